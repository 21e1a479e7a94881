//! Attributes: `#![schema = ".."]` and their like.

use super::lexer::{Bracket, TokenKind};
use super::parser::Parser;
use crate::diagnostic::Diagnostic;

impl Parser<'_> {
    /// Reads an attribute, whose `#` is `current`.
    ///
    /// `#![type = ".."]` and `#![schema = ".."]` say something to editors only; they stand at the
    /// start of the text, as `is_start` says of this one.
    pub(super) fn attribute(&mut self, is_start: bool) {
        let start = self.bump().span;
        let bang = self.take(TokenKind::Bang);
        if !bang || self.current.kind != Some(TokenKind::Open(Bracket::Square)) {
            self.unexpected("an attribute `#![..]`");
            return;
        }
        self.bump();
        let name = self.bump().span.of(self.source);
        let strings = [Some(TokenKind::String), Some(TokenKind::RawString)];
        let has_text = self.take(TokenKind::Equals) && strings.contains(&self.current.kind);
        while !matches!(
            self.current.kind,
            None | Some(TokenKind::Close(Bracket::Square))
        ) {
            self.bump();
        }
        let span = start.to(self.bump().span);
        let (message, help) = match name {
            "type" | "schema" if has_text && is_start => return,
            "type" | "schema" if has_text => (
                "attributes stand at the start of the text",
                "move it to the first line",
            ),
            "enable" => (
                "recipes do not choose extensions of RON",
                "remove it: `Some(..)` may always be left out, and no other extension is used",
            ),
            _ => (
                "unknown attribute",
                "`#![schema = \"..\"]` and `#![type = \"..\"]` are allowed",
            ),
        };
        self.report(Diagnostic::error(span, message).with_help(help));
    }
}
