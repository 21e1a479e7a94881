//! Why an operation failed.

use geometry::MergeError;
use mesh::{BuildError, EditError, Element, Mesh, VertexId};
use progress::Cancelled;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ErrorLocation;

/// The reasons for refusing an edit or a selection. Recipes name these reasons in `refused:`.
#[derive(
    Clone, Copy, Debug, Deserialize, Eq, JsonSchema, Ord, PartialEq, PartialOrd, Serialize,
)]
#[serde(deny_unknown_fields)]
pub enum Refusal {
    /// An edge or a vertex is on the boundary, but the edit needs faces on all sides of it.
    Boundary,
    /// An edge has a face on both sides, but the edit needs a boundary edge.
    NotBoundary,
    /// A face is not a triangle, but the edit needs a triangle.
    NotTriangle,
    /// The two triangles at an edge have the same third vertex.
    SameOpposite,
    /// The same face lies on both sides of an edge, or would lie on both sides after the edit.
    SameFace,
    /// The edit would create a second edge between two vertices.
    DuplicateEdge,
    /// A vertex does not have enough edges for the edit.
    FewEdges,
    /// A face does not have enough corners for the edit.
    FewCorners,
    /// A face would have the same vertex at two corners.
    RepeatedVertex,
    /// The collapse of an edge would leave no face at the merged vertex, or only two faces that lie back to back.
    Vanishes,
    /// The two ends of an edge cannot be merged: they have a common neighbor that is not a corner of a triangle at the
    /// edge.
    Link,
    /// Both ends of an edge lie on the boundary, but the edge itself does not, so the two ends cannot be merged.
    JoinsBoundaries,
    /// Corner attributes differ between the two sides of an edge, and the edit would lose this difference.
    Seam,
    /// The position along an edge is outside the range that the edit accepts, or an edge is too short for the bevels at
    /// its two ends.
    OutsideEdge,
    /// A coordinate or length is not finite, or is outside its range.
    BadNumber,
    /// The edit would separate the faces around a vertex into several fans. A fan is a group of faces that are
    /// connected by edges at the vertex.
    Pinch,
    /// The given faces are only a part of their connected component, but the edit needs all faces of the component.
    PartOfComponent,
    /// The elements do not have the relation that the edit needs. For example, two vertices are not corners of a common
    /// face, or the same element is given twice.
    WrongPlace,
    /// The step needs an element, a tag, an attribute, a material or a path along edges that does not exist, or no
    /// longer exists.
    Missing,
    /// A step or a selection expects a given number of parts or selected elements, but finds a different number.
    Expectation,
    /// The result would not be manifold.
    NonManifold,
    /// The mesh already has the largest supported number of elements, so the edit cannot add more.
    Full,
    /// The step could not reach its goal, for example a requested number of faces.
    Unreached,
}

impl From<EditError> for Refusal {
    fn from(error: EditError) -> Self {
        match error {
            EditError::NoSuchVertex(_)
            | EditError::NoSuchHalfEdge(_)
            | EditError::NoSuchEdge(_)
            | EditError::NoSuchFace(_) => Self::Missing,
            EditError::Boundary(_) | EditError::BoundaryVertex(_) => Self::Boundary,
            EditError::NotBoundary(_) => Self::NotBoundary,
            EditError::NotTriangle(_) => Self::NotTriangle,
            EditError::SameOpposite(..) => Self::SameOpposite,
            EditError::SameFace(_) => Self::SameFace,
            EditError::DuplicateEdge(..) => Self::DuplicateEdge,
            EditError::FewEdges(_) => Self::FewEdges,
            EditError::FewCorners(_) => Self::FewCorners,
            EditError::RepeatedVertex(_) | EditError::VisitsTwice(..) => Self::RepeatedVertex,
            EditError::Vanishes(_) => Self::Vanishes,
            EditError::Link(..) => Self::Link,
            EditError::JoinsBoundaries(_) => Self::JoinsBoundaries,
            EditError::Seam(_) => Self::Seam,
            EditError::OutsideEdge(_) => Self::OutsideEdge,
            EditError::BadNumber(_) => Self::BadNumber,
            EditError::Pinch(_) => Self::Pinch,
            EditError::PartOfComponent(_) => Self::PartOfComponent,
            EditError::Full => Self::Full,
            EditError::NoCut(..)
            | EditError::SeveralCuts(..)
            | EditError::WrongCorner(_)
            | EditError::Adjacent(..)
            | EditError::EdgeListedTwice(_)
            | EditError::FaceListedTwice(_)
            | EditError::ShortLoop(_)
            | EditError::SameLoop(..)
            | EditError::SelfLoop(_)
            | EditError::NoElements => Self::WrongPlace,
        }
    }
}

/// Why an operation failed. If an operation fails in a run, the scene is restored to its state before the step.
#[derive(Debug, thiserror::Error)]
pub enum OpError {
    /// The run was canceled.
    #[error("cancelled")]
    Cancelled,
    /// An edit or a selection was refused.
    #[error("{message}")]
    Refused {
        /// The reason for the refusal.
        reason: Refusal,
        /// A message that describes the refusal and names the elements.
        message: String,
        /// The elements that caused the refusal, with the ids that they had when the edit was refused.
        elements: Vec<Element>,
        /// The locations of the elements.
        places: Vec<ErrorLocation>,
        /// Whether the operation has the parameter `on_refusal`, so that a recipe can continue after the refusal.
        can_skip: bool,
    },
    /// The value of a parameter does not fit the scene.
    #[error("{0}")]
    Parameter(String),
    /// An object does not exist, exists already, or is of the wrong kind.
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
    /// Creates a refusal with a message and without elements.
    pub fn refused(reason: Refusal, message: impl Into<String>) -> Self {
        Self::Refused {
            reason,
            message: message.into(),
            elements: Vec::new(),
            places: Vec::new(),
            can_skip: false,
        }
    }

    /// If the error is a refusal, records that the operation has the parameter `on_refusal`.
    #[must_use]
    pub fn skippable(mut self) -> Self {
        if let Self::Refused { can_skip, .. } = &mut self {
            *can_skip = true;
        }
        self
    }

    /// Returns advice on what to change in the recipe; `None` if there is no advice for this error.
    pub fn help(&self) -> Option<&'static str> {
        let can_skip = matches!(self, Self::Refused { can_skip: true, .. });
        can_skip.then_some("to continue in such cases, add `on_refusal: Skip`")
    }

    /// Creates the error for a coordinate that is not finite. `parameters` names the parameters of the operation that
    /// determine the coordinate.
    pub fn overflow(operation: &str, parameters: &str) -> Self {
        Self::Parameter(format!(
            "{operation}: with these values of {parameters}, a coordinate exceeds the largest number, 1.8e308"
        ))
    }

    /// Creates the error for an edit that was refused. `edited` contains the elements to which the edit was applied.
    /// The error message names each edge by its two vertices, as recipes do.
    pub fn refused_edit(refusal: EditError, mesh: &Mesh, edited: &[Element]) -> Self {
        let between = |element: Element| {
            let Element::Edge(e) = element else {
                return None;
            };
            mesh.has_edge(e).then(|| {
                let [v, w] = mesh.edge_vertices(e).map(VertexId::index);
                format!("Between({v}, {w})")
            })
        };
        let mut message = refusal.to_string();
        let mut elements = refusal.elements();
        for edge in elements.iter().filter_map(|&named| between(named)) {
            message += &format!("; the edge is {edge}");
        }
        for &element in edited {
            if !elements.contains(&element) {
                let name = between(element).unwrap_or_else(|| element.to_string());
                message += &format!("; at {name}");
                elements.push(element);
            }
        }
        Self::refused(refusal.into(), message).about(elements)
    }

    /// Sets the elements of the error if the error is a refusal.
    #[must_use]
    pub fn about<E: Into<Element>>(mut self, about: impl IntoIterator<Item = E>) -> Self {
        if let Self::Refused { elements, .. } = &mut self {
            *elements = about.into_iter().map(E::into).collect();
        }
        self
    }

    /// Returns the elements that caused a refusal.
    pub fn elements(&self) -> &[Element] {
        match self {
            Self::Refused { elements, .. } => elements,
            _ => &[],
        }
    }

    /// Sets the locations of the elements, if the error is a refusal. `object` is the name of the object that contains
    /// `mesh`.
    #[must_use]
    pub(crate) fn placed(mut self, object: &str, mesh: &Mesh) -> Self {
        if let Self::Refused {
            elements, places, ..
        } = &mut self
        {
            let locations = elements
                .iter()
                .filter_map(|&element| ErrorLocation::of(object, mesh, element));
            *places = locations.take(ErrorLocation::MAX_ELEMENTS).collect();
        }
        self
    }

    /// Returns the locations of the elements that caused a refusal.
    pub fn places(&self) -> &[ErrorLocation] {
        match self {
            Self::Refused { places, .. } => places,
            _ => &[],
        }
    }
}

impl From<EditError> for OpError {
    fn from(error: EditError) -> Self {
        Self::refused(error.into(), error.to_string()).about(error.elements())
    }
}

impl From<Cancelled> for OpError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<MergeError> for OpError {
    fn from(error: MergeError) -> Self {
        match error {
            MergeError::Distance(_) => Self::Parameter(error.to_string()),
            MergeError::Cancelled(cancelled) => cancelled.into(),
            MergeError::Build(error) => error.into(),
        }
    }
}
