//! Local edits: one a file. Each checks first and changes after, so that a refused edit leaves every
//! array as it was.

mod delete_face;
mod flip;
mod split;

pub use flip::Seams;

use crate::{EdgeId, FaceId, Mesh, VertexId};

/// Why an edit was refused. The mesh is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    /// The vertex does not exist, or is dead.
    #[error("{0} is not a vertex of the mesh")]
    NoSuchVertex(VertexId),
    /// The edge does not exist, or is dead.
    #[error("{0} is not an edge of the mesh")]
    NoSuchEdge(EdgeId),
    /// The face does not exist, or is dead.
    #[error("{0} is not a face of the mesh")]
    NoSuchFace(FaceId),
    /// The edit needs a face on both sides.
    #[error("{0} is on the boundary")]
    Boundary(EdgeId),
    /// The edit is for triangles only.
    #[error("{0} is not a triangle")]
    NotTriangle(FaceId),
    /// The vertices opposite the edge are one and the same.
    #[error("both triangles at {0} have {1} opposite")]
    SameOpposite(EdgeId, VertexId),
    /// The edit would make a second edge between the same two vertices.
    #[error("{0} and {1} already share an edge")]
    DuplicateEdge(VertexId, VertexId),
    /// Corner attributes differ between the two sides of the edge, and the edit would blur them.
    #[error("{0} is a seam of corner attributes")]
    Seam(EdgeId),
    /// The place on the edge is not strictly between its ends.
    #[error("the place on the edge must lie between 0 and 1, not {0}")]
    OutsideEdge(f64),
    /// The edit would leave two fans of faces at a vertex.
    #[error("the faces around {0} would fall into two fans")]
    Pinch(VertexId),
    /// The mesh has as many elements as ids can number.
    #[error("the mesh is full: ids end at 2^32 - 2")]
    Full,
}

impl Mesh {
    fn check_edge(&self, e: EdgeId) -> Result<(), EditError> {
        if self.has_edge(e) {
            Ok(())
        } else {
            Err(EditError::NoSuchEdge(e))
        }
    }

    /// Refuses if there are not ids for so many more half-edges. Vertices and faces are always fewer.
    fn check_room(&self, half_edges: usize) -> Result<(), EditError> {
        let n = self.connectivity.next.len().max(self.positions.len()) + half_edges;
        if n < u32::MAX as usize {
            Ok(())
        } else {
            Err(EditError::Full)
        }
    }
}
