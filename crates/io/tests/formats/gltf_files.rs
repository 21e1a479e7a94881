//! glTF files: what is written is read by the `gltf` crate with its validation, what is read is made
//! by hand.

use glam::{DVec2, DVec3, DVec4};
use mesh::{CORNER_NORMAL, Domain, MATERIAL, Mesh, UV, VERTEX_NORMAL, shapes};
use mesh_io::{PeekGeometry, ReadError, ReadOptions, WriteOptions};
use proptest::prelude::*;
use scene::{Geometry, Material, Object};
use serde_json::{Value, json};

use crate::{Folder, assert_same, only, polygons, read, scene, tag, write};

// ---- Written files -----------------------------------------------------------------------------

/// A sphere of triangles with a seam in its texture, and normals.
fn sphere() -> Mesh {
    let mut mesh = shapes::icosahedron();
    for p in mesh.positions_mut() {
        *p = p.as_vec3().as_dvec3();
    }
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            let p = mesh.position(mesh.origin(h));
            let wraps = mesh.face_center(f).x < 0.0 && p.y < 0.0;
            let u = if wraps { 0.75 } else { 0.25 };
            uvs[h.index()] = DVec2::new(u, if p.z > 0.0 { 0.5 } else { 0.125 });
        }
    }
    mesh.set(UV, uvs);
    mesh
}

/// What the `gltf` crate finds in a file: for each object the corners of its triangles, as positions
/// and texture coordinates (v downwards).
fn oracle(path: &std::path::Path) -> Vec<(String, Vec<([f32; 3], Option<[f32; 2]>)>)> {
    let file = gltf::Gltf::open(path).unwrap();
    let mut objects = Vec::new();
    for node in file.scenes().next().unwrap().nodes() {
        let mut corners = Vec::new();
        for primitive in node.mesh().into_iter().flat_map(|mesh| mesh.primitives()) {
            let reader = primitive.reader(|_| file.blob.as_deref());
            let positions: Vec<_> = reader.read_positions().unwrap().collect();
            let uvs: Option<Vec<_>> = reader
                .read_tex_coords(0)
                .map(|uvs| uvs.into_f32().collect());
            for normal in reader.read_normals().into_iter().flatten() {
                let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
                assert!((length - 1.0).abs() < 1e-6);
            }
            let indices = reader.read_indices().unwrap().into_u32();
            let corner = |i: u32| {
                (
                    positions[i as usize],
                    uvs.as_ref().map(|uvs| uvs[i as usize]),
                )
            };
            corners.extend(indices.map(corner));
        }
        objects.push((node.name().unwrap().to_owned(), corners));
    }
    objects
}

#[test]
fn another_reader_finds_the_same_triangles() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let mesh = sphere();
    write(
        &path,
        [
            Object::mesh("ball", mesh.clone()),
            Object::mesh("box", shapes::cube()),
        ],
    );

    let found = oracle(&path);
    assert_eq!(found.len(), 2);
    assert_eq!((found[1].0.as_str(), found[1].1.len()), ("box", 36));
    let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    let expected: Vec<_> = corners
        .map(|h| {
            let uv = mesh.get(UV).unwrap()[h.index()];
            let position = mesh.position(mesh.origin(h)).as_vec3().to_array();
            (position, Some([uv.x, 1.0 - uv.y].map(|x| x as f32)))
        })
        .collect();
    assert_eq!(found[0], ("ball".to_owned(), expected));
}

#[test]
fn triangles_with_seams_and_materials_come_back_the_same() {
    for name in ["a.glb", "with blank é.gltf"] {
        let folder = Folder::new();
        let path = folder.path(name);
        let mut mesh = sphere();
        let mut normals = vec![DVec3::ZERO; mesh.n_half_edges()];
        for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
            let axis = mesh.face(h).unwrap().index() % 3;
            normals[h.index()] = DVec3::AXES[axis];
        }
        mesh.set(CORNER_NORMAL, normals);
        let n = mesh.n_vertices();
        mesh.set(
            mesh::COLOR,
            (0..n)
                .map(|i| DVec4::new(0.5, 0.25, 1.0, (i % 2) as f64))
                .collect(),
        );
        // Faces come back by material: their order stays if they are so already.
        mesh.set(MATERIAL, (0..20).map(|i| i / 8 - 1).collect());
        let materials = vec![
            Material {
                base_color: [0.8, 0.1, 0.3, 0.5],
                ..Material::new("glass")
            },
            Material {
                metallic: 0.7,
                roughness: 0.2,
                ..Material::new("steel")
            },
        ];
        let object = Object {
            materials,
            ..Object::mesh("thing", mesh)
        };
        let report = write(&path, [object.clone()]);
        assert_eq!(report.losses, []);
        let back = only(&path);
        assert_same(back.as_mesh().unwrap(), object.as_mesh().unwrap());
        assert_eq!((back.name, back.materials), (object.name, object.materials));
    }
}

#[test]
fn normals_on_vertices_stay_there() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let mut mesh = shapes::octahedron();
    mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
    write(&path, [Object::mesh("a", mesh.clone())]);
    assert_same(only(&path).as_mesh().unwrap(), &mesh);
}

#[test]
fn what_gltf_cannot_hold_is_counted() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y, DVec3::Z];
    let (mut mesh, _) = Mesh::from_polygons(positions, &[vec![0, 1, 2, 3]]).unwrap();
    mesh.set(mesh::CREASE, vec![1.0; 4]);
    mesh.set(mesh::SMOOTHING, vec![1]);
    mesh.set(VERTEX_NORMAL, vec![DVec3::ZERO; 5]);
    mesh.set(mesh::COLOR, vec![DVec4::splat(2.0); 5]);
    mesh.set(MATERIAL, vec![3]);
    tag(&mut mesh, Domain::Face, "side", vec![true]);
    let object = Object {
        materials: vec![Material::new("paint")],
        ..Object::mesh("a", mesh)
    };
    let report = write(&path, [object]);
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|l| (l.attribute.as_str(), l.count))
        .collect();
    let expected = [
        ("crease", 4),
        ("side", 1),
        ("smoothing", 1),
        ("normal", 4),
        ("color", 4),
        ("position", 1),
        ("polygon", 1),
        ("material", 1),
        ("paint", 1),
    ];
    assert_eq!(lost, expected);
    assert_eq!(oracle(&path)[0].1.len(), 6);
}

#[test]
fn empty_meshes_and_scenes_are_files_too() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    assert_eq!(
        write(&path, [Object::mesh("none", Mesh::default())])
            .losses
            .len(),
        1
    );
    assert!(read(&path).unwrap().objects.is_empty());
    write(&path, []);
    assert!(read(&path).unwrap().objects.is_empty());
}

#[test]
fn positions_beyond_32_bits_are_refused() {
    let mut mesh = shapes::square();
    mesh.positions_mut()[1].x = 1e300;
    let folder = Folder::new();
    let scene = scene([Object::mesh("far", mesh)]);
    let error =
        mesh_io::write(&folder.path("a.glb"), &scene, &WriteOptions::default()).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("object `far`: the position of v1"),
        "{error}"
    );
    assert_eq!(folder.count(), 0);
}

#[test]
fn generator_and_provenance_stand_in_the_asset() {
    let folder = Folder::new();
    let path = folder.path("a.gltf");
    let options = WriteOptions {
        provenance: Some("recipe \"x\"".into()),
    };
    mesh_io::write(&path, &scene([Object::mesh("a", shapes::cube())]), &options).unwrap();
    let json: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert!(
        json["asset"]["generator"]
            .as_str()
            .unwrap()
            .starts_with("meshwright ")
    );
    assert_eq!(json["asset"]["extras"]["meshwright"], "recipe \"x\"");
    assert_eq!(json["buffers"][0]["uri"], "a.bin");
}

#[test]
fn large_meshes_get_long_indices() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    for n in [254, 255] {
        // 255 x 256 vertices are 65280, 256 x 256 one too many for short indices.
        let mesh = shapes::grid(n, 255);
        write(&path, [Object::mesh("a", mesh.clone())]);
        let document = gltf::Gltf::open(&path).unwrap();
        let indices = document
            .meshes()
            .next()
            .unwrap()
            .primitives()
            .next()
            .unwrap()
            .indices();
        let short = indices.unwrap().data_type() == gltf::accessor::DataType::U16;
        assert_eq!(short, n == 254);
        assert_eq!(oracle(&path)[0].1.len(), 6 * mesh.n_faces());
    }
}

// ---- Files made by hand ------------------------------------------------------------------------

/// A document with one node, one mesh and one buffer of these bytes.
fn document(bytes: &[u8], accessors: &Value, primitives: &Value) -> Value {
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

fn data_uri(bytes: &[u8]) -> String {
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

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// Four corners of a square, counter-clockwise.
const SQUARE: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];

/// The square with indices behind it, drawn in a mode.
fn square(indices: &[u16], mode: u32) -> Value {
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

fn read_json(json: &Value) -> Result<mesh_io::Loaded, ReadError> {
    let folder = Folder::new();
    read(&folder.with("a.gltf", json.to_string()))
}

fn mesh_of(json: &Value) -> Mesh {
    let loaded = read_json(json).unwrap();
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    loaded.objects[0].as_mesh().unwrap().as_ref().clone()
}

/// Triangles with their lowest corner first.
fn turned(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut faces = polygons(mesh);
    for face in &mut faces {
        let lowest = (0..face.len()).min_by_key(|&i| face[i]).unwrap();
        face.rotate_left(lowest);
    }
    faces
}

#[test]
fn lists_strips_and_fans_are_triangles() {
    let two = [vec![0, 1, 2], vec![0, 2, 3]];
    assert_eq!(turned(&mesh_of(&square(&[0, 1, 2, 0, 2, 3], 4))), two);
    assert_eq!(turned(&mesh_of(&square(&[0, 1, 2, 3], 6))), two);
    assert_eq!(turned(&mesh_of(&square(&[1, 2, 0, 3], 5))), two);
    // A strip that jumps: triangles without area are left out.
    let jumping = mesh_of(&square(&[0, 1, 2, 2, 2, 3, 0], 5));
    assert_eq!(jumping.n_faces(), 2);
    assert!(jumping.is_dense() && jumping.n_edges() == 5);
}

#[test]
fn without_indices_vertices_are_taken_in_order() {
    let mut positions = SQUARE.to_vec();
    positions.extend_from_within(0..3);
    positions.extend_from_within(6..9);
    // 0 1 2, 3 0 2 in the places of new vertices, welded to the old ones.
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
    // Position as 3 floats, color as 4 bytes, texture coordinate as 2 shorts: 20 bytes a vertex.
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
    // Zeros without data: all vertices fall on one.
    json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(3);
    let loaded = read_json(&json).unwrap();
    assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 0);
    assert_eq!(loaded.notes[0].count, 2);
}

#[test]
fn placements_of_nodes_are_applied_and_mirrors_turn_faces() {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    json["nodes"] = json!([
        { "children": [1, 2, 3], "translation": [10, 0, 0], "name": "root" },
        { "mesh": 0, "name": "twin", "scale": [2, 1, 1] },
        { "mesh": 0, "name": "twin", "scale": [-1, 1, 1] },
        { "mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1] },
    ]);
    let loaded = read_json(&json).unwrap();
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
fn normals_turn_with_the_node() {
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
        read_json(&json)
            .unwrap()
            .notes
            .iter()
            .any(|note| note.what.contains("flat"))
    );
}

#[test]
fn what_is_left_out_is_said() {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    json["animations"] = json!([{ "not": "read" }]);
    json["cameras"] = json!([{}, {}]);
    json["skins"] = json!([{}]);
    json["scenes"] = json!([{ "nodes": [0] }, {}]);
    json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(0);
    json["meshes"][0]["primitives"][0]["attributes"]["_TEMPERATURE"] = json!(0);
    json["meshes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "primitives": [] }));
    json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_mesh_quantization"]);
    json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    json["textures"] = json!([{ "source": 0 }, { "extensions": {} }]);
    json["images"] = json!([{ "uri": "wood.png" }]);
    json["materials"] = json!([
        { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } }, "normalTexture": { "index": 1 } },
    ]);
    json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let loaded = read_json(&json).unwrap();
    let notes: Vec<String> = loaded
        .notes
        .iter()
        .map(|n| format!("{} {}", n.count, n.what))
        .collect();
    let expected = [
        "extension \"KHR_lights_punctual\"",
        "1 other scenes",
        "1 animations",
        "1 skins",
        "2 cameras",
        "1 pictures inside",
        "1 meshes left out",
        "1 morph targets",
        "1 attributes TEXCOORD_1",
        "1 attributes _TEMPERATURE",
        "1 textures of materials",
    ];
    for words in expected {
        assert!(
            notes.iter().any(|note| note.contains(words)),
            "{words}: {notes:#?}"
        );
    }
    assert_eq!(notes.len(), expected.len(), "{notes:#?}");
    assert_eq!(
        loaded.objects[0].materials[0].base_color_texture.as_deref(),
        Some("wood.png")
    );
}

/// A change of one place of a good document, and the pointer and words of the error.
fn assert_refused(change: &str, to: Value, pointer: &str, words: &str) {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    let place = json.pointer_mut(change);
    if let Some(place) = place {
        *place = to;
    } else {
        let (parent, key) = change.rsplit_once('/').unwrap();
        json.pointer_mut(parent).unwrap()[key] = to;
    }
    match read_json(&json) {
        Err(ReadError::Json {
            pointer: found,
            message,
            ..
        }) => {
            assert_eq!(found, pointer, "{change}: {message}");
            assert!(message.contains(words), "{change}: {message}");
        }
        other => panic!("{change}: {other:?}"),
    }
}

#[test]
fn broken_documents_are_refused_at_the_pointer() {
    let four_billion = json!(4_000_000_000_u32);
    for (change, to, pointer, words) in [
        ("/asset", json!({}), "/asset/version", "found nothing"),
        ("/asset/version", json!("1.0"), "/asset/version", "1.0"),
        (
            "/asset/minVersion",
            json!("2.1"),
            "/asset/minVersion",
            "2.1",
        ),
        (
            "/extensionsRequired",
            json!(["KHR_draco_mesh_compression"]),
            "/extensionsRequired/0",
            "KHR_draco",
        ),
        ("/scene", json!(3), "/scene", "scene 3, but there are 1"),
        ("/scenes/0/nodes/0", json!(7), "/scenes", "node 7"),
        (
            "/scenes/0/nodes/0",
            json!(-1),
            "/scenes/0/nodes/0",
            "expected an index",
        ),
        (
            "/nodes/0/mesh",
            json!(1),
            "/nodes/0/mesh",
            "mesh 1, but there are 1",
        ),
        (
            "/nodes/0/children",
            json!([0]),
            "/nodes/0",
            "twice, or below itself",
        ),
        (
            "/nodes/0/children",
            json!([5]),
            "/nodes/0/children/0",
            "node 5",
        ),
        (
            "/nodes/0/rotation",
            json!([0, 0, 0, 0]),
            "/nodes/0/rotation",
            "unit",
        ),
        (
            "/nodes/0/matrix",
            json!(vec![0; 16]),
            "/nodes/0/matrix",
            "last row",
        ),
        ("/nodes/0/scale", json!([1, 1]), "/nodes/0", "length 2"),
        ("/meshes", json!({}), "/meshes", "expected a list"),
        (
            "/meshes/0/primitives/0/mode",
            json!(9),
            "/meshes/0/primitives/0/mode",
            "0 to 6",
        ),
        (
            "/meshes/0/primitives/0/indices",
            json!(9),
            "/meshes/0/primitives/0/indices",
            "accessor 9",
        ),
        (
            "/meshes/0/primitives/0/indices",
            json!(0),
            "/accessors/0/type",
            "expected SCALAR",
        ),
        (
            "/meshes/0/primitives/0/material",
            json!(0),
            "/meshes/0/primitives/0/material",
            "material 0",
        ),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(1),
            "/accessors/1/type",
            "expected VEC3",
        ),
        (
            "/meshes/0/primitives/0/attributes/NORMAL",
            json!(2),
            "/meshes/0/primitives/0/attributes/NORMAL",
            "accessor 2",
        ),
        (
            "/accessors/0/count",
            four_billion.clone(),
            "/accessors/0/count",
            "do not fit",
        ),
        (
            "/accessors/0/count",
            json!(u64::MAX),
            "/accessors/0/count",
            "do not fit",
        ),
        (
            "/accessors/0/count",
            json!(3),
            "/meshes/0/primitives/0/indices",
            "refers to vertex 3",
        ),
        (
            "/accessors/1/count",
            json!(5),
            "/meshes/0/primitives/0",
            "multiple of 3",
        ),
        (
            "/accessors/0/byteOffset",
            json!(u64::MAX),
            "/accessors/0/count",
            "do not fit",
        ),
        (
            "/accessors/0/componentType",
            json!(1),
            "/accessors/0/componentType",
            "5120",
        ),
        (
            "/accessors/1/componentType",
            json!(5126),
            "/accessors/1/componentType",
            "unsigned",
        ),
        (
            "/accessors/0/bufferView",
            json!(4),
            "/accessors/0/bufferView",
            "buffer view 4",
        ),
        (
            "/accessors/0",
            json!({ "componentType": 5126, "count": 4_000_000_000_u32, "type": "VEC3" }),
            "/accessors/0/count",
            "no buffer view",
        ),
        ("/accessors/0/type", json!(3), "/accessors/0", "expected"),
        (
            "/bufferViews/0/buffer",
            json!(1),
            "/bufferViews/0/buffer",
            "buffer 1",
        ),
        (
            "/bufferViews/0/byteLength",
            four_billion.clone(),
            "/bufferViews/0/byteLength",
            "buffer 0 has 60",
        ),
        (
            "/bufferViews/0/byteOffset",
            json!(u64::MAX),
            "/bufferViews/0/byteLength",
            "buffer 0 has 60",
        ),
        (
            "/bufferViews/0/byteStride",
            json!(4),
            "/bufferViews/0/byteStride",
            "at least 12",
        ),
        (
            "/buffers/0/byteLength",
            four_billion,
            "/buffers/0/byteLength",
            "but has 60",
        ),
        (
            "/buffers/0/uri",
            json!("data:;base64,A"),
            "/buffers/0/uri",
            "base64",
        ),
        (
            "/buffers/0/uri",
            json!("data:,abc"),
            "/buffers/0/uri",
            "base64",
        ),
        (
            "/buffers/0/uri",
            json!("no.bin"),
            "/buffers/0/uri",
            "cannot read \"no.bin\"",
        ),
        (
            "/buffers/0/uri",
            json!("../a.bin"),
            "/buffers/0/uri",
            "\"../a.bin\" leads out",
        ),
        (
            "/buffers/0/uri",
            json!("file:///etc/passwd"),
            "/buffers/0/uri",
            "scheme",
        ),
        (
            "/buffers/0/uri",
            json!("http://a/b"),
            "/buffers/0/uri",
            "scheme",
        ),
        (
            "/buffers/0/uri",
            json!("/etc/passwd"),
            "/buffers/0/uri",
            "absolute",
        ),
        (
            "/buffers/0/uri",
            json!("%2e%2e/a.bin"),
            "/buffers/0/uri",
            "percent",
        ),
    ] {
        assert_refused(change, to, pointer, words);
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let mut positions = SQUARE;
    positions[4] = f32::NAN;
    let accessors = json!([{ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" }]);
    let json = document(
        &floats(&positions),
        &accessors,
        &json!([{ "attributes": { "POSITION": 0 }, "mode": 6 }]),
    );
    let error = read_json(&json).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("/accessors/0: element 1 is not a finite number"),
        "{error}"
    );
}

#[test]
fn a_long_chain_of_nodes_overflows_no_stack() {
    let mut json = square(&[0, 1, 2], 4);
    let n = 100_000;
    let chain = (0..n).map(|i| {
        if i + 1 < n {
            json!({ "children": [i + 1] })
        } else {
            json!({ "mesh": 0 })
        }
    });
    json["nodes"] = chain.collect();
    assert_eq!(read_json(&json).unwrap().objects.len(), 1);
}

#[test]
fn peeking_reads_only_the_document() {
    let folder = Folder::new();
    for name in ["a.glb", "a.gltf"] {
        let path = folder.path(name);
        write(
            &path,
            [
                Object::mesh("ball", sphere()),
                Object::mesh("box", shapes::cube()),
            ],
        );
        let peek = mesh_io::peek(&path, &ReadOptions::default()).unwrap();
        let counts: Vec<_> = peek
            .objects
            .iter()
            .map(|object| match object.geometry {
                PeekGeometry::Mesh(mesh) => {
                    (object.name.as_str(), mesh.vertices, mesh.faces, mesh.uvs)
                }
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(counts[1], ("box", 8, 12, false));
        assert_eq!((counts[0].2, counts[0].3), (20, true));
    }
    // Not even the binary part has to be there.
    let whole = std::fs::read(folder.path("a.glb")).unwrap();
    let cut = folder.with("cut.glb", &whole[..whole.len() - 100]);
    assert!(mesh_io::peek(&cut, &ReadOptions::default()).is_ok());
    assert!(read(&cut).is_err());
}

#[test]
fn patches_do_not_fit() {
    let folder = Folder::new();
    let scene = scene([Object::new("p", Geometry::Patches(Vec::new()))]);
    for name in ["a.glb", "a.gltf"] {
        assert!(mesh_io::write(&folder.path(name), &scene, &WriteOptions::default()).is_err());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_bytes_are_read_or_refused(bytes: Vec<u8>) {
        let folder = Folder::new();
        for (name, head) in [("a.gltf", &b""[..]), ("a.glb", b""), ("b.glb", b"glTF\x02\0\0\0")] {
            let path = folder.with(name, [head, &bytes].concat());
            let _ = read(&path);
            let _ = mesh_io::peek(&path, &ReadOptions::default());
        }
        for name in ["a.obj", "a.bez", "a.bzc"] {
            let path = folder.with(name, &bytes);
            let _ = read(&path);
            let _ = mesh_io::peek(&path, &ReadOptions::default());
        }
    }

    #[test]
    fn a_file_with_changed_bytes_is_read_or_refused(
        changes in prop::collection::vec((0..1_000_000_usize, any::<u8>()), 1..6),
    ) {
        let folder = Folder::new();
        let path = folder.path("a.glb");
        write(&path, [Object::mesh("ball", sphere())]);
        let mut bytes = std::fs::read(&path).unwrap();
        for (at, byte) in changes {
            let at = at % bytes.len();
            bytes[at] = byte;
        }
        std::fs::write(&path, bytes).unwrap();
        let _ = read(&path);
        let _ = mesh_io::peek(&path, &ReadOptions::default());
    }

    #[test]
    fn a_document_with_changed_numbers_is_read_or_refused(
        which in 0..200_usize,
        number in prop_oneof![0..8_u64, Just(u64::MAX), Just(1 << 32), any::<u64>()],
    ) {
        fn numbers<'a>(value: &'a mut Value, found: &mut Vec<&'a mut Value>) {
            match value {
                Value::Number(_) => found.push(value),
                Value::Array(values) => values.iter_mut().for_each(|v| numbers(v, found)),
                Value::Object(values) => values.values_mut().for_each(|v| numbers(v, found)),
                _ => {}
            }
        }
        let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
        json["accessors"][0]["sparse"] = json!({
            "count": 1,
            "indices": { "bufferView": 0, "byteOffset": 48, "componentType": 5123 },
            "values": { "bufferView": 0, "byteOffset": 0 },
        });
        {
            let mut found = Vec::new();
            numbers(&mut json, &mut found);
            let n = found.len();
            *found[which % n] = json!(number);
        }
        let _ = read_json(&json);
    }
}
