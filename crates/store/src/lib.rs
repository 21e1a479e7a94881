//! Where files are read and written: the [`Disk`], or the [`Memory`] where there is no disk, as in a browser.
//!
//! No crate below the program names `std::fs`: they are handed a [`Store`]. A file is written whole or not at all.
//!
//! # Examples
//!
//! ```
//! use store::{Memory, Store};
//!
//! let store = Memory::default();
//! store.write("models/a.obj".as_ref(), b"v 0 0 0\n")?;
//! assert_eq!(store.read("models/a.obj".as_ref())?, b"v 0 0 0\n");
//! assert!(store.is_folder("models".as_ref()));
//! # Ok::<(), store::StoreError>(())
//! ```

mod disk;
mod memory;
mod temporary;

use std::fmt::Debug;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

pub use disk::{Disk, replace, temporary_prefix};
pub use memory::Memory;
pub use temporary::TemporaryFolder;

/// Files and folders. Paths are those of the platform; relative ones are seen from the working directory.
pub trait Store: Debug + Send + Sync {
    /// Whether the paths are those of the machine, so that whoever knows no store can open them too.
    fn is_disk(&self) -> bool {
        false
    }

    /// Reads at most `most` bytes from the beginning of a plain file.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if the file does not exist, is not a regular file, or does not fit into memory.
    fn read_up_to(&self, path: &Path, most: u64) -> Result<Vec<u8>, StoreError>;

    /// The same, from a pipe or a device too: a text may come from one.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if that cannot be done.
    fn read_stream(&self, path: &Path, most: u64) -> Result<Vec<u8>, StoreError> {
        self.read_up_to(path, most)
    }

    /// What there is under a path, links followed; `None` if there is nothing, or it cannot be told.
    fn entry(&self, path: &Path) -> Option<Entry>;

    /// Whether the path itself is a link.
    fn is_link(&self, path: &Path) -> bool;

    /// The path of an existing file or folder with its links followed, so that two paths of one file are equal.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if there is nothing under the path.
    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError>;

    /// The paths of all files and folders in a folder, sorted.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if there is no such folder, or it cannot be listed.
    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError>;

    /// Makes a folder and those around it, unless they are there.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if that cannot be done.
    fn make_folder(&self, folder: &Path) -> Result<(), StoreError>;

    /// Makes an empty folder of a new name that begins with [`temporary_prefix`], inside of `folder` or else where
    /// temporary files belong. [`TemporaryFolder`] removes it too.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if that cannot be done.
    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError>;

    /// Removes a folder with everything in it.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if something remains.
    fn remove_folder(&self, folder: &Path) -> Result<(), StoreError>;

    /// Begins a file, in a folder that is there. A file of this name stays as it is until [`NewFile::commit`]; a link
    /// of this name is replaced, not followed.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if the file cannot be written, or a folder of this name is there.
    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError>;

    /// Moves a file to another name, where it replaces a file.
    ///
    /// # Errors
    ///
    /// [`StoreError`] with the new name.
    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError>;

    /// Reads a plain file.
    ///
    /// # Errors
    ///
    /// As [`read_up_to`](Self::read_up_to).
    fn read(&self, path: &Path) -> Result<Vec<u8>, StoreError> {
        self.read_up_to(path, u64::MAX)
    }

    /// Writes a file whole or not at all, and makes the folders around it.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if that cannot be done.
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
        self.make_folder(folder_of(path))?;
        let mut file = self.create(path)?;
        file.write_all(bytes)
            .map_err(|error| StoreError::new("write", path, error))?;
        file.commit()
    }

    /// The length of a plain file in bytes, if there is one.
    fn len(&self, path: &Path) -> Option<u64> {
        self.entry(path).filter(Entry::is_file).map(|file| file.len)
    }

    /// Whether there is anything under a path.
    fn exists(&self, path: &Path) -> bool {
        self.entry(path).is_some()
    }

    /// Whether there is a plain file under a path.
    fn is_file(&self, path: &Path) -> bool {
        self.entry(path).is_some_and(|entry| entry.is_file())
    }

    /// Whether there is a folder under a path.
    fn is_folder(&self, path: &Path) -> bool {
        self.entry(path)
            .is_some_and(|entry| entry.kind == Kind::Folder)
    }
}

/// A file that is being written beside its place. Dropped, it leaves nothing.
pub trait NewFile: Write + Send {
    /// Waits until the bytes are on the disk: a disk that is full may be told only here.
    ///
    /// # Errors
    ///
    /// What the system says.
    fn sync(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    ///
    /// [`StoreError`]; then the file of this name is as it was.
    fn commit(self: Box<Self>) -> Result<(), StoreError>;
}

/// What there is under a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// What kind of thing it is.
    pub kind: Kind,
    /// The length of a file in bytes.
    pub len: u64,
    /// When it was written last, if that is known. Files in memory count writes in nanoseconds.
    pub modified: Option<SystemTime>,
}

/// The kind of an [`Entry`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A plain file.
    File,
    /// A folder.
    Folder,
    /// A pipe, a device, a socket.
    Other,
}

impl Entry {
    /// Whether it is a plain file.
    pub fn is_file(&self) -> bool {
        self.kind == Kind::File
    }
}

/// Why a file or folder could not be read or written.
#[derive(Debug, thiserror::Error)]
#[error("cannot {what} {}: {error}", path.display())]
pub struct StoreError {
    /// What could not be done: `read`, `write`, `make the folder` or `list`.
    pub what: &'static str,
    /// The file or folder.
    pub path: PathBuf,
    /// What the system said.
    pub error: io::Error,
}

impl StoreError {
    /// As of [`Store`]s: `what` is a verb such as `read`.
    pub fn new(what: &'static str, path: &Path, error: io::Error) -> Self {
        let path = path.to_owned();
        Self { what, path, error }
    }
}

impl From<StoreError> for io::Error {
    fn from(error: StoreError) -> Self {
        error.error
    }
}

/// The folder that holds `path`; the working directory if the path is a bare name.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// Whether a file of this name can be there.
fn check_place(store: &dyn Store, path: &Path) -> Result<(), StoreError> {
    let problem = match (store.is_folder(path), store.is_folder(folder_of(path))) {
        (true, _) => "a folder of this name is there",
        (_, false) => "there is no such folder",
        _ => return Ok(()),
    };
    Err(StoreError::new("write", path, io::Error::other(problem)))
}

/// All plain files below a folder, sorted.
///
/// # Errors
///
/// [`StoreError`] if a folder cannot be listed.
pub fn files_below(store: &dyn Store, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for path in store.list(&folder)? {
            if store.is_folder(&path) {
                folders.push(path);
            } else {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests;
