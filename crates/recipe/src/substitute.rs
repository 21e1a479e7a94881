//! Substitutes the parameters of a recipe: each `arg("name")` is replaced by the value of the parameter with this name.

use ron_tree::{Call, Diagnostic, Span, Value, ValueKind};

/// Replaces each `arg("name")` in `value` by the value of the parameter with this name. `resolve` is called with the
/// name of a parameter and the span of this name. `resolve` returns the value of the parameter. The inserted value has
/// the span of the `arg(..)` that it replaces, and it records the name of the parameter.
///
/// Returns the errors of `resolve`, and an error for each `arg` without a name. An `arg` with an error is not replaced.
pub fn substitute(
    value: &mut Value,
    mut resolve: impl FnMut(&str, Span) -> Result<Value, Box<Diagnostic>>,
) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    fill(
        value,
        &mut |call, span| {
            let Some(name) = call.body.single() else {
                return Err(no_name(span));
            };
            let text = name.as_str().ok_or_else(|| no_name(span))?;
            let mut value = resolve(text, name.span)?;
            mark(&mut value, span, text);
            Ok(value)
        },
        &mut diagnostics,
    );
    diagnostics
}

fn no_name(span: Span) -> Box<Diagnostic> {
    let message = "expected the name of a parameter of the recipe in `arg(..)`";
    Box::new(Diagnostic::error(span, message).with_help("write `arg(\"name\")`"))
}

/// Replaces each call of `arg` in `value`, in the order of the text.
fn fill(
    value: &mut Value,
    replacement: &mut impl FnMut(&Call, Span) -> Result<Value, Box<Diagnostic>>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    match &mut value.kind {
        ValueKind::Call(call) if &*call.name.text == "arg" => match replacement(call, value.span) {
            Ok(filled) => *value = filled,
            Err(diagnostic) => diagnostics.push(*diagnostic),
        },
        _ => value.for_each_part(|part| fill(part, replacement, diagnostics)),
    }
}

/// Sets the span and the parameter name of a value and of all values inside it.
fn mark(value: &mut Value, span: Span, parameter: &str) {
    value.span = span;
    value.parameter = Some(parameter.into());
    value.for_each_part(|part| mark(part, span, parameter));
}

#[cfg(test)]
mod tests {
    use super::*;
    use ron_tree::{parse, to_json};
    use serde_json::json;

    const SOURCE: &str = "[Grid(x: arg(\"n\"), /* é */ y: [arg(\"size\"), 3])]";

    fn filled() -> Value {
        let mut value = parse(SOURCE).value;
        let wrong = substitute(&mut value, |name, _| match name {
            "n" => Ok(parse("8").value),
            "size" => Ok(parse("(1, 0.5)").value),
            _ => unreachable!(),
        });
        assert_eq!(wrong, []);
        value
    }

    #[test]
    fn values_replace_the_calls_of_arg() {
        let filled = filled();

        assert_eq!(filled.to_string(), "[Grid(x: 8, y: [(1, 0.5), 3])]");
        assert_eq!(
            to_json(&filled),
            json!([{"Grid": {"x": 8, "y": [[1, 0.5], 3]}}])
        );
    }

    #[test]
    fn a_value_remembers_its_parameter() {
        let filled = filled();
        let grid = &filled.items().unwrap()[0];
        let x = grid.field("x").unwrap();

        assert_eq!(x.parameter.as_deref(), Some("n"));
        assert_eq!(x.span.of(SOURCE), "arg(\"n\")");
        assert_eq!(grid.field("y").unwrap().parameter, None);
    }

    #[test]
    fn every_bad_parameter_is_reported() {
        let source = "(a: arg(\"x\"), b: arg(), c: arg(x), d: arg(\"good\"))";
        let mut value = parse(source).value;

        let errors = substitute(&mut value, |name, span| match name {
            "good" => Ok(parse("1").value),
            _ => Err(Diagnostic::error(span, "no such parameter").into()),
        });

        let places: Vec<&str> = errors.iter().map(|e| e.span.unwrap().of(source)).collect();
        assert_eq!(places, ["\"x\"", "arg()", "arg(x)"]);
    }
}
