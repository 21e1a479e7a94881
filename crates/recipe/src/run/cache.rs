//! The interface between a run and a step cache. The cache decides how to store results.

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use op::{FileUse, Files, Refusal, Report};
use scene::{Digest, Scene};
use serde::{Deserialize, Serialize};

use crate::recipe::{RecipeExpectation, RecipeStep};

/// A step cache, set up for the runs of one recipe. The cache stores the results of steps.
pub trait StepCache: fmt::Debug + Sync {
    /// Starts a run that uses this cache.
    fn begin(&self) -> Box<dyn CachedRun + '_>;
}

/// A run that uses a step cache. The run looks up steps, stores the results of steps that ran, and loads scenes. For
/// each step, [`run`](crate::run()) calls [`look_up`](Self::look_up). If the lookup finds no result,
/// [`run`](crate::run()) runs the step and calls [`record_step`](Self::record_step).
pub trait CachedRun {
    /// Looks up the next step. `stage` is the temporary folder that collects the outputs until the run succeeds. If
    /// `stage` is given, the files that the step wrote in an earlier run are restored into this folder.
    ///
    /// # Errors
    ///
    /// Returns the reason why the step must run.
    fn look_up(
        &mut self,
        step: &RecipeStep,
        budget: u64,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<StepResult, RerunReason>;

    /// Stores the result of the step with this number. The cache did not have this result. Steps are counted from 1.
    fn record_step(&mut self, number: usize, label: &str, files: &Files, done: &CompletedStep);

    /// Records that the step number `number` ran again because the scene after it was needed. Steps are counted from 1.
    /// Returns the reason why the cache did not have this scene.
    fn record_rerun(
        &mut self,
        number: usize,
        label: &str,
        scene: &Scene,
        time: Duration,
    ) -> RerunReason;

    /// Loads the latest stored scene that results from one of the steps `from + 1` to `to` (counted from 1). Returns
    /// the number of this step, and the scene. Returns `None` if no such scene can be loaded.
    fn load_scene(&mut self, from: usize, to: usize) -> Option<(usize, Scene)>;

    /// Whether the step with the index `index` leaves the scene unchanged. Indices start at 0.
    fn keeps_scene(&self, index: usize) -> bool;

    /// Whether the cache has a record that an expectation holds for the current scene. If the cache has this record,
    /// the expectation is not checked again.
    fn is_known_to_hold(&mut self, placed: &RecipeExpectation, files: &Files) -> bool;

    /// Records that an expectation holds for the current scene.
    fn record_met_expectation(&mut self, placed: &RecipeExpectation, uses: &[FileUse]);

    /// Returns the digest of the current scene, if it is known.
    fn digest(&self) -> Option<Digest>;

    /// Records the digest of the current scene.
    fn set_digest(&mut self, digest: Digest);

    /// Whether the cache needs the scene at the end of the run, even if no step or expectation needs it.
    fn wants_scene(&self) -> bool;

    /// Writes everything that was recorded about the last step to the cache.
    fn flush(&mut self);

    /// Ends the run. The first returned value is the problem that prevents the cache from storing anything, or `None`.
    /// The second returned value has one line for each result that could not be stored or loaded.
    fn finish(self: Box<Self>) -> (Option<String>, Vec<String>);
}

/// The result of a step, in the form in which a cache stores it.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct StepResult {
    /// The report of the step.
    pub report: Report,
    /// The reason why the operation refused its input, if the recipe expects a refusal.
    pub refused: Option<Refusal>,
    /// The number of vertices, of edges, and of faces of all meshes together.
    pub counts: [usize; 3],
}

/// A step that has just run.
#[derive(Clone, Debug)]
pub struct CompletedStep<'a> {
    /// The result to store.
    pub result: &'a StepResult,
    /// The scene after the step.
    pub scene: &'a Scene,
    /// Whether it is known that the step left the scene unchanged.
    pub keeps_scene: bool,
    /// How long the step took.
    pub time: Duration,
    /// The file accesses of the step.
    pub uses: &'a [FileUse],
    /// The files that the step wrote, as paths relative to `stage`.
    pub written: Vec<PathBuf>,
    /// The temporary folder that holds the outputs until the run succeeds. `None` if the recipe writes no files.
    pub stage: Option<&'a Path>,
}

/// Why a step ran. As text, the reason is a clause that can follow "because".
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RerunReason {
    /// No cache is used.
    #[error("no cache is used")]
    NoCache,
    /// The cache has no record of an earlier run of this step.
    #[error("the step has not run before")]
    New,
    /// The program has another version than in the last run, or is another build of the same version.
    #[error("the last run used a different version or build of the program")]
    Program,
    /// The version of the operation changed.
    #[error("the version of the operation changed: {from} -> {to}")]
    Version {
        /// The version in the last run.
        from: u32,
        /// The current version.
        to: u32,
    },
    /// Parameters changed. The text lists their names, with the old and the new values.
    #[error("parameters changed: {0}")]
    Parameters(String),
    /// The list of objects in `on` changed.
    #[error("`on` changed")]
    On,
    /// The id changed, and the id seeds the random choices of the step.
    #[error("the id of the step changed, and random choices depend on the id")]
    Id,
    /// The field `refused:` of the step, which names the expected refusal, changed.
    #[error("`refused` changed")]
    Refused,
    /// The memory budget changed.
    #[error("the memory budget changed")]
    Budget,
    /// The paths of the input files are now relative to another folder.
    #[error("file paths in the step are now relative to a different folder")]
    Folder,
    /// An input file changed.
    #[error("the file {} {}", .0.display(), .1)]
    File(PathBuf, FileChange),
    /// The recipe or its parameters changed. The output files of the step record both, so the step must write the files
    /// again.
    #[error(
        "the step's output files record the recipe and its parameters, and one of these changed"
    )]
    Provenance,
    /// The step now writes output files with different names.
    #[error("the names of the step's output files changed")]
    Outputs,
    /// An earlier step ran again. The values are its number, counted from 1, and its label.
    #[error("the earlier step {0} {1} ran again")]
    Earlier(usize, String),
    /// The earlier steps are not the same steps as in the last run.
    #[error("earlier steps changed")]
    Order,
    /// The result of the step was removed from the cache.
    #[error("the result of the step is no longer in the cache")]
    Gone,
    /// The result in the cache is damaged. The text gives the reason.
    #[error("the cached result of the step is damaged: {0}")]
    Damaged(String),
    /// The result was not stored. Computing the result took less time than storing it would have taken, or a mesh of
    /// the scene contains removed elements.
    #[error(
        "the result of the step was not stored: storing it would have taken longer than computing it, or a mesh contains removed elements"
    )]
    NotKept,
    /// The input files of the step could not be determined. The values are a path and the reason.
    #[error("the input files of the step cannot be determined ({}: {})", .0.display(), .1)]
    Unknown(PathBuf, String),
    /// The scene before the step cannot be identified. The input files of an earlier step are not known, and after that
    /// step, a mesh contained removed elements.
    #[error(
        "the scene before the step cannot be identified: the input files of an earlier step are unknown, and after that step, a mesh contained removed elements"
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
    /// The file exists now but did not exist in the last run.
    #[error("did not exist before")]
    Appeared,
}
