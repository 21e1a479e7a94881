//! Describes the parameters of an operation in words, from its JSON schema.

use serde_json::Value as Json;

use crate::schema_check::Schema;

/// The documentation of a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldDoc {
    /// The name of the parameter.
    pub name: String,
    /// The kind of value that the parameter takes, with the range of the value.
    pub kind: String,
    /// `None` if the parameter is required. For an optional parameter, the default value as RON, or the text `none` if
    /// there is no default value.
    pub default: Option<String>,
    /// The description of the parameter.
    pub doc: String,
    /// The variants of the parameter's type, if the type is an enumeration.
    pub variants: Vec<VariantDoc>,
}

/// The documentation of one variant of an enumeration, such as a selection or an expectation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VariantDoc {
    /// The name of the variant.
    pub name: String,
    /// The form in which the variant is written, such as `Sharp(above: ..)`.
    pub written: String,
    /// The description of the variant.
    pub doc: String,
    /// The named fields of the variant.
    pub fields: Vec<FieldDoc>,
}

/// Returns the parameters of an operation, in the order of the fields of its struct.
pub fn fields(schema: &Json) -> Vec<FieldDoc> {
    fields_of(&Schema::root(schema), true)
}

/// Returns the fields of `part`, which is a part of the JSON schema `root`: for example, the schema of one variant.
pub fn fields_in(root: &Json, part: &Json) -> Vec<FieldDoc> {
    fields_of(&Schema::new(root, part), true)
}

/// Returns the fields of a schema. If `with_variants` is set and the type of a field is an enumeration, the description
/// of the field contains the variants. Fields inside these variants are described without their own variants. Without
/// this limit, the description would never end, because a selection can contain other selections.
fn fields_of(schema: &Schema, with_variants: bool) -> Vec<FieldDoc> {
    let required: Vec<&str> = schema.required().collect();
    let described = |name: &str| {
        let field = schema.field(name)?;
        let default = field.own("default");
        let default = default.map_or("none".to_owned(), |value| default_of(&field, value));
        Some(FieldDoc {
            name: name.to_owned(),
            kind: kind(&field),
            default: (!required.contains(&name)).then_some(default),
            doc: field.doc(),
            variants: if with_variants {
                variants(&field)
            } else {
                Vec::new()
            },
        })
    };
    schema.fields().filter_map(described).collect()
}

/// The documentation of a type that parameters use: an enumeration or a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TypeDoc {
    /// The name of the type.
    pub name: String,
    /// The description of the type.
    pub doc: String,
    /// The fields of the type, if the type is a struct. A struct is written `(a: .., b: ..)`.
    pub fields: Vec<FieldDoc>,
    /// The variants of the type, if the type is an enumeration.
    pub variants: Vec<VariantDoc>,
}

impl TypeDoc {
    /// Whether the type is a selection or a region. Regions are used only in selections.
    pub fn is_selection(&self) -> bool {
        self.name.ends_with("Selection") || self.name == "Region"
    }
}

/// Returns the structs and enumerations that the parameters of an operation use, sorted by name.
pub fn types(schema: &Json) -> Vec<TypeDoc> {
    let root = Schema::root(schema);
    let mut types: Vec<TypeDoc> = root
        .definitions()
        .map(|(name, definition)| TypeDoc {
            name: name.to_owned(),
            doc: definition.doc(),
            fields: fields_of(&definition, true),
            variants: variants(&definition),
        })
        .filter(|t| !t.fields.is_empty() || !t.variants.is_empty())
        .collect();
    types.sort_by(|a, b| a.name.cmp(&b.name));
    types
}

/// Returns the reasons for a refusal that a recipe can name in `refused:`.
pub fn refusals() -> Vec<VariantDoc> {
    variants(&Schema::root(&crate::schema::of::<op::Refusal>()))
}

/// Returns the documentation of all expectations, in a fixed order.
pub fn expectations() -> Vec<VariantDoc> {
    variants(&Schema::root(crate::schema::expectation()))
}

/// Returns the documentation of the selection types, and of the type of regions that some selections use.
pub fn selections() -> Vec<TypeDoc> {
    let mut all = types(crate::schema::expectation());
    all.retain(TypeDoc::is_selection);
    all
}

/// Describes the kind of value that a schema allows. The description is the name of the type or, if the type is a tuple
/// or has no name, the form of the value.
fn kind(schema: &Schema) -> String {
    match schema.reference() {
        Some(name) if schema.list("prefixItems").is_empty() => name.to_owned(),
        _ => form(schema),
    }
}

/// Describes the form of a value, without the name of its type.
fn form(schema: &Schema) -> String {
    let options = schema.list("anyOf");
    if !options.is_empty() {
        let not_null = options.iter().find(|option| option.types() != ["null"]);
        return not_null.map_or_else(|| "value".to_owned(), kind);
    }
    if let Some(items) = schema.tuple() {
        let items: Vec<String> = items.iter().map(kind).collect();
        return format!("({})", items.join(", "));
    }
    match schema.types()[..] {
        ["array", ..] => {
            let items = schema.child("items").as_ref().map(kind);
            format!("[{}, ..]", items.as_deref().unwrap_or("value"))
        }
        ["integer", ..] => format!("whole number{}", range(schema)),
        ["number", ..] => format!("number{}", range(schema)),
        ["string", ..] => "text".to_owned(),
        ["boolean", ..] => "true or false".to_owned(),
        [other, ..] => other.to_owned(),
        [] => "value".to_owned(),
    }
}

/// Describes the allowed range of a number, such as ` from 2 to 720`, ` above 0` or `, at least 3`. The text is empty
/// if every number is allowed.
fn range(schema: &Schema) -> String {
    let bound = |keyword| schema.numbers(keyword).next();
    let lowest = bound("minimum");
    let highest = bound("maximum").map(number);
    let above = bound("exclusiveMinimum").map(|x| format!("above {}", number(x)));
    let below = bound("exclusiveMaximum").map(|x| format!("below {}", number(x)));
    if let (Some(lowest), Some(highest)) = (lowest, &highest) {
        return format!(" from {} to {highest}", number(lowest));
    }
    // The minimum 0 of an unsigned integer is not shown if there is no maximum.
    let is_number = schema.own("type").is_some_and(|name| name == "number");
    let lowest = lowest.filter(|x| is_number || x.as_u64() != Some(0));
    let is_inclusive = lowest.is_some() || highest.is_some();
    let lowest = lowest.map(|x| format!("at least {}", number(x)));
    let highest = highest.map(|x| format!("at most {x}"));
    let bounds: Vec<String> = [lowest, above, highest, below]
        .into_iter()
        .flatten()
        .collect();
    match (bounds.is_empty(), is_inclusive) {
        (true, _) => String::new(),
        (false, true) => format!(", {}", bounds.join(" and ")),
        (false, false) => format!(" {}", bounds.join(" and ")),
    }
}

/// Formats a number of a schema. A whole number is written without a decimal point.
fn number(x: &serde_json::Number) -> String {
    let text = x.to_string();
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

fn variants(schema: &Schema) -> Vec<VariantDoc> {
    let units = |schema: &Schema, doc: &str| {
        let unit = |name: &str| VariantDoc {
            name: name.to_owned(),
            written: name.to_owned(),
            doc: doc.to_owned(),
            fields: Vec::new(),
        };
        schema.units().into_iter().map(unit).collect()
    };
    let options = schema.list("oneOf");
    if options.is_empty() {
        return units(schema, "");
    }
    let described = |option: &Schema| -> Vec<VariantDoc> {
        let Some((name, content)) = option
            .fields()
            .next()
            .and_then(|name| Some((name, option.field(name)?)))
        else {
            return units(option, &option.doc());
        };
        let fields = fields_of(&content, false);
        let inside = if fields.is_empty() {
            match form(&content) {
                tuple if tuple.starts_with('(') => {
                    vec![".."; content.tuple().map_or(0, |items| items.len())].join(", ")
                }
                list if list.starts_with('[') => "[..]".to_owned(),
                _ => "..".to_owned(),
            }
        } else {
            let written: Vec<String> = fields.iter().map(|f| format!("{}: ..", f.name)).collect();
            written.join(", ")
        };
        vec![VariantDoc {
            name: name.to_owned(),
            written: format!("{name}({inside})"),
            doc: option.doc(),
            fields,
        }]
    };
    options.iter().flat_map(described).collect()
}

/// Formats a default value of this schema as RON.
fn default_of(schema: &Schema, value: &Json) -> String {
    let is_list = schema.child("items").is_some() && schema.tuple().is_none();
    match value {
        Json::Array(items) if is_list => {
            let items: Vec<String> = items.iter().map(to_ron).collect();
            format!("[{}]", items.join(", "))
        }
        other => to_ron(other),
    }
}

/// Formats a JSON value as RON. An object with only one key is written as a variant if the key starts with a capital
/// letter. An array of 1 to 4 numbers is written as a tuple. Fields without a value are omitted.
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
                .filter(|(_, value)| !value.is_null())
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
        Json::Number(x) => number(x),
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
        /// How large.
        #[schemars(range(min = 3))]
        size: u32,
        /// How much.
        #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 1.0))]
        part: f64,
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
                "at: (number, number, number) = Some(\"(0, 0, 0)\"), Where.",
                "on_refusal: OnRefusal = Some(\"Error\"), What then.",
                "some: [number, ..] = Some(\"[0.5]\"), Some numbers.",
                "two: (whole number from 0 to 255, whole number from 0 to 255) = Some(\"(0, 0)\"), Two numbers.",
                "size: whole number, at least 3 = None, How large.",
                "part: number above 0 and below 1 = None, How much.",
            ]
        );
        assert!(
            fields[0]
                .variants
                .iter()
                .any(|v| v.written == "Between(.., ..)")
        );
        assert!(
            fields[0]
                .variants
                .iter()
                .any(|v| v.written == "Sharp(above: ..)")
        );
        assert_eq!(fields[3].variants[1].written, "Skip");
    }
}
