//! Reads and writes files: on the [`Disk`], or in [`Memory`] if there is no disk, as in a browser.
//!
//! The libraries for models and recipes do not use `std::fs`; their callers pass a [`Store`]. A file is written
//! completely or not at all.
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

use std::ffi::OsStr;
use std::fmt::Debug;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

pub use disk::{Disk, replace, temporary_prefix};
pub use memory::Memory;
pub use temporary::TemporaryFolder;

/// A file system. Paths have the syntax of the operating system. Relative paths are relative to the working directory.
pub trait Store: Debug + Send + Sync {
    /// Whether paths refer to the file system of the machine, so that other code can open them without the store.
    fn is_disk(&self) -> bool {
        false
    }

    /// Reads at most `limit` bytes from the beginning of a regular file.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the file is not a regular file or cannot be read, for example because it does not
    /// exist or does not fit in memory.
    fn read_up_to(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError>;

    /// Reads at most `limit` bytes from the beginning of a file, which can also be a pipe or a device.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the file cannot be read.
    fn read_stream(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        self.read_up_to(path, limit)
    }

    /// Describes the file or folder at a path, following links; `None` if it does not exist or cannot be accessed.
    fn entry(&self, path: &Path) -> Option<Entry>;

    /// Whether the path itself is a link.
    fn is_link(&self, path: &Path) -> bool;

    /// Resolves the links in the path of an existing file or folder, so that different paths of the same file give the
    /// same result.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the path does not exist.
    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError>;

    /// Returns the paths of all files and folders in a folder, sorted.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the folder does not exist or cannot be listed.
    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError>;

    /// Creates a folder and its missing parents. Does nothing if the folder exists.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the folder cannot be created.
    fn make_folder(&self, folder: &Path) -> Result<(), StoreError>;

    /// Creates an empty folder with a new name, inside `folder` or, if `folder` is `None`, in the default
    /// location for temporary files. On disk, the name begins with the [`temporary_prefix`] of this process. To
    /// have the folder removed automatically, use [`TemporaryFolder`].
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the folder cannot be created.
    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError>;

    /// Removes a folder with its content.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the folder or a part of its content could not be removed.
    fn remove_folder(&self, folder: &Path) -> Result<(), StoreError>;

    /// Removes a folder if it is empty.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the folder is not empty or cannot be removed.
    fn remove_empty_folder(&self, folder: &Path) -> Result<(), StoreError> {
        if self.list(folder)?.is_empty() {
            return self.remove_folder(folder);
        }
        let error = io::ErrorKind::DirectoryNotEmpty.into();
        Err(StoreError::new("remove the folder", folder, error))
    }

    /// Begins to write the file at `path`, whose folder must exist. Until [`NewFile::commit`] is called, an existing
    /// file at `path` stays unchanged. If `path` is a link, the link is replaced, not followed.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the file cannot be written, or if there is a folder at `path`.
    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError>;

    /// Renames a file. An existing file with the new name is replaced.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] with the new name if the file cannot be renamed.
    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError>;

    /// Reads a regular file.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`read_up_to`](Self::read_up_to).
    fn read(&self, path: &Path) -> Result<Vec<u8>, StoreError> {
        self.read_up_to(path, u64::MAX)
    }

    /// Writes a file completely or not at all, and creates the missing folders of its path.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the file cannot be written. After an error, an existing file is unchanged.
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
        self.make_folder(folder_of(path))?;
        let mut file = self.create(path)?;
        file.write_all(bytes)
            .map_err(|error| StoreError::new("write", path, error))?;
        file.commit()
    }

    /// Returns the length of the file at the path, in bytes. `None` if the path does not exist or is not a regular
    /// file.
    fn len(&self, path: &Path) -> Option<u64> {
        self.entry(path).filter(Entry::is_file).map(|file| file.len)
    }

    /// Whether a file or folder exists at the path.
    fn exists(&self, path: &Path) -> bool {
        self.entry(path).is_some()
    }

    /// Whether a regular file exists at the path.
    fn is_file(&self, path: &Path) -> bool {
        self.entry(path).is_some_and(|entry| entry.is_file())
    }

    /// Whether a folder exists at the path.
    fn is_folder(&self, path: &Path) -> bool {
        self.entry(path)
            .is_some_and(|entry| entry.kind == Kind::Folder)
    }
}

/// Returns the name of a file without its extension, and without a `.gz` after the extension: `model` for
/// `model.obj.gz`. The result is empty if the path has no file name.
pub fn stem(path: &Path) -> &OsStr {
    let is_compressed = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    let stem = path.file_stem().unwrap_or_default();
    if is_compressed {
        Path::new(stem).file_stem().unwrap_or_default()
    } else {
        stem
    }
}

/// A new file whose content is first written to a temporary location. If the value is dropped without
/// [`commit`](Self::commit), the temporary file is removed.
pub trait NewFile: Write + Send {
    /// Waits until the bytes are on the disk. On some systems, only this call reports that the disk is full.
    ///
    /// # Errors
    ///
    /// Returns the error of the operating system.
    fn sync(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Moves the temporary file to the path of the new file. An existing file at this path is replaced.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the file cannot be moved. After an error, an existing file is unchanged.
    fn commit(self: Box<Self>) -> Result<(), StoreError>;
}

/// A description of a file or folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Whether the entry is a file, a folder or something else.
    pub kind: Kind,
    /// The length of a file in bytes.
    pub len: u64,
    /// The time of the last change, if known. For files in memory, this value is a counter instead of a real time, and
    /// increases with each change.
    pub modified: Option<SystemTime>,
}

/// The kind of an [`Entry`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A regular file.
    File,
    /// A folder.
    Folder,
    /// A pipe, a device or a socket.
    Other,
}

impl Entry {
    /// Whether the entry is a regular file.
    pub fn is_file(&self) -> bool {
        self.kind == Kind::File
    }
}

/// Why a file or folder could not be read or written.
#[derive(Debug, thiserror::Error)]
#[error("cannot {what} {}: {error}", path.display())]
pub struct StoreError {
    /// The action that failed: `read`, `write`, `list`, `make the folder` or `remove the folder`.
    pub what: &'static str,
    /// The file or folder.
    pub path: PathBuf,
    /// The cause, such as an error of the operating system.
    pub error: io::Error,
}

impl StoreError {
    /// Creates an error. `what` is the action that failed, such as `read`.
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

/// Returns the parent folder of `path`; `.` if the path is only a file name.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// Checks that a file can be created at the path.
fn check_target(store: &dyn Store, path: &Path) -> Result<(), StoreError> {
    let problem = match (store.is_folder(path), store.is_folder(folder_of(path))) {
        (true, _) => "a folder with this name exists",
        (_, false) => "the folder does not exist",
        _ => return Ok(()),
    };
    Err(StoreError::new("write", path, io::Error::other(problem)))
}

/// Returns the paths of all files below a folder, sorted.
///
/// # Errors
///
/// Returns [`StoreError`] if a folder cannot be listed.
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
