//! Who follows a run, and what they hear.

use std::time::Duration;

use op::{ErrorLocation, Progress, Refusal, Report};
use scene::{Digest, Scene};

use super::cache::{Finding, RerunReason};
use crate::expect::ActualValue;
use crate::recipe::RecipeStep;
use ron_tree::Diagnostic;

/// Follows a run.
pub trait Listener: Progress {
    /// A step begins.
    fn step_begins(&self, _number: usize, _label: &str) {}
    /// A step is done.
    fn step_done(&self, _number: usize, _done: &StepDone) {}
    /// Whether to tell the digest of the scene after each step, which takes a while for large ones.
    fn wants_digests(&self) -> bool {
        false
    }
    /// Whether to show the scene after each step, for which scenes are brought back from the cache.
    fn wants_scenes(&self) -> bool {
        false
    }
    /// The scene after a step, if it is wanted. A copy shares the meshes; the next step that changes one of them
    /// copies it then.
    fn scene_after(&self, _number: usize, _scene: &Scene) {}
    /// A step or an expectation has failed.
    fn failed(&self, _: &Failure) {}
    /// Whether to find the scene and the elements that break an expectation, which takes a while.
    fn wants_places(&self) -> bool {
        false
    }
}

/// A step that failed, or an expectation that does not hold.
#[derive(Clone, Copy, Debug)]
pub struct Failure<'a> {
    /// What is told of it.
    pub diagnostic: &'a Diagnostic,
    /// The scene at that time; before a step that failed.
    pub scene: &'a Scene,
    /// The places in the scene that it is about, if any are known.
    pub places: &'a [ErrorLocation],
    /// What was found in place of a value that an expectation records.
    pub found: Option<&'a ActualValue>,
}

/// What a step left behind.
#[derive(Clone, Debug)]
pub struct StepDone {
    /// The step's id or operation.
    pub label: String,
    /// What it did.
    pub report: Report,
    /// The reason for which it was refused, as the recipe says it must be.
    pub refused: Option<Refusal>,
    /// The vertices of all meshes together, after it; points of polylines count too.
    pub vertices: usize,
    /// The edges.
    pub edges: usize,
    /// The faces.
    pub faces: usize,
    /// The digest of the scene after it, if the listener wants it.
    pub digest: Option<Digest>,
    /// How long it took.
    pub time: Duration,
    /// Why it ran; `None` if its result was taken from the cache.
    pub ran: Option<RerunReason>,
}

impl StepDone {
    pub(super) fn new(
        step: &RecipeStep,
        what: Finding,
        time: Duration,
        ran: Option<RerunReason>,
    ) -> Self {
        let [vertices, edges, faces] = what.counts;
        Self {
            label: step.label().to_owned(),
            report: what.report,
            refused: what.refused,
            vertices,
            edges,
            faces,
            digest: None,
            time,
            ran,
        }
    }
}

/// Follows nothing and never stops.
pub use op::NoProgress as Silent;

impl Listener for Silent {}
