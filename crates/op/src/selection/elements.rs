//! Selections of one kind of elements or another.

use mesh::{EdgeId, FaceId, Mesh, VertexId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{EdgeSelection, FaceSelection, Select, VertexSelection};
use crate::{Context, OpError};

/// Vertices, edges or faces.
///
/// Recipes may leave the outer name out where only one kind of elements has such a selection:
/// `Sharp(above: 30)` is `Edges(Sharp(above: 30))`, but `Boundary` could be of any kind.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-shorthand" = true))]
pub enum Elements {
    /// Vertices.
    Vertices(VertexSelection),
    /// Edges.
    Edges(EdgeSelection),
    /// Faces.
    Faces(FaceSelection),
}

/// What a selection selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// Vertices.
    Vertices,
    /// Edges.
    Edges,
    /// Faces.
    Faces,
}

impl ElementKind {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Vertices, Self::Edges, Self::Faces];

    /// `vertices`, `edges` or `faces`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Vertices => VertexSelection::WORD,
            Self::Edges => EdgeSelection::WORD,
            Self::Faces => FaceSelection::WORD,
        }
    }
}

/// The elements of a mesh that a selection matches, in order of their numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selected {
    /// Vertices.
    Vertices(Vec<VertexId>),
    /// Edges.
    Edges(Vec<EdgeId>),
    /// Faces.
    Faces(Vec<FaceId>),
}

impl Elements {
    /// What kind of elements these are.
    pub fn kind(&self) -> ElementKind {
        match self {
            Self::Vertices(_) => ElementKind::Vertices,
            Self::Edges(_) => ElementKind::Edges,
            Self::Faces(_) => ElementKind::Faces,
        }
    }

    /// The elements of a mesh that the selection matches.
    ///
    /// # Errors
    ///
    /// As [`Select::resolve`]: an element, tag or material that is named is not there, or an expected
    /// number is not met.
    pub fn resolve(&self, mesh: &Mesh, cx: &Context) -> Result<Selected, OpError> {
        Ok(match self {
            Self::Vertices(s) => Selected::Vertices(s.resolve(mesh, cx)?),
            Self::Edges(s) => Selected::Edges(s.resolve(mesh, cx)?),
            Self::Faces(s) => Selected::Faces(s.resolve(mesh, cx)?),
        })
    }
}

impl Selected {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Vertices(list) => list.len(),
            Self::Edges(list) => list.len(),
            Self::Faces(list) => list.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
