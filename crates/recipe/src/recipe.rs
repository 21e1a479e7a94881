//! What a recipe says, once it is read: a list of steps, whatever calls and repetitions they came from.

use std::path::Path;
use std::sync::Arc;

use op::{Files, Loss, Refusal, Step};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::expect::Expectation;
use crate::params::Param;
use crate::source::Source;
use ron_tree::{Diagnostic, Span, Value};

/// The most steps that calls and repetitions may become.
pub const MAX_STEPS: usize = 100_000;

/// A recipe that was read, as far as it could be.
#[derive(Debug)]
pub struct Recipe {
    /// What the recipe says of itself.
    pub about: Option<String>,
    /// The texts that spans point into: its own first, then those of the recipes that it calls.
    pub sources: Vec<Source>,
    /// The parameters that steps were filled in with: its own first, then those of each call.
    pub scopes: Vec<Scope>,
    /// The names of its presets.
    pub presets: Vec<String>,
    /// Its steps in the order in which they run: calls, repetitions and choices are done.
    pub steps: Vec<RecipeStep>,
    /// What must hold, in the order of the steps that it comes after.
    pub expectations: Vec<RecipeExpectation>,
}

/// A text with values for its parameters: the recipe itself, or one call of another.
#[derive(Clone, Debug)]
pub struct Scope {
    /// The text, by its place in [`Recipe::sources`].
    pub source: usize,
    /// The parameters with their values.
    pub parameters: Vec<Parameter>,
    /// Where the call stands: its scope, and its place in the text of that. `None` for the recipe itself.
    pub called: Option<(usize, Span)>,
}

/// A parameter with its value.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its declaration.
    pub param: Param,
    /// Its value.
    pub value: Value,
    /// Where the value comes from.
    pub origin: Origin,
}

/// Where the value of a parameter comes from. The later ones go before the earlier ones.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The recipe's default.
    Default,
    /// The preset of this name.
    Preset(String),
    /// `with:` of the step that calls the recipe.
    Call,
    /// The command line, or another program's choice.
    Set,
}

impl Parameter {
    /// Whether the value was chosen from outside the recipe.
    pub fn is_set(&self) -> bool {
        matches!(self.origin, Origin::Set | Origin::Preset(_))
    }

    /// The value as plain text, as the command line takes it: texts stand without quotes.
    pub fn plain_text(&self) -> String {
        let text = self.value.as_str().map(str::to_owned);
        text.unwrap_or_else(|| self.value.to_string())
    }
}

/// What happens when a step loses something: an attribute that it cannot carry, or what a file cannot
/// hold.
#[derive(Clone, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum OnLoss {
    /// The loss is listed.
    #[default]
    Warn,
    /// The run fails.
    Error,
    /// What has one of these names may be lost; any other loss fails the run.
    Allow(Vec<String>),
}

impl OnLoss {
    /// Whether something of this name may be lost.
    pub fn allows(&self, name: &str) -> bool {
        match self {
            Self::Warn => true,
            Self::Error => false,
            Self::Allow(names) => names.iter().any(|n| n == name),
        }
    }

    /// The first loss that is not allowed.
    pub fn forbidden<'l>(&self, losses: &'l [Loss]) -> Option<&'l Loss> {
        losses.iter().find(|loss| !self.allows(&loss.name))
    }
}

/// A step that holds steps.
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
    /// The name that later parts of its text know it by.
    pub id: Option<String>,
    /// The name that its operation has now, or as written if there is none of that name.
    pub name: String,
    /// The name to show, which also keys its random choices: the id or else the operation, behind the
    /// calls and before the turns of the repetitions that it stands in, as in `clean/Weld#2`.
    pub label: String,
    /// The operation; `None` if the step could not be read.
    pub step: Option<Arc<dyn Step>>,
    /// The objects it was told to act on, with their places in the text.
    pub on: Option<Vec<(String, Span)>>,
    /// The reason for which it must be refused.
    pub refused: Option<Refusal>,
    /// What may be lost.
    pub on_loss: OnLoss,
    /// Its parameters and its text, by their place in [`Recipe::scopes`].
    pub scope: usize,
    /// The place of the name of the operation.
    pub span: Span,
    /// The operation as written, parameters filled in.
    pub value: Value,
    /// The turn of each repetition around it, from 1, from the outside in.
    pub(crate) turns: Vec<u32>,
    /// The label without its turns.
    pub(crate) stem: String,
}

impl RecipeStep {
    /// The name to show.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// The objects it was told to act on.
    pub fn on_names(&self) -> Option<Vec<String>> {
        self.on
            .as_ref()
            .map(|on| on.iter().map(|(name, _)| name.clone()).collect())
    }

    /// The same step in a turn of a repetition around all that it stands in so far.
    pub(crate) fn in_turn(mut self, turn: u32) -> Self {
        self.turns.insert(0, turn);
        let turns: Vec<String> = self.turns.iter().map(u32::to_string).collect();
        self.label = format!("{}#{}", self.stem, turns.join("."));
        self
    }
}

/// An expectation and where it belongs.
#[derive(Clone, Debug)]
pub struct RecipeExpectation {
    /// The step after which it must hold, by its place in the list; at the end if `None`.
    pub after: Option<usize>,
    /// The objects that are meant; all if `None`.
    pub on: Option<Vec<String>>,
    /// What must hold.
    pub that: Expectation,
    /// Its text, by its place in [`Recipe::scopes`].
    pub scope: usize,
    /// Its place in the text.
    pub span: Span,
}

impl Recipe {
    /// The parameters of the recipe itself.
    pub fn parameters(&self) -> &[Parameter] {
        self.scopes.first().map_or(&[], |scope| &scope.parameters)
    }

    /// The texts that stand for placeholders in output paths of the recipe itself: `{name.stem}` and
    /// `{name.name}` for each parameter that is a path.
    pub fn placeholders(&self) -> Vec<(String, String)> {
        self.scopes
            .first()
            .map(Scope::placeholders)
            .unwrap_or_default()
    }

    /// The folders of each scope: `files` for the recipe itself; a recipe that is called reads from its own
    /// folder, and has its own placeholders.
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

    /// Whether files that it writes are held against others.
    pub(crate) fn checks_outputs(&self) -> bool {
        self.expectations
            .iter()
            .any(|placed| placed.that.output().is_some())
    }

    /// The text of a scope, by its place in [`Recipe::sources`].
    pub fn source_of(&self, scope: usize) -> usize {
        self.scopes.get(scope).map_or(0, |scope| scope.source)
    }

    /// A diagnostic about something in a scope, with its text and the calls that led there.
    pub fn located(&self, diagnostic: Diagnostic, scope: usize) -> Diagnostic {
        located(diagnostic, scope, &self.scopes)
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
            // A step without an id had none here before labels held more.
            let id = (step.label != step.name).then_some(&step.label);
            let line = format!("{id:?} {:?} {} {canonical}\n", step.on_names(), step.name);
            hasher.update(line.as_bytes());
            // The same path means another file in another folder.
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

/// The diagnostic with its text, and the calls that led there.
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
}
