//! Files that only exist in memory.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};

use crate::{Entry, Kind, NewFile, Store, StoreError, check_target};

/// Files that exist until this value is dropped. The working directory is the root. A `..` in a path removes the folder
/// name before it. The store contains no links.
#[derive(Debug, Default)]
pub struct Memory(Mutex<Content>);

#[derive(Debug, Default)]
struct Content {
    entries: BTreeMap<PathBuf, (Entry, Arc<[u8]>)>,
    /// A counter that increases with each file or folder that is written.
    n_written: u64,
}

impl Memory {
    /// Removes a file, or a folder with everything in it. If the path does not exist, does nothing.
    pub fn remove(&self, path: &Path) {
        let path = normalized(path);
        (self.content().entries).retain(|inside, _| !inside.starts_with(&path));
    }

    fn content(&self) -> MutexGuard<'_, Content> {
        // If another thread has panicked while it held the lock, the entries can still be used, because each entry is
        // valid by itself.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Content {
    fn insert(&mut self, path: PathBuf, kind: Kind, bytes: Arc<[u8]>) {
        self.n_written += 1;
        let entry = Entry {
            kind,
            len: bytes.len() as u64,
            modified: Some(SystemTime::UNIX_EPOCH + Duration::from_nanos(self.n_written)),
        };
        self.entries.insert(path, (entry, bytes));
    }
}

/// Returns the path relative to the root, without `.` and `..`.
fn normalized(path: &Path) -> PathBuf {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => _ = parts.pop(),
            Component::Normal(name) => parts.push(name),
            Component::CurDir | Component::RootDir | Component::Prefix(_) => {}
        }
    }
    parts
}

fn missing() -> io::Error {
    io::ErrorKind::NotFound.into()
}

impl Store for Memory {
    fn read_up_to(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        let read = match self.content().entries.get(&normalized(path)) {
            Some((entry, bytes)) if entry.is_file() => {
                let n = usize::try_from(limit).map_or(bytes.len(), |limit| limit.min(bytes.len()));
                Ok(bytes[..n].to_vec())
            }
            Some(_) => Err(io::Error::new(
                io::ErrorKind::IsADirectory,
                "expected a file, found a folder",
            )),
            None => Err(missing()),
        };
        read.map_err(|error| StoreError::new("read", path, error))
    }

    fn entry(&self, path: &Path) -> Option<Entry> {
        let path = normalized(path);
        let root = Entry {
            kind: Kind::Folder,
            len: 0,
            modified: None,
        };
        let found = self.content().entries.get(&path).map(|(entry, _)| *entry);
        found.or(path.as_os_str().is_empty().then_some(root))
    }

    fn is_link(&self, _: &Path) -> bool {
        false
    }

    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError> {
        if self.exists(path) {
            Ok(normalized(path))
        } else {
            Err(StoreError::new("read", path, missing()))
        }
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
        if !self.is_folder(folder) {
            return Err(StoreError::new("list", folder, missing()));
        }
        let content = self.content();
        let inside = normalized(folder);
        let here = content.entries.keys();
        let here = here.filter(|path| path.parent() == Some(&inside));
        let names = here.filter_map(|path| path.file_name());
        Ok(names.map(|name| folder.join(name)).collect())
    }

    fn make_folder(&self, folder: &Path) -> Result<(), StoreError> {
        let path = normalized(folder);
        for folder in path.ancestors() {
            match self.entry(folder).map(|entry| entry.kind) {
                Some(Kind::Folder) => {}
                Some(_) => {
                    let error = io::Error::other("a file with this name exists");
                    return Err(StoreError::new("make the folder", folder, error));
                }
                None => (self.content()).insert(folder.to_owned(), Kind::Folder, Arc::default()),
            }
        }
        Ok(())
    }

    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError> {
        let folder = folder.unwrap_or(Path::new(""));
        let path = loop {
            let n = {
                let mut content = self.content();
                content.n_written += 1;
                content.n_written
            };
            let path = folder.join(format!(".meshwright-{n}-"));
            if !self.exists(&path) {
                break path;
            }
        };
        self.make_folder(&path)?;
        Ok(path)
    }

    fn remove_folder(&self, folder: &Path) -> Result<(), StoreError> {
        self.remove(folder);
        Ok(())
    }

    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
        check_target(self, path)?;
        Ok(Box::new(UnfinishedFile {
            store: self,
            path: path.to_owned(),
            bytes: Vec::new(),
        }))
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
        let mut content = self.content();
        let stored = content.entries.remove(&normalized(from));
        let stored = stored.ok_or_else(|| StoreError::new("write", to, missing()))?;
        content.entries.insert(normalized(to), stored);
        Ok(())
    }
}

struct UnfinishedFile<'s> {
    store: &'s Memory,
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Write for UnfinishedFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bytes.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl NewFile for UnfinishedFile<'_> {
    fn commit(self: Box<Self>) -> Result<(), StoreError> {
        let bytes = self.bytes.into();
        let mut content = self.store.content();
        content.insert(normalized(&self.path), Kind::File, bytes);
        Ok(())
    }
}
