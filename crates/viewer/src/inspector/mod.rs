//! The panel at the right: the picked elements, the parameters of a step, and the parameters of the recipe.

mod picked;

use editor::{Command, FieldKind, Panel, SelectionText};
use eframe::egui::{self, Align, Button, Label, Layout, Margin, RichText, ScrollArea, Ui};
use recipe::Param;

use crate::app::Parts;
use crate::field::{self, Change, Field};
use crate::player;
use crate::steps_pane::heading;
use crate::theme::Colors;
use crate::widgets::{counts, grouped};

/// An operation whose parameters are being chosen.
#[derive(Clone, Debug)]
pub(crate) struct Draft {
    panel: Panel,
}

impl Draft {
    /// Creates a draft. Parameters that are required get the value of the example, except for selections.
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
        Self { panel }
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
}

pub(crate) fn ui(ui: &mut Ui, parts: &mut Parts) {
    egui::Frame::new()
        .inner_margin(Margin::symmetric(10, 7))
        .show(ui, |ui| {
            ScrollArea::vertical()
                .auto_shrink([false, false])
                .show(ui, |ui| {
                    if parts.draft.is_some() {
                        draft(ui, parts);
                        ui.add_space(12.0);
                    }
                    player::ui(ui, parts);
                    picked::picked(ui, parts);
                    ui.add_space(12.0);
                    recipe_parameters(ui, parts);
                    step(ui, parts);
                    if parts.shows_information {
                        ui.add_space(12.0);
                        information(ui, parts);
                    }
                });
        });
}

fn weak(ui: &mut Ui, text: &str) {
    let color = Colors::current(ui).weak;
    ui.add(Label::new(RichText::new(text).size(12.0).color(color)).wrap());
}

/// The parameters of a new step.
fn draft(ui: &mut Ui, parts: &mut Parts) {
    let Some(mut draft) = parts.draft.take() else {
        return;
    };
    let colors = Colors::current(ui);
    let mut closes = false;
    heading(ui, &format!("New step: {}", draft.panel.operation), |ui| {
        closes = ui.small_button("Cancel").clicked();
    });
    weak(ui, &draft.panel.summary.clone());
    let selection = parts.editor.selection();
    for i in 0..draft.panel.fields.len() {
        let of = draft.panel.fields[i].clone();
        let change = field::ui(
            ui,
            &Field {
                of: &of,
                live: None,
                selection: selection.as_ref(),
                salt: "draft",
            },
        );
        match change {
            Some(Change::Set(value) | Change::Drag(value)) => {
                draft.panel.set(&of.name, Some(&value));
            }
            Some(Change::Reset) => draft.panel.set(&of.name, None),
            None => {}
        }
    }
    let command = draft.command(selection);
    let problem = parts.editor.steps_of(&command).err();
    if let Some(problem) = &problem {
        ui.add(
            Label::new(
                RichText::new(problem.to_string())
                    .size(12.0)
                    .color(colors.bad),
            )
            .wrap(),
        );
    }
    ui.add_space(4.0);
    let mut applies = false;
    ui.horizontal(|ui| {
        let apply = Button::new("Apply").fill(colors.accent_fill);
        applies = ui.add_enabled(problem.is_none(), apply).clicked();
        if ui
            .add_enabled(problem.is_none(), Button::new("Preview"))
            .clicked()
            && let Err(error) = parts.editor.preview(&command)
        {
            parts.warn(error.to_string());
        }
    });
    if applies {
        parts.apply(&command);
    } else if closes {
        parts.editor.end_preview();
    } else {
        parts.draft = Some(draft);
    }
}

/// The parameters of the step at the cursor.
fn step(ui: &mut Ui, parts: &mut Parts) {
    let Some(step) = parts.editor.cursor().checked_sub(1) else {
        heading(ui, "Step", |_| {});
        weak(
            ui,
            "The cursor is before the first step. Click a step at the left.",
        );
        return;
    };
    let Some(panel) = parts.editor.panel(step) else {
        heading(ui, "Step", |_| {});
        weak(
            ui,
            "The operation of this step is unknown. Correct its name in the recipe.",
        );
        return;
    };
    let colors = Colors::current(ui);
    heading(ui, &panel.operation, |ui| {
        ui.label(
            RichText::new(format!("step {}", step + 1))
                .small()
                .color(colors.weak),
        );
    });
    weak(ui, &panel.summary);
    let play = Button::new("Play the edits").small();
    if parts.editor.has_edits(step)
        && parts.player.is_none()
        && ui
            .add(play)
            .on_hover_text(
                "Shows the edits of this step one by one, with the pointers that they change",
            )
            .clicked()
    {
        parts.play(step);
    }
    let problems = panel.problems();
    let selection = parts.editor.selection();
    for of in &panel.fields {
        let live = parts
            .dragged
            .as_ref()
            .filter(|(at, name, _)| *at == Some(step) && *name == of.name)
            .map(|(_, _, value)| value.clone());
        let salt = format!("step {step}");
        let change = field::ui(
            ui,
            &Field {
                of,
                live: live.as_deref(),
                selection: selection.as_ref(),
                salt: &salt,
            },
        );
        for (_, problem) in problems.iter().filter(|(name, _)| *name == of.name) {
            ui.add(Label::new(RichText::new(&problem.message).size(11.5).color(colors.bad)).wrap());
        }
        let result = match change {
            None => continue,
            Some(Change::Drag(value)) => {
                let result = parts.editor.preview_parameter(step, &[&of.name], &value);
                parts.dragged = Some((Some(step), of.name.clone(), value));
                result
            }
            Some(Change::Set(value)) => {
                parts.dragged = None;
                parts.editor.set_parameter(step, &[&of.name], Some(&value))
            }
            Some(Change::Reset) => parts.editor.set_parameter(step, &[&of.name], None),
        };
        parts.report(result);
    }
    if panel.fields.is_empty() {
        weak(ui, "This operation has no parameters.");
    }
}

/// The parameters of the recipe as sliders.
fn recipe_parameters(ui: &mut Ui, parts: &mut Parts) {
    let parameters = parts.editor.outline().parameters.clone();
    if parameters.is_empty() {
        return;
    }
    heading(ui, "Parameters of the recipe", |_| {});
    for parameter in &parameters {
        let Some((of, param)) = parameter.default.zip(parameter.param.as_ref()) else {
            continue;
        };
        let text = of.of(parts.editor.text()).to_owned();
        let field = panel_field(&parameter.name, param, text);
        let live = parts
            .dragged
            .as_ref()
            .filter(|(at, name, _)| at.is_none() && *name == parameter.name)
            .map(|(_, _, value)| value.clone());
        let change = field::ui(
            ui,
            &Field {
                of: &field,
                live: live.as_deref(),
                selection: None,
                salt: "recipe",
            },
        );
        let result = match change {
            None | Some(Change::Reset) => continue,
            Some(Change::Drag(value)) => {
                let result = parts
                    .editor
                    .preview_recipe_parameter(&parameter.name, &value);
                parts.dragged = Some((None, parameter.name.clone(), value));
                result
            }
            Some(Change::Set(value)) => {
                parts.dragged = None;
                parts.editor.set_recipe_parameter(&parameter.name, &value)
            }
        };
        parts.report(result);
    }
    ui.add_space(12.0);
}

/// Returns a parameter of the recipe in the form of a parameter of an operation.
fn panel_field(name: &str, param: &Param, value: String) -> editor::PanelField {
    let limits = |min: Option<f64>, max: Option<f64>| editor::Limits {
        min,
        max,
        ..editor::Limits::default()
    };
    let (kind, doc) = match param {
        Param::Int { min, max, doc, .. } => (
            FieldKind::Integer(limits(min.map(|n| n as f64), max.map(|n| n as f64))),
            doc,
        ),
        Param::Float { min, max, doc, .. } => (FieldKind::Number(limits(*min, *max)), doc),
        Param::Bool { doc, .. } => (FieldKind::Bool, doc),
        Param::Text { doc, .. } | Param::Path { doc, .. } => (FieldKind::Text, doc),
        _ => (FieldKind::Other, &None),
    };
    editor::PanelField {
        name: name.to_owned(),
        doc: doc.clone().unwrap_or_default(),
        kind,
        type_name: String::new(),
        variants: Vec::new(),
        default: None,
        value: Some(value),
        argument: None,
    }
}

/// The objects of the scene.
fn information(ui: &mut Ui, parts: &Parts) {
    let colors = Colors::current(ui);
    heading(ui, "Scene", |ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |_| {});
    });
    let scene = parts.editor.view().scene;
    for object in scene.objects() {
        ui.label(RichText::new(&object.name).strong().size(12.5));
        match object.as_mesh() {
            Some(mesh) => {
                let text = format!(
                    "{} vertices, {} edges, {} faces\nEuler characteristic {}, {} boundary loops\n{} bytes",
                    grouped(mesh.n_vertices()),
                    grouped(mesh.n_edges()),
                    grouped(mesh.n_faces()),
                    mesh.euler_characteristic(),
                    mesh.n_boundary_loops(),
                    grouped(mesh.bytes()),
                );
                weak(ui, &text);
            }
            None => weak(ui, object.geometry.kind()),
        }
    }
    let [v, e, f] = counts(&scene);
    ui.label(
        RichText::new(format!(
            "Together: V {} - E {} + F {}",
            grouped(v),
            grouped(e),
            grouped(f)
        ))
        .size(12.0)
        .color(colors.weak),
    );
}
