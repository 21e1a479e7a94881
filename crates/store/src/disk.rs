//! The file system of the machine.

use std::fs::{self, File};
use std::io::{self, Read as _, Write};
use std::path::{Path, PathBuf};

#[cfg(unix)]
use rayon::prelude::*;
use tempfile::NamedTempFile;

use crate::{Entry, Kind, NewFile, Store, StoreError, check_target, folder_of};

/// The file system of the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Disk;

impl Store for Disk {
    fn is_disk(&self) -> bool {
        true
    }

    fn read_up_to(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        read_plain(path, limit).map_err(|error| StoreError::new("read", path, error))
    }

    fn read_stream(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        let mut bytes = Vec::new();
        match File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes)) {
            Ok(_) => Ok(bytes),
            Err(error) => Err(StoreError::new("read", path, error)),
        }
    }

    fn entry(&self, path: &Path) -> Option<Entry> {
        let found = fs::metadata(path).ok()?;
        Some(Entry {
            kind: match (found.is_file(), found.is_dir()) {
                (true, _) => Kind::File,
                (_, true) => Kind::Folder,
                _ => Kind::Other,
            },
            len: found.len(),
            modified: found.modified().ok(),
        })
    }

    fn is_link(&self, path: &Path) -> bool {
        path.is_symlink()
    }

    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError> {
        path.canonicalize()
            .map_err(|error| StoreError::new("read", path, error))
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
        let entries = || -> io::Result<Vec<PathBuf>> {
            let entries = fs::read_dir(folder)?;
            entries.map(|entry| Ok(entry?.path())).collect()
        };
        let mut paths = entries().map_err(|error| StoreError::new("list", folder, error))?;
        paths.sort();
        Ok(paths)
    }

    fn make_folder(&self, folder: &Path) -> Result<(), StoreError> {
        fs::create_dir_all(folder)
            .map_err(|error| StoreError::new("make the folder", folder, error))
    }

    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError> {
        let system = std::env::temp_dir();
        let folder = folder.unwrap_or(&system);
        self.make_folder(folder)?;
        let made = tempfile::Builder::new()
            .prefix(&temporary_prefix(std::process::id()))
            .tempdir_in(folder);
        match made {
            Ok(made) => Ok(made.keep()),
            Err(error) => Err(StoreError::new(
                "make the folder",
                folder,
                without_temporary_name(error),
            )),
        }
    }

    fn remove_folder(&self, folder: &Path) -> Result<(), StoreError> {
        // `remove_dir_all` fails, for example, if too many files are open. After a failure, `remove_all` is tried,
        // which needs fewer file descriptors.
        fs::remove_dir_all(folder)
            .or_else(|_| remove_all(folder))
            .map_err(|error| StoreError::new("remove the folder", folder, error))
    }

    fn remove_empty_folder(&self, folder: &Path) -> Result<(), StoreError> {
        fs::remove_dir(folder).map_err(|error| StoreError::new("remove the folder", folder, error))
    }

    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
        check_target(self, path)?;
        let file = beside(path).map_err(|error| StoreError::new("write", path, error))?;
        let path = path.to_owned();
        Ok(Box::new(UnfinishedFile { file, path }))
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
        fs::rename(from, to).map_err(|error| StoreError::new("write", to, error))
    }
}

/// Removes a folder with its content, like [`fs::remove_dir_all`], but with few file descriptors. Each folder
/// is listed and closed before the next one is opened, and empty folders are not opened.
fn remove_all(folder: &Path) -> io::Result<()> {
    if fs::remove_dir(folder).is_ok() {
        return Ok(());
    }
    let entries: Vec<_> = fs::read_dir(folder)?.collect::<Result<_, _>>()?;
    let paths: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).collect();
    for path in paths {
        if fs::symlink_metadata(&path)?.is_dir() {
            remove_all(&path)?;
        } else {
            fs::remove_file(&path)?;
        }
    }
    fs::remove_dir(folder)
}

/// Replaces the content of a file. If the path is a link, the link is kept, and the file that the link points to is
/// replaced. The permissions of the file are kept.
///
/// # Errors
///
/// Returns [`StoreError`] if the file does not exist or cannot be written. After an error, the file is unchanged.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    let replaced = || -> io::Result<()> {
        let real = path.canonicalize()?;
        let mut new = beside(&real)?;
        new.write_all(bytes)?;
        new.as_file().sync_all()?;
        new.as_file()
            .set_permissions(fs::metadata(&real)?.permissions())?;
        new.persist(&real)?;
        Ok(())
    };
    replaced().map_err(|error| StoreError::new("write", path, error))
}

/// Returns the text with which the names of all temporary folders of a process begin. A temporary folder remains after
/// the end of the process only if the process is killed or the folder cannot be removed.
pub fn temporary_prefix(process: u32) -> String {
    format!(".meshwright-{process}-")
}

/// A temporary file. When the temporary file is committed, it replaces the file at `path`.
struct UnfinishedFile {
    file: NamedTempFile,
    path: PathBuf,
}

impl Write for UnfinishedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl NewFile for UnfinishedFile {
    fn sync(&mut self) -> io::Result<()> {
        self.file.as_file().sync_all()
    }

    fn commit(self: Box<Self>) -> Result<(), StoreError> {
        let Self { file, path } = *self;
        match file.persist(&path) {
            Ok(_) => Ok(()),
            Err(failed) => Err(StoreError::new("write", &path, failed.error)),
        }
    }
}

fn beside(path: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".meshwright-");
    // By default, only the user can access a temporary file. This temporary file is later renamed to a normal file, so
    // it gets the permissions of a normal file.
    #[cfg(unix)]
    let open: fs::Permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(open);
    builder
        .tempfile_in(folder_of(path))
        .map_err(without_temporary_name)
}

/// Removes the path of the temporary file, which `tempfile` appends to the message of an error. The path does not help
/// the user, because the temporary file no longer exists.
fn without_temporary_name(error: io::Error) -> io::Error {
    match error.to_string().split_once(" at path ") {
        Some((what, _)) => io::Error::new(error.kind(), what),
        None => error,
    }
}

/// Reads at most `limit` bytes of a regular file. Pipes and devices are refused, because reading them might never end.
fn read_plain(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let meta = fs::metadata(path)?;
    if meta.is_dir() {
        return Err(io::Error::new(
            io::ErrorKind::IsADirectory,
            "expected a file, found a folder",
        ));
    }
    if !meta.is_file() {
        return Err(io::Error::other(
            "expected a regular file, found a pipe or a device",
        ));
    }
    let expected = usize::try_from(meta.len().min(limit)).unwrap_or(usize::MAX);
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(expected)?;
    let file = File::open(path)?;
    #[cfg(unix)]
    if expected >= LARGE {
        drop(bytes);
        bytes = read_at_once(&file, expected)?;
        io::Seek::seek(&mut &file, io::SeekFrom::Start(expected as u64))?;
    }
    // Reads the remaining bytes. For a small file, these are all bytes. For a large file, these are the bytes that were
    // appended after the size of the file was determined.
    let rest = limit - bytes.len() as u64;
    file.take(rest).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Files of at least this size are read by several threads, in pieces of this size.
#[cfg(unix)]
const LARGE: usize = 1 << 20;

/// Reads the first `n` bytes of a file on all threads. Several threads are faster, because most of the time is spent on
/// page faults in the new memory.
#[cfg(unix)]
fn read_at_once(file: &File, n: usize) -> io::Result<Vec<u8>> {
    use std::os::unix::fs::FileExt;
    let mut bytes = bytemuck::try_zeroed_vec(n).map_err(|()| io::ErrorKind::OutOfMemory)?;
    bytes
        .par_chunks_mut(LARGE)
        .enumerate()
        .try_for_each(|(i, piece)| file.read_exact_at(piece, (i * LARGE) as u64))?;
    Ok(bytes)
}
