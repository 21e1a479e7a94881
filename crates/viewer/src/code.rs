//! Colors of recipe texts.

use std::ops::Range;

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{Color32, FontId, Stroke};
use ron_tree::{Lexer, TokenKind};

use crate::theme::Colors;

/// An underlined part of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Mark {
    /// The bytes of the text.
    pub(crate) range: Range<usize>,
    /// If true, the part has an error. If false, the part has a warning.
    pub(crate) is_error: bool,
}

/// Lays out the text of a recipe for display. The tokens have colors, the bytes in the range `current` have a
/// background color, and the marks are underlined.
pub(crate) fn layout(
    text: &str,
    colors: &Colors,
    font: &FontId,
    current: Option<&Range<usize>>,
    marks: &[Mark],
) -> LayoutJob {
    let mut job = LayoutJob::default();
    let tokens: Vec<_> = Lexer::new(text).collect();
    for (i, token) in tokens.iter().enumerate() {
        let next = tokens[i + 1..]
            .iter()
            .find(|token| !token.kind.is_trivia())
            .map(|token| token.kind);
        let color = match token.kind {
            TokenKind::LineComment | TokenKind::BlockComment | TokenKind::UnclosedComment => {
                colors.code_comment
            }
            TokenKind::Number => colors.code_number,
            TokenKind::String | TokenKind::RawString | TokenKind::Char | TokenKind::Bytes => {
                colors.code_text
            }
            TokenKind::Ident if next == Some(TokenKind::Colon) => colors.code_field,
            TokenKind::Ident => colors.code_call,
            TokenKind::UnclosedString | TokenKind::BadChar => colors.bad,
            _ => colors.weak,
        };
        // A token is split where a mark or the current step begins or ends.
        let span = token.span.start..token.span.end;
        let mut cuts: Vec<usize> = marks
            .iter()
            .map(|mark| &mark.range)
            .chain(current)
            .flat_map(|r| [r.start, r.end])
            .collect();
        cuts.retain(|&cut| cut > span.start && cut < span.end && text.is_char_boundary(cut));
        cuts.sort_unstable();
        cuts.dedup();
        cuts.push(span.end);
        let mut start = span.start;
        for end in cuts {
            let inside = |range: &Range<usize>| range.start <= start && end <= range.end;
            let mark = marks
                .iter()
                .filter(|mark| inside(&mark.range))
                .max_by_key(|mark| mark.is_error);
            let underline = mark.map_or(Stroke::NONE, |mark| {
                Stroke::new(
                    1.5,
                    if mark.is_error {
                        colors.bad
                    } else {
                        colors.warning
                    },
                )
            });
            let background = if current.is_some_and(inside) {
                colors.accent_fill.gamma_multiply(0.55)
            } else {
                Color32::TRANSPARENT
            };
            job.append(
                &text[start..end],
                0.0,
                TextFormat {
                    font_id: font.clone(),
                    color,
                    background,
                    underline,
                    ..TextFormat::default()
                },
            );
            start = end;
        }
    }
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_layout_has_exactly_the_text() {
        let colors = Colors::of(true);
        let font = FontId::monospace(12.0);
        for text in [
            "",
            "(recipe: 1, steps: [Cube(name: \"a\")])",
            "// ü\n(\"unclosed",
            "a 'bad' /* x",
        ] {
            let mark = Mark {
                range: 1..text.len().min(5),
                is_error: true,
            };
            let job = layout(text, &colors, &font, Some(&(0..3)), &[mark]);
            assert_eq!(job.text, text);
            let end = job
                .sections
                .last()
                .map_or(0, |section| section.byte_range.end.0);
            assert_eq!(end, text.len());
        }
    }
}
