//! Reads the steps of a recipe.

use std::sync::Arc;

use op::{Entry, Refusal, Step};
use serde::Deserialize;
use serde_json::Value as Json;

use super::{Draft, Reader, flow};
use crate::recipe::{MAX_STEPS, OnLoss, RecipeStep};
use crate::schema;
use crate::schema_check::{Rename, check_schema, check_step, deserialize_error};
use crate::unknown_operation::suggest_operations;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// If a recipe already has this number of problems, errors about unknown operations have no suggestions, because
/// finding suggestions takes long.
const MAX_SUGGESTIONS: usize = 1000;

impl Reader<'_, '_> {
    pub(super) fn steps(&mut self, items: Vec<Value>) -> Vec<Draft> {
        let mut drafts = Vec::new();
        for mut item in items {
            if self.is_disabled(&mut item) {
                self.disabled(item);
            } else if let Some(kind) = flow::kind(&item) {
                let steps = self.flow(kind, item);
                drafts.extend(steps);
            } else if self.shared.remaining_steps == 0 {
                self.too_many(&item, MAX_STEPS + 1);
                break;
            } else {
                self.shared.remaining_steps -= 1;
                drafts.push(self.step(item));
            }
        }
        drafts
    }

    /// Whether a step has `enabled: false`.
    fn is_disabled(&mut self, item: &mut Value) -> bool {
        if !matches!(item.kind, ValueKind::Struct(_)) {
            return false;
        }
        let Some(enabled) = item.field_mut("enabled") else {
            return false;
        };
        self.fill(enabled) && enabled.kind == ValueKind::Bool(false)
    }

    /// Reads a disabled step, and then discards it together with its errors and warnings. Other parts of the recipe can
    /// still refer to the ids in a disabled step. The parameters that the step uses are not reported as unused.
    fn disabled(&mut self, item: Value) {
        let before = (
            self.diagnostics.len(),
            self.shared.diagnostics.len(),
            self.shared.remaining_steps,
            self.has_too_many_steps,
        );
        if let Some(kind) = flow::kind(&item) {
            self.flow(kind, item);
        } else {
            self.step(item);
        }
        self.diagnostics.truncate(before.0);
        self.shared.diagnostics.truncate(before.1);
        (self.shared.remaining_steps, self.has_too_many_steps) = (before.2, before.3);
    }

    /// Reads a step of the form `Name(..)` or `(id: .., run: Name(..), ..)`.
    fn step(&mut self, mut value: Value) -> Draft {
        let is_envelope = matches!(value.kind, ValueKind::Struct(_) | ValueKind::Unit);
        if !self.fill(&mut value) {
            return self.broken_step(value);
        }
        let before = self.diagnostics.len();
        let mut run = &value;
        if is_envelope {
            let wrong = check_schema(&value, schema::step_envelope());
            self.diagnostics.extend(wrong);
            let Some(inner) = value.field("run") else {
                return self.broken_step(value);
            };
            run = inner;
        }
        let Some((name, span)) = run.name() else {
            // If an error in this step was already reported, the name is possibly missing because of that error. In
            // this case, the missing name is not reported.
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
            let has_help = self.diagnostics.len() < MAX_SUGGESTIONS;
            let help = has_help.then(|| suggest_operations(name, self.shared.schemas.registry));
            let message = format!("unknown operation `{name}`");
            self.error(span, message, help.unwrap_or_default());
            None
        };
        let on = envelope("on").and_then(Value::items).map(|items| {
            let named = |item: &Value| item.as_str().map(|name| (name.to_owned(), item.span));
            items.iter().filter_map(named).collect()
        });
        if let (Some(entry), Some(on)) = (&entry, envelope("on"))
            && !entry.takes_on
        {
            let help = "remove `on`: the operation creates new objects, or its parameters name the objects that it acts on";
            self.error(on.span, format!("{} does not take `on`", entry.name), help);
        }
        // `check_schema` has already reported invalid values, so they are ignored here.
        let refused = envelope("refused").and_then(|reason| Refusal::deserialize(reason).ok());
        let on_loss = envelope("on_loss").and_then(|on_loss| OnLoss::deserialize(on_loss).ok());
        let note = envelope("note").and_then(Value::as_str);
        // The name of the operation can be a part of the label, and the label seeds random choices. An old name is
        // replaced by the current name, so that both names give the same choices.
        let name = entry.as_ref().map_or(name, |entry| entry.name).to_owned();
        Draft::new(RecipeStep {
            step,
            on,
            refused,
            on_loss: on_loss.unwrap_or_else(|| self.on_loss.clone()),
            note: note.map(str::to_owned),
            ..self.bare_step(id, name, run_of(value), span)
        })
    }

    fn operation(&mut self, entry: &Entry, run: &Value) -> Option<Arc<dyn Step>> {
        let schema = self.shared.schemas.of(entry);
        let mut checked = check_step(run, &schema);
        if !checked.wrong.is_empty() || run.has_errors() {
            explain_outer_fields(&mut checked.wrong, run, schema::step_envelope(), "run");
            self.diagnostics.extend(checked.wrong);
            return None;
        }
        let parsed = entry.deserialize(&checked.in_full(run));
        let renames = checked.renames_in_step(run, entry.name);
        self.diagnostics.extend(renames.iter().map(Rename::warning));
        match parsed {
            Ok(step) => Some(step.into()),
            Err(error) => {
                let mut wrong = deserialize_error(run.span, error);
                wrong.message = format!("{}: {}", entry.name, wrong.message);
                self.diagnostics.push(wrong);
                None
            }
        }
    }

    /// Returns a placeholder for a step that could not be read. With the placeholder, the indices of the other steps
    /// stay unchanged, and other parts of the recipe can still refer to the id of this step.
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
            note: None,
            scope: self.scope,
            span,
            value,
            turns: Vec::new(),
            stem: label,
        }
    }

    /// Adds the id of a step. Reports an error if an earlier step has the same id.
    pub(super) fn id(&mut self, id: Option<&Value>) -> Option<String> {
        let (value, text) = id.and_then(|id| Some((id, id.as_str()?)))?;
        if !self.ids.insert(text.to_owned()) {
            let message = format!("two steps have the id \"{text}\"");
            self.diagnostics
                .push(Diagnostic::error(value.span, message));
        }
        Some(text.to_owned())
    }

    /// Reports that the recipe has too many steps. The error is reported only once.
    pub(super) fn too_many(&mut self, step: &Value, n: usize) {
        if !std::mem::replace(&mut self.has_too_many_steps, true) {
            let message =
                format!("the recipe has at least {n} steps, expected at most {MAX_STEPS}");
            let span = step.name().map_or(step.span, |(_, span)| span);
            self.error(span, message, "");
        }
    }
}

/// Improves the help text of errors about unknown parameters. Some fields, such as `on`, belong outside of the
/// parentheses of the operation or expectation. If an unknown parameter has the name of one of these fields, the help
/// text says where to write the field. `inner` is the name of the field that contains the operation or expectation:
/// `run` or `that`.
pub(super) fn explain_outer_fields(
    wrong: &mut [Diagnostic],
    call: &Value,
    envelope: &Json,
    inner: &str,
) {
    let Some((owner, _)) = call.name() else {
        return;
    };
    for diagnostic in wrong {
        let mut fields = call.fields().iter();
        let field = fields.find(|field| diagnostic.span == Some(field.name.span));
        let name = field.map_or("", |field| &*field.name.text);
        if envelope["properties"].get(name).is_some() {
            diagnostic.help = Some(format!("write `({name}: .., {inner}: {owner}(..))`"));
        }
    }
}

/// Returns only the operation of a step, without the other fields of the step, such as `id` and `on`.
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
