//! A file store that records which files are read or looked for. The command `watch` uses this store to find out which
//! files a recipe reads.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use engine::{Disk, Store};
use store::{Entry, NewFile, StoreError, folder_of};

use crate::listener::lock;

/// A store that accesses the disk, and records the paths that are read or looked for. Paths at which no file exists are
/// also recorded. The recorded paths can include folders and output files.
#[derive(Debug, Default)]
pub(crate) struct RecordingDisk(Mutex<Recorded>);

#[derive(Debug, Default)]
struct Recorded {
    /// The recorded paths, as the caller wrote them.
    given: BTreeSet<PathBuf>,
    /// The recorded paths. The folder of each path is canonical: absolute, with all links resolved.
    real: BTreeSet<PathBuf>,
}

impl RecordingDisk {
    /// Whether a path was recorded, because a file was read or looked for at this path. The folder of `real` must be
    /// canonical.
    pub(crate) fn has_recorded(&self, real: &Path) -> bool {
        lock(&self.0).real.contains(real)
    }

    /// Returns the recorded files that exist. The folders of the returned paths are canonical.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let recorded = lock(&self.0);
        let files = recorded.real.iter().filter(|path| path.is_file());
        files.cloned().collect()
    }

    fn record(&self, path: &Path) {
        let mut recorded = lock(&self.0);
        if recorded.given.insert(path.to_path_buf()) {
            recorded.real.extend(with_real_folder(path));
        }
    }
}

/// Returns a path with its folder made canonical, or `None` if the folder does not exist. If the path itself is a link,
/// the link is not followed, because saving the file replaces the link.
pub(crate) fn with_real_folder(path: &Path) -> Option<PathBuf> {
    let folder = folder_of(path).canonicalize().ok()?;
    Some(folder.join(path.file_name()?))
}

impl Store for RecordingDisk {
    fn is_disk(&self) -> bool {
        true
    }

    fn read_up_to(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        self.record(path);
        Disk.read_up_to(path, limit)
    }

    fn read_stream(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        self.record(path);
        Disk.read_stream(path, limit)
    }

    fn entry(&self, path: &Path) -> Option<Entry> {
        self.record(path);
        Disk.entry(path)
    }

    fn is_link(&self, path: &Path) -> bool {
        Disk.is_link(path)
    }

    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError> {
        Disk.canonical(path)
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
        Disk.list(folder)
    }

    fn make_folder(&self, folder: &Path) -> Result<(), StoreError> {
        Disk.make_folder(folder)
    }

    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError> {
        Disk.make_temporary(folder)
    }

    fn remove_folder(&self, folder: &Path) -> Result<(), StoreError> {
        Disk.remove_folder(folder)
    }

    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
        Disk.create(path)
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
        Disk.rename(from, to)
    }
}
