//! The parameters of an operation in words, from its JSON schema.

use serde_json::Value as Json;

/// A parameter as its documentation shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldDoc {
    /// Its name.
    pub name: String,
    /// What kind of value it takes, with its range.
    pub kind: String,
    /// The default as RON; `None` if the parameter is required.
    pub default: Option<String>,
    /// What it is for.
    pub doc: String,
    /// The variants to choose from, with what they mean.
    pub variants: Vec<(String, String)>,
}

/// The parameters of an operation, in the order of its struct.
pub fn fields(schema: &Json) -> Vec<FieldDoc> {
    let required: Vec<&str> = schema["required"]
        .as_array()
        .map(|names| names.iter().filter_map(Json::as_str).collect())
        .unwrap_or_default();
    let Some(properties) = schema["properties"].as_object() else {
        return Vec::new();
    };
    properties
        .iter()
        .map(|(name, property)| {
            let target = resolve(schema, property);
            FieldDoc {
                name: name.clone(),
                kind: kind(schema, property),
                default: (!required.contains(&name.as_str())).then(|| {
                    let default = property.get("default");
                    default.map_or("none".to_owned(), |value| default_of(target, value))
                }),
                doc: property["description"]
                    .as_str()
                    .unwrap_or_default()
                    .to_owned(),
                variants: variants(schema, target),
            }
        })
        .collect()
}

/// A type that parameters are made of: a choice of variants, or a group of fields.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TypeDoc {
    /// Its name.
    pub name: String,
    /// What it is.
    pub doc: String,
    /// Its fields, if it is written `(a: .., b: ..)`.
    pub fields: Vec<FieldDoc>,
    /// Its variants, if it is a choice.
    pub variants: Vec<(String, String)>,
}

/// The types that the parameters of an operation are made of, in order of their names; not those that
/// are written as plain numbers.
pub fn types(schema: &Json) -> Vec<TypeDoc> {
    let Some(definitions) = schema["$defs"].as_object() else {
        return Vec::new();
    };
    let mut types: Vec<TypeDoc> = definitions
        .iter()
        .map(|(name, definition)| {
            let mut inner = definition.clone();
            inner["$defs"] = schema["$defs"].clone();
            TypeDoc {
                name: name.clone(),
                doc: text_of(definition),
                fields: fields(&inner),
                variants: variants(schema, definition),
            }
        })
        .filter(|t| !t.fields.is_empty() || !t.variants.is_empty())
        .collect();
    types.sort_by(|a, b| a.name.cmp(&b.name));
    types
}

/// The reasons that `refused:` can name, with what they mean.
pub fn refusals() -> Vec<(String, String)> {
    let schema = crate::schema::of::<op::Refusal>();
    variants(&schema, &schema)
}

fn text_of(schema: &Json) -> String {
    schema["description"]
        .as_str()
        .unwrap_or_default()
        .to_owned()
}

/// What a reference leads to.
fn resolve<'s>(root: &'s Json, schema: &'s Json) -> &'s Json {
    let target = schema["$ref"]
        .as_str()
        .and_then(|r| r.strip_prefix("#/$defs/"));
    target.map_or(schema, |name| resolve(root, &root["$defs"][name]))
}

fn kind(root: &Json, schema: &Json) -> String {
    if let Some(name) = schema["$ref"]
        .as_str()
        .and_then(|r| r.strip_prefix("#/$defs/"))
    {
        let target = resolve(root, schema);
        let is_tuple = target.get("prefixItems").is_some();
        return if is_tuple {
            kind(root, target)
        } else {
            name.to_owned()
        };
    }
    if let Some(options) = schema["anyOf"].as_array() {
        let not_null = options.iter().find(|o| o["type"] != "null");
        return not_null.map_or_else(|| "value".to_owned(), |o| kind(root, o));
    }
    if let Some(items) = schema["prefixItems"].as_array() {
        let items: Vec<String> = items.iter().map(|item| kind(root, item)).collect();
        return format!("({})", items.join(", "));
    }
    let type_name = match &schema["type"] {
        Json::String(name) => name.as_str(),
        Json::Array(names) => names
            .iter()
            .filter_map(Json::as_str)
            .find(|n| *n != "null")
            .unwrap_or("value"),
        _ => "value",
    };
    match type_name {
        "array" => match fixed_len(schema) {
            Some(n) => format!("({})", vec![kind(root, &schema["items"]); n].join(", ")),
            None => format!("[{}, ..]", kind(root, &schema["items"])),
        },
        "integer" => format!("whole number{}", range(schema)),
        "number" => format!("number{}", range(schema)),
        "string" => "text".to_owned(),
        "boolean" => "true or false".to_owned(),
        other => other.to_owned(),
    }
}

fn range(schema: &Json) -> String {
    let above = [("minimum", "from"), ("exclusiveMinimum", "above")];
    let below = [("maximum", "to"), ("exclusiveMaximum", "below")];
    let mut text = String::new();
    for (key, word) in above.into_iter().chain(below) {
        // The bounds of the type itself say nothing.
        if let Some(bound) = schema
            .get(key)
            .filter(|b| b.as_u64() != Some(0) || schema["type"] == "number")
        {
            text += &format!(" {word} {bound}");
        }
    }
    text
}

/// The variants of an enumeration, as they are written.
fn variants(root: &Json, schema: &Json) -> Vec<(String, String)> {
    let Some(options) = schema["oneOf"].as_array() else {
        let names = schema["enum"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Json::as_str);
        return names.map(|name| (name.to_owned(), String::new())).collect();
    };
    let doc = |option: &Json| {
        option["description"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    };
    options
        .iter()
        .flat_map(|option| {
            if let Some(name) = option["const"].as_str() {
                return vec![(name.to_owned(), doc(option))];
            }
            if let Some(names) = option["enum"].as_array() {
                let names = names.iter().filter_map(Json::as_str);
                return names.map(|name| (name.to_owned(), doc(option))).collect();
            }
            let Some((name, content)) = option["properties"]
                .as_object()
                .and_then(|p| p.iter().next())
            else {
                return Vec::new();
            };
            let content = resolve(root, content);
            let inside = match content["properties"].as_object() {
                Some(fields) => {
                    let names: Vec<String> = fields.keys().map(|f| format!("{f}: ..")).collect();
                    names.join(", ")
                }
                None => match kind(root, content) {
                    tuple if tuple.starts_with('(') => {
                        let items = content["prefixItems"].as_array().map_or(0, Vec::len);
                        vec![".."; items].join(", ")
                    }
                    list if list.starts_with('[') => "[..]".to_owned(),
                    _ => "..".to_owned(),
                },
            };
            vec![(format!("{name}({inside})"), doc(option))]
        })
        .collect()
}

/// How many parts an array has that always has as many: RON writes it as a tuple. Lists have brackets.
fn fixed_len(schema: &Json) -> Option<usize> {
    let limit = |name: &str| schema[name].as_u64();
    let n = limit("minItems").filter(|n| limit("maxItems") == Some(*n))?;
    usize::try_from(n).ok().filter(|n| (1..=16).contains(n))
}

/// A default as RON, for a value of this schema.
fn default_of(schema: &Json, value: &Json) -> String {
    let is_list = schema["items"].is_object() && fixed_len(schema).is_none();
    match value {
        Json::Array(items) if is_list => {
            let items: Vec<String> = items.iter().map(to_ron).collect();
            format!("[{}]", items.join(", "))
        }
        other => to_ron(other),
    }
}

/// A value as RON: objects with one capitalised member are variants, and few numbers are a tuple.
fn to_ron(value: &Json) -> String {
    match value {
        Json::Null => "none".to_owned(),
        Json::String(text) if text.chars().next().is_some_and(char::is_uppercase) => text.clone(),
        Json::Array(items) => {
            let items: Vec<String> = items.iter().map(to_ron).collect();
            let numbers = !items.is_empty()
                && items.len() <= 4
                && value
                    .as_array()
                    .is_some_and(|v| v.iter().all(Json::is_number));
            if numbers {
                format!("({})", items.join(", "))
            } else {
                format!("[{}]", items.join(", "))
            }
        }
        Json::Object(members) => {
            let variant = members.len() == 1
                && members
                    .keys()
                    .all(|k| k.chars().next().is_some_and(char::is_uppercase));
            let parts: Vec<String> = members
                .iter()
                .map(|(key, value)| {
                    if variant {
                        format!("{key}{}", bracketed(value))
                    } else {
                        format!("{key}: {}", to_ron(value))
                    }
                })
                .collect();
            if variant {
                parts.join("")
            } else {
                format!("({})", parts.join(", "))
            }
        }
        other => other.to_string(),
    }
}

fn bracketed(value: &Json) -> String {
    let text = to_ron(value);
    if text.starts_with('(') {
        text
    } else {
        format!("({text})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use op::{EdgeSelection, OnRefusal, Vector};
    use schemars::JsonSchema;
    use serde::Serialize;

    /// Does something.
    #[derive(JsonSchema, Serialize)]
    struct Sample {
        /// Which edges.
        edges: EdgeSelection,
        /// How often.
        #[schemars(range(min = 1, max = 9))]
        #[serde(default)]
        times: u32,
        /// Where.
        #[serde(default)]
        at: Vector,
        /// What then.
        #[serde(default)]
        on_refusal: OnRefusal,
        /// Some numbers.
        #[serde(default = "half")]
        some: Vec<f64>,
        /// Two numbers.
        #[serde(default)]
        two: [u8; 2],
    }

    fn half() -> Vec<f64> {
        vec![0.5]
    }

    #[test]
    fn parameters_are_described_in_words() {
        let fields = fields(&schemars::schema_for!(Sample).to_value());
        let lines: Vec<String> = fields
            .iter()
            .map(|f| format!("{}: {} = {:?}, {}", f.name, f.kind, f.default, f.doc))
            .collect();
        assert_eq!(
            lines,
            [
                "edges: EdgeSelection = None, Which edges.",
                "times: whole number from 1 to 9 = Some(\"0\"), How often.",
                "at: (number, number, number) = Some(\"(0.0, 0.0, 0.0)\"), Where.",
                "on_refusal: OnRefusal = Some(\"Error\"), What then.",
                "some: [number, ..] = Some(\"[0.5]\"), Some numbers.",
                "two: (whole number to 255, whole number to 255) = Some(\"(0, 0)\"), Two numbers.",
            ]
        );
        assert!(
            fields[0]
                .variants
                .iter()
                .any(|(v, _)| v == "Between(.., ..)")
        );
        assert!(
            fields[0]
                .variants
                .iter()
                .any(|(v, _)| v == "Sharp(above: ..)")
        );
        assert_eq!(fields[3].variants[1].0, "Skip");
    }
}
