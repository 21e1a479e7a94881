//! The stage: a temporary folder that holds the outputs until the run succeeds.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use op::Files;
use store::{Entry, TemporaryFolder, files_below};

use super::Settings;

/// Creates the stage, the temporary folder for outputs, if the recipe writes files. If the outputs are to be kept after
/// the run, the stage is inside the output folder.
pub(super) fn staging<'a>(settings: &Settings<'a>) -> Result<Option<TemporaryFolder<'a>>, String> {
    if !settings.writes {
        return Ok(None);
    }
    let folder = &settings.files.output;
    let inside = settings.keep_outputs.then_some(folder.as_path());
    match TemporaryFolder::new(&*settings.files.store, inside) {
        Ok(stage) => Ok(Some(stage)),
        Err(error) if settings.keep_outputs => Err(format!(
            "cannot write to the output folder {}: {}",
            folder.display(),
            error.error
        )),
        Err(error) => Err(error.to_string()),
    }
}

/// Moves all files from the stage to the output folder. Returns the paths of the files that were written, and the first
/// error if there was one. If an error occurs before the first file is moved, no files are written.
pub(super) fn deliver(stage: &Path, files: &Files) -> (Vec<PathBuf>, Result<(), String>) {
    let mut written = Vec::new();
    let result = moves(stage, files).and_then(|moves| {
        moves.into_iter().try_for_each(|(from, to)| {
            let renamed = files.store.rename(&from, &to);
            renamed.map_err(|error| error.to_string())?;
            written.push(to);
            Ok(())
        })
    });
    (written, result)
}

/// Returns two paths for each file of the stage: its current path, and its path in the output folder. Creates the
/// folders into which the files will be moved.
fn moves(stage: &Path, files: &Files) -> Result<Vec<(PathBuf, PathBuf)>, String> {
    let store = &*files.store;
    let mut moves = Vec::new();
    for from in files_below(store, stage).map_err(|error| error.to_string())? {
        let relative = from.strip_prefix(stage).expect("found below the stage");
        let to = files.output.join(relative);
        files.check_links(relative).map_err(|e| e.to_string())?;
        if let Err(error) = files.make_folder_of(&to) {
            let why = error.error;
            return Err(format!("cannot write {}: {why}", to.display()));
        }
        if store.is_folder(&to) {
            return Err(format!(
                "cannot write {}: a folder with that name exists",
                to.display()
            ));
        }
        moves.push((from, to));
    }
    Ok(moves)
}

/// The files of a stage. Each file has metadata that change whenever the file is written.
pub(super) type Listing = BTreeMap<PathBuf, Entry>;

/// Lists the files of a stage. Skips files that cannot be listed: `deliver` reports these files as errors.
pub(super) fn listing(stage: &Path, files: &Files) -> Listing {
    let paths = files_below(&*files.store, stage).unwrap_or_default();
    let files = paths.into_iter().filter_map(|path| {
        let entry = files.store.entry(&path)?;
        Some((path.strip_prefix(stage).ok()?.to_owned(), entry))
    });
    files.collect()
}

/// Returns the files of `after` that are new or changed.
pub(super) fn written(before: &Listing, after: &Listing) -> Vec<PathBuf> {
    let is_new = |(path, state): &(&PathBuf, &_)| before.get(*path) != Some(state);
    let new = after.iter().filter(is_new);
    new.map(|(path, _)| path.clone()).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use store::{Memory, NewFile, Store, StoreError};

    use super::*;

    /// Files in memory. Renaming a file fails if the new path ends with `bad.obj`.
    #[derive(Debug, Default)]
    struct Faulty(Memory);

    impl Store for Faulty {
        fn read_up_to(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
            self.0.read_up_to(path, limit)
        }

        fn entry(&self, path: &Path) -> Option<Entry> {
            self.0.entry(path)
        }

        fn is_link(&self, path: &Path) -> bool {
            self.0.is_link(path)
        }

        fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError> {
            self.0.canonical(path)
        }

        fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
            self.0.list(folder)
        }

        fn make_folder(&self, folder: &Path) -> Result<(), StoreError> {
            self.0.make_folder(folder)
        }

        fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError> {
            self.0.make_temporary(folder)
        }

        fn remove_folder(&self, folder: &Path) -> Result<(), StoreError> {
            self.0.remove_folder(folder)
        }

        fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
            self.0.create(path)
        }

        fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
            if to.ends_with("bad.obj") {
                let full = std::io::Error::other("the disk is full");
                return Err(StoreError::new("write", to, full));
            }
            self.0.rename(from, to)
        }
    }

    #[test]
    fn a_failed_delivery_names_the_files_that_were_written() {
        let files = Files {
            store: Arc::new(Faulty::default()),
            output: "out".into(),
            ..Files::default()
        };
        let stage = Path::new("out/stage");
        for name in ["a.obj", "bad.obj", "c.obj"] {
            files.store.write(&stage.join(name), b"").unwrap();
        }
        let (written, result) = deliver(stage, &files);
        assert_eq!(written, [Path::new("out/a.obj")]);
        assert_eq!(
            result.unwrap_err(),
            "cannot write out/bad.obj: the disk is full"
        );
        assert!(files.store.is_file("out/a.obj".as_ref()));
        assert!(!files.store.exists("out/c.obj".as_ref()));
    }
}
