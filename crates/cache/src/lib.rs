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
//! **Keys.** The key of a step is a digest of all data that are known before the step runs and that can change its
//! result. The key depends on the program, the operation with its version and parameters, and the objects in the field
//! `on` of the step. The key also depends on the label of the step (which seeds random choices), the memory budget, and
//! the state of the scene before the step. If the recipe expects that the step is refused, the key depends on the
//! expected reason, too. The state of the scene after a step is a digest of two things: the key of the step, and the
//! files that the step read or looked for. The files that a step reads are known only after the step has run. Before
//! the cached result of a step is used, the current digest of each file that the step read is compared with the
//! recorded digest. The modification times of the files are not compared.
//!
//! **Integrity.** In its folder, the cache reads only regular files, no links, and reads each file only up to a maximum
//! length. Every blob must match the digest in its name. Every record must match its digest, which depends on the
//! secret key of the cache. Only the user can read the secret key. Other people cannot compute the correct digest of an
//! edited record, so the record is rejected. The arrays of a scene are validated when they are loaded. A damaged file
//! is removed and treated as missing. Each file is written under a temporary name and then renamed. Therefore, neither
//! concurrent nor killed processes leave incomplete files, and the cache needs no locks. If the folder cannot be
//! written, the problem is reported once, and the run continues without storing anything.
//!
//! **What is stored.** The record of a completed step is stored if the cache knows the state of the scene before the
//! step and the state of every input file. Removed elements leave gaps in the arrays of a mesh. Storing a mesh would
//! close its gaps and renumber its elements, so a scene with gaps in its meshes is not stored. All other scenes, and
//! all output files, are stored if they have fewer than [`ALWAYS_STORED`] bytes. A larger scene is stored if storing it
//! takes no longer than the steps that ran since a scene was last stored or loaded. The time for storing is estimated
//! from [`BYTES_PER_SECOND`]. Therefore, even a run that stores all of its results takes at most about twice as long as
//! a run without the cache. If storing a scene would take longer than computing it, the scene is not stored, and a
//! later run computes it again. Larger output files are stored if storing them takes at most as long as loading the
//! scene and running the step again. If several scenes contain the same long array, the array is stored only once.
//! Therefore, if a step changes one attribute of a large mesh, only this attribute is added to the cache.
//!
//! **Size.** At the end of a run that has stored something, the cache adds the number of stored bytes to its recorded
//! size. If the new size exceeds the size limit, or if the recorded size is unknown, all files of the cache are listed.
//! If the listed files exceed the size limit, the least recently used files are removed until the remaining files take
//! at most nine tenths of the limit.

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
    /// The size limit in bytes.
    limit: u64,
    program: String,
}

/// How a run of a recipe uses a cache.
#[derive(Clone, Copy, Debug)]
pub struct Caching<'a> {
    /// The cache.
    pub cache: &'a Cache,
    /// The file of the recipe, if the recipe was read from a file. For this file, the cache stores the data from which
    /// the keys of the steps are computed. The next run of the file can then report which data have changed.
    pub recipe: Option<&'a Path>,
    /// Whether the final scene, [`Outcome::scene`](recipe::Outcome::scene), must be available after the run even if no
    /// step needs it.
    pub want_scene: bool,
}

/// The size of a cache.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CacheSize {
    /// The total size in bytes of the files that store steps, recipes and blobs (long arrays and output files).
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
    /// Returns the cache in `folder`. The folder is created when something is stored for the first time. If the files
    /// exceed `limit` bytes at the end of a run that has stored something, the least recently used files are removed.
    /// `program` identifies the program and its version. The results of another program, or of another version of the
    /// program, are not used.
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

    /// If a problem prevents the cache from storing anything, returns this problem.
    pub fn problem(&self) -> Option<&str> {
        self.folder.problem()
    }

    /// Returns the size of the cache. A missing folder counts as empty.
    ///
    /// # Errors
    ///
    /// Returns an error if the folder cannot be listed.
    pub fn size(&self) -> io::Result<CacheSize> {
        evict::size(&self.folder)
    }

    /// Removes everything that the cache has stored, and no other files. Returns the total size of the removed files.
    ///
    /// # Errors
    ///
    /// Returns an error if the folder cannot be listed or a file cannot be removed.
    pub fn clear(&self) -> io::Result<CacheSize> {
        evict::clear(&self.folder)
    }
}

#[cfg(test)]
mod tests;
