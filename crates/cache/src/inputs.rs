//! The files that steps read: their state when they were read, and whether they have changed since then.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use op::{FileUse, Files};
use serde::{Deserialize, Serialize};

use crate::folder::{Hash, Unusable, hash_rest, open};
use recipe::FileChange;

/// The state of a path when a step accessed it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) enum PathState {
    /// A regular file whose content has this digest.
    Content(Hash),
    /// A regular file whose content does not matter, because the step only checked whether the file exists.
    Exists,
    /// The path does not lead to a regular file: it does not exist, or it is a folder, a pipe or a device.
    Missing,
}

/// A path and its state.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct FileState {
    pub(crate) path: PathBuf,
    pub(crate) state: PathState,
}

/// The input files of a step or an expectation.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Inputs {
    /// The requested paths: each path as written in the recipe, and the path to which it was resolved. The resolved
    /// path is stored because a relative path in a recipe refers to different files for different input folders.
    requested: Vec<(String, PathBuf)>,
    /// The files that the step or the expectation read or looked for.
    pub(crate) files: Vec<FileState>,
}

impl Inputs {
    /// Whether each requested path still leads to the same full path as before.
    pub(crate) fn resolve_as_before(&self, files: &Files) -> bool {
        let mut requested = self.requested.iter();
        requested.all(|(path, full)| files.input.join(path) == *full)
    }
}

/// Checks files for changes. The checker remembers the digest of each file, so most files are read only once per run.
#[derive(Debug)]
pub(crate) struct FileChecker {
    run_start: SystemTime,
    /// For each path that was read, the state of the file, which is `Content` or `Missing`. The state is `None` if the
    /// file cannot be read.
    known: BTreeMap<PathBuf, Option<PathState>>,
}

impl FileChecker {
    pub(crate) fn new() -> Self {
        Self {
            run_start: SystemTime::now(),
            known: BTreeMap::new(),
        }
    }

    fn content(&mut self, path: &Path) -> Option<PathState> {
        if let Some(known) = self.known.get(path) {
            return *known;
        }
        let found = content_of(path);
        self.known.insert(path.to_owned(), found);
        found
    }

    /// Returns the first file of the list that has changed, and how it has changed.
    pub(crate) fn first_change(
        &mut self,
        folders: &Files,
        files: &[FileState],
    ) -> Option<(PathBuf, FileChange)> {
        files.iter().find_map(|file| {
            let exists = folders.store.is_file(&file.path);
            let change = match file.state {
                PathState::Missing if exists => FileChange::Appeared,
                PathState::Content(_) | PathState::Exists if !exists => FileChange::Gone,
                PathState::Content(_) if self.content(&file.path) != Some(file.state) => {
                    FileChange::Changed
                }
                _ => return None,
            };
            Some((file.path.clone(), change))
        })
    }

    /// Returns the inputs of a step, given the file accesses that it has reported.
    ///
    /// # Errors
    ///
    /// If the state of a file cannot be determined, returns the path of the file and the reason.
    pub(crate) fn inputs(&mut self, uses: &[FileUse]) -> Result<Inputs, (PathBuf, &'static str)> {
        let (mut read, mut checked, mut requested) = (BTreeSet::new(), BTreeSet::new(), Vec::new());
        for file in uses {
            match file {
                FileUse::Requested { path, full } => requested.push((path.clone(), full.clone())),
                FileUse::Read(path) => _ = read.insert(path),
                FileUse::ExistenceChecked(path) => _ = checked.insert(path),
                FileUse::Written { .. } => {}
            }
        }
        if let Some((_, path)) = requested.iter().find(|(_, path)| !read.contains(path)) {
            return Err((
                path.clone(),
                "the operation requested this path, but did not report that it read the file",
            ));
        }
        let mut files = Vec::new();
        for path in &read {
            // It is possible that the file has changed since its digest was computed, so the digest is computed again.
            self.known.remove(*path);
            let state = match self.content(path) {
                Some(PathState::Content(_)) if self.is_new(path) => {
                    return Err(((*path).clone(), "the file changed during the run"));
                }
                Some(state) => state,
                None => return Err(((*path).clone(), "the file cannot be read")),
            };
            let path = (*path).clone();
            files.push(FileState { path, state });
        }
        for path in checked.difference(&read) {
            let state = if path.is_file() {
                PathState::Exists
            } else {
                PathState::Missing
            };
            let path = (*path).clone();
            files.push(FileState { path, state });
        }
        Ok(Inputs { requested, files })
    }

    /// Whether a file was modified after the run started. In this case, it is unknown which version of the file the
    /// step has read.
    fn is_new(&self, path: &Path) -> bool {
        let modified = std::fs::metadata(path).and_then(|meta| meta.modified());
        modified.is_ok_and(|at| at > self.run_start)
    }
}

/// Reads the file at a path, and returns the state of the path: `Content` or `Missing`. Returns `None` if the file
/// cannot be read.
fn content_of(path: &Path) -> Option<PathState> {
    if !path.is_file() {
        return Some(PathState::Missing);
    }
    match open(path) {
        Ok((mut file, _)) => {
            let (hash, _) = hash_rest(&mut file).ok()?;
            Some(PathState::Content(hash))
        }
        Err(Unusable::Missing) => Some(PathState::Missing),
        Err(Unusable::Damaged(_)) => None,
    }
}
