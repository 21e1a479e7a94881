//! Values that consist of parts: structs, and enumeration variants with content. In the panel, each part of a value has
//! its own field.

use ron_tree::{Value, ValueKind, parse};
use serde_json::Value as Json;

use super::{FieldKind, PanelField, argument, panel_fields};
use crate::text;

/// A variant of an enumeration.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// The name.
    pub name: String,
    /// The description.
    pub doc: String,
    /// What the parentheses contain.
    content: Content,
}

/// The content of a variant, which is written in parentheses.
#[derive(Clone, Debug, PartialEq)]
enum Content {
    /// `Name`
    Nothing,
    /// `Name(value)`
    Value(FieldKind),
    /// `Name(x, y, z)`
    Tuple(FieldKind),
    /// `Name(field: value, ..)`
    Fields(Vec<PanelField>),
}

/// A part of a value: the field of a struct, or the content of a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The field that shows the part, with the value of the part.
    pub field: PanelField,
    /// The path that leads from the whole value to the part. The path is empty if the part consists of all numbers of
    /// `Name(x, y, z)`.
    path: Vec<String>,
}

impl Variant {
    /// Returns the variants of an enumeration. Returns `None` if the schema is not an enumeration.
    pub(super) fn all(json: &Json, root: &Json, depth: usize) -> Option<Vec<Self>> {
        let options = json["oneOf"].as_array()?;
        let all = options.iter().map(|option| {
            let doc = option["description"]
                .as_str()
                .unwrap_or_default()
                .to_owned();
            if let Some(name) = option["const"].as_str() {
                return Some(vec![Self::new(name, doc, Content::Nothing)]);
            }
            if let Some(names) = option["enum"].as_array() {
                let unit =
                    |name: &Json| Some(Self::new(name.as_str()?, doc.clone(), Content::Nothing));
                return names.iter().map(unit).collect();
            }
            let (name, content) = option["properties"].as_object()?.iter().next()?;
            Some(vec![Self::new(
                name,
                doc,
                Content::of(content, root, depth),
            )])
        });
        Some(all.collect::<Option<Vec<_>>>()?.concat())
    }

    fn new(name: &str, doc: String, content: Content) -> Self {
        Self {
            name: name.to_owned(),
            doc,
            content,
        }
    }

    /// Returns an initial value of this variant as RON. Parts that have no default get an initial value.
    pub fn first(&self) -> String {
        let name = &self.name;
        match &self.content {
            Content::Nothing => name.clone(),
            Content::Value(kind) => format!("{name}({})", kind.first().to_ron()),
            Content::Tuple(kind) => format!("{name}{}", kind.first().to_ron()),
            Content::Fields(fields) => format!("{name}{}", first_fields(fields)),
        }
    }
}

impl Content {
    fn of(json: &Json, root: &Json, depth: usize) -> Self {
        if json["properties"].is_object() {
            return Self::Fields(panel_fields(json, root, depth));
        }
        // If the content is a tuple type without a name, the variant has several values in its parentheses:
        // `Name(x, y, z)`.
        match FieldKind::at_depth(json, root, depth) {
            kind @ (FieldKind::Vector(_) | FieldKind::Integers(..)) if json["$ref"].is_null() => {
                Self::Tuple(kind)
            }
            kind => Self::Value(kind),
        }
    }
}

/// Returns the initial value of a struct with these fields.
pub(super) fn first_fields(fields: &[PanelField]) -> String {
    let required = fields.iter().filter(|field| field.default.is_none());
    let written = required.map(|field| format!("{}: {}", field.name, field.kind.first().to_ron()));
    format!("({})", written.collect::<Vec<_>>().join(", "))
}

impl FieldKind {
    /// Returns the parts of a value of this kind. If the kind is an enumeration, also returns the name of the value's
    /// variant. The list of parts is empty if the value has no parts, or if it is not a value of this kind.
    pub fn parts(&self, whole: &str) -> (Option<String>, Vec<Part>) {
        let parsed = parse(whole);
        let value = parsed.value.some().unwrap_or(&parsed.value);
        match self.inner() {
            Self::Struct(fields) => (None, parts_of(fields, &[], value, whole)),
            Self::Variants(variants) => {
                let name = value.name().map(|(name, _)| name);
                let Some(variant) = variants.iter().find(|v| Some(v.name.as_str()) == name) else {
                    return (None, Vec::new());
                };
                (Some(variant.name.clone()), variant.parts(value, whole))
            }
            _ => (None, Vec::new()),
        }
    }
}

impl Variant {
    fn parts(&self, value: &Value, whole: &str) -> Vec<Part> {
        let name = self.name.clone();
        let single = |kind: FieldKind, path: Vec<String>, value: Option<&str>| {
            vec![Part {
                field: PanelField {
                    name: self.name.clone(),
                    doc: self.doc.clone(),
                    kind,
                    type_name: String::new(),
                    variants: Vec::new(),
                    default: None,
                    argument: value.and_then(argument),
                    value: value.map(str::to_owned),
                },
                path,
            }]
        };
        match &self.content {
            Content::Nothing => Vec::new(),
            Content::Value(kind) => {
                let path = vec![name, "0".to_owned()];
                let inside = text::field_value(value, &path);
                single(
                    kind.clone(),
                    path,
                    inside.map(|inside| inside.span.of(whole)),
                )
            }
            Content::Tuple(kind) => {
                let body = match &value.kind {
                    ValueKind::Call(call) => Some(call.body.span.of(whole)),
                    _ => None,
                };
                single(kind.clone(), Vec::new(), body)
            }
            Content::Fields(fields) => parts_of(fields, &[name], value, whole),
        }
    }
}

fn parts_of(fields: &[PanelField], outer: &[String], value: &Value, whole: &str) -> Vec<Part> {
    let part = |field: &PanelField| {
        let path: Vec<String> = outer.iter().chain([&field.name]).cloned().collect();
        let inside = text::field_value(value, &path).map(|inside| inside.span.of(whole));
        Part {
            field: PanelField {
                value: inside.map(str::to_owned),
                argument: inside.and_then(argument),
                ..field.clone()
            },
            path,
        }
    };
    fields.iter().map(part).collect()
}

impl Part {
    /// Replaces the value of this part with `new`, and returns the new whole value as RON. If `new` is `None`, the part
    /// is removed from the text. The part then has its default value. Returns `None` if the part cannot be written into
    /// the whole value.
    pub fn in_whole(&self, whole: &str, new: Option<&str>) -> Option<String> {
        if self.path.is_empty() {
            return Some(format!("{}{}", self.field.name, new?));
        }
        let parsed = parse(whole);
        let edits = text::set_field(whole, &parsed.value, &self.path, new).ok()?;
        text::apply(whole, edits).ok()
    }
}
