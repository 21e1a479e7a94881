//! A set of picked elements of one object.

use mesh::{EdgeId, Element, FaceId, HalfEdgeId, Mesh, VertexId};
use op::{ElementKind, Selected};

/// Picked elements of one object, in the order of their indices.
#[derive(Clone, Debug, PartialEq)]
pub struct Picked {
    /// The name of the object.
    pub object: String,
    /// The elements.
    pub elements: Selected,
    /// The chosen half-edge, if there is one. The view draws it as an arrow. The user can walk from this half-edge to
    /// other half-edges with keys.
    pub half_edge: Option<HalfEdgeId>,
}

impl Picked {
    /// Creates a set of elements without a chosen half-edge.
    pub fn new(object: &str, elements: Selected) -> Self {
        Self {
            object: object.to_owned(),
            elements,
            half_edge: None,
        }
    }

    /// Creates a set of one element. If the element is a half-edge, the set contains its edge.
    pub fn one(object: &str, element: Element) -> Self {
        let (elements, half_edge) = match element {
            Element::Vertex(v) => (Selected::Vertices(vec![v]), None),
            Element::Edge(e) => (Selected::Edges(vec![e]), Some(e.half_edge())),
            Element::HalfEdge(h) => (Selected::Edges(vec![h.edge()]), Some(h)),
            Element::Face(f) => (Selected::Faces(vec![f]), None),
        };
        Self {
            object: object.to_owned(),
            elements,
            half_edge,
        }
    }

    /// Returns the kind of the elements.
    pub fn kind(&self) -> ElementKind {
        match self.elements {
            Selected::Vertices(_) => ElementKind::Vertices,
            Selected::Edges(_) => ElementKind::Edges,
            Selected::Faces(_) => ElementKind::Faces,
        }
    }

    /// Returns the number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Whether no element is picked.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Whether an element is in the set.
    pub fn contains(&self, element: Element) -> bool {
        match (&self.elements, element) {
            (Selected::Vertices(list), Element::Vertex(v)) => list.binary_search(&v).is_ok(),
            (Selected::Edges(list), Element::Edge(e)) => list.binary_search(&e).is_ok(),
            (Selected::Edges(list), Element::HalfEdge(h)) => list.binary_search(&h.edge()).is_ok(),
            (Selected::Faces(list), Element::Face(f)) => list.binary_search(&f).is_ok(),
            _ => false,
        }
    }

    /// Adds the elements of another set. If the other set belongs to another object, or has another kind of elements,
    /// the other set replaces this set.
    pub fn add(&mut self, other: &Self) {
        if self.object != other.object || self.kind() != other.kind() {
            self.clone_from(other);
            return;
        }
        match (&mut self.elements, &other.elements) {
            (Selected::Vertices(a), Selected::Vertices(b)) => merge(a, b),
            (Selected::Edges(a), Selected::Edges(b)) => merge(a, b),
            (Selected::Faces(a), Selected::Faces(b)) => merge(a, b),
            _ => {}
        }
        self.half_edge = other.half_edge.or(self.half_edge);
    }

    /// If all elements of another set are already in this set, removes these elements. Otherwise, adds the elements of
    /// the other set. A click with Shift has this effect. If the other set belongs to another object, or has another
    /// kind of elements, the other set replaces this set.
    pub fn toggle(&mut self, other: &Self) {
        let before = self.clone();
        self.add(other);
        if self.object == before.object && self.elements == before.elements {
            self.remove(other);
        }
    }

    /// Removes the elements of another set. Does nothing if the other set belongs to another object, or has another
    /// kind of elements.
    pub fn remove(&mut self, other: &Self) {
        if self.object != other.object {
            return;
        }
        match (&mut self.elements, &other.elements) {
            (Selected::Vertices(a), Selected::Vertices(b)) => {
                a.retain(|v| b.binary_search(v).is_err());
            }
            (Selected::Edges(a), Selected::Edges(b)) => a.retain(|e| b.binary_search(e).is_err()),
            (Selected::Faces(a), Selected::Faces(b)) => a.retain(|f| b.binary_search(f).is_err()),
            _ => {}
        }
        self.half_edge = self
            .half_edge
            .filter(|&h| self.contains(Element::HalfEdge(h)));
    }

    /// Returns those elements of the set that exist in a mesh.
    #[must_use]
    pub fn existing(&self, mesh: &Mesh) -> Self {
        let elements = match &self.elements {
            Selected::Vertices(list) => Selected::Vertices(
                list.iter()
                    .copied()
                    .filter(|&v: &VertexId| mesh.has_vertex(v))
                    .collect(),
            ),
            Selected::Edges(list) => Selected::Edges(
                list.iter()
                    .copied()
                    .filter(|&e: &EdgeId| mesh.has_edge(e))
                    .collect(),
            ),
            Selected::Faces(list) => Selected::Faces(
                list.iter()
                    .copied()
                    .filter(|&f: &FaceId| mesh.has_face(f))
                    .collect(),
            ),
        };
        Self {
            object: self.object.clone(),
            elements,
            half_edge: self.half_edge.filter(|h| mesh.has_edge(h.edge())),
        }
    }
}

fn merge<T: Ord + Copy>(a: &mut Vec<T>, b: &[T]) {
    a.extend_from_slice(b);
    a.sort_unstable();
    a.dedup();
}
