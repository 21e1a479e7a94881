//! The panel at the right: the picked elements, the parameters of a step, and the parameters of the recipe.

mod draft;
mod picked;
mod pictures;

use editor::{FieldKind, Panel, SelectionText};
use eframe::egui::{self, Button, CollapsingHeader, Label, Margin, RichText, ScrollArea, Ui};
use recipe::Param;

use crate::app::Parts;
use crate::field::{self, Change, Field};
use crate::player;
use crate::theme::Colors;
use crate::widgets::{counts, grouped};
pub(crate) use draft::Draft;

pub(crate) fn ui(ui: &mut Ui, parts: &mut Parts) {
    egui::Frame::new()
        .inner_margin(Margin::symmetric(10, 7))
        .show(ui, |ui| {
            ScrollArea::vertical()
                .auto_shrink([false, false])
                .show(ui, |ui| {
                    if parts.draft.is_some() {
                        draft::ui(ui, parts);
                        ui.add_space(12.0);
                    }
                    player::ui(ui, parts);
                    section(ui, "picked", "Picked", |ui| picked::picked(ui, parts));
                    let title = step_title(parts);
                    section(ui, "step", &title, |ui| step(ui, parts));
                    if !parts.editor.outline().parameters.is_empty() {
                        section(ui, "parameters", "Parameters of the recipe", |ui| {
                            recipe_parameters(ui, parts);
                        });
                    }
                    picked::half_edge(ui, parts);
                    if parts.shows_information {
                        section(ui, "scene", "Scene", |ui| information(ui, parts));
                    }
                });
        });
}

/// Draws a collapsible part of the panel. `name` identifies the part, because the title of a part can change.
fn section(ui: &mut Ui, name: &str, title: &str, contents: impl FnOnce(&mut Ui)) {
    let color = Colors::current(ui).text;
    CollapsingHeader::new(RichText::new(title).strong().size(13.0).color(color))
        .id_salt(name)
        .default_open(true)
        .show_unindented(ui, |ui| {
            contents(ui);
            ui.add_space(8.0);
        });
    ui.separator();
}

/// Returns the title of the step at the cursor.
fn step_title(parts: &Parts) -> String {
    let steps = &parts.editor.outline().steps;
    let at = parts.editor.cursor().checked_sub(1);
    match at.and_then(|at| Some((at, steps.get(at)?))) {
        Some((at, step)) if !step.name.is_empty() => format!("{} (step {})", step.name, at + 1),
        _ => "Step".to_owned(),
    }
}

/// Returns the selection that describes the picked elements. `None` while the search for this selection is in progress.
fn known_selection(parts: &mut Parts) -> Option<SelectionText> {
    let is_known = !parts.editor.is_searching();
    is_known.then(|| parts.editor.selection()).flatten()
}

/// Draws the description of an operation: in one line or, after a click, in full.
fn about(ui: &mut Ui, panel: &Panel) {
    weak(ui, &panel.summary);
    let title = RichText::new("About this operation").size(12.0);
    CollapsingHeader::new(title)
        .id_salt(("about", &panel.operation))
        .show(ui, |ui| {
            pictures::ui(ui, &panel.operation);
            weak(ui, &panel.doc);
            let example = RichText::new(&panel.example).monospace().size(11.5);
            ui.add(Label::new(example).wrap());
        });
}

fn weak(ui: &mut Ui, text: &str) {
    let color = Colors::current(ui).weak;
    ui.add(Label::new(RichText::new(text).size(12.0).color(color)).wrap());
}

/// Draws the parameters of the step at the cursor.
fn step(ui: &mut Ui, parts: &mut Parts) {
    let Some(step) = parts.editor.cursor().checked_sub(1) else {
        weak(
            ui,
            "The cursor is before the first step. Click a step at the left.",
        );
        return;
    };
    let Some(panel) = parts.editor.panel(step) else {
        weak(
            ui,
            "The operation of this step is unknown. Correct its name in the recipe.",
        );
        return;
    };
    let colors = Colors::current(ui);
    about(ui, &panel);
    let play = Button::new("Play the edits").small();
    if parts.editor.has_edits(step)
        && parts.player.is_none()
        && ui
            .add(play)
            .on_hover_text(
                "Shows the edits of this step one by one, with the half-edge pointers that each edit changes",
            )
            .clicked()
    {
        parts.play(step);
    }
    let problems = panel.problems();
    let selection = known_selection(parts);
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

/// Draws the parameters of the recipe as sliders.
fn recipe_parameters(ui: &mut Ui, parts: &mut Parts) {
    let parameters = parts.editor.outline().parameters.clone();
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
}

/// Converts a parameter of the recipe to a field of a panel, so that the field's widget can show the parameter.
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

/// Draws information about the objects of the scene.
fn information(ui: &mut Ui, parts: &Parts) {
    let colors = Colors::current(ui);
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
