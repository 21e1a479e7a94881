//! Attributes such as `#![schema = ".."]`.

use super::lexer::{Bracket, TokenKind};
use super::parser::Parser;
use crate::diagnostic::Diagnostic;

impl Parser<'_> {
    /// Reads an attribute. The token `current` is the `#` of the attribute.
    ///
    /// `#![type = ".."]` and `#![schema = ".."]` are for editors only and are ignored. These attributes must be at the
    /// start of the text. `is_start` is true if this attribute is at the start.
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
                "attributes must be at the start of the text",
                "move the attribute to the first line",
            ),
            "enable" => (
                "recipes cannot enable extensions of RON",
                "remove the attribute: `Some(..)` can always be omitted, and other extensions are not supported",
            ),
            _ => (
                "unknown attribute",
                "`#![schema = \"..\"]` and `#![type = \"..\"]` are allowed",
            ),
        };
        self.report(Diagnostic::error(span, message).with_help(help));
    }
}
