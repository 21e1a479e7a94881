//! Tests of the nodes of glTF files. If a file is read and written again, its hierarchy, cameras, lights and extras do
//! not change.

use geometry::shapes;
use glam::{DVec3, DVec4};
use mesh::{CORNER_TANGENT, VERTEX_NORMAL};
use mesh_io::{Loaded, Orientation, Placements, ReadOptions, WriteOptions};
use scene::{Object, Placement, Scene};
use serde_json::{Value, json};
use store::Disk;

use crate::Folder;
use crate::gltf_read::{SQUARE, document, floats, read_json, square};

/// Returns a document with a hierarchy of nodes. Two nodes reference the first mesh. One node references each of the
/// other meshes. There are two cameras and two lights.
fn asset() -> Value {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    let primitives = json["meshes"][0]["primitives"].clone();
    json["meshes"] = json!([
        { "primitives": primitives, "name": "wheel", "extras": { "tire": [1, null, [], 2.5] } },
        { "primitives": primitives, "name": "Cube.001" },
        { "primitives": primitives },
        { "primitives": primitives, "name": "plain" },
    ]);
    json["cameras"] = json!([
        { "type": "perspective", "name": "main", "perspective": { "yfov": 0.7, "znear": 0.1 }, "extras": { "a": 1 } },
        { "type": "orthographic", "orthographic": { "xmag": 2, "ymag": 1, "zfar": 9, "znear": 0 } },
    ]);
    json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "point", "color": [1, 0.5, 0.25], "intensity": 12.25, "name": "lamp" },
        { "type": "spot", "spot": { "outerConeAngle": 0.5 } },
    ] } });
    let light = |i: u32| json!({ "KHR_lights_punctual": { "light": i } });
    json["nodes"] = json!([
        { "children": [4, 2, 3], "translation": [10, 0.1, 0], "name": "car", "extras": { "id": 7 } },
        { "mesh": 1, "name": "body", "rotation": [0, 0, 0.6, 0.8] },
        { "mesh": 0, "name": "left", "scale": [2, 1, 1], "children": [5] },
        { "mesh": 0, "scale": [-1, 1, 1], "extras": "right" },
        { "camera": 0, "name": "eye" },
        { "extensions": light(1), "camera": 1, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.3, 0, 5, 1] },
        { "mesh": 2, "extensions": light(0), "extras": [] },
        { "mesh": 3, "name": "plain" },
    ]);
    json["scenes"][0]["nodes"] = json!([7, 0, 1, 6]);
    json
}

/// Converts a document to the tree of its nodes. In this tree, each reference to a mesh, camera or light is replaced
/// with the mesh, camera or light itself. The result therefore does not depend on the order and the indices of the
/// parts of the document.
fn canonical(json: &Value) -> Value {
    fn node_tree(json: &Value, i: &Value) -> Value {
        let mut node = json["nodes"][index(i)].clone();
        if !node["mesh"].is_null() {
            let mut mesh = json["meshes"][index(&node["mesh"])].clone();
            mesh.as_object_mut().unwrap().remove("primitives");
            node["mesh"] = mesh;
        }
        if !node["camera"].is_null() {
            node["camera"] = json["cameras"][index(&node["camera"])].clone();
        }
        let light = node["extensions"]["KHR_lights_punctual"]["light"].clone();
        if !light.is_null() {
            let lights = &json["extensions"]["KHR_lights_punctual"]["lights"];
            node["light"] = lights[index(&light)].clone();
        }
        let children = node["children"].as_array().cloned().unwrap_or_default();
        node["children"] = children
            .iter()
            .map(|child| node_tree(json, child))
            .collect();
        let node = node.as_object_mut().unwrap();
        node.remove("extensions");
        node.retain(|_, value| !value.is_null());
        for key in ["translation", "rotation", "scale", "matrix"] {
            if let Some(value) = node.get_mut(key) {
                let numbers = value.as_array().unwrap().iter();
                *value = numbers.map(|x| x.as_f64().unwrap()).collect();
            }
        }
        sorted(Value::Object(node.clone()))
    }
    fn index(value: &Value) -> usize {
        usize::try_from(value.as_u64().unwrap()).unwrap()
    }
    let roots = json["scenes"][0]["nodes"].as_array().unwrap();
    roots.iter().map(|root| node_tree(json, root)).collect()
}

/// Sorts the members of JSON objects, whose order has no meaning.
fn sorted(value: Value) -> Value {
    match value {
        Value::Object(members) => {
            let mut members: Vec<_> = members.into_iter().collect();
            members.sort_by(|a, b| a.0.cmp(&b.0));
            members
                .into_iter()
                .map(|(key, value)| (key, sorted(value)))
                .collect()
        }
        Value::Array(values) => values.into_iter().map(sorted).collect(),
        other => other,
    }
}

fn scene_of(loaded: Loaded) -> Scene {
    let mut scene = Scene::new();
    scene.append(loaded.objects, loaded.graph).unwrap();
    scene
}

/// Writes a scene and returns the document.
fn written(scene: &Scene) -> Value {
    let folder = Folder::new();
    let report = mesh_io::write(
        &Disk,
        &folder.path("a.gltf"),
        scene,
        &WriteOptions::default(),
    );
    assert_eq!(report.unwrap().losses, []);
    serde_json::from_slice(&std::fs::read(folder.path("a.gltf")).unwrap()).unwrap()
}

#[test]
fn an_asset_that_no_step_touched_comes_out_as_it_went_in() {
    let loaded = read_json(&asset()).unwrap();
    assert_eq!(loaded.notes, []);
    let scene = scene_of(loaded);
    let names: Vec<_> = scene.objects().iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["wheel", "body", "a", "plain"]);
    let after = written(&scene);
    assert_eq!(canonical(&after), canonical(&asset()));
    assert_eq!(after["meshes"].as_array().unwrap().len(), 4);
    assert_eq!(after["nodes"].as_array().unwrap().len(), 8);
    // Reading a written file restores the scene bit for bit.
    let folder = Folder::new();
    for extension in ["glb", "gltf", "mws"] {
        let path = folder.path("a").with_extension(extension);
        mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
        let back = scene_of(crate::read(&path).unwrap());
        assert_eq!(back.digest(), scene.digest(), "{extension}");
        assert_eq!(back, scene);
    }
}

#[test]
fn three_nested_nodes_come_back_as_three_nested_nodes() {
    let mut json = square(&[0, 1, 2], 4);
    json["nodes"] = json!([
        { "name": "a", "children": [1] },
        { "name": "b", "children": [2], "translation": [0, 1, 0] },
        { "name": "c", "mesh": 0, "scale": [2, 2, 2] },
    ]);
    let scene = scene_of(read_json(&json).unwrap());
    assert_eq!(canonical(&written(&scene)), canonical(&json));
    assert_eq!(
        scene.objects()[0].as_mesh().unwrap().positions()[1],
        DVec3::X
    );
    let [instance] = &scene.instances()[..] else {
        panic!("one instance");
    };
    assert_eq!(
        instance.to_scene.transform_point3(DVec3::X),
        DVec3::new(2.0, 1.0, 0.0)
    );
}

#[test]
fn roots_keep_their_order() {
    let mut json = square(&[0, 1, 2], 4);
    let mesh = json["meshes"][0].clone();
    json["meshes"] = json!([mesh, mesh]);
    json["nodes"] = json!([{ "mesh": 1, "name": "b" }, { "mesh": 0, "name": "a" }]);
    for (i, name) in ["a", "b"].into_iter().enumerate() {
        json["meshes"][i]["name"] = json!(name);
    }
    json["scenes"][0]["nodes"] = json!([0, 1]);
    for _ in 0..2 {
        let scene = scene_of(read_json(&json).unwrap());
        assert_eq!(canonical(&written(&scene)), canonical(&json));
        // In the second round, one of the nodes has a translation, so the scene has a graph.
        json["nodes"][1]["translation"] = json!([1, 0, 0]);
    }
}

/// The reader makes copies of some vertices. The writer merges these copies, so the written file has the same vertices
/// as the original file.
#[test]
fn meshes_that_are_not_manifold_are_converted_without_a_loss() {
    let mut options = ReadOptions {
        keep_vertices: true,
        ..ReadOptions::default()
    };
    options.policies.orientation = Orientation::Keep;
    let mut bytes = floats(&SQUARE);
    bytes.extend(floats(&[0.0, 0.0, 1.0]));
    // In the first mesh, three triangles share an edge. In the second mesh, two neighboring triangles have opposite
    // orientations.
    for indices in [
        &[0_u16, 1, 2, 1, 0, 3, 0, 1, 4][..],
        &[0, 1, 2, 0, 1, 3, 2, 4, 3],
    ] {
        for has_attribute in [false, true] {
            let mut bytes = bytes.clone();
            bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
            let accessors = json!([
                { "bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3" },
                { "bufferView": 0, "byteOffset": 60, "componentType": 5123, "count": 9, "type": "SCALAR" },
            ]);
            let primitives = json!([{ "attributes": { "POSITION": 0 }, "indices": 1 }]);
            let mut json = document(&bytes, &accessors, &primitives);
            if has_attribute {
                json["meshes"][0]["primitives"][0]["attributes"]["_COPY"] = json!(0);
            }
            let folder = Folder::new();
            let path = folder.with("a.gltf", json.to_string());
            let scene = scene_of(mesh_io::read(&Disk, &path, &options).unwrap());
            assert!(scene.objects()[0].as_mesh().unwrap().n_vertices() > 5);
            let after = written(&scene);
            let positions = &after["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
            let positions = usize::try_from(positions.as_u64().unwrap()).unwrap();
            assert_eq!(after["accessors"][positions]["count"], json!(5));
        }
    }
}

#[test]
fn plain_nodes_are_not_stored() {
    let mut json = square(&[0, 1, 2], 4);
    json["nodes"] = json!([{ "mesh": 0, "name": "b", "scale": [1, 1, 1] }]);
    json["meshes"][0]["name"] = json!("b");
    let loaded = read_json(&json).unwrap();
    assert!(loaded.graph.is_empty());
    json["nodes"][0]["translation"] = json!([0, 0, 1e-30]);
    assert!(!read_json(&json).unwrap().graph.is_empty());
}

#[test]
fn numbers_of_placements_are_kept_exactly() {
    let mut json = square(&[0, 1, 2], 4);
    let digits = [0.1, 1.0 / 3.0, 1e-9 / 7.0];
    json["nodes"][0]["translation"] = json!(digits);
    let scene = scene_of(read_json(&json).unwrap());
    assert_eq!(written(&scene)["nodes"][0]["translation"], json!(digits));
    let Placement::Parts { translation, .. } = scene.graph().nodes()[0].placement else {
        panic!("parts");
    };
    assert_eq!(translation, digits);
}

#[test]
fn formats_without_nodes_are_written_with_placed_instances() {
    let scene = scene_of(read_json(&asset()).unwrap());
    let folder = Folder::new();
    let options = ReadOptions {
        placements: Placements::Bake,
        ..ReadOptions::default()
    };
    let path = folder.with("a.gltf", asset().to_string());
    let baked = mesh_io::read(&Disk, &path, &options).unwrap();
    assert!(baked.graph.is_empty());
    assert_eq!(baked.objects.len(), 5);
    for extension in ["obj", "stl", "ply", "off"] {
        let (path, expected) = (folder.path("b").with_extension(extension), folder.path("c"));
        let expected = expected.with_extension(extension);
        let report = mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
        let lost: Vec<_> = report
            .losses
            .iter()
            .map(|l| (l.attribute.as_str(), l.count))
            .collect();
        for loss in [("nodes", 8), ("cameras", 2), ("lights", 2)] {
            assert!(lost.contains(&loss), "{extension}: {lost:?}");
        }
        // Cameras do not belong to an object, so the reported loss of cameras has no object name.
        let mut losses = report.losses.iter();
        let cameras = losses.find(|l| l.attribute == "cameras").unwrap();
        assert!(cameras.object.is_empty());
        assert!(
            cameras
                .to_string()
                .starts_with("the scene lost \"cameras\" (2): ")
        );
        let strict = WriteOptions {
            strict: true,
            ..WriteOptions::default()
        };
        let error = mesh_io::write(&Disk, &path, &scene, &strict)
            .unwrap_err()
            .to_string();
        assert!(error.contains("cameras"), "{error}");
        let flat = scene_of(baked.clone());
        mesh_io::write(&Disk, &expected, &flat, &WriteOptions::default()).unwrap();
        let points = |path| -> Vec<[f64; 3]> {
            let loaded = crate::read(path).unwrap();
            let meshes = loaded.objects.iter().filter_map(|o| o.as_mesh());
            let points = meshes.flat_map(|mesh| mesh.positions().to_vec());
            let mut points: Vec<[f64; 3]> = points.map(|p| p.to_array()).collect();
            points.sort_by(|a, b| a.partial_cmp(b).unwrap());
            points
        };
        assert_eq!(points(&path), points(&expected), "{extension}");
    }
}

#[test]
fn baked_tangents_turn_with_their_node() {
    let folder = Folder::new();
    let mut tile = shapes::grid(1, 1);
    let tangent = DVec4::new(1.0, 0.0, 0.0, 1.0);
    tile.set(VERTEX_NORMAL, vec![DVec3::Z; tile.n_vertices()]);
    tile.set(CORNER_TANGENT, vec![tangent; tile.n_half_edges()]);
    let mut scene = Scene::new();
    scene.insert(Object::mesh("tile", tile)).unwrap();
    let path = folder.path("a.gltf");
    mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
    let mut json: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    // The node rotates the object by a quarter turn around z, and reflects it.
    let half = 0.5_f64.sqrt();
    json["nodes"][0]["rotation"] = json!([0.0, 0.0, half, half]);
    json["nodes"][0]["scale"] = json!([1.0, 1.0, -1.0]);
    std::fs::write(&path, json.to_string()).unwrap();
    let options = ReadOptions {
        placements: Placements::Bake,
        ..ReadOptions::default()
    };
    let baked = scene_of(mesh_io::read(&Disk, &path, &options).unwrap());
    let mesh = baked.objects()[0].as_mesh().unwrap();
    let tangents = mesh.get(CORNER_TANGENT).unwrap();
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        let expected = DVec4::new(0.0, 1.0, 0.0, -1.0);
        assert!(tangents[h.index()].distance(expected) < 1e-12, "{h}");
    }
}

#[test]
fn placed_instances_agree_with_baked_objects() {
    let scene = scene_of(read_json(&asset()).unwrap());
    let placed = scene.placed();
    let folder = Folder::new();
    let options = ReadOptions {
        placements: Placements::Bake,
        ..ReadOptions::default()
    };
    let path = folder.with("a.gltf", asset().to_string());
    let baked = scene_of(mesh_io::read(&Disk, &path, &options).unwrap());
    let names = |scene: &Scene| -> Vec<String> {
        let mut names: Vec<_> = scene.objects().iter().map(|o| o.name.clone()).collect();
        names.sort();
        names
    };
    // One object is named `wheel` after its mesh, because its node has no name.
    assert_eq!(names(&placed), ["a", "body", "left", "plain", "wheel"]);
    assert_eq!(names(&placed), names(&baked));
    for object in placed.objects() {
        let mesh = object.as_mesh().unwrap();
        let other = baked.object(&object.name).unwrap().as_mesh().unwrap();
        assert_eq!(mesh.defects(), []);
        for (p, q) in mesh.positions().iter().zip(other.positions()) {
            assert!(p.distance(*q) < 1e-12, "{}: {p} {q}", object.name);
        }
        let up = |mesh: &mesh::Mesh| mesh.faces().map(|f| mesh.area_vector(f)).sum::<DVec3>();
        assert!(up(mesh).distance(up(other)) < 1e-12, "{}", object.name);
    }
}

#[test]
fn copyright_and_extras_of_the_document_are_kept() {
    let mut json = asset();
    json["extras"] = json!({ "a": [] });
    json["asset"]["copyright"] = json!("2026 Ada");
    json["asset"]["extras"] = json!({ "meshwright": "an earlier recipe", "source": "a scan" });
    json["scenes"][0]["name"] = json!("Scene");
    json["scenes"][0]["extras"] = json!(0);
    let loaded = read_json(&json).unwrap();
    assert_eq!(loaded.notes, []);
    let after = written(&scene_of(loaded));
    assert_eq!(after["extras"], json["extras"]);
    assert_eq!(after["asset"]["copyright"], json["asset"]["copyright"]);
    assert_eq!(after["asset"]["extras"], json!({ "source": "a scan" }));
    for key in ["name", "extras"] {
        assert_eq!(after["scenes"][0][key], json["scenes"][0][key]);
    }
}

#[test]
fn extras_that_are_not_kept_are_noted() {
    let mut json = asset();
    json["extras"] = json!({ "extras": 1 });
    json["scenes"][0]["extras"] = json!(0);
    json["meshes"][0]["primitives"][0]["material"] = json!(0);
    json["materials"] = json!([{ "extras": {}, "pbrMetallicRoughness": { "extras": [] } }]);
    json["accessors"][0]["extras"] = json!("x");
    json["meshes"][0]["primitives"][0]["extras"] = json!("x");
    let notes = read_json(&json).unwrap().notes;
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert_eq!(
        (notes[0].count, notes[0].what.as_str()),
        (3, "members `extras` left out")
    );
}

#[test]
fn cameras_and_lights_that_do_not_exist_are_errors() {
    for (pointer, value, at) in [
        ("/nodes/4/camera", json!(2), "/nodes/4/camera"),
        (
            "/nodes/6/extensions/KHR_lights_punctual/light",
            json!(5),
            "/nodes/6",
        ),
        (
            "/nodes/6/extensions/KHR_lights_punctual/light",
            json!("x"),
            "/nodes/6/extensions",
        ),
        (
            "/extensions/KHR_lights_punctual/lights/0",
            json!(1),
            "/extensions/KHR_lights_punctual",
        ),
        ("/cameras/0", json!([]), "/cameras/0"),
    ] {
        let mut json = asset();
        *json.pointer_mut(pointer).unwrap() = value;
        let error = read_json(&json).unwrap_err().to_string();
        assert!(error.contains(at), "{error}");
    }
}

#[test]
fn a_placement_beyond_32_bits_is_refused() {
    let mut json = square(&[0, 1, 2], 4);
    json["nodes"][0]["translation"] = json!([1e39, 0, 0]);
    let scene = scene_of(read_json(&json).unwrap());
    let folder = Folder::new();
    let written = mesh_io::write(
        &Disk,
        &folder.path("a.glb"),
        &scene,
        &WriteOptions::default(),
    );
    assert!(written.unwrap_err().to_string().contains("32-bit"));
    assert_eq!(folder.count(), 0);
}

/// This test writes a file for the Khronos validator.
#[test]
fn nodes_cameras_and_lights_are_valid() {
    let mut json = asset();
    // The validator recommends that extras are objects.
    for i in [3, 6] {
        json["nodes"][i]["extras"] = json!({ "list": [], "nothing": null });
    }
    let scene = scene_of(read_json(&json).unwrap());
    crate::gltf_valid::written("nodes", &scene);
}
