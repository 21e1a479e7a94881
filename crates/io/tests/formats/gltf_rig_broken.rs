//! Tests of invalid skins, morph targets and animations in glTF files.

use mesh_io::Loaded;
use serde_json::{Value, json};

use crate::gltf_read::read_json;
use crate::gltf_rig::arm;

/// Changes the JSON of the arm, and reads the changed document.
fn changed(change: impl Fn(&mut Value)) -> Result<Loaded, mesh_io::ReadError> {
    let mut json = arm();
    change(&mut json);
    read_json(&json)
}

#[test]
fn invalid_parts_are_errors_that_name_their_place() {
    type Change = fn(&mut Value);
    let cases: [(&str, &str, Change); 12] = [
        ("/skins/0/joints", "at least one joint", |j| {
            j["skins"][0]["joints"] = json!([]);
        }),
        ("/skins/0/joints/1", "node 9 does not exist", |j| {
            j["skins"][0]["joints"][1] = json!(9);
        }),
        ("/skins/0/skeleton", "node 9 does not exist", |j| {
            j["skins"][0]["skeleton"] = json!(9);
        }),
        ("/nodes/4/skin", "skin 1 does not exist", |j| {
            j["nodes"][4]["skin"] = json!(1);
        }),
        (
            "/animations/0/channels/1",
            "sampler 7 does not exist",
            |j| {
                j["animations"][0]["channels"][1]["sampler"] = json!(7);
            },
        ),
        (
            "/animations/0/channels/0/target",
            "node 7 does not exist",
            |j| {
                j["animations"][0]["channels"][0]["target"]["node"] = json!(7);
            },
        ),
        (
            "/animations/0/samplers/0/interpolation",
            "found \"CUBIC\"",
            |j| {
                j["animations"][0]["samplers"][0]["interpolation"] = json!("CUBIC");
            },
        ),
        (
            "JOINTS_0",
            "refers to joint 2, but the skin has only 2 joints",
            |j| {
                j["skins"][0]["joints"] = json!([1, 2]);
            },
        ),
        ("/accessors/2/componentType", "5121, 5123", |j| {
            j["accessors"][2]["componentType"] = json!(5120);
        }),
        ("/accessors/3/type", "expected VEC4", |j| {
            j["accessors"][3]["type"] = json!("VEC3");
        }),
        (
            "/accessors/6",
            "expected at least 3 inverse bind matrices, one for each joint, found 2",
            |j| {
                j["accessors"][6]["count"] = json!(2);
            },
        ),
        ("targets/1/POSITION", "expected 20 elements", |j| {
            j["accessors"][5]["count"] = json!(3);
        }),
    ];
    for (place, message, change) in cases {
        let error = changed(change).unwrap_err().to_string();
        assert!(
            error.contains(place) && error.contains(message),
            "{place}: {error}"
        );
    }
}

#[test]
fn repairs_and_left_out_parts_are_counted() {
    let notes = |change: fn(&mut Value)| -> Vec<String> {
        let text = |note: &mesh_io::Note| {
            let note = note.to_string();
            note.split_once(": ").unwrap().1.to_owned()
        };
        changed(change).unwrap().notes.iter().map(text).collect()
    };
    // Without a buffer view, all weights are 0.
    let found = notes(|j| {
        let accessor = j["accessors"][3].as_object_mut().unwrap();
        accessor.remove("bufferView");
    });
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].starts_with(
            "20 vertices without weights in /meshes/0/primitives/0/attributes/WEIGHTS_0"
        )
    );
    // The accessor of the weights refers to the bytes of the positions, so the weights are arbitrary bytes.
    let found = notes(|j| {
        j["accessors"][3]["count"] = json!(20);
        j["accessors"][3]["byteOffset"] = json!(0);
        let accessor = &mut j["accessors"][3];
        accessor["bufferView"] = json!(0);
        accessor["componentType"] = json!(5121);
    });
    assert!(
        found
            .iter()
            .any(|note| note.contains("the weights were divided by their sum")),
        "{found:?}"
    );
    let found = notes(|j| j["scenes"][0]["nodes"] = json!([4]));
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(found[0].starts_with("4 nodes left out: not in the scene"));
    assert!(found[1].starts_with("1 skin left out: a joint is not in the scene"));
    assert!(
        found[2]
            .starts_with("3 animation channels left out: the animated node is not in the scene")
    );
    let found = notes(|j| j["animations"][0]["channels"][0]["target"]["path"] = json!("pointer"));
    assert!(
        found[0].starts_with("1 animation channel left out: the property"),
        "{found:?}"
    );
    let found = notes(|j| j["accessors"][8]["count"] = json!(2));
    assert!(
        found[0].contains("/animations/0/samplers/0 has times that do not increase"),
        "{found:?}"
    );
    let found = notes(|j| j["animations"][0]["channels"] = json!([]));
    assert_eq!(found, ["1 animation without channels left out"]);
    let found = notes(|j| {
        let target = &mut j["meshes"][0]["primitives"][0]["targets"][0];
        target["NORMAL"] = target["POSITION"].clone();
    });
    assert_eq!(found, ["1 attribute NORMAL of morph targets left out"]);
}
