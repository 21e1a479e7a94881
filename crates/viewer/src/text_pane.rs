//! The text of the recipe, with colors, errors and completion.

use std::collections::BTreeSet;
use std::ops::Range;

use eframe::egui::{
    self, FontId, Id, Key, Margin, Modifiers, RichText, ScrollArea, TextBuffer, TextEdit,
    TextStyle, Ui,
};

use crate::app::Parts;
use crate::code::{self, Mark};
use crate::palette;
use crate::steps_pane::heading;
use crate::theme::Colors;

/// The state of the text.
#[derive(Debug, Default)]
pub(crate) struct TextPane {
    /// The text that is shown.
    buffer: String,
    /// The version of the document that `buffer` was read from.
    version: Option<u64>,
    /// The byte to scroll to.
    target: Option<usize>,
    /// The cursor, as an index of a byte.
    cursor: Option<usize>,
    /// The index of the chosen completion.
    chosen: usize,
    /// The offset of the word for which the user has closed the list of completions.
    closed_at: Option<usize>,
}

impl TextPane {
    /// Scrolls to a place of the text.
    pub(crate) fn go_to(&mut self, offset: usize) {
        self.target = Some(offset);
    }
}

pub(crate) fn ui(ui: &mut Ui, parts: &mut Parts) {
    egui::Frame::new()
        .inner_margin(Margin::symmetric(10, 7))
        .show(ui, |ui| {
            let n = parts.editor.run().diagnostics.len();
            let colors = Colors::current(ui);
            heading(ui, "Recipe", |ui| {
                if n > 0 && parts.editor.is_run_current() {
                    let text = if n == 1 {
                        "1 message".to_owned()
                    } else {
                        format!("{n} messages")
                    };
                    ui.label(RichText::new(text).small().color(colors.warning));
                }
            });
            edit(ui, parts);
        });
}

fn edit(ui: &mut Ui, parts: &mut Parts) {
    let colors = Colors::current(ui);
    let version = parts.editor.document().version();
    if parts.text.version != Some(version) {
        parts.editor.text().clone_into(&mut parts.text.buffer);
        parts.text.version = Some(version);
    }
    let id = Id::unique("recipe text");
    let words = completions(parts, ui, id);
    let accepted = accept(ui, parts, &words, id);
    let marks = if accepted.is_none() {
        marks(parts)
    } else {
        Vec::new()
    };
    let current: Option<Range<usize>> = parts.editor.cursor().checked_sub(1).and_then(|step| {
        let span = parts.editor.outline().steps.get(step)?.span;
        Some(span.start..span.end)
    });
    let font = TextStyle::Monospace.resolve(ui.style());
    let mut layouter = |ui: &Ui, text: &dyn TextBuffer, _: f32| {
        let mut job = code::layout(text.as_str(), &colors, &font, current.as_ref(), &marks);
        // Long lines are not wrapped: the text scrolls.
        job.wrap.max_width = f32::INFINITY;
        ui.fonts_mut(|fonts| fonts.layout_job(job))
    };
    let pane = &mut parts.text;
    let before = pane.cursor;
    let mut is_changed = accepted.is_some();
    ScrollArea::both()
        .auto_shrink([false, false])
        .show(ui, |ui| {
            let edit = TextEdit::multiline(&mut pane.buffer)
                .id(id)
                .code_editor()
                .lock_focus(true)
                .desired_width(f32::INFINITY)
                .desired_rows(12)
                .frame(egui::Frame::NONE)
                .layouter(&mut layouter);
            let output = edit.show(ui);
            output
                .response
                .response
                .clone()
                .accessible_name("Recipe text");
            is_changed |= output.response.response.changed();
            pane.cursor = output
                .cursor_range
                .map(|range| byte_of(&pane.buffer, range.primary.index.0));
            if let Some(target) = pane.target.take() {
                let at = char_of(&pane.buffer, target);
                let place = output.galley.pos_from_cursor(egui::text::CCursor::new(at));
                ui.scroll_to_rect(
                    place.translate(output.galley_pos.to_vec2()),
                    Some(egui::Align::Center),
                );
            }
            show_completions(ui, pane, &words, &output, &colors);
            // If there is an error under the mouse pointer, its explanation is shown.
            let hovered = output
                .response
                .response
                .hover_pos()
                .map(|at| output.galley.cursor_from_pos(at - output.galley_pos));
            if let Some(at) = hovered.map(|cursor| byte_of(&pane.buffer, cursor.index.0)) {
                let message = message_at(&parts.editor, at);
                if let Some(message) = message {
                    output.response.response.show_tooltip_text(message);
                }
            }
        });
    if is_changed {
        parts.editor.set_text(&parts.text.buffer.clone());
        parts.text.version = Some(parts.editor.document().version());
    } else if parts.text.cursor != before
        && let Some(offset) = parts.text.cursor
        && let Some(step) = parts.editor.outline().step_at(offset)
    {
        // A click on a step in the text selects the step.
        let is_inside = parts.editor.outline().steps[step].span.end >= offset;
        if is_inside && parts.editor.cursor() != step + 1 {
            parts.editor.set_cursor(step + 1);
        }
    }
}

/// Returns the errors and warnings of the text.
fn marks(parts: &Parts) -> Vec<Mark> {
    if !parts.editor.is_run_current() {
        return Vec::new();
    }
    let run = parts.editor.run();
    let all = run
        .diagnostics
        .iter()
        .chain(run.failures.iter().map(|failure| &failure.diagnostic));
    let own = all.filter(|diagnostic| diagnostic.source == 0);
    let mark = |diagnostic: &engine::Diagnostic| {
        let span = diagnostic.span?;
        Some(Mark {
            range: span.start..span.end.max(span.start + 1),
            is_error: diagnostic.is_error(),
        })
    };
    own.filter_map(mark).collect()
}

/// Returns the messages about a byte of the text.
fn message_at(editor: &editor::Editor, at: usize) -> Option<String> {
    if !editor.is_run_current() {
        return None;
    }
    let run = editor.run();
    let all = run
        .diagnostics
        .iter()
        .chain(run.failures.iter().map(|failure| &failure.diagnostic));
    let here = all.filter(|d| {
        d.source == 0
            && d.span
                .is_some_and(|span| (span.start..=span.end).contains(&at))
    });
    let texts: Vec<String> = here
        .map(|diagnostic| match &diagnostic.help {
            Some(help) => format!("{}\n{help}", diagnostic.message),
            None => diagnostic.message.clone(),
        })
        .collect();
    (!texts.is_empty()).then(|| texts.join("\n\n"))
}

/// A word that can be completed: the range of its bytes, and the texts that can replace it.
struct Words {
    range: Range<usize>,
    texts: Vec<String>,
}

/// Returns the completions of the word before the cursor. A word that begins with a capital letter is completed to
/// names of operations. But if the word is in the value of a parameter with variants, it is completed to names of these
/// variants. All other words are completed to names of the parameters of the step.
fn completions(parts: &Parts, ui: &Ui, id: Id) -> Words {
    let none = Words {
        range: 0..0,
        texts: Vec::new(),
    };
    let pane = &parts.text;
    let Some(end) = pane
        .cursor
        .filter(|_| ui.memory(|memory| memory.has_focus(id)))
    else {
        return none;
    };
    let Some(before) = pane.buffer.get(..end) else {
        return none;
    };
    let start = before
        .rfind(|c: char| !c.is_alphanumeric() && c != '_')
        .map_or(0, |i| {
            i + before[i..].chars().next().map_or(1, char::len_utf8)
        });
    let word = &before[start..];
    if pane.closed_at == Some(start) || word.is_empty() {
        return none;
    }
    let variants = variants_at(&parts.editor, start);
    let texts: Vec<String> = if !variants.is_empty() && word.starts_with(char::is_uppercase) {
        let names = variants.into_iter().map(|variant| variant.name);
        names
            .filter(|name| name.starts_with(word) && name != word)
            .collect()
    } else if word.starts_with(char::is_uppercase) {
        let found = palette::search(parts.editor.registry(), word, &BTreeSet::new());
        found
            .iter()
            .filter(|entry| entry.name.starts_with(word) && entry.name != word)
            .map(|entry| entry.name.to_owned())
            .collect()
    } else {
        let Some(step) = parts.editor.outline().step_at(start) else {
            return none;
        };
        let panel = parts.editor.panel(step);
        let fields = panel
            .iter()
            .flat_map(|panel| &panel.fields)
            .map(|field| field.name.clone());
        fields
            .filter(|name| name.starts_with(word) && name != word)
            .map(|name| format!("{name}: "))
            .collect()
    };
    Words {
        range: start..end,
        texts: texts.into_iter().take(8).collect(),
    }
}

/// If the byte `at` of the text is in the value of a step's parameter, returns the variants of this parameter. Inside a
/// nested selection, such as `Sharp` in `Not(Sharp(above: 30))`, the result is the same: the variants of the whole
/// parameter. Otherwise, returns no variants.
fn variants_at(editor: &editor::Editor, at: usize) -> Vec<recipe::VariantDoc> {
    let outline = editor.outline();
    let field = outline.step_at(at).and_then(|step| {
        let fields = outline.run_of(step)?.fields();
        let inside = |span: recipe::Span| span.start <= at && at <= span.end;
        let written = fields.iter().find(|field| inside(field.value.span))?;
        let panel = editor.panel(step)?;
        panel.field(&written.name.text).cloned()
    });
    field.map_or_else(Vec::new, |field| field.variants)
}

/// Handles the keys for the list of completions: the arrow keys choose an entry, Tab or Enter inserts it, and Escape
/// closes the list. Returns the range of the text that the entry replaced, or `None` if no entry was inserted.
fn accept(ui: &mut Ui, parts: &mut Parts, words: &Words, id: Id) -> Option<Range<usize>> {
    if words.texts.is_empty() {
        parts.text.chosen = 0;
        return None;
    }
    let (up, down, take, escape) = ui.input_mut(|input| {
        let mut key = |key| input.consume_key(Modifiers::NONE, key);
        (
            key(Key::ArrowUp),
            key(Key::ArrowDown),
            key(Key::Tab) || key(Key::Enter),
            key(Key::Escape),
        )
    });
    let pane = &mut parts.text;
    let last = words.texts.len() - 1;
    pane.chosen = match (up, down) {
        (true, _) => pane.chosen.saturating_sub(1),
        (_, true) => pane.chosen + 1,
        _ => pane.chosen,
    }
    .min(last);
    if escape {
        pane.closed_at = Some(words.range.start);
    }
    if !take {
        return None;
    }
    let text = &words.texts[pane.chosen];
    pane.buffer.replace_range(words.range.clone(), text);
    let cursor = egui::text::CCursor::new(char_of(&pane.buffer, words.range.start + text.len()));
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    state
        .cursor
        .set_char_range(Some(egui::text::CCursorRange::one(cursor)));
    TextEdit::store_state(ui.ctx(), id, state);
    Some(words.range.clone())
}

fn show_completions(
    ui: &Ui,
    pane: &TextPane,
    words: &Words,
    output: &egui::text_edit::TextEditOutput,
    colors: &Colors,
) {
    if words.texts.is_empty() || pane.cursor.is_none() {
        return;
    }
    let at = char_of(&pane.buffer, words.range.start.min(pane.buffer.len()));
    let place = output.galley.pos_from_cursor(egui::text::CCursor::new(at));
    let corner = output.galley_pos + place.left_bottom().to_vec2();
    egui::Area::new(Id::unique("completions"))
        .fixed_pos(corner)
        .order(egui::Order::Foreground)
        .show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                for (i, text) in words.texts.iter().enumerate() {
                    let color = if i == pane.chosen {
                        colors.accent
                    } else {
                        colors.text
                    };
                    ui.label(
                        RichText::new(text)
                            .font(FontId::monospace(12.0))
                            .color(color),
                    );
                }
            });
        });
}

/// Returns the index of the byte at which the character `at` begins.
fn byte_of(text: &str, at: usize) -> usize {
    text.char_indices()
        .nth(at)
        .map_or(text.len(), |(byte, _)| byte)
}

/// Returns the number of characters before a byte.
fn char_of(text: &str, at: usize) -> usize {
    text.char_indices()
        .take_while(|(byte, _)| *byte < at)
        .count()
}
