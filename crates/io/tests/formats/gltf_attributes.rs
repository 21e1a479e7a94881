//! Tests of glTF files with custom attributes, and with integers instead of floats.

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4, Vec2Swizzles};
use mesh::{Column, Domain, Mesh, Rule, UV, Value};
use mesh_io::ReadError;
use scene::Object;
use serde_json::json;

use crate::gltf_read::{SQUARE, document, floats, read_json, square};
use crate::gltf_written::sphere;
use crate::{Folder, assert_same, only, tag, write};

pub(crate) fn add_column<T: Value>(mesh: &mut Mesh, domain: Domain, name: &str, values: Vec<T>) {
    let column = Column {
        name: name.to_owned(),
        rule: Rule::Interpolate,
        values: T::wrap(values),
    };
    mesh.insert_column(domain, column);
}

#[test]
fn custom_attributes_survive_a_round_trip() {
    for name in ["a.glb", "a.gltf"] {
        let folder = Folder::new();
        let path = folder.path(name);
        let mut mesh = sphere();
        let n = mesh.n_vertices();
        let numbers = || (0..n).map(|i| i as f64 * 0.25);
        add_column(&mut mesh, Domain::Vertex, "quality", numbers().collect());
        add_column(
            &mut mesh,
            Domain::Vertex,
            "é 2",
            numbers().map(DVec2::splat).collect(),
        );
        add_column(
            &mut mesh,
            Domain::Vertex,
            "flow",
            numbers().map(DVec3::splat).collect(),
        );
        add_column(
            &mut mesh,
            Domain::Vertex,
            "_uv",
            numbers().map(DVec4::splat).collect(),
        );
        mesh.set(mesh::VERTEX_SHARPNESS, numbers().collect());
        let uvs: Vec<DVec2> = mesh.get(UV).unwrap().iter().map(|uv| uv.yx()).collect();
        add_column(&mut mesh, Domain::Corner, "uv1", uvs);
        let mut stress = vec![DVec3::ZERO; mesh.n_half_edges()];
        for f in mesh.faces() {
            for h in mesh.face_half_edges(f) {
                stress[h.index()] = DVec3::splat((f.index() % 2) as f64);
            }
        }
        add_column(&mut mesh, Domain::Corner, "stress", stress);
        let report = write(&path, [Object::mesh("a", mesh.clone())]);
        assert_eq!(report.losses, []);
        assert_same(only(&path).as_mesh().unwrap(), &mesh);
        // The `gltf` crate, which is another reader, also accepts the file.
        assert!(gltf::Gltf::open(&path).is_ok());
    }
}

#[test]
fn values_that_gltf_cannot_store_are_losses() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let mut mesh = shapes::octahedron();
    let (n, n_corners) = (mesh.n_vertices(), mesh.n_half_edges());
    tag(&mut mesh, Domain::Vertex, "picked", vec![true; n]);
    add_column(&mut mesh, Domain::Vertex, "count", vec![1_i32; n]);
    add_column(&mut mesh, Domain::Vertex, "huge", vec![1e300; n]);
    add_column(&mut mesh, Domain::Vertex, "material", vec![0.5; n]);
    add_column(
        &mut mesh,
        Domain::Corner,
        "uv2",
        vec![DVec2::ONE; n_corners],
    );
    mesh.set(mesh::TANGENT, vec![DVec3::X; n]);
    let report = write(&path, [Object::mesh("a", mesh)]);
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|loss| loss.attribute.as_str())
        .collect();
    assert_eq!(
        lost,
        ["count", "material", "picked", "tangent", "uv2", "huge"]
    );
    let back = only(&path);
    assert_eq!(back.as_mesh().unwrap().attributes().iter().count(), 1);
}

#[test]
fn reserved_and_taken_names_keep_their_underscore() {
    let mut bytes = floats(&SQUARE);
    bytes.extend(floats(&[1.0, 2.0, 3.0, 4.0]));
    let accessors = json!([
        { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
        { "bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "SCALAR" },
    ]);
    let attributes = json!({ "POSITION": 0, "_normal": 1, "_TEMP": 1, "_uv": 1, "__uv": 1 });
    let json = document(
        &bytes,
        &accessors,
        &json!([{ "attributes": attributes, "mode": 6 }]),
    );
    let loaded = read_json(&json).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    let names: Vec<_> = mesh
        .attributes()
        .iter()
        .map(|(_, c)| c.name.as_str())
        .collect();
    assert_eq!(names, ["TEMP", "_normal", "_uv"]);
    assert_eq!(loaded.notes.len(), 1, "{:?}", loaded.notes);
}

#[test]
fn attributes_of_some_primitives_are_zero_in_the_others() {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    json["accessors"].as_array_mut().unwrap().push(json!({
        "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "byteOffset": 0
    }));
    json["meshes"][0]["primitives"] = json!([
        { "attributes": { "POSITION": 0, "_a": 2 }, "indices": 1 },
        { "attributes": { "POSITION": 2, "_b": 2 }, "indices": 1 },
    ]);
    let loaded = read_json(&json).unwrap();
    assert!(
        loaded
            .notes
            .iter()
            .any(|note| note.count == 2 && note.what.contains("only some"))
    );
    let names: Vec<_> = loaded.objects[0]
        .as_mesh()
        .unwrap()
        .attributes()
        .iter()
        .map(|(_, c)| c.name.clone())
        .collect();
    assert_eq!(names, ["a", "b"]);
}

#[test]
fn quantized_positions_normals_and_coordinates_are_read() {
    // Positions are signed 16-bit integers that are not normalized, normals are normalized bytes, and texture
    // coordinates are bytes.
    let mut bytes = Vec::new();
    for [x, y] in [[0_i16, 0], [300, 0], [300, 300], [0, -300]] {
        for value in [x, y, 7, 0] {
            bytes.extend(value.to_le_bytes());
        }
    }
    for _ in 0..4 {
        bytes.extend([0_u8, 0, 127, 0]);
    }
    for [u, v] in [[0_u8, 255], [255, 255], [255, 0], [0, 0]] {
        bytes.extend([u, v, 0, 0]);
    }
    let accessors = json!([
        { "bufferView": 1, "componentType": 5122, "count": 4, "type": "VEC3" },
        { "bufferView": 2, "componentType": 5120, "count": 4, "type": "VEC3", "normalized": true },
        { "bufferView": 3, "componentType": 5121, "count": 4, "type": "VEC2", "normalized": true },
    ]);
    let attributes = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 });
    let mut json = document(
        &bytes,
        &accessors,
        &json!([{ "attributes": attributes, "mode": 6 }]),
    );
    json["bufferViews"] = json!([
        { "buffer": 0, "byteLength": 0 },
        { "buffer": 0, "byteLength": 32, "byteStride": 8 },
        { "buffer": 0, "byteOffset": 32, "byteLength": 16, "byteStride": 4 },
        { "buffer": 0, "byteOffset": 48, "byteLength": 16, "byteStride": 4 },
    ]);
    json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let loaded = read_json(&json).unwrap();
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    let mesh = loaded.objects[0].as_mesh().unwrap();
    assert_eq!(mesh.positions()[1], DVec3::new(300.0, 0.0, 7.0));
    assert_eq!(mesh.get(mesh::VERTEX_NORMAL).unwrap()[0], DVec3::Z);
    let uvs = mesh.get(UV).unwrap();
    let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    for h in corners.filter(|&h| mesh.origin(h).index() == 1) {
        assert_eq!(uvs[h.index()], DVec2::new(1.0, 0.0));
    }
}

#[test]
fn compressed_files_are_refused_with_advice() {
    for (name, words) in [
        ("KHR_other", "\"KHR_other\", which is not supported"),
        ("KHR_something", "\"KHR_something\", which is not supported"),
    ] {
        let mut json = square(&[0, 1, 2], 4);
        json["extensionsRequired"] = json!([name]);
        match read_json(&json) {
            Err(ReadError::Json { message, .. }) => {
                assert!(
                    message.contains(name) && message.contains(words),
                    "{message}"
                );
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn colors_of_every_type_are_read() {
    // The components of the colors, in units of 1/5.
    let colors = [[0_u8, 1, 5, 2], [5, 3, 0, 4]];
    for components in [3_usize, 4] {
        for (component, size) in [(5121, 1), (5123, 2), (5126, 4)] {
            let mut bytes = floats(&SQUARE);
            let stride = (components * size).next_multiple_of(4);
            for i in 0..4 {
                let start = bytes.len();
                for &x in &colors[i % 2][..components] {
                    match size {
                        1 => bytes.push(x * 51),
                        2 => bytes.extend((u16::from(x) * 13107).to_le_bytes()),
                        _ => bytes.extend((f32::from(x) / 5.0).to_le_bytes()),
                    }
                }
                bytes.resize(start + stride, 0);
            }
            let kind = format!("VEC{components}");
            let accessors = json!([
                { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
                { "bufferView": 1, "componentType": component, "normalized": size < 4, "count": 4, "type": kind },
            ]);
            let attributes = json!({ "POSITION": 0, "COLOR_0": 1 });
            let mut json = document(
                &bytes,
                &accessors,
                &json!([{ "attributes": attributes, "mode": 6 }]),
            );
            json["bufferViews"] = json!([
                { "buffer": 0, "byteLength": 48 },
                { "buffer": 0, "byteOffset": 48, "byteLength": 4 * stride, "byteStride": stride },
            ]);
            let loaded = read_json(&json).unwrap();
            assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
            let mesh = loaded.objects[0].as_mesh().unwrap();
            for (i, color) in mesh.get(mesh::COLOR).unwrap().iter().enumerate() {
                let mut expected = DVec4::from_array(colors[i % 2].map(f64::from)) / 5.0;
                if components == 3 {
                    expected.w = 1.0;
                }
                assert!((*color - expected).length() < 1e-6, "{component} {kind}");
            }
        }
    }
}

#[test]
fn sparse_accessors_do_not_need_a_buffer_view() {
    // Without a buffer view, all four positions are zero. Sparse values replace three of them with the other corners of
    // the square.
    let mut bytes = floats(&SQUARE[3..]);
    bytes.extend([1_u8, 2, 3, 0]);
    let accessors = json!([{
        "componentType": 5126, "count": 4, "type": "VEC3",
        "sparse": {
            "count": 3,
            "indices": { "bufferView": 0, "byteOffset": 36, "componentType": 5121 },
            "values": { "bufferView": 0 },
        },
    }]);
    let primitives = json!([{ "attributes": { "POSITION": 0 }, "mode": 6 }]);
    let loaded = read_json(&document(&bytes, &accessors, &primitives)).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    let corner = |p: &[f32]| DVec3::new(p[0].into(), p[1].into(), p[2].into());
    let expected: Vec<_> = SQUARE.chunks(3).map(corner).collect();
    assert_eq!(mesh.positions(), expected);
}
