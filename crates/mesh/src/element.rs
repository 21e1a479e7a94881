//! One element of any kind: what errors name.

use std::fmt;

use glam::DVec3;

use crate::{EdgeId, EditError, FaceId, HalfEdgeId, Mesh, VertexId};

/// One element of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Element {
    /// A vertex.
    Vertex(VertexId),
    /// A half-edge, or the corner at its origin.
    HalfEdge(HalfEdgeId),
    /// An edge.
    Edge(EdgeId),
    /// A face.
    Face(FaceId),
}

/// The id, as in `e7`.
impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(v) => v.fmt(f),
            Self::HalfEdge(h) => h.fmt(f),
            Self::Edge(e) => e.fmt(f),
            Self::Face(face) => face.fmt(f),
        }
    }
}

impl From<VertexId> for Element {
    fn from(v: VertexId) -> Self {
        Self::Vertex(v)
    }
}

impl From<HalfEdgeId> for Element {
    fn from(h: HalfEdgeId) -> Self {
        Self::HalfEdge(h)
    }
}

impl From<EdgeId> for Element {
    fn from(e: EdgeId) -> Self {
        Self::Edge(e)
    }
}

impl From<FaceId> for Element {
    fn from(f: FaceId) -> Self {
        Self::Face(f)
    }
}

impl Mesh {
    /// Where an element is: the position of a vertex, of both ends of an edge or half-edge, of all corners of a
    /// face in their order. Empty if the mesh has no such element.
    pub fn element_points(&self, element: Element) -> Vec<DVec3> {
        match element {
            Element::Vertex(v) if self.has_vertex(v) => vec![self.position(v)],
            Element::HalfEdge(h) if self.has_edge(h.edge()) => [self.origin(h), self.target(h)]
                .map(|v| self.position(v))
                .to_vec(),
            Element::Edge(e) => self.element_points(e.half_edge().into()),
            Element::Face(f) if self.has_face(f) => {
                self.face_vertices(f).map(|v| self.position(v)).collect()
            }
            Element::Vertex(_) | Element::HalfEdge(_) | Element::Face(_) => Vec::new(),
        }
    }
}

impl EditError {
    /// The elements that it names, in the order of its message.
    pub fn elements(self) -> Vec<Element> {
        match self {
            Self::NoSuchVertex(v)
            | Self::BoundaryVertex(v)
            | Self::FewEdges(v)
            | Self::RepeatedVertex(v)
            | Self::Pinch(v) => vec![v.into()],
            Self::NoSuchHalfEdge(h) | Self::Elsewhere(h) | Self::ShortLoop(h) => vec![h.into()],
            Self::NoSuchEdge(e)
            | Self::Boundary(e)
            | Self::NotBoundary(e)
            | Self::SameFace(e)
            | Self::Vanishes(e)
            | Self::JoinsBoundaries(e)
            | Self::Seam(e)
            | Self::NoPath(e)
            | Self::Twice(e)
            | Self::SelfLoop(e) => vec![e.into()],
            Self::NoSuchFace(f)
            | Self::NotTriangle(f)
            | Self::FewCorners(f)
            | Self::PartOfComponent(f)
            | Self::TwiceFace(f) => vec![f.into()],
            Self::SameOpposite(e, v) | Self::Link(e, v) => vec![e.into(), v.into()],
            Self::DuplicateEdge(v, w) | Self::NoCut(v, w) | Self::SeveralCuts(v, w) => {
                vec![v.into(), w.into()]
            }
            Self::Adjacent(h, g) | Self::SameLoop(h, g) => vec![h.into(), g.into()],
            Self::VisitsTwice(f, v) => vec![f.into(), v.into()],
            Self::OutsideEdge(_) | Self::BadNumber(_) | Self::Nothing | Self::Full => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn elements_are_where_their_vertices_are() {
        let mesh = shapes::square();
        let f = mesh.faces().next().expect("a face");
        let corners: Vec<DVec3> = mesh.face_vertices(f).map(|v| mesh.position(v)).collect();

        assert_eq!(mesh.element_points(f.into()), corners);
        for h in mesh.face_half_edges(f) {
            let ends = [mesh.origin(h), mesh.target(h)].map(|v| mesh.position(v));
            assert_eq!(mesh.element_points(h.into()), ends);
            assert_eq!(mesh.element_points(h.edge().into()).len(), 2);
            assert_eq!(mesh.element_points(mesh.origin(h).into()), ends[..1]);
        }
    }

    #[test]
    fn what_is_not_there_is_nowhere() {
        let mesh = shapes::square();

        for element in [
            VertexId::new(99).into(),
            EdgeId::new(99).into(),
            HalfEdgeId::new(99).into(),
            FaceId::new(99).into(),
        ] {
            assert!(mesh.element_points(element).is_empty(), "{element}");
        }
    }

    #[test]
    fn the_elements_of_a_refusal_are_those_of_its_message() {
        let (e, v, w) = (EdgeId::new(3), VertexId::new(1), VertexId::new(2));
        for refusal in [
            EditError::Boundary(e),
            EditError::Link(e, v),
            EditError::DuplicateEdge(v, w),
            EditError::VisitsTwice(FaceId::new(4), v),
            EditError::Adjacent(HalfEdgeId::new(5), HalfEdgeId::new(6)),
        ] {
            let text = refusal.to_string();
            let mut from = 0;
            for element in refusal.elements() {
                let at = text[from..].find(&element.to_string());
                from += at.expect("the message names it");
            }
        }
    }
}
