//! The journal: a file that contains the unsaved text. The file is written after every change. After a crash, the text
//! is offered at the next start.
//!
//! Each editor has its own folder inside the folder for all journals. The folder of an editor is removed when the text
//! is saved, and when the editor is closed.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use ron_tree::string_literal;
use serde::Deserialize;
use store::Store;

use crate::document::Document;

const FILE: &str = "journal.ron";

/// The journal of one editor.
#[derive(Debug)]
pub(crate) struct Journal {
    folder: PathBuf,
    /// The version of the text that was last written to the journal. `None` if the journal has no text.
    written: Option<u64>,
}

/// An unsaved text of an editor that was not closed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovery {
    /// The path of the recipe.
    pub path: PathBuf,
    /// Whether the recipe has a file.
    pub has_file: bool,
    /// The unsaved text.
    pub text: String,
    folder: PathBuf,
}

/// The content of a journal.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Content {
    path: String,
    has_file: bool,
    process: u32,
    text: String,
}

impl Journal {
    /// Creates the journal of an editor in the folder of all journals.
    pub(crate) fn new(folder: &Path) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = folder.join(format!("{}-{number}", std::process::id()));
        Self {
            folder,
            written: None,
        }
    }

    /// If the document has unsaved changes, writes its text to the journal. If the document has no unsaved changes,
    /// removes the journal. If the journal cannot be written, the error is ignored, because the text is still in
    /// memory.
    pub(crate) fn keep(&mut self, document: &Document, store: &dyn Store) {
        if !document.is_dirty()
            || document.undo_label().is_none() && document.redo_label().is_none()
        {
            return self.clear(store);
        }
        if self.written == Some(document.version()) {
            return;
        }
        let absolute = std::path::absolute(document.path())
            .ok()
            .filter(|_| store.is_disk());
        let path = absolute.unwrap_or_else(|| document.path().to_owned());
        let text = format!(
            "(path: {}, has_file: {}, process: {}, text: {})\n",
            string_literal(&path.to_string_lossy()),
            document.has_file(),
            std::process::id(),
            string_literal(document.text()),
        );
        if store
            .write(&self.folder.join(FILE), text.as_bytes())
            .is_ok()
        {
            self.written = Some(document.version());
        }
    }

    /// Removes the journal.
    pub(crate) fn clear(&mut self, store: &dyn Store) {
        if self.written.take().is_some() {
            // If the journal cannot be removed, its text is offered at the next start.
            let _ = store.remove_folder(&self.folder);
        }
    }
}

/// Reads the folder for journals, and returns the unsaved texts of editors that were not closed, for example because of
/// a crash. On systems that have a folder `/proc`, leaves out the texts of other processes that are still running.
pub fn recoverable(store: &dyn Store, folder: &Path) -> Vec<Recovery> {
    let folders = store.list(folder).unwrap_or_default();
    folders
        .into_iter()
        .filter_map(|folder| read(store, folder))
        .collect()
}

fn read(store: &dyn Store, folder: PathBuf) -> Option<Recovery> {
    let bytes = store.read(&folder.join(FILE)).ok()?;
    let content: Content = ron_tree::from_str(std::str::from_utf8(&bytes).ok()?).ok()?;
    let is_own = content.process == std::process::id();
    let process = PathBuf::from(format!("/proc/{}", content.process));
    if !is_own && store.exists(&process) {
        return None;
    }
    Some(Recovery {
        path: content.path.into(),
        has_file: content.has_file,
        text: content.text,
        folder,
    })
}

impl Recovery {
    /// Removes the unsaved text from the folder for journals.
    pub fn discard(&self, store: &dyn Store) {
        // If the journal cannot be removed, its text is offered again.
        let _ = store.remove_folder(&self.folder);
    }

    /// Returns a document with the unsaved text. An undo restores the text of the file.
    pub(crate) fn document(&self, store: &dyn Store) -> Document {
        let opened = self
            .has_file
            .then(|| Document::open(store, &self.path).ok());
        let mut document = opened
            .flatten()
            .unwrap_or_else(|| Document::new(&self.path, ""));
        document.replace(self.text.as_str(), "recover", false);
        document
    }
}
