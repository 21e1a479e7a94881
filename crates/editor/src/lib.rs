//! The logic of the editor, without user interface: a document, an engine thread, picks that become selections,
//! commands that become text.
//!
//! ```text
//! text --parse--> recipe --run from the first step that is not known--> snapshots --> view
//!   ^                                                                                   |
//!   +---- edits of spans <--- Command(operation, selection) <--- pick, key, drag -------+
//! ```
//!
//! The recipe's text is the only state that an edit changes: an [`Editor`] changes the text, and the engine thread runs
//! the recipe. Undo goes back in the history of texts. The scenes after the steps of recent texts are kept in memory,
//! so that an undo usually runs no step. This crate has no window: a program draws what [`Editor`] returns and forwards
//! input.
//!
//! | task | items |
//! | --- | --- |
//! | the recipe and its file | [`Editor`], [`Document`], [`Outline`] |
//! | the results | [`RunState`], [`StepState`], [`ExpectationState`], [`Snapshot`] |
//! | operations | [`Command`], [`Panel`], [`FieldKind`], [`Part`] |
//! | picking | [`pick`], [`pick_area`], [`keep_visible`], [`Projection`], [`Indexes`], [`Picked`], [`propose`] |
//! | curves and patches | [`control_points`], [`pick_control_point`], [`Editor::move_control_point`] |
//! | half-edges | [`walk`], [`HalfEdgeInfo`], [`Play`] |
//! | recovery after a crash | [`recoverable`], [`Editor::recover`] |
//! | keys | [`Keys`], [`Action`] |

mod curve;
mod document;
mod edit;
mod half_edge;
mod journal;
mod keys;
mod panel;
mod pick;
mod play;
mod run;
mod select;
mod text;

pub use curve::{ControlPoint, control_points, pick_control_point};
pub use document::{Conflict, Document, FileChange, SaveError};
pub use edit::{
    Command, CommandError, Editor, Movement, OpenError, SelectionText, Settings, Update, View,
};
pub use half_edge::{AttributeInfo, HalfEdgeInfo, Walk, of_element, walk};
pub use journal::{Recovery, recoverable};
pub use keys::{Action, Keys, KeysError};
pub use panel::{FieldKind, FieldValue, Limits, Panel, PanelField, Part, Variant};
pub use pick::{
    Area, Hit, Indexes, PICK_RADIUS, PickMode, Projection, keep_visible, pick, pick_area,
};
pub use play::{Play, PlayedEdit, PointerChange, Pointers};
pub use run::{
    ExpectationState, FailureState, Progress, RunState, Snapshot, Status, StepState, Verdict, Wake,
};
pub use select::{Picked, Proposal, propose};
pub use text::{Outline, ParameterText, StepText, TextError};

#[cfg(test)]
mod tests;
