//! Reads a recipe: converts its text to operations with their parameters, and reports all errors at once.
//!
//! There are three stages. First, the text is parsed into a tree; parsing continues after a syntax error. Second, each
//! step is checked against the schema of its operation. Third, each valid step is deserialized into the struct of its
//! operation. An error in one step does not hide errors in other steps.
//!
//! A step that contains other steps (module [`flow`]) is replaced by the steps inside it. The check and the run
//! therefore receive a list of steps without nesting. A called recipe has its own scope when it is read, with its own
//! parameters and ids.

mod expectations;
mod flow;
mod parameters;
mod steps;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use indexmap::{IndexMap, IndexSet};
use op::Registry;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use store::{Disk, Store};

use crate::recipe::{
    MAX_STEPS, OnLoss, Parameter, Recipe, RecipeExpectation, RecipeStep, Scope, located,
};
use crate::schema::{self, Schemas};
use crate::schema_check::{self, check_schema};
use crate::source::Source;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// The version of the recipe language that this program reads.
pub const VERSION: i128 = 1;

/// A recipe with its errors and warnings.
#[derive(Debug)]
pub struct Reading {
    /// The recipe. If the recipe has errors, this value contains only the parts that could be read.
    pub recipe: Recipe,
    /// The errors and warnings, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

impl Reading {
    /// Whether there are errors that prevent the recipe from running.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// Values that the caller of `read` sets for the parameters of a recipe. By default, no values are set.
#[derive(Clone, Copy, Debug, Default)]
pub struct Values<'a> {
    /// The names of parameters, each with its value as plain text.
    pub set: &'a [(String, String)],
    /// The name of a preset of the recipe.
    pub preset: Option<&'a str>,
    /// The folder to which relative paths in the field `set` are relative, such as the working directory. If `None`,
    /// these paths are relative to the folder of the recipe.
    pub folder: Option<&'a Path>,
}

/// Reads a recipe and the recipes that it calls.
pub fn read(source: &Source, registry: &Registry, values: Values) -> Reading {
    read_by(&Schemas::new(registry), &Disk, source, values)
}

/// Like [`read`](read()), but reads called recipes from `store`. Several calls of this function can share `schemas`.
pub fn read_by(schemas: &Schemas, store: &dyn Store, source: &Source, values: Values) -> Reading {
    let mut shared = Shared {
        schemas,
        store,
        sources: vec![source.clone()],
        scopes: vec![Scope {
            source: 0,
            parameters: Vec::new(),
            called: None,
        }],
        canonical_paths: vec![canonical(store, &source.path)],
        remaining_steps: MAX_STEPS,
        diagnostics: Vec::new(),
    };
    let mut reader = Reader::new(&mut shared, 0, String::new());
    let (drafts, last) = reader.text(|reader| {
        reader.choose_preset(values.preset);
        reader.set(values);
    });
    let (about, presets) = (reader.about.take(), std::mem::take(&mut reader.presets));
    reader.close();

    let mut steps = Vec::with_capacity(drafts.len());
    let mut expectations = Vec::new();
    for (i, draft) in drafts.into_iter().enumerate() {
        steps.push(draft.step);
        let then = draft.then.into_iter().map(|placed| RecipeExpectation {
            after: Some(i),
            ..placed
        });
        expectations.extend(then);
    }
    expectations.extend(last);
    let mut diagnostics = shared.diagnostics;
    diagnostics.sort_by_key(|d| (d.source, d.span));
    Reading {
        recipe: Recipe {
            about,
            sources: shared.sources,
            scopes: shared.scopes,
            presets: presets.into_iter().map(|preset| preset.name).collect(),
            steps,
            expectations,
        },
        diagnostics,
    }
}

/// Returns an error if a text declares another version than `expected`, for example with `recipe: 2` if 1 is expected.
pub(crate) fn wrong_version(root: &Value, kind: &str, expected: i128) -> Option<Diagnostic> {
    let version = root.field(kind)?;
    let ValueKind::Number(number) = &version.kind else {
        return None;
    };
    let found = number.to_int().filter(|&found| found != expected)?;
    let message = format!("this {kind} has the format version {found}, expected {expected}");
    let help = if found > expected {
        "a newer version of meshwright may be able to read the file"
    } else {
        "write 1"
    };
    Some(Diagnostic::error(version.span, message).with_help(help))
}

/// The state that all sources of one recipe share while they are read.
struct Shared<'a> {
    schemas: &'a Schemas<'a>,
    /// The store from which called recipes are read.
    store: &'a dyn Store,
    sources: Vec<Source>,
    /// The paths of the sources after resolving symbolic links.
    canonical_paths: Vec<PathBuf>,
    scopes: Vec<Scope>,
    /// The number of steps that can be added before the limit is reached.
    remaining_steps: usize,
    diagnostics: Vec<Diagnostic>,
}

/// Returns the path after resolving symbolic links. If the file does not exist, returns the path itself.
fn canonical(store: &dyn Store, path: &Path) -> PathBuf {
    store.canonical(path).unwrap_or_else(|_| path.to_owned())
}

/// A step, together with the ids and expectations that belong to it.
#[derive(Clone)]
struct Draft {
    step: RecipeStep,
    /// The id of the step itself, and the ids of all calls, repetitions and conditions in which this step is the last
    /// step. Only ids that are written in the same text as the step are included.
    ends: Vec<String>,
    /// The expectations that are checked after the step.
    then: Vec<RecipeExpectation>,
}

/// Takes the items out of a list. Returns an empty list if the value is not a list.
fn take_items(list: Option<&mut Value>) -> Vec<Value> {
    match list.map(|list| &mut list.kind) {
        Some(ValueKind::List(items)) => std::mem::take(items),
        _ => Vec::new(),
    }
}

/// Reads one text in one scope, that is, with one set of parameter values.
struct Reader<'s, 'a> {
    shared: &'s mut Shared<'a>,
    source: Source,
    /// The index of the scope.
    scope: usize,
    /// Every label of a step that this reader reads begins with this text.
    prefix: String,
    on_loss: OnLoss,
    diagnostics: Vec<Diagnostic>,
    about: Option<String>,
    /// The parameters by their names.
    parameters: IndexMap<String, Parameter>,
    presets: Vec<parameters::Preset>,
    /// The names of parameters whose declarations have errors.
    broken: HashSet<String>,
    /// The names of parameters that an `arg(..)` or an `If` uses.
    used: HashSet<String>,
    /// The ids of the steps in this text that were read so far.
    ids: IndexSet<String>,
    /// Whether an error was already reported for too many steps.
    has_too_many_steps: bool,
}

impl<'s, 'a> Reader<'s, 'a> {
    fn new(shared: &'s mut Shared<'a>, scope: usize, prefix: String) -> Self {
        let source = shared.sources[shared.scopes[scope].source].clone();
        Self {
            shared,
            source,
            scope,
            prefix,
            on_loss: OnLoss::default(),
            diagnostics: Vec::new(),
            about: None,
            parameters: IndexMap::new(),
            presets: Vec::new(),
            broken: HashSet::new(),
            used: HashSet::new(),
            ids: IndexSet::new(),
            has_too_many_steps: false,
        }
    }

    /// Reads the text. `values` is called when the parameters have been declared, and sets the values of the
    /// parameters. Returns the steps, and the expectations that are checked at the end of the recipe.
    fn text(&mut self, values: impl FnOnce(&mut Self)) -> (Vec<Draft>, Vec<RecipeExpectation>) {
        let text = self.source.text.clone();
        let parsed = ron_tree::parse(&text);
        let mut root = parsed.value;
        self.diagnostics.extend(parsed.diagnostics);
        let nothing = (Vec::new(), Vec::new());
        // The version is checked before anything else is interpreted.
        if let Some(problem) = wrong_version(&root, "recipe", VERSION) {
            self.diagnostics.push(problem);
            return nothing;
        }
        if matches!(root.kind, ValueKind::Error) && !self.diagnostics.is_empty() {
            return nothing;
        }
        let wrong = check_schema(&root, schema::envelope());
        self.diagnostics.extend(wrong);
        self.about = root
            .field("about")
            .and_then(Value::as_str)
            .map(str::to_owned);
        if let Some(needs) = root.field("needs") {
            self.needs(needs);
        }
        if let Some(on_loss) = root.field("on_loss") {
            // `check_schema` has already reported an invalid value, so the default is used.
            self.on_loss = OnLoss::deserialize(on_loss).unwrap_or_default();
        }
        self.declare(root.field("params"));
        self.declare_presets(root.field("presets"));
        values(self);
        self.shared.scopes[self.scope].parameters = self.parameters.values().cloned().collect();
        let mut drafts = self.steps(take_items(root.field_mut("steps")));
        // For each id, the indices (in `drafts`) of the steps with this id. An id inside a `Repeat` has one index for
        // each repetition. For the id of a step that contains steps, the index of its last step is used. An id in a
        // branch that is not taken has no index.
        let mut ends: HashMap<String, Vec<usize>> = HashMap::new();
        for (i, draft) in drafts.iter().enumerate() {
            for id in &draft.ends {
                ends.entry(id.clone()).or_default().push(i);
            }
        }
        let mut last = Vec::new();
        for expectation in take_items(root.field_mut("expect")) {
            let (after, placed) = self.expectation(expectation);
            match after {
                None => last.extend(placed),
                Some(id) => {
                    for &i in ends.get(&id).into_iter().flatten() {
                        drafts[i].then.extend(placed.iter().cloned());
                    }
                }
            }
        }
        self.unused(root.field("params"));
        (drafts, last)
    }

    /// Moves the diagnostics of this text to the diagnostics of the whole recipe. For each diagnostic, sets the text to
    /// which it belongs and the calls that led to this text.
    fn close(self) {
        let scopes = &self.shared.scopes;
        let located = (self.diagnostics.into_iter()).map(|d| located(d, self.scope, scopes));
        self.shared.diagnostics.extend(located);
    }

    fn needs(&mut self, needs: &Value) {
        let numbers = |text: &str| -> Option<Vec<u64>> {
            text.split('.').map(|part| part.parse().ok()).collect()
        };
        let here = env!("CARGO_PKG_VERSION");
        let Some(text) = needs.as_str() else { return };
        let problem = match numbers(text) {
            None => format!("expected a version such as \"{here}\", found \"{text}\""),
            Some(needed) if Some(&needed) > numbers(here).as_ref() => {
                format!(
                    "this recipe needs meshwright {text}, but this program has the version {here}"
                )
            }
            Some(_) => return,
        };
        self.error(needs.span, problem, "");
    }

    /// Adds an error. If `help` is not empty, the error has this help text.
    fn error(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) {
        let (error, help) = (Diagnostic::error(span, message), help.into());
        self.diagnostics.push(if help.is_empty() {
            error
        } else {
            error.with_help(help)
        });
    }

    /// Checks a value against a schema and deserializes it.
    fn typed<T: DeserializeOwned>(&mut self, value: &Value, schema: &Json) -> Option<T> {
        match schema_check::typed(value, schema) {
            Ok(typed) => Some(typed),
            Err(wrong) => {
                self.diagnostics.extend(wrong);
                None
            }
        }
    }
}
