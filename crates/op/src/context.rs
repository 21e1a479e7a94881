//! What an operation runs in: progress, cancellation, the random stream, files, the budget.

use progress::Progress;

use crate::{Files, OpError};

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
        }
    }

    /// Reports that `done` of `total` parts of the work are done. Every operation calls this before its
    /// first change and at least every few milliseconds.
    ///
    /// # Errors
    ///
    /// [`OpError::Cancelled`] if the run is to stop. Return it at once.
    pub fn advance(&self, what: &str, done: u64, total: u64) -> Result<(), OpError> {
        Ok(self.progress.report(what, done, total)?)
    }

    /// What a long computation outside of operations takes.
    pub fn progress(&self) -> &'a dyn Progress {
        self.progress
    }

    /// Where files are read and written.
    pub fn files(&self) -> &Files {
        self.files
    }
}
