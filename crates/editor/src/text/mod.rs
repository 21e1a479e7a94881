//! Edits of a recipe's text that keep its comments and layout.
//!
//! ```text
//! text --Outline::of--> spans of steps, fields, parameters --insert, remove, set, ..--> edits --apply--> text
//! ```

mod entries;
mod fields;
mod outline;
mod steps;

use ron_tree::Span;

pub use outline::{Outline, ParameterText, StepText};

pub(crate) use fields::{field_value, set_field};
pub(crate) use steps::{
    add_expectations, duplicate_step, insert_steps, move_step, remove_step, set_enabled,
    set_envelope_field, unused_id,
};

/// Edits of a text: each pair has a span and the text that replaces it.
pub(crate) type Edits = Vec<(Span, String)>;

/// Why a text could not be edited.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TextError {
    /// The text has no list `steps`, for example because of a syntax error.
    #[error("the list `steps: [..]` is missing or cannot be read; correct the recipe's text first")]
    NoSteps,
    /// The step does not exist.
    #[error("step {0} does not exist (number of steps: {1})")]
    NoStep(usize, usize),
    /// The parameter does not exist.
    #[error("the recipe has no parameter \"{0}\"")]
    NoParameter(String),
    /// The path does not lead to a place where a value can be written.
    #[error(
        "`{0}` cannot be set in this step: the path leads to a value without fields, or to a list item that does not \
         exist"
    )]
    NoPlace(String),
    /// The edits do not fit the text.
    #[error(transparent)]
    Overlap(#[from] ron_tree::EditOverlap),
}

/// Returns the text with the edits applied.
///
/// # Errors
///
/// Returns [`TextError::Overlap`] if the edits overlap or are out of range.
pub(crate) fn apply(text: &str, edits: Edits) -> Result<String, TextError> {
    Ok(ron_tree::replace(text, edits)?)
}
