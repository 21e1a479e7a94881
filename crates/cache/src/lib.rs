//! The step cache: stores the results of steps in a folder that several processes can share.
//!
//! ```text
//! steps/ab/cdef..     the records of the step with the key abcdef.. (report, counts, files, references to blobs)
//! blobs/12/3456..     an array of a scene, or an output file, whose content has the BLAKE3 digest 123456..
//! recipes/..          for each recipe, the data from which the keys of its last run were computed, to explain changes
//! tmp/                files that are being written
//! sizes               the number of bytes that each run has added
//! key                 the secret key of the cache: random bytes that enter the digests of records
//! ```
//!
//! **Keys.** The key of a step is the digest of the data that determine its result and that are known before the step
//! runs: the program, the operation with its version and parameters, the objects in `on`, the label that seeds random
//! choices, the expected refusal, the memory budget, and the state before the step. The state after a step is the
//! digest of its key and of the files that it read or looked for. The files that a step reads are known only after the
//! step has run. Before a cached result is used, the contents of these files are compared again. Modification times are
//! not used to compare files.
//!
//! **Integrity.** Only regular files are read, not links, and only up to a maximum length. Every blob must match the
//! digest in its name. Every record must match its digest, which depends on the secret key of the cache. Only the user
//! can read that key, so an edited record is rejected even if its digest was computed again. The arrays of a scene are
//! validated. A damaged file is removed and treated as missing. Files are written under a temporary name and then
//! renamed, so that neither concurrent nor killed processes leave incomplete files; no locks are needed. If the folder
//! cannot be written, the problem is reported once, and the run continues without storing anything.
//!
//! **What is stored.** The record of each completed step is stored, unless the state of an input file is unknown.
//! Scenes in which a mesh has removed elements are not stored, because they cannot be restored exactly. Other scenes
//! and output files are always stored if they have fewer than [`ALWAYS_STORED`] bytes. A larger scene is stored if the
//! computation since the last stored scene took at least as long as storing the scene takes (at [`BYTES_PER_SECOND`]).
//! A first run that stores its results therefore takes at most about twice as long as a run without the cache.
//! Recomputing a scene in a later run takes no longer than storing the scene would have taken. Larger output files are
//! stored if running the step and loading its scene takes at least as long as storing the files. Equal long arrays are
//! stored once. A step that changes one attribute of a large mesh therefore adds only that attribute.
//!
//! **Size.** At the end of a run that has stored something, the numbers of bytes that all runs have added are summed.
//! If the sum exceeds the limit or is not known, all files are listed. If these files exceed the limit, the least
//! recently used ones are removed until the remaining files take at most nine tenths of the limit.

mod blob;
mod evict;
mod expectations;
mod folder;
mod history;
mod inputs;
mod key;
mod record;
mod session;

use std::io;
use std::path::{Path, PathBuf};

use folder::Folder;
use recipe::{CachedRun, StepCache};
use session::Session;

/// Scenes and output files with fewer bytes than this are stored even if they are faster to compute than to store.
pub const ALWAYS_STORED: u64 = 1 << 20;
/// The estimated rate, in bytes per second, at which results are hashed and written.
pub const BYTES_PER_SECOND: f64 = 1e9;
/// The default size limit of a cache, in bytes.
pub const DEFAULT_LIMIT: u64 = 4 << 30;

/// A folder that stores the results of steps. Any number of runs can use the folder at the same time.
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
    /// The file of the recipe, if it has one. The data from which the keys of the steps are computed is stored for this
    /// file, so that the next run can report which data has changed.
    pub recipe: Option<&'a Path>,
    /// Whether [`Outcome::scene`](recipe::Outcome::scene) must be available even if no step needs it.
    pub want_scene: bool,
}

/// The size of a cache.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CacheSize {
    /// The total size of the stored steps, blobs and recipes, in bytes.
    pub bytes: u64,
    /// The number of stored steps.
    pub steps: u64,
    /// The number of stored arrays and output files.
    pub blobs: u64,
}

impl StepCache for Caching<'_> {
    fn begin(&self) -> Box<dyn CachedRun + '_> {
        Box::new(Session::new(*self))
    }
}

impl Cache {
    /// Returns the cache in `folder`. The folder is created when something is stored. If the files exceed `limit` bytes
    /// at the end of a run that has stored something, the least recently used files are removed. `program` identifies
    /// the program and its version. Results of other programs are not used.
    pub fn new(folder: impl Into<PathBuf>, limit: u64, program: impl Into<String>) -> Self {
        Self {
            folder: Folder::new(folder.into()),
            limit,
            program: program.into(),
        }
    }

    /// Returns the folder.
    pub fn folder(&self) -> &Path {
        self.folder.root()
    }

    /// Returns the size limit in bytes.
    pub fn limit(&self) -> u64 {
        self.limit
    }

    /// Returns the problem that prevents the cache from storing anything, if one has occurred.
    pub fn problem(&self) -> Option<&str> {
        self.folder.problem()
    }

    /// Returns the size of the cache. A missing folder counts as empty.
    ///
    /// # Errors
    ///
    /// If the folder cannot be listed.
    pub fn size(&self) -> io::Result<CacheSize> {
        evict::size(&self.folder)
    }

    /// Removes everything that the cache has stored, and no other files. Returns the size of the removed files.
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
