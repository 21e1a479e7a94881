//! Local edits: one a file. Each checks first and changes after, so that a refused edit leaves every
//! array as it was.

mod bevel;
mod bridge;
mod collapse;
mod cut;
mod cut_face;
mod delete;
mod delete_face;
mod dissolve_edge;
mod dissolve_vertex;
mod extrude;
mod fill_hole;
mod flip;
mod inset;
mod poke;
mod reverse;
mod split;
mod split_face;
mod split_vertex;
mod stitch;
#[cfg(test)]
mod testing;

pub use cut_face::polygon_parts;
pub use flip::Seams;

use glam::DVec3;

use crate::{EdgeId, Element, FaceId, HalfEdgeId, Id, Mesh, VertexId};

/// Why an edit was refused. The mesh is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    /// The vertex does not exist, or is dead.
    #[error("{0} is not a vertex of the mesh")]
    NoSuchVertex(VertexId),
    /// The half-edge does not exist, or is dead.
    #[error("{0} is not a half-edge of the mesh")]
    NoSuchHalfEdge(HalfEdgeId),
    /// The edge does not exist, or is dead.
    #[error("{0} is not an edge of the mesh")]
    NoSuchEdge(EdgeId),
    /// The face does not exist, or is dead.
    #[error("{0} is not a face of the mesh")]
    NoSuchFace(FaceId),
    /// The edit needs a face on both sides.
    #[error("{0} is on the boundary")]
    Boundary(EdgeId),
    /// The edit needs an edge with a face on one side only.
    #[error("{0} is not on the boundary")]
    NotBoundary(EdgeId),
    /// The edit is for vertices inside the surface.
    #[error("{0} is on the boundary")]
    BoundaryVertex(VertexId),
    /// The edit is for triangles only.
    #[error("{0} is not a triangle")]
    NotTriangle(FaceId),
    /// The vertices opposite the edge are one and the same.
    #[error("both triangles at {0} have {1} opposite")]
    SameOpposite(EdgeId, VertexId),
    /// One face lies on both sides of the edge.
    #[error("one face is on both sides of {0}")]
    SameFace(EdgeId),
    /// The edit would make a second edge between the same two vertices.
    #[error("{0} and {1} already share an edge")]
    DuplicateEdge(VertexId, VertexId),
    /// The vertex has too few edges for the edit.
    #[error("{0} has too few edges")]
    FewEdges(VertexId),
    /// The face would be left with fewer than three corners.
    #[error("{0} has too few corners")]
    FewCorners(FaceId),
    /// A face would have this vertex, or has it, as a corner twice.
    #[error("one face would have {0} as a corner twice")]
    RepeatedVertex(VertexId),
    /// No face has both vertices as corners that an edge could join.
    #[error("no face can be cut from {0} to {1}")]
    NoCut(VertexId, VertexId),
    /// Several faces have both vertices as corners, or one has them several times.
    #[error("more than one face can be cut from {0} to {1}")]
    SeveralCuts(VertexId, VertexId),
    /// The edit would take the last faces of a closed part, or fold them onto each other.
    #[error("nothing would be left of the faces around {0}")]
    Vanishes(EdgeId),
    /// The ends of the edge have a neighbour in common that no face beside the edge has: they cannot
    /// become one.
    #[error("the ends of {0} are both joined to {1}, but not by a face at the edge")]
    Link(EdgeId, VertexId),
    /// Both ends of the edge are on the boundary, but the edge is not: one boundary would become two,
    /// or two one.
    #[error("{0} joins two places of the boundary")]
    JoinsBoundaries(EdgeId),
    /// Corner attributes differ between the two sides of the edge, and the edit would blur them.
    #[error("{0} is a seam of corner attributes")]
    Seam(EdgeId),
    /// The place on the edge is not strictly between its ends.
    #[error("the place on the edge must lie between 0 and 1, not {0}")]
    OutsideEdge(f64),
    /// A coordinate or length is infinite or not a number, or out of its range.
    #[error("{0} is not a number that the edit can use")]
    BadNumber(f64),
    /// The edit would leave two fans of faces at a vertex.
    #[error("the faces around {0} would fall into two fans")]
    Pinch(VertexId),
    /// The corner is not one of that face, or not one of that vertex.
    #[error("{0} does not begin a side of the same face or vertex")]
    Elsewhere(HalfEdgeId),
    /// The two corners are the same or neighbours.
    #[error("{0} and {1} are the same or next to each other")]
    Adjacent(HalfEdgeId, HalfEdgeId),
    /// The edit is for whole components, and this face is beside one that was not named.
    #[error("{0} is only a part of its component")]
    PartOfComponent(FaceId),
    /// Elements are not a path, a loop or a region of the kind that the edit needs; this one is not in
    /// its place.
    #[error("{0} does not continue the path")]
    NoPath(EdgeId),
    /// The element was named twice.
    #[error("{0} was named twice")]
    Twice(EdgeId),
    /// The same face was named twice.
    #[error("{0} was named twice")]
    TwiceFace(FaceId),
    /// The loop around the hole has fewer than three edges.
    #[error("the loop of boundary edges through {0} has fewer than three")]
    ShortLoop(HalfEdgeId),
    /// The two half-edges lie on one boundary loop, and the edit is for two loops.
    #[error("{0} and {1} lie on one boundary loop")]
    SameLoop(HalfEdgeId, HalfEdgeId),
    /// The ends of the edge would become one vertex.
    #[error("{0} would begin and end at one vertex")]
    SelfLoop(EdgeId),
    /// Two corners of the face would become one vertex.
    #[error("{0} would visit {1} twice")]
    VisitsTwice(FaceId, VertexId),
    /// Nothing was named to edit.
    #[error("nothing was named to edit")]
    Nothing,
    /// The mesh has as many elements as ids can number.
    #[error("the mesh is full: ids end at 2^32 - 2")]
    Full,
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

impl Mesh {
    fn check_vertex(&self, v: VertexId) -> Result<(), EditError> {
        allow(self.has_vertex(v), EditError::NoSuchVertex(v))
    }

    fn check_half_edge(&self, h: HalfEdgeId) -> Result<(), EditError> {
        allow(self.has_edge(h.edge()), EditError::NoSuchHalfEdge(h))
    }

    fn check_edge(&self, e: EdgeId) -> Result<(), EditError> {
        allow(self.has_edge(e), EditError::NoSuchEdge(e))
    }

    fn check_face(&self, f: FaceId) -> Result<(), EditError> {
        allow(self.has_face(f), EditError::NoSuchFace(f))
    }

    /// Refuses unless `h` is a half-edge without a face.
    fn check_hole(&self, h: HalfEdgeId) -> Result<(), EditError> {
        self.check_half_edge(h)?;
        allow(self.face(h).is_none(), EditError::NotBoundary(h.edge()))
    }

    /// Refuses if there are not ids for so many more half-edges. Vertices and faces are always fewer.
    fn check_room(&self, half_edges: usize) -> Result<(), EditError> {
        let n = self.connectivity.next.len().max(self.positions.len()) + half_edges;
        allow(n < u32::MAX as usize, EditError::Full)
    }

    /// Lets half-edges follow each other around `f`, the first after the last.
    fn link_around(&mut self, f: FaceId, around: &[HalfEdgeId]) {
        for (&h, &next) in around.iter().zip(around.iter().cycle().skip(1)) {
            self.set_next(h, next);
            self.set_face(h, Some(f));
        }
    }

    /// If the face of `old` begins at it, lets that face begin at `new`.
    #[inline]
    fn replace_first_of_face(&mut self, old: HalfEdgeId, new: HalfEdgeId) {
        if let Some(f) = self.face(old).filter(|&f| self.face_half_edge(f) == old) {
            self.set_face_half_edge(f, new);
        }
    }

    /// If `old` is the half-edge of its origin, gives that vertex `new` instead.
    #[inline]
    fn replace_leaving(&mut self, old: HalfEdgeId, new: HalfEdgeId) {
        let v = self.origin(old);
        if self.vertex_half_edge(v) == Some(old) {
            self.set_vertex_half_edge(v, Some(new));
        }
    }

    /// A new isolated vertex in the place of `v`, with its values.
    fn push_copy_of_vertex(&mut self, v: VertexId) -> VertexId {
        let copy = self.push_vertex(self.position(v));
        self.copy_values(v, copy);
        copy
    }

    /// A new face that begins at `h`, with the values of `f`.
    fn push_copy_of_face(&mut self, f: FaceId, h: HalfEdgeId) -> FaceId {
        let copy = self.push_face(h);
        self.copy_values(f, copy);
        copy
    }

    /// A new edge between the origins of two corners of a face, each half with the values of the corner
    /// that it leaves.
    fn push_diagonal(&mut self, x: HalfEdgeId, y: HalfEdgeId) -> [HalfEdgeId; 2] {
        let halves = self.push_edge(self.origin(x), self.origin(y)).half_edges();
        self.copy_values(x, halves[0]);
        self.copy_values(y, halves[1]);
        halves
    }
}

/// Refuses points with a coordinate that is not finite.
fn check_finite(points: &[DVec3]) -> Result<(), EditError> {
    let mut coordinates = points.iter().flat_map(DVec3::to_array);
    let bad = coordinates.find(|x| !x.is_finite());
    bad.map_or(Ok(()), |x| Err(EditError::BadNumber(x)))
}

/// The lowest id that is named more than once.
fn first_repeated<I: Id>(ids: &[I]) -> Option<I> {
    let mut sorted = ids.to_vec();
    sorted.sort_unstable();
    let mut pairs = sorted.windows(2);
    pairs.find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

/// The ids in rising order, each once.
fn sorted_once<T: Ord>(ids: impl Iterator<Item = T>) -> Vec<T> {
    let mut sorted: Vec<T> = ids.collect();
    sorted.sort_unstable();
    sorted.dedup();
    sorted
}

fn allow(is_allowed: bool, refusal: EditError) -> Result<(), EditError> {
    if is_allowed { Ok(()) } else { Err(refusal) }
}

#[cfg(test)]
mod tests {
    use super::*;

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
