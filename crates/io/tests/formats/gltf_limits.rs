//! Tests of small glTF files that declare large content. The reader must refuse them quickly and without much memory.

use std::time::{Duration, Instant};

use mesh_io::{Placements, ReadError, ReadOptions};
use serde_json::{Value, json};

use crate::gltf_read::{read_baked, read_json, square};
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
fn repeated_references_to_the_same_data_are_limited() {
    let mut json = square(&[0, 1, 2].repeat(20_000), 4);
    let primitive = json["meshes"][0]["primitives"][0].clone();
    json["meshes"][0]["primitives"] = vec![primitive; 5_000].into();
    let error = read_json(&json).unwrap_err();
    assert!(error.to_string().contains("so often"), "{error}");
    // The same limit applies if many nodes reference the same mesh, and each node becomes an object.
    let mut json = square(&[0, 1, 2].repeat(20_000), 4);
    json["nodes"] = vec![json!({ "mesh": 0 }); 5_000].into();
    json["scenes"][0]["nodes"] = (0..5_000).collect();
    let error = read_baked(&json).unwrap_err();
    assert!(error.to_string().contains("so often"), "{error}");
    // If the nodes are kept, they share one object and need little memory.
    let loaded = read_json(&json).unwrap();
    assert_eq!(
        (loaded.objects.len(), loaded.graph.nodes().len()),
        (1, 5_000)
    );
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
    assert_eq!(read_baked(&json).unwrap().objects.len(), n);
    assert_eq!(read_json(&json).unwrap().graph.nodes().len(), n);
}

#[test]
fn a_container_with_a_wrong_length_is_refused() {
    let folder = Folder::new();
    for lengths in [[u32::MAX, 4], [28, u32::MAX], [28, 0x7fff_fff0], [4, 4]] {
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend(lengths[0].to_le_bytes());
        bytes.extend(lengths[1].to_le_bytes());
        bytes.extend(b"JSON{}  ");
        assert!(read(&folder.with("a.glb", bytes)).is_err());
    }
}

/// Reads a document that the reader must refuse. Returns the error, and checks that reading takes little time.
fn error_quickly(json: &Value) -> String {
    let start = Instant::now();
    let error = read_baked(json).unwrap_err();
    assert!(
        start.elapsed() < Duration::from_secs(5),
        "{:?}",
        start.elapsed()
    );
    error.to_string()
}

#[test]
fn nodes_that_repeat_a_long_name_are_refused() {
    let mut json = square(&[0, 1, 2], 4);
    json["meshes"][0]["name"] = "a".repeat(1 << 20).into();
    json["nodes"] = vec![json!({ "mesh": 0 }); 2000].into();
    json["scenes"][0]["nodes"] = (0..2000).collect();
    assert!(error_quickly(&json).contains("so often"));
}

#[test]
fn nodes_that_repeat_a_long_material_are_refused() {
    let mut json = square(&[0, 1, 2], 4);
    json["materials"] = json!([{ "name": "a".repeat(1 << 20) }]);
    json["meshes"][0]["primitives"][0]["material"] = 0.into();
    json["nodes"] = vec![json!({ "mesh": 0 }); 2000].into();
    json["scenes"][0]["nodes"] = (0..2000).collect();
    assert!(error_quickly(&json).contains("so often"));
}

#[test]
fn many_primitives_with_different_attributes_are_refused() {
    // Every primitive has a different attribute, and each attribute needs values for the vertices of all primitives.
    let mut json = square(&[0, 1, 2], 4);
    let primitive = |i: usize| {
        let mut primitive = json["meshes"][0]["primitives"][0].clone();
        primitive["attributes"][format!("_{i}")] = 0.into();
        primitive
    };
    let primitives: Vec<Value> = (0..2000).map(primitive).collect();
    json["meshes"][0]["primitives"] = primitives.into();
    assert!(error_quickly(&json).contains("so often"));
}

#[test]
fn repeated_use_of_a_sparse_accessor_is_limited() {
    let mut json = square(&vec![0; 200_000], 4);
    json["accessors"][0]["sparse"] = json!({
        "count": 30_000,
        "indices": { "bufferView": 0, "byteOffset": 48, "componentType": 5123 },
        "values": { "bufferView": 0, "byteOffset": 0 },
    });
    let primitive = |i: usize| {
        let mut primitive = json["meshes"][0]["primitives"][0].clone();
        primitive["indices"] = Value::Null;
        primitive["mode"] = 5.into();
        primitive["attributes"][format!("_{i}")] = 0.into();
        primitive
    };
    let primitives: Vec<Value> = (0..1000).map(primitive).collect();
    json["meshes"][0]["primitives"] = primitives.into();
    assert!(error_quickly(&json).contains("so often"));
}

#[test]
fn repeated_reading_of_a_buffer_file_is_limited() {
    let folder = Folder::new();
    folder.with("a.bin", vec![0; 1 << 20]);
    let mut json = square(&[0, 1, 2], 4);
    json["buffers"] = vec![json!({ "uri": "a.bin", "byteLength": 1 << 20 }); 1000].into();
    let error = read(&folder.with("a.gltf", json.to_string())).unwrap_err();
    assert!(error.to_string().contains("so often"), "{error}");
    json["buffers"].as_array_mut().unwrap().truncate(3);
    read(&folder.with("a.gltf", json.to_string())).unwrap();
}

#[test]
fn too_many_empty_objects_are_refused() {
    for key in ["nodes", "materials"] {
        let mut json = square(&[0, 1, 2], 4);
        json[key] = vec![json!({}); 300_000].into();
        assert!(error_quickly(&json).contains("so often"), "{key}");
    }
}

#[test]
fn many_nodes_with_a_mesh_of_many_primitives_are_counted_quickly() {
    let mut json = square(&[0, 1, 2], 4);
    let primitive = json["meshes"][0]["primitives"][0].clone();
    json["meshes"][0]["primitives"] = vec![primitive; 5000].into();
    json["nodes"] = vec![json!({ "mesh": 0 }); 5000].into();
    json["scenes"][0]["nodes"] = (0..5000).collect();
    let folder = Folder::new();
    let path = folder.with("a.gltf", json.to_string());
    let start = Instant::now();
    let options = ReadOptions {
        placements: Placements::Bake,
        ..ReadOptions::default()
    };
    let peek = mesh_io::peek(&store::Disk, &path, &options).unwrap();
    assert_eq!(peek.objects.len(), 5000);
    let peek = mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap();
    assert_eq!((peek.objects.len(), peek.graph.nodes().len()), (1, 5000));
    assert!(start.elapsed() < Duration::from_secs(2));
}
