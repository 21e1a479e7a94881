//! The panel of an operation: a list of fields, generated from the schema of its parameters. A panel turns its values
//! into the text of a step.

mod kind;
mod parts;

use op::{Entry, Registry};
use recipe::{Diagnostic, VariantDoc};
use ron_tree::{Value, ValueKind, parse};

pub use kind::{FieldKind, FieldValue, Limits};
pub use parts::{Part, Variant};

pub(crate) use kind::number;

/// The panel of an operation.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The name of the operation.
    pub operation: String,
    /// A summary of the operation in one line.
    pub summary: String,
    /// The description of the operation. Each paragraph is one line.
    pub doc: String,
    /// An example step.
    pub example: String,
    /// The fields, in the order of the documentation.
    pub fields: Vec<PanelField>,
    /// The names of the fields that have a value, in the order in which the text of the step sets them.
    order: Vec<String>,
    schema: serde_json::Value,
}

/// A field of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelField {
    /// The name of the parameter.
    pub name: String,
    /// The description of the parameter.
    pub doc: String,
    /// The kind of the parameter's values, which determines the widget of the field.
    pub kind: FieldKind,
    /// The type of the parameter in words, as in the reference of operations.
    pub type_name: String,
    /// The variants of the parameter's type, if this type is an enumeration. The variants are suggested while the user
    /// enters a value.
    pub variants: Vec<VariantDoc>,
    /// The default value as RON. `None` if the parameter is required.
    pub default: Option<String>,
    /// The value that the step gives to the parameter, as RON. `None` if the step does not set the parameter.
    pub value: Option<String>,
    /// If the value is `arg("name")`, the name in the quotes. It refers to a parameter of the recipe.
    pub argument: Option<String>,
}

impl PanelField {
    /// Whether the parameter is required but has no value.
    pub fn is_missing(&self) -> bool {
        self.default.is_none() && self.value.is_none()
    }

    /// Returns the value that the step sets or, if the step does not set the parameter, the default value.
    pub fn current(&self) -> Option<&str> {
        self.value.as_deref().or(self.default.as_deref())
    }

    /// Returns the current value as the widget shows it. Returns `None` if there is no value, or if the widget cannot
    /// show the value. For example, it cannot show `arg(..)`.
    pub fn typed(&self) -> Option<FieldValue> {
        FieldValue::read(&self.kind, self.current()?)
    }
}

impl Panel {
    /// Creates the panel of an operation. No field of the new panel has a value.
    pub fn new(entry: &Entry) -> Self {
        let schema = entry.schema();
        Self {
            operation: entry.name.to_owned(),
            summary: entry.summary.to_owned(),
            doc: unwrapped(schema["description"].as_str().unwrap_or_default()),
            example: entry.example.to_owned(),
            fields: panel_fields(&schema, &schema, 0),
            order: Vec::new(),
            schema,
        }
    }

    /// Creates the panel of a step `Name(..)` with the values of the step. The spans of `run` are ranges of `text`.
    /// Returns `None` if the registry does not have the operation.
    pub fn of_step(registry: &Registry, run: &Value, text: &str) -> Option<Self> {
        let entry = registry.get(run.name()?.0)?;
        let mut panel = Self::new(entry);
        for field in run.fields() {
            let name = panel.current_name(&field.name.text);
            panel.set(&name, Some(field.value.span.of(text)));
        }
        Some(panel)
    }

    /// Returns the field with this name.
    pub fn field(&self, name: &str) -> Option<&PanelField> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// Sets the value of a parameter, which is given as RON. If `value` is `None`, the value is removed. If the
    /// operation has no parameter of this name, nothing happens.
    pub fn set(&mut self, name: &str, value: Option<&str>) {
        let Some(field) = self.fields.iter_mut().find(|field| field.name == name) else {
            return;
        };
        field.value = value.map(str::to_owned);
        field.argument = value.and_then(argument);
        match value {
            None => self.order.retain(|known| known != name),
            Some(_) if self.order.iter().any(|known| known == name) => {}
            Some(_) => self.order.push(name.to_owned()),
        }
    }

    /// Returns the text of the step, in the form `Name(parameter: value, ..)`.
    pub fn step_text(&self) -> String {
        let value = |name: &String| Some(format!("{name}: {}", self.field(name)?.value.as_ref()?));
        let fields: Vec<String> = self.order.iter().filter_map(value).collect();
        format!("{}({})", self.operation, fields.join(", "))
    }

    /// Returns the problems of the panel: missing values, values of the wrong type, and values that are out of range.
    /// Each problem has the name of the field that it is about. For a problem of the whole step, the name is empty. A
    /// value of the form `arg(..)` is not checked.
    pub fn problems(&self) -> Vec<(String, Diagnostic)> {
        let text = self.step_text();
        let parsed = parse(&text);
        let ValueKind::Call(call) = &parsed.value.kind else {
            return Vec::new();
        };
        let found = if parsed.diagnostics.is_empty() {
            recipe::schema_check::check_schema(&call.body, &self.schema)
        } else {
            parsed.diagnostics.clone()
        };
        let fields = call.body.fields();
        let place = |diagnostic: &Diagnostic| {
            let span = diagnostic.span?;
            fields
                .iter()
                .find(|field| field.name.span.to(field.value.span).contains(span))
        };
        let problem = |diagnostic: Diagnostic| {
            let field = place(&diagnostic);
            if field.is_some_and(|field| argument(field.value.span.of(&text)).is_some()) {
                return None;
            }
            Some((
                field.map_or_else(String::new, |field| field.name.text.to_string()),
                diagnostic,
            ))
        };
        found.into_iter().filter_map(problem).collect()
    }

    /// Returns the current name of a parameter. `name` can be an earlier name of the parameter, which older recipes
    /// use.
    fn current_name(&self, name: &str) -> String {
        if self.field(name).is_some() {
            return name.to_owned();
        }
        let has_alias = |field: &&PanelField| {
            let aliases = self.schema["properties"][&field.name]["aliases"].as_array();
            aliases.is_some_and(|aliases| aliases.iter().any(|alias| alias == name))
        };
        self.fields
            .iter()
            .find(has_alias)
            .map_or(name, |field| &field.name)
            .to_owned()
    }
}

/// Joins the lines of each paragraph into one line. Each item of a list and each row of a table remains a separate
/// line.
fn unwrapped(doc: &str) -> String {
    let mut text = String::with_capacity(doc.len());
    for line in doc.lines() {
        let starts_anew = line.is_empty() || line.starts_with(['-', '|']);
        if !text.is_empty() {
            let continues = !starts_anew && !text.ends_with('\n');
            text.push(if continues { ' ' } else { '\n' });
        }
        text += line.trim_start();
    }
    text
}

/// Returns the fields of a struct. References in the schema of the struct are looked up in the schema `root`.
fn panel_fields(
    json: &serde_json::Value,
    root: &serde_json::Value,
    depth: usize,
) -> Vec<PanelField> {
    let field = |field: recipe::FieldDoc| PanelField {
        kind: FieldKind::at_depth(&json["properties"][&field.name], root, depth),
        name: field.name,
        doc: field.doc,
        type_name: field.kind,
        variants: field.variants,
        default: field.default,
        value: None,
        argument: None,
    };
    let docs = recipe::fields_in(root, json);
    docs.into_iter().map(field).collect()
}

/// If a value is `arg("name")`, returns the name.
fn argument(text: &str) -> Option<String> {
    if !text.trim_start().starts_with("arg") {
        return None;
    }
    let parsed = parse(text);
    match &parsed.value.kind {
        ValueKind::Call(call) if &*call.name.text == "arg" => {
            Some(call.body.single()?.as_str()?.to_owned())
        }
        _ => None,
    }
}
