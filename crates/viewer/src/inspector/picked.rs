//! The picked elements, and the half-edge with its neighbors.

use editor::{Action, HalfEdgeInfo};
use eframe::egui::{Button, Grid, Label, RichText, Ui};

use super::weak;
use crate::app::Parts;
use crate::steps_pane::heading;
use crate::theme::Colors;

/// The picked elements.
pub(super) fn picked(ui: &mut Ui, parts: &mut Parts) {
    heading(ui, "Picked", |_| {});
    let (Some(picked), Some(mesh)) = (parts.editor.picked().cloned(), parts.picked_mesh()) else {
        weak(
            ui,
            "Click a vertex, an edge or a face in the view. Shift+drag picks a box, a double click an edge loop.",
        );
        return;
    };
    let colors = Colors::current(ui);
    ui.label(RichText::new(parts.description()).color(colors.picked));
    if let Some(proposal) = parts.editor.proposal().cloned() {
        let has_other = parts.editor.may_have_other_proposal();
        ui.horizontal_wrapped(|ui| {
            let text = RichText::new(&proposal.text).monospace().size(11.5);
            ui.add(Label::new(text).wrap())
                .on_hover_text("The selection that the next step uses for the picked elements");
            if has_other
                && ui
                    .small_button("Other")
                    .on_hover_text("Another selection that means the same elements")
                    .clicked()
            {
                parts.editor.next_proposal();
            }
        });
    }
    let ctx = ui.ctx().clone();
    ui.horizontal_wrapped(|ui| {
        let actions: &[(&str, Action)] = match picked.elements {
            op::Selected::Edges(_) => &[
                ("Flip", Action::Flip),
                ("Split", Action::Split),
                ("Collapse", Action::Collapse),
                ("Dissolve", Action::Dissolve),
                ("Move", Action::Move),
                ("Loop", Action::EdgeLoop),
                ("Ring", Action::EdgeRing),
            ],
            op::Selected::Vertices(_) => &[
                ("Dissolve", Action::Dissolve),
                ("Move", Action::Move),
                ("Grow", Action::Grow),
            ],
            op::Selected::Faces(_) => &[
                ("Extrude", Action::Extrude),
                ("Move", Action::Move),
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
    if let Some(info) = picked.half_edge.and_then(|h| HalfEdgeInfo::of(&mesh, h)) {
        ui.add_space(4.0);
        half_edge(ui, parts, &info);
    }
}

/// The half-edge and its neighbors.
fn half_edge(ui: &mut Ui, parts: &mut Parts, info: &HalfEdgeInfo) {
    let colors = Colors::current(ui);
    ui.label(
        RichText::new("Half-edge")
            .strong()
            .size(12.0)
            .color(colors.weak),
    );
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
