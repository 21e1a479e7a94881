//! The logic of the editor, without its user interface. An editor has a document, which is the text of a recipe, and a
//! thread that runs this recipe. The editor describes picked elements by selections: expressions such as
//! `Sharp(above: 30)`. The editor writes the commands of the user into the text as steps.
//!
//! ```text
//! text --parse--> recipe --run from the first step that is not known--> snapshots --> view
//!   ^                                                                                   |
//!   +---- edits of spans <--- Command(operation, selection) <--- pick, key, drag -------+
//! ```
//!
//! The recipe's text is the only state that an edit changes. An [`Editor`] changes the text, and a separate thread runs
//! the recipe. To undo a change, the editor goes back to an earlier text in its history of texts. For recent texts, the
//! editor keeps the scenes after the steps in memory. Therefore, usually no step has to run when a change is undone.
//! This crate opens no window. A program that uses this crate draws the scenes that [`Editor`] returns, and passes the
//! input of the user to the editor.
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
    Command, CommandError, Editor, Movement, OpenError, PickError, SelectionText, Settings, Update,
    View,
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
