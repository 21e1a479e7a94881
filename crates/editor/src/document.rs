//! The text of a recipe, its history, and its file.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use engine::stamp_line;
use recipe::SourceError;
use store::{Entry, Store, StoreError};

/// The maximum number of texts in the history.
const MAX_HISTORY: usize = 10_000;

/// The text of a recipe, its history, and its file.
#[derive(Debug)]
pub struct Document {
    /// The path of the recipe's file. For a recipe that was never saved, this is the path that is suggested when the
    /// recipe is saved.
    path: PathBuf,
    /// True if the recipe was read from its file or saved to its file; false for a new recipe that was never saved.
    has_file: bool,
    /// The texts, oldest first.
    history: Vec<State>,
    /// The index of the current text in `history`.
    current: usize,
    /// The text of the file when it was last read or written.
    saved: Option<Arc<str>>,
    /// The state that the file had when it was last checked. `None` if the file did not exist.
    seen: Option<Entry>,
    conflict: Option<Conflict>,
    /// Whether the file was removed by another program.
    is_removed: bool,
    /// A number that increases with every change of the text.
    version: u64,
}

#[derive(Clone, Debug)]
struct State {
    text: Arc<str>,
    /// A description of the change that led to this text, for the Undo and Redo buttons.
    label: String,
    /// The position of the step cursor after the change.
    cursor: usize,
}

/// The file was changed by another program while the text had unsaved changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// The text of the file.
    pub theirs: Arc<str>,
}

/// Why a recipe is not saved.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// The file was changed by another program since it was read.
    #[error("{} was changed by another program: choose `Keep mine` or `Take theirs`", .0.display())]
    Conflict(PathBuf),
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] StoreError),
}

/// Something that another program did to the file of the recipe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileChange {
    /// The file was changed by another program, and its text is now the text of the document.
    Reloaded,
    /// The file was changed by another program while the text had unsaved changes.
    Conflict,
    /// The file was removed. The text of the document stays, and counts as unsaved.
    Removed,
    /// The file was changed by another program, but cannot be read.
    Unreadable(String),
}

impl Document {
    /// Creates a document that has no file yet. `path` is the path that is suggested when the document is saved.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<Arc<str>>) -> Self {
        let text = text.into();
        let state = State {
            text,
            label: String::new(),
            cursor: usize::MAX,
        };
        Self {
            path: path.into(),
            has_file: false,
            history: vec![state],
            current: 0,
            saved: None,
            seen: None,
            conflict: None,
            is_removed: false,
            version: 1,
        }
    }

    /// Opens the file of a recipe.
    ///
    /// # Errors
    ///
    /// Returns [`SourceError`] if the file cannot be read, is too long, or is not UTF-8 text.
    pub fn open(store: &dyn Store, path: &Path) -> Result<Self, SourceError> {
        let seen = store.entry(path);
        let text = recipe::Source::open_in(store, path)?.text;
        let mut document = Self::new(path, text.clone());
        document.has_file = true;
        document.saved = Some(text);
        document.seen = seen;
        Ok(document)
    }

    /// Returns the text.
    pub fn text(&self) -> &Arc<str> {
        &self.history[self.current].text
    }

    /// Returns a number that changes with every change of the text.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Returns the path of the file or, if there is no file yet, the path that is suggested when the document is saved.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// If the recipe has a file, returns the path of the file, and its last known stamp. A stamp is a text that
    /// describes the state of a file, and changes when the file changes.
    pub(crate) fn seen(&self) -> Option<(PathBuf, String)> {
        self.has_file
            .then(|| (self.path.clone(), stamp_line(&self.path, self.seen)))
    }

    /// True if the recipe was read from its file or saved to its file; false for a new recipe that was never saved.
    pub fn has_file(&self) -> bool {
        self.has_file
    }

    /// Whether the text differs from the file.
    pub fn is_dirty(&self) -> bool {
        self.is_removed || self.saved.as_ref() != Some(self.text())
    }

    /// Replaces the text. `label` says what the change does. Returns whether the text has changed.
    ///
    /// If `merges` is true and the last change had the same label, the new change and the last change become one entry
    /// of the history. When the user types, changes are merged in this way, so that one undo removes more than one
    /// letter.
    pub fn replace(&mut self, text: impl Into<Arc<str>>, label: &str, merges: bool) -> bool {
        let text = text.into();
        if *self.text() == text {
            return false;
        }
        self.history.truncate(self.current + 1);
        let last = &mut self.history[self.current];
        if merges
            && self.current > 0
            && last.label == label
            && self.saved.as_ref() != Some(&last.text)
        {
            last.text = text;
        } else {
            self.history.push(State {
                text,
                label: label.to_owned(),
                cursor: usize::MAX,
            });
            if self.history.len() > MAX_HISTORY {
                self.history.remove(0);
            }
            self.current = self.history.len() - 1;
        }
        self.version += 1;
        true
    }

    /// Stores the position of the step cursor together with the current text.
    pub(crate) fn set_cursor(&mut self, cursor: usize) {
        self.history[self.current].cursor = cursor;
    }

    /// Returns the position of the step cursor that was stored together with the current text.
    pub(crate) fn cursor(&self) -> usize {
        self.history[self.current].cursor
    }

    /// Returns the label of the change that [`undo`](Self::undo) would undo. Returns `None` if nothing can be undone.
    pub fn undo_label(&self) -> Option<&str> {
        (self.current > 0).then(|| self.history[self.current].label.as_str())
    }

    /// Returns the label of the change that [`redo`](Self::redo) would redo. Returns `None` if nothing can be redone.
    pub fn redo_label(&self) -> Option<&str> {
        self.history
            .get(self.current + 1)
            .map(|state| state.label.as_str())
    }

    /// Goes back to the text before the last change. Returns whether there was a change to undo.
    pub fn undo(&mut self) -> bool {
        let can = self.current > 0;
        if can {
            self.current -= 1;
            self.version += 1;
        }
        can
    }

    /// Redoes the change that was undone last. Returns whether there was a change to redo.
    pub fn redo(&mut self) -> bool {
        let can = self.current + 1 < self.history.len();
        if can {
            self.current += 1;
            self.version += 1;
        }
        can
    }

    /// Saves the text to its file.
    ///
    /// # Errors
    ///
    /// Returns [`SaveError`] if the file cannot be written, or was changed by another program since it was read. If
    /// another program has changed the file, [`conflict`](Self::conflict) then returns the text of the file.
    pub fn save(&mut self, store: &dyn Store) -> Result<(), SaveError> {
        if self.has_file && self.follow(store) == Some(FileChange::Conflict) {
            return Err(SaveError::Conflict(self.path.clone()));
        }
        Ok(self.save_as(store, &self.path.clone())?)
    }

    /// Saves the text to a file, which becomes the file of the document. An existing file is replaced.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the file cannot be written.
    pub fn save_as(&mut self, store: &dyn Store, path: &Path) -> Result<(), StoreError> {
        store.write(path, self.text().as_bytes())?;
        path.clone_into(&mut self.path);
        self.has_file = true;
        self.saved = Some(self.text().clone());
        self.seen = store.entry(path);
        self.conflict = None;
        self.is_removed = false;
        Ok(())
    }

    /// Returns the conflict if another program has changed the file while the text had unsaved changes, and `None`
    /// otherwise.
    pub fn conflict(&self) -> Option<&Conflict> {
        self.conflict.as_ref()
    }

    /// Ends a conflict in favor of the document: the text of the document stays as it is and counts as unsaved. When
    /// the document is saved the next time, the file is replaced.
    pub fn keep_mine(&mut self) {
        if let Some(conflict) = self.conflict.take() {
            self.saved = Some(conflict.theirs);
        }
    }

    /// Ends a conflict in favor of the other program: the text of the file becomes the text of the document.
    /// [`undo`](Self::undo) restores the previous text of the document.
    pub fn take_theirs(&mut self) {
        if let Some(Conflict { theirs }) = self.conflict.take() {
            self.replace(theirs.clone(), "take the changed file", false);
            self.saved = Some(theirs);
        }
    }

    /// Checks whether another program has changed the file. If the file has changed and the document has no unsaved
    /// changes, the text of the file becomes the text of the document.
    pub fn follow(&mut self, store: &dyn Store) -> Option<FileChange> {
        if !self.has_file {
            return None;
        }
        let seen = store.entry(&self.path);
        if seen == self.seen {
            return self.conflict.is_some().then_some(FileChange::Conflict);
        }
        if seen.is_none() {
            self.seen = None;
            self.is_removed = true;
            return Some(FileChange::Removed);
        }
        let theirs = match recipe::Source::open_in(store, &self.path) {
            Ok(source) => source.text,
            Err(error) => {
                // The other program may still be writing the file. If the file has changed again at a
                // later check, it is read again.
                self.seen = seen;
                return Some(FileChange::Unreadable(error.to_string()));
            }
        };
        self.seen = seen;
        self.is_removed = false;
        if Some(&theirs) == self.saved.as_ref() {
            return self.conflict.is_some().then_some(FileChange::Conflict);
        }
        if theirs == *self.text() {
            self.saved = Some(theirs);
            self.conflict = None;
            return None;
        }
        if self.is_dirty() {
            self.conflict = Some(Conflict { theirs });
            return Some(FileChange::Conflict);
        }
        self.replace(theirs.clone(), "follow the changed file", false);
        self.saved = Some(theirs);
        Some(FileChange::Reloaded)
    }
}
