//! The errors that subdivision can return.

use mesh::{FaceId, VertexId};
use progress::Cancelled;

use crate::rules::Scheme;
use crate::size::TooLarge;

/// Why a mesh could not be subdivided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SubdivisionError {
    /// The scheme supports only triangles, but a face of the mesh has more than three corners.
    #[error("{} needs triangles, but {face} has {degree} corners", .scheme.name())]
    NotTriangle {
        /// The scheme.
        scheme: Scheme,
        /// The first face with more than three corners. The id is valid in the compacted mesh (without deleted
        /// elements).
        face: FaceId,
        /// The number of corners of the face.
        degree: usize,
    },
    /// A coordinate is so large that a weighted sum of coordinates could overflow.
    #[error(
        "{} accepts only coordinates of at most {:e} in magnitude, but {vertex} has a larger coordinate",
        .scheme.name(), crate::MAX_COORDINATE
    )]
    TooFar {
        /// The scheme.
        scheme: Scheme,
        /// The first vertex with a coordinate whose magnitude is above the maximum. The id is valid in the compacted
        /// mesh (without deleted elements).
        vertex: VertexId,
    },
    /// The scheme can subdivide a whole mesh, but not a part of it.
    #[error("{} can only refine all faces, not a part of them", .0.name())]
    WholeMesh(Scheme),
    /// The list of faces to refine does not have one flag for each face of the mesh.
    #[error("expected one flag for each of the {faces} faces, found {flags} flags")]
    FlagCount {
        /// The number of faces of the mesh.
        faces: usize,
        /// The number of flags that were given.
        flags: usize,
    },
    /// The crate cannot compute limit positions for this scheme.
    #[error("the limit surface is not available for {}", .0.name())]
    NoLimit(Scheme),
    /// The result would have more elements than there are ids, or exceed the memory budget.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The progress listener asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
