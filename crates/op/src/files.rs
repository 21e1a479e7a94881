//! Where a recipe reads and writes.
//!
//! A recipe reads relative to its own folder. It writes only below the output folder, wherever the
//! path in the recipe points: a path that leads out of it is refused.
//!
//! What operations ask for here is noted, for whoever wants to know what a step depends on: the cache
//! of steps. An operation that reads a file says which files that were with [`Files::has_read`]; one that
//! only asks for a path may have read anything beside it, and is run anew each time.

use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use store::{Disk, Store, StoreError};

/// Why a path cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileError {
    /// The path leads out of the output folder.
    #[error(
        "the output path \"{0}\" must stay inside the output folder: no \"..\", no absolute path"
    )]
    Outside(String),
    /// The path names no file.
    #[error("the output path \"{0}\" names no file")]
    NoName(String),
    /// A placeholder that is not a path parameter.
    #[error("unknown placeholder {{{0}}} in \"{1}\", known are: {2}")]
    Placeholder(String, String, String),
    /// A link inside the output folder leads out of it.
    #[error("\"{0}\" leads out of the output folder through a link")]
    Link(String),
}

/// The files of a run: the folders, and the texts that stand for placeholders in output paths.
#[derive(Clone, Debug)]
pub struct Files {
    /// Where files are read and written; the disk by default.
    pub store: Arc<dyn Store>,
    /// The folder of the recipe.
    pub input: PathBuf,
    /// The output folder.
    pub output: PathBuf,
    /// For `{model.stem}` in an output path: ("model.stem", "cow").
    pub placeholders: Vec<(String, String)>,
    /// A line that says where the outputs come from, for formats that can carry it.
    pub provenance: Option<String>,
    /// What was asked for.
    pub log: FileLog,
}

/// What was asked for of files, in order. Copies share one list.
#[derive(Clone, Debug, Default)]
pub struct FileLog(Arc<Mutex<Vec<FileUse>>>);

/// Something that was done with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileUse {
    /// Its path was asked for, to read it.
    Asked {
        /// As the recipe has it.
        path: String,
        /// As [`Files::to_read`] gave it.
        full: PathBuf,
    },
    /// Its content was read.
    Read(PathBuf),
    /// It was only looked whether there is a plain file of this name.
    LookedFor(PathBuf),
    /// A path to write was asked for.
    Written {
        /// As the recipe has it, with placeholders.
        path: String,
        /// Below the output folder.
        relative: PathBuf,
    },
}

impl FileLog {
    /// Adds a line.
    pub fn note(&self, file: FileUse) {
        self.lock().push(file);
    }

    /// Takes all lines out.
    pub fn take(&self) -> Vec<FileUse> {
        std::mem::take(&mut self.lock())
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<FileUse>> {
        // A list of whole lines, even after a panic.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Default for Files {
    fn default() -> Self {
        Self {
            store: Arc::new(Disk),
            input: PathBuf::new(),
            output: PathBuf::new(),
            placeholders: Vec::new(),
            provenance: None,
            log: FileLog::default(),
        }
    }
}

impl Files {
    /// The path of a file to read: `path` seen from the recipe's folder. Whoever reads it says so with
    /// [`has_read`](Self::has_read).
    pub fn to_read(&self, path: &str) -> PathBuf {
        let full = self.input.join(path);
        let file = FileUse::Asked {
            path: path.to_owned(),
            full: full.clone(),
        };
        self.log.note(file);
        full
    }

    /// Says that a file was read: `path` as [`to_read`](Self::to_read) gave it, and each file that was read
    /// because the first one names it. A step that says this for every path that it has asked for can be
    /// kept in a cache; its result must depend on the contents of no other files.
    pub fn has_read(&self, path: impl Into<PathBuf>) {
        self.log.note(FileUse::Read(path.into()));
    }

    /// Says that a file was read, or that it was only looked whether it is there.
    pub fn has_used(&self, path: PathBuf, is_read: bool) {
        self.log.note(if is_read {
            FileUse::Read(path)
        } else {
            FileUse::LookedFor(path)
        });
    }

    /// Says that it was looked whether there is a plain file of this name, without reading it.
    pub fn has_looked_for(&self, path: impl Into<PathBuf>) {
        self.log.note(FileUse::LookedFor(path.into()));
    }

    /// Makes the folders around a file to write.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if that cannot be done.
    pub fn make_folder_of(&self, path: &Path) -> Result<(), StoreError> {
        self.store.make_folder(store::folder_of(path))
    }

    /// The path of a file to write: `path` below the output folder, placeholders filled in.
    ///
    /// # Errors
    ///
    /// [`FileError`] if the path leaves the output folder, names no file or has an unknown
    /// placeholder.
    pub fn to_write(&self, path: &str) -> Result<PathBuf, FileError> {
        let filled = self.fill(path)?;
        let relative = Path::new(&filled);
        // A drive or a backslash means something on some systems only: refused on all.
        let plain = relative
            .components()
            .all(|c| matches!(c, Component::Normal(_)));
        if !plain || filled.contains('\\') || filled.contains(':') || filled.contains('\0') {
            return Err(FileError::Outside(filled));
        }
        if relative.file_name().is_none() || filled.ends_with('/') {
            return Err(FileError::NoName(filled));
        }
        self.check_links(relative)?;
        let file = FileUse::Written {
            path: path.to_owned(),
            relative: relative.to_path_buf(),
        };
        self.log.note(file);
        Ok(self.output.join(relative))
    }

    fn fill(&self, path: &str) -> Result<String, FileError> {
        let mut filled = String::new();
        let mut rest = path;
        while let Some((before, after)) = rest.split_once('{') {
            filled.push_str(before);
            let (name, behind) = after.split_once('}').unwrap_or((after, ""));
            let Some((_, text)) = self.placeholders.iter().find(|(known, _)| known == name) else {
                let known: Vec<_> = self
                    .placeholders
                    .iter()
                    .map(|(known, _)| format!("{{{known}}}"))
                    .collect();
                let known = if known.is_empty() {
                    "none".into()
                } else {
                    known.join(", ")
                };
                return Err(FileError::Placeholder(name.into(), path.into(), known));
            };
            filled.push_str(text);
            rest = behind;
        }
        filled.push_str(rest);
        Ok(filled)
    }

    /// Refuses a path whose existing folders lead out of the output folder through a link.
    ///
    /// # Errors
    ///
    /// [`FileError::Link`].
    pub fn check_links(&self, relative: &Path) -> Result<(), FileError> {
        let Ok(root) = self.store.canonical(&self.output) else {
            return Ok(());
        };
        for folder in relative.ancestors().skip(1) {
            if let Ok(real) = self.store.canonical(&self.output.join(folder)) {
                if real.starts_with(&root) {
                    return Ok(());
                }
                return Err(FileError::Link(relative.display().to_string()));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files() -> Files {
        Files {
            input: "recipes".into(),
            output: "out".into(),
            placeholders: vec![("model.stem".into(), "cow".into())],
            ..Files::default()
        }
    }

    #[test]
    fn outputs_stay_below_the_output_folder() {
        assert_eq!(
            files().to_write("a/b.glb"),
            Ok(PathBuf::from("out/a/b.glb"))
        );
        for path in [
            "../b.glb",
            "/b.glb",
            "a/../../b.glb",
            "./b.glb",
            "c:b.glb",
            "a\\..\\b.glb",
            "",
        ] {
            assert!(files().to_write(path).is_err(), "{path}");
        }
    }

    #[test]
    fn placeholders_are_filled_in() {
        assert_eq!(
            files().to_write("{model.stem}.obj"),
            Ok(PathBuf::from("out/cow.obj"))
        );
        assert_eq!(
            files().to_write("{mdel}.obj").unwrap_err().to_string(),
            "unknown placeholder {mdel} in \"{mdel}.obj\", known are: {model.stem}"
        );
    }

    #[test]
    fn inputs_are_seen_from_the_recipe() {
        assert_eq!(
            files().to_read("assets/a.obj"),
            PathBuf::from("recipes/assets/a.obj")
        );
    }

    #[test]
    fn what_is_asked_for_is_noted_once_in_all_copies() {
        let files = files();
        let copy = files.clone();
        let path = copy.to_read("a.obj");
        copy.has_read(path.as_path());
        copy.to_write("{model.stem}.obj").unwrap();
        let written = FileUse::Written {
            path: "{model.stem}.obj".into(),
            relative: "cow.obj".into(),
        };
        let asked = FileUse::Asked {
            path: "a.obj".into(),
            full: path.clone(),
        };
        let expected = [asked, FileUse::Read(path), written];
        assert_eq!(files.log.take(), expected);
        assert_eq!(copy.log.take(), []);
    }
}
