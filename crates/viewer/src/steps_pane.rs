//! The list of steps with the cursor, and the expectations.

use editor::{Editor, Verdict};
use eframe::egui::{
    self, Align, Color32, Label, Layout, Margin, Rect, RichText, ScrollArea, Sense, Stroke, Ui,
    UiBuilder, Vec2, WidgetInfo,
};

use crate::app::Parts;
use crate::theme::Colors;
use crate::widgets::{dot, duration, size};

/// What the user does with a step in the list.
enum Edit {
    Cursor(usize),
    Delete(usize),
    Duplicate(usize),
    Enable(usize, bool),
    Move(usize, usize),
}

/// Draws the heading of a tile.
pub(crate) fn heading(ui: &mut Ui, title: &str, right: impl FnOnce(&mut Ui)) {
    let colors = Colors::current(ui);
    ui.horizontal(|ui| {
        ui.set_min_height(22.0);
        ui.label(RichText::new(title).strong().size(13.0).color(colors.text));
        ui.with_layout(Layout::right_to_left(Align::Center), right);
    });
    let y = ui.cursor().top();
    ui.painter()
        .hline(ui.max_rect().x_range(), y, Stroke::new(1.0, colors.line));
    ui.add_space(5.0);
}

pub(crate) fn ui(ui: &mut Ui, parts: &mut Parts) {
    let mut edit = None;
    egui::Frame::new()
        .inner_margin(Margin::symmetric(10, 7))
        .show(ui, |ui| {
            let mut records = false;
            heading(ui, "Steps", |ui| {
                records = ui
                    .small_button("Record a test")
                    .on_hover_text(
                        "Adds expectations to the recipe, such as the number of faces, that hold for the scene after the selected step",
                    )
                    .clicked();
            });
            ScrollArea::vertical()
                .auto_shrink([false, false])
                .show(ui, |ui| {
                    ui.spacing_mut().item_spacing.y = 2.0;
                    edit = steps(ui, parts);
                    expectations(ui, parts);
                });
            if records {
                let result = parts.editor.record_test().map(|_| ());
                parts.report(result);
            }
        });
    let editor = &mut parts.editor;
    let result = match edit {
        None => return,
        Some(Edit::Cursor(cursor)) => {
            editor.set_cursor(cursor);
            Ok(())
        }
        Some(Edit::Delete(step)) => editor.delete_step(step),
        Some(Edit::Duplicate(step)) => editor.duplicate_step(step),
        Some(Edit::Enable(step, is)) => editor.set_enabled(step, is),
        Some(Edit::Move(from, to)) => editor.move_step(from, to),
    };
    parts.report(result);
}

fn steps(ui: &mut Ui, parts: &Parts) -> Option<Edit> {
    let editor = &parts.editor;
    let colors = Colors::current(ui);
    let cursor = editor.cursor();
    let mut edit = None;
    let n = editor.outline().steps.len();
    if row(ui, "Start", "the empty scene", cursor == 0, |ui| {
        dot(ui, colors.line);
        ui.label(RichText::new("Start").color(colors.weak));
    })
    .clicked()
    {
        edit = Some(Edit::Cursor(0));
    }
    for (i, step) in editor.outline().steps.iter().enumerate() {
        let state = Summary::of(editor, i);
        let is_at = cursor == i + 1;
        let is_after = i + 1 > cursor;
        let response = row(
            ui,
            &format!("Step {}: {}", i + 1, step.name),
            state.doc,
            is_at,
            |ui| {
                dot(ui, state.color(&colors, step.enabled));
                let color = if !step.enabled || is_after {
                    colors.weak
                } else {
                    colors.text
                };
                let mut name = RichText::new(if step.name.is_empty() {
                    "?"
                } else {
                    &step.name
                })
                .color(color);
                if !step.enabled {
                    name = name.strikethrough();
                }
                ui.add(Label::new(name).selectable(false));
                if let Some(id) = &step.id {
                    ui.add(
                        Label::new(RichText::new(id).small().color(colors.weak)).selectable(false),
                    );
                }
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.add(
                        Label::new(RichText::new(&state.time).small().color(colors.weak))
                            .selectable(false),
                    );
                    ui.add(
                        Label::new(RichText::new(&state.size).small().color(colors.weak))
                            .selectable(false)
                            .truncate(),
                    );
                });
            },
        );
        if response.clicked() {
            edit = Some(Edit::Cursor(i + 1));
        }
        response.context_menu(|ui| {
            let is = step.enabled;
            for (label, new, is_possible) in [
                (
                    if is { "Disable" } else { "Enable" },
                    Edit::Enable(i, !is),
                    true,
                ),
                ("Duplicate", Edit::Duplicate(i), true),
                ("Move up", Edit::Move(i, i.saturating_sub(1)), i > 0),
                ("Move down", Edit::Move(i, i + 1), i + 1 < n),
                ("Delete", Edit::Delete(i), true),
            ] {
                if ui
                    .add_enabled(is_possible, egui::Button::new(label))
                    .clicked()
                {
                    edit = Some(new);
                    ui.close();
                }
            }
        });
        if let Some(note) = &step.note {
            details(ui, note, colors.weak);
        }
        for note in state.notes.iter().filter(|_| is_at) {
            details(ui, note, colors.weak);
        }
        for loss in &state.losses {
            details(ui, loss, colors.warning);
        }
        for error in &state.errors {
            details(ui, error, colors.bad);
        }
    }
    edit
}

fn details(ui: &mut Ui, text: &str, color: Color32) {
    ui.horizontal(|ui| {
        ui.add_space(22.0);
        ui.add(Label::new(RichText::new(text).small().color(color)).wrap());
    });
}

/// Draws a row that can be clicked.
fn row(
    ui: &mut Ui,
    label: &str,
    doc: &str,
    is_at: bool,
    contents: impl FnOnce(&mut Ui),
) -> egui::Response {
    let colors = Colors::current(ui);
    let (rect, response) =
        ui.allocate_exact_size(Vec2::new(ui.available_width(), 24.0), Sense::click());
    response.widget_info(|| WidgetInfo::selected(egui::Role::ListBoxOption, true, is_at, label));
    let fill = if is_at {
        colors.accent_fill
    } else if response.hovered() {
        ui.visuals().faint_bg_color
    } else {
        Color32::TRANSPARENT
    };
    ui.painter().rect_filled(rect, 4.0, fill);
    if is_at {
        let bar = Rect::from_min_max(rect.left_top(), rect.left_bottom() + Vec2::new(3.0, 0.0));
        ui.painter().rect_filled(bar, 1.0, colors.accent);
    }
    if response.has_focus() {
        ui.painter().rect_stroke(
            rect,
            4.0,
            Stroke::new(1.0, colors.accent),
            egui::StrokeKind::Inside,
        );
    }
    let inner = rect.shrink2(Vec2::new(8.0, 0.0));
    ui.scope_builder(
        UiBuilder::new()
            .max_rect(inner)
            .layout(Layout::left_to_right(Align::Center)),
        |ui| {
            ui.disable_selectable();
            contents(ui);
        },
    );
    if doc.is_empty() {
        response
    } else {
        response.on_hover_text(doc)
    }
}

trait NotSelectable {
    fn disable_selectable(&mut self);
}

impl NotSelectable for Ui {
    /// Text in rows cannot be selected, so that a click on the text is a click on the row.
    fn disable_selectable(&mut self) {
        self.style_mut().interaction.selectable_labels = false;
    }
}

/// What the list shows about a step.
struct Summary {
    is_known: bool,
    time: String,
    size: String,
    doc: &'static str,
    notes: Vec<String>,
    losses: Vec<String>,
    errors: Vec<String>,
}

impl Summary {
    fn of(editor: &Editor, item: usize) -> Self {
        let run = editor.run();
        let is_current = editor.is_run_current() || editor.is_preview();
        let range = if is_current {
            editor.steps_of_item(item)
        } else {
            0..0
        };
        let steps = &run.steps[range.clone()];
        let results: Vec<_> = steps
            .iter()
            .filter_map(|step| step.result.as_ref())
            .collect();
        let is_known = !steps.is_empty() && results.len() == steps.len();
        let time = results.iter().map(|result| result.done.time).sum();
        let name = editor.outline().steps[item].name.as_str();
        let mut errors: Vec<String> = Vec::new();
        if is_current {
            let failed = run
                .failures
                .iter()
                .filter(|failure| failure.step.is_some_and(|step| range.contains(&step)));
            errors.extend(failed.map(|failure| failure.diagnostic.message.clone()));
            let span = editor.outline().steps[item].span;
            let inside = run.diagnostics.iter().filter(|d| {
                d.is_error() && d.source == 0 && d.span.is_some_and(|s| span.contains(s))
            });
            errors.extend(inside.map(|diagnostic| diagnostic.message.clone()));
        }
        let reports = || results.iter().map(|result| &result.done.report);
        Self {
            is_known,
            time: if is_known {
                duration(time)
            } else {
                String::new()
            },
            size: results
                .last()
                .filter(|_| is_known)
                .map_or_else(String::new, |result| size(&result.scene)),
            doc: editor
                .registry()
                .get(name)
                .map_or("", |entry| entry.summary),
            notes: reports()
                .flat_map(|report| report.notes.iter().cloned())
                .collect(),
            losses: reports()
                .flat_map(|report| {
                    report
                        .losses
                        .iter()
                        .map(|loss| format!("lost {}: {}", loss.name, loss.reason))
                })
                .collect(),
            errors,
        }
    }

    fn color(&self, colors: &Colors, is_enabled: bool) -> Color32 {
        if !is_enabled {
            colors.line
        } else if !self.errors.is_empty() {
            colors.bad
        } else if !self.losses.is_empty() {
            colors.warning
        } else if self.is_known {
            colors.good
        } else {
            colors.weak
        }
    }
}

fn expectations(ui: &mut Ui, parts: &mut Parts) {
    let colors = Colors::current(ui);
    let run = parts.editor.run();
    if run.expectations.is_empty() || !parts.editor.is_run_current() {
        return;
    }
    ui.add_space(8.0);
    ui.label(
        RichText::new("Expectations")
            .strong()
            .size(12.0)
            .color(colors.weak),
    );
    let mut go_to = None;
    for expectation in &run.expectations {
        let Some(source) = run.sources.get(expectation.source) else {
            continue;
        };
        let text: String = expectation
            .span
            .of(&source.text)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        let (color, message, state) = match &expectation.verdict {
            Some(Verdict::Holds) => (colors.good, None, "holds"),
            Some(Verdict::Fails { message, .. }) => (colors.bad, Some(message), "does not hold"),
            None => (colors.weak, None, "not checked yet"),
        };
        let response = row(ui, &format!("{text}: {state}"), "", false, |ui| {
            dot(ui, color);
            ui.add(Label::new(RichText::new(&text).monospace().size(11.5)).truncate());
        });
        if response.clicked() && expectation.source == 0 {
            go_to = Some(expectation.span.start);
        }
        if let Some(message) = message {
            details(ui, message, colors.bad);
        }
    }
    if let Some(offset) = go_to {
        parts.text.go_to(offset);
    }
}
