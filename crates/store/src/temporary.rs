//! Folders that go when nobody needs them any more.

use std::path::{Path, PathBuf};

use crate::{Store, StoreError};

/// A folder that is removed with everything in it when this is dropped.
#[derive(Debug)]
pub struct TemporaryFolder<'s> {
    store: &'s dyn Store,
    path: PathBuf,
}

impl<'s> TemporaryFolder<'s> {
    /// Makes a folder of a new name, as [`Store::make_temporary`] does.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if that cannot be done.
    pub fn new(store: &'s dyn Store, inside: Option<&Path>) -> Result<Self, StoreError> {
        let path = store.make_temporary(inside)?;
        Ok(Self { store, path })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for TemporaryFolder<'_> {
    fn drop(&mut self) {
        // Removal is best effort.
        let _ = self.store.remove_folder(&self.path);
    }
}
