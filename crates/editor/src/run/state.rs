//! The state of the current run: the results of its steps and expectations, its diagnostics and its progress.

use std::path::PathBuf;
use std::time::Duration;

use engine::{Diagnostic, Source};
use op::ErrorLocation;
use recipe::{Parameter, Span, StepForecast};
use scene::Digest;

use super::{Progress, Snapshot};

/// The state of the newest run.
#[derive(Clone, Debug, Default)]
pub struct RunState {
    /// The texts that diagnostics refer to: first the recipe, then the recipes that it calls.
    pub sources: Vec<Source>,
    /// The errors and warnings that were found while the recipe was read and checked, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
    /// The failures of the run: a failed step, and expectations that do not hold.
    pub failures: Vec<FailureState>,
    /// The steps of the run. Calls and repetitions are replaced by the steps that they contain.
    pub steps: Vec<StepState>,
    /// The expectations, in the order in which they are checked.
    pub expectations: Vec<ExpectationState>,
    /// The parameters of the recipe with their values.
    pub parameters: Vec<Parameter>,
    /// The files that the recipe reads.
    pub inputs: Vec<PathBuf>,
    /// The files, other than the recipe, on which the result depends. Each file has its stamp: a text that describes
    /// the state of the file when the recipe was read.
    pub(crate) watched: Vec<(PathBuf, String)>,
    /// The files that the run wrote. The list is empty if the request did not ask for outputs.
    pub written: Vec<PathBuf>,
    /// The digest of the final scene. The digest is known only after the run has ended.
    pub digest: Option<Digest>,
    /// The time that the last run took, including the time for reading and checking the recipe.
    pub time: Duration,
    /// The number of steps that ran. The other steps did not run, because their results were known.
    pub ran: usize,
    /// Whether the run is in progress.
    pub status: Status,
}

/// Whether a run is in progress, or how it ended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// The run is in progress.
    Running(Progress),
    /// The run has ended, or no run was requested. The [`RunState`] has its failures and diagnostics.
    #[default]
    Done,
    /// The run was canceled.
    Canceled,
}

/// A step of the run.
#[derive(Clone, Debug)]
pub struct StepState {
    /// The label of the step: the calls and repetitions that contain the step, and then the id of the step or, if the
    /// step has no id, the name of its operation.
    pub label: String,
    /// The name of the operation.
    pub name: String,
    /// The index of the entry from which the step comes. The index refers to the list `steps` in the recipe's text. All
    /// steps inside the same call or repetition have the same index.
    pub item: usize,
    /// The text that `span` refers to, as an index into [`RunState::sources`].
    pub source: usize,
    /// The range of the text in which the name of the operation is written.
    pub span: Span,
    /// The predicted numbers of elements and the predicted memory after the step.
    pub forecast: Option<StepForecast>,
    /// The result, once it is known.
    pub result: Option<Snapshot>,
}

/// An expectation of the run.
#[derive(Clone, Debug)]
pub struct ExpectationState {
    /// The text that `span` refers to, as an index into [`RunState::sources`].
    pub source: usize,
    /// The span of the expectation.
    pub span: Span,
    /// The index of the step after which the expectation is checked. `None` if it is checked at the end of the run.
    pub after: Option<usize>,
    /// The result of the expectation. `None` if it is not known yet.
    pub verdict: Option<Verdict>,
}

/// The result of an expectation.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The expectation holds.
    Holds,
    /// The expectation does not hold.
    Fails {
        /// The reason why the expectation does not hold, with the actual value.
        message: String,
        /// The places in the scene that violate the expectation.
        places: Vec<ErrorLocation>,
    },
}

/// A failure of the run.
#[derive(Clone, Debug)]
pub struct FailureState {
    /// The error with its span.
    pub diagnostic: Diagnostic,
    /// The places in the scene that the failure is about. If a step has failed, these are places in the scene before
    /// the step.
    pub places: Vec<ErrorLocation>,
    /// The index of the step that has failed, or of the step after which an expectation does not hold. `None` for a
    /// failure at the end of the run, such as an expectation about the final scene that does not hold.
    pub step: Option<usize>,
}

impl RunState {
    /// Whether the recipe has errors, a step failed, or an expectation does not hold.
    pub fn has_failed(&self) -> bool {
        !self.failures.is_empty() || self.has_errors()
    }

    /// Whether errors were found in the recipe before it ran.
    pub(crate) fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// Whether the run is in progress.
    pub fn is_running(&self) -> bool {
        matches!(self.status, Status::Running(_))
    }

    /// Returns those steps of the run that come from the entry `item` of the recipe's list `steps`. The result is a
    /// range of indices. The range is empty if no steps come from the entry, for example because it is disabled.
    pub fn steps_of(&self, item: usize) -> std::ops::Range<usize> {
        let start = self.steps.partition_point(|step| step.item < item);
        start..self.steps.partition_point(|step| step.item <= item)
    }

    /// Looks at the steps of the run that come from the first `n` entries of the recipe's list `steps`. Returns the
    /// result of the last of these steps before the first step whose result is not known; `None` if there is no such
    /// step. Also returns whether the results of all these steps are known.
    pub(crate) fn result_after(&self, n: usize) -> (Option<&Snapshot>, bool) {
        let end = self.steps.partition_point(|step| step.item < n);
        let steps = &self.steps[..end];
        let known = steps
            .iter()
            .take_while(|step| step.result.is_some())
            .count();
        let last = known.checked_sub(1).and_then(|i| steps[i].result.as_ref());
        (last, known == end)
    }
}

/// A message of the thread.
#[derive(Debug)]
pub(crate) enum Event {
    /// The recipe was read and checked.
    Checked { number: u64, state: Box<RunState> },
    /// A step has a result.
    Step {
        number: u64,
        step: usize,
        result: Snapshot,
    },
    /// The run has ended.
    Done { number: u64, end: Box<End> },
    /// The engine panicked while it read or checked the recipe.
    Panicked { number: u64 },
    /// One of the watched files has changed.
    FilesChanged,
}

/// The end of a run.
#[derive(Debug)]
pub(crate) struct End {
    pub(crate) canceled: bool,
    pub(crate) failures: Vec<FailureState>,
    /// The results of the expectations, in the order of the expectations.
    pub(crate) verdicts: Vec<Option<Verdict>>,
    pub(crate) digest: Option<Digest>,
    pub(crate) written: Vec<PathBuf>,
    pub(crate) time: Duration,
    pub(crate) ran: usize,
}

impl Event {
    /// If the event is about a request, returns the number of this request.
    pub(crate) fn number(&self) -> Option<u64> {
        match self {
            Self::FilesChanged => None,
            Self::Checked { number, .. }
            | Self::Step { number, .. }
            | Self::Done { number, .. }
            | Self::Panicked { number } => Some(*number),
        }
    }
}
