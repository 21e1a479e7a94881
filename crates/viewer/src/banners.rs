//! Shows messages over the view: conflicts, unsaved texts that can be recovered, notices and errors.

use eframe::egui::{Color32, CornerRadius, Frame, Margin, RichText, Stroke, Ui};

use engine::Diagnostic;

use crate::app::Parts;
use crate::theme::Colors;
use crate::widgets::dot;

/// Shows the messages.
pub(crate) fn banners(ui: &mut Ui, parts: &mut Parts, colors: &Colors) {
    let frame = |color: Color32| {
        Frame::new()
            .fill(colors.panel)
            .stroke(Stroke::new(1.0, color))
            .corner_radius(CornerRadius::same(7))
            .inner_margin(Margin::symmetric(10, 6))
    };
    ui.add_space(2.0);
    if parts.editor.document().conflict().is_some() {
        frame(colors.warning).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label("Another program changed the file, but your text has unsaved changes. Keep your text, or take the text of the file?");
                if ui.button("Keep mine").clicked() {
                    parts.editor.keep_mine();
                }
                if ui.button("Take theirs").clicked() {
                    parts.editor.take_theirs();
                }
            });
        });
    }
    if let Some(recovery) = parts.files.recovery() {
        let name = recovery.path.file_name().unwrap_or_default().display();
        let message = format!("The editor closed before {name} was saved.");
        frame(colors.accent).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label(message);
                if ui.button("Recover").clicked()
                    && let Some(recovery) = parts.files.take_recovery()
                {
                    parts.editor.recover(&recovery);
                }
                if ui.button("Discard").clicked()
                    && let Some(recovery) = parts.files.take_recovery()
                {
                    recovery.discard(&engine::Disk);
                }
            });
        });
    }
    if let Some(notice) = parts.notice.clone() {
        frame(if notice.is_error {
            colors.bad
        } else {
            colors.accent
        })
        .show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label(&notice.text);
                if ui.small_button("Close").clicked() {
                    parts.notice = None;
                }
            });
        });
    }
    if let Some((error, offset)) = first_error(parts) {
        frame(colors.bad).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                dot(ui, colors.bad);
                ui.label(error.message);
                if let Some(offset) = offset
                    && ui.small_button("Show in the recipe").clicked()
                {
                    parts.text.go_to(offset);
                }
            });
            if let Some(help) = error.help {
                ui.label(RichText::new(help).color(colors.weak));
            }
        });
    }
    for message in &parts.view.messages {
        ui.label(RichText::new(message).color(colors.warning));
    }
}

/// Returns the first error, and its offset in the text if the error is about the current text.
fn first_error(parts: &Parts) -> Option<(Diagnostic, Option<usize>)> {
    if parts.editor.is_running() {
        return None;
    }
    let run = parts.editor.run();
    let errors = run
        .diagnostics
        .iter()
        .filter(|d| d.is_error())
        .chain(run.failures.iter().map(|f| &f.diagnostic));
    let first = errors.into_iter().next()?;
    let place = first
        .span
        .filter(|_| first.source == 0 && parts.editor.is_run_current());
    Some((first.clone(), place.map(|span| span.start)))
}
