//! The start of the program: opens a file before there is a window.

use std::path::PathBuf;
use std::sync::Arc;

use editor::{Editor, Settings};
use op::Registry;

use super::Notice;
use crate::files::{self, Files};

/// What to open at the start.
#[derive(Clone, Debug)]
pub struct Start {
    /// The operations.
    pub registry: Arc<Registry>,
    /// A model or a recipe.
    pub path: Option<PathBuf>,
    /// The folder for the list of recent files and the recovery of texts. If omitted, nothing is stored.
    pub state_folder: Option<PathBuf>,
    /// Whether the program asks for paths of files with dialogs of the system. If false, a text field in the window
    /// asks for the paths.
    pub has_dialogs: bool,
}

impl Default for Start {
    fn default() -> Self {
        Self {
            registry: Arc::new(ops_all::registry()),
            path: None,
            state_folder: None,
            has_dialogs: false,
        }
    }
}

/// The editor and its files, without a window. The engine thread already runs the recipe, so that the scene is computed
/// while the window and the graphics device are created.
pub struct Opened {
    pub(super) editor: Editor,
    pub(super) files: Files,
    /// Why the file that was given at the start could not be opened.
    pub(super) notice: Option<Notice>,
    pub(super) start: Start,
}

impl Start {
    /// Creates the editor, and opens the file if there is one.
    pub fn open(self) -> Opened {
        // The unsaved texts of other editors are read before this editor creates its own journal. Otherwise, the new
        // journal would be read too.
        let mut files = Files::new(self.state_folder.clone());
        let settings = Settings {
            journals: files::journals(self.state_folder.as_deref()),
            ..Settings::default()
        };
        let mut editor = Editor::new(self.registry.clone(), Arc::new(engine::Disk), settings);
        let mut notice = None;
        if let Some(path) = &self.path {
            match editor.open(path) {
                Ok(()) => files.remember(path),
                Err(error) => notice = Some(Notice::error(error)),
            }
        }
        Opened {
            editor,
            files,
            notice,
            start: self,
        }
    }
}
