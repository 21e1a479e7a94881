//! Checks that compression and quantization preserve the content of glTF files, except for the reported errors of
//! quantization.

use glam::{DVec2, DVec3, DVec4};
use mesh::{CORNER_TANGENT, Domain, Mesh, UV, VERTEX_NORMAL};
use mesh_io::{
    Compression, Loaded, Loss, PackingReport, Placements, Quantization, ReadOptions, WriteError,
    WriteOptions,
};
use scene::{Node, Object, Placement, Scene};
use serde_json::{Value, json};
use store::Disk;

use crate::gltf_attributes::add_column;
use crate::gltf_materials::{painted, rich};
use crate::gltf_written::sphere;
use crate::{Folder, scene};

const COMPRESSED: WriteOptions = WriteOptions {
    provenance: None,
    images: None,
    compression: Some(Compression::Meshopt),
    quantization: None,
    weight_sets: None,
    rows: None,
    strict: false,
};

fn quantized() -> WriteOptions {
    WriteOptions {
        quantization: Some(Quantization::default()),
        ..WriteOptions::default()
    }
}

fn both() -> WriteOptions {
    WriteOptions {
        quantization: Some(Quantization::default()),
        ..COMPRESSED
    }
}

/// A torus with normals, texture coordinates, colors and a custom attribute.
fn torus() -> Mesh {
    let mut mesh = geometry::shapes::torus(40, 24, 2.0, 0.7);
    let corners: Vec<_> = mesh.faces().flat_map(|f| mesh.face_half_edges(f)).collect();
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for h in corners {
        let p = mesh.position(mesh.origin(h));
        uvs[h.index()] = (p.truncate() / 6.0 + 0.5).as_vec2().as_dvec2();
    }
    mesh.set(UV, uvs);
    let normals = mesh.positions().iter().map(|p| p.normalize()).collect();
    mesh.set(VERTEX_NORMAL, normals);
    let tangents = geometry::tangents(&mesh, mesh.get(UV).unwrap())
        .unwrap()
        .values;
    mesh.set(CORNER_TANGENT, tangents);
    let colors = mesh.positions().iter();
    let colors = colors
        .map(|p| DVec4::new(p.x / 6.0 + 0.5, 0.25, 1.0, 1.0))
        .collect();
    mesh.set(mesh::COLOR, colors);
    let quality: Vec<f64> = mesh.positions().iter().map(|p| p.z).collect();
    add_column(&mut mesh, Domain::Vertex, "quality", quality);
    mesh
}

/// Returns a scene with three objects. A root node has a scale, and two of its descendants reference the first and the
/// second object. Another root node also references the first object. No node references the third object.
fn placed() -> Scene {
    let mut scene = scene([
        Object::mesh("torus", torus()),
        painted("ball", rich()),
        Object::mesh("alone", sphere()),
    ]);
    let node = |parent, object: Option<&str>, scale| Node {
        parent,
        object: object.map(str::to_owned),
        name: Some("a node".to_owned()),
        placement: Placement::Parts {
            translation: [1.0, -20.0, 0.5],
            rotation: [0.0, 0.6, 0.0, 0.8],
            scale,
        },
        ..Node::default()
    };
    let graph = scene.graph_mut();
    let root = graph.push(node(None, None, [4.0, 3.0, 2.0]));
    let middle = graph.push(node(Some(root), Some("torus"), [1.0, -1.0, 0.5]));
    graph.push(node(Some(middle), Some("ball"), [0.1; 3]));
    graph.push(node(None, Some("torus"), [1.0; 3]));
    scene
}

fn write(scene: &Scene, name: &str, options: &WriteOptions) -> (Folder, Vec<Loss>, PackingReport) {
    let folder = Folder::new();
    let report = mesh_io::write(&Disk, &folder.path(name), scene, options).unwrap();
    let sizes = report
        .files
        .iter()
        .map(|path| std::fs::metadata(path).unwrap().len());
    let packing = report.packing.unwrap_or_default();
    if options.compression.is_some() {
        assert_eq!(packing.bytes_after, sizes.sum::<u64>());
    }
    (folder, report.losses, packing)
}

fn read_back(folder: &Folder, name: &str, placements: Placements) -> Loaded {
    let options = ReadOptions {
        placements,
        ..ReadOptions::default()
    };
    mesh_io::read(&Disk, &folder.path(name), &options).unwrap()
}

fn baked(scene: &Scene, options: &WriteOptions) -> Vec<Object> {
    let (folder, ..) = write(scene, "a.glb", options);
    read_back(&folder, "a.glb", Placements::Bake).objects
}

/// Returns the faces in ascending order. Each face is a list of corners that starts at its smallest corner. Each corner
/// is a list of numbers: the bits of its position and attributes.
fn sorted_faces(mesh: &Mesh) -> Vec<Vec<Vec<u64>>> {
    let corner = |h| {
        let v = mesh.origin(h);
        let mut numbers = mesh.position(v).to_array().to_vec();
        if let Some(normals) = mesh.get(VERTEX_NORMAL) {
            numbers.extend(normals[v.index()].to_array());
        }
        if let Some(colors) = mesh.get(mesh::COLOR) {
            numbers.extend(colors[v.index()].to_array());
        }
        if let Some(uvs) = mesh.get(UV) {
            numbers.extend(uvs[h.index()].to_array());
        }
        numbers.into_iter().map(f64::to_bits).collect()
    };
    let faces = mesh.faces().map(|f| {
        let mut corners: Vec<Vec<u64>> = mesh.face_half_edges(f).map(corner).collect();
        let first = corners
            .iter()
            .enumerate()
            .min_by_key(|(_, numbers)| *numbers);
        let first = first.unwrap().0;
        corners.rotate_left(first);
        corners
    });
    let mut faces: Vec<_> = faces.collect();
    faces.sort();
    faces
}

fn document(folder: &Folder, name: &str) -> Value {
    let bytes = std::fs::read(folder.path(name)).unwrap();
    if bytes[0] == b'{' {
        return serde_json::from_slice(&bytes).unwrap();
    }
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap());
    serde_json::from_slice(&bytes[20..20 + usize::try_from(length).unwrap()]).unwrap()
}

#[test]
fn compressed_files_are_read_as_uncompressed_ones() {
    let scene = placed();
    for name in ["a.glb", "a.gltf"] {
        for (options, plain) in [(COMPRESSED, WriteOptions::default()), (both(), quantized())] {
            let (folder, losses, packing) = write(&scene, name, &options);
            let (plain_folder, plain_losses, _) = write(&scene, name, &plain);
            assert_eq!(losses, plain_losses);
            assert!(packing.bytes_after < packing.bytes_before);
            let loaded = read_back(&folder, name, Placements::Keep);
            let expected = read_back(&plain_folder, name, Placements::Keep);
            assert_eq!(loaded.graph, expected.graph);
            for (a, b) in loaded.objects.iter().zip(&expected.objects) {
                let (a, b) = (a.as_mesh().unwrap(), b.as_mesh().unwrap());
                assert_eq!(a.n_vertices(), b.n_vertices());
                assert_eq!(sorted_faces(a), sorted_faces(b));
            }
            let json = document(&folder, name);
            assert_eq!(
                json["extensionsRequired"].as_array().unwrap().last(),
                Some(&json!("EXT_meshopt_compression"))
            );
            assert_eq!(
                json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"],
                true
            );
        }
    }
}

#[test]
fn the_sizes_before_are_those_of_plain_files() {
    let scene = placed();
    for name in ["a.glb", "a.gltf"] {
        let (folder, ..) = write(&scene, name, &WriteOptions::default());
        let files = std::fs::read_dir(folder.path("")).unwrap();
        let size: u64 = files
            .map(|file| file.unwrap().metadata().unwrap().len())
            .sum();
        assert_eq!(write(&scene, name, &both()).2.bytes_before, size);
        assert_eq!(write(&scene, name, &quantized()).2.bytes_before, size);
    }
}

#[test]
fn quantized_positions_are_within_the_reported_error() {
    let scene = placed();
    let plain = baked(&scene, &WriteOptions::default());
    for position in [8_u32, 11, 16] {
        let quantization = Quantization {
            position: position.try_into().unwrap(),
            ..Quantization::default()
        };
        let options = WriteOptions {
            quantization: Some(quantization),
            ..WriteOptions::default()
        };
        let (folder, losses, packing) = write(&scene, "a.glb", &options);
        assert!(
            !losses.iter().any(|loss| loss.reason.contains("quantized")),
            "{losses:?}"
        );
        let error = packing.position_error.unwrap();
        // Along each axis, the error is at most half a step of the grid of the largest object. The transforms of the
        // nodes multiply this error by at most 4.
        let step = 5.4 / f64::from((1 << position) - 1);
        assert!(error < 0.5 * step * 3.0_f64.sqrt() * 4.01, "{error}");
        let objects = read_back(&folder, "a.glb", Placements::Bake).objects;
        assert_eq!(objects.len(), plain.len());
        let mut largest = 0.0_f64;
        for (a, b) in objects.iter().zip(&plain) {
            let (a, b) = (a.as_mesh().unwrap(), b.as_mesh().unwrap());
            assert_eq!(a.n_faces(), b.n_faces());
            for (a, b) in a.positions().iter().zip(b.positions()) {
                largest = largest.max(a.distance(*b));
            }
        }
        // The added 1e-5 is for the file without quantization, in which positions are rounded to 32 bits.
        assert!(
            largest <= error + 1e-5 && largest > error / 4.0,
            "{largest} {error}"
        );
    }
}

#[test]
fn quantized_attributes_are_within_the_reported_errors() {
    let scene = scene([Object::mesh("torus", torus())]);
    let plain = baked(&scene, &WriteOptions::default()).remove(0);
    let plain = plain.as_mesh().unwrap();
    for bits in [8_u32, 10, 16] {
        let bits = bits.try_into().unwrap();
        let quantization = Quantization {
            position: 16.try_into().unwrap(),
            normal: bits,
            uv: bits,
            color: bits,
        };
        let options = WriteOptions {
            quantization: Some(quantization),
            ..WriteOptions::default()
        };
        let packing = write(&scene, "a.glb", &options).2;
        let object = baked(&scene, &options).remove(0);
        let mesh = object.as_mesh().unwrap();
        let most = f64::from((1 << bits.get()) - 1);
        let degrees = packing.normal_error.unwrap();
        assert!(degrees < 320.0 / most, "{degrees}");
        let normals = mesh.get(VERTEX_NORMAL).unwrap().iter();
        for (a, b) in normals.zip(plain.get(VERTEX_NORMAL).unwrap()) {
            assert!(mesh::angle_between(*a, *b).to_degrees() <= degrees + 1e-3);
        }
        let tangents = plain.get(CORNER_TANGENT).unwrap();
        for (a, b) in mesh.get(CORNER_TANGENT).unwrap().iter().zip(tangents) {
            let angle = mesh::angle_between(a.truncate(), b.truncate());
            assert!(angle.to_degrees() <= degrees + 1e-3);
            assert!(a.w == b.w);
        }
        let error = packing.uv_error.unwrap();
        assert!(error <= 0.5 / most + 0.5 / 65535.0);
        // The faces of both meshes are in the same order, so their corners correspond.
        for (a, b) in mesh.get(UV).unwrap().iter().zip(plain.get(UV).unwrap()) {
            assert!((*a - *b).abs().max_element() <= error + 1e-7);
        }
        let colors = mesh.get(mesh::COLOR).unwrap().iter();
        for (a, b) in colors.zip(plain.get(mesh::COLOR).unwrap()) {
            assert!((*a - *b).abs().max_element() <= 0.5 / most + 1e-5);
        }
    }
}

#[test]
fn nodes_of_quantized_scenes_keep_their_members_and_places() {
    let scene = placed();
    let (plain_folder, ..) = write(&scene, "a.glb", &WriteOptions::default());
    let (folder, ..) = write(&scene, "a.glb", &both());
    let (plain, json) = (document(&plain_folder, "a.glb"), document(&folder, "a.glb"));
    assert_eq!(json["materials"], plain["materials"]);
    assert_eq!(json["textures"], plain["textures"]);
    assert_eq!(json["scenes"], plain["scenes"]);
    let [nodes, plain] = [&json, &plain].map(|json| json["nodes"].as_array().unwrap());
    assert_eq!(nodes.len(), plain.len() + 3);
    for (node, plain) in nodes.iter().zip(plain) {
        for key in ["name", "extras", "camera"] {
            assert_eq!(node[key], plain[key]);
        }
    }
    for node in &nodes[..4] {
        assert!(node["mesh"].is_null());
    }
    for grid in &nodes[5..] {
        assert!(!grid["mesh"].is_null());
        assert_eq!(grid["name"], json!("a node"));
        assert_eq!(grid["scale"][0], grid["scale"][2]);
    }
    let names = |folder| -> Vec<String> {
        let objects = read_back(folder, "a.glb", Placements::Keep).objects;
        objects.into_iter().map(|object| object.name).collect()
    };
    assert_eq!(names(&folder), names(&plain_folder));
}

#[test]
fn texture_coordinates_outside_of_the_range_stay_floats() {
    let mut mesh = torus();
    let mut uvs = mesh.get(UV).unwrap().to_vec();
    uvs[0].x = 1.5;
    mesh.set(UV, uvs);
    let scene = scene([Object::mesh("torus", mesh)]);
    let packing = write(&scene, "a.glb", &both()).2;
    assert_eq!(packing.uv_error, None);
    let (object, attribute, _) = &packing.unquantized[0];
    assert_eq!((object.as_str(), attribute.as_str()), ("torus", "uv"));
    assert!(
        packing.to_string().contains("torus: uv not quantized"),
        "{packing}"
    );
}

#[test]
fn vertices_that_quantization_merges_are_lost() {
    let mut mesh = geometry::shapes::grid(3, 3);
    for p in mesh.positions_mut() {
        p.x += if p.x > 0.0 { 1000.0 } else { 0.0 };
    }
    let quantization = Quantization {
        position: 8.try_into().unwrap(),
        ..Quantization::default()
    };
    let options = WriteOptions {
        quantization: Some(quantization),
        ..WriteOptions::default()
    };
    let losses = write(&scene([Object::mesh("grid", mesh)]), "a.glb", &options).1;
    let loss = losses.iter().find(|loss| loss.reason.contains("quantized"));
    assert!(loss.unwrap().count > 0);
}

#[test]
fn objects_of_every_size_and_without_content_are_packed() {
    let largest = f64::from(f32::MAX);
    for size in [largest, 1e30, 1.0, 1e-30, 1e-37, 1e-45, 0.0] {
        let mut mesh = geometry::shapes::cube();
        for p in mesh.positions_mut() {
            *p *= size / p.abs().max_element();
        }
        let scene = scene([
            Object::mesh("cube", mesh),
            Object::mesh("none", Mesh::default()),
        ]);
        for options in [COMPRESSED, quantized(), both()] {
            let (folder, ..) = write(&scene, "a.gltf", &options);
            let loaded = read_back(&folder, "a.gltf", Placements::Bake);
            let mesh = loaded.objects[0].as_mesh().unwrap();
            for p in mesh.positions() {
                assert!((p.abs() - DVec3::splat(size)).abs().max_element() <= size * 2e-5 + 1e-45);
            }
        }
    }
    let (folder, ..) = write(&scene([]), "a.glb", &both());
    assert!(
        read_back(&folder, "a.glb", Placements::Keep)
            .objects
            .is_empty()
    );
}

#[test]
fn other_formats_refuse_compression_and_quantization() {
    let scene = scene([Object::mesh("torus", torus())]);
    let folder = Folder::new();
    for name in ["a.obj", "a.ply", "a.stl", "a.off", "a.mws", "a.obj.gz"] {
        for options in [COMPRESSED, quantized()] {
            let error = mesh_io::write(&Disk, &folder.path(name), &scene, &options);
            let Err(WriteError::Scene { message, .. }) = error else {
                panic!("{name}: {error:?}");
            };
            assert_eq!(
                message,
                "only .glb and .gltf files can be compressed or quantized"
            );
        }
    }
    assert_eq!(folder.count(), 0);
}
