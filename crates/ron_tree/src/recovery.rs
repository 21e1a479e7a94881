//! Error recovery: guesses which bracket is missing or mistyped.
//!
//! ```text
//! steps: [
//!     FlipEdges(edges: Vertices([1, 2)),     the `]` is missing: the other brackets match without it
//!     Load(path: "a.bez"],                   the `]` should be a `)`
//!     Weld(distance: 0.1)),                  the second `)` has no matching bracket
//!     Tessellate(segments: 8,                the `)` is missing: the next line starts a new step
//!     Save(path: "a.obj"),
//! ]
//! ```

use super::brackets::Contents;
use super::lexer::{Bracket, TokenKind};
use super::parser::{Lexeme, Parser};

/// How a closing bracket relates to the innermost open bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Closing {
    /// The closing bracket matches the innermost open bracket.
    Matching,
    /// The closing bracket is mistyped. It was meant to close the innermost open bracket, but has a different kind.
    Mistyped,
    /// The closing bracket matches an outer open bracket, so the closing bracket of the innermost open bracket is
    /// missing.
    Missing,
    /// The closing bracket has no matching open bracket.
    Stray,
}

impl Parser<'_> {
    /// The token `current` is a closing bracket of kind `found`. Guesses how this bracket relates to the innermost open
    /// bracket, of kind `innermost_kind`.
    pub(super) fn closing(&self, innermost_kind: Bracket, found: Bracket) -> Closing {
        if found == innermost_kind {
            return Closing::Matching;
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
        let has_same_indent = indent == self.indent(innermost.span.start);
        match partner {
            None if self.current.starts_line && !has_same_indent => Closing::Stray,
            None => Closing::Mistyped,
            Some(partner) if partner.line == line => {
                // Brackets that open in a line are usually closed in that line.
                let n_open = self.open.iter().filter(|open| open.line == line).count();
                if self.closing_run() >= n_open {
                    Closing::Mistyped
                } else {
                    Closing::Missing
                }
            }
            Some(_) if !self.current.starts_line => Closing::Mistyped,
            Some(partner) => {
                if has_same_indent && indent != self.indent(partner.span.start) {
                    Closing::Mistyped
                } else {
                    Closing::Missing
                }
            }
        }
    }

    /// Whether the token `current` seems to start an item of an outer group. If so, the closing bracket of the
    /// innermost group is missing.
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
            // A tuple has no named fields, so a name at `current` starts a field of the enclosing struct.
            Bracket::Round if contents.is_tuple() && names_field => !innermost.has_name && in_round,
            _ if !starts_line => false,
            // A value without a name cannot follow named fields. It is an item of the enclosing list, and the closing
            // bracket of the struct is missing.
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
            // A list has no named fields, so a name at `current` starts a field of the enclosing struct.
            Bracket::Square => names_field && in_round,
            Bracket::Curly => false,
        }
    }

    /// Returns the number of consecutive closing brackets, beginning with the token `current`.
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

    /// Returns the indentation of the line that contains the byte at `offset`.
    fn indent(&self, offset: usize) -> &str {
        let before = &self.source[..offset];
        let line = &self.source[before.rfind('\n').map_or(0, |feed| feed + 1)..];
        &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
    }
}
