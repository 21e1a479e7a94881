//! What an operation runs in: progress, cancellation, the random stream, files, the budget.

use crate::{Files, OpError, Place};

/// Listens to progress and can ask for the run to stop.
pub trait Progress: Sync {
    /// Called with how far a loop is: `done` of `total`. Returns whether to go on.
    fn advance(&self, what: &str, done: u64, total: u64) -> bool;
}

/// Listens to nothing and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoProgress;

impl Progress for NoProgress {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

/// What an operation runs in.
pub struct Context<'a> {
    progress: &'a dyn Progress,
    files: &'a Files,
    /// The objects that the step was told to act on; `None` for all that it can.
    pub on: Option<&'a [String]>,
    /// Keys the random streams of the step: its id, or the name of its operation.
    pub stream: &'a str,
    /// How many bytes meshes may take.
    pub budget: u64,
    /// The names of the materials of the object at work, for selections.
    pub materials: Vec<String>,
    /// After an error: where the elements are that it is about. [`MeshOperation`](crate::MeshOperation)s leave
    /// them to their driver.
    pub places: Vec<Place>,
}

impl<'a> Context<'a> {
    /// A context without a choice of objects and without a budget.
    pub fn new(progress: &'a dyn Progress, files: &'a Files) -> Self {
        Self {
            progress,
            files,
            on: None,
            stream: "",
            budget: u64::MAX,
            materials: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Reports that `done` of `total` parts of the work are done. Every operation calls this before its
    /// first change and at least every few milliseconds.
    ///
    /// # Errors
    ///
    /// [`OpError::Cancelled`] if the run is to stop. Return it at once.
    pub fn advance(&self, what: &str, done: u64, total: u64) -> Result<(), OpError> {
        if self.progress.advance(what, done, total) {
            Ok(())
        } else {
            Err(OpError::Cancelled)
        }
    }

    /// Where files are read and written.
    pub fn files(&self) -> &Files {
        self.files
    }
}
