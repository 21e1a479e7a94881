//! What a run asks of a cache of steps. How results are stored is the business of the cache.

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use op::{FileUse, Files, Refusal, Report};
use scene::{Digest, Scene};
use serde::{Deserialize, Serialize};

use crate::recipe::{RecipeExpectation, RecipeStep};

/// A cache of steps, set up for runs of one recipe.
pub trait StepCache: fmt::Debug + Sync {
    /// Begins a run.
    fn begin(&self) -> Box<dyn CachedRun + '_>;
}

/// A run with a cache: looks steps up, stores what ran, and brings scenes back. The run calls either
/// [`find`](Self::find) for a step, or after an error of that [`ran`](Self::ran) too.
pub trait CachedRun {
    /// Looks the next step up. What it has written is put below `stage`, if there is one.
    ///
    /// # Errors
    ///
    /// Why the step must run.
    fn find(
        &mut self,
        step: &RecipeStep,
        budget: u64,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<Finding, RerunReason>;

    /// Keeps what step `number`, counted from 1, has done, which was not found.
    fn ran(&mut self, number: usize, label: &str, files: &Files, done: &Done);

    /// Takes note that the step that leads to a place ran once more for its scene, and says why.
    fn ran_again(
        &mut self,
        place: usize,
        label: &str,
        scene: &Scene,
        time: Duration,
    ) -> RerunReason;

    /// The last place from `from` up to `to` at which the scene can be brought back, and that scene.
    fn bring(&mut self, from: usize, to: usize) -> Option<(usize, Scene)>;

    /// Whether the step behind a place leaves the scene as it was.
    fn is_same(&self, place: usize) -> bool;

    /// Whether an expectation is known to hold for the current scene.
    fn holds(&mut self, placed: &RecipeExpectation, files: &Files) -> bool;

    /// Takes note that an expectation holds for the current scene.
    fn held(&mut self, placed: &RecipeExpectation, uses: &[FileUse]);

    /// The digest of the current scene, if it is known.
    fn digest(&self) -> Option<Digest>;

    /// Takes note of the digest of the current scene.
    fn set_digest(&mut self, digest: Digest);

    /// Whether the scene at the end is wanted even where no step needs it.
    fn wants_scene(&self) -> bool;

    /// Stores what has become known of the last step.
    fn flush(&mut self);

    /// Ends the run. Returns why nothing can be stored any more, if that is so, and lines on what was not stored or
    /// not found.
    fn finish(self: Box<Self>) -> (Option<String>, Vec<String>);
}

/// What a step did, as a cache keeps it.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Finding {
    /// What it reported.
    pub report: Report,
    /// The reason for which it was refused, as the recipe says it must be.
    pub refused: Option<Refusal>,
    /// Vertices, edges and faces of all meshes together.
    pub counts: [usize; 3],
}

/// What a step has just done.
#[derive(Clone, Debug)]
pub struct Done<'a> {
    /// What a cache finds of it later.
    pub finding: &'a Finding,
    /// The scene after it.
    pub scene: &'a Scene,
    /// Whether the scene is certainly the one before it.
    pub same: bool,
    /// How long it took.
    pub time: Duration,
    /// What it asked for of files.
    pub uses: &'a [FileUse],
    /// The files that it has written below `stage`.
    pub written: Vec<PathBuf>,
    /// Where outputs wait until the run succeeds, if it writes any.
    pub stage: Option<&'a Path>,
}

/// Why a step ran. Shown as the end of a sentence that begins with "because".
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RerunReason {
    /// There is no cache.
    #[error("there is no cache")]
    NoCache,
    /// The cache knows no run of this step.
    #[error("it has not run before")]
    New,
    /// Another version of the program, or another build of it.
    #[error("the program is another one")]
    Program,
    /// The operation has another version.
    #[error("the version of the operation changed: {from} -> {to}")]
    Version {
        /// The version then.
        from: u32,
        /// The version now.
        to: u32,
    },
    /// Parameters have other values: which, and what they were and are.
    #[error("parameters changed: {0}")]
    Parameters(String),
    /// `on` names other objects.
    #[error("`on` changed")]
    On,
    /// The id is another one, and keys the random choices.
    #[error("its id changed, which keys random choices")]
    Id,
    /// `refused` is another one.
    #[error("`refused` changed")]
    Refused,
    /// The memory budget is another one.
    #[error("the memory budget changed")]
    Budget,
    /// It reads from another folder.
    #[error("it reads from another folder")]
    Folder,
    /// A file is not what it was.
    #[error("the file {} {}", .0.display(), .1)]
    File(PathBuf, Change),
    /// The recipe or its parameters are others, and the files that the step writes say which.
    #[error("the recipe changed, and what is written says from which one it is")]
    Provenance,
    /// The names of the files that the step writes are others.
    #[error("the names of its outputs changed")]
    Outputs,
    /// An earlier step, by its number from 1 and its label, ran.
    #[error("step {0} {1} ran again")]
    Earlier(usize, String),
    /// There are other steps before it.
    #[error("there are other steps before it")]
    Order,
    /// The cache does not have its result any more.
    #[error("its result is not in the cache any more")]
    Gone,
    /// Its result in the cache was damaged: how.
    #[error("its result in the cache was damaged: {0}")]
    Damaged(String),
    /// Its result was not stored: making it took less time than storing it would have.
    #[error("its result was not stored: making it took less time than storing it would")]
    NotKept,
    /// What it depends on cannot be told: a file and the reason.
    #[error("what it read cannot be told: {}, {}", .0.display(), .1)]
    Unknown(PathBuf, String),
    /// What it depends on cannot be told, because an earlier step has left a scene with removed elements.
    #[error("what an earlier step has left cannot be told")]
    NoState,
}

/// What became of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Change {
    /// It has another content.
    #[error("changed")]
    Changed,
    /// It is not there any more.
    #[error("is gone")]
    Gone,
    /// It was not there.
    #[error("was not there before")]
    Appeared,
}
