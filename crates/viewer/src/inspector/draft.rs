//! A new step whose parameters are being chosen. The view shows its result.

use editor::{Command, FieldKind, Panel, SelectionText};
use eframe::egui::{Button, Label, RichText, Ui};

use super::{about, known_selection};
use crate::app::Parts;
use crate::field::{self, Change, Field};
use crate::steps_pane::heading;
use crate::theme::Colors;

/// An operation whose parameters are being chosen.
#[derive(Clone, Debug)]
pub(crate) struct Draft {
    panel: Panel,
    previewed: Option<Previewed>,
}

/// Everything that a preview depends on.
#[derive(Clone, Debug, PartialEq)]
struct Previewed {
    /// The version of the text.
    version: u64,
    cursor: usize,
    /// The new steps.
    steps: Vec<String>,
}

impl Draft {
    /// Creates a draft. Required parameters get the value from the example of the operation, except for selections.
    pub(crate) fn new(mut panel: Panel, example: &str) -> Self {
        let parsed = ron_tree::parse(example);
        for field in parsed.value.fields() {
            let value = field.value.span.of(example);
            let is_needed = panel.field(&field.name.text).is_some_and(|field| {
                field.is_missing() && !matches!(field.kind.inner(), FieldKind::Selection(_))
            });
            if is_needed {
                panel.set(&field.name.text, Some(value));
            }
        }
        Self {
            panel,
            previewed: None,
        }
    }

    /// Returns the command of the draft.
    fn command(&self, selection: Option<SelectionText>) -> Command {
        let values = self
            .panel
            .fields
            .iter()
            .filter_map(|field| Some((field.name.clone(), field.value.clone()?)));
        Command {
            operation: self.panel.operation.clone(),
            parameters: values.collect(),
            selection,
            ..Command::default()
        }
    }

    /// Draws the parameters, and applies the changes that the user makes. `selection` describes the picked elements. If
    /// the step uses the picked elements, the parameter that takes them shows `selection`.
    fn fields(&mut self, ui: &mut Ui, selection: Option<&SelectionText>) {
        let picked = selection.and_then(|selection| self.panel.picked_value(selection));
        for i in 0..self.panel.fields.len() {
            let mut of = self.panel.fields[i].clone();
            if let Some((name, value)) = &picked
                && of.name == *name
            {
                of.value = Some(value.clone());
            }
            let field = Field {
                of: &of,
                live: None,
                selection,
                salt: "draft",
            };
            match field::ui(ui, &field) {
                Some(Change::Set(value) | Change::Drag(value)) => {
                    self.panel.set(&of.name, Some(&value));
                }
                // The step sets the parameter to its default value. A parameter that the step does not set would take
                // the picked elements again.
                Some(Change::Reset)
                    if picked.as_ref().is_some_and(|(name, _)| of.name == *name) =>
                {
                    self.panel.set(&of.name, of.default.as_deref());
                }
                Some(Change::Reset) => self.panel.set(&of.name, None),
                None => {}
            }
        }
    }
}

/// Draws the parameters of a new step.
pub(super) fn ui(ui: &mut Ui, parts: &mut Parts) {
    let Some(mut draft) = parts.draft.take() else {
        return;
    };
    let colors = Colors::current(ui);
    let mut closes = false;
    heading(ui, &format!("New step: {}", draft.panel.operation), |ui| {
        closes = ui.small_button("Cancel").clicked();
    });
    about(ui, &draft.panel);
    let selection = known_selection(parts);
    draft.fields(ui, selection.as_ref());
    let command = draft.command(selection);
    let problem = if parts.editor.is_searching() {
        Some("Searching for a short expression that selects the picked elements..".to_owned())
    } else {
        preview(parts, &mut draft, &command)
    };
    if let Some(problem) = &problem {
        let text = RichText::new(problem).size(12.0).color(colors.bad);
        ui.add(Label::new(text).wrap());
    }
    ui.add_space(4.0);
    let apply = Button::new("Apply").fill(colors.accent_fill);
    let applies = ui.add_enabled(problem.is_none(), apply).clicked();
    if applies {
        parts.apply(&command);
    } else if closes {
        parts.editor.end_preview();
    } else {
        parts.draft = Some(draft);
    }
}

/// Shows the scene after the new step, if something has changed since the last preview. Cancels the previous run.
/// Returns the problem of a step that cannot run.
fn preview(parts: &mut Parts, draft: &mut Draft, command: &Command) -> Option<String> {
    let editor = &mut parts.editor;
    let steps = match editor.steps_of(command) {
        Ok(steps) => steps,
        Err(problem) => {
            draft.previewed = None;
            editor.end_preview();
            return Some(problem.to_string());
        }
    };
    let now = Some(Previewed {
        version: editor.document().version(),
        cursor: editor.cursor(),
        steps,
    });
    if draft.previewed == now {
        return None;
    }
    draft.previewed = now;
    editor.preview(command).err().map(|error| error.to_string())
}
