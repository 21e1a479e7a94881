//! Checks structs and maps.

use super::schema::Schema;
use super::{Checker, Place, listed, nearest};
use ron_tree::{Field, Number, Span, Value, ValueKind};

impl Checker {
    /// Checks a struct value, such as `(a: 1, b: 2)`, against its schema.
    ///
    /// `owner` is the span of the name of the struct or, if there is no name, of the opening bracket. If fields are
    /// missing, the error is reported at this span.
    pub(super) fn check_struct(
        &mut self,
        value: &Value,
        schema: &Schema,
        place: Place,
        owner: Span,
    ) {
        let (fields, complete): (&[Field], bool) = match &value.kind {
            ValueKind::Struct(body) => (&body.fields, body.complete),
            ValueKind::Unit => (&[], true),
            // `ron` accepts the name of a struct before its parentheses, so the name is accepted here, too.
            ValueKind::Call(call) if schema.name() == Some(&*call.name.text) => {
                return self.check_struct(&call.body, schema, place, call.name.span);
            }
            _ => {
                let help = match &value.kind {
                    ValueKind::Map(_) => {
                        let help = "write fields in parentheses, with names without quotes: `(name: value)`";
                        Some(help.to_owned())
                    }
                    _ => with_field_name(value, schema),
                };
                let expected = schema.expectation();
                return self.mismatch(value, &expected, place, help);
            }
        };
        let (mut given, mut unknown) = (Vec::with_capacity(fields.len()), Vec::new());
        for field in fields {
            let name = &*field.name.text;
            let Some((current, inner)) = schema.field_or_alias(name) else {
                unknown.push(field);
                continue;
            };
            if current != name {
                self.renamed(value, field.name.span, name, current);
            }
            given.push(current);
            self.check(&field.value, &inner, Place::named(name));
        }
        let is_given = |name: &&str| given.contains(name);
        let mut missing: Vec<&str> = schema.required().filter(|name| !is_given(name)).collect();
        for field in unknown {
            self.unknown_field(value, field, schema, place, &mut missing);
        }
        if complete && !missing.is_empty() {
            let names = listed(missing.iter().copied());
            let message = match (place.name, &missing[..]) {
                (Some(name), _) => format!("`{name}` needs {names}"),
                (None, [_]) => format!("{names} is missing"),
                (None, _) => format!("{names} are missing"),
            };
            let help = format!("write {}", usage_of(&missing, schema));
            self.report(value, owner, message, Some(help));
        }
    }

    /// Reports an unknown field. The unknown field is probably a missing field whose name is misspelled. If so, this
    /// function removes the missing field from `missing`, so that only the unknown field is reported.
    fn unknown_field(
        &mut self,
        value: &Value,
        field: &Field,
        schema: &Schema,
        place: Place,
        missing: &mut Vec<&str>,
    ) {
        let name = &*field.name.text;
        let near = nearest(name, schema.fields());
        let known: Vec<&str> = schema.fields().collect();
        let help = match place.name {
            _ if !near.is_empty() => {
                missing.retain(|name| !near.contains(name));
                format!("did you mean {}?", listed(near))
            }
            _ if missing.len() == 1 => {
                format!(
                    "write {} instead",
                    usage_of(&std::mem::take(missing), schema)
                )
            }
            Some(owner) if known.is_empty() => format!("`{owner}` has no fields"),
            _ => format!("fields: {}", listed(known.iter().copied().take(24))),
        };
        let owner = place
            .name
            .map_or(String::new(), |owner| format!(" in `{owner}`"));
        self.report(
            value,
            field.name.span,
            format!("unknown field `{name}`{owner}"),
            Some(help),
        );
    }

    /// Checks a map, such as `{"a": 1}`, against its schema.
    pub(super) fn check_map(&mut self, value: &Value, schema: &Schema, place: Place) {
        let ValueKind::Map(entries) = &value.kind else {
            return self.mismatch(value, &schema.expectation(), place, None);
        };
        let values = schema.map_values();
        for (key, value) in entries {
            let fits = matches!(key.kind, ValueKind::String(_) | ValueKind::Error);
            if schema.has_text_keys() && !fits {
                let message = format!(
                    "expected a string `\"..\"` as the key{}, found {}",
                    place.of(),
                    key.describe()
                );
                self.report(key, key.span, message, None);
            }
            if let Some(values) = &values {
                self.check(
                    value,
                    values,
                    Place {
                        name: key.as_str().or(place.name),
                        inside: false,
                    },
                );
            }
        }
    }
}

impl Schema<'_> {
    /// Whether a number, a string or a variant has the type of this schema. Returns `false` for all other kinds of
    /// values.
    pub(super) fn accepts(&self, value: &Value) -> bool {
        let choice = self.choice();
        match (&value.kind, &choice) {
            (ValueKind::Name(name), Some(choice)) => choice.has(name),
            (ValueKind::Call(call), Some(choice)) => choice.content(&call.name.text).is_some(),
            (ValueKind::Number(_), None) => {
                matches!(self.types()[..], ["integer" | "number", ..])
            }
            (ValueKind::String(_), None) => matches!(self.types()[..], ["string", ..]),
            _ => false,
        }
    }
}

/// Returns the help text for a value that looks like a single field of the struct that the schema requires. The help
/// text names the first field that accepts the value. If no field accepts it, the text names the first field. Required
/// fields come first.
fn with_field_name(value: &Value, schema: &Schema) -> Option<String> {
    let inner = value.single().unwrap_or(value);
    let accepts = |field: &&str| {
        let field = schema.field(field);
        field.is_some_and(|field| field.accepts(inner))
    };
    let all = || schema.required().chain(schema.fields());
    let field = all().find(accepts).or_else(|| all().next())?;
    Some(format!("write `({field}: {})`", short(inner)?))
}

/// Returns a value in the form in which help texts quote it. Returns `None` if the quoted value would be too long.
pub(super) fn short(value: &Value) -> Option<String> {
    match &value.kind {
        ValueKind::Name(name) => Some(name.to_string()),
        ValueKind::Call(call) => Some(format!("{}(..)", call.name.text)),
        ValueKind::Number(Number::Int(text) | Number::Float(text)) => Some(text.to_string()),
        ValueKind::String(_) => Some("\"..\"".to_owned()),
        _ => None,
    }
}

/// Describes how to write the missing fields, for example `` `count:` with a whole number ``.
fn usage_of(missing: &[&str], schema: &Schema) -> String {
    let one = |name: &&str| {
        let expectation = schema
            .field(name)
            .map_or("a value".to_owned(), |s| s.expectation());
        format!("`{name}:` with {expectation}")
    };
    missing
        .iter()
        .take(3)
        .map(one)
        .collect::<Vec<_>>()
        .join(", ")
}
