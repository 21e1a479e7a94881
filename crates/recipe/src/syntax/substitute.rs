//! Puts the values of parameters in place of `arg("name")`.
//!
//! ```text
//! source   Tessellate(segments: arg("segments") /* per patch */)
//!                               ^^^^^^^^^^^^^^^
//! text     Tessellate(segments: 8 /* per patch */)
//!                               ^
//! ```

use super::parser::parse;
use super::tree::{Call, Value, ValueKind};
use crate::diagnostic::{Diagnostic, LineIndex, Span};

/// A value of a recipe with its parameters filled in.
#[derive(Clone, Debug)]
pub struct Substituted {
    /// The value. Its spans point into the source; what was put in for an `arg(..)` has the span
    /// of that, and the name of its parameter.
    pub value: Value,
    /// The text of the value with the literals put in, for `ron`.
    pub text: String,
    /// The pieces of the text that differ from the source, in order.
    pieces: Vec<Piece>,
    /// Where the text starts in the source.
    start: usize,
}

/// A literal that was put in.
#[derive(Clone, Debug)]
struct Piece {
    /// Where in the text.
    inserted: Span,
    /// The `arg(..)` in the source.
    original: Span,
}

/// Fills the parameters in `value` in: `resolve` gives the RON literal of a parameter.
///
/// `value` was read from `source`. `resolve` gets the name of the parameter and the place of that
/// name.
///
/// # Errors
///
/// What `resolve` says of each parameter, and an error for each `arg` that names none.
pub fn substitute(
    source: &str,
    value: &Value,
    mut resolve: impl FnMut(&str, Span) -> Result<String, Box<Diagnostic>>,
) -> Result<Substituted, Vec<Diagnostic>> {
    let mut literals = Vec::new();
    let mut diagnostics = Vec::new();
    let mut replaced = value.clone();
    fill(
        &mut replaced,
        &mut |call: &Call, span| match literal(call, span, &mut resolve) {
            Ok((text, value)) => {
                literals.push((span, text));
                Some(value)
            }
            Err(diagnostic) => {
                diagnostics.push(*diagnostic);
                None
            }
        },
    );
    if !diagnostics.is_empty() {
        return Err(diagnostics);
    }

    let mut substituted = Substituted {
        value: replaced,
        text: String::new(),
        pieces: Vec::new(),
        start: value.span.start,
    };
    let mut at = value.span.start;
    for (original, literal) in literals {
        substituted.text += Span::new(at, original.start).of(source);
        let start = substituted.text.len();
        substituted.text += &literal;
        let inserted = Span::new(start, substituted.text.len());
        substituted.pieces.push(Piece { inserted, original });
        at = original.end;
    }
    substituted.text += Span::new(at, value.span.end).of(source);
    Ok(substituted)
}

impl Substituted {
    /// The place in the source of a place in the text.
    ///
    /// A place in a literal that was put in is the `arg(..)` that it was put in for.
    pub fn original(&self, span: Span) -> Span {
        let start = self.original_offset(span.start, |original| original.start);
        let last = span.end.max(span.start + 1) - 1;
        let end = self.original_offset(last, |original| original.end - 1) + 1;
        Span::new(start, if span.is_empty() { start } else { end })
    }

    /// The place in the source of an error that `ron` found in the text.
    pub fn original_of_ron(&self, span: &ron::error::Span) -> Span {
        let lines = LineIndex::new(&self.text);
        let start = lines.offset(span.start.line, span.start.col);
        let end = lines.offset(span.end.line, span.end.col).max(start);
        // The span of `ron` starts with the white space before what it could not read.
        let blank = Span::new(start, end).of(&self.text);
        let start = start + (blank.len() - blank.trim_start().len());
        self.original(Span::new(start, end))
    }

    /// The byte of the source for a byte of the text; `inside` picks one of an `arg(..)`.
    fn original_offset(&self, offset: usize, inside: impl Fn(Span) -> usize) -> usize {
        let passed = self
            .pieces
            .partition_point(|piece| piece.inserted.start <= offset);
        match passed.checked_sub(1).map(|i| &self.pieces[i]) {
            None => self.start + offset,
            Some(piece) if offset < piece.inserted.end => inside(piece.original),
            Some(piece) => piece.original.end + (offset - piece.inserted.end),
        }
    }
}

/// Replaces the calls of `arg` in `value`, in the order of the text.
fn fill(value: &mut Value, replacement: &mut impl FnMut(&Call, Span) -> Option<Value>) {
    match &mut value.kind {
        ValueKind::Call(call) if &*call.name.text == "arg" => {
            if let Some(filled) = replacement(call, value.span) {
                *value = filled;
            }
        }
        ValueKind::Call(call) => fill(&mut call.body, replacement),
        ValueKind::Struct(body) => {
            for field in &mut body.fields {
                fill(&mut field.value, replacement);
            }
        }
        ValueKind::Tuple(items) | ValueKind::List(items) => {
            for item in items {
                fill(item, replacement);
            }
        }
        ValueKind::Map(entries) => {
            for (key, value) in entries {
                fill(key, replacement);
                fill(value, replacement);
            }
        }
        _ => {}
    }
}

/// The literal for one `arg(..)`, as text and as a value.
fn literal(
    call: &Call,
    span: Span,
    resolve: &mut impl FnMut(&str, Span) -> Result<String, Box<Diagnostic>>,
) -> Result<(String, Value), Box<Diagnostic>> {
    let Some((name, name_span)) = call.body.single().and_then(|v| Some((v.as_str()?, v.span)))
    else {
        let message = "expected the name of one parameter of the recipe in `arg(..)`";
        let error = Diagnostic::error(span, message).with_help("write `arg(\"name\")`");
        return Err(error.into());
    };
    let text = resolve(name, name_span)?;
    let parsed = parse(&text);
    if let Some(problem) = parsed.diagnostics.first() {
        let message = format!(
            "the value of parameter `{name}` is no RON: {}",
            problem.message
        );
        return Err(Diagnostic::error(span, message).into());
    }
    let mut value = parsed.value;
    mark(&mut value, span, name);
    // The literal alone, without comments that could swallow what follows.
    let text = value.to_string();
    Ok((text, value))
}

/// Gives all parts of a value the place of the `arg(..)` and the name of its parameter.
fn mark(value: &mut Value, span: Span, parameter: &str) {
    value.span = span;
    value.parameter = Some(parameter.into());
    match &mut value.kind {
        ValueKind::Call(call) => {
            call.name.span = span;
            mark(&mut call.body, span, parameter);
        }
        ValueKind::Struct(body) => {
            for field in &mut body.fields {
                field.name.span = span;
                mark(&mut field.value, span, parameter);
            }
        }
        ValueKind::Tuple(items) | ValueKind::List(items) => {
            for item in items {
                mark(item, span, parameter);
            }
        }
        ValueKind::Map(entries) => {
            for (key, value) in entries {
                mark(key, span, parameter);
                mark(value, span, parameter);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::to_json;
    use serde_json::json;

    const SOURCE: &str = "[Grid(x: arg(\"n\"), /* é */ y: [arg(\"size\"), 3])]";

    fn filled() -> Substituted {
        let list = parse(SOURCE).value;
        let step = &list.items().unwrap()[0];
        substitute(SOURCE, step, |name, _| match name {
            "n" => Ok("8".to_owned()),
            "size" => Ok("(1, 0.5)".to_owned()),
            _ => unreachable!(),
        })
        .unwrap()
    }

    #[test]
    fn literals_take_the_place_of_the_calls() {
        let filled = filled();

        assert_eq!(filled.text, "Grid(x: 8, /* é */ y: [(1, 0.5), 3])");
        assert_eq!(
            to_json(&filled.value),
            json!({"Grid": {"x": 8, "y": [[1, 0.5], 3]}})
        );
        assert_eq!(to_json(&parse(&filled.text).value), to_json(&filled.value));
    }

    #[test]
    fn a_value_remembers_its_parameter() {
        let filled = filled();
        let x = filled.value.field("x").unwrap();

        assert_eq!(x.parameter.as_deref(), Some("n"));
        assert_eq!(x.span.of(SOURCE), "arg(\"n\")");
        assert_eq!(filled.value.field("y").unwrap().parameter, None);
    }

    #[test]
    fn places_in_the_text_lead_back_to_the_source() {
        let filled = filled();
        let back = |part: &str| {
            let start = filled.text.find(part).unwrap();
            filled
                .original(Span::new(start, start + part.len()))
                .of(SOURCE)
        };

        assert_eq!(back("x"), "x");
        assert_eq!(back("8"), "arg(\"n\")");
        assert_eq!(back("0.5"), "arg(\"size\")");
        assert_eq!(back("3"), "3");
        assert_eq!(back("y: [(1"), "y: [arg(\"size\")");
        assert_eq!(back("Grid(x: 8,"), "Grid(x: arg(\"n\"),");
    }

    #[test]
    fn an_error_of_ron_is_found_in_the_source() {
        #[derive(Debug, serde::Deserialize)]
        #[expect(dead_code, reason = "only read")]
        struct Grid {
            x: u32,
            y: bool,
        }
        let filled = filled();

        let error = ron::from_str::<Grid>(&filled.text).unwrap_err();

        assert_eq!(
            filled.original_of_ron(&error.span).start,
            SOURCE.find("[arg").unwrap()
        );
    }

    #[test]
    fn every_bad_parameter_is_reported() {
        let source = "(a: arg(\"x\"), b: arg(), c: arg(x), d: arg(\"bad\"))";
        let value = parse(source).value;

        let errors = substitute(source, &value, |name, span| match name {
            "bad" => Ok("[1".to_owned()),
            _ => Err(Diagnostic::error(span, "no such parameter").into()),
        })
        .unwrap_err();

        let places: Vec<&str> = errors.iter().map(|e| e.span.unwrap().of(source)).collect();
        assert_eq!(places, ["\"x\"", "arg()", "arg(x)", "arg(\"bad\")"]);
    }

    #[test]
    fn no_literal_can_reach_beyond_its_place() {
        let source = "(a: arg(\"x\"), b: 2)";
        let value = parse(source).value;

        let filled = substitute(source, &value, |_, _| Ok("1 // b".to_owned())).unwrap();

        assert_eq!(filled.text, "(a: 1, b: 2)");
    }
}
