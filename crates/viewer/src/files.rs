//! Dialogs for files, recent files, and the recovery of texts after a crash.

use std::path::{Path, PathBuf};

use editor::{Document, Editor, Keys};
use eframe::egui::{self, Context, Id};

use crate::app::{Parts, Pending};

/// The maximum number of recent files.
const MAX_RECENT: usize = 10;

/// The files in the state folder.
pub(crate) struct Files {
    folder: Option<PathBuf>,
    recent: Vec<PathBuf>,
    recovery: Option<Recovery>,
    /// The version of the text that was stored.
    stored: u64,
    /// Whether the text of a session that did not end is still on disk.
    keeps_recovery: bool,
}

/// The text of a session that ended without saving.
#[derive(Clone, Debug)]
pub(crate) struct Recovery {
    path: PathBuf,
    text: String,
}

impl Recovery {
    pub(crate) fn name(&self) -> String {
        self.path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    }

    /// Returns the document with the unsaved text.
    pub(crate) fn document(&self) -> Document {
        let saved = Document::open(&engine::Disk, &self.path);
        match saved {
            Ok(mut document) => {
                document.replace(self.text.as_str(), "recover", false);
                document
            }
            Err(_) => Document::new(&*self.path, self.text.as_str()),
        }
    }
}

impl Files {
    pub(crate) fn new(folder: Option<PathBuf>) -> Self {
        let read = |name: &str| std::fs::read_to_string(folder.as_ref()?.join(name)).ok();
        let recent = read("recent").unwrap_or_default();
        let recovery = read("recovery").and_then(|text| {
            let (path, text) = text.split_once('\n')?;
            Some(Recovery {
                path: PathBuf::from(path),
                text: text.to_owned(),
            })
        });
        Self {
            recent: recent.lines().map(PathBuf::from).take(MAX_RECENT).collect(),
            keeps_recovery: recovery.is_some(),
            recovery,
            folder,
            stored: 1,
        }
    }

    pub(crate) fn recent(&self) -> &[PathBuf] {
        &self.recent
    }

    pub(crate) fn recovery(&self) -> Option<&Recovery> {
        self.recovery.as_ref()
    }

    /// Ends the offer of the recovery.
    pub(crate) fn forget_recovery(&mut self) {
        self.recovery = None;
        self.keeps_recovery = false;
        self.drop_recovery();
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

    /// Stores the text for a recovery if it changed since the last time.
    pub(crate) fn store_recovery_if_changed(&mut self, editor: &Editor) {
        if self.recovery.is_none() && self.stored != editor.document().version() {
            self.store_recovery(editor);
        }
    }

    /// Stores the text for a recovery, or removes the stored text if everything is saved.
    pub(crate) fn store_recovery(&mut self, editor: &Editor) {
        let document = editor.document();
        self.stored = document.version();
        if self.recovery.is_some() {
            return;
        }
        if document.is_dirty() && document.undo_label().is_some() {
            let path =
                std::path::absolute(document.path()).unwrap_or_else(|_| document.path().to_owned());
            self.write(
                "recovery",
                &format!("{}\n{}", path.display(), document.text()),
            );
        } else {
            self.drop_recovery();
        }
    }

    /// Removes the stored text. The text of an earlier session is kept until the user has decided.
    pub(crate) fn drop_recovery(&self) {
        if let Some(folder) = self
            .folder
            .as_ref()
            .filter(|_| !self.keeps_recovery || self.recovery.is_none())
        {
            // Without a stored text, there is nothing to remove.
            let _ = std::fs::remove_file(folder.join("recovery"));
        }
    }

    /// Writes a file of the state folder. The state is a convenience: an error is not worth a message.
    fn write(&self, name: &str, text: &str) {
        if let Some(folder) = &self.folder {
            let new = folder.join(format!("{name}.new"));
            let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&new, text));
            let _ = written.and_then(|()| std::fs::rename(&new, folder.join(name)));
        }
    }
}

/// Asks for a file to open.
pub(crate) fn ask_open() -> Option<PathBuf> {
    rfd::FileDialog::new()
        .set_title("Open a model or a recipe")
        .add_filter(
            "Models and recipes",
            &[
                "ron", "obj", "gltf", "glb", "ply", "stl", "off", "3mf", "bez", "bzc",
            ],
        )
        .add_filter("All files", &["*"])
        .pick_file()
}

/// Saves the recipe, and asks for a file if it has none.
pub(crate) fn save(parts: &mut Parts) {
    if !parts.editor.document().has_file() {
        save_as(parts);
        return;
    }
    let result = parts.editor.save();
    let path = parts.editor.document().path().to_owned();
    finish(parts, result, &path);
}

/// Asks for a file and saves the recipe.
pub(crate) fn save_as(parts: &mut Parts) {
    let path = parts.editor.document().path();
    let mut dialog = rfd::FileDialog::new()
        .set_title("Save the recipe")
        .add_filter("Recipes", &["ron"]);
    if let Some(name) = path.file_name() {
        dialog = dialog.set_file_name(name.to_string_lossy());
    }
    if let Some(folder) = path.parent().filter(|folder| folder.is_dir()) {
        dialog = dialog.set_directory(folder);
    }
    if let Some(path) = dialog.save_file() {
        let result = parts.editor.save_as(&path);
        finish(parts, result, &path);
    }
}

fn finish(parts: &mut Parts, result: Result<(), String>, path: &Path) {
    match result {
        Ok(()) => {
            parts.files.remember(path);
            parts.files.store_recovery(&parts.editor);
            parts.inform(format!("Saved {}", path.display()));
        }
        Err(message) => parts.warn(message),
    }
}

/// Asks what to do with unsaved changes.
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
                    save(parts);
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
