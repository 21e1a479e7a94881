//! The steps of a text.

use std::sync::Arc;

use op::{Entry, Refusal, Step};
use serde::Deserialize;

use super::{Draft, Reader, flow};
use crate::recipe::{Kind, MAX_STEPS, OnLoss, RecipeStep};
use crate::schema;
use crate::shape::{Rename, check_shape, check_step, did_you_mean, unread};
use ron_tree::{Diagnostic, Span, Value, ValueKind};

impl Reader<'_, '_> {
    /// Reads a list of steps.
    pub(super) fn steps(&mut self, items: Vec<Value>) -> Vec<Draft> {
        let mut drafts = Vec::new();
        for item in items {
            if let Some(kind) = flow::kind(&item) {
                let steps = self.flow(kind, item);
                drafts.extend(steps);
            } else if self.shared.left == 0 {
                // Nothing more is said of the others.
                self.too_many(&item, MAX_STEPS + 1);
                break;
            } else {
                self.shared.left -= 1;
                drafts.push(self.step(item));
            }
        }
        drafts
    }

    /// `Name(..)`, or `(id: .., run: Name(..), ..)`.
    fn step(&mut self, mut value: Value) -> Draft {
        let is_envelope = matches!(value.kind, ValueKind::Struct(_) | ValueKind::Unit);
        if !self.fill(&mut value) {
            return self.broken_step(value);
        }
        let before = self.diagnostics.len();
        let mut run = &value;
        if is_envelope {
            let wrong = check_shape(&value, schema::step_envelope());
            self.diagnostics.extend(wrong);
            let Some(inner) = value.field("run") else {
                return self.broken_step(value);
            };
            run = inner;
        }
        let Some((name, span)) = run.name() else {
            // A slip that was reported already leaves no name.
            if !run.has_errors() && self.diagnostics.len() == before {
                let message = format!("expected an operation, found {}", run.describe());
                self.error(run.span, message, "");
            }
            return self.broken_step(value);
        };
        let envelope = |field: &str| value.field(field).filter(|_| is_envelope);
        let id = self.id(envelope("id"));
        let entry = self.shared.schemas.registry.get(name).cloned();
        let step = if let Some(entry) = &entry {
            self.operation(entry, run)
        } else {
            let registry = self.shared.schemas.registry;
            let known = registry.entries().iter().map(|e| e.name);
            let help = did_you_mean(name, known.chain(Kind::ALL.map(Kind::name)));
            self.error(span, format!("unknown operation `{name}`"), help);
            None
        };
        let on = envelope("on").and_then(Value::items).map(|items| {
            let named = |item: &Value| item.as_str().map(|name| (name.to_owned(), item.span));
            items.iter().filter_map(named).collect()
        });
        if let (Some(entry), Some(on)) = (&entry, envelope("on"))
            && !entry.takes_on
        {
            let help = "it names its objects in parameters of its own, or makes new ones";
            self.error(on.span, format!("{} does not take `on`", entry.name), help);
        }
        // A wrong reason or a wrong name was reported with the envelope.
        let refused = envelope("refused").and_then(|reason| Refusal::deserialize(reason).ok());
        let on_loss = envelope("on_loss").and_then(|on_loss| OnLoss::deserialize(on_loss).ok());
        // The name keys random choices: an older one must not make others.
        let name = entry.as_ref().map_or(name, |entry| entry.name).to_owned();
        Draft::new(RecipeStep {
            step,
            on,
            refused,
            on_loss: on_loss.unwrap_or_else(|| self.on_loss.clone()),
            ..self.bare_step(id, name, run_of(value), span)
        })
    }

    fn operation(&mut self, entry: &Entry, run: &Value) -> Option<Arc<dyn Step>> {
        let schema = self.shared.schemas.of(entry);
        let checked = check_step(run, &schema);
        if !checked.wrong.is_empty() || run.has_errors() {
            self.diagnostics.extend(checked.wrong);
            return None;
        }
        let parsed = entry.parse(&checked.in_full(run));
        let renames = checked.renames_in_step(run, entry.name);
        self.diagnostics.extend(renames.iter().map(Rename::warning));
        match parsed {
            Ok(step) => Some(step.into()),
            Err(error) => {
                let mut wrong = unread(run.span, error);
                wrong.message = format!("{}: {}", entry.name, wrong.message);
                self.diagnostics.push(wrong);
                None
            }
        }
    }

    /// A step that could not be read keeps its place in the list, and its id.
    pub(super) fn broken_step(&mut self, written: Value) -> Draft {
        let run = written.field("run").unwrap_or(&written);
        let (name, span) = run.name().unwrap_or(("?", written.span));
        let name = name.to_owned();
        let id = written.field("id").and_then(Value::as_str);
        let id = id.map(str::to_owned);
        self.ids.extend(id.clone());
        Draft::new(self.bare_step(id, name, run_of(written), span))
    }

    fn bare_step(&self, id: Option<String>, name: String, value: Value, span: Span) -> RecipeStep {
        let label = format!("{}{}", self.prefix, id.as_ref().unwrap_or(&name));
        RecipeStep {
            id,
            name,
            label: label.clone(),
            step: None,
            on: None,
            refused: None,
            on_loss: self.on_loss.clone(),
            scope: self.scope,
            span,
            value,
            turns: Vec::new(),
            stem: label,
        }
    }

    /// Takes the id of a step, which no step before it may have.
    pub(super) fn id(&mut self, id: Option<&Value>) -> Option<String> {
        let (value, text) = id.and_then(|id| Some((id, id.as_str()?)))?;
        if !self.ids.insert(text.to_owned()) {
            let message = format!("two steps have the id \"{text}\"");
            self.diagnostics
                .push(Diagnostic::error(value.span, message));
        }
        Some(text.to_owned())
    }

    /// Refuses a recipe of too many steps, once.
    pub(super) fn too_many(&mut self, at: &Value, n: usize) {
        if !std::mem::replace(&mut self.is_over, true) {
            let message = format!("the recipe has {n} steps or more, expected at most {MAX_STEPS}");
            let span = at.name().map_or(at.span, |(_, span)| span);
            self.error(span, message, "");
        }
    }
}

/// The operation of a step, without what stands around it.
fn run_of(mut written: Value) -> Value {
    let is_envelope = matches!(written.kind, ValueKind::Struct(_));
    match written.field_mut("run").filter(|_| is_envelope) {
        Some(run) => std::mem::replace(run, Value::new(run.span, ValueKind::Unit)),
        None => written,
    }
}

impl Draft {
    fn new(step: RecipeStep) -> Self {
        Self {
            ends: step.id.iter().cloned().collect(),
            step,
            then: Vec::new(),
        }
    }
}
