//! A recipe after reading: a flat list of steps, in which calls and repetitions are replaced by their steps.

use std::path::Path;
use std::sync::Arc;

use op::{Files, Loss, Refusal, Step};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::expect::Expectation;
use crate::params::Param;
use crate::source::Source;
use ron_tree::{Diagnostic, Span, Value};

/// The maximum number of steps, after calls and repetitions are replaced by their steps.
pub const MAX_STEPS: usize = 100_000;

/// A recipe that was read. If the recipe has errors, this value contains the parts that could be read.
#[derive(Debug)]
pub struct Recipe {
    /// The description of the recipe.
    pub about: Option<String>,
    /// The sources that spans refer to: first the text of the recipe itself, then the text of each recipe that it
    /// calls.
    pub sources: Vec<Source>,
    /// The scopes of parameters: first the scope of the recipe itself, then one scope for each call.
    pub scopes: Vec<Scope>,
    /// The names of the presets of the recipe.
    pub presets: Vec<String>,
    /// The steps in the order in which they run. Calls, repetitions and conditions are replaced by their steps.
    pub steps: Vec<RecipeStep>,
    /// The expectations, in the order of the steps after which they are checked.
    pub expectations: Vec<RecipeExpectation>,
}

/// A text with values for its parameters: the recipe itself, or one call of another recipe.
#[derive(Clone, Debug)]
pub struct Scope {
    /// The index of the text in [`Recipe::sources`].
    pub source: usize,
    /// The parameters with their values.
    pub parameters: Vec<Parameter>,
    /// The scope that contains the call, and the span of the call in its text. `None` for the recipe itself.
    pub called: Option<(usize, Span)>,
}

/// A parameter with its value.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name of the parameter.
    pub name: String,
    /// The declaration of the parameter.
    pub param: Param,
    /// The current value.
    pub value: Value,
    /// Where the value comes from.
    pub origin: Origin,
}

/// Where the value of a parameter comes from. Later variants of this enumeration take precedence over earlier variants.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The default in the recipe.
    Default,
    /// The preset with this name.
    Preset(String),
    /// `with:` of the step that calls the recipe.
    Call,
    /// The command line, or another program.
    Set,
}

impl Parameter {
    /// Whether the value was set from outside the recipe, directly or by a preset.
    pub fn is_set(&self) -> bool {
        matches!(self.origin, Origin::Set | Origin::Preset(_))
    }

    /// Returns the value as plain text, as on the command line: strings have no quotes.
    pub fn plain_text(&self) -> String {
        let text = self.value.as_str().map(str::to_owned);
        text.unwrap_or_else(|| self.value.to_string())
    }
}

/// What happens if a step loses data: an attribute that it cannot preserve, or data that a file format cannot
/// store.
#[derive(Clone, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum OnLoss {
    /// The loss is reported.
    #[default]
    Warn,
    /// The run fails.
    Error,
    /// Data with one of these names may be lost. Any other loss fails the run.
    Allow(Vec<String>),
}

impl OnLoss {
    /// Whether data with this name may be lost.
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

/// The kind of a step that contains other steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Call,
    Repeat,
    If,
}

impl Kind {
    pub(crate) const ALL: [Self; 3] = [Self::Call, Self::Repeat, Self::If];

    /// The name in recipes.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Call => "Call",
            Self::Repeat => "Repeat",
            Self::If => "If",
        }
    }
}

/// A step.
#[derive(Clone, Debug)]
pub struct RecipeStep {
    /// The id, by which other parts of the recipe refer to the step.
    pub id: Option<String>,
    /// The current name of its operation. If the operation is unknown, the name as written.
    pub name: String,
    /// The label, which is shown to users and seeds random choices. The label consists of the names of the calls
    /// around the step, the id or (without an id) the name of the operation, and the numbers of the repetitions
    /// around the step, as in `clean/Weld#2`.
    pub label: String,
    /// The operation. `None` if the step could not be read.
    pub step: Option<Arc<dyn Step>>,
    /// The names of the objects in `on`, with their spans.
    pub on: Option<Vec<(String, Span)>>,
    /// The reason for which the step must be refused, if the recipe expects a refusal.
    pub refused: Option<Refusal>,
    /// Which losses the step may cause.
    pub on_loss: OnLoss,
    /// The comment on the step. Programs show the comment to people. The comment has no effect on the run.
    pub note: Option<String>,
    /// The index of its scope in [`Recipe::scopes`].
    pub scope: usize,
    /// The span of the name of the operation.
    pub span: Span,
    /// The operation as written, with parameters replaced by their values.
    pub value: Value,
    /// For each repetition around the step, from the outside in, the number of the current repetition, counted from 1.
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

    /// Returns the step for repetition number `turn` of a `Repeat` around the step.
    pub(crate) fn in_turn(mut self, turn: u32) -> Self {
        self.turns.insert(0, turn);
        let turns: Vec<String> = self.turns.iter().map(u32::to_string).collect();
        self.label = format!("{}#{}", self.stem, turns.join("."));
        self
    }
}

/// An expectation, with the point in the recipe at which it is checked.
#[derive(Clone, Debug)]
pub struct RecipeExpectation {
    /// The index of the step after which the expectation is checked. If `None`, the expectation is checked at the end.
    pub after: Option<usize>,
    /// The names of the objects that the expectation is checked for. If `None`, all objects.
    pub on: Option<Vec<String>>,
    /// The expectation.
    pub that: Expectation,
    /// The index of its scope in [`Recipe::scopes`].
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

    /// Returns the parameters of the recipe itself.
    pub fn parameters(&self) -> &[Parameter] {
        self.scopes.first().map_or(&[], |scope| &scope.parameters)
    }

    /// Returns the placeholders for output paths of the recipe itself, with their values: `name.stem` and `name.name`
    /// for each parameter that is a path.
    pub fn placeholders(&self) -> Vec<(String, String)> {
        self.scopes
            .first()
            .map(Scope::placeholders)
            .unwrap_or_default()
    }

    /// Returns the file settings of each scope. The settings of the recipe itself are `files`. A called recipe reads
    /// from its own folder and has its own placeholders.
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

    /// Returns the index in [`Recipe::sources`] of the text of a scope.
    pub fn source_of(&self, scope: usize) -> usize {
        self.scopes.get(scope).map_or(0, |scope| scope.source)
    }

    /// Returns the diagnostic with the location of a scope: the index of its text, and the calls that led to the scope.
    pub fn located(&self, diagnostic: Diagnostic, scope: usize) -> Diagnostic {
        located(diagnostic, scope, &self.scopes)
    }

    /// Returns the digest of the operations of the recipe with all their parameters in canonical form. Layout, comments
    /// and notes do not change the digest.
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        for step in &self.steps {
            let canonical = step
                .step
                .as_ref()
                .map(|s| s.canonical())
                .unwrap_or_default();
            // If the label is only the name of the operation, the digest uses `None`, so that the digest is the same as
            // in older versions.
            let id = (step.label != step.name).then_some(&step.label);
            let line = format!("{id:?} {:?} {} {canonical}\n", step.on_names(), step.name);
            hasher.update(line.as_bytes());
            // The same relative path refers to a different file in a different folder.
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

/// Returns the diagnostic with the location of a scope: the index of its text, and the calls that led to the scope.
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
