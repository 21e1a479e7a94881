//! The kinds of a panel's fields, and the values that the widgets of the fields show. The kinds are read from JSON
//! schemas.

use op::ElementKind;
use ron_tree::{Number, Value, ValueKind, parse, string_literal};
use serde_json::Value as Json;

use super::parts::{Variant, first_fields};
use super::{PanelField, panel_fields};

/// Which values a field can have.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldKind {
    /// A number.
    Number(Limits),
    /// A whole number.
    Integer(Limits),
    /// `true` or `false`.
    Bool,
    /// One of several names. Each name has a description.
    Choice(Vec<(String, String)>),
    /// A text in quotes.
    Text,
    /// A tuple of two or three numbers, such as `(x, y, z)`. `Vector(3)` stands for a tuple of three numbers.
    Vector(usize),
    /// A tuple of whole numbers, such as `(1280, 960)`. The variant contains the number of items (2 or 3), and the
    /// range of each item.
    Integers(usize, Limits),
    /// One variant of an enumeration in which some variants have content.
    Variants(Vec<Variant>),
    /// A struct with these fields.
    Struct(Vec<PanelField>),
    /// A selection of elements. If `None`, the selection can select elements of any kind.
    Selection(Option<ElementKind>),
    /// Any other type. The widget of the field is a text field for RON, and the text is checked.
    Other,
    /// A value of this kind, or none.
    Optional(Box<FieldKind>),
}

/// The range of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// The minimum.
    pub min: Option<f64>,
    /// Whether a value must be greater than the minimum, not equal to it.
    pub above_min: bool,
    /// The maximum.
    pub max: Option<f64>,
    /// Whether a value must be less than the maximum, not equal to it.
    pub below_max: bool,
}

impl Limits {
    /// Whether a value is in the range.
    pub fn allows(&self, value: f64) -> bool {
        let low = self
            .min
            .is_none_or(|min| value > min || (value == min && !self.above_min));
        let high = self
            .max
            .is_none_or(|max| value < max || (value == max && !self.below_max));
        low && high && value.is_finite()
    }

    /// Returns an initial number that is in the range. If 1 is in the range, returns 1.
    fn first(&self) -> f64 {
        match (self.min, self.max) {
            _ if self.allows(1.0) => 1.0,
            (Some(min), Some(max)) => f64::midpoint(min, max),
            (Some(min), None) => min + 1.0,
            (None, Some(max)) => max - 1.0,
            (None, None) => 0.0,
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "conversions from f64 saturate"
)]
fn integer(x: f64) -> i64 {
    x.round() as i64
}

impl FieldKind {
    /// Returns the kind of a field whose values have this JSON schema. References in the schema are looked up in the
    /// schema `root`.
    pub(super) fn at_depth(json: &Json, root: &Json, depth: usize) -> Self {
        // Schemas can refer to themselves, so the depth is limited.
        if depth > 8 {
            return Self::Other;
        }
        if let Some(path) = json["$ref"].as_str() {
            let name = path.rsplit('/').next().unwrap_or_default();
            return match name {
                "VertexSelection" => Self::Selection(Some(ElementKind::Vertices)),
                "EdgeSelection" => Self::Selection(Some(ElementKind::Edges)),
                "FaceSelection" => Self::Selection(Some(ElementKind::Faces)),
                "Elements" => Self::Selection(None),
                _ => match path.strip_prefix('#').and_then(|path| root.pointer(path)) {
                    Some(target) => Self::at_depth(target, root, depth + 1),
                    None => Self::Other,
                },
            };
        }
        if let Some(parts) = json["allOf"].as_array() {
            return match &parts[..] {
                [one] => Self::at_depth(one, root, depth + 1),
                _ => Self::Other,
            };
        }
        if let Some(options) = json["anyOf"].as_array() {
            let others: Vec<&Json> = options
                .iter()
                .filter(|option| option["type"] != "null")
                .collect();
            return match &others[..] {
                [one] if options.len() == 2 => {
                    Self::Optional(Box::new(Self::at_depth(one, root, depth + 1)))
                }
                _ => Self::Other,
            };
        }
        if let Some(choice) = choice(json) {
            return Self::Choice(choice);
        }
        if let Some(variants) = Variant::all(json, root, depth + 1) {
            return Self::Variants(variants);
        }
        let (name, is_optional) = match &json["type"] {
            Json::String(name) => (name.as_str(), false),
            Json::Array(names) => {
                let mut others = names
                    .iter()
                    .filter_map(Json::as_str)
                    .filter(|name| *name != "null");
                match (others.next(), others.next()) {
                    (Some(name), None) => (name, names.len() > 1),
                    _ => return Self::Other,
                }
            }
            _ => return Self::Other,
        };
        let kind = match name {
            "number" => Self::Number(limits(json)),
            "integer" => Self::Integer(limits(json)),
            "boolean" => Self::Bool,
            "string" => Self::Text,
            "array" => tuple(json).unwrap_or(Self::Other),
            "object" if json["properties"].is_object() => {
                Self::Struct(panel_fields(json, root, depth + 1))
            }
            _ => Self::Other,
        };
        if is_optional {
            Self::Optional(Box::new(kind))
        } else {
            kind
        }
    }

    /// Returns an initial value of this kind, for a parameter that was not set before.
    pub fn first(&self) -> FieldValue {
        match self {
            Self::Number(limits) => FieldValue::Number(limits.first()),
            Self::Integer(limits) => FieldValue::Integer(integer(limits.first())),
            Self::Bool => FieldValue::Bool(false),
            Self::Choice(names) => FieldValue::Choice(
                names
                    .first()
                    .map_or_else(String::new, |(name, _)| name.clone()),
            ),
            Self::Text => FieldValue::Text(String::new()),
            Self::Vector(n) => FieldValue::Vector(vec![0.0; *n]),
            Self::Integers(n, limits) => FieldValue::Integers(vec![integer(limits.first()); *n]),
            Self::Variants(all) => {
                FieldValue::Ron(all.first().map_or_else(String::new, Variant::first))
            }
            Self::Struct(fields) => FieldValue::Ron(first_fields(fields)),
            Self::Selection(_) => FieldValue::Ron("All".to_owned()),
            Self::Other | Self::Optional(_) => FieldValue::Ron(String::new()),
        }
    }

    /// If the kind is `Optional`, returns the kind inside it. If the kind is not `Optional`, returns the kind itself.
    pub fn inner(&self) -> &Self {
        match self {
            Self::Optional(inner) => inner.inner(),
            kind => kind,
        }
    }
}

/// If no variant of an enumeration has content, returns the names of the variants.
fn choice(json: &Json) -> Option<Vec<(String, String)>> {
    let text = |json: &Json| json.as_str().map(str::to_owned);
    if let Some(names) = json["enum"].as_array() {
        return names
            .iter()
            .map(|name| Some((text(name)?, String::new())))
            .collect();
    }
    let mut names = Vec::new();
    for option in json["oneOf"].as_array()? {
        let doc = text(&option["description"]).unwrap_or_default();
        match &option["enum"] {
            Json::Array(list) => {
                for name in list {
                    names.push((text(name)?, doc.clone()));
                }
            }
            _ => names.push((text(&option["const"])?, doc)),
        }
    }
    Some(names)
}

fn limits(json: &Json) -> Limits {
    let number = |key: &str| json[key].as_f64();
    let (above, below) = (number("exclusiveMinimum"), number("exclusiveMaximum"));
    Limits {
        min: above.or_else(|| number("minimum")),
        above_min: above.is_some(),
        max: below.or_else(|| number("maximum")),
        below_max: below.is_some(),
    }
}

/// Returns the kind of a tuple of two or three numbers. Returns `None` if the schema allows other items, or items with
/// different limits.
fn tuple(json: &Json) -> Option<FieldKind> {
    let (n, item) = if let Some(items) = json["prefixItems"].as_array() {
        let first = items.first()?;
        (items.iter().all(|item| item == first)).then_some((items.len(), first))?
    } else {
        let n = json["minItems"].as_u64()?;
        let is_fixed = json["maxItems"].as_u64() == Some(n);
        is_fixed.then_some((usize::try_from(n).ok()?, &json["items"]))?
    };
    let kind = match item["type"].as_str()? {
        "number" => FieldKind::Vector(n),
        "integer" => FieldKind::Integers(n, limits(item)),
        _ => return None,
    };
    (2..=3).contains(&n).then_some(kind)
}

/// The value of a field, as a widget shows it.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValue {
    /// A number.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// `true` or `false`.
    Bool(bool),
    /// The chosen name, for a kind that allows one of several names.
    Choice(String),
    /// A text, without its quotes.
    Text(String),
    /// A tuple of numbers.
    Vector(Vec<f64>),
    /// A tuple of whole numbers.
    Integers(Vec<i64>),
    /// Any other value as RON.
    Ron(String),
    /// The field is optional and has no value.
    None,
}

impl FieldValue {
    /// Returns the value as RON.
    pub fn to_ron(&self) -> String {
        match self {
            Self::Number(x) => number(*x),
            Self::Integer(n) => n.to_string(),
            Self::Bool(is) => is.to_string(),
            Self::Choice(name) => name.clone(),
            Self::Text(text) => string_literal(text),
            Self::Vector(parts) => {
                let parts: Vec<String> = parts.iter().map(|x| number(*x)).collect();
                format!("({})", parts.join(", "))
            }
            Self::Integers(parts) => {
                let parts: Vec<String> = parts.iter().map(i64::to_string).collect();
                format!("({})", parts.join(", "))
            }
            Self::Ron(text) => text.clone(),
            Self::None => "None".to_owned(),
        }
    }

    /// Parses the RON text of a value of the given kind. Returns `None` if the text is not a value of this kind.
    pub fn read(kind: &FieldKind, text: &str) -> Option<Self> {
        let parsed = parse(text);
        if !parsed.diagnostics.is_empty() {
            return None;
        }
        let value = &parsed.value;
        if let FieldKind::Optional(inner) = kind {
            if value.name() == Some(("None", value.span)) || text == "none" {
                return Some(Self::None);
            }
            return Self::read(
                inner,
                value.some().map_or(text, |inner| inner.span.of(text)),
            );
        }
        Some(match (kind, &value.kind) {
            (FieldKind::Number(_), ValueKind::Number(number)) => Self::Number(number.to_float()),
            (FieldKind::Integer(_), ValueKind::Number(number)) => {
                Self::Integer(i64::try_from(number.to_int()?).ok()?)
            }
            (FieldKind::Bool, ValueKind::Bool(is)) => Self::Bool(*is),
            (FieldKind::Choice(names), ValueKind::Name(name)) => names
                .iter()
                .any(|(known, _)| **known == **name)
                .then(|| Self::Choice(name.to_string()))?,
            (FieldKind::Text, ValueKind::String(text)) => Self::Text(text.to_string()),
            (FieldKind::Vector(n), ValueKind::Tuple(items)) if items.len() == *n => {
                let number = |item: &Value| match &item.kind {
                    ValueKind::Number(number) => Some(Number::to_float(number)),
                    _ => None,
                };
                Self::Vector(items.iter().map(number).collect::<Option<_>>()?)
            }
            (FieldKind::Integers(n, _), ValueKind::Tuple(items)) if items.len() == *n => {
                let whole = |item: &Value| match &item.kind {
                    ValueKind::Number(number) => i64::try_from(number.to_int()?).ok(),
                    _ => None,
                };
                Self::Integers(items.iter().map(whole).collect::<Option<_>>()?)
            }
            (FieldKind::Variants(variants), _) => {
                let name = value.name()?.0;
                let is_known = variants.iter().any(|variant| variant.name == name);
                is_known.then(|| Self::Ron(text.to_owned()))?
            }
            (FieldKind::Struct(_), ValueKind::Struct(_) | ValueKind::Unit)
            | (FieldKind::Selection(_) | FieldKind::Other, _) => Self::Ron(text.to_owned()),
            _ => return None,
        })
    }
}

/// Returns the shortest text for a number, such as `2` or `0.5`. If the text is parsed, the result is exactly the same
/// number.
pub(crate) fn number(x: f64) -> String {
    if x.is_finite() && x.abs() < 1e15 && x.abs() >= 1e-5 || x == 0.0 {
        let text = format!("{x}");
        return text;
    }
    format!("{x:?}")
}
