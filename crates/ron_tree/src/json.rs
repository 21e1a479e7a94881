//! Converts the values of a recipe to JSON, in the form that serde uses for Rust data.

use super::literal::Number;
use super::tree::{Value, ValueKind};
use serde_json::{Map, Value as Json};

/// Returns the value as the JSON that serde writes for the same Rust data. Enumerations are externally tagged.
///
/// ```text
/// Area          "Area"                 (a: 1)   {"a": 1}      None      null
/// Grow(x)       {"Grow": x}            (1, 2)   [1, 2]        Some(x)   x
/// Pair(1, 2)    {"Pair": [1, 2]}       [1, 2]   [1, 2]        ()        {}
/// Box(a: 1)     {"Box": {"a": 1}}      {k: v}   {"k": v}      inf, NaN  null
/// ```
///
/// `(x)` without a name is a tuple with one item. Whole numbers that do not fit in 64 bits become floating-point
/// numbers. Map keys that are not strings are written as in the recipe. Values that could not be read become null.
pub fn to_json(value: &Value) -> Json {
    match &value.kind {
        ValueKind::Bool(value) => Json::Bool(*value),
        ValueKind::Number(number) => number_to_json(number),
        ValueKind::String(text) => Json::String(text.to_string()),
        ValueKind::Char(c) => Json::String(c.to_string()),
        ValueKind::Name(name) if &**name == "None" => Json::Null,
        ValueKind::Name(name) => Json::String(name.to_string()),
        ValueKind::Unit => Json::Object(Map::new()),
        ValueKind::Struct(body) => {
            let fields = body.fields.iter();
            Json::Object(
                fields
                    .map(|f| (f.name.text.to_string(), to_json(&f.value)))
                    .collect(),
            )
        }
        ValueKind::Tuple(items) | ValueKind::List(items) => {
            Json::Array(items.iter().map(to_json).collect())
        }
        ValueKind::Map(entries) => {
            let key = |key: &Value| key.as_str().map_or_else(|| key.to_string(), str::to_owned);
            Json::Object(entries.iter().map(|(k, v)| (key(k), to_json(v))).collect())
        }
        ValueKind::Call(call) => {
            if let Some(inner) = value.some() {
                return to_json(inner);
            }
            let content = to_json(call.body.single().unwrap_or(&call.body));
            Json::Object(Map::from_iter([(call.name.text.to_string(), content)]))
        }
        ValueKind::Error => Json::Null,
    }
}

fn number_to_json(number: &Number) -> Json {
    let Some(int) = number.to_int() else {
        return serde_json::Number::from_f64(number.to_float()).map_or(Json::Null, Json::Number);
    };
    if let Ok(int) = i64::try_from(int) {
        Json::from(int)
    } else if let Ok(int) = u64::try_from(int) {
        Json::from(int)
    } else {
        Json::from(int as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;
    use serde_json::json;

    fn converted(source: &str) -> Json {
        to_json(&parse(source).value)
    }

    #[test]
    fn every_kind_of_value_is_converted_as_by_serde() {
        assert_eq!(
            converted(
                "(a: Area, b: Grow(All), c: Pair(1, 0xFF), d: Box(x: 1_000.5), e: (true, 'c'), \
                 f: [\"s\"], g: {\"k\": None}, h: Some(-1), i: (), j: inf, k: Not(Grow(All)))"
            ),
            json!({
                "a": "Area", "b": {"Grow": "All"}, "c": {"Pair": [1, 255]}, "d": {"Box": {"x": 1000.5}},
                "e": [true, "c"], "f": ["s"], "g": {"k": null}, "h": -1, "i": {}, "j": null,
                "k": {"Not": {"Grow": "All"}}
            })
        );
    }

    #[test]
    fn whole_numbers_stay_whole_if_they_fit_64_bits() {
        assert_eq!(converted("18446744073709551615"), json!(u64::MAX));
        assert_eq!(
            converted("18446744073709551616"),
            json!(18_446_744_073_709_551_616.0)
        );
        assert_eq!(converted("-9223372036854775808"), json!(i64::MIN));
    }
}
