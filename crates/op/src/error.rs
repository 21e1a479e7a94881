//! Why an operation failed.

use geometry::MergeError;
use mesh::{BuildError, EditError, Element, Mesh, VertexId};
use progress::Cancelled;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ErrorLocation;

/// The reasons for which an edit or a selection is refused, as recipes name them in `refused:`.
#[derive(
    Clone, Copy, Debug, Deserialize, Eq, JsonSchema, Ord, PartialEq, PartialOrd, Serialize,
)]
#[serde(deny_unknown_fields)]
pub enum Refusal {
    /// An edge is on the boundary and the edit needs a face on both sides.
    Boundary,
    /// An edge has a face on both sides and the edit needs one of the boundary.
    NotBoundary,
    /// The edit is for triangles only.
    NotTriangle,
    /// Both triangles at an edge have the same opposite vertex.
    SameOpposite,
    /// One face lies on both sides of an edge.
    SameFace,
    /// Two vertices would get a second edge between them.
    DuplicateEdge,
    /// A vertex has too few edges.
    FewEdges,
    /// A face has too few corners.
    FewCorners,
    /// A face would have a vertex as a corner twice.
    RepeatedVertex,
    /// Nothing would be left of the faces around an edge.
    Vanishes,
    /// The ends of an edge have a neighbour in common outside the faces beside it, so that they cannot
    /// become one.
    Link,
    /// An edge inside the surface joins two places of the boundary, so that its ends cannot become one.
    JoinsBoundaries,
    /// Corner attributes differ between the two sides of an edge.
    Seam,
    /// A place on an edge is not strictly between its ends.
    OutsideEdge,
    /// A coordinate or length is not finite or out of its range.
    BadNumber,
    /// The faces around a vertex would fall into two fans.
    Pinch,
    /// The faces are only a part of their component.
    PartOfComponent,
    /// Elements do not lie to each other as the edit needs it: a path with a gap, corners of two faces,
    /// one element named twice, or none.
    WrongPlace,
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
            | EditError::Elsewhere(_)
            | EditError::Adjacent(..)
            | EditError::NoPath(_)
            | EditError::Twice(_)
            | EditError::TwiceFace(_)
            | EditError::ShortLoop(_)
            | EditError::SameLoop(..)
            | EditError::SelfLoop(_)
            | EditError::Nothing => Self::WrongPlace,
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
        /// The elements that it is about, of the mesh as it was then.
        elements: Vec<Element>,
        /// Where they were.
        places: Vec<ErrorLocation>,
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
            elements: Vec::new(),
            places: Vec::new(),
        }
    }

    /// The refusal of an edit of a mesh that was to be done to `edited`. Edges are told as recipes name them,
    /// by their vertices.
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
            message += &format!("; it is {edge}");
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

    /// The same error about these elements, if it is a refusal.
    #[must_use]
    pub fn about<E: Into<Element>>(mut self, about: impl IntoIterator<Item = E>) -> Self {
        if let Self::Refused { elements, .. } = &mut self {
            *elements = about.into_iter().map(E::into).collect();
        }
        self
    }

    /// The elements that a refusal is about.
    pub fn elements(&self) -> &[Element] {
        match self {
            Self::Refused { elements, .. } => elements,
            _ => &[],
        }
    }

    /// The same error with the places of its elements in an object.
    #[must_use]
    pub(crate) fn placed(mut self, object: &str, mesh: &Mesh) -> Self {
        if let Self::Refused {
            elements, places, ..
        } = &mut self
        {
            let found = elements.iter();
            let found = found.filter_map(|&element| ErrorLocation::of(object, mesh, element));
            *places = found.take(ErrorLocation::MOST).collect();
        }
        self
    }

    /// Where the elements are that a refusal is about.
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
