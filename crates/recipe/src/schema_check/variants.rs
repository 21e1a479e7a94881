//! Checks values whose schema has several alternatives, such as the variants of an enumeration.

use super::fields::short;
use super::schema::{Choice, Schema};
use super::{Checker, Place, listed, nearest, selections};
use mesh::counted;
use ron_tree::{Call, Span, Value, ValueKind};

impl Checker {
    pub(super) fn check_choice(
        &mut self,
        value: &Value,
        schema: &Schema,
        choice: &Choice,
        place: Place,
    ) {
        if schema.is_shorthand() {
            return self.check_shorthand(value, schema, choice, place);
        }
        match choice.others.as_slice() {
            [] => self.check_variant(value, schema, choice, place),
            [one] => self.check(value, one, place),
            // Only the schema of an untagged enumeration has several alternatives that are not variants. Parameters do
            // not use untagged enumerations, so nothing is checked here.
            _ => {}
        }
    }

    /// Checks a value that should be a variant of an enumeration.
    pub(super) fn check_variant(
        &mut self,
        value: &Value,
        schema: &Schema,
        choice: &Choice,
        place: Place,
    ) {
        let content = |name: &str| choice.content(name);
        let is_unit = |name: &str| choice.units.contains(&name);
        let is_known = |name: &str| is_unit(name) || content(name).is_some();
        // A renamed variant is checked under its current name.
        if let Some((name, span)) = value.name()
            && !is_known(name)
            && let Some(current) = schema.variant_by_alias(name).filter(|name| is_known(name))
        {
            self.renamed(value, span, name, current);
            return match &value.kind {
                ValueKind::Call(call) => match content(current) {
                    Some(content) => self.check_content(call, &content),
                    None => self.check_variant(&renamed(value, current), schema, choice, place),
                },
                _ => self.check_variant(&renamed(value, current), schema, choice, place),
            };
        }
        match &value.kind {
            ValueKind::Name(name) if is_unit(name) => {}
            ValueKind::Name(name) => match content(name) {
                Some(content) => {
                    let help = format!("write `{}`", content.usage(name));
                    self.report(
                        value,
                        value.span,
                        format!("`{name}` needs parameters"),
                        Some(help),
                    );
                }
                None => self.unknown_variant(value, (name, value.span), schema, choice, place),
            },
            ValueKind::Call(call) => match content(&call.name.text) {
                Some(content) => self.check_content(call, &content),
                None if is_unit(&call.name.text) => {
                    let message = format!("`{}` takes no parameters", call.name.text);
                    let help = format!("write `{}` alone", call.name.text);
                    self.report(value, call.body.span, message, Some(help));
                }
                None => {
                    let name = (&*call.name.text, call.name.span);
                    self.unknown_variant(value, name, schema, choice, place);
                }
            },
            ValueKind::String(text) if is_unit(text) || content(text).is_some() => {
                let message = format!("the variant `{text}` must not be in quotes");
                self.report(value, value.span, message, Some(format!("write `{text}`")));
            }
            _ => {
                let names: Vec<&str> = choice.names().collect();
                let help = with_variant_name(value, choice)
                    .or_else(|| (names.len() > 6).then(|| variants_help(&names)).flatten());
                self.mismatch(value, &schema.expectation(), place, help);
            }
        }
    }

    fn unknown_variant(
        &mut self,
        value: &Value,
        (name, span): (&str, Span),
        schema: &Schema,
        choice: &Choice,
        place: Place,
    ) {
        if let Some(other) = schema
            .name()
            .and_then(|kind| selections::of_other_kind(name, kind))
        {
            let message = format!("{}{}", other.message, place.of());
            return self.report(value, span, message, Some(other.help));
        }
        let names: Vec<&str> = choice.names().collect();
        let near = nearest(name, names.iter().copied());
        let help = if !near.is_empty() {
            Some(format!("did you mean {}?", listed(near)))
        } else if schema
            .name()
            .is_some_and(|name| name.ends_with("Selection"))
        {
            Some("`meshwright ops --selections` lists all selections".to_owned())
        } else if names.contains(&"Closed") {
            Some("`meshwright expectations` lists all expectations".to_owned())
        } else {
            variants_help(&names)
        };
        self.report(
            value,
            span,
            format!("unknown variant `{name}`{}", place.of()),
            help,
        );
    }

    fn check_content(&mut self, call: &Call, schema: &Schema) {
        let name = &*call.name.text;
        let place = Place::named(name);
        if !schema.is_one_value() {
            if let Some(items) = schema.tuple() {
                let expected = format!("`{}`", schema.usage(name));
                return self.check_tuple(&call.body, &items, &expected, place);
            }
            return self.check_struct(&call.body, schema, place, call.name.span);
        }
        if let Some(single) = call.body.single() {
            return self.check(single, schema, place);
        }
        if let ValueKind::Struct(body) = &call.body.kind
            && !body.complete
        {
            return;
        }
        let found = match &call.body.kind {
            ValueKind::Tuple(values) => counted(values.len(), "value"),
            ValueKind::Unit => "none".to_owned(),
            _ => call.body.describe(),
        };
        let message = format!("expected one value in `{name}(..)`, found {found}");
        let wraps = matches!(call.body.kind, ValueKind::Struct(_) | ValueKind::Tuple(_))
            && matches!(schema.types().as_slice(), ["object" | "array"]);
        let help = if wraps && schema.types() == ["array"] && schema.tuple().is_none() {
            Some(format!("write `{name}([..])`"))
        } else if wraps {
            Some(format!(
                "inside the parentheses of `{name}`, the value needs its own parentheses: `{name}({})`",
                schema.usage("")
            ))
        } else {
            Some(format!("the value must be {}", schema.expectation()))
        };
        self.report(&call.body, call.body.span, message, help);
    }
}

/// Returns a copy of the value with another name.
fn renamed(value: &Value, name: &str) -> Value {
    let mut renamed = value.clone();
    match &mut renamed.kind {
        ValueKind::Name(own) => *own = name.into(),
        ValueKind::Call(call) => call.name.text = name.into(),
        _ => {}
    }
    renamed
}

/// Returns a help text that lists the variants, if there are at most 24.
fn variants_help(names: &[&str]) -> Option<String> {
    (1..=24)
        .contains(&names.len())
        .then(|| format!("variants: {}", listed(names.iter().copied())))
}

/// Returns the help text for a value that should be a variant but is only the content of a variant. At most two
/// variants are suggested.
fn with_variant_name(value: &Value, choice: &Choice) -> Option<String> {
    let accepts = |name: &&str| {
        let content = choice.content(name);
        content.is_some_and(|content| content.is_one_value() && content.accepts(value))
    };
    let text = short(value)?;
    let written = choice
        .names()
        .filter(accepts)
        .map(|name| format!("`{name}({text})`"));
    let written: Vec<String> = written.collect();
    (1..=2)
        .contains(&written.len())
        .then(|| format!("write {}", written.join(" or ")))
}
