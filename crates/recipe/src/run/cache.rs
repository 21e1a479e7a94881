//! The interface between a run and a step cache. The cache decides how results are stored.

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use op::{FileUse, Files, Refusal, Report};
use scene::{Digest, Scene};
use serde::{Deserialize, Serialize};

use crate::recipe::{RecipeExpectation, RecipeStep};

/// A step cache, set up for runs of one recipe.
pub trait StepCache: fmt::Debug + Sync {
    /// Starts a run.
    fn begin(&self) -> Box<dyn CachedRun + '_>;
}

/// A run with a cache: looks up steps, stores the results of steps that ran, and loads scenes. For each step,
/// [`run`](crate::run()) calls [`look_up`](Self::look_up). If the lookup fails, [`run`](crate::run()) runs the step and
/// calls [`record_step`](Self::record_step).
pub trait CachedRun {
    /// Looks up the next step. If `stage` is given, the files that the step wrote are restored into this folder, which
    /// collects the outputs of the run until it succeeds.
    ///
    /// # Errors
    ///
    /// The reason why the step must run.
    fn look_up(
        &mut self,
        step: &RecipeStep,
        budget: u64,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<StepResult, RerunReason>;

    /// Stores the result of step `number` (counted from 1), which was not in the cache.
    fn record_step(&mut self, number: usize, label: &str, files: &Files, done: &CompletedStep);

    /// Records that step `number` (counted from 1) ran again because the scene after this step was needed. Returns the
    /// reason why that scene was not in the cache.
    fn record_rerun(
        &mut self,
        number: usize,
        label: &str,
        scene: &Scene,
        time: Duration,
    ) -> RerunReason;

    /// Loads the latest stored scene among the scenes after the steps `from + 1` to `to`, counted from 1. Returns the
    /// number of steps before this scene, and the scene.
    fn load_scene(&mut self, from: usize, to: usize) -> Option<(usize, Scene)>;

    /// Whether the step with this index (counted from 0) leaves the scene unchanged.
    fn keeps_scene(&self, index: usize) -> bool;

    /// Whether an expectation is known to hold for the current scene.
    fn is_known_to_hold(&mut self, placed: &RecipeExpectation, files: &Files) -> bool;

    /// Records that an expectation holds for the current scene.
    fn record_met_expectation(&mut self, placed: &RecipeExpectation, uses: &[FileUse]);

    /// Returns the digest of the current scene, if it is known.
    fn digest(&self) -> Option<Digest>;

    /// Records the digest of the current scene.
    fn set_digest(&mut self, digest: Digest);

    /// Whether the final scene must be available even if no step needs it.
    fn wants_scene(&self) -> bool;

    /// Writes what has been recorded about the last step to the cache.
    fn flush(&mut self);

    /// Ends the run. The first returned value is the problem that prevents the cache from storing anything, if there is
    /// one. The second value has one line for each result that was not stored or could not be loaded.
    fn finish(self: Box<Self>) -> (Option<String>, Vec<String>);
}

/// The result of a step that a cache stores.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct StepResult {
    /// The report of the step.
    pub report: Report,
    /// The reason why the step was refused, if the recipe expects a refusal.
    pub refused: Option<Refusal>,
    /// The numbers of vertices, edges and faces of all meshes together.
    pub counts: [usize; 3],
}

/// A step that has just run.
#[derive(Clone, Debug)]
pub struct CompletedStep<'a> {
    /// The result to store.
    pub result: &'a StepResult,
    /// The scene after the step.
    pub scene: &'a Scene,
    /// Whether the step is known to have left the scene unchanged.
    pub keeps_scene: bool,
    /// How long the step took.
    pub time: Duration,
    /// The file accesses of the step.
    pub uses: &'a [FileUse],
    /// The files that the step has written, relative to `stage`.
    pub written: Vec<PathBuf>,
    /// The folder that holds the outputs until the run succeeds, if the recipe writes files.
    pub stage: Option<&'a Path>,
}

/// Why a step ran. The displayed text is a clause that can follow "because".
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RerunReason {
    /// No cache is used.
    #[error("no cache is used")]
    NoCache,
    /// The cache has no record of an earlier run of this step.
    #[error("it has not run before")]
    New,
    /// The program has a different version, or is a different build of the same version.
    #[error("the program is a different version or build")]
    Program,
    /// The version of the operation changed.
    #[error("the version of the operation changed: {from} -> {to}")]
    Version {
        /// The version in the last run.
        from: u32,
        /// The current version.
        to: u32,
    },
    /// Parameters changed: a list of their names with the old and the new values.
    #[error("parameters changed: {0}")]
    Parameters(String),
    /// The list of objects in `on` changed.
    #[error("`on` changed")]
    On,
    /// The id changed, and the id seeds the random choices of the step.
    #[error("its id changed, and the id seeds random choices")]
    Id,
    /// The expected refusal changed.
    #[error("`refused` changed")]
    Refused,
    /// The memory budget changed.
    #[error("the memory budget changed")]
    Budget,
    /// The paths of the step's input files now refer to a different folder.
    #[error("it reads from a different folder")]
    Folder,
    /// An input file changed.
    #[error("the file {} {}", .0.display(), .1)]
    File(PathBuf, FileChange),
    /// The recipe or its parameters changed, and the output files of the step record them.
    #[error("the recipe changed, and the output files record which recipe wrote them")]
    Provenance,
    /// The names of the step's output files changed.
    #[error("the names of its output files changed")]
    Outputs,
    /// An earlier step ran: its number (counted from 1) and its label.
    #[error("step {0} {1} ran again")]
    Earlier(usize, String),
    /// The earlier steps are not the same as in the last run.
    #[error("earlier steps changed")]
    Order,
    /// The result of the step was removed from the cache.
    #[error("its result is no longer in the cache")]
    Gone,
    /// The result in the cache is damaged, for this reason.
    #[error("its result in the cache is damaged: {0}")]
    Damaged(String),
    /// The result was not stored, because computing it took less time than storing it would have taken, or because a
    /// mesh of the scene contains removed elements.
    #[error(
        "its result was not stored: it is faster to compute than to store, or a mesh contains removed elements"
    )]
    NotKept,
    /// The input files of the step could not be determined: a path and the reason.
    #[error("its input files cannot be determined ({}: {})", .0.display(), .1)]
    Unknown(PathBuf, String),
    /// The scene before the step cannot be identified, because the input files of an earlier step could not be
    /// determined and that step left removed elements in a mesh.
    #[error(
        "the input files of an earlier step cannot be determined, and that step left removed elements in a mesh"
    )]
    NoState,
}

/// How an input file changed since the last run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileChange {
    /// The content of the file changed.
    #[error("changed")]
    Changed,
    /// The file no longer exists.
    #[error("no longer exists")]
    Gone,
    /// The file did not exist in the last run.
    #[error("did not exist before")]
    Appeared,
}
