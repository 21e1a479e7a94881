//! Opening and closing documents.

use std::path::{Path, PathBuf};

use eframe::egui::{self, ViewportCommand};

use super::Parts;

/// An action that discards the current document.
#[derive(Clone, Debug)]
pub(crate) enum Pending {
    /// Start a new recipe.
    New,
    /// Open a file.
    Open(PathBuf),
    /// Close the window.
    Close,
}

impl Parts {
    /// Opens a file, or reports why it cannot be opened.
    pub(crate) fn open(&mut self, path: &Path) {
        match self.editor.open(path) {
            Ok(()) => {
                self.files.remember(path);
                self.draft = None;
                self.notice = None;
                self.view.forget_fit();
            }
            Err(error) => self.warn(error.to_string()),
        }
    }

    /// Performs an action that discards the current document. If the document has unsaved changes, asks the user first.
    pub(crate) fn drop_document(&mut self, pending: Pending, ctx: &egui::Context) {
        if self.editor.document().is_dirty() && self.editor.document().undo_label().is_some() {
            self.pending = Some(pending);
        } else {
            self.proceed(pending, ctx);
        }
    }

    pub(crate) fn proceed(&mut self, pending: Pending, ctx: &egui::Context) {
        self.pending = None;
        match pending {
            Pending::New => {
                self.editor.new_recipe();
                self.draft = None;
                self.view.forget_fit();
            }
            Pending::Open(path) => self.open(&path),
            Pending::Close => {
                self.is_closing = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    pub(super) fn closing(&mut self, ctx: &egui::Context) {
        if ctx.input(|input| input.viewport().close_requested()) && !self.is_closing {
            let is_dirty =
                self.editor.document().is_dirty() && self.editor.document().undo_label().is_some();
            if is_dirty {
                ctx.send_viewport_cmd(ViewportCommand::CancelClose);
                self.pending = Some(Pending::Close);
            }
        }
    }

    pub(super) fn dropped_files(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input(|input| {
            input
                .raw
                .dropped_files
                .first()
                .map(|file| file.path().to_owned())
        });
        if let Some(path) = dropped {
            self.drop_document(Pending::Open(path), ctx);
        }
    }
}
