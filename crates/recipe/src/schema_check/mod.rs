//! Checks values of a recipe against the JSON schema of their Rust type.
//!
//! `schemars` derives the schema from the type, and the values are written as `ron` writes them. If a value is accepted
//! here, it can be deserialized, unless it breaks a rule that the schema does not contain. An example is the rule that
//! a direction must not be zero. Deserialization stops at the first error. In contrast, this check finds all errors of
//! a value, each with its span and a help text.
//!
//! ```text
//! schema                                        in the recipe
//! object with properties                        (count: 24, seed: 7)
//! object with additionalProperties              {"key": value}
//! array with items                              [1, 2, 3]
//! array with prefixItems, or of fixed length    (0, 0, 1)
//! string with enum or const                     Area
//! object with one required property, in oneOf   Random(count: 24), Between(1, 2), Not(All)
//! anyOf with null, type with null               7, Some(7) or None
//! ```
//!
//! A schema does not contain everything that `ron` needs to know. Types of parameters must therefore follow three
//! rules. If a newtype variant contains a tuple or a struct, the schema must refer to this content as a named type (a
//! `$ref`). A struct around a single value must be `#[serde(transparent)]`. A list of fixed length must be an array,
//! not a `Vec`.

mod fields;
mod nearest;
mod range;
mod schema;
mod selections;
mod shorthand;
mod variants;

pub use nearest::{did_you_mean, nearest};
pub(crate) use shorthand::Checked;

use mesh::counted;
use ron_tree::{Diagnostic, Span, Value, ValueKind};
pub(crate) use schema::Schema;
use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use shorthand::Short;

/// Checks `value` against `schema`, and returns all errors in the order of the text.
///
/// `schema` is a root schema: references in it are looked up in its own `$defs`. Parts of the value that could not be
/// read are skipped.
pub fn check_schema(value: &Value, schema: &Json) -> Vec<Diagnostic> {
    checked(value, schema).wrong
}

/// Checks a value against a schema.
pub(crate) fn checked(value: &Value, schema: &Json) -> Checked {
    let mut checker = Checker::default();
    checker.check(value, &Schema::root(schema), Place::default());
    checker.finish()
}

/// Deserializes a value into a type whose schema is `schema`.
///
/// # Errors
///
/// Returns all errors that the check against the schema finds. If the check finds none, returns the error of
/// deserialization. If a part of the value could not be read and there is no other error, the returned list is empty.
/// The parser has already reported this part.
pub(crate) fn typed<T: DeserializeOwned>(
    value: &Value,
    schema: &Json,
) -> Result<T, Vec<Diagnostic>> {
    let checked = checked(value, schema);
    if !checked.wrong.is_empty() || value.has_errors() {
        return Err(checked.wrong);
    }
    let read = T::deserialize(&*checked.in_full(value));
    read.map_err(|error| vec![deserialize_error(value.span, error)])
}

/// Returns the error for a value that fits the schema but cannot be deserialized.
pub(crate) fn deserialize_error(span: Span, error: ron_tree::Error) -> Diagnostic {
    Diagnostic::error(error.span.unwrap_or(span), error.message)
}

/// Checks a step `Name(parameters)` or `Name` against the schema of its parameters. The name is not checked.
pub(crate) fn check_step(step: &Value, schema: &Json) -> Checked {
    let mut checker = Checker::default();
    let schema = Schema::root(schema);
    match &step.kind {
        ValueKind::Call(call) => {
            let place = Place::named(&call.name.text);
            checker.check_struct(&call.body, &schema, place, call.name.span);
        }
        ValueKind::Name(name) => {
            let body = Value::new(step.span, ValueKind::Unit);
            let place = Place::named(name);
            checker.check_struct(&body, &schema, place, step.span);
        }
        _ => checker.check(step, &schema, Place::default()),
    }
    checker.finish()
}

/// An old name in a recipe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rename {
    /// The span of the old name.
    pub span: Span,
    /// The old name.
    pub from: String,
    /// The current name.
    pub to: String,
}

impl Rename {
    /// Returns the warning for the old name.
    pub(crate) fn warning(&self) -> Diagnostic {
        let message = format!("`{}` was renamed to `{}`", self.from, self.to);
        Diagnostic::warning(self.span, message)
            .with_help("run `meshwright upgrade` to replace old names in the recipe")
    }
}

/// The field or variant to which a value belongs. Messages use the name of this field or variant.
#[derive(Clone, Copy, Debug, Default)]
struct Place<'n> {
    /// The name of the innermost field or variant around the value.
    name: Option<&'n str>,
    /// Whether the value is nested inside the value of the field or variant. Otherwise, the two values are the same.
    inside: bool,
}

impl<'n> Place<'n> {
    fn named(name: &'n str) -> Self {
        Self {
            name: Some(name),
            inside: false,
        }
    }

    fn inside(self) -> Self {
        Self {
            inside: true,
            ..self
        }
    }

    /// Returns a noun phrase for the value. Messages use the phrase as the subject of a sentence.
    fn subject(self) -> String {
        match self.name {
            Some(name) if self.inside => format!("a value in `{name}`"),
            Some(name) => format!("`{name}`"),
            None => "the value".to_owned(),
        }
    }

    /// Returns the end of a message such as `expected a number`: the text that names the field or variant.
    fn of(self) -> String {
        match self.name {
            Some(name) if self.inside => format!(" in `{name}`"),
            Some(name) => format!(" for `{name}`"),
            None => String::new(),
        }
    }
}

#[derive(Default)]
struct Checker {
    diagnostics: Vec<Diagnostic>,
    /// The number of errors found after the first [`MAX_DIAGNOSTICS`] errors. These errors are only counted.
    more: usize,
    /// The old names that were found.
    renames: Vec<Rename>,
    /// The values that are written without the name of their variant.
    shorts: Vec<Short>,
}

/// The maximum number of errors of one value that are reported individually.
const MAX_DIAGNOSTICS: usize = 100;

impl Checker {
    fn finish(mut self) -> Checked {
        self.renames.sort_by_key(|rename| rename.span);
        self.diagnostics.sort_by_key(|d| d.span);
        if let (1.., Some(last)) = (self.more, self.diagnostics.last().and_then(|d| d.span)) {
            let message = format!("and {} more errors like these", self.more);
            self.diagnostics.push(Diagnostic::error(last, message));
        }
        Checked {
            wrong: self.diagnostics,
            renames: self.renames,
            shorts: self.shorts,
        }
    }

    /// Records the use of an old name, unless the name comes from the value of a recipe parameter.
    fn renamed(&mut self, value: &Value, span: Span, from: &str, to: &str) {
        if value.parameter.is_none() {
            let (from, to) = (from.to_owned(), to.to_owned());
            self.renames.push(Rename { span, from, to });
        }
    }

    /// Reports an error of `value`. If the value comes from a recipe parameter, the message names this parameter.
    fn report(&mut self, value: &Value, span: Span, message: String, help: Option<String>) {
        if self.diagnostics.len() >= MAX_DIAGNOSTICS {
            self.more += 1;
            return;
        }
        let message = match &value.parameter {
            Some(parameter) => format!("{message} (from parameter `{parameter}`)"),
            None => message,
        };
        self.diagnostics.push(Diagnostic {
            help,
            ..Diagnostic::error(span, message)
        });
    }

    fn mismatch(&mut self, value: &Value, expected: &str, place: Place, help: Option<String>) {
        if value.has_errors() {
            // The parser has already reported why the value could not be read.
            return;
        }
        let message = format!(
            "expected {expected}{}, found {}",
            place.of(),
            value.describe()
        );
        self.report(value, value.span, message, help);
    }

    fn check(&mut self, value: &Value, schema: &Schema, place: Place) {
        let is_none = matches!(&value.kind, ValueKind::Name(name) if &**name == "None");
        if !schema.is_nullable() {
            self.check_present(value, schema, place);
        } else if let Some(inner) = value.some() {
            self.check_present(inner, schema, place);
        } else if !is_none {
            self.check_present(value, schema, place);
        }
    }

    /// Checks a value that is not `None`.
    fn check_present(&mut self, value: &Value, schema: &Schema, place: Place) {
        if matches!(value.kind, ValueKind::Error) {
            return;
        }
        if let Some(choice) = schema.choice() {
            return self.check_choice(value, schema, &choice, place);
        }
        if let [one, ..] = schema.types()[..] {
            self.check_type(value, schema, one, place);
        }
    }

    fn check_type(&mut self, value: &Value, schema: &Schema, name: &str, place: Place) {
        let fits = match (name, &value.kind) {
            ("integer", ValueKind::Number(number)) => {
                return self.check_integer(value, number, schema, place);
            }
            ("number", ValueKind::Number(number)) => {
                return self.check_number(value, number, schema, place);
            }
            ("string", ValueKind::String(_) | ValueKind::Char(_)) => {
                return self.check_string(value, schema, place);
            }
            ("array", _) => return self.check_array(value, schema, place),
            ("object", _) if schema.is_map() => return self.check_map(value, schema, place),
            ("object", _) => return self.check_struct(value, schema, place, opening(value)),
            ("boolean", ValueKind::Bool(_)) => true,
            // `ron` does not accept a space inside `()`, so a written value must have exactly two characters.
            ("null", ValueKind::Unit) => value.span.len() == 2 || value.parameter.is_some(),
            _ => false,
        };
        if !fits {
            let quotes = match (name, &value.kind) {
                ("string", ValueKind::Name(name)) => Some(format!("write \"{name}\" in quotes")),
                ("boolean", ValueKind::Name(name)) if name.eq_ignore_ascii_case("true") => {
                    Some("write `true`".to_owned())
                }
                ("boolean", ValueKind::Name(name)) if name.eq_ignore_ascii_case("false") => {
                    Some("write `false`".to_owned())
                }
                ("integer" | "number", ValueKind::String(_)) => {
                    Some("write numbers without quotes".to_owned())
                }
                _ => None,
            };
            self.mismatch(value, &schema.expectation(), place, quotes);
        }
    }

    fn check_string(&mut self, value: &Value, schema: &Schema, place: Place) {
        let (least, most) = (schema.count("minLength"), schema.count("maxLength"));
        let is_character = least == Some(1) && most == Some(1);
        let text = match &value.kind {
            ValueKind::Char(_) if is_character => return,
            ValueKind::String(text) if !is_character => text,
            _ => return self.mismatch(value, &schema.expectation(), place, None),
        };
        let length = text.chars().count();
        self.check_count(value, length, [least, most], "characters", place);
    }

    fn check_array(&mut self, value: &Value, schema: &Schema, place: Place) {
        if let Some(items) = schema.tuple() {
            let expected = schema.expectation() + &place.of();
            // `ron` accepts the name of a struct before its parentheses, so the name is accepted here, too.
            let body = match &value.kind {
                ValueKind::Call(call) if schema.name() == Some(&*call.name.text) => &call.body,
                _ => value,
            };
            return self.check_tuple(body, &items, &expected, place);
        }
        let ValueKind::List(values) = &value.kind else {
            let help = match &value.kind {
                ValueKind::Tuple(_) => Some("write lists in square brackets: `[..]`".to_owned()),
                _ => None,
            };
            return self.mismatch(value, &schema.expectation(), place, help);
        };
        if values.iter().all(|v| !matches!(v.kind, ValueKind::Error)) {
            let limits = [schema.count("minItems"), schema.count("maxItems")];
            self.check_count(value, values.len(), limits, "items", place);
        }
        if let Some(item) = schema.child("items") {
            for value in values {
                self.check(value, &item, place.inside());
            }
        }
    }

    /// Checks a tuple, such as `(1, 2)`, against the schemas of its items. `expected` describes the expected value in
    /// messages.
    fn check_tuple(&mut self, value: &Value, items: &[Schema], expected: &str, place: Place) {
        let values = match &value.kind {
            ValueKind::Tuple(values) => values.as_slice(),
            ValueKind::Unit => &[],
            ValueKind::List(_) => {
                let help = "write tuples in parentheses: `(1, 2, 3)`";
                return self.mismatch(value, expected, Place::default(), Some(help.to_owned()));
            }
            _ => {
                let are_numbers = items.iter().all(|item| item.types() == ["number"]);
                let example = vec!["0.5"; items.len()].join(", ");
                let help = are_numbers.then(|| format!("write numbers, such as `({example})`"));
                return self.mismatch(value, expected, Place::default(), help);
            }
        };
        let readable = values.iter().all(|v| !matches!(v.kind, ValueKind::Error));
        if readable && values.len() != items.len() {
            let found = counted(values.len(), "value");
            let message = format!("expected {expected}, found {found}");
            self.report(value, value.span, message, None);
        }
        for (value, schema) in values.iter().zip(items) {
            self.check(value, schema, place.inside());
        }
    }

    /// Checks a count against its limits. The count is the number of characters of a string or the number of items of a
    /// list.
    fn check_count(
        &mut self,
        value: &Value,
        count: usize,
        [least, most]: [Option<u64>; 2],
        things: &str,
        place: Place,
    ) {
        let limit = if let Some(least) = least.filter(|&least| (count as u64) < least) {
            format!("at least {least}")
        } else if let Some(most) = most.filter(|&most| count as u64 > most) {
            format!("at most {most}")
        } else {
            return;
        };
        let message = format!("{} has {count} {things}, expected {limit}", place.subject());
        self.report(value, value.span, message, None);
    }
}

/// Returns the span of the name of a value. If the value has no name, returns the span of the first character of the
/// value.
fn opening(value: &Value) -> Span {
    match value.name() {
        Some((_, span)) => span,
        None => Span::new(value.span.start, value.span.end.min(value.span.start + 1)),
    }
}

/// Returns a list of names in backticks, separated by commas.
pub(crate) fn listed<'n>(names: impl IntoIterator<Item = &'n str>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

#[cfg(test)]
mod tests;
