//! The outcome of a run.

use std::path::PathBuf;

use scene::{Digest, Scene};

use super::listener::StepDone;
use crate::expect::ActualValue;
use ron_tree::Diagnostic;

/// The outcome of a run.
#[derive(Debug)]
pub struct Outcome {
    /// The index of the first step of the run.
    pub first: usize,
    /// The steps that were done.
    pub steps: Vec<StepDone>,
    /// The errors of the run. An error is a failed step, an expectation that does not hold, or outputs that cannot be
    /// written.
    pub failures: Vec<Diagnostic>,
    /// The expectations that do not hold.
    pub unmet: Vec<UnmetExpectation>,
    /// Whether the run was canceled.
    pub cancelled: bool,
    /// The number of expectations that were checked.
    pub checked: usize,
    /// The scene at the end. `None` if the scene was not needed and therefore not loaded from the cache, or if the
    /// scene could not be computed again.
    pub scene: Option<Scene>,
    /// The digest of the scene at the end.
    pub digest: Digest,
    /// The files that were written. If a file cannot be moved to the output folder, the run fails, and the list has the
    /// files that were moved before the failure.
    pub written: Vec<PathBuf>,
    /// The problem that prevents the cache from storing anything, if there is one.
    pub cache_problem: Option<String>,
    /// One line for each result that could not be stored in the cache or loaded from it, with the reason.
    pub cache_notes: Vec<String>,
}

/// An expectation that does not hold.
#[derive(Clone, Debug)]
pub struct UnmetExpectation {
    /// The index of the expectation in [`Recipe::expectations`](crate::Recipe::expectations).
    pub expectation: usize,
    /// The index of the error of this expectation in [`Outcome::failures`].
    pub failure: usize,
    /// The actual value, if it can replace the expected value in the recipe.
    pub found: Option<ActualValue>,
}

impl Outcome {
    /// Whether the run was not canceled and has no failures.
    pub fn succeeded(&self) -> bool {
        self.failures.is_empty() && !self.cancelled
    }
}
