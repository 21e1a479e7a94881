//! The list of all keys.

use editor::Action;
use eframe::egui::{self, Context, Id, Key, RichText, ScrollArea, Ui};

use crate::app::Parts;
use crate::theme::Colors;

/// How the mouse is used.
const MOUSE: [(&str, &str); 10] = [
    ("Drag", "turn the view"),
    ("Right or middle drag", "move the view"),
    ("Wheel", "zoom to the cursor"),
    ("Click", "pick a vertex, an edge or a face"),
    (
        "Shift+Click",
        "add an element to the picked elements, or remove it",
    ),
    ("Shift+Drag", "add all elements in a box"),
    ("Ctrl+Drag", "add all elements in a lasso"),
    (
        "with Alt",
        "remove all elements in the box or lasso from the picked elements",
    ),
    ("Double click", "pick an edge loop"),
    (
        "Drag a control point",
        "move the control point of a curve or patch",
    ),
];

/// The name of a task in the help. Below this name, the help also shows the keys in `SIDES`.
const LOOK: &str = "Look";
/// Keys that the table of actions does not have.
const SIDES: [(&str, &str); 2] = [
    ("1 to 7", "look from one of seven directions"),
    ("0", "switch perspective on or off"),
];

pub(crate) fn ui(ctx: &Context, parts: &mut Parts) {
    if !parts.shows_help {
        return;
    }
    let modal = egui::Modal::new(Id::unique("help")).frame(modal_frame(ctx)).show(ctx, |ui| {
        // All keys fit in a window of 1280 x 800 logical pixels. In a smaller window, the list of keys is scrolled
        // below its title.
        let window = ctx.content_rect().size();
        ui.set_width((window.x - 120.0).clamp(300.0, 1000.0));
        ui.horizontal(|ui| {
            ui.heading("Keys and mouse");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.button("Close").clicked() {
                    parts.shows_help = false;
                }
            });
        });
        ui.label(RichText::new("Every edit becomes a step of the recipe at the left. Undo reverts the last change of the recipe.").weak());
        ui.separator();
        ScrollArea::vertical().min_scrolled_height(window.y - 180.0).max_height(window.y - 180.0).show(ui, |ui| {
            // A row is as high as its text. By default, it would be at least as high as a button.
            ui.spacing_mut().interact_size.y = 0.0;
            ui.columns(3, |columns| {
                let mouse = MOUSE.map(|(keys, doc)| (keys.to_owned(), doc)).to_vec();
                let mut groups = vec![("Mouse", mouse)];
                for (task, actions) in Action::groups() {
                    let rows = actions.map(|action| (parts.keys.of(action).join(", "), action.doc()));
                    let mut rows: Vec<(String, &str)> = rows.collect();
                    if task == LOOK {
                        rows.extend(SIDES.map(|(keys, doc)| (keys.to_owned(), doc)));
                    }
                    groups.push((task, rows));
                }
                let lengths: Vec<usize> = groups.iter().map(|(_, rows)| rows.len() + 2).collect();
                for ((task, rows), column) in groups.iter().zip(columns_of(&lengths)) {
                    group(&mut columns[column], task, rows);
                }
            });
        });
    });
    if modal.should_close() || ctx.input(|input| input.key_pressed(Key::Escape)) {
        parts.shows_help = false;
    }
}

/// Returns the column of each group. Starting with the longest group, each group goes into the column that is shortest
/// so far. The three columns thereby become about equally long.
fn columns_of(lengths: &[usize]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    order.sort_by_key(|&g| std::cmp::Reverse(lengths[g]));
    let (mut columns, mut filled) = (vec![0; lengths.len()], [0; 3]);
    for g in order {
        let shortest = (0..3).min_by_key(|&i| filled[i]).unwrap_or_default();
        filled[shortest] += lengths[g];
        columns[g] = shortest;
    }
    columns
}

/// Draws the name of a task, and the keys for this task below it.
fn group(ui: &mut Ui, task: &str, rows: &[(String, &str)]) {
    ui.add_space(4.0);
    ui.label(RichText::new(task).strong().size(13.0));
    for (keys, doc) in rows {
        row(ui, keys, doc);
    }
    ui.add_space(6.0);
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
