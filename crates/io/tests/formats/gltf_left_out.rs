//! Checks that notes report all glTF content that is not kept, and that names and extras are kept.

use mesh_io::{NoteKind, WriteOptions};
use scene::Scene;
use serde_json::{Value, json};
use store::Disk;

use crate::Folder;
use crate::gltf_read::{read_json, square};

/// Returns a document with a textured square. The scene uses all parts of this document.
fn asset() -> Value {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    json["nodes"][0]["name"] = json!("board");
    let primitive = &mut json["meshes"][0]["primitives"][0];
    primitive["material"] = json!(0);
    primitive["attributes"]["TEXCOORD_0"] = json!(2);
    let accessors = json["accessors"].as_array_mut().unwrap();
    accessors.push(json!({ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC2" }));
    json["materials"] = json!([{
        "name": "paint", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
        "extras": { "price": [1.5, null, {}] },
    }]);
    json["textures"] = json!([{ "source": 0, "sampler": 0, "name": "wood" }]);
    json["samplers"] = json!([{ "name": "default" }]);
    json["images"] = json!([{
        "uri": "data:image/png;base64,iVBORw0KGgo=", "mimeType": "image/png", "name": "oak",
    }]);
    json
}

/// Returns the codes and counts of the content that is left out.
fn left_out(json: &Value) -> Vec<(&'static str, usize)> {
    let notes = read_json(json).unwrap().notes;
    let left_out = notes.iter().filter(|note| note.kind == NoteKind::LeftOut);
    left_out.map(|note| (note.code, note.count)).collect()
}

fn push(json: &mut Value, key: &str, part: Value) {
    match &mut json[key] {
        Value::Array(parts) => parts.push(part),
        missing => *missing = json!([part]),
    }
}

#[test]
fn parts_that_the_scene_does_not_use_are_left_out_with_a_note() {
    assert_eq!(left_out(&asset()), []);
    for (key, part, expected) in [
        ("nodes", json!({ "mesh": 0 }), ("nodes-unused", 1)),
        ("nodes", json!({ "children": [1] }), ("nodes-unused", 1)),
        ("materials", json!({}), ("materials-unused", 1)),
        ("textures", json!({ "source": 0 }), ("textures-unused", 1)),
        ("samplers", json!({}), ("samplers-unused", 1)),
        ("images", json!({ "uri": "a.png" }), ("images-unused", 1)),
    ] {
        let mut json = asset();
        push(&mut json, key, part);
        assert_eq!(left_out(&json), [expected], "{key}");
    }
    let mut json = asset();
    let mesh = json["meshes"][0].clone();
    push(&mut json, "meshes", mesh);
    assert_eq!(left_out(&json), [("meshes-unused", 1)]);
}

/// If only an unused node refers to a part, the part is also reported as unused.
#[test]
fn parts_of_an_unused_node_are_left_out_too() {
    let mut json = asset();
    json["scenes"] = json!([{ "nodes": [] }, { "nodes": [0] }]);
    let expected = [
        ("scenes", 1),
        ("nodes-unused", 1),
        ("meshes-unused", 1),
        ("materials-unused", 1),
        ("textures-unused", 1),
        ("samplers-unused", 1),
        ("images-unused", 1),
    ];
    assert_eq!(left_out(&json), expected);
    // If a primitive does not consist of triangles, its material is not read.
    let mut json = asset();
    json["meshes"][0]["primitives"][0]["mode"] = json!(0);
    let codes: Vec<_> = left_out(&json).into_iter().map(|(code, _)| code).collect();
    assert!(codes.contains(&"materials-unused"), "{codes:?}");
}

#[test]
fn attributes_of_morph_targets_that_the_mesh_lacks_are_left_out_with_a_note() {
    let mut json = asset();
    json["meshes"][0]["primitives"][0]["targets"] = json!([
        { "POSITION": 0, "TEXCOORD_1": 2 },
        { "POSITION": 0, "TEXCOORD_0": 2, "TEXCOORD_1": 2, "COLOR_0": 0, "TANGENT": 0 },
    ]);
    let notes = read_json(&json).unwrap().notes;
    let notes: Vec<_> = notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert!(notes[0].ends_with("1 attribute COLOR_0 of morph targets left out"));
    // The primitive has neither tangents nor colors, and only one set of texture coordinates.
    assert!(notes[1].ends_with("1 attribute TANGENT of morph targets left out"));
    assert!(notes[2].ends_with("2 attributes TEXCOORD_1 of morph targets left out"));
}

#[test]
fn names_of_textures_and_extras_of_materials_are_kept() {
    let loaded = read_json(&asset()).unwrap();
    let mut scene = Scene::new();
    scene.append(loaded.objects, loaded.graph).unwrap();
    let folder = Folder::new();
    for extension in ["gltf", "glb", "mws"] {
        let path = folder.path("b").with_extension(extension);
        mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
        let back = crate::read(&path).unwrap();
        assert_eq!(back.objects, scene.objects(), "{extension}");
    }
    // OBJ files can store neither extras of materials nor names of textures.
    let path = folder.path("a.obj");
    let losses = mesh_io::write(&Disk, &path, &scene, &WriteOptions::default());
    let losses: Vec<_> = losses
        .unwrap()
        .losses
        .iter()
        .map(ToString::to_string)
        .collect();
    for what in ["extras", "the names of a texture"] {
        assert!(losses.iter().any(|loss| loss.contains(what)), "{losses:?}");
    }
}

/// What happens to a part of a file when the file is read and written again.
#[derive(Clone)]
enum Outcome {
    /// The values at these JSON pointers are unchanged. If a pointer leads to an attribute of a morph target, only the
    /// number of elements of the attribute is compared.
    Kept(&'static [&'static str]),
    /// A note with this code reports that the part is left out.
    Lost(&'static str),
}

/// The name of a part of glTF files, a function that adds the part to a document, and the expected outcome.
type Part = (&'static str, fn(&mut Value), Outcome);

fn kept_parts() -> Vec<Part> {
    vec![
        (
            "names of nodes, meshes, cameras, skins and animations",
            |j| {
                for kind in ["nodes", "meshes", "cameras", "skins", "animations"] {
                    j[kind][0]["name"] = json!("Ada");
                }
            },
            Outcome::Kept(&[
                "/nodes/0/name",
                "/meshes/0/name",
                "/cameras/0/name",
                "/skins/0/name",
                "/animations/0/name",
            ]),
        ),
        (
            "names of textures, images and samplers",
            |j| j["textures"][0]["name"] = json!("Ada"),
            Outcome::Kept(&["/textures/0/name", "/images/0/name", "/samplers/0/name"]),
        ),
        (
            "order of root nodes",
            |j| j["meshes"][0]["name"] = j["nodes"][0]["name"].clone(),
            Outcome::Kept(&["/nodes/0/name", "/nodes/1/name", "/scenes/0/nodes"]),
        ),
        (
            "extras of nodes, meshes and materials",
            |j| {
                j["nodes"][0]["extras"] = json!([1]);
                j["meshes"][0]["extras"] = json!([2]);
            },
            Outcome::Kept(&["/nodes/0/extras", "/meshes/0/extras", "/materials/0/extras"]),
        ),
        (
            "extras of cameras, skins, animations, the scene, the asset and the document",
            |j| {
                for kind in ["cameras", "skins", "animations", "scenes"] {
                    j[kind][0]["extras"] = json!([kind]);
                }
                j["asset"]["extras"] = json!({ "a": 1 });
                j["extras"] = json!([3]);
            },
            Outcome::Kept(&[
                "/cameras/0/extras",
                "/skins/0/extras",
                "/animations/0/extras",
                "/scenes/0/extras",
                "/asset/extras",
                "/extras",
            ]),
        ),
        (
            "texture coordinates and colors of morph targets",
            |j| {
                let primitive = &mut j["meshes"][0]["primitives"][0];
                primitive["attributes"]["COLOR_0"] = json!(0);
                primitive["targets"] = json!([{ "TEXCOORD_0": 2 }, { "COLOR_0": 0 }]);
            },
            Outcome::Kept(&[
                "/meshes/0/primitives/0/targets/0/TEXCOORD_0",
                "/meshes/0/primitives/0/targets/1/COLOR_0",
            ]),
        ),
    ]
}

fn lost_parts() -> Vec<Part> {
    vec![
        (
            "extras of primitives, textures, images, samplers and accessors",
            |j| {
                j["meshes"][0]["primitives"][0]["extras"] = json!(1);
                for kind in ["textures", "images", "samplers", "accessors"] {
                    j[kind][0]["extras"] = json!(1);
                }
            },
            Outcome::Lost("extras"),
        ),
        (
            "other scenes",
            |j| push(j, "scenes", json!({})),
            Outcome::Lost("scenes"),
        ),
        (
            "nodes outside the scene",
            |j| push(j, "nodes", json!({})),
            Outcome::Lost("nodes-unused"),
        ),
        (
            "meshes without a node",
            |j| {
                let mesh = j["meshes"][0].clone();
                push(j, "meshes", mesh);
            },
            Outcome::Lost("meshes-unused"),
        ),
        (
            "materials without triangles",
            |j| push(j, "materials", json!({})),
            Outcome::Lost("materials-unused"),
        ),
        (
            "textures without a material",
            |j| push(j, "textures", json!({})),
            Outcome::Lost("textures-unused"),
        ),
        (
            "samplers without a texture",
            |j| push(j, "samplers", json!({})),
            Outcome::Lost("samplers-unused"),
        ),
        (
            "images without a texture",
            |j| push(j, "images", json!({})),
            Outcome::Lost("images-unused"),
        ),
        (
            "attributes of morph targets that the primitive does not have",
            |j| {
                j["meshes"][0]["primitives"][0]["targets"] = json!([
                    { "POSITION": 0, "TANGENT": 0, "TEXCOORD_1": 2, "COLOR_0": 0 },
                ]);
            },
            Outcome::Lost("morphs"),
        ),
        (
            "points and lines",
            |j| {
                let points = json!({ "attributes": { "POSITION": 0 }, "mode": 0 });
                push(&mut j["meshes"][0], "primitives", points);
            },
            Outcome::Lost("points"),
        ),
        (
            "extensions that are not supported",
            |j| j["extensionsUsed"] = json!(["ADA_unknown"]),
            Outcome::Lost("extensions"),
        ),
    ]
}

#[test]
fn the_third_table_matches_the_measured_results() {
    let cases = [kept_parts(), lost_parts()].concat();
    let table = include_str!("../../src/kept.md").split("\n## ").nth(2);
    let rows = table.unwrap().lines().filter(|line| line.starts_with('|'));
    let rows: Vec<Vec<&str>> = rows
        .skip(2)
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), cases.len());
    for (row, (part, change, outcome)) in rows.iter().zip(cases) {
        let mut before = animated();
        change(&mut before);
        match outcome {
            Outcome::Kept(places) => {
                assert_eq!(*row, [part, "kept", ""]);
                assert_eq!(left_out(&before), [], "{part}");
                let after = rewritten(&before);
                for place in places {
                    let part = |json: &Value| match json.pointer(place)?.as_u64() {
                        Some(accessor) if place.contains("/targets/") => {
                            let count = format!("/accessors/{accessor}/count");
                            json.pointer(&count).cloned()
                        }
                        _ => json.pointer(place).cloned(),
                    };
                    assert!(part(&before).is_some(), "{place}");
                    assert_eq!(part(&after), part(&before), "{place}");
                }
            }
            Outcome::Lost(code) => {
                assert_eq!(*row, [part, "lost", &format!("`{code}`")]);
                let codes = left_out(&before);
                assert!(codes.iter().all(|(found, _)| *found == code), "{codes:?}");
                assert!(!codes.is_empty(), "{part}");
            }
        }
    }
}

/// Returns the document of `asset` with a second root node, a camera, a skin and an animation.
fn animated() -> Value {
    let mut json = asset();
    push(&mut json, "nodes", json!({ "name": "eye", "camera": 0 }));
    json["scenes"][0]["nodes"] = json!([0, 1]);
    json["cameras"] =
        json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.5 } }]);
    json["skins"] = json!([{ "joints": [1] }]);
    let accessors = json["accessors"].as_array_mut().unwrap();
    // The animation has two keyframes, at the times 0 and 1, and one translation for each keyframe.
    accessors.push(json!({
        "bufferView": 0, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1],
    }));
    accessors.push(json!({ "bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3" }));
    json["animations"] = json!([{
        "channels": [{ "sampler": 0, "target": { "node": 1, "path": "translation" } }],
        "samplers": [{ "input": 3, "output": 4 }],
    }]);
    json
}

/// Reads a document, writes it and returns the new document.
fn rewritten(json: &Value) -> Value {
    let loaded = read_json(json).unwrap();
    let mut scene = Scene::new();
    scene.append(loaded.objects, loaded.graph).unwrap();
    let folder = Folder::new();
    let path = folder.path("a.gltf");
    let report = mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
    assert_eq!(report.losses, []);
    serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap()
}
