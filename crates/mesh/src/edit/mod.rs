//! Local edits, with one file for each edit or for a few similar edits. Each edit first checks whether it is possible,
//! then changes the mesh, so a refused edit leaves every array unchanged.

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

/// Why an edit was refused. A refused edit leaves the mesh unchanged.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    /// The vertex does not exist, or was removed.
    #[error("{0} is not a vertex of the mesh")]
    NoSuchVertex(VertexId),
    /// The half-edge does not exist, or was removed.
    #[error("{0} is not a half-edge of the mesh")]
    NoSuchHalfEdge(HalfEdgeId),
    /// The edge does not exist, or was removed.
    #[error("{0} is not an edge of the mesh")]
    NoSuchEdge(EdgeId),
    /// The face does not exist, or was removed.
    #[error("{0} is not a face of the mesh")]
    NoSuchFace(FaceId),
    /// The edit needs an edge with a face on both sides.
    #[error("{0} is on the boundary")]
    Boundary(EdgeId),
    /// The edit needs a half-edge without a face, but this half-edge has one. The edge can still be on the
    /// boundary, if its other half-edge has no face.
    #[error("{0} has a face, so it is not a boundary half-edge")]
    NotBoundary(HalfEdgeId),
    /// The edit needs a vertex inside the surface.
    #[error("{0} is on the boundary")]
    BoundaryVertex(VertexId),
    /// The edit needs a triangle.
    #[error("{0} is not a triangle")]
    NotTriangle(FaceId),
    /// The two vertices opposite the edge are the same vertex.
    #[error("both triangles at {0} have the same opposite vertex {1}")]
    SameOpposite(EdgeId, VertexId),
    /// The same face lies on both sides of the edge, or would lie on both sides after the edit.
    #[error("the same face is on both sides of {0}")]
    SameFace(EdgeId),
    /// The edit would make a second edge between the same two vertices.
    #[error("{0} and {1} already share an edge")]
    DuplicateEdge(VertexId, VertexId),
    /// The vertex has too few edges for this edit.
    #[error("{0} has too few edges")]
    FewEdges(VertexId),
    /// The face would be left with fewer than three corners.
    #[error("{0} would have fewer than three corners")]
    FewCorners(FaceId),
    /// A face contains this vertex twice, or would contain it twice.
    #[error("a face would contain {0} twice")]
    RepeatedVertex(VertexId),
    /// No face has both vertices as corners, or the two vertices are the same. [`Mesh::cut_face`] also returns this
    /// error if two diagonals cross or are equal, or if a diagonal joins neighboring corners. The error then contains
    /// the ends of the first diagonal in the list.
    #[error("no face can be cut from {0} to {1}")]
    NoCut(VertexId, VertexId),
    /// The cut between the two vertices is ambiguous: several faces have both vertices as corners, or one face contains
    /// one of the vertices several times.
    #[error("several cuts from {0} to {1} are possible")]
    SeveralCuts(VertexId, VertexId),
    /// The edit would remove the last faces of a component, or would leave two faces that lie back to back.
    #[error("no valid faces would be left around {0}")]
    Vanishes(EdgeId),
    /// The ends of the edge have a common neighbor that is not a corner of a triangle at the edge, so the ends
    /// cannot be merged.
    #[error(
        "both ends of {0} are neighbors of {1}, which is not a corner of a triangle at the edge"
    )]
    Link(EdgeId, VertexId),
    /// Both ends of the edge are on the boundary, but the edge is not. Collapsing this edge would split one boundary
    /// loop in two, or merge two boundary loops.
    #[error("{0} is inside the surface, but both of its ends are on the boundary")]
    JoinsBoundaries(EdgeId),
    /// Corner attributes differ between the two sides of the edge, and the edit would lose the difference.
    #[error("{0} is a seam of corner attributes")]
    Seam(EdgeId),
    /// The position along the edge is not between 0 (one end) and 1 (the other end). A collapse allows positions from 0
    /// to 1, inclusive; other edits require a position strictly between 0 and 1.
    #[error(
        "the position along the edge must be between 0 and 1, not {0} (only a collapse accepts 0 and 1)"
    )]
    OutsideEdge(f64),
    /// A coordinate, length or fraction is not finite, or is out of range.
    #[error("{0} is not finite, or is outside the range that this edit accepts")]
    BadNumber(f64),
    /// The edit would leave several fans of faces at the vertex. Also returned if a hole to be filled contains the
    /// vertex twice, or if both ends of a diagonal are at the vertex.
    #[error("the faces around {0} would form several separate fans")]
    Pinch(VertexId),
    /// The corner does not belong to the required face or vertex.
    #[error("{0} is not a corner of the face or vertex that is to be split")]
    WrongCorner(HalfEdgeId),
    /// The two corners are the same, adjacent, or at the same vertex.
    #[error("{0} and {1} are the same corner, adjacent corners, or corners at the same vertex")]
    Adjacent(HalfEdgeId, HalfEdgeId),
    /// The listed faces must form whole components, but this face shares an edge with a face that was not listed.
    #[error(
        "the faces must form whole connected components, but {0} shares an edge with a face that was not listed"
    )]
    PartOfComponent(FaceId),
    /// The edge was listed twice.
    #[error("{0} was listed twice")]
    EdgeListedTwice(EdgeId),
    /// The face was listed twice.
    #[error("{0} was listed twice")]
    FaceListedTwice(FaceId),
    /// The boundary loop has fewer than three edges.
    #[error("the boundary loop of {0} has fewer than three edges")]
    ShortLoop(HalfEdgeId),
    /// The two half-edges lie on the same boundary loop, and the edit needs two loops.
    #[error("{0} and {1} lie on the same boundary loop")]
    SameLoop(HalfEdgeId, HalfEdgeId),
    /// The ends of the edge would become one vertex.
    #[error("{0} would start and end at the same vertex")]
    SelfLoop(EdgeId),
    /// Two corners of the face would become one vertex, or are already at one vertex.
    #[error("{0} would contain {1} twice")]
    VisitsTwice(FaceId, VertexId),
    /// The list of elements to edit is empty.
    #[error("the list of elements to edit is empty")]
    NoElements,
    /// After the edit, the mesh could have more elements than there are ids.
    #[error("the mesh would have too many elements: the highest id is 2^32 - 2")]
    Full,
}

impl EditError {
    /// Returns the elements that the error message mentions, in the order of the message.
    pub fn elements(self) -> Vec<Element> {
        match self {
            Self::NoSuchVertex(v)
            | Self::BoundaryVertex(v)
            | Self::FewEdges(v)
            | Self::RepeatedVertex(v)
            | Self::Pinch(v) => vec![v.into()],
            Self::NoSuchHalfEdge(h)
            | Self::NotBoundary(h)
            | Self::WrongCorner(h)
            | Self::ShortLoop(h) => vec![h.into()],
            Self::NoSuchEdge(e)
            | Self::Boundary(e)
            | Self::SameFace(e)
            | Self::Vanishes(e)
            | Self::JoinsBoundaries(e)
            | Self::Seam(e)
            | Self::EdgeListedTwice(e)
            | Self::SelfLoop(e) => vec![e.into()],
            Self::NoSuchFace(f)
            | Self::NotTriangle(f)
            | Self::FewCorners(f)
            | Self::PartOfComponent(f)
            | Self::FaceListedTwice(f) => vec![f.into()],
            Self::SameOpposite(e, v) | Self::Link(e, v) => vec![e.into(), v.into()],
            Self::DuplicateEdge(v, w) | Self::NoCut(v, w) | Self::SeveralCuts(v, w) => {
                vec![v.into(), w.into()]
            }
            Self::Adjacent(h, g) | Self::SameLoop(h, g) => vec![h.into(), g.into()],
            Self::VisitsTwice(f, v) => vec![f.into(), v.into()],
            Self::OutsideEdge(_) | Self::BadNumber(_) | Self::NoElements | Self::Full => Vec::new(),
        }
    }
}

impl Mesh {
    fn check_vertex(&self, v: VertexId) -> Result<(), EditError> {
        require(self.has_vertex(v), EditError::NoSuchVertex(v))
    }

    fn check_half_edge(&self, h: HalfEdgeId) -> Result<(), EditError> {
        require(self.has_edge(h.edge()), EditError::NoSuchHalfEdge(h))
    }

    fn check_edge(&self, e: EdgeId) -> Result<(), EditError> {
        require(self.has_edge(e), EditError::NoSuchEdge(e))
    }

    fn check_face(&self, f: FaceId) -> Result<(), EditError> {
        require(self.has_face(f), EditError::NoSuchFace(f))
    }

    /// Checks that `h` is a half-edge without a face.
    fn check_hole(&self, h: HalfEdgeId) -> Result<(), EditError> {
        self.check_half_edge(h)?;
        require(self.face(h).is_none(), EditError::NotBoundary(h))
    }

    /// Checks that the number of half-edges and the number of vertices can each grow by `half_edges` without running
    /// out of ids. A caller must add at most `half_edges` half-edges, and no more vertices or faces than half-edges.
    fn check_room(&self, half_edges: usize) -> Result<(), EditError> {
        let n = self.connectivity.next.len().max(self.positions.len()) + half_edges;
        require(n < u32::MAX as usize, EditError::Full)
    }

    /// Links the given half-edges, in order, to a loop around the face `f`.
    fn link_around(&mut self, f: FaceId, around: &[HalfEdgeId]) {
        for (&h, &next) in around.iter().zip(around.iter().cycle().skip(1)) {
            self.set_next(h, next);
            self.set_face(h, Some(f));
        }
    }

    /// If the face of `old` stores `old` as its half-edge, makes the face store `new` instead.
    #[inline]
    fn replace_first_of_face(&mut self, old: HalfEdgeId, new: HalfEdgeId) {
        if let Some(f) = self.face(old).filter(|&f| self.face_half_edge(f) == old) {
            self.set_face_half_edge(f, new);
        }
    }

    /// If the origin of `old` stores `old` as its half-edge, makes the origin store `new` instead.
    #[inline]
    fn replace_first_of_vertex(&mut self, old: HalfEdgeId, new: HalfEdgeId) {
        let v = self.origin(old);
        if self.vertex_half_edge(v) == Some(old) {
            self.set_vertex_half_edge(v, Some(new));
        }
    }

    /// Adds an isolated vertex with the position and values of `v`.
    fn push_copy_of_vertex(&mut self, v: VertexId) -> VertexId {
        let copy = self.push_vertex(self.position(v));
        self.copy_values(v, copy);
        copy
    }

    /// Adds a face that stores `h` as its half-edge and has the values of `f`.
    fn push_copy_of_face(&mut self, f: FaceId, h: HalfEdgeId) -> FaceId {
        let copy = self.push_face(h);
        self.copy_values(f, copy);
        copy
    }

    /// Adds an edge between two corners of a face. Each half-edge of the new edge gets the values of the old corner
    /// from which it starts.
    fn push_diagonal(&mut self, x: HalfEdgeId, y: HalfEdgeId) -> [HalfEdgeId; 2] {
        let halves = self.push_edge(self.origin(x), self.origin(y)).half_edges();
        self.copy_values(x, halves[0]);
        self.copy_values(y, halves[1]);
        halves
    }
}

/// Checks that all coordinates are finite.
fn check_finite(points: &[DVec3]) -> Result<(), EditError> {
    let mut coordinates = points.iter().flat_map(DVec3::to_array);
    let bad = coordinates.find(|x| !x.is_finite());
    bad.map_or(Ok(()), |x| Err(EditError::BadNumber(x)))
}

/// Returns the lowest id that is listed more than once.
fn first_repeated<I: Id>(ids: &[I]) -> Option<I> {
    let mut sorted = ids.to_vec();
    sorted.sort_unstable();
    let mut pairs = sorted.windows(2);
    pairs.find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

/// Returns the ids in ascending order, without duplicates.
fn sorted_unique<T: Ord>(ids: impl Iterator<Item = T>) -> Vec<T> {
    let mut sorted: Vec<T> = ids.collect();
    sorted.sort_unstable();
    sorted.dedup();
    sorted
}

/// Returns `refusal` as an error unless `is_allowed` is true.
fn require(is_allowed: bool, refusal: EditError) -> Result<(), EditError> {
    if is_allowed { Ok(()) } else { Err(refusal) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_elements_of_an_error_are_those_of_its_message() {
        let (e, v, w) = (EdgeId::new(3), VertexId::new(1), VertexId::new(2));
        for error in [
            EditError::Boundary(e),
            EditError::Link(e, v),
            EditError::DuplicateEdge(v, w),
            EditError::VisitsTwice(FaceId::new(4), v),
            EditError::Adjacent(HalfEdgeId::new(5), HalfEdgeId::new(6)),
        ] {
            let text = error.to_string();
            let mut from = 0;
            for element in error.elements() {
                let offset = text[from..].find(&element.to_string());
                from += offset.expect("the message names the element");
            }
        }
    }
}
