//! What is known about the current run: its steps, expectations, diagnostics and progress.

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
    /// The errors and warnings from reading and checking, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
    /// The failures of the run: a failed step, and expectations that do not hold.
    pub failures: Vec<FailureState>,
    /// The steps, after calls and repetitions were replaced by their steps.
    pub steps: Vec<StepState>,
    /// The expectations, in the order in which they are checked.
    pub expectations: Vec<ExpectationState>,
    /// The parameters of the recipe with their values.
    pub parameters: Vec<Parameter>,
    /// The files that the recipe reads.
    pub inputs: Vec<PathBuf>,
    /// The files besides the recipe that the result depends on, with their stamps when the recipe was read.
    pub(crate) watched: Vec<(PathBuf, String)>,
    /// The files that the run wrote. Empty unless outputs were requested.
    pub written: Vec<PathBuf>,
    /// The digest of the final scene, once the run has ended.
    pub digest: Option<Digest>,
    /// How long the last run took, including reading and checking.
    pub time: Duration,
    /// The number of steps that ran. The results of the other steps were known.
    pub ran: usize,
    /// Whether the run is in progress.
    pub status: Status,
}

/// Whether a run is in progress, or how it ended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// The run is in progress.
    Running(Progress),
    /// The run has ended, or no run was requested. Failures and diagnostics are in the [`RunState`].
    #[default]
    Done,
    /// The run was canceled.
    Canceled,
}

/// A step of the run.
#[derive(Clone, Debug)]
pub struct StepState {
    /// The label: the id or, if the step has no id, the name of the operation, with the calls and repetitions around
    /// it.
    pub label: String,
    /// The name of the operation.
    pub name: String,
    /// The index of the step in the list `steps` of the text. All steps of a call or repetition have the same index.
    pub item: usize,
    /// The index in [`RunState::sources`] of the text that `span` refers to.
    pub source: usize,
    /// The span of the name of the operation.
    pub span: Span,
    /// The forecast of the counts and the memory after the step.
    pub forecast: Option<StepForecast>,
    /// The result, once it is known.
    pub result: Option<Snapshot>,
}

/// An expectation of the run.
#[derive(Clone, Debug)]
pub struct ExpectationState {
    /// The index in [`RunState::sources`] of the text that `span` refers to.
    pub source: usize,
    /// The span of the expectation.
    pub span: Span,
    /// The index of the step after which the expectation is checked; `None` for the end.
    pub after: Option<usize>,
    /// The result; `None` if it is not known yet.
    pub verdict: Option<Verdict>,
}

/// The result of an expectation.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The expectation holds.
    Holds,
    /// The expectation does not hold.
    Fails {
        /// The reason, with the actual value.
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
    /// The places in the scene that the failure is about. For a failed step, these are places in the scene before the
    /// step.
    pub places: Vec<ErrorLocation>,
    /// The index of the step that failed, or after which an expectation does not hold. `None` for the end.
    pub step: Option<usize>,
}

impl RunState {
    /// Whether the recipe has errors, a step failed, or an expectation does not hold.
    pub fn has_failed(&self) -> bool {
        !self.failures.is_empty() || self.has_errors()
    }

    /// Whether the recipe has errors that were found before it ran.
    pub(crate) fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// Whether the run is in progress.
    pub fn is_running(&self) -> bool {
        matches!(self.status, Status::Running(_))
    }

    /// Returns the steps of an item of the list `steps`, as a range of indices. Empty if the item has no steps, such as
    /// a disabled step.
    pub fn steps_of(&self, item: usize) -> std::ops::Range<usize> {
        let start = self.steps.partition_point(|step| step.item < item);
        start..self.steps.partition_point(|step| step.item <= item)
    }

    /// Returns the last known result among the steps of the first `n` items, and whether it is the result of the last
    /// of these steps. `None` if no step has a result.
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
    /// The results of the expectations, by index.
    pub(crate) verdicts: Vec<Option<Verdict>>,
    pub(crate) digest: Option<Digest>,
    pub(crate) written: Vec<PathBuf>,
    pub(crate) time: Duration,
    pub(crate) ran: usize,
}

impl Event {
    /// Returns the number of the request that the event is about, if it is about a request.
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
