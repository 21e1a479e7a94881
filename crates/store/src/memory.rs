//! Files that exist as long as the program.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};
use std::time::{Duration, SystemTime};

use crate::{Entry, Kind, NewFile, Store, StoreError, folder_of};

/// Files that exist as long as this does. The working directory is the root, `..` leads up by name, and there are no
/// links.
#[derive(Debug, Default)]
pub struct Memory(RwLock<Content>);

#[derive(Debug, Default)]
struct Content {
    entries: BTreeMap<PathBuf, Stored>,
    /// How many files and folders were written so far.
    n_written: u64,
}

#[derive(Clone, Debug)]
struct Stored {
    /// `None` for a folder.
    bytes: Option<Arc<[u8]>>,
    /// The number of its writing.
    written: u64,
}

impl Memory {
    fn content(&self) -> RwLockReadGuard<'_, Content> {
        // Each change is one insertion or removal, so the map is whole even after a panic.
        self.0.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self) -> RwLockWriteGuard<'_, Content> {
        self.0.write().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Content {
    fn get(&self, path: &Path) -> Option<&Stored> {
        self.entries.get(&plain(path))
    }

    fn insert(&mut self, path: &Path, bytes: Option<Arc<[u8]>>) {
        self.n_written += 1;
        let written = self.n_written;
        self.entries.insert(plain(path), Stored { bytes, written });
    }
}

/// The path below the root.
fn plain(path: &Path) -> PathBuf {
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
    fn read_up_to(&self, path: &Path, most: u64) -> Result<Vec<u8>, StoreError> {
        let read = match self.content().get(path) {
            Some(Stored { bytes: None, .. }) => Err(io::Error::new(
                io::ErrorKind::IsADirectory,
                "expected a file, found a folder",
            )),
            Some(Stored {
                bytes: Some(bytes), ..
            }) => {
                let n = usize::try_from(most).map_or(bytes.len(), |most| most.min(bytes.len()));
                Ok(bytes[..n].to_vec())
            }
            None => Err(missing()),
        };
        read.map_err(|error| StoreError::read(path, error))
    }

    fn entry(&self, path: &Path) -> Option<Entry> {
        let content = self.content();
        let folder = Entry {
            kind: Kind::Folder,
            len: 0,
            modified: None,
        };
        let Some(stored) = content.get(path) else {
            return plain(path).as_os_str().is_empty().then_some(folder);
        };
        let modified = SystemTime::UNIX_EPOCH + Duration::from_nanos(stored.written);
        Some(match &stored.bytes {
            None => folder,
            Some(bytes) => Entry {
                kind: Kind::File,
                len: bytes.len() as u64,
                modified: Some(modified),
            },
        })
    }

    fn is_link(&self, _: &Path) -> bool {
        false
    }

    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError> {
        if self.exists(path) {
            Ok(plain(path))
        } else {
            Err(StoreError::read(path, missing()))
        }
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
        if !self.is_folder(folder) {
            return Err(StoreError::list(folder, missing()));
        }
        let content = self.content();
        let inside = plain(folder);
        let here = content.entries.keys();
        let here = here.filter(|path| path.parent() == Some(&inside));
        let names = here.filter_map(|path| path.file_name());
        Ok(names.map(|name| folder.join(name)).collect())
    }

    fn make_folder(&self, folder: &Path) -> Result<(), StoreError> {
        let mut content = self.change();
        for folder in plain(folder).ancestors() {
            match content.get(folder) {
                _ if folder.as_os_str().is_empty() => {}
                Some(Stored { bytes: None, .. }) => {}
                Some(_) => {
                    let error = io::Error::other("a file of this name is there");
                    return Err(StoreError::folder(folder, error));
                }
                None => content.insert(folder, None),
            }
        }
        Ok(())
    }

    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError> {
        let folder = folder.unwrap_or(Path::new(""));
        let path = loop {
            let n = {
                let mut content = self.change();
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
        let folder = plain(folder);
        let entries = &mut self.change().entries;
        entries.retain(|path, _| !path.starts_with(&folder));
        Ok(())
    }

    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
        let problem = match (self.is_folder(path), self.is_folder(folder_of(path))) {
            (true, _) => "a folder of this name is there",
            (_, false) => "there is no such folder",
            _ => {
                return Ok(Box::new(Begun {
                    store: self,
                    path: path.to_owned(),
                    bytes: Vec::new(),
                }));
            }
        };
        Err(StoreError::write(path, io::Error::other(problem)))
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
        let mut content = self.change();
        let (from, new) = (plain(from), plain(to));
        match content.entries.remove(&from) {
            Some(stored) => _ = content.entries.insert(new, stored),
            None => return Err(StoreError::write(to, missing())),
        }
        Ok(())
    }
}

struct Begun<'s> {
    store: &'s Memory,
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Write for Begun<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bytes.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl NewFile for Begun<'_> {
    fn commit(self: Box<Self>) -> Result<(), StoreError> {
        let bytes = self.bytes.into();
        self.store.change().insert(&self.path, Some(bytes));
        Ok(())
    }
}
