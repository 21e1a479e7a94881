//! Gives access to the files that a model file refers to, such as images. They must be inside the folder of the model
//! file.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use store::{Store, StoreError, folder_of};

/// Resolves a path that must stay inside a folder. The path must be relative and must not name a drive. The path can
/// contain `..` if the result is inside the folder.
///
/// # Errors
///
/// Returns the reason why the path is refused, for example `is empty`. The caller puts the path before the reason.
pub(crate) fn inside(name: &str) -> Result<PathBuf, &'static str> {
    if name.is_empty() {
        return Err("is empty");
    }
    if name.starts_with('/') || name.starts_with('\\') {
        return Err("is absolute, expected a path inside the folder of the file");
    }
    let mut parts = Vec::new();
    for part in name.split(['/', '\\']) {
        match part {
            "" | "." => {}
            ".." => {
                if parts.pop().is_none() {
                    return Err("leads out of the folder of the file");
                }
            }
            // A path with a colon is refused. The colon can belong to a drive (`C:`), a scheme (`file:`), or a named
            // stream of a file on Windows.
            _ if part.contains(':') => return Err("names a drive or a scheme"),
            _ if part.contains(char::is_control) => return Err("has control characters"),
            _ => parts.push(part),
        }
    }
    if parts.is_empty() {
        Err("does not name a file")
    } else {
        Ok(parts.iter().collect())
    }
}

/// Like [`inside`], but for a URI reference in glTF, in which bytes can be percent-encoded.
///
/// # Errors
///
/// Returns the reason why the URI is refused, for example `has a backslash`. The caller puts the URI before the reason.
pub(crate) fn inside_uri(uri: &str) -> Result<PathBuf, &'static str> {
    if uri.contains('\\') {
        return Err("has a backslash");
    }
    if uri.contains(['?', '#']) {
        return Err("has a query or a fragment");
    }
    let mut decoded = Vec::new();
    for segment in uri.split('/') {
        let part = percent_decoded(segment).ok_or("has an invalid percent-encoding")?;
        // The path is split at `/` before its segments are decoded, so an encoded `/` does not split the path.
        if part.contains(['/', '\\']) || (part != segment && (part == "." || part == "..")) {
            return Err("has a percent-encoded separator or dot segment");
        }
        decoded.push(part);
    }
    inside(&decoded.join("/"))
}

/// Decodes the percent-encoded bytes of a part of a URI; `None` if the encoding is not valid.
pub(crate) fn percent_decoded(segment: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(segment.len());
    let mut rest = segment.as_bytes();
    while let [first, tail @ ..] = rest {
        if *first == b'%' {
            let [high, low, after @ ..] = tail else {
                return None;
            };
            bytes.push(16 * hex(*high)? + hex(*low)?);
            rest = after;
        } else {
            bytes.push(*first);
            rest = tail;
        }
    }
    String::from_utf8(bytes).ok()
}

fn hex(digit: u8) -> Option<u8> {
    char::from(digit)
        .to_digit(16)
        .and_then(|value| u8::try_from(value).ok())
}

/// Encodes a file name as a URI reference (RFC 3986). Only unreserved characters stay as they are; all other characters
/// are percent-encoded.
pub(crate) fn percent_encoded(name: &str) -> String {
    let encode = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
            char::from(byte).to_string()
        }
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(encode).collect()
}

/// A file that can change the result of reading a model.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileDependency {
    /// The path of the file.
    pub path: PathBuf,
    /// True if the program tried to read the file, even if the file is missing. False if the program only checked
    /// whether the file exists.
    pub is_read: bool,
}

/// Opens the files that the model file refers to, and records which files were opened. The model file is the file that
/// the caller asked to read or write.
pub(crate) struct Assets<'a> {
    store: &'a dyn Store,
    /// The path of the model file.
    pub(crate) path: &'a Path,
    /// The reader looks for images first in these folders, and then in the folder of the model file. The paths of these
    /// folders are relative to the folder of the model file.
    pub(crate) image_folders: Vec<PathBuf>,
    seen: BTreeSet<FileDependency>,
}

impl<'a> Assets<'a> {
    pub(crate) fn of(store: &'a dyn Store, path: &'a Path) -> Self {
        Self {
            store,
            path,
            image_folders: Vec::new(),
            seen: BTreeSet::new(),
        }
    }

    /// Appends a path that was returned by [`inside`] or [`inside_uri`] to the folder of the model file.
    pub(crate) fn place(&self, name: &Path) -> PathBuf {
        folder_of(self.path).join(name)
    }

    /// Whether the file exists.
    pub(crate) fn has(&mut self, name: &Path) -> bool {
        let path = self.place(name);
        let exists = self.store.is_file(&path);
        self.seen.insert(FileDependency {
            path,
            is_read: false,
        });
        exists
    }

    /// Reads at most `limit` bytes of a file.
    ///
    /// # Errors
    ///
    /// Returns an error if the file is missing or is not a regular file. Also returns an error if a link in its path
    /// leads out of the folder of the model file.
    pub(crate) fn read(&mut self, name: &Path, limit: u64) -> io::Result<Vec<u8>> {
        let path = self.place(name);
        self.seen.insert(FileDependency {
            path: path.clone(),
            is_read: true,
        });
        let because = |error: StoreError| error.error;
        let real = self.store.canonical(&path).map_err(because)?;
        let folder = self
            .store
            .canonical(folder_of(self.path))
            .map_err(because)?;
        if !real.starts_with(folder) {
            return Err(io::Error::other(
                "a link in the path leads out of the folder of the file",
            ));
        }
        self.store.read_up_to(&real, limit).map_err(because)
    }

    /// The files that were read, or whose existence was checked, sorted by path.
    pub(crate) fn into_files(self) -> Vec<FileDependency> {
        self.seen.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_that_stay_inside_are_accepted() {
        assert_eq!(inside("a.mtl"), Ok(PathBuf::from("a.mtl")));
        assert_eq!(inside("./sub//../a b.mtl"), Ok(PathBuf::from("a b.mtl")));
        assert_eq!(inside("sub\\a.mtl"), Ok(PathBuf::from("sub/a.mtl")));
        assert_eq!(
            inside_uri("sub/a%20b.bin"),
            Ok(PathBuf::from("sub/a b.bin"))
        );
    }

    #[test]
    fn paths_that_leave_the_folder_are_refused() {
        for name in [
            "",
            ".",
            "/etc/passwd",
            "\\x",
            "../a",
            "a/../../b",
            "C:\\a",
            "C:a",
            "a\0b",
        ] {
            assert!(inside(name).is_err(), "{name}");
        }
    }

    #[test]
    fn uris_that_disguise_a_path_out_of_the_folder_are_refused() {
        for uri in [
            "file:///etc/passwd",
            "http://example.com/a.bin",
            "../a.bin",
            "%2e%2e/a.bin",
            "..%2Fa.bin",
            "a%5cb.bin",
            "%2Fetc/passwd",
            "a%00.bin",
            "a%zz.bin",
            "a%2",
            "a%ff.bin",
            "a\\b.bin",
            "C:/a.bin",
            "file%3A/a.bin",
            "a.bin?x",
        ] {
            assert!(inside_uri(uri).is_err(), "{uri}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_folder_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        std::fs::write(folder.path().join("secret"), "x").unwrap();
        std::os::unix::fs::symlink("../secret", inner.join("link")).unwrap();
        std::fs::write(inner.join("plain"), "yes").unwrap();

        let path = inner.join("a.gltf");
        let mut assets = Assets::of(&store::Disk, &path);
        assert!(assets.read(Path::new("link"), 9).is_err());
        assert_eq!(assets.read(Path::new("plain"), 2).unwrap(), b"ye");
    }
}
