//! Why an operation failed.

use mesh::{BuildError, EditError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The reasons for which an edit or a selection is refused, as recipes name them in `refused:`.
#[derive(
    Clone, Copy, Debug, Deserialize, Eq, JsonSchema, Ord, PartialEq, PartialOrd, Serialize,
)]
#[serde(deny_unknown_fields)]
pub enum Refusal {
    /// An edge is on the boundary and the edit needs a face on both sides.
    Boundary,
    /// The edit is for triangles only.
    NotTriangle,
    /// Both triangles at an edge have the same opposite vertex.
    SameOpposite,
    /// Two vertices would get a second edge between them.
    DuplicateEdge,
    /// Corner attributes differ between the two sides of an edge.
    Seam,
    /// A place on an edge is not strictly between its ends.
    OutsideEdge,
    /// The faces around a vertex would fall into two fans.
    Pinch,
    /// A vertex, edge or face that was named is not there, or is not there any more.
    Missing,
    /// A selection did not match as many elements as was expected.
    Expectation,
    /// The result would not be a manifold.
    NonManifold,
    /// The mesh has as many elements as ids can number.
    Full,
}

impl From<EditError> for Refusal {
    fn from(error: EditError) -> Self {
        match error {
            EditError::NoSuchVertex(_) | EditError::NoSuchEdge(_) | EditError::NoSuchFace(_) => {
                Self::Missing
            }
            EditError::Boundary(_) => Self::Boundary,
            EditError::NotTriangle(_) => Self::NotTriangle,
            EditError::SameOpposite(..) => Self::SameOpposite,
            EditError::DuplicateEdge(..) => Self::DuplicateEdge,
            EditError::Seam(_) => Self::Seam,
            EditError::OutsideEdge(_) => Self::OutsideEdge,
            EditError::Pinch(_) => Self::Pinch,
            EditError::Full => Self::Full,
        }
    }
}

/// Why an operation failed. The scene is as it was before the step.
#[derive(Debug, thiserror::Error)]
pub enum OpError {
    /// The run was cancelled.
    #[error("cancelled")]
    Cancelled,
    /// An edit or a selection was refused.
    #[error("{message}")]
    Refused {
        /// The reason.
        reason: Refusal,
        /// The reason with the elements.
        message: String,
    },
    /// A parameter has a value that the scene does not allow.
    #[error("{0}")]
    Parameter(String),
    /// An object is not there, is there already, or is of the wrong kind.
    #[error("{0}")]
    Object(String),
    /// The polygons do not form a mesh.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A file could not be read or written.
    #[error("{0}")]
    File(String),
    /// The step needs more memory than the budget allows.
    #[error("{0}")]
    Budget(String),
}

impl OpError {
    /// A refusal with its message.
    pub fn refused(reason: Refusal, message: impl Into<String>) -> Self {
        Self::Refused {
            reason,
            message: message.into(),
        }
    }
}

impl From<EditError> for OpError {
    fn from(error: EditError) -> Self {
        Self::refused(error.into(), error.to_string())
    }
}
