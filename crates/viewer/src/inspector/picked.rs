//! The picked elements, and the half-edge with its neighbors.

use std::time::Duration;

use editor::{Action, HalfEdgeInfo};
use eframe::egui::{Button, Grid, Id, RichText, Ui};

use super::{section, weak};
use crate::app::Parts;
use crate::field;
use crate::theme::Colors;

/// The picked elements.
pub(super) fn picked(ui: &mut Ui, parts: &mut Parts) {
    let Some(picked) = parts.editor.picked().cloned() else {
        nothing_picked(ui, parts);
        return;
    };
    let colors = Colors::current(ui);
    ui.label(RichText::new(parts.description()).color(colors.picked));
    selection(ui, parts);
    let ctx = ui.ctx().clone();
    ui.horizontal_wrapped(|ui| {
        let actions: &[(&str, Action)] = match picked.elements {
            op::Selected::Edges(_) => &[
                ("Flip", Action::Flip),
                ("Split", Action::Split),
                ("Collapse", Action::Collapse),
                ("Dissolve", Action::Dissolve),
                ("Tag", Action::Tag),
                ("Move", Action::Move),
                ("Rotate", Action::Rotate),
                ("Scale", Action::Scale),
                ("Loop", Action::EdgeLoop),
                ("Ring", Action::EdgeRing),
            ],
            op::Selected::Vertices(_) => &[
                ("Dissolve", Action::Dissolve),
                ("Tag", Action::Tag),
                ("Move", Action::Move),
                ("Rotate", Action::Rotate),
                ("Scale", Action::Scale),
                ("Grow", Action::Grow),
            ],
            op::Selected::Faces(_) => &[
                ("Extrude", Action::Extrude),
                ("Tag", Action::Tag),
                ("Move", Action::Move),
                ("Rotate", Action::Rotate),
                ("Scale", Action::Scale),
                ("Grow", Action::Grow),
                ("Shrink", Action::Shrink),
            ],
        };
        for &(name, action) in actions {
            let key = parts.editor_key(action);
            if ui
                .button(name)
                .on_hover_text(format!("{} ({key})", action.doc()))
                .clicked()
            {
                parts.act(action, &ctx);
            }
        }
    });
}

/// Explains how to pick elements or, if the scene has only patches, how to turn them into a mesh whose elements can be
/// picked.
fn nothing_picked(ui: &mut Ui, parts: &mut Parts) {
    let scene = parts.editor.view().scene;
    let has_mesh = scene
        .objects()
        .iter()
        .any(|object| object.as_mesh().is_some());
    if has_mesh || parts.editor.patches().is_empty() {
        weak(
            ui,
            "Click a vertex, an edge or a face in the view. Shift+drag picks the elements in a box, and a double click \
             picks an edge loop.",
        );
        if has_mesh {
            weak(ui, "Or write a selection:");
            selection(ui, parts);
        }
        return;
    }
    weak(
        ui,
        "Bezier patches have no vertices, edges or faces to pick. Drag their control points, or turn them into a mesh.",
    );
    if ui
        .button("Turn into a mesh")
        .on_hover_text("Adds the steps Tessellate and Weld")
        .clicked()
    {
        let result = parts.editor.turn_into_mesh();
        parts.report(result);
    }
}

/// Draws the selection that the next step uses. The user can edit this selection.
fn selection(ui: &mut Ui, parts: &mut Parts) {
    if parts.editor.is_searching() {
        weak(
            ui,
            "Searching for a short expression that selects these elements..",
        );
        ui.ctx().request_repaint_after(Duration::from_millis(50));
        return;
    }
    let text = parts
        .editor
        .proposal()
        .map(|proposal| proposal.text.clone());
    let text = text.unwrap_or_default();
    let new = field::line(
        ui,
        "Selection",
        &text,
        "Sharp(above: 30)",
        Id::unique("selection"),
    );
    if let Some(new) = new.filter(|new| !new.trim().is_empty()) {
        parts.pick_text(&new);
    }
    if !text.is_empty() && parts.editor.may_have_other_proposal() {
        let key = parts.editor_key(Action::NextProposal);
        let other = ui.small_button("Other selection");
        if other
            .on_hover_text(format!(
                "Another expression that selects the same elements ({key})"
            ))
            .clicked()
        {
            parts.editor.next_proposal();
        }
    }
}

/// If an edge is picked, draws the half-edge of this edge, and the neighbors of the half-edge.
pub(super) fn half_edge(ui: &mut Ui, parts: &mut Parts) {
    let picked = parts.editor.picked().and_then(|picked| picked.half_edge);
    let info = picked.zip(parts.picked_mesh());
    if let Some(info) = info.and_then(|(h, mesh)| HalfEdgeInfo::of(&mesh, h)) {
        section(ui, "half-edge", "Half-edge", |ui| {
            half_edge_table(ui, parts, &info);
        });
    }
}

fn half_edge_table(ui: &mut Ui, parts: &mut Parts, info: &HalfEdgeInfo) {
    let colors = Colors::current(ui);
    let ctx = ui.ctx().clone();
    Grid::new("half-edge")
        .num_columns(3)
        .spacing([14.0, 3.0])
        .show(ui, |ui| {
            let mut row = |name: &str, value: String, walk: Option<(Action, &str)>| {
                ui.label(RichText::new(name).size(12.0).color(colors.weak));
                ui.label(RichText::new(value).monospace().size(12.0));
                if let Some((action, key)) = walk
                    && ui
                        .add(Button::new(RichText::new(key).monospace().size(11.0)).small())
                        .on_hover_text(action.doc())
                        .clicked()
                {
                    parts.act(action, &ctx);
                }
                ui.end_row();
            };
            row("id", info.id.index().to_string(), None);
            row(
                "next",
                info.next.index().to_string(),
                Some((Action::Next, "N")),
            );
            row(
                "twin",
                info.twin.index().to_string(),
                Some((Action::Twin, "T")),
            );
            row(
                "previous",
                info.previous.index().to_string(),
                Some((Action::Previous, "P")),
            );
            row(
                "origin",
                format!("{} (valence {})", info.origin.index(), info.valence),
                Some((Action::AroundVertex, "V")),
            );
            row("target", info.target.index().to_string(), None);
            let face = info
                .face
                .map_or_else(|| "none (boundary)".to_owned(), |f| f.index().to_string());
            row("face", face, None);
            row("edge", info.edge.index().to_string(), None);
            row("length", format!("{:.5}", info.length), None);
            let angle = info
                .dihedral_angle
                .map_or_else(|| "boundary".to_owned(), |angle| format!("{angle:.2}°"));
            row("dihedral angle", angle, None);
            for attribute in &info.attributes {
                let values: Vec<String> =
                    attribute.value.iter().map(|x| format!("{x:.4}")).collect();
                let value = if attribute.is_tag {
                    (attribute.value == [1.0]).to_string()
                } else {
                    values.join(" ")
                };
                row(&attribute.name, value, None);
            }
        });
}
