//! `info` and `convert`.

use crate::folder::Folder;

const SQUARE: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n";

#[test]
fn the_facts_of_a_mesh_are_shown() {
    let folder = Folder::new().with("square.obj", SQUARE);
    folder.run("info square.obj").with_code(0).prints(&[
        "square: mesh\n",
        "vertices           4\n",
        "edges              4\n",
        "faces              1 (1 of 4 corners)\n",
        "closed             no, 1 boundary loop\n",
        "area               2\n",
        "bounds             [0, 0, 0] to [2, 1, 0]\n",
    ]);
    let json = folder
        .run("info square.obj --format json")
        .with_code(0)
        .json();
    assert_eq!(json["objects"][0]["name"], "square");
    assert_eq!(json["objects"][0]["area"], 2.0);
    assert_eq!(json["objects"][0]["bounds"][1][0], 2.0);
}

#[test]
fn the_facts_of_curves_and_patches_are_shown() {
    let patch = format!("1\n{}", "0 0 0\n".repeat(16));
    let folder = Folder::new()
        .with("a.bzc", "3\n0 0\n1 1\n2 0\n")
        .with("b.bez", patch);
    folder
        .run("info a.bzc")
        .with_code(0)
        .prints(&["a: curve\n", "control points     3\n"]);
    folder
        .run("info b.bez")
        .with_code(0)
        .prints(&["b: patches\n", "patches            1\n"]);
}

#[test]
fn changes_while_reading_a_file_are_noted() {
    let folder = Folder::new().with("a.obj", format!("{SQUARE}f 1 2 2\n"));
    let ended = folder.run("info a.obj").with_code(0);
    assert!(ended.stdout.contains("note: "), "{ended:#?}");
}

#[test]
fn a_converted_mesh_is_unchanged() {
    let folder = Folder::new().with("square.obj", SQUARE);
    folder
        .run("convert square.obj square.glb")
        .with_code(0)
        .prints(&["wrote square.glb\n"]);
    folder.run("convert square.glb back.obj").with_code(0);
    let facts = folder.run("info back.obj --format json").json();
    assert_eq!(facts["objects"][0]["area"], 2.0);
    assert_eq!(facts["objects"][0]["bounds"][1][1], 1.0);
}

#[test]
fn conversions_can_compress_and_quantize() {
    let folder = Folder::new().with("square.obj", SQUARE);
    folder
        .run("convert square.obj a.glb --compress meshopt --quantize")
        .with_code(0)
        .prints(&["bytes instead of", "moved positions by at most"]);
    let json = folder
        .run("convert --quantize=position=8,uv=12 square.obj b.gltf --format json")
        .json();
    assert!(json["packing"]["position_error"].as_f64().unwrap() < 0.01);
    for (option, words) in [
        ("--quantize=position=7", "8 to 16 bits"),
        ("--quantize=weight=8", "position, normal, uv or color"),
        ("--compress zip", "zip"),
    ] {
        let ended = folder
            .run(&format!("convert square.obj c.glb {option}"))
            .with_code(2);
        assert!(ended.stderr.contains(words), "{ended:#?}");
    }
    let ended = folder.run("convert square.obj c.ply --compress meshopt");
    assert!(
        ended
            .with_code(1)
            .stderr
            .contains("only .glb and .gltf files")
    );
}

#[test]
fn a_failed_conversion_writes_no_file() {
    let folder = Folder::new()
        .with("square.obj", SQUARE)
        .with("curve.bzc", "2\n0 0\n1 1\n")
        .with("bad.obj", "f 1 2 3\n")
        .with("old.obj", "old");
    for (arguments, message) in [
        (
            "square.obj new.xyz",
            "new.xyz: expected a file name that ends in one of ",
        ),
        ("curve.bzc new.obj", "new.obj"),
        ("bad.obj old.obj", "bad.obj:1:"),
        ("none.obj new.obj", "none.obj: "),
        (
            "square.obj no/new.obj",
            "no/new.obj: the folder does not exist\n",
        ),
        ("square.obj bad.obj/new.obj", "bad.obj/new.obj"),
    ] {
        let ended = folder.run(&format!("convert {arguments}")).with_code(1);
        assert!(ended.stderr.starts_with("error: "), "{ended:#?}");
        assert!(ended.stderr.contains(message), "{ended:#?}");
    }
    assert_eq!(
        folder.entries("."),
        ["bad.obj", "curve.bzc", "old.obj", "square.obj"]
    );
    assert_eq!(folder.read("old.obj"), b"old");
}

#[test]
fn policies_for_unclean_input_are_applied_and_listed() {
    let obj = format!("{SQUARE}v 9 9 9\nf 4 3 2 1\np 5\n");
    let folder = Folder::new().with("a.obj", obj);
    let json = folder
        .run("info a.obj --duplicates Drop --isolated Drop --format json")
        .with_code(0)
        .json();
    assert_eq!(json["objects"][0]["faces"], 1);
    assert_eq!(json["objects"][0]["vertices"], 4);
    let notes = json["notes"].as_array().unwrap();
    assert_eq!(notes[0]["left_out"], true);
    assert_eq!(notes[0]["line"], 8);
    assert_eq!(notes[1]["faces"], serde_json::json!([1]));
    assert_eq!(notes[2]["vertices"], serde_json::json!([4]));
    assert_eq!(notes[2]["text"], "a.obj: 1 isolated vertex dropped (v4)");

    folder.run("convert a.obj a.ply --strict").with_code(1);
    assert!(!folder.path("a.ply").exists());
    let wrong = folder.run("info a.obj --isolated Shrink").with_code(2);
    assert!(
        wrong.stderr.contains("expected `Keep` or `Drop`"),
        "{wrong:#?}"
    );
}

/// Five triangles. Some neighbors have opposite orientations, and the last triangle touches the others only at one
/// vertex.
const UNCLEAN: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 5 5 5\nv 6 5 5\n\
                       f 1 2 3\nf 2 3 4\nf 1 2 5\nf 3 1 5\nf 1 6 7\n";

#[test]
fn a_conversion_changes_no_face_and_no_vertex() {
    let folder = Folder::new().with("a.obj", UNCLEAN);
    for to in ["b.obj", "b.ply", "b.off"] {
        let ended = folder.run(&format!("convert a.obj {to}")).with_code(0);
        assert_eq!(ended.stdout, format!("wrote {to}\n"));
        folder.run(&format!("convert {to} back.obj")).with_code(0);
        let text = String::from_utf8(folder.read("back.obj")).unwrap();
        let lines: Vec<&str> = (text.lines())
            .filter(|line| !line.starts_with('#'))
            .collect();
        let lines = lines.join("\n") + "\n";
        assert_eq!(lines, UNCLEAN, "{to}");
    }
    // With `--orientation Orient`, faces are reversed, and the output reports these repairs.
    let ended = folder
        .run("convert a.obj c.obj --orientation Orient")
        .with_code(0);
    assert!(ended.stdout.contains("reversed"), "{ended:#?}");
}

/// Returns the codes of the notes in the output of a command.
fn note_codes(json: &serde_json::Value) -> Vec<&str> {
    let notes = json["notes"].as_array().unwrap();
    notes.iter().map(|n| n["code"].as_str().unwrap()).collect()
}

#[test]
fn notes_have_codes_in_json() {
    let folder = Folder::new().with("a.obj", format!("{UNCLEAN}f 1 2 2\n"));
    let json = folder.run("info a.obj --format json").with_code(0).json();
    let codes = note_codes(&json);
    assert!(
        codes.contains(&"faces-reversed") && codes.contains(&"faces-dropped"),
        "{codes:?}"
    );
    let dropped = &json["notes"][codes.iter().position(|c| *c == "faces-dropped").unwrap()];
    assert_eq!(dropped["count"], 1);
    assert_eq!(dropped["faces"], serde_json::json!([5]));
    assert_eq!(dropped["places"][0][1], serde_json::json!([1.0, 0.0, 0.0]));

    let json = folder
        .run("convert a.obj b.stl --format json")
        .with_code(0)
        .json();
    assert_eq!(json["wrote"], serde_json::json!(["b.stl"]));
    let codes = note_codes(&json);
    assert!(!codes.contains(&"faces-reversed"), "{codes:?}");
}

#[test]
fn strict_conversions_lose_nothing_in_both_directions() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
    let folder = Folder::new().with("a.obj", obj);
    let ended = folder.run("convert a.obj a.stl --strict").with_code(1);
    assert!(
        ended
            .stderr
            .contains("strict writing does not allow any loss"),
        "{ended:#?}"
    );
    assert!(!folder.path("a.stl").exists());
    folder.run("convert a.obj a.ply --strict").with_code(0);
}

/// A glTF file with a triangle and a skin. The skin is lost with `placements: Bake`.
const SKINNED: &str = r#"{ "asset": { "version": "2.0" }, "skins": [{ "joints": [0] }],
    "nodes": [{ "mesh": 0 }], "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
    "accessors": [{ "componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 0 }],
    "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
    "buffers": [{ "byteLength": 36,
        "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }] }"#;

#[test]
fn losses_of_reading_are_losses_of_the_step() {
    let recipe = |more: &str| {
        format!(
            "(recipe: 1, {more} steps: [Load(path: \"a.gltf\", placements: Bake), Save(path: \"b.obj\")])"
        )
    };
    let folder = Folder::new()
        .with("a.gltf", SKINNED)
        .with("warn.ron", recipe(""))
        .with("error.ron", recipe("on_loss: Error,"))
        .with(
            "allow.ron",
            recipe("on_loss: Allow([\"skins\", \"nodes\"]),"),
        );
    let ended = folder.run("run warn.ron").with_code(0);
    assert!(
        ended.stdout.contains("Load: a.gltf: 1 skin left out"),
        "{ended:#?}"
    );
    let checked = folder.run("check warn.ron").with_code(0);
    assert!(
        checked.stdout.contains("Load: a.gltf: 1 skin left out"),
        "{checked:#?}"
    );
    for command in ["check", "run"] {
        let ended = folder.run(&format!("{command} error.ron")).with_code(1);
        for expected in ["1 skin left out", "and `on_loss` does not allow it"] {
            assert!(ended.stderr.contains(expected), "{ended:#?}");
        }
    }
    folder.run("run allow.ron").with_code(0);
}

/// A glTF file with a skinned, morphed and animated triangle.
const RIGGED: &str = r#"{ "asset": { "version": "2.0" }, "scenes": [{ "nodes": [0, 2] }],
    "nodes": [{ "name": "hip", "children": [1] }, { "name": "knee", "translation": [0, 1, 0] },
        { "name": "body", "mesh": 0, "skin": 0 }],
    "skins": [{ "joints": [0, 1] }],
    "animations": [{ "name": "walk", "samplers": [{ "input": 3, "output": 4 }],
        "channels": [{ "sampler": 0, "target": { "node": 1, "path": "rotation" } }] }],
    "meshes": [{ "extras": { "targetNames": ["smile"] }, "primitives": [{
        "attributes": { "POSITION": 0, "WEIGHTS_0": 1, "JOINTS_0": 2 }, "targets": [{ "POSITION": 0 }] }] }],
    "accessors": [{ "componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 0 },
        { "componentType": 5126, "count": 3, "type": "VEC4", "bufferView": 1 },
        { "componentType": 5121, "count": 3, "type": "VEC4", "bufferView": 2 },
        { "componentType": 5126, "count": 2, "type": "SCALAR", "bufferView": 3 },
        { "componentType": 5126, "count": 2, "type": "VEC4", "bufferView": 4 }],
    "bufferViews": [{ "buffer": 0, "byteOffset": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 48 }, { "buffer": 0, "byteOffset": 84, "byteLength": 12 }, { "buffer": 0, "byteOffset": 96, "byteLength": 8 }, { "buffer": 0, "byteOffset": 104, "byteLength": 32 }],
    "buffers": [{ "byteLength": 136, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAAAAAAAAAAAAAAAAAAD8AAAA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAEAAAABAAAAAQAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAA==" }] }"#;

#[test]
fn a_rigged_character_is_converted_and_subdivided() {
    let recipe = |steps: &str| {
        format!("(recipe: 1, on_loss: Error, steps: [Load(path: \"a.gltf\"), {steps}])")
    };
    let folder = Folder::new()
        .with("a.gltf", RIGGED)
        .with(
            "fine.ron",
            recipe("Midpoint(levels: 2), Save(path: \"b.glb\")"),
        )
        .with("lost.ron", recipe("Save(path: \"b.obj\")"));
    folder.run("convert a.gltf c.glb --strict").with_code(0);
    folder.run("run fine.ron --out .").with_code(0);
    for file in ["c.glb", "b.glb"] {
        let shown = folder.run(&format!("info {file}")).with_code(0);
        for line in [
            "joints             2 (at most 2 at a vertex)",
            "morph targets      1",
            "skins: 1",
            "animations: 1",
            "animation walk: 1 channel, duration 2 s",
        ] {
            assert!(shown.stdout.contains(line), "{line}: {shown:#?}");
        }
    }
    let json = folder.run("info b.glb --format json").with_code(0);
    let json: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(json["skins"], 1);
    assert_eq!(json["animation_list"][0]["seconds"], 2.0);
    assert_eq!(json["objects"][0]["joints"], 2);
    assert_eq!(json["objects"][0]["morph_targets"], 1);
    assert_eq!(json["objects"][0]["faces"], 16);
    // An OBJ file cannot store the skin. `check` reports this loss without running the recipe.
    let checked = folder.run("check lost.ron").with_code(1);
    assert!(
        checked.stderr.contains("`on_loss` does not allow it"),
        "{checked:#?}"
    );
}

/// Two triangles, each with a node. The node of the first triangle is rotated and animated.
const CAR: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], 
    "nodes": [{"name": "wheel", "mesh": 0, "rotation": [0, 0, 0.24740395925452294, 0.9689124217106447]}, {"name": "body", "mesh": 1}], 
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}, {"primitives": [{"attributes": {"POSITION": 0}}]}], 
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}, {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}], 
    "animations": [{"name": "spin", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": 1, "output": 2}]}], 
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8}, {"buffer": 0, "byteOffset": 44, "byteLength": 24}], 
    "buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAACAPwAAAEAAAEBAAACAQAAAoEA="}]}"#;

#[test]
fn check_knows_what_becomes_of_nodes_and_animations() {
    let recipe = |file: &str, step: &str| {
        format!("(recipe: 1, on_loss: Error, steps: [Load(path: \"{file}\"), {step}])")
    };
    let mut still: serde_json::Value = serde_json::from_str(CAR).unwrap();
    still.as_object_mut().unwrap().remove("animations");
    let folder = Folder::new()
        .with("car.gltf", CAR)
        .with("still.gltf", still.to_string())
        .with(
            "lost.ron",
            recipe("car.gltf", "Delete(objects: [\"wheel\"])"),
        )
        .with(
            "kept.ron",
            recipe("car.gltf", "Delete(objects: [\"body\"])"),
        )
        .with(
            "shear.ron",
            recipe("still.gltf", "Transform(scale: (1, 2, 1))"),
        )
        // `Transform` does not scale the animated node, but adds a parent to this node and scales the parent.
        .with(
            "parent.ron",
            recipe("car.gltf", "Transform(scale: (1, 2, 1))"),
        );
    for (file, message) in [
        ("lost.ron", "Delete loses 1 animation channel of the scene"),
        ("shear.ron", "the node \"wheel\" cannot store the result"),
    ] {
        folder
            .run(&format!("check {file}"))
            .with_code(1)
            .complains(&[message]);
    }
    for file in ["kept.ron", "parent.ron"] {
        folder.run(&format!("check {file}")).with_code(0);
        folder.run(&format!("run {file}")).with_code(0);
    }
}
