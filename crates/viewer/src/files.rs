//! Saved files, recent files, and the offer to recover texts after a crash.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use editor::{Keys, Recovery};
use eframe::egui::{self, Context, Id};

use crate::app::{Parts, Pending};
use crate::paths::{self, Purpose};

/// The maximum number of recent files.
const MAX_RECENT: usize = 10;

/// The files in the state folder.
pub(crate) struct Files {
    folder: Option<PathBuf>,
    recent: Vec<PathBuf>,
    /// The unsaved texts of editors that crashed.
    recoveries: Vec<Recovery>,
}

impl Files {
    pub(crate) fn new(folder: Option<PathBuf>) -> Self {
        let recent = folder
            .as_ref()
            .and_then(|folder| std::fs::read_to_string(folder.join("recent")).ok());
        let recent = recent.unwrap_or_default();
        let journals = journals(folder.as_deref());
        Self {
            recent: recent.lines().map(PathBuf::from).take(MAX_RECENT).collect(),
            recoveries: journals.map_or_else(Vec::new, |journals| {
                editor::recoverable(&engine::Disk, &journals)
            }),
            folder,
        }
    }

    pub(crate) fn recent(&self) -> &[PathBuf] {
        &self.recent
    }

    /// Returns the unsaved text that is offered next.
    pub(crate) fn recovery(&self) -> Option<&Recovery> {
        self.recoveries.first()
    }

    /// Removes and returns the unsaved text that is offered, so that it is not offered again.
    pub(crate) fn take_recovery(&mut self) -> Option<Recovery> {
        (!self.recoveries.is_empty()).then(|| self.recoveries.remove(0))
    }

    /// Adds a file to the recent files.
    pub(crate) fn remember(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|known| *known != path);
        self.recent.insert(0, path);
        self.recent.truncate(MAX_RECENT);
        let lines: Vec<String> = self
            .recent
            .iter()
            .map(|path| path.display().to_string())
            .collect();
        self.write("recent", &lines.join("\n"));
    }

    /// Reads the file `keys.ron` of the state folder. `None` if it does not exist.
    pub(crate) fn read_keys(&self) -> Option<Result<Keys, String>> {
        let path = self.folder.as_ref()?.join("keys.ron");
        let text = std::fs::read_to_string(&path).ok()?;
        Some(Keys::read(&text).map_err(|error| format!("{}: {error}", path.display())))
    }

    /// Writes a file of the state folder. Errors are ignored, because the program works without the state.
    pub(crate) fn write(&self, name: &str, text: &str) {
        if let Some(folder) = &self.folder {
            let new = folder.join(format!("{name}.new"));
            let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&new, text));
            let _ = written.and_then(|()| std::fs::rename(&new, folder.join(name)));
        }
    }
}

/// Returns the folder of journals in the state folder.
pub(crate) fn journals(state_folder: Option<&Path>) -> Option<PathBuf> {
    state_folder.map(|folder| folder.join("journals"))
}

/// Saves the recipe. If the recipe has no file yet, asks for one.
pub(crate) fn save(parts: &mut Parts, ctx: &Context) {
    if !parts.editor.document().has_file() {
        paths::ask(parts, Purpose::SaveRecipe, ctx);
        return;
    }
    let result = parts.editor.save();
    let path = parts.editor.document().path().to_owned();
    finish(parts, result, &path);
}

/// Saves the recipe to a file, which becomes the file of the recipe.
pub(crate) fn save_to(parts: &mut Parts, path: &Path) {
    let result = parts.editor.save_as(path);
    finish(parts, result, path);
}

fn finish(parts: &mut Parts, result: Result<(), impl Display>, path: &Path) {
    match result {
        Ok(()) => {
            parts.files.remember(path);
            parts.inform(format!("Saved {}", path.display()));
        }
        Err(error) => parts.warn(error.to_string()),
    }
}

/// Asks the user whether to save or discard the unsaved changes.
pub(crate) fn question(ctx: &Context, parts: &mut Parts) {
    let Some(pending) = parts.pending.clone() else {
        return;
    };
    let modal = egui::Modal::new(Id::unique("unsaved"))
        .frame(crate::help::modal_frame(ctx))
        .show(ctx, |ui| {
            ui.set_width(380.0);
            ui.heading("Unsaved changes");
            let what = match &pending {
                Pending::New => "before a new recipe is started",
                Pending::Open(_) => "before another file is opened",
                Pending::Close => "before the window is closed",
            };
            ui.label(format!("Save the recipe {what}?"));
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                if ui.button("Save").clicked() {
                    save(parts, ctx);
                    if !parts.editor.document().is_dirty() {
                        parts.proceed(pending.clone(), ctx);
                    }
                }
                if ui.button("Discard").clicked() {
                    parts.proceed(pending.clone(), ctx);
                }
                if ui.button("Cancel").clicked() {
                    parts.pending = None;
                }
            });
        });
    if modal.should_close() {
        parts.pending = None;
    }
}
