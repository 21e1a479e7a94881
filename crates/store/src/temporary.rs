//! Temporary folders that are removed automatically.

use std::path::{Path, PathBuf};

use crate::{Store, StoreError};

/// A folder that is removed with its content when this value is dropped.
#[derive(Debug)]
pub struct TemporaryFolder<'s> {
    store: &'s dyn Store,
    path: PathBuf,
}

impl<'s> TemporaryFolder<'s> {
    /// Creates a folder with a new name, as [`Store::make_temporary`] does.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if the folder cannot be created.
    pub fn new(store: &'s dyn Store, inside: Option<&Path>) -> Result<Self, StoreError> {
        let path = store.make_temporary(inside)?;
        Ok(Self { store, path })
    }

    /// Returns the path of the folder.
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
