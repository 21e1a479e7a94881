//! Tests of primitives that are compressed by Draco. The original encoder wrote the files; see the folder `draco`.

use mesh_io::ReadError;
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::{Folder, read};

const FILES: [(&[u8], &[u8]); 2] = [
    (
        include_bytes!("draco/torus_edgebreaker.glb"),
        include_bytes!("draco/torus_edgebreaker_decoded.glb"),
    ),
    (
        include_bytes!("draco/torus_sequential.glb"),
        include_bytes!("draco/torus_sequential_decoded.glb"),
    ),
];

fn read_bytes(bytes: &[u8]) -> Result<mesh_io::Loaded, ReadError> {
    let folder = Folder::new();
    read(&folder.with("a.glb", bytes))
}

/// The JSON and the binary chunk of a GLB file.
fn parts(glb: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap());
    let length = usize::try_from(word(12)).unwrap();
    let json = serde_json::from_slice(&glb[20..20 + length]).unwrap();
    (json, &glb[28 + length..])
}

fn joined(json: &Value, binary: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let word = |n: usize| u32::try_from(n).unwrap().to_le_bytes();
    let length = 28 + text.len() + binary.len();
    let head = [*b"glTF", word(2), word(length), word(text.len()), *b"JSON"].concat();
    [&head, &text[..], &word(binary.len()), b"BIN\0", binary].concat()
}

/// Changes the JSON of the first file of `FILES`, reads the changed file, and returns the error.
fn error_of(change: impl FnOnce(&mut Value)) -> String {
    let (mut json, binary) = parts(FILES[0].0);
    change(&mut json);
    read_bytes(&joined(&json, binary)).unwrap_err().to_string()
}

#[test]
fn draco_files_are_decoded_as_by_the_original_decoder() {
    for (compressed, decoded) in FILES {
        let (a, b) = (
            read_bytes(compressed).unwrap(),
            read_bytes(decoded).unwrap(),
        );
        assert_eq!(a.notes, b.notes);
        assert_eq!(a.objects.len(), 1);
        let mesh = a.objects[0].as_mesh().unwrap();
        assert_eq!(mesh.n_faces(), 192);
        assert_eq!(mesh, b.objects[0].as_mesh().unwrap());
    }
}

#[test]
fn draco_files_that_break_the_rules_are_errors_with_the_primitive() {
    type Change = fn(&mut Value);
    let here = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    let changes: [(Change, &str); 8] = [
        (
            |j| j["accessors"][0]["count"] = json!(573),
            "cannot be decoded",
        ),
        (|j| j["accessors"][0]["count"] = json!(579), "579 indices"),
        (|j| j["accessors"][1]["count"] = json!(118), "118 vertices"),
        (
            |j| j["accessors"][1]["componentType"] = json!(5123),
            "POSITION: expected 3 numbers of type Uint16 for each element of the accessor",
        ),
        (|j| j["accessors"][1]["count"] = json!(u64::MAX), ""),
        (
            |j| j["meshes"][0]["primitives"][0]["mode"] = json!(5),
            "triangles with indices",
        ),
        (
            |j| {
                j["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
                    ["POSITION"] = json!(9);
            },
            "no attribute 9",
        ),
        (
            |j| {
                j["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] =
                    json!({});
            },
            "bufferView",
        ),
    ];
    for (change, words) in changes {
        let error = error_of(change);
        assert!(
            error.contains(here) && error.contains(words),
            "{words}: {error}"
        );
    }
    let error = error_of(|j| {
        j["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] =
            json!(7);
    });
    assert!(error.contains("buffer view 7 does not exist"), "{error}");
    // If the stream does not contain an attribute, all values of the attribute are 0, because the accessor of the
    // attribute has no buffer view.
    let (mut json, binary) = parts(FILES[0].0);
    let extension =
        &mut json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
    extension["attributes"]
        .as_object_mut()
        .unwrap()
        .remove("COLOR_0");
    read_bytes(&joined(&json, binary)).unwrap();
}

proptest! {
    #[test]
    fn changed_draco_streams_do_not_panic(
        which in 0..2_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), any::<bool>()), 1..8),
    ) {
        let (json, binary) = parts(FILES[which].0);
        let mut binary = binary.to_vec();
        for (place, byte, near_start) in changes {
            let n = if near_start { 64 } else { binary.len() };
            binary[place.index(n)] = byte;
        }
        let _ = read_bytes(&joined(&json, &binary));
    }
}
