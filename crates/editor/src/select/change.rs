//! Changes the picked elements: grows or shrinks them, picks all elements, or picks the elements of a typed selection.

use mesh::{Domain, Mesh, VertexId};
use op::{ElementKind, Selected};
use recipe::{Diagnostic, read_selection, resolve};
use ron_tree::string_literal;
use scene::Scene;

use super::Picked;

impl Picked {
    /// Returns all elements of a mesh that have the given kind.
    pub fn all(object: &str, mesh: &Mesh, kind: ElementKind) -> Self {
        let elements = match kind {
            ElementKind::Vertices => Selected::Vertices(mesh.vertices().collect()),
            ElementKind::Edges => Selected::Edges(mesh.edges().collect()),
            ElementKind::Faces => Selected::Faces(mesh.faces().collect()),
        };
        Self::new(object, elements)
    }

    /// Returns the elements that a typed selection of a recipe, such as `Sharp(above: 30)`, selects on an object.
    ///
    /// # Errors
    ///
    /// Returns the errors of the text with their spans. If the selection fails on the mesh, or the object is not a
    /// mesh, returns an error without a span.
    pub fn by_text(
        scene: &Scene,
        object: &str,
        text: &str,
        kind: Option<ElementKind>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let elements = read_selection(text, kind)?;
        let error = |message: String| vec![Diagnostic::without_place(message)];
        let found = scene
            .object(object)
            .and_then(|found| Some((found, found.as_mesh()?)));
        let (found, mesh) =
            found.ok_or_else(|| error(format!("{} is not a mesh", string_literal(object))))?;
        let elements =
            resolve(&elements, scene, found, mesh, "").map_err(|e| error(e.to_string()))?;
        Ok(Self::new(object, elements))
    }

    /// Returns the picked elements and their neighbors, as the selection `Grow` does. Edges or faces are neighbors if
    /// they share a vertex. Vertices are neighbors if an edge joins them.
    #[must_use]
    pub fn grown(&self, mesh: &Mesh) -> Self {
        let mut marks = vertices(mesh, &self.elements);
        if let Selected::Vertices(list) = &self.elements {
            for &v in list {
                mesh.vertex_neighbors(v)
                    .for_each(|w| marks[w.index()] = true);
            }
        }
        let is_marked = |v: VertexId| marks[v.index()];
        Self {
            elements: touching(mesh, self.kind(), is_marked),
            ..self.clone()
        }
    }

    /// Returns the picked elements whose neighbors are all picked, as the selection `Shrink` does. Edges or faces are
    /// neighbors if they share a vertex. Vertices are neighbors if an edge joins them.
    #[must_use]
    pub fn shrunk(&self, mesh: &Mesh) -> Self {
        let outside = Self {
            elements: complement(mesh, &self.elements),
            ..self.clone()
        };
        let grown = outside.grown(mesh);
        Self {
            elements: complement(mesh, &grown.elements),
            half_edge: None,
            ..self.clone()
        }
    }
}

/// Returns, for each vertex of the mesh, whether it is a vertex of one of the elements.
fn vertices(mesh: &Mesh, elements: &Selected) -> Vec<bool> {
    let mut marks = vec![false; mesh.domain_len(Domain::Vertex)];
    let mut mark = |v: VertexId| marks[v.index()] = true;
    match elements {
        Selected::Vertices(list) => list.iter().copied().for_each(mark),
        Selected::Edges(list) => list
            .iter()
            .flat_map(|&e| mesh.edge_vertices(e))
            .for_each(mark),
        Selected::Faces(list) => {
            for &f in list {
                mesh.face_vertices(f).for_each(&mut mark);
            }
        }
    }
    marks
}

fn touching(mesh: &Mesh, kind: ElementKind, is_marked: impl Fn(VertexId) -> bool) -> Selected {
    match kind {
        ElementKind::Vertices => {
            Selected::Vertices(mesh.vertices().filter(|&v| is_marked(v)).collect())
        }
        ElementKind::Edges => {
            let edges = mesh
                .edges()
                .filter(|&e| mesh.edge_vertices(e).into_iter().any(&is_marked));
            Selected::Edges(edges.collect())
        }
        ElementKind::Faces => Selected::Faces(
            mesh.faces()
                .filter(|&f| mesh.face_vertices(f).any(&is_marked))
                .collect(),
        ),
    }
}

/// Returns all elements of the mesh that have the same kind as the given elements, but are not among them.
fn complement(mesh: &Mesh, elements: &Selected) -> Selected {
    match elements {
        Selected::Vertices(list) => Selected::Vertices(
            mesh.vertices()
                .filter(|v| list.binary_search(v).is_err())
                .collect(),
        ),
        Selected::Edges(list) => Selected::Edges(
            mesh.edges()
                .filter(|e| list.binary_search(e).is_err())
                .collect(),
        ),
        Selected::Faces(list) => Selected::Faces(
            mesh.faces()
                .filter(|f| list.binary_search(f).is_err())
                .collect(),
        ),
    }
}
