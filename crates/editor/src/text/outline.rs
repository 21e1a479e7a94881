//! The outline of a recipe's text: where its steps, parameters and expectations are.

use ron_tree::{Diagnostic, Span, Value, ValueKind, parse};

/// The outline of a recipe's text. If the text has errors, the outline has only the parts that could be read.
#[derive(Clone, Debug)]
pub struct Outline {
    /// The steps of the list `steps`, in the order of the text.
    pub steps: Vec<StepText>,
    /// The parameters, in the order of the text.
    pub parameters: Vec<ParameterText>,
    /// The spans of the items of `expect`.
    pub expectations: Vec<Span>,
    /// The syntax errors.
    pub diagnostics: Vec<Diagnostic>,
    root: Value,
}

/// A step in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepText {
    /// The span of the whole step.
    pub span: Span,
    /// The span of the operation `Name(..)`.
    pub run: Span,
    /// The name of the operation. Empty if it could not be read.
    pub name: String,
    /// The id, if the step has one.
    pub id: Option<String>,
    /// The note, if the step has one.
    pub note: Option<String>,
    /// Whether the step runs: false if it has `enabled: false`.
    pub enabled: bool,
    /// The names in the field `on`, if the step has this field.
    pub on: Option<Vec<String>>,
    /// The steps inside `Repeat` and `If`.
    pub inner: Vec<StepText>,
}

/// A parameter of the recipe in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterText {
    /// The name.
    pub name: String,
    /// The declaration. `None` if the declaration could not be read.
    pub param: Option<recipe::Param>,
    /// The span of the default value, if the parameter has one in the text.
    pub default: Option<Span>,
    /// The span of the declaration.
    pub span: Span,
}

impl Outline {
    /// Reads the outline of a text.
    pub fn of(text: &str) -> Self {
        let parsed = parse(text);
        let root = parsed.value;
        let items = |field: &str| root.field(field).and_then(Value::items).unwrap_or_default();
        let parameters = match root.field("params").map(|params| &params.kind) {
            Some(ValueKind::Map(entries)) => entries
                .iter()
                .filter_map(|(key, value)| parameter(text, key, value))
                .collect(),
            _ => Vec::new(),
        };
        Self {
            steps: items("steps").iter().map(step).collect(),
            parameters,
            expectations: items("expect").iter().map(|item| item.span).collect(),
            diagnostics: parsed.diagnostics,
            root,
        }
    }

    /// Returns the syntax tree of the text.
    pub fn root(&self) -> &Value {
        &self.root
    }

    /// Returns the syntax tree of the operation `Name(..)` of a step.
    pub fn run_of(&self, step: usize) -> Option<&Value> {
        let written = self.written(step)?;
        Some(run_of(written))
    }

    /// Returns the syntax tree of a step, including the fields around the operation of the step.
    pub(super) fn written(&self, step: usize) -> Option<&Value> {
        self.root.field("steps")?.items()?.get(step)
    }

    /// Returns the index of the step that contains an offset or, if no step contains the offset, of the last step
    /// before the offset.
    pub fn step_at(&self, offset: usize) -> Option<usize> {
        self.steps
            .iter()
            .rposition(|step| step.span.start <= offset)
    }
}

fn run_of(written: &Value) -> &Value {
    let is_envelope = matches!(written.kind, ValueKind::Struct(_));
    written
        .field("run")
        .filter(|_| is_envelope)
        .unwrap_or(written)
}

fn step(written: &Value) -> StepText {
    let is_envelope = matches!(written.kind, ValueKind::Struct(_));
    let envelope = |field: &str| written.field(field).filter(|_| is_envelope);
    let text = |field: &str| envelope(field).and_then(Value::as_str).map(str::to_owned);
    let run = run_of(written);
    let name = run
        .name()
        .map_or_else(String::new, |(name, _)| name.to_owned());
    let inner = match name.as_str() {
        "Repeat" | "If" => ["steps", "otherwise"]
            .iter()
            .filter_map(|field| run.field(field)?.items())
            .flatten()
            .map(step)
            .collect(),
        _ => Vec::new(),
    };
    let on = envelope("on").and_then(Value::items);
    StepText {
        span: written.span,
        run: run.span,
        name,
        id: text("id"),
        note: text("note"),
        enabled: envelope("enabled").is_none_or(|is| is.kind != ValueKind::Bool(false)),
        on: on.map(|on| {
            on.iter()
                .filter_map(|name| name.as_str().map(str::to_owned))
                .collect()
        }),
        inner,
    }
}

fn parameter(text: &str, key: &Value, value: &Value) -> Option<ParameterText> {
    Some(ParameterText {
        name: key.as_str()?.to_owned(),
        param: ron_tree::from_str(value.span.of(text)).ok(),
        default: value.field("default").map(|default| default.span),
        span: value.span,
    })
}
