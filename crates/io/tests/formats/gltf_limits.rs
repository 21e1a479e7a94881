//! Small glTF files that claim to be large: each is refused before it costs anything.

use std::time::{Duration, Instant};

use mesh_io::ReadError;
use serde_json::json;

use crate::gltf_read::{read_json, square};
use crate::{Folder, read};

#[test]
fn a_tiny_file_of_four_billion_vertices_is_refused_at_once() {
    let text = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"componentType":5126,"count":4294967295,"type":"VEC3"}]}"#;
    assert!(text.len() < 200);
    let folder = Folder::new();
    let path = folder.with("a.gltf", text);
    let start = Instant::now();
    assert!(read(&path).is_err());
    assert!(start.elapsed() < Duration::from_millis(50));
}

#[test]
fn a_file_that_refers_to_its_data_again_and_again_has_a_limit() {
    let mut json = square(&[0, 1, 2].repeat(20_000), 4);
    let primitive = json["meshes"][0]["primitives"][0].clone();
    json["meshes"][0]["primitives"] = vec![primitive; 5_000].into();
    let error = read_json(&json).unwrap_err();
    assert!(error.to_string().contains("so often"), "{error}");
    // As many nodes that show the same mesh.
    let mut json = square(&[0, 1, 2].repeat(20_000), 4);
    json["nodes"] = vec![json!({ "mesh": 0 }); 5_000].into();
    json["scenes"][0]["nodes"] = (0..5_000).collect();
    let error = read_json(&json).unwrap_err();
    assert!(error.to_string().contains("so often"), "{error}");
}

#[test]
fn deep_json_is_refused() {
    let folder = Folder::new();
    let text = format!("{{\"asset\":{}", "[".repeat(1_000_000));
    assert!(matches!(
        read(&folder.with("a.gltf", text)),
        Err(ReadError::Text { .. })
    ));
}

#[test]
fn many_nodes_are_read() {
    let mut json = square(&[0, 1, 2], 4);
    let n = 20_000;
    json["nodes"] = vec![json!({ "mesh": 0 }); n].into();
    json["scenes"][0]["nodes"] = (0..n).collect();
    assert_eq!(read_json(&json).unwrap().objects.len(), n);
}

#[test]
fn a_container_with_a_lying_length_is_refused() {
    let folder = Folder::new();
    for lengths in [[u32::MAX, 4], [28, u32::MAX], [28, 0x7fff_fff0], [4, 4]] {
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend(lengths[0].to_le_bytes());
        bytes.extend(lengths[1].to_le_bytes());
        bytes.extend(b"JSON{}  ");
        assert!(read(&folder.with("a.glb", bytes)).is_err());
    }
}
