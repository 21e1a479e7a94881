//! Parses groups in brackets: fields of structs, items of lists and tuples, entries of maps.

use super::brackets::{Contents, OpenBracket};
use super::lexer::{Bracket, TokenKind};
use super::parser::{MAX_DEPTH, Parser, excerpt, starts_value};
use super::recovery::Closing;
use super::tree::{Field, Name, Struct, Value, ValueKind};
use crate::diagnostic::{Diagnostic, Span};
use std::collections::BTreeMap;

impl Parser<'_> {
    /// Parses the group whose opening bracket is the token `current`.
    pub(super) fn group(&mut self, bracket: Bracket, has_name: bool) -> Value {
        if self.open.len() >= MAX_DEPTH {
            return self.skip_group();
        }
        let start = self.current;
        let mut contents = Contents {
            bracket,
            fields: Vec::new(),
            values: Vec::new(),
            entries: Vec::new(),
            complete: true,
        };
        self.open.push(OpenBracket {
            bracket,
            span: start.span,
            has_name,
            line: start.line,
        });
        self.bump();
        self.contents(&mut contents);
        self.open.pop();
        let span = Span::new(start.span.start, self.previous_end);
        Value::new(span, self.finish(contents))
    }

    /// Parses items up to the closing bracket, and consumes the closing bracket if it exists.
    fn contents(&mut self, contents: &mut Contents) {
        loop {
            match self.current.kind {
                None => return self.ended_inside(),
                Some(TokenKind::Close(found)) => match self.closing(contents.bracket, found) {
                    Closing::Matching => {
                        self.bump();
                        return;
                    }
                    Closing::Mistyped => {
                        self.unexpected(&format!("`{}`", contents.bracket.close()));
                        contents.complete = false;
                        self.bump();
                        return;
                    }
                    Closing::Missing => {
                        self.unclosed();
                        contents.complete = false;
                        return;
                    }
                    Closing::Stray => {
                        let text = excerpt(self.current.span.of(self.source));
                        let message = format!("{text} has no matching opening bracket");
                        self.complain(Diagnostic::error(self.current.span, message));
                        self.bump();
                        self.complained_at = Some(self.current.span.start);
                        self.separator(contents);
                    }
                },
                Some(TokenKind::Comma) => {
                    self.unexpected("a value");
                    while self.take(TokenKind::Comma) {}
                }
                _ if self.belongs_outside(contents) => {
                    self.unclosed();
                    contents.complete = false;
                    return;
                }
                _ => {
                    self.item(contents);
                    self.separator(contents);
                }
            }
        }
    }

    fn item(&mut self, contents: &mut Contents) {
        if self.current.kind == Some(TokenKind::Hash) && self.next.kind == Some(TokenKind::Bang) {
            return self.attribute(false);
        }
        if !starts_value(self.current.kind) {
            self.unexpected("a value");
            self.bump();
            contents.complete = false;
            return;
        }
        match contents.bracket {
            Bracket::Round => self.round_item(contents),
            Bracket::Square => {
                let value = self.value("a value");
                contents.values.push(value);
            }
            Bracket::Curly => {
                let key = self.value("a key");
                self.colon();
                let value = self.value_after_colon(|| format!("the key {}", key.describe()));
                contents.entries.push((key, value));
            }
        }
    }

    /// Parses a field of a struct or an item of a tuple.
    fn round_item(&mut self, contents: &mut Contents) {
        use TokenKind as K;
        let quoted = self.current.kind == Some(K::String) && self.next.kind == Some(K::Colon);
        let named = quoted
            || self.current.kind == Some(K::Ident)
                && match self.next.kind {
                    Some(K::Colon | K::Equals) => true,
                    Some(K::Open(Bracket::Round)) => false,
                    // The two cases below are mistakes, but the name is still the name of a field. In `levels,` after
                    // other fields, the colon and the value are missing. In `levels 3`, only the colon is missing.
                    Some(K::Comma | K::Close(_)) => !contents.fields.is_empty(),
                    next => starts_value(next) && contents.values.is_empty(),
                };
        let mixed = if named {
            !contents.values.is_empty()
        } else {
            !contents.fields.is_empty()
        };
        if mixed && contents.complete {
            let message = "named and unnamed values cannot be mixed";
            let help = "write parameters as `name: value`";
            self.complain(Diagnostic::error(self.current.span, message).with_help(help));
            contents.complete = false;
        }
        if !named {
            let value = self.value("a value");
            contents.values.push(value);
            return;
        }
        if quoted {
            let message = "field names are written without quotes";
            self.complain(Diagnostic::error(self.current.span, message));
        }
        let name = match self.current.kind {
            Some(K::String) => {
                let span = self.bump().span;
                Name {
                    span,
                    text: span.of(self.source).trim_matches('"').into(),
                }
            }
            _ => self.name(),
        };
        let value = if matches!(self.current.kind, Some(K::Comma | K::Close(_))) {
            self.missing(&format!("the value of `{}`", name.text));
            self.missing_value()
        } else {
            self.colon();
            self.value_after_colon(|| format!("`{}`", name.text))
        };
        if contents.fields.is_empty() {
            // Most steps have one parameter. The default capacity of 4 would waste memory in recipes with many steps.
            contents.fields.reserve_exact(1);
        }
        contents.fields.push(Field { name, value });
    }

    /// Consumes a colon, or reports that it is missing.
    fn colon(&mut self) {
        match self.current.kind {
            Some(TokenKind::Colon) => {
                self.bump();
            }
            Some(TokenKind::Equals) => {
                self.unexpected("`:`");
                self.bump();
            }
            kind if starts_value(kind) => self.missing("`:`"),
            _ => self.unexpected("`:`"),
        }
    }

    fn value_after_colon(&mut self, of: impl Fn() -> String) -> Value {
        while matches!(
            self.current.kind,
            Some(TokenKind::Colon | TokenKind::Equals)
        ) {
            self.unexpected(&format!("the value of {}", of()));
            self.bump();
        }
        let is_next_field = self.current.kind == Some(TokenKind::Ident)
            && self.next.kind == Some(TokenKind::Colon)
            && self
                .open
                .last()
                .is_some_and(|open| open.bracket == Bracket::Round);
        if is_next_field || !starts_value(self.current.kind) {
            self.missing(&format!("the value of {}", of()));
            return self.missing_value();
        }
        self.value("a value")
    }

    /// Consumes the comma between two items, or reports that it is missing.
    fn separator(&mut self, contents: &mut Contents) {
        use TokenKind as K;
        loop {
            match self.current.kind {
                Some(K::Comma) => {
                    self.bump();
                    return;
                }
                None | Some(K::Close(_)) => return,
                _ if self.belongs_outside(contents) => return,
                Some(K::Colon | K::Equals | K::Semicolon | K::Hash | K::Bang) => {
                    let close = contents.bracket.close();
                    self.unexpected(&format!("`,` or `{close}`"));
                    let pairs = matches!(self.bump().kind, Some(K::Colon | K::Equals));
                    contents.complete = false;
                    if !pairs || !starts_value(self.current.kind) {
                        return;
                    }
                    // In `[a: 1]`, only the colon is reported as an error. The missing comma before the 1 is not
                    // reported.
                    self.value("a value");
                }
                _ => return self.missing("`,`"),
            }
        }
    }

    fn finish(&mut self, contents: Contents) -> ValueKind {
        let Contents {
            bracket,
            fields,
            mut values,
            entries,
            complete,
        } = contents;
        if !complete && (bracket == Bracket::Square || !values.is_empty()) {
            // Some items could not be read, so the number of items is unknown. The error value stands for the items
            // that could not be read.
            values.push(self.missing_value());
        }
        let has_fields = !fields.is_empty();
        if fields.len() > 1 {
            self.refuse_duplicates(fields.iter().map(|f| (&*f.name.text, f.name.span)), "field");
        }
        let keys = entries
            .iter()
            .filter_map(|(key, _)| Some((key.as_str()?, key.span)));
        self.refuse_duplicates(keys, "key");
        match bracket {
            Bracket::Square => ValueKind::List(values),
            Bracket::Curly => ValueKind::Map(entries),
            Bracket::Round if has_fields || !complete && values.is_empty() => {
                ValueKind::Struct(Struct { fields, complete })
            }
            Bracket::Round if values.is_empty() => ValueKind::Unit,
            Bracket::Round => ValueKind::Tuple(values),
        }
    }

    fn refuse_duplicates<'n>(&mut self, names: impl Iterator<Item = (&'n str, Span)>, what: &str) {
        let mut first_places = BTreeMap::new();
        for (name, span) in names {
            let first = *first_places.entry(name).or_insert(span);
            if first != span {
                let message = format!("the {what} `{}` is given twice", name.escape_debug());
                self.report(Diagnostic::error(span, message).with_label(first, "first given here"));
            }
        }
    }

    /// Skips a group that is nested too deeply.
    fn skip_group(&mut self) -> Value {
        let start = self.current.span;
        if !self.too_deep {
            self.too_deep = true;
            let message = format!("brackets are nested more than {MAX_DEPTH} levels deep");
            self.report(Diagnostic::error(start, message));
        }
        let mut depth = 0_usize;
        loop {
            match self.bump().kind {
                Some(TokenKind::Open(_)) => depth += 1,
                Some(TokenKind::Close(_)) => depth -= 1,
                None => break,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        Value::new(Span::new(start.start, self.previous_end), ValueKind::Error)
    }

    fn unclosed(&mut self) {
        if let Some(open) = self.open.last() {
            let message = format!("this `{}` is not closed", open.bracket.open());
            let help = format!("`{}` is missing", open.bracket.close());
            let diagnostic = Diagnostic::error(open.span, message)
                .with_label(self.gap(), "probably here")
                .with_help(help);
            self.report(diagnostic);
            self.complained_at = Some(self.current.span.start);
        }
    }

    /// Reports, once, that the text ends inside brackets.
    fn ended_inside(&mut self) {
        let Some((innermost, others)) = self.open.split_last() else {
            return;
        };
        let message = format!(
            "the text ends before this `{}` is closed",
            innermost.bracket.open()
        );
        let mut diagnostic = Diagnostic::error(innermost.span, message);
        for open in others.iter().rev().take(3) {
            let text = format!("and this `{}`", open.bracket.open());
            diagnostic = diagnostic.with_label(open.span, text);
        }
        // The groups around this one also end at this token, but `complain` reports only the first error about the
        // token `current`.
        self.complain(diagnostic);
    }
}
