//! Tests that compare the result of reading handmade glTF files with the expected result.

use glam::{DVec2, DVec3, DVec4};
use mesh::{Mesh, UV, VERTEX_NORMAL};
use mesh_io::{Placements, ReadError, ReadOptions};
use serde_json::{Value, json};

use crate::{Folder, polygons, read};

/// A document with one node, one mesh and one buffer with these bytes.
pub(crate) fn document(bytes: &[u8], accessors: &Value, primitives: &Value) -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": primitives }],
        "buffers": [{ "byteLength": bytes.len(), "uri": data_uri(bytes) }],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "accessors": accessors,
    })
}

pub(crate) fn data_uri(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = "data:application/octet-stream;base64,".to_owned();
    for three in bytes.chunks(3) {
        let mut bits = 0;
        for k in 0..3 {
            bits = bits << 8 | usize::from(three.get(k).copied().unwrap_or(0));
        }
        for k in 0..4 {
            let digit = char::from(DIGITS[bits >> (18 - 6 * k) & 63]);
            text.push(if k > three.len() { '=' } else { digit });
        }
    }
    text
}

/// Decodes a data URI that this module made.
pub(crate) fn bytes_of_uri(uri: &str) -> Vec<u8> {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let (_, digits) = uri.split_once(',').unwrap();
    let mut bytes = Vec::new();
    for four in digits.as_bytes().chunks(4) {
        let value = |c: &u8| DIGITS.iter().position(|d| d == c).unwrap_or(0);
        let bits = four.iter().fold(0, |bits, c| bits << 6 | value(c));
        let n = four.iter().filter(|c| **c != b'=').count() - 1;
        bytes.extend((0..n).map(|k| u8::try_from(bits >> (16 - 8 * k) & 255).unwrap()));
    }
    bytes
}

pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// The positions of the four corners of a square, counter-clockwise.
pub(crate) const SQUARE: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];

/// Returns a document with the corners of [`SQUARE`] as vertices, and one primitive with these indices and this mode.
/// In the buffer, the indices follow the positions.
pub(crate) fn square(indices: &[u16], mode: u32) -> Value {
    let mut bytes = floats(&SQUARE);
    bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    let accessors = json!([
        { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
        { "bufferView": 0, "byteOffset": 48, "componentType": 5123, "count": indices.len(), "type": "SCALAR" },
    ]);
    document(
        &bytes,
        &accessors,
        &json!([{ "attributes": { "POSITION": 0 }, "indices": 1, "mode": mode }]),
    )
}

pub(crate) fn read_json(json: &Value) -> Result<mesh_io::Loaded, ReadError> {
    let folder = Folder::new();
    read(&folder.with("a.gltf", json.to_string()))
}

/// Reads a document and applies the transforms of its nodes.
pub(crate) fn read_baked(json: &Value) -> Result<mesh_io::Loaded, ReadError> {
    let folder = Folder::new();
    let options = ReadOptions {
        placements: Placements::Bake,
        ..ReadOptions::default()
    };
    let path = folder.with("a.gltf", json.to_string());
    mesh_io::read(&store::Disk, &path, &options)
}

fn mesh_of(json: &Value) -> Mesh {
    let loaded = read_baked(json).unwrap();
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    loaded.objects[0].as_mesh().unwrap().as_ref().clone()
}

/// Returns the triangles. Each triangle is a list of corners that starts at its lowest corner.
fn rotated_triangles(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut faces = polygons(mesh);
    for face in &mut faces {
        let lowest = (0..face.len()).min_by_key(|&i| face[i]).unwrap();
        face.rotate_left(lowest);
    }
    faces
}

#[test]
fn lists_strips_and_fans_become_triangles() {
    let two = [vec![0, 1, 2], vec![0, 2, 3]];
    assert_eq!(
        rotated_triangles(&mesh_of(&square(&[0, 1, 2, 0, 2, 3], 4))),
        two
    );
    assert_eq!(rotated_triangles(&mesh_of(&square(&[0, 1, 2, 3], 6))), two);
    assert_eq!(rotated_triangles(&mesh_of(&square(&[1, 2, 0, 3], 5))), two);
    // Some triangles of the strip use a vertex twice. These triangles are left out.
    let jumping = mesh_of(&square(&[0, 1, 2, 2, 2, 3, 0], 5));
    assert_eq!(jumping.n_faces(), 2);
    assert!(jumping.is_dense() && jumping.n_edges() == 5);
}

#[test]
fn without_indices_vertices_are_used_in_order() {
    let mut positions = SQUARE.to_vec();
    positions.extend_from_within(0..3);
    positions.extend_from_within(6..9);
    // The corners of the square are used in the order 0 1 2, 3 0 2. Each corner has its own vertex in the file, and
    // equal vertices are merged.
    let bytes = floats(&positions);
    let accessors = json!([{ "bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3" }]);
    let mesh = mesh_of(&document(
        &bytes,
        &accessors,
        &json!([{ "attributes": { "POSITION": 0 } }]),
    ));
    assert_eq!(
        (mesh.n_vertices(), mesh.n_faces(), mesh.n_edges()),
        (4, 2, 5)
    );
}

#[test]
fn interleaved_normalized_and_sparse_arrays_are_read() {
    // Each vertex has 20 bytes: 3 floats for the position, 4 bytes for the color, and two 16-bit integers for the
    // texture coordinates.
    let mut bytes = Vec::new();
    for (i, position) in SQUARE.chunks(3).enumerate() {
        bytes.extend(floats(position));
        bytes.extend([255, 0, 51, 255]);
        bytes.extend(
            [0_u16, if i == 0 { 65535 } else { 0 }]
                .iter()
                .flat_map(|x| x.to_le_bytes()),
        );
    }
    bytes.extend([0, 1, 2, 3, 0, 0, 0, 0]);
    bytes.extend(floats(&[0.0, 0.0, 7.0]));
    let mut json = document(
        &bytes,
        &json!([
            {
                "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3",
                "sparse": {
                    "count": 1,
                    "indices": { "bufferView": 2, "byteOffset": 3, "componentType": 5121 },
                    "values": { "bufferView": 2, "byteOffset": 8 },
                },
            },
            { "bufferView": 1, "byteOffset": 12, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" },
            { "bufferView": 1, "byteOffset": 16, "componentType": 5123, "normalized": true, "count": 4, "type": "VEC2" },
            { "componentType": 5126, "count": 4, "type": "VEC3" },
        ]),
        &json!([{ "attributes": { "POSITION": 0, "COLOR_0": 1, "TEXCOORD_0": 2 }, "mode": 6 }]),
    );
    json["bufferViews"] = json!([
        { "buffer": 0, "byteLength": 0 },
        { "buffer": 0, "byteLength": 80, "byteStride": 20 },
        { "buffer": 0, "byteOffset": 80, "byteLength": 20 },
    ]);
    let mesh = mesh_of(&json);
    assert_eq!(
        mesh.position(mesh.vertices().nth(3).unwrap()),
        DVec3::new(0.0, 0.0, 7.0)
    );
    assert_eq!(
        mesh.get(mesh::COLOR).unwrap()[2],
        DVec4::new(1.0, 0.0, 0.2, 1.0)
    );
    let uvs = mesh.get(UV).unwrap();
    for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
        let v = if mesh.origin(h).index() == 0 {
            0.0
        } else {
            1.0
        };
        assert_eq!(uvs[h.index()], DVec2::new(0.0, v));
    }
    // This accessor has no data. Therefore, all positions are zero, and all vertices are merged into one.
    json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(3);
    let loaded = read_json(&json).unwrap();
    assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 0);
    assert_eq!(loaded.notes[0].count, 2);
}

#[test]
fn transforms_of_nodes_are_applied_and_mirrors_reverse_faces() {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    json["nodes"] = json!([
        { "children": [1, 2, 3], "translation": [10, 0, 0], "name": "root" },
        { "mesh": 0, "name": "twin", "scale": [2, 1, 1] },
        { "mesh": 0, "name": "twin", "scale": [-1, 1, 1] },
        { "mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1] },
    ]);
    let loaded = read_baked(&json).unwrap();
    let names: Vec<_> = loaded.objects.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["twin", "twin.2", "a"]);
    assert_eq!(loaded.notes.len(), 1);
    let meshes: Vec<_> = loaded
        .objects
        .iter()
        .map(|o| o.as_mesh().unwrap())
        .collect();
    let corner = |mesh: &Mesh, v: usize| mesh.positions()[v];
    assert_eq!(corner(meshes[0], 1), DVec3::new(12.0, 0.0, 0.0));
    assert_eq!(corner(meshes[1], 1), DVec3::new(9.0, 0.0, 0.0));
    assert_eq!(corner(meshes[2], 1), DVec3::new(10.0, 1.0, 5.0));
    for mesh in meshes {
        for f in mesh.faces() {
            assert!(mesh.area_vector(f).z > 0.0);
        }
    }
}

#[test]
fn normals_are_transformed_with_the_node() {
    let mut bytes = floats(&SQUARE);
    bytes.extend(floats(&[0.0, 0.6, 0.8].repeat(4)));
    let mut json = document(
        &bytes,
        &json!([
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3" },
        ]),
        &json!([{ "attributes": { "POSITION": 0, "NORMAL": 1 }, "mode": 6 }]),
    );
    json["nodes"][0]["scale"] = json!([1, 0.5, 1]);
    let mesh = mesh_of(&json);
    let expected = DVec3::new(0.0, f64::from(0.6_f32) * 2.0, f64::from(0.8_f32)).normalize();
    assert!((mesh.get(VERTEX_NORMAL).unwrap()[0] - expected).length() < 1e-12);
    json["nodes"][0]["scale"] = json!([1, 0, 1]);
    assert!(
        read_baked(&json)
            .unwrap()
            .notes
            .iter()
            .any(|note| note.what.contains("singular"))
    );
}

#[test]
fn content_left_out_is_noted() {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    json["animations"] = json!([{ "samplers": [], "channels": [] }]);
    json["cameras"] = json!([{}, {}]);
    json["skins"] = json!([{ "joints": [0] }]);
    json["scenes"] = json!([{ "nodes": [0] }, {}]);
    json["meshes"][0]["primitives"][0]["targets"] = json!([{ "NORMAL": 0 }]);
    for name in ["COLOR_1", "JOINTS_1", "WEIGHTS_1"] {
        json["meshes"][0]["primitives"][0]["attributes"][name] = json!(0);
    }
    for mode in [0, 1, 2, 3] {
        let lines = json!({ "attributes": { "POSITION": 0 }, "mode": mode });
        let primitives = json["meshes"][0]["primitives"].as_array_mut().unwrap();
        primitives.push(lines);
    }
    json["meshes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "primitives": [] }));
    json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_mesh_quantization", "KHR_xmp"]);
    json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    json["textures"] = json!([{ "source": 0 }, { "extensions": {} }]);
    json["images"] = json!([{ "uri": "wood.png" }]);
    json["materials"] = json!([
        { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } }, "normalTexture": { "index": 1 } },
    ]);
    json["meshes"][0]["primitives"][0]["material"] = json!(0);
    json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{}, {}, {}] } });
    json["nodes"][0]["skin"] = json!(0);
    let extensions = json!({ "KHR_materials_ior": { "ior": 1.4 }, "KHR_materials_unlit": {} });
    json["materials"][0]["extensions"] = extensions;
    let kept = read_json(&json).unwrap();
    let loaded = read_baked(&json).unwrap();
    // The first call keeps the nodes with their cameras, lights and skins. The second call leaves them out and reports
    // this in three more notes.
    assert_eq!(kept.notes.len(), loaded.notes.len() - 3);
    let is_left_out =
        |note: &mesh_io::Note| note.what.contains("cameras") || note.what.contains("lights");
    assert!(!kept.notes.iter().any(is_left_out));
    let notes: Vec<String> = loaded
        .notes
        .iter()
        .map(|n| format!("{} {}", n.count, n.what))
        .collect();
    let expected = [
        "3 lights",
        "1 uses of the extension \"KHR_xmp\"",
        "1 uses of the extension \"KHR_materials_ior\"",
        "1 other scenes",
        "1 animations",
        "1 skins",
        "2 cameras",
        "1 meshes left out",
        "1 attributes NORMAL of morph targets left out",
        "1 primitives of points",
        "3 primitives of lines",
        "1 attributes COLOR_1",
        "1 attributes JOINTS_1",
        "1 attributes WEIGHTS_1",
        "1 textures without a supported image left out",
        "1 image `wood.png` left out",
    ];
    for words in expected {
        assert!(
            notes.iter().any(|note| note.contains(words)),
            "{words}: {notes:#?}"
        );
    }
    assert_eq!(notes.len(), expected.len(), "{notes:#?}");
    assert_eq!(
        loaded.objects[0].materials[0].base_color_texture,
        Some(scene::Texture::file("wood.png"))
    );
}
