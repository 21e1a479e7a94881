//! Asks for the path of a file with a dialog of the system. If the system shows no dialog, asks with a text field and a
//! list of files in the window.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{Button, Context, Id, Key, Modal, Response, RichText, ScrollArea, TextEdit, Ui};
use mesh_io::Format;

use crate::app::{Parts, Pending};
use crate::{files, help};

/// If a dialog ends in less than this time, the system did not show the dialog, for example on Linux without a desktop
/// portal.
const SHORTEST_DIALOG: Duration = Duration::from_millis(200);

/// The entry of the list for the parent folder.
const PARENT: &str = "..";

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

    /// Returns the extensions of the files that the user can choose.
    fn extensions(self) -> Vec<&'static str> {
        if self != Self::Open {
            return vec![self.extension()];
        }
        let formats = Format::all().filter(|format| format.can_read());
        let formats = formats.map(Format::extension);
        ["ron", "gz"].into_iter().chain(formats).collect()
    }

    /// Whether the user can choose this file.
    fn fits(self, path: &Path) -> bool {
        let extension = path.extension().unwrap_or_default();
        let mut extensions = self.extensions().into_iter();
        extensions.any(|fitting| extension.eq_ignore_ascii_case(fitting))
    }

    /// Returns the extension of the file to be saved. If a file is opened, the extension is empty.
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
    /// The folder of the path, and the folders and files in this folder that are listed.
    listed: (PathBuf, Vec<Listed>),
    /// Whether the text field for the path gets the keyboard focus in the next frame.
    takes_keys: bool,
}

/// A folder or a file in the list below the text field.
struct Listed {
    is_file: bool,
    name: String,
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
        listed: (PathBuf::new(), Vec::new()),
        takes_keys: true,
    });
}

impl Prompt {
    /// Returns the folder of the path, and the name that the user has typed so far.
    fn split(&self) -> (PathBuf, String) {
        let path = Path::new(self.path.trim());
        if self.path.trim().ends_with(std::path::is_separator) {
            return (path.to_owned(), String::new());
        }
        let folder = path.parent().unwrap_or(path).to_owned();
        let name = path.file_name().unwrap_or_default();
        (folder, name.to_string_lossy().into_owned())
    }

    /// Draws the list of folders and files in the folder of the path. If the user chooses a file to open, only names
    /// that contain the typed name are shown. If the typed name is the name of an entry, all names are shown. A click
    /// writes the path of a folder or a file. Returns whether a file was double-clicked.
    fn list(&mut self, ui: &mut Ui) -> bool {
        let (folder, typed) = self.split();
        if self.listed.0 != folder {
            self.listed = (folder.clone(), entries(&folder, self.purpose));
        }
        let all = &self.listed.1;
        // A click on a file enters its name, but does not shorten the list, so that a second click opens the same file.
        let shows_all =
            self.purpose != Purpose::Open || all.iter().any(|entry| entry.name == typed);
        let typed = typed.to_lowercase();
        let matches = |entry: &&Listed| shows_all || entry.name.to_lowercase().contains(&typed);
        let shown: Vec<&Listed> = all.iter().filter(matches).collect();
        let height = ui.spacing().interact_size.y;
        let area = ScrollArea::vertical()
            .auto_shrink([false, true])
            .max_height(12.0 * height);
        let clicked = area.show_rows(ui, height, shown.len(), |ui, rows| {
            let mut clicked = None;
            for entry in &shown[rows] {
                let response = row(ui, entry);
                if response.clicked() {
                    clicked = Some((entry.is_file && response.double_clicked(), *entry));
                }
            }
            clicked
        });
        let Some((is_chosen, entry)) = clicked.inner else {
            return false;
        };
        let path = match folder.parent() {
            Some(parent) if entry.name == PARENT => parent.to_owned(),
            _ => folder.join(&entry.name),
        };
        self.path = path.display().to_string();
        if !entry.is_file {
            self.path.push(std::path::MAIN_SEPARATOR);
        }
        self.takes_keys = true;
        is_chosen
    }
}

fn row(ui: &mut Ui, entry: &Listed) -> Response {
    let mut name = entry.name.clone();
    if !entry.is_file {
        name.push('/');
    }
    ui.add(Button::selectable(false, name).truncate())
}

/// Lists the content of a folder: the parent folder if there is one, then the folders, then the files that fit the
/// purpose. Folders and files are sorted by name. Folders and files whose names begin with `.` are left out. If the
/// folder cannot be read, lists only the parent folder if there is one.
fn entries(folder: &Path, purpose: Purpose) -> Vec<Listed> {
    let listed = |entry: std::fs::DirEntry| {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_file = !path.is_dir();
        let fits = !is_file || purpose.fits(&path);
        (fits && !name.starts_with('.')).then_some(Listed { is_file, name })
    };
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut entries: Vec<Listed> = entries.flatten().filter_map(listed).collect();
    entries.sort_by_cached_key(|entry| (entry.is_file, entry.name.to_lowercase()));
    if folder.parent().is_some() {
        let name = PARENT.to_owned();
        let is_file = false;
        entries.insert(0, Listed { is_file, name });
    }
    entries
}

/// Shows a dialog of the system. Returns `None` if the dialog is canceled, or cannot be shown.
fn dialog(purpose: Purpose, suggested: &Path) -> Option<PathBuf> {
    let mut dialog = rfd::FileDialog::new().set_title(purpose.title());
    if let Some(folder) = suggested.parent().filter(|folder| folder.is_dir()) {
        dialog = dialog.set_directory(folder);
    }
    if purpose == Purpose::Open {
        let dialog = dialog.add_filter("Models and recipes", &purpose.extensions());
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

/// Draws the text field for a path, and the list of files.
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
        if std::mem::take(&mut prompt.takes_keys) {
            line.request_focus();
        }
        let is_chosen = prompt.list(ui);
        let path = Path::new(prompt.path.trim());
        let (is_open, is_file) = (prompt.purpose == Purpose::Open, path.is_file());
        let problem = match path.parent() {
            _ if is_open && path.is_dir() => "Choose a file.",
            _ if is_open && !is_file => "This file does not exist.",
            Some(folder) if folder != Path::new("") && !folder.is_dir() => {
                "The folder does not exist."
            }
            None => "Write the path of a file.",
            _ if path.is_dir() => "This is a folder.",
            _ if is_file && !is_open => "Saving replaces the existing file.",
            _ => "",
        };
        ui.label(RichText::new(problem).weak());
        let can = problem.is_empty() || is_file && !is_open;
        ui.horizontal(|ui| {
            let enters = line.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let name = if is_open { "Open" } else { "Save" };
            let button = ui.add_enabled(can, Button::new(name));
            is_done = can && (button.clicked() || enters || is_chosen);
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
