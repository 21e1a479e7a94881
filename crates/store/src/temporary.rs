//! Temporary folders that are removed automatically.

use std::path::{Path, PathBuf};

use crate::{Store, StoreError};

/// A folder that is removed with its content when this value is dropped. Afterwards, the parent folders that were
/// created together with this folder are removed if they are empty.
#[derive(Debug)]
pub struct TemporaryFolder<'s> {
    store: &'s dyn Store,
    path: PathBuf,
    /// The parent folders that were created together with this folder, from the innermost to the outermost.
    parents: Vec<PathBuf>,
}

impl<'s> TemporaryFolder<'s> {
    /// Creates a folder with a new name, as [`Store::make_temporary`] does.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the folder cannot be created.
    pub fn new(store: &'s dyn Store, inside: Option<&Path>) -> Result<Self, StoreError> {
        let missing = inside.into_iter().flat_map(Path::ancestors);
        let missing =
            missing.take_while(|folder| !folder.as_os_str().is_empty() && !store.exists(folder));
        let parents = missing.map(Path::to_path_buf).collect();
        // Another process can remove the folder `inside` while this folder is empty. If the first attempt fails for
        // this reason, the second attempt also creates the folder `inside` again.
        let path = store
            .make_temporary(inside)
            .or_else(|_| store.make_temporary(inside))?;
        Ok(Self {
            store,
            path,
            parents,
        })
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for TemporaryFolder<'_> {
    fn drop(&mut self) {
        // If the removal fails, the error is ignored and the folder remains.
        let _ = self.store.remove_folder(&self.path);
        for parent in &self.parents {
            if self.store.remove_empty_folder(parent).is_err() {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Disk, Memory};

    #[test]
    fn created_parents_are_removed_if_they_are_empty() {
        let folder = tempfile::tempdir().unwrap();
        for (store, root) in [
            (&Disk as &dyn Store, folder.path()),
            (&Memory::default(), Path::new("root")),
        ] {
            store.make_folder(&root.join("old")).unwrap();
            let [inner, old] = ["old/a/b", "old"].map(|path| root.join(path));
            drop(TemporaryFolder::new(store, Some(&inner)).unwrap());
            assert!(!store.exists(&root.join("old/a")));
            // An empty folder that existed before is kept.
            drop(TemporaryFolder::new(store, Some(&old)).unwrap());
            assert!(store.is_folder(&old));
            // A parent folder that contains a file is kept.
            let temporary = TemporaryFolder::new(store, Some(&inner)).unwrap();
            store.write(&root.join("old/a/file"), b"").unwrap();
            drop(temporary);
            assert!(store.is_folder(&root.join("old/a")));
            assert!(!store.exists(&inner));
        }
    }
}
