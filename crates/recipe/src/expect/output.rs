//! The expectation `Output`. It compares a file from a step with a reference file in the folder of the recipe. In the
//! code, the reference file is called `golden`.
//!
//! Pictures are compared pixel by pixel. Mesh files are compared by the objects that are read from them, and all other
//! files byte by byte. The provenance in a file, which says how the file was made, is ignored.

use std::path::{Component, Path, PathBuf};

use op::Files;
use scene::{Digest, Scene};
use store::TemporaryFolder;

use super::subject::Subject;
use super::violation::{ActualValue, Violation, fails_unless};

/// The maximum size, in bytes, of a written file that `test --update` copies over its reference file.
const MAX_RECORDED: u64 = 64 << 20;

/// Whether the path has the extension of a picture. Pictures are compared by their pixels, not by the bytes of their
/// files.
pub(super) fn is_picture(path: &str) -> bool {
    let extension = Path::new(path).extension().unwrap_or_default();
    ["png", "apng"]
        .iter()
        .any(|e| extension.eq_ignore_ascii_case(e))
}

/// Returns the full path of a reference file. Not every path is allowed, because `test --update` writes to the
/// reference file.
///
/// # Errors
///
/// Returns a [`Violation`] if the path leads out of the recipe's folder, directly or through a link. Also returns a
/// [`Violation`] if the path is a folder, a link or a device.
pub(crate) fn golden(files: &Files, path: &str) -> Result<PathBuf, Violation> {
    let relative = Path::new(path);
    let is_plain = relative
        .components()
        .all(|c| matches!(c, Component::Normal(_)));
    if !is_plain || path.contains(['\\', ':', '\0']) {
        let message = format!(
            "the path \"{path}\" must stay inside the recipe's folder: use a relative path without the folders \".\" and \"..\" and without the characters \"\\\" and \":\""
        );
        return Err(message.into());
    }
    if relative.file_name().is_none() || path.ends_with('/') {
        return Err(format!("the path \"{path}\" does not name a file").into());
    }
    let input = if files.input.as_os_str().is_empty() {
        PathBuf::from(".")
    } else {
        files.input.clone()
    };
    let beside = Files {
        output: input,
        ..files.clone()
    };
    beside.check_links(relative).map_err(|_| {
        format!("the path \"{path}\" leads out of the recipe's folder through a symbolic link")
    })?;
    let full = files.to_read(path);
    match files.store.entry(&full) {
        _ if files.store.is_link(&full) => Err(format!("\"{path}\" is a link, not a file").into()),
        Some(found) if !found.is_file() => Err(format!("\"{path}\" is not a file").into()),
        // A missing file is allowed, because `test --update` creates it.
        _ => Ok(full),
    }
}

/// Compares a file that a step has written with the reference file.
pub(super) fn check(
    subject: Subject,
    path: &str,
    beside: &str,
    tolerance: u8,
) -> Result<(), Violation> {
    let files = subject.files;
    let written = files.to_write(path).map_err(|error| error.to_string())?;
    let golden = golden(files, beside)?;
    if !files.store.is_file(&written) {
        return Err(format!("no step has written \"{path}\" yet").into());
    }
    let after_colon = |violation: Violation| Violation {
        message: format!(": {}", violation.message),
        ..violation
    };
    let compared = if !files.store.exists(&golden) {
        Err(", which does not exist: create it with `meshwright test --update`".into())
    } else if is_picture(path) {
        compare_pictures(&written, &golden, tolerance, subject).map_err(after_colon)
    } else {
        compare(&written, &golden, subject).map_err(after_colon)
    };
    compared.map_err(|mut violation| {
        let (shown, why) = (golden.display(), &violation.message);
        violation.message = format!("expected \"{path}\" to match {shown}{why}");
        with_written_file(violation, &written, &golden, tolerance, subject)
    })
}

/// Adds the bytes of the written file to the violation, so that `test --update` can write them to the reference file.
/// If it is not possible to record the bytes, adds the reason to the message.
fn with_written_file(
    mut violation: Violation,
    written: &Path,
    golden: &Path,
    tolerance: u8,
    subject: Subject,
) -> Violation {
    let store = &subject.files.store;
    let why = if store.len(written).is_none_or(|len| len > MAX_RECORDED) {
        "is too large to be recorded".to_owned()
    } else {
        match store.read(written) {
            Ok(bytes) if stands_alone(written, golden, &bytes, subject) => {
                let golden = golden.to_path_buf();
                violation.found = Some(ActualValue::File {
                    golden,
                    bytes,
                    tolerance,
                });
                return violation;
            }
            Ok(_) => {
                "cannot be recorded because it depends on other files: write a .glb, .ply or .mws"
                    .to_owned()
            }
            Err(error) => format!("cannot be read: {}", error.error),
        }
    };
    Violation::unmet(format!("{}; the written file {why}", violation.message))
}

/// Whether the written file can be read without other files. To find out, copies the file to an empty folder, and
/// compares the objects in the copy with the objects in the file. The copy has the name of the reference file. Returns
/// `false` for an OBJ file with a material library, because the library is missing beside the copy. Returns `true` if
/// the written file cannot be read as objects.
fn stands_alone(written: &Path, golden: &Path, bytes: &[u8], subject: Subject) -> bool {
    let Ok(scene) = subject.reader.scene(written, subject.files) else {
        return true;
    };
    let alone = || {
        let store = &*subject.files.store;
        let folder = TemporaryFolder::new(store, None).map_err(|error| error.to_string())?;
        let path = folder.path().join(golden.file_name().unwrap_or_default());
        store
            .write(&path, bytes)
            .map_err(|error| error.to_string())?;
        let alone = subject.reader.scene(&path, subject.files)?;
        digests((written, &scene), (&path, alone))
    };
    alone().is_ok_and(|[then, now]| then == now)
}

/// Compares the pixels of two pictures.
fn compare_pictures(
    written: &Path,
    golden: &Path,
    tolerance: u8,
    subject: Subject,
) -> Result<(), Violation> {
    let bytes = |path| {
        let bytes = subject.files.store.read(path);
        bytes.map_err(|error| error.to_string())
    };
    let (now, then) = (bytes(written)?, bytes(golden)?);
    let differs = subject
        .reader
        .compare_pictures((written, &now), (golden, &then), tolerance)?;
    differs.map_or(Ok(()), |message| Err(Violation::unmet(message)))
}

/// Compares two files that are not pictures.
fn compare(written: &Path, golden: &Path, subject: Subject) -> Result<(), Violation> {
    let (reader, files) = (subject.reader, subject.files);
    // A file that cannot be read as objects is compared by its bytes.
    if let Ok(now) = reader.scene(written, files) {
        let then = reader.scene(golden, files)?;
        let [now, then] = digests((written, &now), (golden, then))?;
        return fails_unless(now == then, || {
            format!("expected the objects in the file to have the digest {then}, found {now}")
        });
    }
    let bytes = |path: &Path| {
        let bytes = files.store.read(path).map(without_stamp);
        bytes.map_err(|error| error.to_string())
    };
    let (now, then) = (bytes(written)?, bytes(golden)?);
    if now == then {
        return Ok(());
    }
    let at = now.iter().zip(&then).position(|(a, b)| a != b);
    Err(Violation::unmet(match at {
        Some(at) => {
            let line = then[..at].split(|b| *b == b'\n').count();
            format!("the first difference is at byte {at} (counted from 0), in line {line}")
        }
        None => format!("expected {} bytes, found {}", then.len(), now.len()),
    }))
}

/// Returns the digests of the scenes in two files. A single object in a file often has the name of the file. If each of
/// two corresponding objects has the name of its file, these names are treated as equal.
fn digests(
    (path, scene): (&Path, &Scene),
    (other_path, mut other): (&Path, Scene),
) -> Result<[Digest; 2], Violation> {
    let is_of = |name: &str, path: &Path| *store::stem(path) == *name;
    let names =
        |scene: &Scene| -> Vec<String> { scene.objects().iter().map(|o| o.name.clone()).collect() };
    for (name, old) in names(scene).iter().zip(names(&other)) {
        if is_of(name, path) && is_of(&old, other_path) {
            other
                .rename(&old, name)
                .map_err(|error| error.to_string())?;
        }
    }
    Ok([scene.digest(), other.digest()])
}

/// Removes the recorded provenance from the bytes of a file. The provenance of an SVG file is in its metadata, and the
/// provenance of a GIF file is in its comment.
fn without_stamp(mut bytes: Vec<u8>) -> Vec<u8> {
    let find = |bytes: &[u8], text: &[u8]| bytes.windows(text.len()).position(|w| w == text);
    let (open, close): (&[u8], &[u8]) = (b"<metadata>meshwright ", b"</metadata>");
    if let Some(start) = find(&bytes, open)
        && let Some(length) = find(&bytes[start..], close)
    {
        bytes.drain(start..start + length + close.len());
    }
    let is_gif = bytes.starts_with(b"GIF8");
    let is_comment = |w: &[u8]| w.starts_with(b"\x21\xfe") && w.ends_with(b"meshwright ");
    if is_gif && let Some(start) = bytes.windows(14).position(is_comment) {
        // The comment of a GIF file is a list of blocks. Each block starts with its length, and a block of length 0
        // ends the list.
        let mut end = start + 2;
        while let Some(&length) = bytes.get(end) {
            end += 1 + usize::from(length);
            if length == 0 {
                break;
            }
        }
        bytes.drain(start..end.min(bytes.len()));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn provenance_is_removed_from_svg_and_gif_files() {
        let svg =
            |stamp: &str| format!("<svg>\n  {stamp}\n  <path d=\"M 0 0\"/>\n</svg>").into_bytes();
        let one = without_stamp(svg("<metadata>meshwright 1, recipe 0a</metadata>"));
        assert_eq!(one, without_stamp(svg("<metadata>meshwright 2</metadata>")));
        assert_eq!(one, svg(""));
        // Metadata of other programs, and metadata without an end tag, are not removed.
        for other in ["<metadata>by hand</metadata>", "<metadata>meshwright 1"] {
            assert_eq!(without_stamp(svg(other)), svg(other));
        }
        let gif = |comment: &[u8]| [b"GIF89a..", comment, b"image"].concat();
        let long = [&b"\x21\xfe\x0cmeshwright 1\x03abc\x00"[..]].concat();
        assert_eq!(without_stamp(gif(&long)), gif(b""));
        assert_eq!(
            without_stamp(gif(b"\x21\xfe\x02by\x00")),
            gif(b"\x21\xfe\x02by\x00")
        );
        // Truncated input does not cause a panic.
        for end in 0..gif(&long).len() {
            without_stamp(gif(&long)[..end].to_vec());
        }
    }
}
