//! Guesses which bracket was forgotten or mistyped.
//!
//! ```text
//! steps: [
//!     FlipEdges(edges: Vertices([1, 2)),     the `]` is missing: the others pair up without it
//!     Load(path: "a.bez"],                   the `]` stands for a `)`
//!     Weld(distance: 0.1)),                  the second `)` is one too many
//!     Tessellate(segments: 8,                the `)` is missing: a step starts on a line
//!     Save(path: "a.obj"),
//! ]
//! ```

use super::group::Contents;
use super::lexer::{Bracket, TokenKind};
use super::parser::{Lexeme, Parser};
use crate::diagnostic::Span;

/// A bracket that is not closed yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenBracket {
    pub(super) bracket: Bracket,
    pub(super) span: Span,
    /// Whether a name stands before it.
    pub(super) has_name: bool,
    /// The number of line feeds before it.
    pub(super) line: usize,
}

/// What a closing bracket is to the innermost open one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Closing {
    /// It closes it.
    Ours,
    /// It was meant to close it.
    Mistyped,
    /// It closes one further out: the innermost one was not closed.
    Missing,
    /// It is one too many.
    Stray,
}

impl Parser<'_> {
    /// What the closing bracket at `current` is to the innermost open bracket.
    pub(super) fn closing(&self, ours: Bracket, found: Bracket) -> Closing {
        if found == ours {
            return Closing::Ours;
        }
        let Some((innermost, outer)) = self.open.split_last() else {
            return Closing::Stray;
        };
        let line = self.current.line;
        let partner = outer.iter().rev().find(|open| open.bracket == found);
        if innermost.line != line && !self.current.starts_line {
            return Closing::Stray;
        }
        let indent = self.indent(self.current.span.start);
        let as_ours = indent == self.indent(innermost.span.start);
        match partner {
            None if self.current.starts_line && !as_ours => Closing::Stray,
            None => Closing::Mistyped,
            Some(partner) if partner.line == line => {
                // Brackets of one line usually close in that line.
                let to_close = self.open.iter().filter(|open| open.line == line).count();
                if self.closing_run() >= to_close {
                    Closing::Mistyped
                } else {
                    Closing::Missing
                }
            }
            Some(_) if !self.current.starts_line => Closing::Mistyped,
            Some(partner) => {
                if as_ours && indent != self.indent(partner.span.start) {
                    Closing::Mistyped
                } else {
                    Closing::Missing
                }
            }
        }
    }

    /// Whether `current` starts an item of a bracket further out, so that the innermost one was
    /// not closed.
    pub(super) fn belongs_outside(&self, contents: &Contents) -> bool {
        let Lexeme {
            kind, starts_line, ..
        } = self.current;
        let is_ident = kind == Some(TokenKind::Ident);
        let next_opens = self.next.kind == Some(TokenKind::Open(Bracket::Round));
        let Some((innermost, outer)) = self.open.split_last() else {
            return false;
        };
        let names_field = is_ident && self.next.kind == Some(TokenKind::Colon);
        let in_round = outer
            .last()
            .is_some_and(|open| open.bracket == Bracket::Round);
        match contents.bracket {
            // In a tuple without a name, the next field of the struct around it.
            Bracket::Round if contents.is_tuple() && names_field => !innermost.has_name && in_round,
            _ if !starts_line => false,
            // Among named fields, the next step of the list around them.
            Bracket::Round => {
                !contents.fields.is_empty()
                    && (kind == Some(TokenKind::Open(Bracket::Round)) || is_ident && next_opens)
                    && outer
                        .iter()
                        .rev()
                        .find(|open| open.bracket != Bracket::Round)
                        .is_some_and(|open| {
                            open.bracket == Bracket::Square && open.line < self.current.line
                        })
            }
            // In a list, the next field of the struct around it.
            Bracket::Square => names_field && in_round,
            Bracket::Curly => false,
        }
    }

    /// The number of closing brackets from `current` on, without anything between them.
    fn closing_run(&self) -> usize {
        let closes = |kind| matches!(kind, Some(TokenKind::Close(_)));
        if !closes(self.next.kind) {
            return 1;
        }
        let rest = self
            .lexer
            .clone()
            .map(|t| t.kind)
            .filter(|kind| *kind != TokenKind::Whitespace);
        2 + rest.take_while(|&kind| closes(Some(kind))).count()
    }

    /// The white space at the start of the line that the byte `at` stands on.
    fn indent(&self, at: usize) -> &str {
        let before = &self.source[..at];
        let line = &self.source[before.rfind('\n').map_or(0, |feed| feed + 1)..];
        &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
    }
}
