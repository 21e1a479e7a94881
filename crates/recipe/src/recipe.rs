//! A recipe after it was read. The recipe has a flat list of steps, in which calls and repetitions are replaced by the
//! steps that they stand for.

use std::path::Path;
use std::sync::Arc;

use op::{Files, Loss, Refusal, Step};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::expect::Expectation;
use crate::params::Param;
use crate::source::Source;
use ron_tree::{Diagnostic, Span, Value};

/// The maximum number of steps. Calls and repetitions count as the steps that they stand for.
pub const MAX_STEPS: usize = 100_000;

/// A recipe that was read. If the recipe has errors, this value contains only the parts that could be read.
#[derive(Debug)]
pub struct Recipe {
    /// The description of the recipe.
    pub about: Option<String>,
    /// The sources to which spans refer: first the text of the recipe itself, then the text of each recipe that it
    /// calls.
    pub sources: Vec<Source>,
    /// The scopes: each scope is the text of a recipe, with values for the parameters of this recipe. The first scope
    /// is the recipe itself, and each call of another recipe adds one scope.
    pub scopes: Vec<Scope>,
    /// The names of the presets of the recipe. A preset is a named set of parameter values.
    pub presets: Vec<String>,
    /// The steps in the order in which they run. Calls, repetitions and conditions are replaced by the steps that they
    /// stand for.
    pub steps: Vec<RecipeStep>,
    /// The expectations, in the order of the steps after which they are checked.
    pub expectations: Vec<RecipeExpectation>,
}

/// A scope: the text of a recipe, with values for its parameters. A scope is either the recipe itself or one call of
/// another recipe.
#[derive(Clone, Debug)]
pub struct Scope {
    /// The index of the text in [`Recipe::sources`].
    pub source: usize,
    /// The parameters of this text, each with its value.
    pub parameters: Vec<Parameter>,
    /// The index of the scope that contains the call, and the span of the call in the text of that scope. `None` for
    /// the recipe itself.
    pub called: Option<(usize, Span)>,
}

/// A parameter with its value.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name of the parameter.
    pub name: String,
    /// The declaration of the parameter.
    pub param: Param,
    /// The current value of the parameter.
    pub value: Value,
    /// Where the value comes from.
    pub origin: Origin,
}

/// Where the value of a parameter comes from. If a value is set in several ways, the way that comes last in this
/// enumeration takes precedence.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The default in the recipe.
    Default,
    /// The preset with this name.
    Preset(String),
    /// The field `with:` of the step that calls the recipe.
    Call,
    /// The command line, or another program.
    Set,
}

impl Parameter {
    /// Whether the value was set on the command line, by another program, or by a preset. A value from `with:` does not
    /// count.
    pub fn is_set(&self) -> bool {
        matches!(self.origin, Origin::Set | Origin::Preset(_))
    }

    /// Returns the value as plain text in the form of the command line, in which strings have no quotes.
    pub fn plain_text(&self) -> String {
        let text = self.value.as_str().map(str::to_owned);
        text.unwrap_or_else(|| self.value.to_string())
    }
}

/// What happens if a step loses data. Data are lost if a step cannot preserve an attribute, or if a file format cannot
/// store some of the data.
#[derive(Clone, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum OnLoss {
    /// The run reports the loss and continues.
    #[default]
    Warn,
    /// The run fails.
    Error,
    /// Steps are allowed to lose data with these names. If a step loses other data, the run fails.
    Allow(Vec<String>),
}

impl OnLoss {
    /// Whether steps are allowed to lose data with this name.
    pub fn allows(&self, name: &str) -> bool {
        match self {
            Self::Warn => true,
            Self::Error => false,
            Self::Allow(names) => names.iter().any(|n| n == name),
        }
    }

    /// Returns the first loss that is not allowed.
    pub fn forbidden<'l>(&self, losses: &'l [Loss]) -> Option<&'l Loss> {
        losses.iter().find(|loss| !self.allows(&loss.name))
    }
}

/// The kind of a step that contains other steps: a call, a repetition or a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Call,
    Repeat,
    If,
}

impl Kind {
    pub(crate) const ALL: [Self; 3] = [Self::Call, Self::Repeat, Self::If];

    /// Returns the name of this kind of step in recipes.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Call => "Call",
            Self::Repeat => "Repeat",
            Self::If => "If",
        }
    }
}

/// A step of a recipe that was read.
#[derive(Clone, Debug)]
pub struct RecipeStep {
    /// The id of the step. Other parts of the recipe use the id to refer to the step.
    pub id: Option<String>,
    /// The current name of the operation, even if the recipe uses an earlier name. If the operation is unknown, this is
    /// the name as written in the recipe.
    pub name: String,
    /// The label. It is shown to users, and it seeds random choices. An example of a label is `clean/Weld#2`. The first
    /// part contains the names of the calls around the step. The second part is the id of the step, and the third part
    /// contains the numbers of the repetitions around the step. If the step has no id, the second part is the name of
    /// the operation.
    pub label: String,
    /// The operation. `None` if the step could not be read.
    pub step: Option<Arc<dyn Step>>,
    /// The names of the objects in `on`, each with its span.
    pub on: Option<Vec<(String, Span)>>,
    /// The expected reason, if the recipe expects the operation to refuse its input.
    pub refused: Option<Refusal>,
    /// The losses that the step is allowed to cause.
    pub on_loss: OnLoss,
    /// The comment on the step. Programs show the comment to users. The comment has no effect on the run.
    pub note: Option<String>,
    /// The index of the scope in [`Recipe::scopes`].
    pub scope: usize,
    /// The span of the name of the operation.
    pub span: Span,
    /// The operation as written in the recipe, but with parameters replaced by their values.
    pub value: Value,
    /// One number for each `Repeat` around the step, from the outermost to the innermost. The number says to which
    /// repetition the step belongs, counted from 1.
    pub(crate) turns: Vec<u32>,
    /// The label without the numbers of the repetitions.
    pub(crate) stem: String,
}

impl RecipeStep {
    /// Returns the label.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Returns the names of the objects in `on`.
    pub fn on_names(&self) -> Option<Vec<String>> {
        self.on
            .as_ref()
            .map(|on| on.iter().map(|(name, _)| name.clone()).collect())
    }

    /// Adds the repetition number `turn` to the label of the step, and returns the step. `turn` counts the repetitions
    /// of a `Repeat` that contains the step. If several `Repeat`s contain the step, this function must be called for
    /// the innermost `Repeat` first.
    pub(crate) fn in_turn(mut self, turn: u32) -> Self {
        self.turns.insert(0, turn);
        let turns: Vec<String> = self.turns.iter().map(u32::to_string).collect();
        self.label = format!("{}#{}", self.stem, turns.join("."));
        self
    }
}

/// An expectation, and the point in the recipe at which it is checked.
#[derive(Clone, Debug)]
pub struct RecipeExpectation {
    /// The index of the step after which the expectation is checked. If `None`, the expectation is checked at the end
    /// of the recipe.
    pub after: Option<usize>,
    /// The names of the objects for which the expectation is checked. If `None`, it is checked for all objects.
    pub on: Option<Vec<String>>,
    /// The expectation.
    pub that: Expectation,
    /// The index of the scope in [`Recipe::scopes`].
    pub scope: usize,
    /// The span of the expectation.
    pub span: Span,
}

impl Recipe {
    /// Changes `on_loss: Warn`, which is the default, to `on_loss: Error` in all steps.
    pub fn forbid_losses(&mut self) {
        for step in &mut self.steps {
            if step.on_loss == OnLoss::Warn {
                step.on_loss = OnLoss::Error;
            }
        }
    }

    /// Returns the parameters of the recipe itself, but not those of called recipes.
    pub fn parameters(&self) -> &[Parameter] {
        self.scopes.first().map_or(&[], |scope| &scope.parameters)
    }

    /// Returns the placeholders that output paths of the recipe itself can contain, with their values. Each parameter
    /// that is a path has two placeholders: if its name is `p`, these are `p.stem` and `p.name`.
    pub fn placeholders(&self) -> Vec<(String, String)> {
        self.scopes
            .first()
            .map(Scope::placeholders)
            .unwrap_or_default()
    }

    /// Returns the file settings of the recipe itself and of each called recipe, such as the folder with the input
    /// files of its steps. The recipe itself gets the given settings `files`. A called recipe reads files from its own
    /// folder and has its own placeholders.
    pub fn files(&self, files: &Files) -> Vec<Files> {
        let of = |(i, scope): (usize, &Scope)| {
            if i == 0 {
                return files.clone();
            }
            Files {
                input: self.sources[scope.source].folder().to_path_buf(),
                placeholders: scope.placeholders(),
                ..files.clone()
            }
        };
        self.scopes.iter().enumerate().map(of).collect()
    }

    /// Whether the recipe has `Output` expectations.
    pub(crate) fn checks_outputs(&self) -> bool {
        self.expectations
            .iter()
            .any(|placed| placed.that.output().is_some())
    }

    /// Returns the index, in [`Recipe::sources`], of the source text that contains a scope.
    pub fn source_of(&self, scope: usize) -> usize {
        self.scopes.get(scope).map_or(0, |scope| scope.source)
    }

    /// Adds a location to a diagnostic, and returns the diagnostic. The location has two parts: the chain of calls that
    /// led to the scope, and the index of the scope's source text in [`Recipe::sources`].
    pub fn located(&self, diagnostic: Diagnostic, scope: usize) -> Diagnostic {
        located(diagnostic, scope, &self.scopes)
    }

    /// Returns a digest of all operations of the recipe. The digest depends on all parameters of the operations, in
    /// canonical form. Layout, comments and the notes on steps (`note: ..`) do not change the digest.
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        for step in &self.steps {
            let canonical = step
                .step
                .as_ref()
                .map(|s| s.canonical())
                .unwrap_or_default();
            // A label that is only the name of the operation is hashed as `None`. With this rule, the digest is the
            // same as in older versions of the program.
            let id = (step.label != step.name).then_some(&step.label);
            let line = format!("{id:?} {:?} {} {canonical}\n", step.on_names(), step.name);
            hasher.update(line.as_bytes());
            // In a called recipe, relative paths are relative to the folder of that recipe, so the digest depends on
            // this folder.
            let called = self.source_of(step.scope);
            if called > 0 {
                let folder = self.sources[called].folder().to_string_lossy();
                let own = self.sources[0].folder();
                let seen = pathdiff::diff_paths(&*folder, own).unwrap_or_else(|| (*folder).into());
                hasher.update(format!("from {}\n", seen.display()).as_bytes());
            }
        }
        hasher.finalize().to_hex()[..32].to_owned()
    }
}

/// See [`Recipe::located`].
pub(crate) fn located(mut diagnostic: Diagnostic, scope: usize, scopes: &[Scope]) -> Diagnostic {
    let Some(mut at) = scopes.get(scope) else {
        return diagnostic;
    };
    diagnostic.source = at.source;
    diagnostic.calls.clear();
    while let Some((caller, span)) = at.called {
        at = &scopes[caller];
        diagnostic.calls.push((at.source, span));
    }
    diagnostic
}

impl Scope {
    fn placeholders(&self) -> Vec<(String, String)> {
        let mut texts = Vec::new();
        for parameter in &self.parameters {
            if let Param::Path { .. } = parameter.param
                && let Some(path) = parameter.value.as_str().map(Path::new)
            {
                let name = path.file_name().unwrap_or_default();
                for (part, text) in [("stem", store::stem(path)), ("name", name)] {
                    let placeholder = format!("{}.{part}", parameter.name);
                    texts.push((placeholder, text.to_string_lossy().into_owned()));
                }
            }
        }
        texts
    }
}
