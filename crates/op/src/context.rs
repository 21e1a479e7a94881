//! The context that an operation runs in: progress, cancellation, the random stream, files, the memory budget.

use std::sync::{Mutex, PoisonError};

use progress::Progress;

use crate::{Files, OpError};

/// The context that an operation runs in.
pub struct Context<'a> {
    progress: &'a dyn Progress,
    files: &'a Files,
    /// The objects named in the step's `on:`; `None` if the step acts on all objects that it supports.
    pub on: Option<&'a [String]>,
    /// The text that seeds the random choices of the step, together with the `seed` of each choice: the label of the
    /// step in the recipe.
    pub stream: &'a str,
    /// The memory budget of meshes, in bytes.
    pub budget: u64,
    /// The names of the materials of the object that is being changed, for selections.
    pub materials: Vec<String>,
    /// Facts about the selections of the step, for its report.
    notes: Mutex<Vec<String>>,
}

impl<'a> Context<'a> {
    /// Creates a context without a choice of objects and without a memory budget.
    pub fn new(progress: &'a dyn Progress, files: &'a Files) -> Self {
        Self {
            progress,
            files,
            on: None,
            stream: "",
            budget: u64::MAX,
            materials: Vec::new(),
            notes: Mutex::default(),
        }
    }

    /// Reports that `done` of `total` parts of the work are done. Every operation calls this before its
    /// first change and at least every few milliseconds.
    ///
    /// # Errors
    ///
    /// [`OpError::Cancelled`] if the run was canceled. The operation returns this error at once.
    pub fn advance(&self, what: &str, done: u64, total: u64) -> Result<(), OpError> {
        Ok(self.progress.report(what, done, total)?)
    }

    /// Adds a note to the report of the step, once for equal notes.
    pub(crate) fn note(&self, note: String) {
        let mut notes = self.notes.lock().unwrap_or_else(PoisonError::into_inner);
        if !notes.contains(&note) {
            notes.push(note);
        }
    }

    /// Removes and returns the notes for the report.
    pub(crate) fn take_notes(&mut self) -> Vec<String> {
        let notes = self.notes.get_mut().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(notes)
    }

    /// Returns the progress, for long computations outside of this crate.
    pub fn progress(&self) -> &'a dyn Progress {
        self.progress
    }

    /// Returns the files of the run: where files are read and written.
    pub fn files(&self) -> &Files {
        self.files
    }
}
