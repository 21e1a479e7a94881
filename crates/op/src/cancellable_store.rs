//! A store that stops writing when the run is canceled.

use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use progress::Progress;
use store::{Entry, NewFile, Store, StoreError};

/// The maximum number of bytes that are written between two checks for cancellation.
const PIECE: usize = 1 << 20;

/// A store that reports progress while it writes files. If the run is canceled, the write fails.
pub struct CancellableStore<'a> {
    store: &'a dyn Store,
    progress: &'a dyn Progress,
}

impl<'a> CancellableStore<'a> {
    pub(crate) fn new(store: &'a dyn Store, progress: &'a dyn Progress) -> Self {
        Self { store, progress }
    }
}

impl fmt::Debug for CancellableStore<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("CancellableStore")
            .field(&self.store)
            .finish()
    }
}

impl Store for CancellableStore<'_> {
    fn is_disk(&self) -> bool {
        self.store.is_disk()
    }

    fn read_up_to(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        self.store.read_up_to(path, limit)
    }

    fn read_stream(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        self.store.read_stream(path, limit)
    }

    fn entry(&self, path: &Path) -> Option<Entry> {
        self.store.entry(path)
    }

    fn is_link(&self, path: &Path) -> bool {
        self.store.is_link(path)
    }

    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError> {
        self.store.canonical(path)
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
        self.store.list(folder)
    }

    fn make_folder(&self, folder: &Path) -> Result<(), StoreError> {
        self.store.make_folder(folder)
    }

    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError> {
        self.store.make_temporary(folder)
    }

    fn remove_folder(&self, folder: &Path) -> Result<(), StoreError> {
        self.store.remove_folder(folder)
    }

    fn remove_empty_folder(&self, folder: &Path) -> Result<(), StoreError> {
        self.store.remove_empty_folder(folder)
    }

    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
        Ok(Box::new(CancellableFile {
            file: self.store.create(path)?,
            progress: self.progress,
        }))
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
        self.store.rename(from, to)
    }
}

struct CancellableFile<'a> {
    file: Box<dyn NewFile + 'a>,
    progress: &'a dyn Progress,
}

impl Write for CancellableFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // The size of the file is unknown, so each report says that 0 of 1 parts are finished. This call fails if the
        // run was canceled.
        self.progress
            .report("write", 0, 1)
            .map_err(io::Error::other)?;
        self.file.write(&bytes[..bytes.len().min(PIECE)])
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl NewFile for CancellableFile<'_> {
    fn sync(&mut self) -> io::Result<()> {
        self.file.sync()
    }

    fn commit(self: Box<Self>) -> Result<(), StoreError> {
        self.file.commit()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    use store::Memory;

    use super::*;

    /// Lets the run continue at the first call of `advance`, and cancels the run at every later call.
    #[derive(Default)]
    struct Once(AtomicUsize);

    impl Progress for Once {
        fn advance(&self, _: &str, _: u64, _: u64) -> bool {
            self.0.fetch_add(1, Relaxed) == 0
        }
    }

    #[test]
    fn writing_stops_when_cancelled_and_leaves_no_file() {
        let (memory, progress) = (Memory::default(), Once::default());
        let store = CancellableStore::new(&memory, &progress);
        let written = store.write("a".as_ref(), &vec![7; 3 * PIECE]);
        assert!(written.unwrap_err().to_string().contains("cancelled"));
        assert_eq!(progress.0.into_inner(), 2);
        assert!(!memory.exists("a".as_ref()));
    }
}
