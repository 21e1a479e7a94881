//! The list of all keys.

use editor::Action;
use eframe::egui::{self, Context, Id, Key, RichText, Ui};

use crate::app::Parts;
use crate::theme::Colors;

/// How the mouse is used.
const MOUSE: [(&str, &str); 9] = [
    ("Drag", "turn the view"),
    ("Right or middle drag", "move the view"),
    ("Wheel", "zoom to the cursor"),
    ("Click", "pick a vertex, an edge or a face"),
    (
        "Shift+Click",
        "add to the picked elements, or remove from them",
    ),
    ("Shift+Drag", "pick all elements in a box"),
    ("Ctrl+Drag", "pick all elements in a lasso"),
    ("Double click", "pick an edge loop"),
    ("Drag a control point", "move it (curves and patches)"),
];

pub(crate) fn ui(ctx: &Context, parts: &mut Parts) {
    if !parts.shows_help {
        return;
    }
    let modal = egui::Modal::new(Id::unique("help")).frame(modal_frame(ctx)).show(ctx, |ui| {
        ui.set_width(760.0);
        ui.horizontal(|ui| {
            ui.heading("Keys and mouse");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.button("Close").clicked() {
                    parts.shows_help = false;
                }
            });
        });
        ui.label(RichText::new("Everything you do becomes a step of the recipe at the left. Undo goes back in the history of the recipe.").weak());
        ui.separator();
        let actions: Vec<Action> = Action::all().collect();
        let n = actions.len().div_ceil(3);
        ui.columns(3, |columns| {
            for (column, actions) in columns.iter_mut().zip(actions.chunks(n)) {
                for &action in actions {
                    row(column, &parts.keys.of(action).join(", "), action.doc());
                }
            }
        });
        ui.separator();
        ui.columns(3, |columns| {
            for (i, (keys, doc)) in MOUSE.iter().enumerate() {
                row(&mut columns[i % 3], keys, doc);
            }
            row(&mut columns[1], "1 to 7", "views from the sides; 0 switches perspective");
        });
    });
    if modal.should_close() || ctx.input(|input| input.key_pressed(Key::Escape)) {
        parts.shows_help = false;
    }
}

fn row(ui: &mut Ui, keys: &str, doc: &str) {
    let colors = Colors::current(ui);
    ui.horizontal_wrapped(|ui| {
        ui.label(
            RichText::new(keys)
                .monospace()
                .size(11.5)
                .color(colors.accent),
        );
        ui.label(RichText::new(doc).size(12.0));
    });
}

/// Returns the frame of a dialog.
pub(crate) fn modal_frame(ctx: &Context) -> egui::Frame {
    egui::Frame::window(&ctx.global_style()).inner_margin(16)
}
