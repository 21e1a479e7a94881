//! Checks structs and maps.

use super::schema::Schema;
use super::{Checker, Place, listed, nearest};
use ron_tree::{Field, Span, Value, ValueKind};

impl Checker {
    /// Checks `(a: 1, b: 2)`.
    ///
    /// `owner` is the span of the name, or of the opening bracket. Missing fields are reported there.
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
            // `ron` accepts the name of a struct before its parentheses.
            ValueKind::Call(call) if schema.name() == Some(&*call.name.text) => {
                return self.check_struct(&call.body, schema, place, call.name.span);
            }
            _ => {
                let help = match &value.kind {
                    ValueKind::Map(_) => {
                        Some("write fields in parentheses, and their names without quotes")
                    }
                    _ => None,
                };
                let expected = schema.expectation();
                return self.mismatch(value, &expected, place, help.map(str::to_owned));
            }
        };
        let mut given = Vec::with_capacity(fields.len());
        for field in fields {
            let name = &*field.name.text;
            let Some((current, inner)) = schema.field_or_alias(name) else {
                self.unknown_field(value, field, schema, place);
                continue;
            };
            if current != name {
                self.renamed(value, field.name.span, name, current);
            }
            given.push(current);
            self.check(&field.value, &inner, Place::named(name));
        }
        let is_given = |name: &&str| given.contains(name);
        let missing: Vec<&str> = schema.required().filter(|name| !is_given(name)).collect();
        if complete && !missing.is_empty() {
            let subject = place
                .name
                .map_or("the value".to_owned(), |name| format!("`{name}`"));
            let message = format!("{subject} needs {}", listed(missing.iter().copied()));
            let help = format!("write {}", usage_of(&missing, schema));
            self.report(value, owner, message, Some(help));
        }
    }

    fn unknown_field(&mut self, value: &Value, field: &Field, schema: &Schema, place: Place) {
        let name = &*field.name.text;
        let near = nearest(name, schema.fields());
        let known: Vec<&str> = schema.fields().collect();
        let help = match place.name {
            _ if !near.is_empty() => format!("did you mean {}?", listed(near)),
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

    /// Checks `{"a": 1}`.
    pub(super) fn check_map(&mut self, value: &Value, schema: &Schema, place: Place) {
        let ValueKind::Map(entries) = &value.kind else {
            return self.mismatch(value, &schema.expectation(), place, None);
        };
        let values = schema.map_values();
        for (key, value) in entries {
            let fits = matches!(key.kind, ValueKind::String(_) | ValueKind::Error);
            if schema.has_text_keys() && !fits {
                let message = format!(
                    "expected a string `\"..\"` as key{}, found {}",
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

/// Describes how to write the missing fields, such as `` `count:` with a whole number ``.
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
