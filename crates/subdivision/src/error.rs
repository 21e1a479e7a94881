//! Why a mesh was not subdivided.

use mesh::FaceId;
use progress::Cancelled;

use crate::rules::Scheme;
use crate::size::TooLarge;

/// Why a mesh was not subdivided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SubdivisionError {
    /// The scheme is for triangles, and a face has more corners.
    #[error("{} needs triangles, but {face} has {degree} corners", .scheme.name())]
    NotTriangle {
        /// The scheme.
        scheme: Scheme,
        /// The first such face of the dense mesh.
        face: FaceId,
        /// How many corners it has.
        degree: usize,
    },
    /// The scheme subdivides whole meshes only.
    #[error("{} cannot refine some of the faces only", .0.name())]
    WholeMesh(Scheme),
    /// The faces to refine were given for another number of faces.
    #[error("expected a choice for each of {faces} faces, not {choices}")]
    Choices {
        /// How many faces the mesh has.
        faces: usize,
        /// How many choices there were.
        choices: usize,
    },
    /// There are no limit masks for the scheme.
    #[error("the limit of {} is not known", .0.name())]
    NoLimit(Scheme),
    /// The elements would outnumber the ids, or take more memory than allowed.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The progress listener asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
