//! Tests of invalid glTF files. The reader returns errors with a JSON pointer and does not panic.

use mesh_io::{ReadError, ReadOptions};
use proptest::prelude::*;
use scene::Object;
use serde_json::{Value, json};

use crate::gltf_read::{SQUARE, document, floats, read_json, square};
use crate::gltf_written::sphere;
use crate::{Folder, read, write};

const FOUR_BILLION: u32 = 4_000_000_000;

/// Changes one value of a valid document, and checks the pointer and the message of the error.
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
fn errors_in_nodes_and_scenes_name_the_pointer() {
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
            json!(["KHR_other"]),
            "/extensionsRequired/0",
            "KHR_other",
        ),
        (
            "/scene",
            json!(3),
            "/scene",
            "scene 3 does not exist (the file has 1)",
        ),
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
            "mesh 1 does not exist (the file has 1)",
        ),
        (
            "/nodes/0/children",
            json!([0]),
            "/nodes/0",
            "twice in the scene or is its own descendant",
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
    ] {
        assert_refused(change, to, pointer, words);
    }
}

#[test]
fn errors_in_primitives_and_accessors_name_the_pointer() {
    for (change, to, pointer, words) in [
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
            json!(FOUR_BILLION),
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
            "without a buffer view",
        ),
        ("/accessors/0/type", json!(3), "/accessors/0", "expected"),
    ] {
        assert_refused(change, to, pointer, words);
    }
}

#[test]
fn errors_in_buffers_and_uris_name_the_pointer() {
    for (change, to, pointer, words) in [
        (
            "/bufferViews/0/buffer",
            json!(1),
            "/bufferViews/0/buffer",
            "buffer 1",
        ),
        (
            "/bufferViews/0/byteLength",
            json!(FOUR_BILLION),
            "/bufferViews/0/byteLength",
            "buffer 0 has only 60",
        ),
        (
            "/bufferViews/0/byteOffset",
            json!(u64::MAX),
            "/bufferViews/0/byteLength",
            "buffer 0 has only 60",
        ),
        (
            "/bufferViews/0/byteStride",
            json!(4),
            "/bufferViews/0/byteStride",
            "at least 12, the size of an element",
        ),
        (
            "/buffers/0/byteLength",
            json!(FOUR_BILLION),
            "/buffers/0/byteLength",
            "has only 60",
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
    ] {
        assert_refused(change, to, pointer, words);
    }
}

#[test]
fn uris_that_leave_the_folder_are_refused() {
    for (uri, words) in [
        ("../a.bin", "\"../a.bin\" leads out"),
        ("a/../../a.bin", "leads out"),
        ("/etc/passwd", "absolute"),
        ("file:///etc/passwd", "scheme"),
        ("http://a/b", "scheme"),
        ("C:/a.bin", "drive"),
        ("..\\a.bin", "backslash"),
        ("\\\\host\\a.bin", "backslash"),
        ("%2e%2e/a.bin", "percent"),
        ("%2e%2e%2fa.bin", "percent"),
        ("..%5Ca.bin", "percent"),
        ("a%00.bin", "control"),
        ("%ff.bin", "percent"),
        ("a.bin?b", "query"),
        ("", "empty"),
    ] {
        assert_refused("/buffers/0/uri", json!(uri), "/buffers/0/uri", words);
    }
}

#[test]
fn data_uris_are_read_in_every_variant() {
    let good = square(&[0, 1, 2, 0, 2, 3], 4);
    let uri = good["buffers"][0]["uri"].as_str().unwrap();
    let data = uri.split_once("base64,").unwrap().1;
    let (first, second) = data.split_at(21);
    for uri in [
        format!("data:;base64,{data}"),
        format!("data:application/gltf-buffer;base64,{data}"),
        format!("data:application/octet-stream;charset=utf-8;base64,{data}"),
        format!("data:;base64,{}", data.trim_end_matches('=')),
        format!("data:;base64,\n  {first}\r\n\t{second}\n"),
        format!("data:;base64,{}", data.replace('+', "-").replace('/', "_")),
    ] {
        let mut json = good.clone();
        json["buffers"][0]["uri"] = json!(uri);
        assert!(read_json(&json).is_ok(), "{uri}");
    }
}

#[test]
fn non_finite_numbers_are_refused() {
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
fn a_long_chain_of_nodes_does_not_overflow_the_stack() {
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn random_bytes_do_not_panic(bytes: Vec<u8>) {
        let folder = Folder::new();
        for (name, head) in [("a.gltf", &b""[..]), ("a.glb", b""), ("b.glb", b"glTF\x02\0\0\0")] {
            let path = folder.with(name, [head, &bytes].concat());
            let _ = read(&path);
            let _ = mesh_io::peek(&store::Disk, &path, &ReadOptions::default());
        }
        for name in ["a.obj", "a.bez", "a.bzc"] {
            let path = folder.with(name, &bytes);
            let _ = read(&path);
            let _ = mesh_io::peek(&store::Disk, &path, &ReadOptions::default());
        }
    }

    #[test]
    fn a_file_with_changed_bytes_does_not_panic(
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
        let _ = mesh_io::peek(&store::Disk, &path, &ReadOptions::default());
    }

    #[test]
    fn a_document_with_changed_numbers_does_not_panic(
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

#[test]
fn uncompressed_data_is_read_instead_of_draco() {
    let mut json = json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_draco_mesh_compression"],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0 },
            "extensions": { "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } },
        }] }],
        "accessors": [{ "componentType": 5126, "count": 3, "type": "VEC3" }],
        "buffers": [{ "byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
    });
    let error = read_json(&json).unwrap_err().to_string();
    let expected =
        "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: expected triangles";
    assert!(error.contains(expected), "{error}");
    // If the accessor also has uncompressed data, the extension is not needed and not checked.
    json["accessors"][0]["bufferView"] = json!(0);
    let loaded = read_json(&json).unwrap();
    assert_eq!(loaded.notes, []);
    assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 1);
}
