//! Reading a recipe: text to operations with their parameters, and every error on the way.
//!
//! Three stages: the text becomes a tree that survives slips; each step is held against the schema of
//! its operation; what passes is read into the operation's struct. One broken step hides no other.

use std::path::{Path, PathBuf};

use op::{Entry, Refusal, Registry, Step};
use serde::de::DeserializeOwned;

use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::expect::Expectation;
use crate::params::Param;
use crate::schema;
use crate::shape::{check_shape, check_step, did_you_mean};
use crate::syntax::{self, Value, ValueKind};

/// The version of recipes that this program reads.
pub const VERSION: i128 = 1;

/// A recipe that was read, as far as it could be.
#[derive(Debug)]
pub struct Recipe {
    /// What the recipe says of itself.
    pub about: Option<String>,
    /// Its parameters with their values.
    pub parameters: Vec<Parameter>,
    /// Its steps.
    pub steps: Vec<RecipeStep>,
    /// What must hold.
    pub expectations: Vec<Placed>,
}

/// A parameter with its value.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its declaration.
    pub param: Param,
    /// Its value as RON.
    pub literal: String,
    /// Whether the value was set from outside, and is not the default.
    pub is_set: bool,
}

/// A step.
#[derive(Debug)]
pub struct RecipeStep {
    /// The name that later parts of the recipe know it by.
    pub id: Option<String>,
    /// The name of its operation, as written.
    pub name: String,
    /// The operation; `None` if the step could not be read.
    pub step: Option<Box<dyn Step>>,
    /// The objects it was told to act on, with their places in the text.
    pub on: Option<Vec<(String, Span)>>,
    /// The reason for which it must be refused.
    pub refused: Option<Refusal>,
    /// The place of the name of the operation.
    pub span: Span,
    /// The operation as written, parameters filled in.
    pub value: Value,
}

impl RecipeStep {
    /// The name to show: the id, or else the operation.
    pub fn label(&self) -> &str {
        self.id.as_deref().unwrap_or(&self.name)
    }

    /// The objects it was told to act on.
    pub fn on_names(&self) -> Option<Vec<String>> {
        self.on
            .as_ref()
            .map(|on| on.iter().map(|(name, _)| name.clone()).collect())
    }
}

/// An expectation and where it belongs.
#[derive(Debug)]
pub struct Placed {
    /// The step after which it must hold, by its place in the list; at the end if `None`.
    pub after: Option<usize>,
    /// The objects that are meant; all if `None`.
    pub on: Option<Vec<String>>,
    /// What must hold.
    pub that: Expectation,
    /// Its place in the text.
    pub span: Span,
}

/// A recipe and what is wrong with it.
#[derive(Debug)]
pub struct Reading {
    /// The recipe, as far as it could be read.
    pub recipe: Recipe,
    /// What is wrong.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a recipe. `set` are names of parameters and their values as text; relative paths among them
/// are seen from `folder`, the working directory.
pub fn read(source: &str, registry: &Registry, set: &[(String, String)], folder: &Path) -> Reading {
    let parsed = syntax::parse(source);
    let mut reader = Reader {
        source,
        registry,
        diagnostics: parsed.diagnostics,
        recipe: Recipe {
            about: None,
            parameters: Vec::new(),
            steps: Vec::new(),
            expectations: Vec::new(),
        },
        broken: Vec::new(),
        used: Vec::new(),
    };
    reader.recipe(&parsed.value, set, folder);
    reader.diagnostics.sort_by_key(|d| d.span);
    Reading {
        recipe: reader.recipe,
        diagnostics: reader.diagnostics,
    }
}

struct Reader<'a> {
    source: &'a str,
    registry: &'a Registry,
    diagnostics: Vec<Diagnostic>,
    recipe: Recipe,
    /// Parameters that are declared, but wrongly.
    broken: Vec<String>,
    /// Parameters that some `arg(..)` names.
    used: Vec<String>,
}

impl Reader<'_> {
    fn recipe(&mut self, root: &Value, set: &[(String, String)], folder: &Path) {
        // The version is read before anything else is interpreted.
        if let Some(version) = root.field("recipe")
            && let ValueKind::Number(number) = &version.kind
            && let Some(found) = number.to_int()
            && found != VERSION
        {
            let message = format!("this recipe is of version {found}, expected {VERSION}");
            let help = if found > VERSION {
                "a newer meshwright can read it"
            } else {
                "write 1"
            };
            self.diagnostics
                .push(Diagnostic::error(version.span, message).with_help(help));
            return;
        }
        if matches!(root.kind, ValueKind::Error) && !self.diagnostics.is_empty() {
            return;
        }
        let wrong = check_shape(root, &schema::envelope());
        self.diagnostics.extend(wrong);
        self.recipe.about = root
            .field("about")
            .and_then(Value::as_str)
            .map(str::to_owned);
        if let Some(needs) = root.field("needs") {
            self.needs(needs);
        }
        self.parameters(root.field("params"), set, folder);
        for step in root
            .field("steps")
            .and_then(Value::items)
            .unwrap_or_default()
        {
            self.step(step);
        }
        for expectation in root
            .field("expect")
            .and_then(Value::items)
            .unwrap_or_default()
        {
            self.expectation(expectation);
        }
        self.unused(root.field("params"));
    }

    fn needs(&mut self, needs: &Value) {
        let numbers = |text: &str| -> Option<Vec<u64>> {
            text.split('.').map(|part| part.parse().ok()).collect()
        };
        let here = env!("CARGO_PKG_VERSION");
        let Some(text) = needs.as_str() else { return };
        let problem = match numbers(text) {
            None => format!("expected a version such as \"{here}\", found \"{text}\""),
            Some(wanted) if Some(&wanted) > numbers(here).as_ref() => {
                format!("this recipe needs meshwright {text}, and this is {here}")
            }
            Some(_) => return,
        };
        self.diagnostics
            .push(Diagnostic::error(needs.span, problem));
    }

    fn parameters(&mut self, params: Option<&Value>, set: &[(String, String)], folder: &Path) {
        if let Some(ValueKind::Map(entries)) = params.map(|p| &p.kind) {
            for (key, value) in entries {
                let Some(name) = key.as_str() else { continue };
                let Some(param): Option<Param> = self.typed(value, &schema::of::<Param>()) else {
                    self.broken.push(name.to_owned());
                    continue;
                };
                let literal = match param.default_literal() {
                    Ok(literal) => literal,
                    Err(problem) => {
                        let message = format!("the default of `{name}` is not allowed: {problem}");
                        self.diagnostics
                            .push(Diagnostic::error(value.span, message));
                        self.broken.push(name.to_owned());
                        continue;
                    }
                };
                let name = name.to_owned();
                self.recipe.parameters.push(Parameter {
                    name,
                    param,
                    literal,
                    is_set: false,
                });
            }
        }
        for (name, text) in set {
            if self.broken.contains(name) {
                continue;
            }
            let Some(parameter) = self.recipe.parameters.iter_mut().find(|p| p.name == *name)
            else {
                let known = self.recipe.parameters.iter().map(|p| p.name.as_str());
                let message = format!("the recipe has no parameter `{name}`");
                self.diagnostics
                    .push(Diagnostic::without_place(message).with_help(did_you_mean(name, known)));
                continue;
            };
            match parameter.param.literal(text, Some(folder)) {
                Ok(literal) => (parameter.literal, parameter.is_set) = (literal, true),
                Err(problem) => {
                    let message = format!("the value set for `{name}` is not allowed: {problem}");
                    self.diagnostics.push(Diagnostic::without_place(message));
                }
            }
        }
    }

    /// Fills parameters in.
    fn filled(&mut self, value: &Value) -> Option<Value> {
        let parameters = &self.recipe.parameters;
        let (broken, used) = (&self.broken, &mut self.used);
        // The declarations of these were reported already.
        let mut reported = Vec::new();
        let resolve = |name: &str, span: Span| {
            used.push(name.to_owned());
            if broken.iter().any(|b| b == name) {
                reported.push(span);
            }
            let found = parameters.iter().find(|p| p.name == name);
            found.map(|p| p.literal.clone()).ok_or_else(|| {
                let known = parameters.iter().map(|p| p.name.as_str());
                Diagnostic::error(span, format!("the recipe has no parameter `{name}`"))
                    .with_help(did_you_mean(name, known))
            })
        };
        match syntax::substitute(self.source, value, resolve) {
            Ok(substituted) => Some(substituted.value),
            Err(mut diagnostics) => {
                diagnostics.retain(|d| d.span.is_none_or(|span| !reported.contains(&span)));
                self.diagnostics.extend(diagnostics);
                None
            }
        }
    }

    /// Warns of parameters that neither an `arg(..)` nor a placeholder in a path names. Says nothing
    /// beside errors: one of them may be the use.
    fn unused(&mut self, params: Option<&Value>) {
        let Some(ValueKind::Map(entries)) = params.map(|p| &p.kind) else {
            return;
        };
        if self
            .diagnostics
            .iter()
            .any(|d| d.severity == Severity::Error)
        {
            return;
        }
        for (key, _) in entries {
            if let Some(name) = key.as_str()
                && !self.used.iter().any(|used| used == name)
                && !self.source.contains(&format!("{{{name}."))
            {
                let message = format!("the parameter `{name}` is never used");
                let help = format!("a step takes its value with arg(\"{name}\")");
                self.diagnostics
                    .push(Diagnostic::warning(key.span, message).with_help(help));
            }
        }
    }

    /// Holds a value against a schema and reads it into its type.
    fn typed<T: DeserializeOwned>(
        &mut self,
        value: &Value,
        schema: &serde_json::Value,
    ) -> Option<T> {
        let wrong = check_shape(value, schema);
        if !wrong.is_empty() || value.has_errors() {
            self.diagnostics.extend(wrong);
            return None;
        }
        match syntax::ron_options().from_str(&value.to_string()) {
            Ok(typed) => Some(typed),
            Err(error) => {
                self.diagnostics
                    .push(Diagnostic::error(value.span, error.code.to_string()));
                None
            }
        }
    }

    fn step(&mut self, written: &Value) {
        // `Name(..)`, or `(id: .., run: Name(..), ..)`.
        let is_envelope = matches!(written.kind, ValueKind::Struct(_) | ValueKind::Unit);
        let Some(value) = self.filled(written) else {
            self.push_broken(written);
            return;
        };
        let mut run = &value;
        let before = self.diagnostics.len();
        if is_envelope {
            let wrong = check_shape(&value, &schema::step_envelope());
            self.diagnostics.extend(wrong);
            let Some(inner) = value.field("run") else {
                self.push_broken(&value);
                return;
            };
            run = inner;
        }
        let Some((name, span)) = run.name() else {
            // A slip that was reported already leaves no name.
            if !run.has_errors() && self.diagnostics.len() == before {
                let message = format!("expected an operation, found {}", run.describe());
                self.diagnostics.push(Diagnostic::error(run.span, message));
            }
            self.push_broken(&value);
            return;
        };
        let id = value.field("id").filter(|_| is_envelope);
        let id = id.and_then(Value::as_str).map(str::to_owned);
        self.check_id(id.as_deref(), &value);
        let entry = self.registry.get(name);
        let step = if let Some(entry) = entry {
            self.operation(entry, run)
        } else {
            let known = self.registry.entries().iter().map(|e| e.name);
            let unknown = Diagnostic::error(span, format!("unknown operation `{name}`"));
            self.diagnostics
                .push(unknown.with_help(did_you_mean(name, known)));
            None
        };
        let envelope = |field: &str| value.field(field).filter(|_| is_envelope);
        let on = envelope("on").and_then(Value::items).map(|items| {
            let named = |item: &Value| item.as_str().map(|name| (name.to_owned(), item.span));
            items.iter().filter_map(named).collect()
        });
        if let (Some(entry), Some(on)) = (entry, envelope("on"))
            && !entry.takes_on
        {
            let message = format!("{} does not take `on`", entry.name);
            let help = "it names its objects in parameters of its own, or makes new ones";
            self.diagnostics
                .push(Diagnostic::error(on.span, message).with_help(help));
        }
        let refused = envelope("refused").and_then(|reason| {
            // A wrong reason was reported with the envelope.
            syntax::ron_options().from_str(&reason.to_string()).ok()
        });
        let step = RecipeStep {
            id,
            name: name.to_owned(),
            step,
            on,
            refused,
            span,
            value: run.clone(),
        };
        self.recipe.steps.push(step);
    }

    fn operation(&mut self, entry: &Entry, run: &Value) -> Option<Box<dyn Step>> {
        let wrong = check_step(run, &entry.schema());
        if !wrong.is_empty() || run.has_errors() {
            self.diagnostics.extend(wrong);
            return None;
        }
        // A name alone stands for a name with nothing in brackets.
        let parameters = match &run.kind {
            ValueKind::Call(call) => call.body.to_string(),
            _ => "()".to_owned(),
        };
        match entry.parse(&parameters) {
            Ok(step) => Some(step),
            Err(error) => {
                let message = format!("{}: {}", entry.name, error.code);
                self.diagnostics.push(Diagnostic::error(run.span, message));
                None
            }
        }
    }

    /// A step that could not be read keeps its place in the list, and its id.
    fn push_broken(&mut self, written: &Value) {
        let run = written.field("run").unwrap_or(written);
        let (name, span) = run.name().unwrap_or(("?", written.span));
        self.recipe.steps.push(RecipeStep {
            id: written
                .field("id")
                .and_then(Value::as_str)
                .map(str::to_owned),
            name: name.to_owned(),
            step: None,
            on: None,
            refused: None,
            span,
            value: run.clone(),
        });
    }

    fn check_id(&mut self, id: Option<&str>, value: &Value) {
        let Some(id) = id else { return };
        if self
            .recipe
            .steps
            .iter()
            .any(|s| s.id.as_deref() == Some(id))
        {
            let span = value.field("id").map_or(value.span, |v| v.span);
            let message = format!("two steps have the id \"{id}\"");
            self.diagnostics.push(Diagnostic::error(span, message));
        }
    }

    /// `Name(..)`, or `(after: "id", on: [..], that: Name(..) or a list of them)`.
    fn expectation(&mut self, written: &Value) {
        let Some(value) = self.filled(written) else {
            return;
        };
        if !matches!(value.kind, ValueKind::Struct(_) | ValueKind::Unit) {
            self.place(&value, None, None);
            return;
        }
        let wrong = check_shape(&value, &schema::expectation_envelope());
        self.diagnostics.extend(wrong);
        let mut after = None;
        if let Some(id) = value.field("after")
            && let Some(text) = id.as_str()
        {
            after = self
                .recipe
                .steps
                .iter()
                .position(|s| s.id.as_deref() == Some(text));
            if after.is_none() {
                let known = self.recipe.steps.iter().filter_map(|s| s.id.as_deref());
                let message = format!("no step has the id \"{text}\"");
                self.diagnostics
                    .push(Diagnostic::error(id.span, message).with_help(did_you_mean(text, known)));
                return;
            }
        }
        let on = value.field("on").and_then(Value::items).map(|items| {
            items
                .iter()
                .filter_map(Value::as_str)
                .map(str::to_owned)
                .collect::<Vec<_>>()
        });
        let Some(that) = value.field("that") else {
            return;
        };
        for item in that.items().unwrap_or(std::slice::from_ref(that)) {
            self.place(item, after, on.clone());
        }
    }

    fn place(&mut self, value: &Value, after: Option<usize>, on: Option<Vec<String>>) {
        let Some(that): Option<Expectation> = self.typed(value, &schema::of::<Expectation>())
        else {
            return;
        };
        if let Some(problem) = that.problem() {
            self.diagnostics.push(
                Diagnostic::error(value.span, problem)
                    .with_help("give it a bound, such as `eq`, `min` or `max`"),
            );
            return;
        }
        self.recipe.expectations.push(Placed {
            after,
            on,
            that,
            span: value.span,
        });
    }
}

impl Reading {
    /// Whether the recipe cannot run.
    pub fn has_errors(&self) -> bool {
        self.diagnostics
            .iter()
            .any(|d| d.severity == Severity::Error)
    }
}

impl Recipe {
    /// The texts that stand for placeholders in output paths: `{name.stem}` and `{name.name}` for each
    /// parameter that is a path.
    pub fn placeholders(&self) -> Vec<(String, String)> {
        let mut texts = Vec::new();
        for parameter in &self.parameters {
            if let Param::Path { .. } = parameter.param
                && let Ok(path) = ron::from_str::<PathBuf>(&parameter.literal)
            {
                let text = |part: Option<&std::ffi::OsStr>| {
                    part.map(|p| p.to_string_lossy().into_owned())
                        .unwrap_or_default()
                };
                texts.push((format!("{}.stem", parameter.name), text(path.file_stem())));
                texts.push((format!("{}.name", parameter.name), text(path.file_name())));
            }
        }
        texts
    }

    /// The digest of what the recipe does: its operations with all their parameters, in their
    /// canonical form. Layout, comments and notes do not count.
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        for step in &self.steps {
            let canonical = step
                .step
                .as_ref()
                .map(|s| s.canonical())
                .unwrap_or_default();
            let line = format!(
                "{:?} {:?} {} {canonical}\n",
                step.id,
                step.on_names(),
                step.name
            );
            hasher.update(line.as_bytes());
        }
        hasher.finalize().to_hex()[..32].to_owned()
    }
}
