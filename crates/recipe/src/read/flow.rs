//! Steps that contain steps:
//!
//! ```text
//! Call(recipe: "clean.ron", with: {"distance": 1e-6})    runs the steps of another recipe
//! Repeat(times: 3, steps: [..])                          runs the steps 3 times
//! If(param: "smooth", steps: [..], otherwise: [..])      runs `steps` if the parameter is true, else `otherwise`
//! If(param: "mode", is: Fast, steps: [..])               runs the steps if the parameter equals `is`
//! ```
//!
//! When a recipe is read, a step that contains steps is replaced by the steps inside it. A called recipe works on the
//! current scene, reads files from its own folder, and can use only its own parameters and ids. The expectations of a
//! called recipe are checked after the steps of the called recipe.

use std::path::Path;

use store::Store;

use super::{Draft, Reader, canonical, take_items};
use crate::params::{Param, Rebase};
use crate::recipe::{Kind, MAX_STEPS, Origin, Scope};
use crate::schema;
use crate::schema_check::{check_schema, check_step, did_you_mean};
use crate::source::Source;
use ron_tree::{Span, Value, ValueKind};

/// The maximum depth to which calls can be nested.
const MAX_CALLS: usize = 32;

/// Each call counts as this number of steps, in addition to the steps of the called recipe. Because calls count as
/// steps, the maximum number of steps also limits the time for reading called recipes.
const STEPS_PER_CALL: usize = 20;

/// Returns the kind of a step that contains other steps, or `None` for any other step.
pub(super) fn kind(written: &Value) -> Option<Kind> {
    let is_envelope = matches!(written.kind, ValueKind::Struct(_));
    let run = if is_envelope {
        written.field("run")?
    } else {
        written
    };
    let name = run.name()?.0;
    Kind::ALL.into_iter().find(|kind| kind.name() == name)
}

impl Reader<'_, '_> {
    /// Replaces a step that contains other steps by the steps inside it.
    pub(super) fn flow(&mut self, kind: Kind, mut value: Value) -> Vec<Draft> {
        let is_envelope = matches!(value.kind, ValueKind::Struct(_));
        // The inner steps are taken out of `value`, because they are read later like all steps. At that time, the
        // parameters in the inner steps are substituted.
        let bodies = ["steps", "otherwise"].map(|field| {
            let run = if is_envelope {
                value.field_mut("run")
            } else {
                Some(&mut value)
            };
            take_items(run.and_then(|run| run.field_mut(field)))
        });
        if !self.fill(&mut value) {
            return vec![self.broken_step(value)];
        }
        let before = self.diagnostics.len();
        let run = if is_envelope {
            let wrong = check_schema(&value, schema::step_envelope());
            self.diagnostics.extend(wrong);
            for field in ["on", "refused", "on_loss"] {
                if let Some(found) = value.field(field) {
                    let message = format!("{} does not take `{field}`", kind.name());
                    let help = format!("set `{field}` on the inner steps");
                    self.error(found.span, message, help);
                }
            }
            value.field("run").unwrap_or(&value)
        } else {
            &value
        };
        let wrong = check_step(run, &schema::flow(kind)).wrong;
        self.diagnostics.extend(wrong);
        let is_whole = self.diagnostics.len() == before && !run.has_errors();
        let id = self.id(value.field("id").filter(|_| is_envelope));
        let mut drafts = match kind {
            Kind::Call if is_whole => self.call(run, id.as_deref()),
            Kind::Call => Vec::new(),
            Kind::Repeat => {
                let [body, _] = bodies;
                self.repeat(run, body)
            }
            Kind::If => self.choice(run, bodies, is_whole),
        };
        if let (Some(id), Some(last)) = (id, drafts.last_mut()) {
            last.ends.push(id);
        }
        drafts
    }

    fn repeat(&mut self, run: &Value, body: Vec<Value>) -> Vec<Draft> {
        let body = self.steps(body);
        let times = match run.field("times").map(|times| &times.kind) {
            Some(ValueKind::Number(number)) => number.to_int().unwrap_or(1),
            _ => 1,
        };
        let times = u32::try_from(times).unwrap_or(0);
        let more = body.len().saturating_mul(times.saturating_sub(1) as usize);
        let Some(remaining) = self.shared.remaining_steps.checked_sub(more) else {
            let n = (MAX_STEPS - self.shared.remaining_steps).saturating_add(more);
            self.too_many(run, n);
            return body;
        };
        self.shared.remaining_steps = remaining;
        if body.is_empty() {
            return body;
        }
        let turn = |turn| {
            body.iter().map(move |draft| Draft {
                step: draft.step.clone().in_turn(turn),
                ..draft.clone()
            })
        };
        (1..=times).flat_map(turn).collect()
    }

    fn choice(&mut self, run: &Value, bodies: [Vec<Value>; 2], is_whole: bool) -> Vec<Draft> {
        let [then, otherwise] = bodies;
        // Both branches are read, so that errors are also found in the branch that is not taken.
        let known = self.ids.len();
        let then = self.steps(then);
        // Only one branch is taken, so steps in the two branches can have the same id.
        let ids = self.ids.split_off(known);
        let otherwise = self.steps(otherwise);
        self.ids.extend(ids);
        match is_whole.then(|| self.condition(run)).flatten() {
            Some(false) => otherwise,
            _ => then,
        }
    }

    /// Whether the parameter of an `If` has the requested value. Returns `None` if an error prevents the comparison.
    fn condition(&mut self, run: &Value) -> Option<bool> {
        let param = run.field("param")?;
        let name = param.as_str()?;
        self.used.insert(name.to_owned());
        if self.broken.contains(name) {
            return None;
        }
        let Some(parameter) = self.parameters.get(name) else {
            let unknown = self.unknown(name, param.span);
            self.diagnostics.push(unknown);
            return None;
        };
        let Some(is) = run.field("is") else {
            if let Param::Bool { .. } = parameter.param {
                return Some(parameter.value.kind == ValueKind::Bool(true));
            }
            let kind = parameter.param.type_name();
            let message = format!("`{name}` has the type {kind}, expected Bool");
            let help = "add `is: value` to compare the parameter with a value";
            self.error(param.span, message, help);
            return None;
        };
        match parameter.param.value_from(is, None) {
            Ok(value) => Some(parameter.value == value),
            Err(problem) => {
                let message = format!("`{name}` cannot have this value: {problem}");
                self.error(is.span, message, "");
                None
            }
        }
    }

    fn call(&mut self, run: &Value, id: Option<&str>) -> Vec<Draft> {
        let Some((span, text)) = run
            .field("recipe")
            .and_then(|r| Some((r.span, r.as_str()?)))
        else {
            return Vec::new();
        };
        let path = self.source.folder().join(text);
        let Some(source) = self.open_called(&path, span) else {
            return Vec::new();
        };
        if self.shared.remaining_steps < STEPS_PER_CALL {
            self.too_many(run, MAX_STEPS + 1);
            return Vec::new();
        }
        self.shared.remaining_steps -= STEPS_PER_CALL;
        let scope = self.shared.scopes.len();
        self.shared.scopes.push(Scope {
            source,
            parameters: Vec::new(),
            called: Some((self.scope, span)),
        });
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let prefix = format!("{}{}/", self.prefix, id.unwrap_or(&stem));
        let (from, on_loss) = (self.source.clone(), self.on_loss.clone());
        let mut wrong = Vec::new();
        let mut called = Reader::new(self.shared, scope, prefix);
        called.on_loss = on_loss;
        let (mut drafts, last) = called.text(|called| {
            let Some(with) = run.field("with") else {
                return;
            };
            let to = called.source.clone();
            let folders = Rebase {
                from: from.folder(),
                to: to.folder(),
                store: called.shared.store,
            };
            let (values, problems) = called.values_of(with, Some(folders));
            called.assign(&values, &Origin::Call);
            wrong = problems;
        });
        called.close();
        self.diagnostics.extend(wrong);
        for draft in &mut drafts {
            draft.ends.clear();
        }
        match drafts.last_mut() {
            Some(draft) => draft.then.extend(last),
            None if !last.is_empty() => {
                let message = "the called recipe has expectations, but none of its steps runs";
                self.error(span, message, "");
            }
            None => {}
        }
        drafts
    }

    /// Returns the index of the source text of a called recipe in the list of source texts. Reports an error and
    /// returns `None` in three cases: the text cannot be read, the recipe calls itself, or calls are nested too deeply.
    fn open_called(&mut self, path: &Path, span: Span) -> Option<usize> {
        let mut chain = vec![self.scope];
        while let Some((caller, _)) = self.shared.scopes[*chain.last()?].called {
            chain.push(caller);
        }
        let sources = (chain.iter().rev()).map(|&scope| self.shared.scopes[scope].source);
        let chain: Vec<usize> = sources.collect();
        let canonical = canonical(self.shared.store, path);
        let is_called = |&source: &usize| self.shared.canonical_paths[source] == canonical;
        if let Some(first) = chain.iter().position(is_called) {
            let names = chain[first..].iter();
            let names = names.map(|&source| self.shared.sources[source].path.as_path());
            let names: Vec<String> = (names.chain([path]))
                .map(|p| p.display().to_string())
                .collect();
            let message = format!("the recipe calls itself: {}", names.join(" -> "));
            self.error(span, message, "");
            return None;
        }
        if chain.len() > MAX_CALLS {
            let message = format!("calls are nested more than {MAX_CALLS} levels deep");
            self.error(span, message, "");
            return None;
        }
        if let Some(known) = self.shared.sources.iter().position(|s| s.path == path) {
            return Some(known);
        }
        match Source::open_in(self.shared.store, path) {
            Ok(source) => {
                self.shared.sources.push(source);
                self.shared.canonical_paths.push(canonical);
                Some(self.shared.sources.len() - 1)
            }
            Err(error) => {
                self.error(
                    span,
                    error.to_string(),
                    similar_files(self.shared.store, path),
                );
                None
            }
        }
    }
}

/// If a called recipe does not exist, returns a text that suggests other recipes in the same folder. The text names the
/// recipes with similar file names or, if no name is similar, all recipes in the folder. The text is empty if the
/// folder contains no recipes, or if the recipe exists but cannot be read.
fn similar_files(store: &dyn Store, path: &Path) -> String {
    let folder = path.parent().filter(|_| !store.exists(path));
    let siblings = folder.and_then(|folder| store.list(folder).ok());
    let names: Vec<String> = (siblings.into_iter().flatten())
        .filter(|path| path.extension().is_some_and(|e| e == "ron"))
        .filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()))
        .collect();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if names.is_empty() {
        return String::new();
    }
    did_you_mean(&name, names.iter().map(String::as_str))
}
