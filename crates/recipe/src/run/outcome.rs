//! The outcome of a run.

use std::path::PathBuf;

use scene::{Digest, Scene};

use super::listener::StepDone;
use crate::expect::ActualValue;
use ron_tree::Diagnostic;

/// The outcome of a run.
#[derive(Debug)]
pub struct Outcome {
    /// The index of the step that the run started with.
    pub first: usize,
    /// The steps that were done.
    pub steps: Vec<StepDone>,
    /// The errors: a failed step, expectations that do not hold, or outputs that cannot be written.
    pub failures: Vec<Diagnostic>,
    /// The expectations that do not hold.
    pub unmet: Vec<UnmetExpectation>,
    /// Whether the run was canceled.
    pub cancelled: bool,
    /// The number of expectations that were checked.
    pub checked: usize,
    /// The scene at the end. `None` if the scene was not needed and therefore not loaded from the cache, or if it could
    /// not be recomputed.
    pub scene: Option<Scene>,
    /// The digest of the scene at the end.
    pub digest: Digest,
    /// The files that were written. If a file cannot be moved to the output folder, the run fails and this list has the
    /// files that were moved before that file.
    pub written: Vec<PathBuf>,
    /// The problem that prevents the cache from storing anything, if any.
    pub cache_problem: Option<String>,
    /// One line for each result that was not stored in the cache or could not be loaded from it, with the reason.
    pub cache_notes: Vec<String>,
}

/// An expectation that does not hold.
#[derive(Clone, Debug)]
pub struct UnmetExpectation {
    /// The index of the expectation in [`Recipe::expectations`](crate::Recipe::expectations).
    pub expectation: usize,
    /// The index of the expectation's error in [`Outcome::failures`].
    pub failure: usize,
    /// The actual value, if the recipe can be updated with it.
    pub found: Option<ActualValue>,
}

impl Outcome {
    /// Whether the run has no failures and was not canceled.
    pub fn succeeded(&self) -> bool {
        self.failures.is_empty() && !self.cancelled
    }
}
