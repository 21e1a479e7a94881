//! The texts of a recipe: its own, and those of the recipes that it calls.

use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use ron_tree::MAX_BYTES;
use store::{Disk, Store};

/// A text and the file that it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// The file, as it is shown; relative paths in the text are seen from its folder.
    pub path: PathBuf,
    /// The text.
    pub text: Arc<str>,
}

impl Source {
    /// A text that is said to stand in the file `path`.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<Arc<str>>) -> Self {
        Self {
            path: path.into(),
            text: text.into(),
        }
    }

    /// Reads a file of the disk, as [`open_in`](Self::open_in) does.
    ///
    /// # Errors
    ///
    /// As [`open_in`](Self::open_in).
    pub fn open(path: &Path) -> Result<Self, String> {
        Self::open_in(&Disk, path)
    }

    /// Reads a file. No more of it is read than a recipe may be long.
    ///
    /// # Errors
    ///
    /// A message with the path, if the file cannot be read, is too long, or is not UTF-8 text.
    pub fn open_in(store: &dyn Store, path: &Path) -> Result<Self, String> {
        let shown = path.display();
        let bytes = store.read_stream(path, MAX_BYTES as u64 + 1);
        let bytes = bytes.map_err(|error| error.to_string())?;
        if bytes.len() > MAX_BYTES {
            let mebibytes = MAX_BYTES >> 20;
            return Err(format!(
                "{shown}: a recipe of more than {mebibytes} MiB is not read"
            ));
        }
        let text = String::from_utf8(bytes).map_err(|error| {
            let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = String::from_utf8_lossy(before).matches('\n').count() + 1;
            format!("{shown}:{line}: the recipe is not UTF-8 text")
        })?;
        Ok(Self::new(path, text))
    }

    /// The folder of the file.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }
}

/// The file that `text` names in `from`, as a path that names it in `to`: relative if `text` is, so that
/// a recipe means the same wherever its folders stand.
pub(crate) fn seen_from(store: &dyn Store, text: &str, from: &Path, to: &Path) -> PathBuf {
    let (Ok(target), Ok(to)) = (
        std::path::absolute(from.join(text)),
        std::path::absolute(to),
    ) else {
        return from.join(text);
    };
    if Path::new(text).is_absolute() {
        return target;
    }
    // The way up from a folder that is a link leads elsewhere than its name says.
    let is_same = |relative: &PathBuf| {
        let (there, here) = (
            store.canonical(&to.join(relative)),
            store.canonical(&target),
        );
        there.ok() == here.ok()
    };
    match pathdiff::diff_paths(without_ways_up(&target), without_ways_up(&to)) {
        Some(relative) if is_same(&relative) => relative,
        _ => target,
    }
}

/// The path that `a/../b` means if `a` is no link.
fn without_ways_up(path: &Path) -> PathBuf {
    let mut clean = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => _ = clean.pop(),
            part => clean.push(part),
        }
    }
    clean
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_led_from_one_folder_to_another() {
        let seen = |text, from, to| seen_from(&Disk, text, Path::new(from), Path::new(to));
        assert_eq!(seen("cow.obj", "/a/b", "/a/b"), Path::new("cow.obj"));
        assert_eq!(seen("cow.obj", "/a/b", "/a/c"), Path::new("../b/cow.obj"));
        assert_eq!(seen("../cow.obj", "a/b", "a"), Path::new("cow.obj"));
        assert_eq!(seen("/x/cow.obj", "/a/b", "/a"), Path::new("/x/cow.obj"));
        assert_eq!(seen("cow.obj", "", "lib"), Path::new("../cow.obj"));
    }

    #[test]
    #[cfg(unix)]
    fn the_way_out_of_a_linked_folder_is_not_taken_by_name() {
        let root = tempfile::tempdir().unwrap();
        let at = |name: &str| root.path().join(name);
        std::fs::create_dir_all(at("far/away")).unwrap();
        std::os::unix::fs::symlink(at("far/away"), at("lib")).unwrap();
        std::fs::write(at("cow.obj"), "").unwrap();
        assert_eq!(
            seen_from(&Disk, "cow.obj", root.path(), &at("lib")),
            at("cow.obj"),
            "lib/../cow.obj would be far/cow.obj"
        );
    }

    #[test]
    fn what_is_no_text_is_refused_with_its_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ron");
        std::fs::write(&path, b"(\n\xff)").unwrap();
        let error = Source::open(&path).unwrap_err();
        assert!(
            error.ends_with("a.ron:2: the recipe is not UTF-8 text"),
            "{error}"
        );
        assert!(Source::open(&folder.path().join("b.ron")).is_err());
    }

    #[test]
    fn a_file_that_is_too_long_is_not_read_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ron");
        let file = std::fs::File::create(&path).unwrap();
        file.set_len(1 << 40).unwrap();
        let error = Source::open(&path).unwrap_err();
        assert!(
            error.ends_with("a recipe of more than 64 MiB is not read"),
            "{error}"
        );
    }
}
