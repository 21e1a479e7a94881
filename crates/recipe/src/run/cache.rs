//! What a run asks of a cache of steps. How results are stored is the business of the cache.

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use op::{FileUse, Files, Refusal, Report};
use scene::{Digest, Scene};
use serde::{Deserialize, Serialize};

use crate::recipe::{Placed, RecipeStep};

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
    ) -> Result<Finding, Why>;

    /// Keeps what step `number`, counted from 1, has done, which was not found.
    fn ran(&mut self, number: usize, label: &str, files: &Files, done: &Done);

    /// Takes note that the step that leads to a place ran once more for its scene, and says why.
    fn ran_again(&mut self, place: usize, label: &str, scene: &Scene, time: Duration) -> Why;

    /// The last place from `from` up to `to` at which the scene can be brought back, and that scene.
    fn bring(&mut self, from: usize, to: usize) -> Option<(usize, Scene)>;

    /// Whether the step behind a place leaves the scene as it was.
    fn is_same(&self, place: usize) -> bool;

    /// Whether an expectation is known to hold for the current scene.
    fn holds(&mut self, placed: &Placed, files: &Files) -> bool;

    /// Takes note that an expectation holds for the current scene.
    fn held(&mut self, placed: &Placed, uses: &[FileUse]);

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
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Why {
    /// There is no cache.
    NoCache,
    /// The cache knows no run of this step.
    New,
    /// Another version of the program, or another build of it.
    Program,
    /// The operation has another version.
    Version {
        /// The version then.
        from: u32,
        /// The version now.
        to: u32,
    },
    /// Parameters have other values: which, and what they were and are.
    Parameters(String),
    /// `on` names other objects.
    On,
    /// The id is another one, and keys the random choices.
    Id,
    /// `refused` is another one.
    Refused,
    /// The memory budget is another one.
    Budget,
    /// It reads from another folder.
    Folder,
    /// A file is not what it was.
    File(PathBuf, Change),
    /// The recipe or its parameters are others, and the files that the step writes say which.
    Provenance,
    /// The names of the files that the step writes are others.
    Outputs,
    /// An earlier step, by its number from 1 and its label, ran.
    Earlier(usize, String),
    /// There are other steps before it.
    Order,
    /// The cache does not have its result any more.
    Gone,
    /// Its result in the cache was damaged: how.
    Damaged(String),
    /// Its result was not stored: making it took less time than storing it would have.
    NotKept,
    /// What it depends on cannot be told: a file and the reason.
    Unknown(PathBuf, String),
    /// What it depends on cannot be told, because an earlier step has left a scene with removed elements.
    NoState,
}

/// What became of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// It has another content.
    Changed,
    /// It is not there any more.
    Gone,
    /// It was not there.
    Appeared,
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoCache => f.write_str("there is no cache"),
            Self::New => f.write_str("it has not run before"),
            Self::Program => f.write_str("the program is another one"),
            Self::Version { from, to } => {
                write!(f, "the version of the operation changed: {from} -> {to}")
            }
            Self::Parameters(which) => write!(f, "parameters changed: {which}"),
            Self::On => f.write_str("`on` changed"),
            Self::Id => f.write_str("its id changed, which keys random choices"),
            Self::Refused => f.write_str("`refused` changed"),
            Self::Budget => f.write_str("the memory budget changed"),
            Self::Folder => f.write_str("it reads from another folder"),
            Self::File(path, change) => {
                let change = match change {
                    Change::Changed => "changed",
                    Change::Gone => "is gone",
                    Change::Appeared => "was not there before",
                };
                write!(f, "the file {} {change}", path.display())
            }
            Self::Provenance => {
                f.write_str("the recipe changed, and what is written says from which one it is")
            }
            Self::Outputs => f.write_str("the names of its outputs changed"),
            Self::Earlier(number, label) => write!(f, "step {number} {label} ran again"),
            Self::Order => f.write_str("there are other steps before it"),
            Self::Gone => f.write_str("its result is not in the cache any more"),
            Self::Damaged(how) => write!(f, "its result in the cache was damaged: {how}"),
            Self::NotKept => f.write_str(
                "its result was not stored: making it took less time than storing it would",
            ),
            Self::Unknown(path, why) => {
                write!(f, "what it read cannot be told: {}, {why}", path.display())
            }
            Self::NoState => f.write_str("what an earlier step has left cannot be told"),
        }
    }
}
