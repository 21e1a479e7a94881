//! Checks that [`mesh_io::peek`] reports the content that reading would leave out.

use mesh::Domain;
use mesh_io::{
    CleanupPolicy, NonManifold, PeekGeometry, PeekObject, PeekRanges, Policies, ReadOptions, peek,
    read,
};
use scene::{Graph, Object};
use store::{Memory, Store};

/// Checks that peeking at a file gives exactly the expected notes, and that reading gives these notes too. Each
/// expected string is a part of the text of a note.
#[track_caller]
fn peek_notes(files: &[(&str, &[u8])], expected: &[&str]) {
    let store = Memory::default();
    for (path, bytes) in files {
        store.write(path.as_ref(), bytes).unwrap();
    }
    let path = files[0].0.as_ref();
    let options = ReadOptions::default();
    let read = read(&store, path, &options).unwrap();
    let peek = peek(&store, path, &options).unwrap();
    for note in &peek.left_out {
        assert!(
            read.notes.contains(note),
            "{note} is not in {:?}",
            read.notes
        );
    }
    let found: Vec<String> = peek.left_out.iter().map(ToString::to_string).collect();
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (note, expected) in found.iter().zip(expected) {
        assert!(note.contains(expected), "{note}");
    }
    assert_eq!(peek.graph, without_numbers(&read.graph));
    for (peek, read) in peek.objects.iter().zip(&read.objects) {
        if let Some(materials) = &peek.materials {
            let names: Vec<&String> = read.materials.iter().map(|m| &m.name).collect();
            assert_eq!(materials.iter().collect::<Vec<_>>(), names);
        }
        check_counts(peek, read, options.policies);
    }
}

/// Compares the mesh that was read from a file with the result of peeking. The counts of the mesh must be in the
/// predicted ranges, and peeking must predict each attribute of the mesh.
#[track_caller]
fn check_counts(peek: &PeekObject, read: &Object, policies: Policies) {
    let (PeekGeometry::Mesh(counts), Some(mesh)) = (&peek.geometry, read.as_mesh()) else {
        return;
    };
    let ranges = counts.ranges(policies);
    assert!(
        ranges.vertices.contains(&(mesh.n_vertices() as u64)),
        "{ranges:?}"
    );
    assert!(
        ranges.edges.contains(&(mesh.n_edges() as u64)),
        "{ranges:?}"
    );
    assert!(
        ranges.faces.contains(&(mesh.n_faces() as u64)),
        "{ranges:?}"
    );
    for f in mesh.faces() {
        assert!(
            ranges.degrees.contains(&(mesh.degree(f) as u64)),
            "{ranges:?}"
        );
    }
    let Some(others) = &peek.attributes else {
        return;
    };
    for (domain, column) in mesh.attributes().iter() {
        let is_described = !counts.is_exact
            && match (domain, column.name.as_str()) {
                (Domain::Corner, "uv") => counts.uvs,
                (Domain::Vertex | Domain::Corner, "normal") => counts.normals,
                (Domain::Vertex, "color") => counts.colors,
                (Domain::Face, "material") => counts.materials,
                _ => false,
            };
        let is_listed = others
            .iter()
            .any(|(d, name)| *d == domain && *name == column.name);
        assert!(
            is_described || is_listed,
            "{domain} {} is not in the result of peeking",
            column.name
        );
    }
}

/// Reads and peeks at a file with these policies, and returns the counts that peeking predicts.
#[track_caller]
fn ranges(path: &str, bytes: &[u8], policies: Policies) -> PeekRanges {
    let store = Memory::default();
    store.write(path.as_ref(), bytes).unwrap();
    let options = ReadOptions {
        policies,
        ..ReadOptions::default()
    };
    let read = read(&store, path.as_ref(), &options).unwrap();
    let peek = peek(&store, path.as_ref(), &options).unwrap();
    check_counts(&peek.objects[0], &read.objects[0], policies);
    let PeekGeometry::Mesh(mesh) = peek.objects[0].geometry else {
        panic!("expected a mesh");
    };
    mesh.ranges(policies)
}

#[test]
fn counts_are_exact_unless_faces_are_dropped_or_vertices_split() {
    let torus = Object::mesh("a", geometry::shapes::torus(7, 5, 2.0, 0.5));
    let mut scene = scene::Scene::new();
    scene.insert(torus).unwrap();
    for extension in ["obj", "ply", "off", "mws", "stl"] {
        let path = format!("a.{extension}");
        let store = Memory::default();
        let options = mesh_io::WriteOptions::default();
        mesh_io::write(&store, path.as_ref(), &scene, &options).unwrap();
        let bytes = store.read(path.as_ref()).unwrap();
        let faces = if extension == "stl" { 70 } else { 35 };
        for non_manifold in [NonManifold::Split, NonManifold::Refuse] {
            for drop in [CleanupPolicy::Keep, CleanupPolicy::Drop] {
                let policies = Policies {
                    non_manifold,
                    duplicates: drop,
                    isolated: drop,
                    ..Policies::default()
                };
                let found = ranges(&path, &bytes, policies);
                if drop == CleanupPolicy::Keep {
                    assert_eq!(found.faces, faces..=faces, "{path}");
                    assert!(*found.edges.start() >= faces * 3 / 2, "{path}");
                    if extension != "stl" {
                        assert_eq!(*found.vertices.start(), 35, "{path}");
                        assert_eq!(found.degrees, 4..=4, "{path}");
                    }
                }
            }
        }
    }
}

#[test]
fn faces_that_reading_may_drop_do_not_count_as_certain() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    for (faces, certain) in [
        ("f 1 2 3\nf 2 4 3\n", 2),
        ("f 1 2 3\nf 2 2 3\n", 1),
        ("f 1 2 3\nf 2 02 3\n", 1),
        ("f 1 2 3\nf 2 -3 3\n", 1),
        ("f 1/1 2 3\nf -3 -1 -2\n", 2),
        ("f 1 2 3 1 4\nf 2 4 3\n", 1),
    ] {
        let text = format!("{points}vt 0 0\n{faces}");
        let found = ranges("a.obj", text.as_bytes(), Policies::default());
        assert_eq!(*found.faces.start(), certain, "{faces}");
    }
    let off = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 1 2\n3 1 3 2 1 0 0\n";
    let found = ranges("a.off", off.as_bytes(), Policies::default());
    assert_eq!(*found.faces.start(), 2);
    let drops = Policies {
        degenerate: CleanupPolicy::Drop,
        ..Policies::default()
    };
    let found = ranges("a.off", off.as_bytes(), drops);
    assert_eq!(*found.faces.start(), 0);
}

#[test]
fn strict_peeking_fails_if_content_would_be_left_out() {
    let text = format!("{TRIANGLE}vp 1\nf 1 2 3\n");
    let store = Memory::default();
    store.write("a.obj".as_ref(), text.as_bytes()).unwrap();
    let options = |strict| ReadOptions {
        strict,
        ..ReadOptions::default()
    };
    assert!(peek(&store, "a.obj".as_ref(), &options(false)).is_ok());
    let refused = peek(&store, "a.obj".as_ref(), &options(true)).unwrap_err();
    let read = read(&store, "a.obj".as_ref(), &options(true)).unwrap_err();
    assert_eq!(refused.to_string(), read.to_string());
}

#[test]
fn lists_of_ply_that_are_left_out() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property list uchar float weights\nproperty float quality\nelement face 1\n\
        property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty list uchar int other\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n\
        0 0 0 1 5 1\n1 0 0 1 5 1\n0 1 0 1 5 1\n3 0 1 2 6 0 0 1 0 0 1 1 7 255 0 0\n";
    peek_notes(&[("a.ply", text.as_bytes())], &["weights", "other"]);
}

/// Returns a copy of the graph without the arrays of numbers, which peeking at a glTF file does not read.
pub(crate) fn without_numbers(graph: &Graph) -> Graph {
    let mut graph = graph.clone();
    graph.arrays.clear();
    for skin in &mut graph.skins {
        skin.inverse_bind_matrices = None;
    }
    let animations = graph.animations.iter_mut();
    for sampler in animations.flat_map(|animation| &mut animation.samplers) {
        (sampler.input, sampler.output) = (0, 0);
    }
    graph
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn statements_materials_and_images_of_obj() {
    let text = format!(
        "{TRIANGLE}mtllib a.mtl b.mtl\nusemtl red\nvp 1\nf 1 2 3\nl 1 2\np 1 2\nf 1 2\nvp 2\nusemtl blue\nf 1 2 3\n"
    );
    peek_notes(
        &[
            ("a.obj", text.as_bytes()),
            (
                "a.mtl",
                b"newmtl red\nmap_Kd red.png\nnewmtl green\nmap_Kd here.png\n",
            ),
            ("here.png", b"\x89PNG\r\n"),
        ],
        &[
            "a.obj:6: 2 statements `vp` left out",
            "a.obj:9: 2 points (`p`) left out",
            "a.obj:10: 1 face with fewer than 3 corners left out",
            "1 polyline (`l`) left out",
            "material library `b.mtl` left out",
            "image `red.png` left out: the file ./red.png does not exist",
        ],
    );
}

#[test]
fn elements_and_extra_bytes_of_ply() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element camera 2\nproperty float fov\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let text = format!("{header}0 0 0\n1 0 0\n0 1 0\n30\n40\n3 0 1 2\nrest\n");
    peek_notes(
        &[("a.ply", text.as_bytes())],
        &[
            "a.ply:18: 1 line left out after the last element",
            "a.ply:7: 2 rows of element `camera`",
        ],
    );
}

#[test]
fn attribute_bytes_and_extra_bytes_of_stl() {
    let mut bytes = vec![0; 80];
    bytes.extend_from_slice(&2_u32.to_le_bytes());
    for k in 0..2_u8 {
        for x in [
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            f32::from(k),
            1.0,
            0.0,
            0.0,
            0.0,
            1.0,
            0.0,
        ] {
            bytes.extend_from_slice(&f32::to_le_bytes(x));
        }
        bytes.extend_from_slice(&[0, k]);
    }
    bytes.extend_from_slice(b"more");
    peek_notes(
        &[("a.stl", &bytes)],
        &[
            "4 bytes left out after the last facet",
            "1 facet with attribute bytes",
        ],
    );
}

#[test]
fn small_faces_and_extra_lines_of_off() {
    peek_notes(
        &[(
            "a.off",
            b"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\nmore\nlines\n",
        )],
        &[
            "a.off:6: 1 face with fewer than 3 corners",
            "a.off:8: 2 lines left out after the last face",
        ],
    );
}

#[test]
fn images_of_gltf() {
    let json = r#"{
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 1 }] }],
        "materials": [
            { "name": "unused", "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 } } },
            { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } }, "normalTexture": { "index": 1 },
                "emissiveTexture": { "index": 2 } }
        ],
        "textures": [{ "source": 0 }, { "source": 1 }, {}],
        "images": [{ "uri": "red%20one.png" }, { "uri": "here.png" }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0] }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "buffers": [{ "uri": "a.bin", "byteLength": 36 }]
    }"#;
    let bin: Vec<u8> = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        .iter()
        .flat_map(|x: &f32| x.to_le_bytes())
        .collect();
    peek_notes(
        &[
            ("a.gltf", json.as_bytes()),
            ("a.bin", &bin),
            ("here.png", b"\x89PNG\r\n"),
        ],
        &[
            "1 material left out: not used by any triangles",
            "1 texture without a supported image left out",
            "image `red one.png` left out: the file ./red one.png does not exist",
        ],
    );
}
