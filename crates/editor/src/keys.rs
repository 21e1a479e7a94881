//! Actions and their keys. A file can change the keys.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Something that a key does.
#[derive(Clone, Copy, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Action {
    /// Walk to the next half-edge of the face.
    Next,
    /// Walk to the other half-edge of the same edge.
    Twin,
    /// Walk to the previous half-edge of the face.
    Previous,
    /// Walk to the next half-edge around the vertex.
    AroundVertex,
    /// Flip the picked edges.
    Flip,
    /// Split the picked edges.
    Split,
    /// Collapse the picked edges.
    Collapse,
    /// Extrude the picked faces.
    Extrude,
    /// Dissolve the picked vertices or edges.
    Dissolve,
    /// Tag the picked elements.
    Tag,
    /// Show or hide arrows that move the picked elements.
    Move,
    /// Show or hide rings that rotate the picked elements.
    Rotate,
    /// Show or hide handles that scale the picked elements.
    Scale,
    /// Apply one level of Loop subdivision.
    Loop,
    /// Apply one level of Catmull-Clark subdivision.
    CatmullClark,
    /// Show or hide the wireframe.
    Wireframe,
    /// Switch between smooth and flat shading.
    Smooth,
    /// Show or hide information about the scene.
    Information,
    /// Show or hide the help.
    Help,
    /// Reset the view.
    ResetView,
    /// Fit the view to the picked elements or, if nothing is picked, to the scene.
    Fit,
    /// Open the list of all operations.
    Palette,
    /// Undo the last change of the recipe.
    Undo,
    /// Redo the change that was undone last.
    Redo,
    /// Save the recipe.
    Save,
    /// Save the recipe under a new name.
    SaveAs,
    /// Open a file.
    Open,
    /// Start a new recipe.
    New,
    /// Close the window.
    Quit,
    /// Close the help, the list of operations, the dialog or the new step that is open. If none of them is open, cancel
    /// the run. If no run is in progress either, unpick all elements.
    Cancel,
    /// Show the next selection expression, such as `Sharp(above: 30)`, that describes the picked elements.
    NextProposal,
    /// Also pick the neighbors of the picked elements.
    Grow,
    /// Unpick the picked elements that have an unpicked neighbor.
    Shrink,
    /// Pick the edge loop through the picked edges.
    EdgeLoop,
    /// Pick the edge ring through the picked edges.
    EdgeRing,
    /// Pick the shortest path between two picked vertices.
    Path,
    /// Pick the faces around the picked faces, up to sharp edges.
    ByAngle,
    /// Pick all elements.
    SelectAll,
    /// Pick nothing.
    SelectNone,
    /// Pick vertices.
    PickVertices,
    /// Pick edges.
    PickEdges,
    /// Pick faces.
    PickFaces,
    /// Pick half-edges.
    PickHalfEdges,
    /// Move the step cursor back by one step.
    StepBack,
    /// Move the step cursor forward by one step.
    StepForward,
    /// Delete the step at the cursor.
    DeleteStep,
    /// Enable or disable the step at the cursor.
    ToggleStep,
    /// Duplicate the step at the cursor.
    DuplicateStep,
}

impl Action {
    /// Returns the description of the action, which the help shows.
    pub fn doc(self) -> &'static str {
        let found = rows().find(|row| row.0 == self);
        found.map_or("", |row| row.2)
    }

    /// All actions, in the order of the help.
    pub fn all() -> impl Iterator<Item = Self> {
        rows().map(|row| row.0)
    }

    /// Returns all actions, grouped by task. Each group is a pair: the name of a task, and the actions for this task.
    pub fn groups() -> impl Iterator<Item = (&'static str, impl Iterator<Item = Self>)> {
        GROUPS
            .iter()
            .map(|(name, rows)| (*name, rows.iter().map(|row| row.0)))
    }
}

/// An action, its default keys, and what it does.
type Row = (Action, &'static [&'static str], &'static str);

/// All actions, grouped by task.
const GROUPS: &[(&str, &[Row])] = &[
    (
        "Edit",
        &[
            (Action::Flip, &["F"], "flip the picked edges"),
            (Action::Split, &["S"], "split the picked edges"),
            (Action::Collapse, &["C"], "collapse the picked edges"),
            (Action::Extrude, &["E"], "extrude the picked faces"),
            (
                Action::Dissolve,
                &["D"],
                "dissolve the picked vertices or edges",
            ),
            (Action::Tag, &["M"], "tag the picked elements"),
            (Action::Loop, &["L"], "one level of Loop subdivision"),
            (
                Action::CatmullClark,
                &["K"],
                "one level of Catmull-Clark subdivision",
            ),
            (Action::Palette, &["Ctrl+K"], "search all operations"),
        ],
    ),
    (
        "Move",
        &[
            (
                Action::Move,
                &["G"],
                "show or hide arrows that move the picked elements",
            ),
            (
                Action::Rotate,
                &["Shift+R"],
                "show or hide rings that rotate the picked elements",
            ),
            (
                Action::Scale,
                &["Shift+S"],
                "show or hide handles that scale the picked elements",
            ),
        ],
    ),
    (
        "Pick",
        &[
            (Action::PickVertices, &["Alt+1"], "pick vertices"),
            (Action::PickEdges, &["Alt+2"], "pick edges"),
            (Action::PickFaces, &["Alt+3"], "pick faces"),
            (Action::PickHalfEdges, &["Alt+4"], "pick half-edges"),
            (
                Action::Grow,
                &["Plus"],
                "also pick the neighbors of the picked elements",
            ),
            (
                Action::Shrink,
                &["Minus"],
                "unpick the picked elements that have an unpicked neighbor",
            ),
            (
                Action::EdgeLoop,
                &["O"],
                "pick the edge loop through the picked edges",
            ),
            (
                Action::EdgeRing,
                &["R"],
                "pick the edge ring through the picked edges",
            ),
            (
                Action::Path,
                &["Shift+P"],
                "pick the shortest path between two picked vertices",
            ),
            (
                Action::ByAngle,
                &["Shift+F"],
                "pick the faces around the picked faces, up to sharp edges",
            ),
            (Action::SelectAll, &["Ctrl+A"], "pick all elements"),
            (Action::SelectNone, &["Ctrl+Shift+A"], "pick nothing"),
            (
                Action::NextProposal,
                &["A"],
                "show another recipe expression that selects the picked elements",
            ),
        ],
    ),
    (
        "Walk over half-edges",
        &[
            (
                Action::Next,
                &["N"],
                "walk to the next half-edge of the face",
            ),
            (Action::Twin, &["T"], "walk to the other half of the edge"),
            (
                Action::Previous,
                &["P"],
                "walk to the previous half-edge of the face",
            ),
            (
                Action::AroundVertex,
                &["V"],
                "walk to the next half-edge around the vertex",
            ),
        ],
    ),
    (
        "Look",
        &[
            (Action::Wireframe, &["W"], "show or hide the wireframe"),
            (
                Action::Smooth,
                &["Q"],
                "switch between smooth and flat shading",
            ),
            (Action::ResetView, &["Space"], "reset the view"),
            (
                Action::Fit,
                &["Home"],
                "fit the view to the picked elements, or to the whole scene if nothing is picked",
            ),
            (
                Action::Information,
                &["I"],
                "show or hide information about the scene",
            ),
        ],
    ),
    (
        "Steps",
        &[
            (
                Action::StepBack,
                &["Alt+Up"],
                "move the step cursor back by one step",
            ),
            (
                Action::StepForward,
                &["Alt+Down"],
                "move the step cursor forward by one step",
            ),
            (
                Action::DuplicateStep,
                &["Ctrl+D"],
                "duplicate the step at the cursor",
            ),
            (
                Action::ToggleStep,
                &["Ctrl+E"],
                "enable or disable the step at the cursor",
            ),
            (
                Action::DeleteStep,
                &["Ctrl+Delete"],
                "delete the step at the cursor",
            ),
        ],
    ),
    (
        "Recipe and window",
        &[
            (Action::Undo, &["Ctrl+Z"], "undo"),
            (Action::Redo, &["Ctrl+Shift+Z", "Ctrl+Y"], "redo"),
            (Action::New, &["Ctrl+N"], "start a new recipe"),
            (Action::Open, &["Ctrl+O"], "open a file"),
            (Action::Save, &["Ctrl+S"], "save the recipe"),
            (
                Action::SaveAs,
                &["Ctrl+Shift+S"],
                "save the recipe under a new name",
            ),
            (Action::Quit, &["Ctrl+Q"], "close the window"),
            (
                Action::Cancel,
                &["Escape"],
                "close the open dialog or panel, or cancel the run",
            ),
            (Action::Help, &["H", "F1"], "show or hide this help"),
        ],
    ),
];

/// Returns all rows of the table.
fn rows() -> impl Iterator<Item = &'static Row> {
    GROUPS.iter().flat_map(|(_, rows)| *rows)
}

/// The keys of all actions. A key is written as the names of its modifiers and the name of the key, such as `N`,
/// `Ctrl+Shift+Z` or `Alt+Up`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keys {
    of_action: BTreeMap<Action, Vec<String>>,
}

impl Default for Keys {
    fn default() -> Self {
        let row = |row: &Row| (row.0, row.1.iter().map(|key| normal(key)).collect());
        Self {
            of_action: rows().map(row).collect(),
        }
    }
}

/// Why the keys in a file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KeysError {
    /// The text is not a map from actions to lists of keys.
    #[error("line {line}, column {column}: {message}")]
    Text {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// The reason.
        message: String,
    },
    /// Two actions have the same key.
    #[error("the key {0} is assigned to two actions: {1:?} and {2:?}")]
    Twice(String, Action, Action),
}

impl Keys {
    /// Reads changes of the default keys from RON: `{ Flip: ["Ctrl+F"], Split: [] }`. An action that the text does not
    /// name keeps its keys, unless the text gives them to another action.
    ///
    /// # Errors
    ///
    /// Returns [`KeysError`] if the text is not a map from actions to lists of keys, or if it gives the same key to two
    /// actions.
    pub fn read(text: &str) -> Result<Self, KeysError> {
        let changes: BTreeMap<Action, Vec<String>> = ron_tree::from_str(text).map_err(|error| {
            let place = error.span.unwrap_or_default().start;
            let (line, column) = ron_tree::LineIndex::new(text).position(place);
            KeysError::Text {
                line,
                column,
                message: error.message,
            }
        })?;
        let mut keys = Self::default();
        let mut taken: Vec<(String, Action)> = Vec::new();
        for (action, list) in &changes {
            for key in list.iter().map(|key| normal(key)) {
                if let Some((_, other)) = taken.iter().find(|(known, _)| *known == key) {
                    return Err(KeysError::Twice(key, *other, *action));
                }
                taken.push((key, *action));
            }
        }
        for list in keys.of_action.values_mut() {
            list.retain(|key| taken.iter().all(|(other, _)| other != key));
        }
        for (action, list) in changes {
            keys.of_action
                .insert(action, list.iter().map(|key| normal(key)).collect());
        }
        Ok(keys)
    }

    /// Returns the keys of an action.
    pub fn of(&self, action: Action) -> &[String] {
        self.of_action.get(&action).map_or(&[], Vec::as_slice)
    }

    /// Returns the action that a key, such as `Ctrl+Shift+Z`, starts. The order and the case of the modifiers do not
    /// matter.
    pub fn action(&self, key: &str) -> Option<Action> {
        let key = normal(key);
        let mut all = self.of_action.iter();
        all.find(|(_, keys)| keys.contains(&key))
            .map(|(action, _)| *action)
    }
}

/// Sorts the modifiers of a key by the order Ctrl, Alt, Shift. Makes the first letter of the key's name upper case.
fn normal(key: &str) -> String {
    let mut parts: Vec<&str> = key.split('+').map(str::trim).collect();
    let name = parts.pop().unwrap_or_default();
    let mut text = String::new();
    for modifier in ["Ctrl", "Alt", "Shift"] {
        if parts.iter().any(|part| part.eq_ignore_ascii_case(modifier)) {
            text += modifier;
            text += "+";
        }
    }
    let mut letters = name.chars();
    if let Some(first) = letters.next() {
        text.extend(first.to_uppercase());
        text += letters.as_str();
    }
    text
}
