//! Tests of glTF files with compressed buffer views. The program `gltfpack` wrote the files; see `meshopt/make.mjs`.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mesh::{Domain, Mesh, Values};
use mesh_io::ReadError;
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::gltf_read::{document, read_json};
use crate::{Folder, assert_same, only, read};

fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/formats/meshopt");
    folder.join(name)
}

fn torus(name: &str) -> Mesh {
    only(&file(name)).as_mesh().unwrap().as_ref().clone()
}

/// Returns the values of an attribute at each corner of each face, for an attribute of any domain.
fn corners(mesh: &Mesh, name: &str) -> Vec<Vec<f64>> {
    let find = |domain| {
        let columns = mesh.attributes().of(domain);
        columns.iter().find(|column| column.name == name)
    };
    let column = find(Domain::Corner).or(find(Domain::Vertex)).unwrap();
    let is_corner = find(Domain::Corner).is_some();
    let half_edges = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    half_edges
        .map(|h| {
            let v = mesh.origin(h);
            let i = if is_corner { h.index() } else { v.index() };
            match &column.values {
                Values::Vec2(values) => values[i].to_array().to_vec(),
                Values::Vec3(values) => values[i].to_array().to_vec(),
                Values::Vec4(values) => values[i].to_array().to_vec(),
                other => panic!("{other:?}"),
            }
        })
        .collect()
}

/// Returns the positions and attributes at the corners of each triangle. The corners of each triangle are listed in
/// order, starting at the smallest corner. The triangles are sorted.
fn triangles(mesh: &Mesh) -> Vec<Vec<Vec<f64>>> {
    let half_edges = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    let corners: Vec<Vec<f64>> = half_edges
        .zip(corners(mesh, "uv"))
        .zip(
            corners(mesh, "normal")
                .into_iter()
                .zip(corners(mesh, "color")),
        )
        .map(|((h, uv), (normal, color))| {
            let position = mesh.position(mesh.origin(h)).to_array();
            [&position[..], &uv, &normal, &color].concat()
        })
        .collect();
    let mut triangles: Vec<_> = corners.chunks(3).map(<[_]>::to_vec).collect();
    for triangle in &mut triangles {
        let lowest = (0..3).min_by(|&a, &b| triangle[a].partial_cmp(&triangle[b]).unwrap());
        triangle.rotate_left(lowest.unwrap());
    }
    triangles.sort_by(|a, b| a.partial_cmp(b).unwrap());
    triangles
}

#[test]
fn a_compressed_file_gives_the_same_mesh_as_an_uncompressed_one() {
    let plain = torus("torus_plain.glb");
    assert_eq!((plain.n_vertices(), plain.n_faces()), (12 * 8, 2 * 12 * 8));
    // The codec for triangles can start a triangle at a different corner, so the function `triangles` rearranges the
    // corners before they are compared.
    for name in ["torus_ext.glb", "torus_fallback.gltf"] {
        let mesh = torus(name);
        assert_eq!(mesh.positions(), plain.positions());
        assert!(triangles(&mesh) == triangles(&plain), "{name}");
    }
}

#[test]
fn decoded_views_equal_the_fallback_buffer() {
    let gltf = std::fs::read(file("torus_fallback.gltf")).unwrap();
    let mut json: Value = serde_json::from_slice(&gltf).unwrap();
    for key in ["bufferViews", "buffers"] {
        for piece in json[key].as_array_mut().unwrap() {
            piece.as_object_mut().unwrap().remove("extensions");
        }
    }
    let folder = Folder::new();
    for name in ["torus_fallback.bin", "torus_fallback.fallback.bin"] {
        folder.with(name, std::fs::read(file(name)).unwrap());
    }
    let path = folder.with("a.gltf", json.to_string());
    let fallback = only(&path);
    let fallback = triangles(fallback.as_mesh().unwrap());
    assert!(fallback == triangles(&torus("torus_fallback.gltf")));
}

#[test]
fn filtered_values_are_close_and_positions_equal() {
    let plain = triangles(&torus("torus_fallback.gltf"));
    let filtered = triangles(&torus("torus_khr.glb"));
    assert_eq!(plain.len(), filtered.len());
    for (a, b) in plain.concat().iter().zip(&filtered.concat()) {
        // The first five numbers are the position and the texture coordinates.
        assert_eq!(a[..5], b[..5]);
        // The other numbers are normals, which have 8 bits, and then colors.
        assert!(
            a[5..8]
                .iter()
                .zip(&b[5..8])
                .all(|(a, b)| (a - b).abs() < 2.5 / 127.0)
        );
        assert!(
            a[8..]
                .iter()
                .zip(&b[8..])
                .all(|(a, b)| (a - b).abs() < 1.5 / 255.0)
        );
    }
}

#[test]
fn float_positions_are_decoded_accurately() {
    let mesh = torus("torus_floats.glb");
    assert_eq!(mesh.n_faces(), 2 * 12 * 8);
    for p in mesh.positions() {
        let from_circle = glam::DVec2::new(p.truncate().length() - 2.0, p.z).length();
        assert!((from_circle - 0.75).abs() < 1e-3, "{p}");
    }
    for normal in corners(&mesh, "normal") {
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() < 1e-2);
    }
}

#[test]
fn fallback_buffers_are_never_read() {
    let folder = Folder::new();
    let gltf = std::fs::read(file("torus_fallback.gltf")).unwrap();
    folder.with(
        "torus_fallback.bin",
        std::fs::read(file("torus_fallback.bin")).unwrap(),
    );
    // The file of the fallback buffer is missing. The file `a.gltf` declares the buffer as a fallback, but the file
    // `b.gltf` does not.
    let path = folder.with("a.gltf", &gltf);
    assert_same(
        only(&path).as_mesh().unwrap(),
        &torus("torus_fallback.gltf"),
    );
    let mut json: Value = serde_json::from_slice(&gltf).unwrap();
    for buffer in json["buffers"].as_array_mut().unwrap() {
        buffer.as_object_mut().unwrap().remove("extensions");
    }
    let path = folder.with("b.gltf", json.to_string());
    assert_same(
        only(&path).as_mesh().unwrap(),
        &torus("torus_fallback.gltf"),
    );
    // In the file `c.gltf`, a buffer view without compression needs the missing buffer, so reading fails.
    json["bufferViews"][0]
        .as_object_mut()
        .unwrap()
        .remove("extensions");
    let path = folder.with("c.gltf", json.to_string());
    assert!(matches!(read(&path), Err(ReadError::Json { .. })));
}

/// A document with `count` positions in a compressed stream, without indices.
fn points(stream: &[u8], count: u64) -> Value {
    let accessors =
        json!([{ "bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3" }]);
    let mut json = document(
        stream,
        &accessors,
        &json!([{ "attributes": { "POSITION": 0 } }]),
    );
    let length = count.saturating_mul(12);
    json["bufferViews"] = json!([{
        "buffer": 1, "byteLength": length, "byteStride": 12,
        "extensions": { "EXT_meshopt_compression": {
            "buffer": 0, "byteLength": stream.len(), "byteStride": 12, "count": count, "mode": "ATTRIBUTES",
        } },
    }]);
    let buffers = json["buffers"].as_array_mut().unwrap();
    buffers.push(json!({ "byteLength": length }));
    json["extensionsUsed"] = json!(["EXT_meshopt_compression"]);
    json["extensionsRequired"] = json!(["EXT_meshopt_compression"]);
    json
}

#[test]
fn errors_in_streams_name_the_pointer() {
    let mut stream = vec![0xa0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    stream.extend([0; 32]);
    assert!(read_json(&points(&stream, 6)).is_ok());
    for (change, to, pointer, words) in [
        ("/byteLength", json!(44), "", "expected 1 more byte"),
        (
            "/byteLength",
            json!(46),
            "/byteLength",
            "46 bytes from byte 0",
        ),
        (
            "/byteOffset",
            json!(1),
            "/byteLength",
            "45 bytes from byte 1",
        ),
        (
            "/byteOffset",
            json!(u64::MAX),
            "/byteLength",
            "45 bytes from",
        ),
        (
            "/buffer",
            json!(9),
            "/buffer",
            "buffer 9 does not exist (the file has 2)",
        ),
        ("/count", json!(7), "", "do not match the 72 bytes"),
        ("/count", json!(-1), "", "invalid value"),
        ("/mode", json!("TRIANGLES"), "", "2 or 4"),
        ("/filter", json!("COLOR"), "", "Color"),
        ("/mode", json!(null), "", "expected"),
    ] {
        let mut json = points(&stream, 6);
        let at = "/bufferViews/0/extensions/EXT_meshopt_compression";
        json.pointer_mut(at).unwrap()[&change[1..]] = to;
        match read_json(&json) {
            Err(ReadError::Json {
                pointer: found,
                message,
                ..
            }) => {
                assert_eq!(found, format!("{at}{pointer}"), "{change}: {message}");
                assert!(message.contains(words), "{change}: {message}");
            }
            other => panic!("{change}: {other:?}"),
        }
    }
}

#[test]
fn a_small_stream_of_four_billion_vertices_is_refused_at_once() {
    for count in [4_294_967_295_u64, u64::MAX / 12, u64::MAX] {
        let json = points(&[0xa0; 60], count);
        let start = Instant::now();
        let error = read_json(&json).unwrap_err();
        assert!(start.elapsed() < Duration::from_millis(50));
        assert!(error.to_string().contains("bytes"), "{error}");
    }
}

#[test]
fn decoded_views_are_limited_to_64_times_the_file() {
    // Each block stores 256 equal elements in 3 bytes.
    let stream = |blocks: usize| {
        let mut stream = vec![0xa1];
        stream.resize(1 + 3 * blocks, 0xaa);
        stream.resize(1 + 3 * blocks + 24, 0);
        stream
    };
    let count = |blocks: usize| 256 * blocks as u64 / 3 * 3;
    for (blocks, is_fine) in [(10, true), (10_000, false)] {
        let mut json = points(&stream(blocks), count(blocks));
        // The mode 4 means triangles. All points are equal and are merged into one vertex, so the triangles are left
        // out.
        json["meshes"][0]["primitives"][0]["mode"] = json!(4);
        let result = read_json(&json);
        assert_eq!(result.is_ok(), is_fine, "{blocks}");
        if let Err(error) = result {
            assert!(error.to_string().contains("more than 64 times"), "{error}");
        }
    }
}

/// Returns a document with rows of triangles. Each triangle has three separate vertices and needs about two bytes,
/// which is close to the best possible compression.
fn dense_triangles(n: usize) -> Value {
    // Each element has 8 bytes: x, y, z and padding. From element to element, x increases by 1. Every 256 elements, y
    // increases by 1, and every 65536 elements, z increases by 1.
    let mut stream = vec![0xa0];
    let blocks = (3 * n).div_ceil(256);
    for block in 0..blocks {
        let one = |is: bool| {
            [
                &[u8::from(is), 0, 0, 0][..],
                &[0x80, 0, 0, 0][..if is { 4 } else { 0 }],
            ]
            .concat()
        };
        stream.extend([0x55; 4]);
        stream.extend([0xaa; 64]);
        stream.extend([0; 4]);
        stream.extend(one(true));
        stream.extend([0; 4]);
        stream.extend(one(block % 256 == 0));
        stream.extend([0; 12]);
    }
    stream.extend([0; 32]);
    let vertices = stream.len();
    stream.push(0xe1);
    stream.resize(vertices + 1 + n, 0xf0);
    stream.resize(vertices + 1 + n + 16, 0);
    let accessors = json!([
        { "bufferView": 0, "componentType": 5123, "count": 256 * blocks, "type": "VEC3" },
        { "bufferView": 1, "componentType": 5125, "count": 3 * n, "type": "SCALAR" },
    ]);
    let primitives = json!([{ "attributes": { "POSITION": 0 }, "indices": 1 }]);
    let mut json = document(&stream, &accessors, &primitives);
    json["bufferViews"] = json!([
        { "buffer": 1, "byteLength": 2048 * blocks, "byteStride": 8, "extensions": { "KHR_meshopt_compression": {
            "buffer": 0, "byteLength": vertices, "byteStride": 8, "count": 256 * blocks, "mode": "ATTRIBUTES",
        } } },
        { "buffer": 1, "byteLength": 12 * n, "extensions": { "KHR_meshopt_compression": {
            "buffer": 0, "byteOffset": vertices, "byteLength": n + 17, "byteStride": 4, "count": 3 * n,
            "mode": "TRIANGLES",
        } } },
    ]);
    let buffers = json["buffers"].as_array_mut().unwrap();
    buffers.push(json!({ "byteLength": 2048 * blocks }));
    json
}

#[test]
fn well_compressed_files_are_read() {
    // The second mesh needs more memory than 64 times the size of the file, and more than the smallest memory budget.
    for n in [85, 60_000] {
        let loaded = read_json(&dense_triangles(n)).unwrap();
        let mesh = loaded.objects[0].as_mesh().unwrap();
        assert_eq!(mesh.n_faces(), n);
        assert_eq!(mesh.n_vertices(), 3 * n);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn changed_files_do_not_panic(
        name in prop::sample::select(vec!["torus_ext.glb", "torus_khr.glb", "torus_floats.glb"]),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = std::fs::read(file(name)).unwrap();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        let folder = Folder::new();
        let _ = read(&folder.with("a.glb", bytes));
    }
}
