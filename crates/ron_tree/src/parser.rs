//! Parses a source text into a tree of values. A source text with errors also becomes a tree.
//!
//! A mistake usually gives one diagnostic, and parsing continues after it. To recover from a bracket error, the parser
//! assumes that only one bracket is missing or mistyped. The parser also assumes that line breaks and indentation are
//! right, and that each item of a list starts on its own line. The module [`recovery`](super::recovery) implements the
//! recovery.

use super::brackets::OpenBracket;
use super::lexer::{Bracket, Lexer, Token, TokenKind};
use super::literal::{self, BadLiteral, Number};
use super::tree::{Call, Name, Value, ValueKind};
use crate::diagnostic::{Diagnostic, Span};

/// The maximum length of a source text, in bytes.
pub const MAX_BYTES: usize = 64 << 20;

/// The maximum nesting depth of brackets.
pub const MAX_DEPTH: usize = 128;

/// The maximum number of values in a source text. Each value takes about a hundred bytes of memory.
pub const MAX_VALUES: usize = 4 << 20;

/// The maximum number of errors that are reported. If there are more errors, one more diagnostic says so, and parsing
/// stops.
const MAX_DIAGNOSTICS: usize = 100;

/// A parsed text.
#[derive(Clone, Debug, PartialEq)]
pub struct Parsed {
    /// The value. Parts that could not be read are [`ValueKind::Error`].
    pub value: Value,
    /// The errors, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// Parses a source text that contains one value.
///
/// The attributes `#![type = ".."]` and `#![schema = ".."]` can precede the value. Takes time and memory proportional
/// to the length of the text. Exceeding [`MAX_BYTES`], [`MAX_VALUES`] or [`MAX_DEPTH`] is an error.
pub fn parse(source: &str) -> Parsed {
    if source.len() > MAX_BYTES {
        let message = format!(
            "the text has {} bytes, expected at most {MAX_BYTES}",
            source.len()
        );
        let diagnostics = vec![Diagnostic::without_place(message)];
        return Parsed {
            value: Value::new(Span::default(), ValueKind::Error),
            diagnostics,
        };
    }
    let mut parser = Parser::new(source);
    while parser.current.kind == Some(TokenKind::Hash) {
        parser.attribute(true);
    }
    let value = parser.value("a value");
    if parser.current.kind.is_some() {
        parser.unexpected("the end of the text");
    }
    let mut diagnostics = parser.diagnostics;
    diagnostics.sort_by_key(|d| d.span);
    Parsed { value, diagnostics }
}

/// A token that is neither whitespace nor a comment, or the end of the text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lexeme {
    /// The kind of the token, or `None` at the end of the text.
    pub(super) kind: Option<TokenKind>,
    pub(super) span: Span,
    /// The number of line feeds before the token.
    pub(super) line: usize,
    /// Whether the token is the first of its line.
    pub(super) starts_line: bool,
    /// Whether invalid characters or an unclosed comment before the token were reported and skipped.
    after_invalid: bool,
}

pub(super) struct Parser<'s> {
    pub(super) source: &'s str,
    pub(super) lexer: Lexer<'s>,
    pub(super) current: Lexeme,
    pub(super) next: Lexeme,
    /// The end of the last token before the token `current`.
    pub(super) previous_end: usize,
    /// The open brackets around the token `current`, outermost first.
    pub(super) open: Vec<OpenBracket>,
    diagnostics: Vec<Diagnostic>,
    /// The start of the token that the last error is about. No second error is reported about this token.
    pub(super) complained_at: Option<usize>,
    values: usize,
    pub(super) too_deep: bool,
    /// Whether parsing stopped before the end of the text.
    stopped: bool,
}

impl<'s> Parser<'s> {
    fn new(source: &'s str) -> Self {
        let start = Lexeme {
            kind: None,
            span: Span::new(0, 0),
            line: 0,
            starts_line: true,
            after_invalid: false,
        };
        let mut parser = Self {
            source,
            lexer: Lexer::new(source),
            current: start,
            next: start,
            previous_end: 0,
            open: Vec::new(),
            diagnostics: Vec::new(),
            complained_at: None,
            values: 0,
            too_deep: false,
            stopped: false,
        };
        parser.current = parser.lexeme();
        parser.next = parser.current;
        parser.next = parser.lexeme();
        parser
    }

    /// Consumes the token `current` and returns it. At the end of the text, nothing is consumed.
    pub(super) fn bump(&mut self) -> Lexeme {
        let consumed = self.current;
        if consumed.kind.is_some() {
            self.previous_end = consumed.span.end;
            self.current = self.next;
            self.next = self.lexeme();
        }
        consumed
    }

    /// Reads the lexeme (a token that is neither whitespace nor a comment) after `next`.
    fn lexeme(&mut self) -> Lexeme {
        if self.next.kind.is_none() && self.next.span.end > 0 {
            return self.next;
        }
        let last_end = self.next.span.end;
        let mut line = self.next.line + line_feeds(self.next.span.of(self.source));
        let (mut starts_line, mut after_invalid) = (last_end == 0, false);
        let (kind, span) = loop {
            let Some(Token { kind, span }) = self.lexer.next() else {
                break (None, Span::new(self.source.len(), self.source.len()));
            };
            let feeds = line_feeds(span.of(self.source));
            match kind {
                kind if kind.is_trivia() => starts_line |= feeds > 0,
                TokenKind::Unknown => {
                    let text = excerpt(span.of(self.source));
                    self.report(Diagnostic::error(span, format!("unexpected {text}")));
                    after_invalid = true;
                }
                TokenKind::UnclosedComment => {
                    let start = Span::new(span.start, span.start + 2);
                    self.report(
                        Diagnostic::error(start, "this comment is not closed")
                            .with_help("end it with `*/`"),
                    );
                    // The unclosed comment can cause further errors at the end of the text, so these are not reported.
                    after_invalid = true;
                }
                _ => break (Some(kind), span),
            }
            line += feeds;
        };
        Lexeme {
            kind,
            span,
            line,
            starts_line,
            after_invalid,
        }
    }

    /// Reports an error that is not about the token `current`.
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        if self.stopped {
            return;
        }
        if self.diagnostics.len() < MAX_DIAGNOSTICS {
            self.diagnostics.push(diagnostic);
        } else {
            self.stop("too many errors: the rest of the text was not read");
        }
    }

    /// Reports an error about the token `current`, unless an error about this token was already reported.
    pub(super) fn complain(&mut self, diagnostic: Diagnostic) {
        let start = self.current.span.start;
        // The function `value` always reports an unclosed string or a bad character, so no other error is reported
        // about such a token.
        let is_bad = matches!(
            self.current.kind,
            Some(TokenKind::UnclosedString | TokenKind::BadChar)
        );
        if self.complained_at != Some(start) && !self.current.after_invalid && !is_bad {
            self.report(diagnostic);
        }
        self.complained_at = Some(start);
    }

    pub(super) fn unexpected(&mut self, expected: &str) {
        let found = match self.current.kind {
            None => "the end of the text".to_owned(),
            Some(_) => excerpt(self.current.span.of(self.source)),
        };
        let message = format!("expected {expected}, found {found}");
        self.complain(Diagnostic::error(self.current.span, message));
    }

    /// Reports that something is missing before the token `current`.
    pub(super) fn missing(&mut self, what: &str) {
        self.complain(Diagnostic::error(self.gap(), format!("missing {what}")));
    }

    /// Returns the empty span at the end of the last token before the token `current`.
    pub(super) fn gap(&self) -> Span {
        Span::new(self.previous_end, self.previous_end)
    }

    /// Returns an error value in place of a value that is missing before the token `current`.
    pub(super) fn missing_value(&self) -> Value {
        Value::new(self.gap(), ValueKind::Error)
    }

    /// Stops parsing with an error.
    fn stop(&mut self, message: &str) {
        if !self.stopped {
            self.stopped = true;
            self.diagnostics
                .push(Diagnostic::error(self.current.span, message));
        }
        let end = Span::new(self.source.len(), self.source.len());
        self.lexer = Lexer::new("");
        self.next = Lexeme {
            kind: None,
            span: end,
            ..self.next
        };
        self.current = self.next;
    }

    /// If the token `current` has this kind, consumes it and returns `true`. Otherwise, returns `false`.
    pub(super) fn take(&mut self, kind: TokenKind) -> bool {
        let found = self.current.kind == Some(kind);
        if found {
            self.bump();
        }
        found
    }

    /// Parses a value. If no value starts with the token `current`, reports an error and consumes nothing.
    pub(super) fn value(&mut self, expected: &str) -> Value {
        use TokenKind as K;
        self.values += 1;
        if self.values > MAX_VALUES {
            self.stop("too many values: the rest of the text was not read");
        }
        let Lexeme { kind, span, .. } = self.current;
        let text = span.of(self.source);
        let kind = match kind {
            Some(K::Open(bracket)) => return self.group(bracket, false),
            Some(K::Ident) if self.next.kind == Some(K::Open(Bracket::Round)) => {
                let name = self.name();
                let body = self.group(Bracket::Round, true);
                return Value::new(
                    span.to(body.span),
                    ValueKind::Call(Box::new(Call { name, body })),
                );
            }
            Some(K::Ident) => match text {
                "true" => ValueKind::Bool(true),
                "false" => ValueKind::Bool(false),
                "inf" | "NaN" => ValueKind::Number(Number::Float(text.into())),
                _ => ValueKind::Name(literal::name(text).into()),
            },
            Some(K::Number) => match Number::parse(text) {
                Some(number) => ValueKind::Number(number),
                None => self.bad_number(span),
            },
            Some(K::String) => match literal::unescape_string(text) {
                Ok(text) => ValueKind::String(text.into()),
                Err(error) => self.bad_literal(span, &error),
            },
            Some(K::RawString) => ValueKind::String(literal::raw_string(text).into()),
            Some(K::Char) => match literal::unescape_char(text) {
                Ok(c) => ValueKind::Char(c),
                Err(error) => self.bad_literal(span, &error),
            },
            Some(K::Bytes) => {
                let message = "byte strings are not supported in recipes";
                self.report(Diagnostic::error(span, message));
                ValueKind::Error
            }
            Some(K::BadChar) => {
                let help = "write strings in double quotes: `\"..\"`";
                let message = "more than one character in single quotes";
                self.report(Diagnostic::error(span, message).with_help(help));
                ValueKind::Error
            }
            Some(K::UnclosedString) => {
                let first_line = Span::new(
                    span.start,
                    span.start + text.find('\n').unwrap_or(text.len()),
                );
                self.report(Diagnostic::error(
                    first_line,
                    "this string has no closing quote",
                ));
                ValueKind::Error
            }
            _ => {
                self.unexpected(expected);
                return self.missing_value();
            }
        };
        self.bump();
        Value::new(span, kind)
    }

    fn bad_number(&mut self, span: Span) -> ValueKind {
        let text = excerpt(span.of(self.source));
        let help = "write numbers as 7, 1_000, 0.5, -3 or 1e-6, without a unit or a type suffix";
        self.report(Diagnostic::error(span, format!("{text} is not a number")).with_help(help));
        ValueKind::Error
    }

    fn bad_literal(&mut self, literal: Span, error: &BadLiteral) -> ValueKind {
        let span = Span::new(
            literal.start + error.span.start,
            literal.start + error.span.end,
        );
        self.report(Diagnostic::error(span, error.message));
        ValueKind::Error
    }

    pub(super) fn name(&mut self) -> Name {
        let span = self.bump().span;
        Name {
            span,
            text: literal::name(span.of(self.source)).into(),
        }
    }
}

/// Whether a value, valid or not, can start with a token of this kind.
pub(super) fn starts_value(kind: Option<TokenKind>) -> bool {
    use TokenKind as K;
    matches!(
        kind,
        Some(
            K::Open(_)
                | K::Ident
                | K::Number
                | K::String
                | K::RawString
                | K::Char
                | K::Bytes
                | K::BadChar
                | K::UnclosedString
        )
    )
}

/// Returns the start of the first line of `text`, in backticks.
pub(super) fn excerpt(text: &str) -> String {
    let line = text.lines().next().unwrap_or("");
    let mut shown: String = line.chars().take(20).flat_map(char::escape_debug).collect();
    if line.chars().nth(20).is_some() {
        shown += "..";
    }
    format!("`{shown}`")
}

fn line_feeds(text: &str) -> usize {
    text.bytes().filter(|&b| b == b'\n').count()
}
