//! Reads the JSON schemas that `schemars` derives (draft 2020-12).

use super::listed;
use mesh::counted;
use serde_json::{Map, Value as Json};

/// A JSON schema, together with the schemas to which it refers.
#[derive(Clone, Debug)]
pub(crate) struct Schema<'s> {
    root: &'s Json,
    /// The layers: the schema itself, and the schemas that it includes by `$ref` and `allOf`. A value must fit all of
    /// them.
    layers: Vec<&'s Map<String, Json>>,
    /// The name of the Rust type, if it has one.
    name: Option<&'s str>,
    /// Whether the schema is given by a reference (`$ref`) to a definition in `$defs`.
    is_reference: bool,
}

/// The alternatives of a schema: the variants of an enumeration, or other schemas.
#[derive(Debug, Default)]
pub(super) struct Choice<'s> {
    /// The names of the variants without content.
    pub(super) units: Vec<&'s str>,
    /// Variants with content. The schema of the content of a variant is read only when it is needed.
    variants: Vec<(&'s str, &'s Json)>,
    root: Option<&'s Json>,
    /// All other alternatives except null, such as the type inside an option.
    pub(super) others: Vec<Schema<'s>>,
}

/// The maximum number of layers (a schema and the schemas that it includes). A limit is necessary because a schema can
/// refer to itself.
const MAX_LAYERS: usize = 32;

impl<'s> Schema<'s> {
    pub(crate) fn root(root: &'s Json) -> Self {
        let mut schema = Self::new(root, root);
        schema.name = schema.text("title");
        schema
    }

    /// Creates the schema of `json`. References in `json` are looked up in `root`.
    pub(crate) fn new(root: &'s Json, json: &'s Json) -> Self {
        let mut schema = Self {
            root,
            layers: Vec::new(),
            name: None,
            is_reference: false,
        };
        schema.add(json);
        schema
    }

    fn add(&mut self, json: &'s Json) {
        let Json::Object(layer) = json else { return };
        if self.layers.len() >= MAX_LAYERS {
            return;
        }
        self.layers.push(layer);
        if let Some(path) = layer.get("$ref").and_then(Json::as_str) {
            self.is_reference = true;
            self.name = self.name.or(path.rsplit('/').next());
            // A reference to a missing definition is ignored.
            if let Some(target) = path
                .strip_prefix('#')
                .and_then(|path| self.root.pointer(path))
            {
                self.add(target);
            }
        }
        for part in layer
            .get("allOf")
            .and_then(Json::as_array)
            .into_iter()
            .flatten()
        {
            self.add(part);
        }
    }

    /// Returns the values that a keyword has in this schema and in the schemas that it includes. The outermost schema
    /// comes first.
    fn all(&self, keyword: &str) -> impl Iterator<Item = &'s Json> {
        self.layers
            .iter()
            .filter_map(move |layer| layer.get(keyword))
    }

    fn text(&self, keyword: &str) -> Option<&'s str> {
        self.all(keyword).find_map(Json::as_str)
    }

    /// Returns the numbers that a keyword has in this schema and in the schemas that it includes.
    pub(crate) fn numbers(&self, keyword: &str) -> impl Iterator<Item = &'s serde_json::Number> {
        self.all(keyword).filter_map(Json::as_number)
    }

    /// Returns the value of a keyword that contains a count, such as `minItems`.
    pub(super) fn count(&self, keyword: &str) -> Option<u64> {
        self.all(keyword).find_map(Json::as_u64)
    }

    /// Returns the value of a keyword in the schema itself. The schemas to which it refers are ignored.
    pub(crate) fn own(&self, keyword: &str) -> Option<&'s Json> {
        self.layers.first()?.get(keyword)
    }

    /// Returns the description in the schema itself. If there is no description, the result is empty.
    pub(crate) fn doc(&self) -> String {
        let doc = self.own("description").and_then(Json::as_str);
        doc.unwrap_or_default().to_owned()
    }

    /// Returns the name of the type, if the schema is a reference to a named type.
    pub(crate) fn reference(&self) -> Option<&'s str> {
        self.name.filter(|_| self.is_reference)
    }

    /// Returns the named types in `$defs`.
    pub(crate) fn definitions(&self) -> impl Iterator<Item = (&'s str, Self)> {
        let (root, all) = (self.root, self.own("$defs").and_then(Json::as_object));
        let definitions = all.into_iter().flatten();
        definitions.map(move |(name, json)| (name.as_str(), Self::new(root, json)))
    }

    /// Returns the schemas in the list that is the value of a keyword.
    pub(crate) fn list(&self, keyword: &str) -> Vec<Self> {
        let items = self.all(keyword).filter_map(Json::as_array).flatten();
        items.map(|item| Self::new(self.root, item)).collect()
    }

    pub(super) fn format(&self) -> Option<&'s str> {
        self.text("format")
    }

    pub(super) fn name(&self) -> Option<&'s str> {
        self.name
    }

    pub(crate) fn child(&self, keyword: &str) -> Option<Self> {
        self.all(keyword)
            .next()
            .map(|json| Self::new(self.root, json))
    }

    /// Returns the allowed types. `null` is included only if no other type is allowed. If every type is allowed, the
    /// result is empty.
    pub(crate) fn types(&self) -> Vec<&'s str> {
        let mut types: Vec<&str> = match self.all("type").next() {
            Some(Json::String(name)) => vec![name],
            Some(Json::Array(names)) => names.iter().filter_map(Json::as_str).collect(),
            _ if self.has("properties") => vec!["object"],
            _ if self.has("items") || self.has("prefixItems") => vec!["array"],
            _ => Vec::new(),
        };
        if types.len() > 1 {
            types.retain(|&name| name != "null");
        }
        types
    }

    fn has(&self, keyword: &str) -> bool {
        self.all(keyword).next().is_some()
    }

    /// Whether a value can omit the name of its variant.
    pub(super) fn is_shorthand(&self) -> bool {
        self.all("x-shorthand").any(|is| is == &Json::Bool(true))
    }

    /// Whether `None` is allowed in addition to other values.
    pub(super) fn is_nullable(&self) -> bool {
        let by_type = match self.all("type").next() {
            Some(Json::Array(names)) => names.len() > 1 && names.iter().any(|name| name == "null"),
            _ => false,
        };
        by_type
            || self
                .parts()
                .any(|part| part.get("type").is_some_and(|t| t == "null"))
    }

    /// Returns the alternatives of the schema as JSON.
    fn parts(&self) -> impl Iterator<Item = &'s Json> {
        let lists = ["oneOf", "anyOf"].into_iter().flat_map(|key| self.all(key));
        lists.filter_map(Json::as_array).flatten()
    }

    /// Returns the names of the variants, if the schema describes an enumeration.
    pub(crate) fn variants(&self) -> Vec<&'s str> {
        self.choice()
            .map_or_else(Vec::new, |choice| choice.names().collect())
    }

    /// Returns the alternatives of the schema, if it has any.
    pub(super) fn choice(&self) -> Option<Choice<'s>> {
        let mut choice = Choice {
            root: Some(self.root),
            ..Choice::default()
        };
        let mut found = self.add_units(&mut choice);
        for part in self.parts() {
            found = true;
            // This fast path handles the most common alternatives: a name, or a name with content.
            if let Some(name) = unit(part) {
                choice.units.push(name);
                continue;
            }
            if let Some(variant) = variant(part) {
                choice.variants.push(variant);
                continue;
            }
            let schema = Self::new(self.root, part);
            let is_plain = schema.is_reference || !schema.add_units(&mut choice);
            if is_plain && schema.types() != ["null"] {
                choice.others.push(schema);
            }
        }
        found.then_some(choice)
    }

    /// If the schema describes strings, adds the names in its `enum` and `const`. Returns whether any names were added.
    fn add_units(&self, choice: &mut Choice<'s>) -> bool {
        let before = choice.units.len();
        choice.units.extend(self.units());
        choice.units.len() > before
    }

    /// If the schema describes strings, returns the names in its `enum` and `const`.
    pub(crate) fn units(&self) -> Vec<&'s str> {
        if !self.types().iter().all(|&name| name == "string") {
            return Vec::new();
        }
        let lists = self.all("enum").filter_map(Json::as_array).flatten();
        let names = lists.chain(self.all("const"));
        names.filter_map(Json::as_str).collect()
    }

    /// If the schema describes an array of fixed length, returns the schemas of its items.
    pub(crate) fn tuple(&self) -> Option<Vec<Self>> {
        let items = self.list("prefixItems");
        if !items.is_empty() {
            return Some(items);
        }
        let most = self.count("maxItems")?;
        if most == 0 {
            return Some(Vec::new());
        }
        let length = (self.count("minItems")? == most).then_some(most)?;
        let item = self.child("items")?;
        // The limit prevents huge lists for invalid schemas. `serde` itself supports arrays of up to 32 items.
        Some(vec![
            item;
            usize::try_from(length).ok().filter(|&n| n <= 64)?
        ])
    }

    /// Whether an object of this schema is a map and not a struct.
    pub(super) fn is_map(&self) -> bool {
        let open = self
            .all("additionalProperties")
            .any(|json| json != &Json::Bool(false));
        !self.has("properties") && (open || self.has("patternProperties"))
    }

    /// Whether the keys of the map are strings. If the keys are not strings, the schema does not describe them
    /// precisely.
    pub(super) fn has_text_keys(&self) -> bool {
        !self.has("patternProperties")
    }

    /// Returns the schema of the values of a map.
    pub(super) fn map_values(&self) -> Option<Self> {
        let by_pattern = self
            .all("patternProperties")
            .filter_map(Json::as_object)
            .flatten();
        let json = by_pattern.map(|(_, json)| json).next();
        let json = json.or_else(|| self.all("additionalProperties").next())?;
        Some(Self::new(self.root, json))
    }

    /// Returns the names of the fields of a struct.
    pub(crate) fn fields(&self) -> impl Iterator<Item = &'s str> {
        self.all("properties")
            .filter_map(Json::as_object)
            .flatten()
            .map(|(name, _)| name.as_str())
    }

    pub(crate) fn field(&self, name: &str) -> Option<Self> {
        let mut found = self.all("properties").filter_map(|fields| fields.get(name));
        found.next().map(|json| Self::new(self.root, json))
    }

    /// Finds the field that has the name `name`, or had this name in an earlier version. Returns the current name and
    /// the schema of the field.
    pub(super) fn field_or_alias(&self, name: &str) -> Option<(&'s str, Self)> {
        let fields = || self.all("properties").filter_map(Json::as_object).flatten();
        let (current, json) = fields()
            .find(|(current, _)| *current == name)
            .or_else(|| fields().find(|(_, json)| has_alias(json, name)))?;
        Some((current, Self::new(self.root, json)))
    }

    /// Returns the current name of the variant that had this name in an earlier version.
    pub(super) fn variant_by_alias(&self, name: &str) -> Option<&'s str> {
        let part = self.parts().find(|part| has_alias(part, name))?;
        let unit = part["const"].as_str();
        unit.or_else(|| Some(part["properties"].as_object()?.keys().next()?.as_str()))
    }

    /// Returns the names of the required fields.
    pub(crate) fn required(&self) -> impl Iterator<Item = &'s str> {
        self.all("required")
            .filter_map(Json::as_array)
            .flatten()
            .filter_map(Json::as_str)
    }

    /// Whether the content of a variant is a single value inside its parentheses, as in `Not((a: 1))`. The content of
    /// other variants is a list of fields or items, as in `Random(count: 1)`.
    pub(super) fn is_one_value(&self) -> bool {
        let types = self.types();
        let spread = match types.as_slice() {
            ["object"] => !self.is_map(),
            ["array"] => self.has("prefixItems") || self.count("maxItems") == Some(0),
            _ => false,
        };
        self.is_reference || !spread || self.is_nullable()
    }

    /// Describes the expected value in a few words.
    pub(super) fn expectation(&self) -> String {
        if let Some(choice) = self.choice() {
            let names: Vec<&str> = choice.names().collect();
            return match (self.name, choice.others.as_slice()) {
                (_, [one, ..]) => one.expectation(),
                (Some(name), []) if names.len() > 6 => article(name),
                _ => format!("one of {}", listed(names)),
            };
        }
        match self.types()[..] {
            [name, ..] => self.type_expectation(name),
            [] => "a value".to_owned(),
        }
    }

    fn type_expectation(&self, name: &str) -> String {
        match name {
            "integer" => "a whole number".to_owned(),
            "number" => "a number".to_owned(),
            "string"
                if self.count("maxLength") == Some(1) && self.count("minLength") == Some(1) =>
            {
                "a character `'c'`".to_owned()
            }
            "string" => "a string".to_owned(),
            "boolean" => "`true` or `false`".to_owned(),
            "null" => "`()`".to_owned(),
            "array" => match self.tuple() {
                Some(items) => {
                    format!(
                        "{} in brackets `({})`",
                        counted(items.len(), "value"),
                        dots(items.len())
                    )
                }
                None => "a list `[..]`".to_owned(),
            },
            "object" if self.is_map() => "a map `{..}`".to_owned(),
            "object" => format!("named fields `{}`", self.usage("")),
            other => format!("a value of type {other}"),
        }
    }

    /// Describes the form in which a variant or struct is written, such as `Name(count: .., seed: ..)`.
    pub(super) fn usage(&self, name: &str) -> String {
        if self.is_one_value() && !name.is_empty() {
            return format!("{name}(..)");
        }
        if let Some(items) = self.tuple() {
            return format!("{name}({})", dots(items.len()));
        }
        let mut fields: Vec<&str> = self.required().collect();
        if fields.is_empty() {
            fields = self.fields().take(1).collect();
        }
        let fields: Vec<String> = fields
            .iter()
            .take(4)
            .map(|field| format!("{field}: .."))
            .collect();
        format!("{name}({})", fields.join(", "))
    }
}

impl<'s> Choice<'s> {
    /// Returns the names of all variants.
    pub(super) fn names(&self) -> impl Iterator<Item = &'s str> {
        self.units
            .iter()
            .copied()
            .chain(self.variants.iter().map(|(name, _)| *name))
    }

    /// Whether there is a variant with this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.names().any(|n| n == name)
    }

    /// Returns the schema for the content of a variant.
    pub(super) fn content(&self, name: &str) -> Option<Schema<'s>> {
        let (_, json) = self.variants.iter().find(|(n, _)| *n == name)?;
        Some(Schema::new(self.root?, json))
    }
}

/// If the schema describes a variant without content, returns the name of the variant.
fn unit(schema: &Json) -> Option<&str> {
    let layer = schema.as_object()?;
    let name = layer.get("const")?.as_str()?;
    let is_text = layer.get("type").is_none_or(|t| t == "string");
    (is_text && !layer.contains_key("enum") && !refers(layer)).then_some(name)
}

/// Whether a schema includes other schemas.
fn refers(layer: &Map<String, Json>) -> bool {
    layer.contains_key("$ref") || layer.contains_key("allOf")
}

/// If the schema describes a variant with content, returns the name of the variant and the schema of the content.
fn variant(schema: &Json) -> Option<(&str, &Json)> {
    let layer = schema.as_object()?;
    let properties = layer.get("properties")?.as_object()?;
    let required = layer.get("required")?.as_array()?;
    if refers(layer) {
        return None;
    }
    let closed = layer.get("additionalProperties") == Some(&Json::Bool(false));
    let (name, content) = properties.iter().next()?;
    let single = properties.len() == 1 && required.len() == 1 && required[0] == name.as_str();
    (single && closed).then_some((name.as_str(), content))
}

/// Whether a field or variant had this name in an earlier version.
fn has_alias(json: &Json, name: &str) -> bool {
    let aliases = json.get("aliases").and_then(Json::as_array);
    aliases.is_some_and(|aliases| aliases.iter().any(|alias| alias == name))
}

fn dots(count: usize) -> String {
    vec![".."; count].join(", ")
}

/// Returns the name of a type in backticks, after the article "a" or "an".
fn article(name: &str) -> String {
    let vowel = name.starts_with(['A', 'E', 'I', 'O', 'U']);
    format!("{} `{name}`", if vowel { "an" } else { "a" })
}
