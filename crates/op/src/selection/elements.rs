//! Selections of vertices, edges or faces.

use mesh::{EdgeId, FaceId, Mesh, VertexId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{EdgeSelection, FaceSelection, Select, VertexSelection};
use crate::compiled_once::compiled_once;
use crate::{Context, OpError};

/// A selection of vertices, edges or faces.
///
/// Some selections, such as `Sharp`, exist for only one kind of element. For such a selection, a recipe can omit the
/// outer name (`Vertices`, `Edges` or `Faces`). For example, `Sharp(above: 30)` is short for `Edges(Sharp(above: 30))`.
/// `Boundary` exists for vertices, edges and faces, so its outer name is required, as in `Edges(Boundary)`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, remote = "Self")]
#[schemars(!remote, extend("x-shorthand" = true))]
pub enum Elements {
    /// A selection of vertices.
    Vertices(VertexSelection),
    /// A selection of edges.
    Edges(EdgeSelection),
    /// A selection of faces.
    Faces(FaceSelection),
}

compiled_once!(Elements);

/// The kind of elements of a selection.
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
    /// All three kinds.
    pub const ALL: [Self; 3] = [Self::Vertices, Self::Edges, Self::Faces];

    /// Returns the names of the selections that convert elements of the kind `other` to elements of this kind. For
    /// example, `EdgesOf` converts faces to their edges. The list is empty if both kinds are the same.
    pub fn conversions(self, other: Self) -> &'static [&'static str] {
        match (self, other) {
            (Self::Vertices, Self::Edges) => &["EndsOf"],
            (Self::Vertices, Self::Faces) => &["CornersOf"],
            (Self::Edges, Self::Vertices) => &["EdgesAround", "EdgesWithin"],
            (Self::Edges, Self::Faces) => &["EdgesOf"],
            (Self::Faces, Self::Vertices) => &["FacesAround"],
            (Self::Faces, Self::Edges) => &["FacesBeside"],
            (Self::Vertices, Self::Vertices)
            | (Self::Edges, Self::Edges)
            | (Self::Faces, Self::Faces) => &[],
        }
    }

    /// Returns `vertices`, `edges` or `faces`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Vertices => VertexSelection::WORD,
            Self::Edges => EdgeSelection::WORD,
            Self::Faces => FaceSelection::WORD,
        }
    }
}

/// The selected elements of a mesh, in order of their ids.
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
    /// Returns the kind of elements.
    pub fn kind(&self) -> ElementKind {
        match self {
            Self::Vertices(_) => ElementKind::Vertices,
            Self::Edges(_) => ElementKind::Edges,
            Self::Faces(_) => ElementKind::Faces,
        }
    }

    /// Returns the selected elements of a mesh.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Select::resolve`].
    pub fn resolve(&self, mesh: &Mesh, cx: &Context) -> Result<Selected, OpError> {
        Ok(match self {
            Self::Vertices(s) => Selected::Vertices(s.resolve(mesh, cx)?),
            Self::Edges(s) => Selected::Edges(s.resolve(mesh, cx)?),
            Self::Faces(s) => Selected::Faces(s.resolve(mesh, cx)?),
        })
    }
}

impl Selected {
    /// Returns the number of selected elements.
    pub fn len(&self) -> usize {
        match self {
            Self::Vertices(list) => list.len(),
            Self::Edges(list) => list.len(),
            Self::Faces(list) => list.len(),
        }
    }

    /// Whether no element is selected.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
