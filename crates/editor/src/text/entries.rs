//! Inserts and removes entries of a list, struct or map. New entries get the layout of the entries around them.
//!
//! ```text
//! steps: [
//!     Cube(name: "a"),      // a comment at the end of the line belongs to the entry
//!     PokeFaces(),          <- a new entry starts its own line if the entry before ends its line
//! ]
//! ```

use ron_tree::{Lexer, Span, TokenKind};

use super::Edits;

/// How much farther the entries of a container are indented than the container itself.
const INDENT: &str = "    ";

/// The part of a line after an entry.
pub(super) struct Tail {
    /// The offset in the text directly after the comma of the entry, if the entry has a comma.
    pub(super) comma: Option<usize>,
    /// The offset in the text directly after the entry, its comma, and the comments at the end of its line.
    pub(super) end: usize,
    /// Whether the line ends at `end`.
    pub(super) ends_line: bool,
}

/// Returns the part of a line after an entry. `from` is the offset at which the entry ends.
pub(super) fn tail(text: &str, from: usize) -> Tail {
    let (mut comma, mut after_comma, mut after_comment) = (None, from, from);
    let found = |comma, end, ends_line| Tail {
        comma,
        end,
        ends_line,
    };
    let rest = text.get(from..).unwrap_or_default();
    for token in Lexer::new(rest) {
        let end = from + token.span.end;
        match token.kind {
            TokenKind::Comma if comma.is_none() => {
                comma = Some(end);
                (after_comma, after_comment) = (end, end);
            }
            TokenKind::Whitespace if token.span.of(rest).contains('\n') => {
                if comma.is_none() && next_is_comma(&text[end..]) {
                    continue;
                }
                return found(comma, after_comment, true);
            }
            TokenKind::Whitespace => {}
            TokenKind::LineComment | TokenKind::BlockComment => after_comment = end,
            _ => return found(comma, after_comma, false),
        }
    }
    found(comma, after_comment, true)
}

fn next_is_comma(text: &str) -> bool {
    let next = Lexer::new(text).find(|token| !token.kind.is_trivia());
    next.is_some_and(|token| token.kind == TokenKind::Comma)
}

/// Returns the offset at which the line that contains `offset` starts.
pub(super) fn line_start(text: &str, offset: usize) -> usize {
    text[..offset].rfind('\n').map_or(0, |feed| feed + 1)
}

/// Returns the indentation of the line that contains `offset`.
pub(super) fn indent(text: &str, offset: usize) -> &str {
    let line = &text[line_start(text, offset)..];
    &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
}

/// Whether the part of the line before `offset` consists only of spaces.
pub(super) fn starts_line(text: &str, offset: usize) -> bool {
    text[line_start(text, offset)..offset].trim().is_empty()
}

/// Inserts an entry into a container, which is a list, struct or map. The new entry has the index `at`. The span of the
/// container includes its brackets.
pub(crate) fn insert_entry(
    text: &str,
    container: Span,
    entries: &[Span],
    at: usize,
    entry: &str,
) -> Edits {
    let Some(before) = at.min(entries.len()).checked_sub(1) else {
        return insert_first(text, container, entries.first().copied(), entry);
    };
    let before = entries[before];
    let tail = tail(text, before.end);
    let mut edits = Vec::new();
    let at_end = |offset| Span::new(offset, offset);
    let is_last = at >= entries.len();
    if tail.comma.is_none() {
        edits.push((at_end(before.end), ",".to_owned()));
    }
    // The new last entry gets a comma only if the old last entry had one.
    let comma = if is_last && tail.comma.is_none() {
        ""
    } else {
        ","
    };
    if tail.ends_line {
        let indent = if starts_line(text, before.start) {
            indent(text, before.start).to_owned()
        } else {
            format!("{}{INDENT}", indent(text, container.start))
        };
        edits.push((at_end(tail.end), format!("\n{indent}{entry}{comma}")));
    } else {
        let offset = tail.comma.unwrap_or(before.end);
        let comma = if is_last { "" } else { "," };
        edits.push((at_end(offset), format!(" {entry}{comma}")));
    }
    edits
}

/// Inserts an entry before all other entries of the container.
fn insert_first(text: &str, container: Span, first: Option<Span>, entry: &str) -> Edits {
    let open = container.start + 1;
    let close = container.end.saturating_sub(1).max(open);
    let outer = indent(text, container.start);
    let inner = format!("{outer}{INDENT}");
    let Some(first) = first else {
        if text[open..close].trim().is_empty() {
            let is_list = text[container.start..].starts_with('[');
            let new = if is_list {
                format!("\n{inner}{entry},\n{outer}")
            } else {
                entry.to_owned()
            };
            return vec![(Span::new(open, close), new)];
        }
        // The container has no entries, only comments.
        let offset = line_start(text, close).max(open);
        let new = if starts_line(text, close) && offset > open {
            format!("{inner}{entry},\n")
        } else {
            format!(" {entry}")
        };
        let offset = if new.starts_with(' ') && !starts_line(text, close) {
            close
        } else {
            offset
        };
        return vec![(Span::new(offset, offset), new)];
    };
    if starts_line(text, first.start) {
        let tail = tail(text, open);
        let indent = indent(text, first.start);
        let offset = if tail.ends_line { tail.end } else { open };
        return vec![(Span::new(offset, offset), format!("\n{indent}{entry},"))];
    }
    vec![(Span::new(first.start, first.start), format!("{entry}, "))]
}

/// Removes an entry, its comma, and the comment at the end of its line. Comments in the lines above the entry are not
/// removed.
pub(super) fn remove_entry(text: &str, entries: &[Span], at: usize) -> Edits {
    let entry = entries[at];
    let tail = tail(text, entry.end);
    let line = line_start(text, entry.start);
    if starts_line(text, entry.start) && tail.ends_line && line > 0 {
        return vec![(Span::new(line - 1, tail.end), String::new())];
    }
    if let Some(before) = at.checked_sub(1).filter(|_| at + 1 == entries.len()) {
        // If the last entry is removed and has no comma of its own, the comma before it is removed too.
        let comma = super::entries::tail(text, entries[before].end).comma;
        let start = if tail.comma.is_some() {
            comma
        } else {
            Some(entries[before].end)
        };
        let start = start.unwrap_or(entry.start).min(entry.start);
        let end = tail.comma.unwrap_or(entry.end);
        return vec![(Span::new(start, end), String::new())];
    }
    let end = tail.comma.unwrap_or(entry.end);
    let rest = &text[end..];
    let spaces = rest.len() - rest.trim_start_matches(' ').len();
    vec![(Span::new(entry.start, end + spaces), String::new())]
}
