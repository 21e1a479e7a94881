//! The listener interface: receives the events of a run.

use std::time::Duration;

use op::{ErrorLocation, Progress, Refusal, Report};
use scene::{Digest, Scene};

use super::cache::{RerunReason, StepResult};
use crate::expect::ActualValue;
use crate::recipe::RecipeStep;
use ron_tree::Diagnostic;

/// Receives the events of a run. Steps are numbered from 0.
pub trait Listener: Progress {
    /// Called when a step begins.
    fn step_begins(&self, _number: usize, _label: &str) {}
    /// Called when a step is done.
    fn step_done(&self, _number: usize, _done: &StepDone) {}
    /// Whether the run computes the digest of the scene after each step, which is slow for large scenes.
    fn wants_digests(&self) -> bool {
        false
    }
    /// Whether the run calls [`scene_after`](Self::scene_after). If this method returns true, scenes are loaded from
    /// the cache even if no step needs them.
    fn wants_scenes(&self) -> bool {
        false
    }
    /// Called with the scene after each step if [`wants_scenes`](Self::wants_scenes) returns true. A clone of the scene
    /// shares its meshes with the run. As long as the clone exists, a step that changes a shared mesh first copies the
    /// mesh.
    fn scene_after(&self, _number: usize, _scene: &Scene) {}
    /// Called when a step fails or an expectation does not hold.
    fn failed(&self, _: &Failure) {}
    /// Whether the run searches for the elements that violate an expectation. The search takes time.
    fn wants_places(&self) -> bool {
        false
    }
}

/// A step that failed, or an expectation that does not hold.
#[derive(Clone, Copy, Debug)]
pub struct Failure<'a> {
    /// The error to report.
    pub diagnostic: &'a Diagnostic,
    /// The current scene. If the operation of a step failed, this is the scene before the step.
    pub scene: &'a Scene,
    /// The locations in the scene to which the failure refers, if any are known.
    pub places: &'a [ErrorLocation],
    /// The actual value, if it can replace the expected value in the recipe.
    pub found: Option<&'a ActualValue>,
}

/// A step that is done.
#[derive(Clone, Debug)]
pub struct StepDone {
    /// The label of the step.
    pub label: String,
    /// The report of the step.
    pub report: Report,
    /// The reason why the operation refused its input, if the recipe expects a refusal.
    pub refused: Option<Refusal>,
    /// The number of vertices of all meshes together after the step. Points of polylines are included.
    pub vertices: usize,
    /// The number of edges after the step.
    pub edges: usize,
    /// The number of faces after the step.
    pub faces: usize,
    /// The digest of the scene after the step, if the listener requests it.
    pub digest: Option<Digest>,
    /// How long the step took.
    pub time: Duration,
    /// Why the step ran. `None` if the result of the step was taken from the cache.
    pub ran: Option<RerunReason>,
}

impl StepDone {
    pub(super) fn new(
        step: &RecipeStep,
        result: StepResult,
        time: Duration,
        ran: Option<RerunReason>,
    ) -> Self {
        let [vertices, edges, faces] = result.counts;
        Self {
            label: step.label().to_owned(),
            report: result.report,
            refused: result.refused,
            vertices,
            edges,
            faces,
            digest: None,
            time,
            ran,
        }
    }
}

/// A listener that ignores all events and never cancels.
pub use op::NoProgress as Silent;

impl Listener for Silent {}
