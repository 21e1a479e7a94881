//! How a run ended.

use std::path::PathBuf;

use scene::{Digest, Scene};

use super::listener::StepDone;
use crate::expect::ActualValue;
use ron_tree::Diagnostic;

/// How a run ended.
#[derive(Debug)]
pub struct Outcome {
    /// The number of the step that the run began with.
    pub first: usize,
    /// The steps that were done.
    pub steps: Vec<StepDone>,
    /// What went wrong: one failed step, or expectations that do not hold.
    pub failures: Vec<Diagnostic>,
    /// The expectations that do not hold.
    pub unmet: Vec<UnmetExpectation>,
    /// Whether the run was cancelled.
    pub cancelled: bool,
    /// How many expectations were held against the scene.
    pub checked: usize,
    /// The scene at the end; `None` only if it stayed in the cache because nobody wanted it.
    pub scene: Option<Scene>,
    /// The digest of the scene at the end.
    pub digest: Digest,
    /// The files that were written.
    pub written: Vec<PathBuf>,
    /// Why nothing can be stored in the cache any more, if that is so.
    pub cache_problem: Option<String>,
    /// What was not stored in the cache, and why, and what was not found there, each one line.
    pub cache_notes: Vec<String>,
}

/// An expectation that does not hold.
#[derive(Clone, Debug)]
pub struct UnmetExpectation {
    /// Its place in [`Recipe::expectations`](crate::Recipe::expectations).
    pub expectation: usize,
    /// The place of what is told of it in [`Outcome::failures`].
    pub failure: usize,
    /// What was found, if a value that it records is another one.
    pub found: Option<ActualValue>,
}

impl Outcome {
    /// Whether every step was done and every expectation holds.
    pub fn succeeded(&self) -> bool {
        self.failures.is_empty() && !self.cancelled
    }
}
