//! Asks for the path of a file: by a dialog of the system or, if the system shows none, by a line in the window.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{Context, Id, Key, Modal, RichText, TextEdit};
use mesh_io::Format;

use crate::app::{Parts, Pending};
use crate::{files, help};

/// If a dialog ends in less than this time, the system did not show it. This happens on Linux without a desktop portal.
const SHORTEST_DIALOG: Duration = Duration::from_millis(200);

/// Why the user is asked for the path of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    Open,
    SaveRecipe,
    SaveGif,
    SaveApng,
}

impl Purpose {
    fn title(self) -> &'static str {
        match self {
            Self::Open => "Open a model or a recipe",
            Self::SaveRecipe => "Save the recipe",
            Self::SaveGif | Self::SaveApng => "Save the animation",
        }
    }

    /// Returns the extension of the file; empty for a file that is opened.
    fn extension(self) -> &'static str {
        match self {
            Self::Open => "",
            Self::SaveRecipe => "ron",
            Self::SaveGif => "gif",
            Self::SaveApng => "png",
        }
    }
}

/// A path that the user is typing in the window.
pub(crate) struct Prompt {
    purpose: Purpose,
    path: String,
}

/// Asks for the path of a file, and then opens or saves the file, as `purpose` says.
pub(crate) fn ask(parts: &mut Parts, purpose: Purpose, ctx: &Context) {
    let path = parts.editor.document().path();
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let suggested = path.with_extension(purpose.extension());
    if parts.has_dialogs {
        let start = Instant::now();
        if let Some(path) = dialog(purpose, &suggested) {
            proceed(parts, purpose, &path, ctx);
            return;
        }
        if start.elapsed() >= SHORTEST_DIALOG {
            return;
        }
    }
    let path = match purpose {
        Purpose::Open => path.with_file_name(""),
        _ => suggested,
    };
    parts.prompt = Some(Prompt {
        purpose,
        path: path.display().to_string(),
    });
}

/// Shows a dialog of the system. `None` if it is canceled, or cannot be shown.
fn dialog(purpose: Purpose, suggested: &Path) -> Option<PathBuf> {
    let mut dialog = rfd::FileDialog::new().set_title(purpose.title());
    if let Some(folder) = suggested.parent().filter(|folder| folder.is_dir()) {
        dialog = dialog.set_directory(folder);
    }
    if purpose == Purpose::Open {
        let formats = Format::all().filter(|format| format.can_read());
        let formats = formats.map(Format::extension);
        let extensions: Vec<&str> = ["ron", "gz"].into_iter().chain(formats).collect();
        let dialog = dialog.add_filter("Models and recipes", &extensions);
        return dialog.add_filter("All files", &["*"]).pick_file();
    }
    if let Some(name) = suggested.file_name() {
        dialog = dialog.set_file_name(name.to_string_lossy());
    }
    let extension = purpose.extension();
    dialog.add_filter(extension, &[extension]).save_file()
}

fn proceed(parts: &mut Parts, purpose: Purpose, path: &Path, ctx: &Context) {
    match purpose {
        Purpose::Open => parts.drop_document(Pending::Open(path.to_owned()), ctx),
        Purpose::SaveRecipe => files::save_to(parts, path),
        Purpose::SaveGif | Purpose::SaveApng => parts.export(path, purpose == Purpose::SaveGif),
    }
}

/// The line for a path.
pub(crate) fn ui(ctx: &Context, parts: &mut Parts) {
    let Some(mut prompt) = parts.prompt.take() else {
        return;
    };
    let mut is_done = false;
    let modal = Modal::new(Id::unique("path")).frame(help::modal_frame(ctx));
    let modal = modal.show(ctx, |ui| {
        ui.set_width(520.0);
        ui.heading(prompt.purpose.title());
        let edit = TextEdit::singleline(&mut prompt.path).desired_width(f32::INFINITY);
        let line = ui.add(edit).accessible_name("Path of the file");
        if !line.has_focus() && !line.lost_focus() {
            line.request_focus();
        }
        let path = Path::new(prompt.path.trim());
        let (is_open, is_file) = (prompt.purpose == Purpose::Open, path.is_file());
        let problem = match path.parent() {
            _ if is_open && !is_file => "This file does not exist.",
            Some(folder) if folder != Path::new("") && !folder.is_dir() => {
                "The folder does not exist."
            }
            None => "Write the path of a file.",
            _ if path.is_dir() => "This is a folder.",
            _ if is_file && !is_open => "The existing file is replaced.",
            _ => "",
        };
        ui.label(RichText::new(problem).weak());
        let can = problem.is_empty() || is_file && !is_open;
        ui.horizontal(|ui| {
            let enters = line.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let name = if is_open { "Open" } else { "Save" };
            let button = ui.add_enabled(can, eframe::egui::Button::new(name));
            is_done = can && (button.clicked() || enters);
            ui.button("Cancel").clicked()
        })
        .inner
    });
    if is_done {
        let path = PathBuf::from(prompt.path.trim());
        proceed(parts, prompt.purpose, &path, ctx);
    } else if !modal.inner && !modal.should_close() {
        parts.prompt = Some(prompt);
    }
}
