//! Opens recipes and models, saves recipes, and recovers unsaved texts.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use mesh_io::Format;
use recipe::Rebase;
use store::StoreError;

use crate::document::{Document, SaveError};
use crate::journal::Recovery;
use crate::run::RunState;
use crate::text::Outline;

use super::{Editor, OpenError};

impl Editor {
    /// Opens a recipe. If the file is a model, opens a new recipe that loads the model. The previous document is
    /// discarded, even if it has unsaved changes.
    ///
    /// # Errors
    ///
    /// Returns [`OpenError`] if the file cannot be read or is neither a recipe nor a model. The editor then keeps its
    /// current document.
    pub fn open(&mut self, path: &Path) -> Result<(), OpenError> {
        let is_recipe = path
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("ron"));
        let document = if is_recipe {
            Document::open(&*self.store, path)?
        } else {
            self.document_of_model(path)?
        };
        self.set_document(document);
        Ok(())
    }

    /// Returns a document with a recipe that loads a model.
    fn document_of_model(&self, path: &Path) -> Result<Document, OpenError> {
        let is_model = Format::from_path(path).is_some_and(Format::can_read);
        let file = path.file_name().and_then(|name| name.to_str());
        let (true, Some(file)) = (is_model, file) else {
            return Err(OpenError::Kind(
                path.to_owned(),
                Format::readable_extensions(),
            ));
        };
        if !self.store.is_file(path) {
            return Err(OpenError::Missing(path.to_owned()));
        }
        let load = format!("Load(path: {})", ron_tree::string_literal(file));
        let name = store::stem(path).to_owned();
        let recipe = path.with_file_name(name).with_extension("ron");
        Ok(Document::new(recipe, new_text(&load)))
    }

    /// Starts a new recipe. The previous document is discarded, even if it has unsaved changes.
    pub fn new_recipe(&mut self) {
        self.set_document(new_document());
    }

    /// Replaces the document of the editor, and runs the new document. The step cursor moves to the end of the new
    /// document.
    pub fn set_document(&mut self, document: Document) {
        self.document = document;
        self.outline = Outline::of(self.document.text());
        self.cursor = self.outline.steps.len();
        self.document.set_cursor(self.cursor);
        self.picked = None;
        self.shown = Arc::default();
        self.run = RunState::default();
        self.show(None);
    }

    /// Opens an unsaved text that [`recoverable`](crate::recoverable) has found. The previous document is discarded,
    /// even if it has unsaved changes. The recovered text counts as unsaved, and its old journal is removed.
    pub fn recover(&mut self, recovery: &Recovery) {
        self.set_document(recovery.document(&*self.store));
        self.keep_journal();
        recovery.discard(&*self.store);
    }

    /// Writes the unsaved text to the journal, from which the text can be recovered after a crash. Does nothing if the
    /// editor has no journal.
    pub(super) fn keep_journal(&mut self) {
        if let Some(journal) = &mut self.journal {
            journal.keep(&self.document, &*self.store);
        }
    }

    /// Saves the recipe to its file.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Document::save`].
    pub fn save(&mut self) -> Result<(), SaveError> {
        self.document.save(&*self.store)?;
        self.keep_journal();
        self.watch();
        Ok(())
    }

    /// Saves the recipe to a file, which becomes the file of the document. If this file is in another folder, the
    /// relative paths of input files in the recipe are changed to fit the new folder.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Document::save_as`].
    pub fn save_as(&mut self, path: &Path) -> Result<(), StoreError> {
        let moved = self
            .with_moved_inputs(path)
            .filter(|text| text != self.text());
        if let Some(text) = &moved {
            self.document
                .replace(text.as_str(), "move the recipe", false);
        }
        let saved = self.document.save_as(&*self.store, path);
        if saved.is_err() && moved.is_some() {
            self.document.undo();
        }
        self.text_changed(Some(self.cursor()));
        saved
    }

    /// Returns the text with which the recipe can be saved to the file `path`. In this text, the paths of input files
    /// are relative to the folder of `path`.
    fn with_moved_inputs(&self, path: &Path) -> Option<String> {
        let rebase = Rebase {
            from: self.document.path().parent()?,
            to: path.parent()?,
            store: &*self.store,
        };
        let called = self.run.sources.iter().skip(1).map(|source| &source.path);
        let inputs: Vec<PathBuf> = called.chain(&self.run.inputs).cloned().collect();
        let edits = rebase.edits(self.outline.root(), &inputs);
        crate::text::apply(self.text(), edits).ok()
    }

    /// Ends a conflict with another program that has changed the file. The text of the document stays, and the next
    /// save replaces the file.
    pub fn keep_mine(&mut self) {
        self.document.keep_mine();
    }

    /// Ends a conflict with another program that has changed the file. The text of the file becomes the text of the
    /// document. [`undo`](Self::undo) restores the previous text of the document.
    pub fn take_theirs(&mut self) {
        self.document.take_theirs();
        self.text_changed(None);
    }
}

/// Returns the document of a new recipe, which creates a cube.
pub(super) fn new_document() -> Document {
    let cube = "Cube(name: \"cube\", size: 2, triangles: true)";
    Document::new("recipe.ron", new_text(cube))
}

/// Returns the text of a new recipe with one step.
fn new_text(step: &str) -> String {
    format!("(\n    recipe: 1,\n    steps: [\n        {step},\n    ],\n)\n")
}
