//! Groups in brackets while they are being parsed.

use super::lexer::Bracket;
use super::tree::{Field, Value};
use crate::diagnostic::Span;

/// A bracket that is not closed yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenBracket {
    pub(super) bracket: Bracket,
    pub(super) span: Span,
    /// Whether a name precedes the bracket, as in `Name(`.
    pub(super) has_name: bool,
    /// The number of line feeds in the text before the bracket.
    pub(super) line: usize,
}

/// The contents of a group in brackets.
pub(super) struct Contents {
    pub(super) bracket: Bracket,
    pub(super) fields: Vec<Field>,
    pub(super) values: Vec<Value>,
    pub(super) entries: Vec<(Value, Value)>,
    /// Whether all items that were parsed so far could be read.
    pub(super) complete: bool,
}

impl Contents {
    /// Whether the group seems to be a tuple: the group is in round brackets, and all of its items so far are values
    /// without names.
    pub(super) fn is_tuple(&self) -> bool {
        self.bracket == Bracket::Round && self.fields.is_empty() && !self.values.is_empty()
    }
}
