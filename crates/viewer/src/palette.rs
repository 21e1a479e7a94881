//! The search over all operations.

use std::collections::BTreeSet;

use editor::{Editor, Panel, Picked};
use eframe::egui::{self, Align2, Context, Id, Key, RichText, ScrollArea, TextEdit, Vec2};
use op::{Entry, Registry};

use crate::app::Parts;
use crate::theme::Colors;

/// The state of the search.
#[derive(Clone, Debug, Default)]
pub(crate) struct Palette {
    query: String,
    at: usize,
    /// The operations that can be applied to the picked elements.
    fitting: BTreeSet<&'static str>,
}

impl Palette {
    /// Creates a search without a query. If several operations match equally well, the operations that take the picked
    /// elements come first.
    pub(crate) fn new(editor: &Editor) -> Self {
        let kind = editor.picked().map(Picked::kind);
        let entries = editor.registry().entries().iter();
        let fits = |entry: &&Entry| kind.is_some_and(|kind| Panel::new(entry).takes_picked(kind));
        Self {
            fitting: entries.filter(fits).map(|entry| entry.name).collect(),
            ..Self::default()
        }
    }
}

/// Returns the operations that match a query, the best first. If several operations match equally well, the operations
/// in `first` come first. An empty query matches all operations.
pub(crate) fn search<'r>(
    registry: &'r Registry,
    query: &str,
    first: &BTreeSet<&str>,
) -> Vec<&'r Entry> {
    let words: Vec<String> = query.split_whitespace().map(str::to_lowercase).collect();
    let mut found: Vec<((u32, bool), &Entry)> = registry
        .entries()
        .iter()
        .filter_map(|entry| {
            let scores = words.iter().map(|word| score(entry, word));
            let is_last = !first.contains(entry.name);
            Some(((scores.sum::<Option<u32>>()?, is_last), entry))
        })
        .collect();
    found.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.name.cmp(b.1.name)));
    found.into_iter().map(|(_, entry)| entry).collect()
}

/// Returns how well an operation matches a word; 0 is best. Returns `None` if the operation does not match.
fn score(entry: &Entry, word: &str) -> Option<u32> {
    let name = entry.name.to_lowercase();
    let has = |list: &[&str]| {
        list.iter()
            .any(|item| item.to_lowercase().starts_with(word))
    };
    if name == word {
        Some(0)
    } else if name.starts_with(word) {
        Some(1)
    } else if has(entry.words) || has(entry.aliases) {
        Some(2)
    } else if name.contains(word) {
        Some(3)
    } else if entry.summary.to_lowercase().contains(word) {
        Some(4)
    } else {
        None
    }
}

pub(crate) fn ui(ctx: &Context, parts: &mut Parts) {
    let Some(mut palette) = parts.palette.take() else {
        return;
    };
    let registry = parts.editor.registry().clone();
    let found = search(&registry, &palette.query, &palette.fitting);
    let (up, down, enter, escape) = ctx.input_mut(|input| {
        let mut key = |key| input.consume_key(egui::Modifiers::NONE, key);
        (
            key(Key::ArrowUp),
            key(Key::ArrowDown),
            key(Key::Enter),
            key(Key::Escape),
        )
    });
    let last = found.len().saturating_sub(1);
    palette.at = match (up, down) {
        (true, _) => palette.at.saturating_sub(1),
        (_, true) => palette.at + 1,
        _ => palette.at,
    }
    .min(last);
    let mut chosen = enter
        .then(|| found.get(palette.at).map(|entry| entry.name))
        .flatten();
    let area = egui::Area::new(Id::unique("palette"))
        .anchor(Align2::CENTER_TOP, Vec2::new(0.0, 90.0))
        .order(egui::Order::Foreground);
    let modal = egui::Modal::new(Id::unique("palette"))
        .area(area)
        .frame(crate::help::modal_frame(ctx).inner_margin(12))
        .show(ctx, |ui| {
            ui.set_width(560.0);
            let colors = Colors::current(ui);
            let edit = TextEdit::singleline(&mut palette.query)
                .hint_text("Search all operations: flip, smooth, bevel, ...")
                .font(egui::FontId::proportional(16.0))
                .desired_width(f32::INFINITY);
            let response = ui.add(edit).accessible_name("Search operations");
            if !response.has_focus() {
                response.request_focus();
            }
            if response.changed() {
                palette.at = 0;
            }
            ui.add_space(4.0);
            ScrollArea::vertical()
                .max_height(420.0)
                .auto_shrink([false, true])
                .show(ui, |ui| {
                    for (i, entry) in found.iter().enumerate() {
                        let is_at = i == palette.at;
                        let mut job = egui::text::LayoutJob::default();
                        let format = |size, color| egui::TextFormat {
                            font_id: egui::FontId::proportional(size),
                            color,
                            ..egui::TextFormat::default()
                        };
                        job.append(
                            entry.name,
                            0.0,
                            format(14.0, if is_at { colors.accent } else { colors.text }),
                        );
                        job.append(entry.summary, 12.0, format(12.5, colors.weak));
                        job.wrap = egui::text::TextWrapping::truncate_at_width(
                            ui.available_width() - 20.0,
                        );
                        let row = ui
                            .with_layout(
                                egui::Layout::top_down_justified(egui::Align::LEFT),
                                |ui| {
                                    ui.add(
                                        egui::Button::selectable(is_at, job)
                                            .truncate()
                                            .min_size(Vec2::new(0.0, 26.0)),
                                    )
                                },
                            )
                            .inner;
                        let row = row.accessible_name(entry.name);
                        if row.clicked() {
                            chosen = Some(entry.name);
                        }
                        if is_at && (up || down) {
                            row.scroll_to_me(None);
                        }
                    }
                    if found.is_empty() {
                        ui.label(RichText::new("No operation matches. Try another word.").weak());
                    }
                });
        });
    if let Some(name) = chosen {
        parts.choose(name);
    } else if !(escape || modal.should_close()) {
        parts.palette = Some(palette);
    }
}
