//! Paths inside a file that was read: they must stay inside the folder of that file.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

#[cfg(unix)]
use rayon::prelude::*;

/// The part of a path that stays inside a folder: no root, no drive, and `..` only as far as the
/// folder itself.
///
/// # Errors
///
/// Why the path is refused, as words that follow its name.
pub(crate) fn inside(name: &str) -> Result<PathBuf, &'static str> {
    if name.is_empty() {
        return Err("is empty");
    }
    if name.starts_with('/') || name.starts_with('\\') {
        return Err("is absolute, but must stay inside the folder of the file");
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
            // A drive (`C:`), a scheme (`file:`) or a stream of a file on Windows.
            _ if part.contains(':') => return Err("names a drive or a scheme"),
            _ if part.contains(char::is_control) => return Err("has control characters"),
            _ => parts.push(part),
        }
    }
    if parts.is_empty() {
        Err("names no file")
    } else {
        Ok(parts.iter().collect())
    }
}

/// As [`inside`], for a URI reference as glTF has it: percent signs spell bytes.
///
/// # Errors
///
/// Why the URI is refused, as words that follow it.
pub(crate) fn inside_uri(uri: &str) -> Result<PathBuf, &'static str> {
    if uri.contains('\\') {
        return Err("has a backslash");
    }
    if uri.contains(['?', '#']) {
        return Err("has a query or a fragment");
    }
    let mut decoded = Vec::new();
    for segment in uri.split('/') {
        let part = percent_decoded(segment).ok_or("has a percent sign that spells no text")?;
        // Decoded after splitting: an escaped separator or dot must not act as one.
        if part.contains(['/', '\\']) || (part != segment && (part == "." || part == "..")) {
            return Err("hides a separator or a dot behind a percent sign");
        }
        decoded.push(part);
    }
    inside(&decoded.join("/"))
}

/// The text that a part of a URI spells, if it is one.
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

/// Reads at most `limit` bytes of the file `name`, a path from [`inside`] or [`inside_uri`], beside
/// the file `asset`.
///
/// # Errors
///
/// If the file is missing, is no plain file, or lies outside the folder because of a link.
pub(crate) fn read_beside(asset: &Path, name: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let folder = folder_of(asset);
    let path = folder.join(name);
    let real = fs::canonicalize(&path)?;
    if !real.starts_with(fs::canonicalize(folder)?) {
        return Err(io::Error::other(
            "a link leads out of the folder of the file",
        ));
    }
    read_plain(&real, limit)
}

/// Reads at most `limit` bytes of a plain file: a pipe or a device could go on for ever.
pub(crate) fn read_plain(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
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
    let expected = usize::try_from(meta.len().min(limit)).unwrap_or(usize::MAX);
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
    let rest = limit - bytes.len() as u64;
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
    let mut bytes = mesh::zeroed(n);
    bytes
        .par_chunks_mut(LARGE)
        .enumerate()
        .try_for_each(|(i, piece)| file.read_exact_at(piece, (i * LARGE) as u64))?;
    Ok(bytes)
}

/// The folder that holds `path`; the working directory if the path is a bare name.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_that_stay_inside_are_taken() {
        assert_eq!(inside("a.mtl"), Ok(PathBuf::from("a.mtl")));
        assert_eq!(inside("./sub//../a b.mtl"), Ok(PathBuf::from("a b.mtl")));
        assert_eq!(inside("sub\\a.mtl"), Ok(PathBuf::from("sub/a.mtl")));
        assert_eq!(
            inside_uri("sub/a%20b.bin"),
            Ok(PathBuf::from("sub/a b.bin"))
        );
    }

    #[test]
    fn paths_that_leave_are_refused() {
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
    fn tricks_in_uris_are_refused() {
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
        fs::create_dir(&inner).unwrap();
        fs::write(folder.path().join("secret"), "x").unwrap();
        std::os::unix::fs::symlink("../secret", inner.join("link")).unwrap();
        fs::write(inner.join("plain"), "yes").unwrap();

        let asset = inner.join("a.gltf");
        assert!(read_beside(&asset, Path::new("link"), 9).is_err());
        assert_eq!(read_beside(&asset, Path::new("plain"), 2).unwrap(), b"ye");
    }
}
