//! The cache of steps: what steps have made, by content, in a folder that several processes share.
//!
//! ```text
//! steps/ab/cdef..     what a step did, by its key: report, counts, files, and the scene as
//! blobs/12/3456..     arrays and output files, each by the BLAKE3 of its content
//! recipes/..          what the steps of the last run of a recipe were made of, to say what changed
//! tmp/                files that are being written
//! sizes               how many bytes each run has added
//! key                 random bytes that enter the digests of records
//! ```
//!
//! **Keys.** The key of a step is the digest of all that it is made of before it runs: the
//! program, the operation with its version and parameters, the objects, the name that keys random choices, the
//! budget, and the state before it. The state after it is made of its key and of the contents of the files that it
//! read, which are known when it has run, and looked at again before its result is taken. Times of files are
//! not trusted.
//!
//! **Trust.** Only plain files are read, no links and no more bytes than were stored. Every blob must match the digest
//! that is its name, and every record its digest under the key of the cache, which only the user can read: a record that
//! was edited is not taken, even if its digest was computed anew. A scene is only made of arrays
//! that form one. What is damaged is removed and counts as not there. Files are written under a temporary
//! name and renamed, so that neither a second process nor a killed one leaves half of one under its name; nothing is
//! locked. A folder that cannot be written is told once, and the run goes on without it.
//!
//! **What is kept.** The small part of a result is always kept, and scenes and files below [`SMALL`] bytes. A
//! larger scene is kept when what was computed since the last kept one took longer than storing it takes, at
//! [`SPEED`] bytes a second: so the cache at most about doubles the time of a first run, and never makes
//! a later one compute more than storing would have cost. Large outputs are kept by the same measure, with
//! the time that bringing back their scene takes. Equal arrays are stored once: a step that changes one
//! attribute adds that attribute.
//!
//! **Size.** A run that has added something adds up what all runs have added. Over the limit, all files are listed
//! and those that were not used for the longest time are removed, down to nine tenths of it.

mod blob;
mod evict;
mod folder;
mod held;
mod key;
mod record;
mod seen;
mod session;
mod why;

use std::io;
use std::path::{Path, PathBuf};

use folder::Folder;
use recipe::{CachedRun, StepCache};
use session::Session;

/// Scenes and files of fewer bytes are always kept.
pub const SMALL: u64 = 1 << 20;
/// How many bytes a second are hashed and written, in estimates.
pub const SPEED: f64 = 1e9;
/// The size of a cache unless told otherwise, in bytes.
pub const LIMIT: u64 = 4 << 30;

/// A folder of results of steps, for any number of runs at once.
#[derive(Debug)]
pub struct Cache {
    folder: Folder,
    /// In bytes.
    limit: u64,
    program: String,
}

/// How a run uses a cache.
#[derive(Clone, Copy, Debug)]
pub struct Caching<'a> {
    /// The cache.
    pub cache: &'a Cache,
    /// The recipe's file, if it has one: what its steps are made of is kept, to tell in the next run what
    /// has changed.
    pub recipe: Option<&'a Path>,
    /// Whether [`Outcome::scene`](recipe::Outcome::scene) is wanted even where no step needs it.
    pub want_scene: bool,
}

/// What a cache holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CacheSize {
    /// The bytes of all files.
    pub bytes: u64,
    /// The number of steps.
    pub steps: u64,
    /// The number of arrays and output files.
    pub blobs: u64,
}

impl StepCache for Caching<'_> {
    fn begin(&self) -> Box<dyn CachedRun + '_> {
        Box::new(Session::new(*self))
    }
}

impl Cache {
    /// The cache in `folder`, which is made when something is stored. It is kept below `limit` bytes. `program`
    /// names the program with its version: results of another program are not taken.
    pub fn new(folder: impl Into<PathBuf>, limit: u64, program: impl Into<String>) -> Self {
        Self {
            folder: Folder::new(folder.into()),
            limit,
            program: program.into(),
        }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        self.folder.root()
    }

    /// The limit in bytes.
    pub fn limit(&self) -> u64 {
        self.limit
    }

    /// Why nothing can be stored, once that was found.
    pub fn problem(&self) -> Option<&str> {
        self.folder.problem()
    }

    /// Lists all files and adds them up. A folder that is not there is empty.
    ///
    /// # Errors
    ///
    /// If the folder cannot be listed.
    pub fn size(&self) -> io::Result<CacheSize> {
        evict::size(&self.folder)
    }

    /// Removes everything that the cache has stored, and nothing else, and returns what that was.
    ///
    /// # Errors
    ///
    /// If the folder cannot be listed or a file cannot be removed.
    pub fn clear(&self) -> io::Result<CacheSize> {
        evict::clear(&self.folder)
    }
}

#[cfg(test)]
mod tests;
