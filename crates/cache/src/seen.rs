//! The files that steps read: what they were, and whether they still are.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use op::{FileUse, Files};
use serde::{Deserialize, Serialize};

use crate::folder::{Hash, Unusable, hash_rest, open};
use recipe::Change;

/// What there was under a path.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) enum Seen {
    /// A plain file of this content.
    Content(Hash),
    /// A plain file whose content does not matter.
    Plain,
    /// No plain file.
    Nothing,
}

/// A path and what there was.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct FileState {
    pub(crate) path: PathBuf,
    pub(crate) seen: Seen,
}

/// What was read, and what was asked for.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Inputs {
    /// The paths that were asked for: as the recipe has them, and where that was. The same text means another
    /// file in another folder.
    asked: Vec<(String, PathBuf)>,
    /// The files that were read or looked for.
    pub(crate) files: Vec<FileState>,
}

impl Inputs {
    /// Whether what is asked for is where it was.
    pub(crate) fn are_asked_for_in(&self, files: &Files) -> bool {
        let mut asked = self.asked.iter();
        asked.all(|(path, full)| files.input.join(path) == *full)
    }
}

/// Looks at files, at each once in a run.
#[derive(Debug)]
pub(crate) struct Eyes {
    /// When the run began.
    began: SystemTime,
    /// Digests of plain files; `None` where there is none, an error where it cannot be read.
    known: BTreeMap<PathBuf, Result<Option<Hash>, String>>,
}

impl Eyes {
    pub(crate) fn new() -> Self {
        Self {
            began: SystemTime::now(),
            known: BTreeMap::new(),
        }
    }

    fn content(&mut self, path: &Path) -> Result<Option<Hash>, String> {
        if let Some(known) = self.known.get(path) {
            return known.clone();
        }
        let found = digest_of(path).map_err(|error| error.to_string());
        self.known.insert(path.to_owned(), found.clone());
        found
    }

    /// What has become of the first of these files that is not as it was.
    pub(crate) fn changed(&mut self, files: &[FileState]) -> Option<(PathBuf, Change)> {
        files.iter().find_map(|file| {
            let is_there = file.path.is_file();
            let change = match file.seen {
                Seen::Nothing if is_there => Change::Appeared,
                Seen::Content(_) | Seen::Plain if !is_there => Change::Gone,
                Seen::Content(before) if self.content(&file.path) != Ok(Some(before)) => {
                    Change::Changed
                }
                _ => return None,
            };
            Some((file.path.clone(), change))
        })
    }

    /// What a step has read, from what it said.
    ///
    /// # Errors
    ///
    /// A path for which that cannot be told, and why.
    pub(crate) fn read(&mut self, uses: &[FileUse]) -> Result<Inputs, (PathBuf, &'static str)> {
        let (mut read, mut looked_for, mut asked) = (BTreeSet::new(), BTreeSet::new(), Vec::new());
        for file in uses {
            match file {
                FileUse::Requested { path, full } => asked.push((path.clone(), full.clone())),
                FileUse::Read(path) => _ = read.insert(path),
                FileUse::ExistenceChecked(path) => _ = looked_for.insert(path),
                FileUse::Written { .. } => {}
            }
        }
        if let Some((_, path)) = asked.iter().find(|(_, path)| !read.contains(path)) {
            return Err((path.clone(), "it is not told what is read there"));
        }
        let mut files = Vec::new();
        for path in &read {
            // What was seen before may be something else now.
            self.known.remove(*path);
            let seen = match self.content(path) {
                Ok(Some(_)) if self.is_new(path) => {
                    return Err(((*path).clone(), "it has changed during the run"));
                }
                Ok(Some(hash)) => Seen::Content(hash),
                Ok(None) => Seen::Nothing,
                Err(_) => return Err(((*path).clone(), "it cannot be read")),
            };
            let path = (*path).clone();
            files.push(FileState { path, seen });
        }
        for path in looked_for.difference(&read) {
            let seen = if path.is_file() {
                Seen::Plain
            } else {
                Seen::Nothing
            };
            let path = (*path).clone();
            files.push(FileState { path, seen });
        }
        Ok(Inputs { asked, files })
    }

    /// Whether a file has changed since the run began: then nobody knows which of its contents was read.
    fn is_new(&self, path: &Path) -> bool {
        let modified = std::fs::metadata(path).and_then(|meta| meta.modified());
        modified.is_ok_and(|at| at > self.began)
    }
}

/// The digest of a plain file; `None` if there is none.
fn digest_of(path: &Path) -> io::Result<Option<Hash>> {
    if !path.is_file() {
        return Ok(None);
    }
    match open(path) {
        Ok((mut file, _)) => hash_rest(&mut file).map(|(hash, _)| Some(hash)),
        Err(Unusable::Missing) => Ok(None),
        Err(Unusable::Damaged(why)) => Err(io::Error::other(why)),
    }
}
