//! The files of a run: the paths that a recipe is allowed to read and write, and a log of each use of a file.
//!
//! Paths of input files are relative to the folder of the recipe. Output files are always inside the output folder. An
//! output path that leads out of the output folder is refused.
//!
//! Each use of a file is logged. The step cache, which stores the results of steps, reads the log to find the files
//! that a step depends on. An operation that reads files reports each file with [`Files::has_read`]. If an operation
//! requests a path but never reports that it read the file, the dependencies of the step are unknown. The step is then
//! never cached.

use std::fmt;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use store::{Disk, Store, StoreError};

use crate::OpError;

/// Why a path cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileError {
    /// The output path leads out of the output folder.
    #[error(
        "the output path \"{0}\" must stay inside the output folder: use a relative path without the folders \".\" \
         and \"..\" and without the characters \"\\\" and \":\""
    )]
    Outside(String),
    /// The output path does not end with a file name.
    #[error("the output path \"{0}\" does not end with a file name")]
    NoName(String),
    /// An output path contains an unknown placeholder.
    #[error(
        "unknown placeholder {{{0}}} in \"{1}\"; known placeholders, which stand for the file names of path parameters: {2}"
    )]
    Placeholder(String, String, String),
    /// The output path leads out of the output folder through a symbolic link.
    #[error("the output path \"{0}\" leads out of the output folder through a symbolic link")]
    Link(String),
}

/// The files of a run: its folders, and the values of the placeholders in output paths.
#[derive(Clone, Debug)]
pub struct Files {
    /// The store from which files are read and to which they are written. Defaults to the disk.
    pub store: Arc<dyn Store>,
    /// The folder of the recipe.
    pub input: PathBuf,
    /// The output folder.
    pub output: PathBuf,
    /// The names of the placeholders and the values that replace them. For example, ("model.stem", "cow") replaces
    /// `{model.stem}` in an output path with `cow`.
    pub placeholders: Vec<(String, String)>,
    /// A line that says how the output files were made (their provenance). Output files contain this line if their
    /// format can store the line.
    pub provenance: Option<String>,
    /// A log of the files that the run has used so far.
    pub log: FileLog,
}

/// A log of all uses of files, in chronological order. All clones of a `FileLog` share the same list of entries.
#[derive(Clone, Debug, Default)]
pub struct FileLog(Arc<Mutex<Vec<FileUse>>>);

/// One use of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileUse {
    /// The path of an input file was requested.
    Requested {
        /// The path as written in the recipe.
        path: String,
        /// The path that [`Files::to_read`] returned.
        full: PathBuf,
    },
    /// The file was read.
    Read(PathBuf),
    /// The operation checked whether a regular file of this name exists, without reading it.
    ExistenceChecked(PathBuf),
    /// The path of an output file was requested.
    Written {
        /// The path as written in the recipe, with placeholders.
        path: String,
        /// The path relative to the output folder.
        relative: PathBuf,
    },
}

impl FileLog {
    /// Adds an entry to the log.
    pub fn note(&self, file: FileUse) {
        self.lock().push(file);
    }

    /// Removes all entries of the log and returns them.
    pub fn take(&self) -> Vec<FileUse> {
        std::mem::take(&mut self.lock())
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<FileUse>> {
        // If a thread panicked while it held the lock, the list is still valid, so the panic is ignored.
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
    /// Returns the full path of an input file. `path` is relative to the folder of the recipe. A caller that reads the
    /// file must also call [`has_read`](Self::has_read).
    pub fn to_read(&self, path: &str) -> PathBuf {
        let full = self.input.join(path);
        let file = FileUse::Requested {
            path: path.to_owned(),
            full: full.clone(),
        };
        self.log.note(file);
        full
    }

    /// Logs that the file at `path` was read. The path can come from [`to_read`](Self::to_read), or from the content of
    /// another input file, such as an OBJ file that names a material library. A step can be cached only if its
    /// operation calls this method for every input path that it requested. The result of a cached step must not depend
    /// on the contents of any other file.
    pub fn has_read(&self, path: impl Into<PathBuf>) {
        self.log.note(FileUse::Read(path.into()));
    }

    /// Logs that a file was read. If `is_read` is false, logs that only the existence of the file was checked.
    pub fn has_used(&self, path: PathBuf, is_read: bool) {
        self.log.note(if is_read {
            FileUse::Read(path)
        } else {
            FileUse::ExistenceChecked(path)
        });
    }

    /// Logs that the existence of a regular file of this name was checked, without reading it.
    pub fn has_checked_existence(&self, path: impl Into<PathBuf>) {
        self.log.note(FileUse::ExistenceChecked(path.into()));
    }

    /// Creates the missing folders of an output file.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if a folder cannot be created.
    pub fn make_folder_of(&self, path: &Path) -> Result<(), StoreError> {
        self.store.make_folder(store::folder_of(path))
    }

    /// Returns the full path of an output file in the output folder. Placeholders in `path` are replaced by their
    /// values.
    ///
    /// # Errors
    ///
    /// Returns a [`FileError`] if the path leads out of the output folder, does not end with a file name, or has an
    /// unknown placeholder.
    pub fn to_write(&self, path: &str) -> Result<PathBuf, FileError> {
        let filled = self.fill(path)?;
        let relative = Path::new(&filled);
        // Drive letters (`C:`) and backslashes have a special meaning only on some systems. Paths with drive letters or
        // backslashes are refused on all systems, so that a recipe works in the same way everywhere.
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

    /// Converts an error about output files to an [`OpError`]. In the message of the result, the paths of output files
    /// are relative to the output folder, as in the recipe. A full path would name the temporary folder into which a
    /// run writes.
    pub fn output_error(&self, error: impl fmt::Display) -> OpError {
        // `join("")` adds a separator to the end of the folder's path, so the separator is also removed from the text.
        let folder = self.output.join("").display().to_string();
        let mut text = error.to_string();
        if !folder.is_empty() {
            text = text.replace(&folder, "");
        }
        OpError::File(text)
    }

    fn fill(&self, path: &str) -> Result<String, FileError> {
        let mut filled = String::new();
        let mut rest = path;
        while let Some((before, after)) = rest.split_once('{') {
            filled.push_str(before);
            let (name, remainder) = after.split_once('}').unwrap_or((after, ""));
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
            rest = remainder;
        }
        filled.push_str(rest);
        Ok(filled)
    }

    /// Returns an error if the existing folders of a path lead out of the output folder through a symbolic link.
    ///
    /// # Errors
    ///
    /// Returns [`FileError::Link`] if the path leads out of the output folder.
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
    fn errors_name_output_files_as_in_the_recipe() {
        let files = files();
        let path = files.to_write("a/b.glb").unwrap();
        let error = files.output_error(format!("cannot write {}: too large", path.display()));
        assert_eq!(error.to_string(), "cannot write a/b.glb: too large");
        let here = Files::default();
        let error = here.output_error("cannot write a/b.glb");
        assert_eq!(error.to_string(), "cannot write a/b.glb");
    }

    #[test]
    fn outputs_stay_inside_the_output_folder() {
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
    fn placeholders_are_replaced() {
        assert_eq!(
            files().to_write("{model.stem}.obj"),
            Ok(PathBuf::from("out/cow.obj"))
        );
        assert_eq!(
            files().to_write("{mdel}.obj").unwrap_err().to_string(),
            "unknown placeholder {mdel} in \"{mdel}.obj\"; known placeholders, which stand for the file names of path parameters: {model.stem}"
        );
    }

    #[test]
    fn input_paths_are_relative_to_the_recipe() {
        assert_eq!(
            files().to_read("assets/a.obj"),
            PathBuf::from("recipes/assets/a.obj")
        );
    }

    #[test]
    fn clones_share_one_log() {
        let files = files();
        let copy = files.clone();
        let path = copy.to_read("a.obj");
        copy.has_read(path.as_path());
        copy.to_write("{model.stem}.obj").unwrap();
        let written = FileUse::Written {
            path: "{model.stem}.obj".into(),
            relative: "cow.obj".into(),
        };
        let requested = FileUse::Requested {
            path: "a.obj".into(),
            full: path.clone(),
        };
        let expected = [requested, FileUse::Read(path), written];
        assert_eq!(files.log.take(), expected);
        assert_eq!(copy.log.take(), []);
    }
}
