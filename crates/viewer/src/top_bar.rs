//! The bar at the top, and the status at the bottom.

use editor::{Action, Status};
use eframe::egui::{
    self, Align, Button, Frame, Layout, Margin, Panel, RichText, Sense, Stroke, Ui, Vec2,
};

use crate::app::{Parts, Pending};
use crate::theme::Colors;
use crate::widgets::{counts, dot, duration, grouped, size};

/// Draws the bar at the top of the window.
pub(crate) fn top(ui: &mut Ui, parts: &mut Parts) {
    let colors = Colors::current(ui);
    let frame = Frame::new()
        .fill(colors.panel)
        .inner_margin(Margin::symmetric(10, 6));
    Panel::top("top").frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.label(
                RichText::new("Meshwright")
                    .strong()
                    .size(15.0)
                    .color(colors.accent),
            );
            ui.add_space(6.0);
            file_menu(ui, parts);
            let ctx = ui.ctx().clone();
            let document = parts.editor.document();
            let undo = document
                .undo_label()
                .map(|label| format!("Undo: {label} (Ctrl+Z)"));
            let redo = document
                .redo_label()
                .map(|label| format!("Redo: {label} (Ctrl+Shift+Z)"));
            for (name, label, action) in
                [("Undo", undo, Action::Undo), ("Redo", redo, Action::Redo)]
            {
                let button = ui.add_enabled(label.is_some(), Button::new(name));
                if button.on_hover_text(label.unwrap_or_default()).clicked() {
                    parts.act(action, &ctx);
                }
            }
            ui.add_space(8.0);
            let search =
                Button::new(RichText::new("Search operations   Ctrl+K").color(colors.weak))
                    .min_size(Vec2::new(220.0, 24.0))
                    .fill(colors.field)
                    .stroke(Stroke::new(1.0, colors.line));
            if ui.add(search).clicked() {
                parts.act(Action::Palette, &ctx);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if ui.button("Help").on_hover_text("All keys (H)").clicked() {
                    parts.act(Action::Help, &ctx);
                }
                let is_dark = ui.visuals().dark_mode;
                if ui
                    .button(if is_dark { "Light" } else { "Dark" })
                    .on_hover_text("Switch between dark and light")
                    .clicked()
                {
                    ctx.set_theme(if is_dark {
                        egui::Theme::Light
                    } else {
                        egui::Theme::Dark
                    });
                }
                let document = parts.editor.document();
                let name = document
                    .path()
                    .file_name()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                let mark = if document.is_dirty() { " •" } else { "" };
                ui.add_space(8.0);
                ui.label(RichText::new(format!("{name}{mark}")).color(colors.weak))
                    .on_hover_text(document.path().display().to_string());
            });
        });
    });
}

fn file_menu(ui: &mut Ui, parts: &mut Parts) {
    let ctx = ui.ctx().clone();
    ui.menu_button("File", |ui| {
        ui.set_min_width(200.0);
        let rows = [
            ("New", "Ctrl+N", Action::New),
            ("Open...", "Ctrl+O", Action::Open),
            ("Save", "Ctrl+S", Action::Save),
            ("Save as...", "Ctrl+Shift+S", Action::SaveAs),
        ];
        for (name, key, action) in rows {
            if ui.add(Button::new(name).shortcut_text(key)).clicked() {
                parts.act(action, &ctx);
                ui.close();
            }
        }
        ui.separator();
        if ui
            .button("Run and write the outputs")
            .on_hover_text("Runs all steps, and writes the files of the Save and Picture steps")
            .clicked()
        {
            parts.editor.write_outputs();
            ui.close();
        }
        let recent = parts.files.recent().to_vec();
        if !recent.is_empty() {
            ui.separator();
            ui.label(RichText::new("Recent files").weak().small());
        }
        for path in recent {
            let name = path
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if ui
                .button(name)
                .on_hover_text(path.display().to_string())
                .clicked()
            {
                parts.drop_document(Pending::Open(path), &ctx);
                ui.close();
            }
        }
        ui.separator();
        if ui
            .add(Button::new("Quit").shortcut_text("Ctrl+Q"))
            .clicked()
        {
            parts.act(Action::Quit, &ctx);
            ui.close();
        }
    });
}

/// Draws the status bar at the bottom of the window.
pub(crate) fn status(ui: &mut Ui, parts: &mut Parts) {
    let colors = Colors::current(ui);
    let frame = Frame::new()
        .fill(colors.panel)
        .inner_margin(Margin::symmetric(10, 4));
    Panel::bottom("status").frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            let run = parts.editor.run();
            let (color, text) = if let Some(progress) = parts.editor.progress() {
                let part = (100 * progress.done).checked_div(progress.total);
                let part = part.map_or_else(String::new, |part| format!(" {part} %"));
                (
                    colors.accent,
                    format!("Running {}{part}  (Esc cancels)", progress.step),
                )
            } else if run.has_failed() {
                let n =
                    run.failures.len() + run.diagnostics.iter().filter(|d| d.is_error()).count();
                (
                    colors.bad,
                    format!("{n} {}", if n == 1 { "error" } else { "errors" }),
                )
            } else if run.status == Status::Canceled {
                (colors.warning, "Canceled".to_owned())
            } else {
                let n = run.steps.len();
                let word = if n == 1 { "step" } else { "steps" };
                (
                    colors.good,
                    format!("{n} {word}, {} ran in {}", run.ran, duration(run.time)),
                )
            };
            dot(ui, color);
            ui.label(RichText::new(text).size(12.0));
            if let Some(digest) = run.digest {
                let text = digest.to_string();
                let short: String = text.chars().take(12).collect();
                let label = ui.label(
                    RichText::new(format!("digest {short}…"))
                        .monospace()
                        .size(11.0)
                        .color(colors.weak),
                );
                let label = label.interact(Sense::click());
                if label
                    .on_hover_text(format!("{text}\nClick to copy"))
                    .clicked()
                {
                    ui.ctx().copy_text(text);
                }
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let at = parts.editor.view();
                let [v, e, _] = counts(&at.scene);
                let mut text = size(&at.scene);
                if v > 0 {
                    text = format!("{} vertices   {} edges   {text}", grouped(v), grouped(e));
                }
                ui.label(RichText::new(text).size(12.0).color(colors.weak));
                ui.add_space(12.0);
                let view = &parts.view;
                let element = view.hovered.as_ref();
                let element = element.map(|hit| format!("{} of {}", word(hit.element), hit.object));
                let point = view.hovered_point.as_ref();
                let point =
                    point.map(|hit| format!("control point {} of {}", hit.index, hit.object));
                let hovered = point.or(element);
                let text = match (parts.description(), hovered) {
                    ("", Some(hovered)) => hovered,
                    (text, _) => text.to_owned(),
                };
                ui.add(egui::Label::new(RichText::new(text).size(12.0)).truncate());
            });
        });
    });
}

fn word(element: mesh::Element) -> String {
    match element {
        mesh::Element::Vertex(v) => format!("vertex {}", v.index()),
        mesh::Element::HalfEdge(h) => format!("half-edge {}", h.index()),
        mesh::Element::Edge(e) => format!("edge {}", e.index()),
        mesh::Element::Face(f) => format!("face {}", f.index()),
    }
}
