//! Reading a recipe: text to operations with their parameters, and every error on the way.
//!
//! Three stages: the text becomes a tree that survives slips; each step is held against the schema of
//! its operation; what passes is read into the operation's struct. One broken step hides no other.
//!
//! Steps that hold steps ([`flow`]) are done here: the recipe becomes one list, and later stages know of
//! nothing else. A recipe that is called is read in a scope of its own, with its own parameters and ids.

mod expectations;
mod flow;
mod parameters;
mod steps;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use indexmap::IndexSet;
use op::Registry;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use store::{Disk, Store};

use crate::recipe::{
    MAX_STEPS, OnLoss, Parameter, Recipe, RecipeExpectation, RecipeStep, Scope, located,
};
use crate::schema::{self, Schemas};
use crate::shape::{self, check_shape};
use crate::source::Source;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// The version of recipes that this program reads.
pub const VERSION: i128 = 1;

/// A recipe and what is wrong with it.
#[derive(Debug)]
pub struct Reading {
    /// The recipe, as far as it could be read.
    pub recipe: Recipe,
    /// What is wrong, in order.
    pub diagnostics: Vec<Diagnostic>,
}

impl Reading {
    /// Whether the recipe cannot run.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// The values that a recipe's parameters get from outside; by default none.
#[derive(Clone, Copy, Debug, Default)]
pub struct Values<'a> {
    /// Names of parameters and their values as text.
    pub set: &'a [(String, String)],
    /// One of the recipe's presets.
    pub preset: Option<&'a str>,
    /// The folder that relative paths in `set` are seen from, such as the working directory; the
    /// recipe's own if `None`.
    pub folder: Option<&'a Path>,
}

/// Reads a recipe, and those that it calls.
pub fn read(source: &Source, registry: &Registry, values: Values) -> Reading {
    read_by(&Schemas::new(registry), &Disk, source, values)
}

/// The same with schemas that serve several recipes; recipes that are called are read from `store`.
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
        real: vec![real(store, &source.path)],
        left: MAX_STEPS,
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

/// Refuses a text that says that it is of another version: `recipe: 2`.
pub(crate) fn other_version(root: &Value, kind: &str, expected: i128) -> Option<Diagnostic> {
    let version = root.field(kind)?;
    let ValueKind::Number(number) = &version.kind else {
        return None;
    };
    let found = number.to_int().filter(|&found| found != expected)?;
    let message = format!("this {kind} is of version {found}, expected {expected}");
    let help = if found > expected {
        "a newer meshwright can read it"
    } else {
        "write 1"
    };
    Some(Diagnostic::error(version.span, message).with_help(help))
}

/// What the texts of one recipe share while they are read.
struct Shared<'a> {
    schemas: &'a Schemas<'a>,
    /// Where recipes that are called are.
    store: &'a dyn Store,
    sources: Vec<Source>,
    /// The files of the sources, links followed.
    real: Vec<PathBuf>,
    scopes: Vec<Scope>,
    /// How many more steps there may be.
    left: usize,
    diagnostics: Vec<Diagnostic>,
}

/// A path with its links followed, if the file is there.
fn real(store: &dyn Store, path: &Path) -> PathBuf {
    store.canonical(path).unwrap_or_else(|_| path.to_owned())
}

/// A step, and what hangs on it.
#[derive(Clone)]
struct Draft {
    step: RecipeStep,
    /// The ids of this text whose work ends with the step.
    ends: Vec<String>,
    /// What must hold after it.
    then: Vec<RecipeExpectation>,
}

/// The items of a list, which leaves it empty; none if it is no list.
fn take_items(list: Option<&mut Value>) -> Vec<Value> {
    match list.map(|list| &mut list.kind) {
        Some(ValueKind::List(items)) => std::mem::take(items),
        _ => Vec::new(),
    }
}

/// Reads one text in one scope.
struct Reader<'s, 'a> {
    shared: &'s mut Shared<'a>,
    source: Source,
    /// The scope, by its place.
    scope: usize,
    /// What the labels of steps begin with.
    prefix: String,
    on_loss: OnLoss,
    diagnostics: Vec<Diagnostic>,
    about: Option<String>,
    parameters: Vec<Parameter>,
    presets: Vec<parameters::Preset>,
    /// Parameters that are declared, but wrongly.
    broken: Vec<String>,
    /// Parameters that some `arg(..)` names.
    used: HashSet<String>,
    /// The ids of steps.
    ids: IndexSet<String>,
    /// Whether it was reported that there are too many steps.
    is_over: bool,
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
            parameters: Vec::new(),
            presets: Vec::new(),
            broken: Vec::new(),
            used: HashSet::new(),
            ids: IndexSet::new(),
            is_over: false,
        }
    }

    /// Reads the text. `values` gives the parameters their values when they are declared. Returns the steps,
    /// and what must hold at the end.
    fn text(&mut self, values: impl FnOnce(&mut Self)) -> (Vec<Draft>, Vec<RecipeExpectation>) {
        let text = self.source.text.clone();
        let parsed = ron_tree::parse(&text);
        let mut root = parsed.value;
        self.diagnostics.extend(parsed.diagnostics);
        let nothing = (Vec::new(), Vec::new());
        // The version is read before anything else is interpreted.
        if let Some(problem) = other_version(&root, "recipe", VERSION) {
            self.diagnostics.push(problem);
            return nothing;
        }
        if matches!(root.kind, ValueKind::Error) && !self.diagnostics.is_empty() {
            return nothing;
        }
        let wrong = check_shape(&root, schema::envelope());
        self.diagnostics.extend(wrong);
        self.about = root
            .field("about")
            .and_then(Value::as_str)
            .map(str::to_owned);
        if let Some(needs) = root.field("needs") {
            self.needs(needs);
        }
        if let Some(on_loss) = root.field("on_loss") {
            // A wrong one was reported with the envelope.
            self.on_loss = OnLoss::deserialize(on_loss).unwrap_or_default();
        }
        self.declare(root.field("params"));
        self.declare_presets(root.field("presets"));
        values(self);
        self.shared.scopes[self.scope]
            .parameters
            .clone_from(&self.parameters);
        let mut drafts = self.steps(take_items(root.field_mut("steps")));
        // Each turn of a repetition has a step with the id, and a branch that is not taken has none.
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

    /// Hands the diagnostics over, with their text and the calls that led to it.
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
            Some(wanted) if Some(&wanted) > numbers(here).as_ref() => {
                format!("this recipe needs meshwright {text}, and this is {here}")
            }
            Some(_) => return,
        };
        self.error(needs.span, problem, "");
    }

    /// Adds an error, with advice unless that is empty.
    fn error(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) {
        let (error, help) = (Diagnostic::error(span, message), help.into());
        self.diagnostics.push(if help.is_empty() {
            error
        } else {
            error.with_help(help)
        });
    }

    /// Holds a value against a schema and reads it into its type.
    fn typed<T: DeserializeOwned>(&mut self, value: &Value, schema: &Json) -> Option<T> {
        match shape::typed(value, schema) {
            Ok(typed) => Some(typed),
            Err(wrong) => {
                self.diagnostics.extend(wrong);
                None
            }
        }
    }
}
