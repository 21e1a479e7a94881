//! The files of the machine.

use std::fs::{self, File, Permissions};
use std::io::{self, Read as _, Write};
use std::path::{Path, PathBuf};

#[cfg(unix)]
use rayon::prelude::*;
use tempfile::NamedTempFile;

use crate::{Entry, Kind, NewFile, Store, StoreError, check_place, folder_of};

/// The files of the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Disk;

impl Store for Disk {
    fn is_disk(&self) -> bool {
        true
    }

    fn read_up_to(&self, path: &Path, most: u64) -> Result<Vec<u8>, StoreError> {
        read_plain(path, most).map_err(|error| StoreError::new("read", path, error))
    }

    fn read_stream(&self, path: &Path, most: u64) -> Result<Vec<u8>, StoreError> {
        let mut bytes = Vec::new();
        match File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes)) {
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
        fs::remove_dir_all(folder).map_err(|error| StoreError::new("write", folder, error))
    }

    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
        check_place(self, path)?;
        let file = beside(path).map_err(|error| StoreError::new("write", path, error))?;
        let path = path.to_owned();
        Ok(Box::new(Begun { file, path }))
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
        fs::rename(from, to).map_err(|error| StoreError::new("write", to, error))
    }
}

/// Puts bytes in place of those of a file. A link stays a link, and who may read and write the file stays as it was.
///
/// # Errors
///
/// [`StoreError`] if the file does not exist or cannot be written. The file is then unchanged.
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

/// How the names of the temporary folders of a process begin. They remain only if the process is killed.
pub fn temporary_prefix(process: u32) -> String {
    format!(".meshwright-{process}-")
}

/// A file that waits beside its place.
struct Begun {
    file: NamedTempFile,
    path: PathBuf,
}

impl Write for Begun {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl NewFile for Begun {
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
    // A temporary file is private to its user; the file that it becomes is as open as any other.
    #[cfg(unix)]
    let open: Permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(open);
    builder
        .tempfile_in(folder_of(path))
        .map_err(without_temporary_name)
}

/// The error without the path that tempfile puts behind it: the name of a file that is gone tells a
/// person nothing.
fn without_temporary_name(error: io::Error) -> io::Error {
    match error.to_string().split_once(" at path ") {
        Some((what, _)) => io::Error::new(error.kind(), what),
        None => error,
    }
}

/// Reads at most `most` bytes of a plain file: a pipe or a device could go on for ever.
fn read_plain(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let meta = fs::metadata(path)?;
    if meta.is_dir() {
        return Err(io::Error::new(
            io::ErrorKind::IsADirectory,
            "expected a file, found a folder",
        ));
    }
    if !meta.is_file() {
        return Err(io::Error::other(
            "expected a plain file, found a pipe or a device",
        ));
    }
    let expected = usize::try_from(meta.len().min(most)).unwrap_or(usize::MAX);
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(expected)?;
    let mut file = File::open(path)?;
    #[cfg(unix)]
    if expected >= LARGE {
        drop(bytes);
        bytes = read_at_once(&file, expected)?;
        io::Seek::seek(&mut file, io::SeekFrom::Start(expected as u64))?;
    }
    // What is left: all of a small file, and what was added to a large one since it was looked at.
    let rest = most - bytes.len() as u64;
    file.take(rest).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// From this size on several threads read a file, in pieces of this size.
#[cfg(unix)]
const LARGE: usize = 1 << 20;

/// The first `n` bytes of a file, read by all threads: most of the time goes into making the pages of
/// memory that the bytes are copied to.
#[cfg(unix)]
fn read_at_once(file: &File, n: usize) -> io::Result<Vec<u8>> {
    use std::os::unix::fs::FileExt;
    let mut bytes = bytemuck::zeroed_vec(n);
    bytes
        .par_chunks_mut(LARGE)
        .enumerate()
        .try_for_each(|(i, piece)| file.read_exact_at(piece, (i * LARGE) as u64))?;
    Ok(bytes)
}
