//! What a file says of where it comes from: the counterpart of
//! [`WriteOptions::provenance`](crate::WriteOptions::provenance).

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use serde::Deserialize;

use crate::{Format, ReadError};

/// As much of the beginning of a file is looked at.
const HEAD: u64 = 1 << 20;

/// The most bytes of a glTF document that are looked at.
const DOCUMENT: u64 = 1 << 30;

/// The text that a file carries about where it comes from; `None` if it carries none, or is of a format
/// without a place for it. MTL files and glTF's buffers are known by their endings too.
///
/// STL has room for about 60 bytes only.
///
/// # Errors
///
/// [`ReadError`] if the file cannot be read.
pub fn provenance(path: &Path) -> Result<Option<String>, ReadError> {
    let failed = |error: std::io::Error| ReadError::io(path, error);
    let mut file = File::open(path).map_err(failed)?;
    match Format::from_path(path) {
        Some(Format::Gltf) => {
            let text = head(&mut file, DOCUMENT).map_err(failed)?;
            Ok(of_document(&text))
        }
        Some(Format::Glb) => {
            let mut header = [0; 20];
            if file.read_exact(&mut header).is_err() || &header[16..] != b"JSON" {
                return Ok(None);
            }
            let length = u32::from_le_bytes([header[12], header[13], header[14], header[15]]);
            let text = head(&mut file, u64::from(length)).map_err(failed)?;
            Ok(of_document(&text))
        }
        Some(Format::Stl) => {
            let text = head(&mut file, 80).map_err(failed)?;
            let text = String::from_utf8_lossy(&text);
            // The name of the program stands before it.
            let rest = text
                .strip_prefix("meshwright ")
                .and_then(|t| t.split_once(' '));
            let text = rest.map(|(_, text)| text.trim_end_matches(['\0', ' ']));
            Ok(text.filter(|t| !t.is_empty()).map(str::to_owned))
        }
        Some(Format::Mws) => {
            let text = head(&mut file, HEAD).map_err(failed)?;
            Ok(crate::mws::provenance(&text))
        }
        _ => {
            file.seek(SeekFrom::Start(0)).map_err(failed)?;
            let text = head(&mut file, HEAD).map_err(failed)?;
            let lines = text.split(|&b| b == b'\n');
            let comments = lines.filter_map(|line| {
                let line = std::str::from_utf8(line).ok()?.trim_end_matches('\r');
                let text = line
                    .strip_prefix("# ")
                    .or_else(|| line.strip_prefix("comment "))?;
                text.starts_with("meshwright ").then(|| text.to_owned())
            });
            Ok(comments.into_iter().next())
        }
    }
}

/// The first bytes of what is left of a file.
fn head(file: &mut File, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// `asset.extras.meshwright` of a glTF document.
fn of_document(json: &[u8]) -> Option<String> {
    #[derive(Deserialize)]
    struct Document {
        asset: Asset,
    }
    #[derive(Deserialize)]
    struct Asset {
        extras: Extras,
    }
    #[derive(Deserialize)]
    struct Extras {
        meshwright: String,
    }
    let document: Document = serde_json::from_slice(json).ok()?;
    Some(document.asset.extras.meshwright)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{WriteOptions, write};
    use mesh::shapes;
    use scene::{Object, Scene};

    #[test]
    fn every_format_gives_back_what_it_was_given() {
        let folder = tempfile::tempdir().unwrap();
        let text = r#"meshwright 1.2.3, recipe 0123456789abcdef0123456789abcdef, {"a":"\"ä"}"#;
        let options = WriteOptions {
            provenance: Some(text.to_owned()),
        };
        let mut scene = Scene::new();
        scene
            .insert(Object::mesh("a", shapes::tetrahedron()))
            .unwrap();
        for format in Format::ALL.into_iter().filter(|f| f.is_written()) {
            let path = folder.path().join(format!("a.{}", format.extension()));
            if write(&path, &scene, &options).is_err() {
                continue;
            }
            let found = provenance(&path).unwrap().unwrap();
            let room = if format == Format::Stl {
                60
            } else {
                text.len()
            };
            assert_eq!(found[..room], text[..room], "{format}");
        }
    }

    #[test]
    fn files_of_others_and_broken_ones_carry_nothing() {
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
            assert_eq!(provenance(&path(name)).unwrap(), None, "{name}");
        }
        assert!(provenance(&path("missing.obj")).is_err());
    }
}
