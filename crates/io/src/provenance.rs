//! Reads the provenance of a file. The provenance is the text of
//! [`WriteOptions::provenance`](crate::WriteOptions::provenance) when the file was written.

use std::path::Path;

use serde_json::Value;
use store::Store;

use crate::{Format, ReadError, gltf, gzip, mws};

/// The number of bytes at the beginning of a file that are searched for the provenance. In glTF files, the whole JSON
/// is searched.
const HEAD: u64 = 1 << 20;
/// The maximum number of decompressed bytes that are read from a compressed glTF file.
const MAX_DOCUMENT: u64 = 1 << 30;

/// Reads the provenance of a file. Returns `None` if the file has no provenance, for example because its format cannot
/// store one. Also reads the provenance of MTL files, and of the PNG and SVG pictures that the program writes.
///
/// An STL file stores only about the first 60 bytes of the provenance.
///
/// # Errors
///
/// Returns a [`ReadError`] if the file cannot be read.
pub fn provenance(store: &dyn Store, path: &Path) -> Result<Option<String>, ReadError> {
    let head = |most| gzip::head(store, path, most);
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    let is_ours = |text: &String| text.starts_with("meshwright ");
    Ok(match Format::from_path(path) {
        None if ending == "png" => of_png(&head(HEAD)?).filter(is_ours),
        None if ending == "svg" => of_svg(&head(HEAD)?).filter(is_ours),
        Some(Format::Gltf) if gzip::is_compressed(path) => of_document(&head(MAX_DOCUMENT)?),
        Some(Format::Gltf | Format::Glb) => of_document(&gltf::document_of(store, path)?),
        Some(Format::Stl) => {
            let head = head(80)?;
            // In the header of an STL file, the name of the program precedes the provenance.
            let text = String::from_utf8_lossy(&head);
            let rest = text
                .strip_prefix("meshwright ")
                .and_then(|t| t.split_once(' '));
            let text = rest.map(|(_, text)| text.trim_end_matches(['\0', ' ']));
            text.filter(|text| !text.is_empty()).map(str::to_owned)
        }
        Some(Format::Mws) => mws::provenance(&head(HEAD)?),
        _ => {
            let head = head(HEAD)?;
            let mut comments = head.split(|&b| b == b'\n').filter_map(|line| {
                let line = std::str::from_utf8(line).ok()?.trim_end_matches('\r');
                let comment = line.strip_prefix("# ").or(line.strip_prefix("comment "));
                comment.map(str::to_owned).filter(is_ours)
            });
            comments.next()
        }
    })
}

/// Returns the text at `asset.extras.meshwright` in a glTF document.
fn of_document(json: &[u8]) -> Option<String> {
    let document: Value = serde_json::from_slice(json).ok()?;
    let text = document.pointer("/asset/extras/meshwright")?;
    text.as_str().map(str::to_owned)
}

/// Returns the text that a PNG file stores with the keyword "Software". Returns `None` if the file has no such text in
/// an uncompressed `iTXt` chunk (a chunk for international text).
///
/// A chunk consists of its length, four letters, the data, and a checksum. The data of an `iTXt` chunk consists of the
/// keyword, two bytes about compression, the language, the translated keyword, and the text. A zero byte follows the
/// keyword, the language and the translated keyword. Source: W3C, "Portable Network Graphics (PNG) Specification", 3rd
/// edition, 2025, §11.3.3.4.
fn of_png(bytes: &[u8]) -> Option<String> {
    let mut rest = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?;
    loop {
        let (length, behind) = rest.split_first_chunk::<4>()?;
        let (letters, behind) = behind.split_first_chunk::<4>()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        let (data, behind) = behind.split_at_checked(length)?;
        if letters == b"IDAT" {
            return None;
        }
        let text = data
            .strip_prefix(b"Software\0\0\0")
            .filter(|_| letters == b"iTXt");
        if let Some(text) = text.and_then(|text| text.splitn(3, |&b| b == 0).nth(2)) {
            return String::from_utf8(text.to_vec()).ok();
        }
        rest = behind.get(4..)?;
    }
}

/// The metadata of an SVG file, if it is plain text.
fn of_svg(bytes: &[u8]) -> Option<String> {
    // Invalid UTF-8 is accepted, because `bytes` is only the beginning of the file and can end in the middle of a
    // character.
    let text = String::from_utf8_lossy(bytes);
    let (_, behind) = text.split_once("<metadata>")?;
    let (text, _) = behind.split_once("</metadata>")?;
    let plain = text
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"");
    Some(plain.replace("&amp;", "&"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{WriteOptions, write};
    use geometry::shapes;
    use scene::{Object, Scene};
    use store::Disk;

    #[test]
    fn every_format_returns_the_provenance_that_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let text = r#"meshwright 1.2.3, recipe 0123456789abcdef0123456789abcdef, {"a":"\"ä"}"#;
        let options = WriteOptions {
            provenance: Some(text.to_owned()),
            ..WriteOptions::default()
        };
        let mut scene = Scene::new();
        scene
            .insert(Object::mesh("a", shapes::tetrahedron()))
            .unwrap();
        for format in Format::all().filter(|f| f.can_read() && f.can_write()) {
            let path = folder.path().join(format!("a.{}", format.extension()));
            if write(&Disk, &path, &scene, &options).is_err() {
                continue;
            }
            let found = provenance(&Disk, &path).unwrap().unwrap();
            let room = if format == Format::Stl {
                60
            } else {
                text.len()
            };
            assert_eq!(found[..room], text[..room], "{format}");
        }
    }

    #[test]
    fn pictures_return_the_provenance_that_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let stamp = r#"meshwright 1, recipe 01, {"a":"<&>ä"}"#;
        let chunk = |letters: &str, data: &[u8]| {
            let length = u32::try_from(data.len()).unwrap().to_be_bytes();
            [&length, letters.as_bytes(), data, b"sum."].concat()
        };
        let text = |keyword: &str| {
            let data = [keyword.as_bytes(), b"\0\0\0\0\0", stamp.as_bytes()].concat();
            chunk("iTXt", &data)
        };
        let png = |chunks: &[Vec<u8>]| [b"\x89PNG\r\n\x1a\n".to_vec(), chunks.concat()].concat();
        let header = chunk("IHDR", &[0; 13]);
        let xml = stamp
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        for (name, bytes, found) in [
            ("a.PNG", png(&[header.clone(), text("Software")]), true),
            (
                "b.png",
                png(&[header.clone(), text("Source"), text("Software")]),
                true,
            ),
            ("c.png", png(&[header.clone(), text("Source")]), false),
            (
                "d.png",
                png(&[header.clone(), chunk("IDAT", b"x"), text("Software")]),
                false,
            ),
            (
                "e.png",
                png(&[header, text("Software")])[..70].to_vec(),
                false,
            ),
            (
                "f.png",
                b"\x89PNG\r\n\x1a\n\xff\xff\xff\xffiTXt".to_vec(),
                false,
            ),
            (
                "a.svg",
                format!("<svg><metadata>{xml}</metadata></svg>").into_bytes(),
                true,
            ),
            ("b.svg", b"<svg><metadata>meshwright".to_vec(), false),
            (
                "c.svg",
                b"<svg><metadata>inkscape</metadata></svg>".to_vec(),
                false,
            ),
        ] {
            std::fs::write(path(name), bytes).unwrap();
            let expected = found.then(|| stamp.to_owned());
            assert_eq!(provenance(&Disk, &path(name)).unwrap(), expected, "{name}");
        }
    }

    #[test]
    fn files_of_other_programs_and_broken_files_have_no_provenance() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for (name, bytes) in [
            ("a.obj", &b"# blender\nv 0 0 0\n"[..]),
            ("b.obj", b"\xff\xfe\n# mesh\n"),
            ("a.gltf", b"{\"asset\": {\"version\": \"2.0\"}}"),
            ("b.gltf", b"{"),
            ("a.glb", b"glTF"),
            (
                "b.glb",
                b"glTF\x02\0\0\0\xff\xff\xff\xff\xff\xff\xff\xffJSON{",
            ),
            ("a.stl", b"solid a"),
            ("a.bin", b""),
        ] {
            std::fs::write(path(name), bytes).unwrap();
            assert_eq!(provenance(&Disk, &path(name)).unwrap(), None, "{name}");
        }
        assert!(provenance(&Disk, &path("missing.obj")).is_err());
    }
}
