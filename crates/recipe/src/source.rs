//! The sources of a recipe: the text of the recipe itself, and the text of each recipe that it calls.

use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use ron_tree::MAX_BYTES;
use store::{Disk, Store, StoreError};

/// Why the text of a recipe could not be loaded from a file.
#[derive(Debug, thiserror::Error)]
pub enum SourceError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] StoreError),
    /// The text is longer than the maximum length of a recipe.
    #[error("{}: the recipe is larger than {} MiB", .0.display(), MAX_BYTES >> 20)]
    TooLong(PathBuf),
    /// The bytes of the file are not UTF-8 text.
    #[error("{}:{line}: the recipe is not UTF-8 text", path.display())]
    NotUtf8 {
        /// The path of the file.
        path: PathBuf,
        /// The number of the first line that is not UTF-8 text. Lines are counted from 1.
        line: usize,
    },
}

/// A text, together with the path of its file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// The path of the file in the form in which messages show it. Paths in the text are relative to the folder of this
    /// file.
    pub path: PathBuf,
    /// The text of the file.
    pub text: Arc<str>,
}

impl Source {
    /// Creates a source from a text. The file `path` is not read.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<Arc<str>>) -> Self {
        Self {
            path: path.into(),
            text: text.into(),
        }
    }

    /// Reads a file from disk. See [`open_in`](Self::open_in).
    ///
    /// # Errors
    ///
    /// Returns the errors of [`open_in`](Self::open_in).
    pub fn open(path: &Path) -> Result<Self, SourceError> {
        Self::open_in(&Disk, path)
    }

    /// Reads a file. Reading stops as soon as the file exceeds the maximum length of a recipe.
    ///
    /// # Errors
    ///
    /// Returns [`SourceError`] if the file cannot be read, is too long, or is not UTF-8 text.
    pub fn open_in(store: &dyn Store, path: &Path) -> Result<Self, SourceError> {
        let bytes = store.read_stream(path, MAX_BYTES as u64 + 1)?;
        Self::from_bytes(path, bytes)
    }

    /// Creates a source from the bytes of a text. The file `path` is not read.
    ///
    /// # Errors
    ///
    /// Returns [`SourceError`] if the text is too long or is not UTF-8 text.
    pub fn from_bytes(path: &Path, bytes: Vec<u8>) -> Result<Self, SourceError> {
        if bytes.len() > MAX_BYTES {
            return Err(SourceError::TooLong(path.to_owned()));
        }
        let text = String::from_utf8(bytes).map_err(|error| {
            let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = String::from_utf8_lossy(before).matches('\n').count() + 1;
            SourceError::NotUtf8 {
                path: path.to_owned(),
                line,
            }
        })?;
        Ok(Self::new(path, text))
    }

    /// Returns the folder that contains the file.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }
}

/// Converts a path relative to the folder `from` into a path relative to the folder `to` that leads to the same file.
/// The result is absolute if `text` is absolute. The result is also absolute if, because of links, a relative path
/// would lead to another file.
pub(crate) fn rebase_path(store: &dyn Store, text: &str, from: &Path, to: &Path) -> PathBuf {
    let (Ok(target), Ok(to)) = (
        std::path::absolute(from.join(text)),
        std::path::absolute(to),
    ) else {
        return from.join(text);
    };
    if Path::new(text).is_absolute() {
        return target;
    }
    // If `a` is a link to a folder, `a/..` does not lead to the folder that contains the link. Therefore, the links in
    // both paths are resolved before the paths are compared.
    let is_same = |relative: &PathBuf| {
        let (rebased, original) = (
            store.canonical(&to.join(relative)),
            store.canonical(&target),
        );
        rebased.ok() == original.ok()
    };
    match pathdiff::diff_paths(normalized(&target), normalized(&to)) {
        Some(relative) if is_same(&relative) => relative,
        _ => target,
    }
}

/// Converts an absolute path to a path relative to `folder`. Returns `None` if the path does not begin with the path of
/// the folder.
pub(crate) fn below(path: &Path, folder: &Path) -> Option<PathBuf> {
    let absolute = if folder.has_root() {
        folder.to_owned()
    } else {
        // If a file is given only by its name, its folder is "", which stands for the working directory.
        std::path::absolute(Path::new(".").join(folder)).ok()?
    };
    path.strip_prefix(absolute).ok().map(Path::to_owned)
}

/// Removes `..` from a path: `a/../b` becomes `b`. The result is correct only if no folder in the path is a link.
fn normalized(path: &Path) -> PathBuf {
    let mut normalized = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => _ = normalized.pop(),
            part => normalized.push(part),
        }
    }
    normalized
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_rewritten_from_one_folder_to_another() {
        let rebased = |text, from, to| rebase_path(&Disk, text, Path::new(from), Path::new(to));
        assert_eq!(rebased("cow.obj", "/a/b", "/a/b"), Path::new("cow.obj"));
        assert_eq!(
            rebased("cow.obj", "/a/b", "/a/c"),
            Path::new("../b/cow.obj")
        );
        assert_eq!(rebased("../cow.obj", "a/b", "a"), Path::new("cow.obj"));
        assert_eq!(rebased("/x/cow.obj", "/a/b", "/a"), Path::new("/x/cow.obj"));
        assert_eq!(rebased("cow.obj", "", "lib"), Path::new("../cow.obj"));
    }

    #[test]
    #[cfg(unix)]
    fn the_path_out_of_a_linked_folder_is_absolute() {
        let root = tempfile::tempdir().unwrap();
        let at = |name: &str| root.path().join(name);
        std::fs::create_dir_all(at("far/away")).unwrap();
        std::os::unix::fs::symlink(at("far/away"), at("lib")).unwrap();
        std::fs::write(at("cow.obj"), "").unwrap();
        assert_eq!(
            rebase_path(&Disk, "cow.obj", root.path(), &at("lib")),
            at("cow.obj"),
            "lib/../cow.obj would be far/cow.obj"
        );
    }

    #[test]
    fn a_file_that_is_not_utf_8_is_refused_with_the_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ron");
        std::fs::write(&path, b"(\n\xff)").unwrap();
        let error = Source::open(&path).unwrap_err().to_string();
        assert!(
            error.ends_with("a.ron:2: the recipe is not UTF-8 text"),
            "{error}"
        );
        assert!(Source::open(&folder.path().join("b.ron")).is_err());
    }

    #[test]
    fn a_file_that_is_too_large_is_not_read_completely() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ron");
        let file = std::fs::File::create(&path).unwrap();
        file.set_len(1 << 40).unwrap();
        let error = Source::open(&path).unwrap_err().to_string();
        assert!(
            error.ends_with("the recipe is larger than 64 MiB"),
            "{error}"
        );
    }
}
