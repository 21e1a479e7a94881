//! Tests of invalid COLLADA files. The reader returns errors with a position and does not panic.

use std::fmt::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use mesh_io::{Loaded, ReadError, ReadOptions};
use proptest::prelude::*;

const SQUARE: &str = r##"<COLLADA version="1.4.1">
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_effects><effect id="e"><profile_COMMON><technique><phong><diffuse><color>1 0 0</color></diffuse>
</phong></technique></profile_COMMON></effect></library_effects>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="4" stride="3">
<param name="X"/><param name="Y"/><param name="Z"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<polylist count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="NORMAL" source="#s" offset="1"/><vcount>4</vcount>
<p>0 0 1 1 2 2 3 3</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="n"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>"##;

fn read(text: &[u8]) -> Result<Loaded, ReadError> {
    mesh_io::read_bytes(
        &store::Disk,
        Path::new("a.dae"),
        text.to_vec(),
        &ReadOptions::default(),
    )
}

#[test]
fn the_square_is_valid() {
    let loaded = read(SQUARE.as_bytes()).unwrap();
    assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 1);
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
}

/// A part of the text of the file `SQUARE`, the text that replaces this part, and the expected error.
const BROKEN: &[(&str, &str, &str)] = &[
    (
        "<COLLADA version=\"1.4.1\">",
        "<kml>",
        "expected 'kml' tag, not 'COLLADA'",
    ),
    ("</mesh>", "", "expected 'mesh' tag, not 'geometry'"),
    (
        "0 0 0 1 0 0 1 1",
        "0 0 0 1 0 x 1 1",
        "6:57: expected a number, found `x`",
    ),
    (
        "0 0 0 1 0 0 1 1",
        "0 0 0 1 0 NaN 1 1",
        "6:57: expected a finite number, found `NaN`",
    ),
    (
        "0 0 0 1 0 0 1 1",
        "0 0 0 1 0 1e999 1 1",
        "expected a finite number",
    ),
    (
        "1 1 0 0 1 0<",
        "1 1 0 0 1<",
        "6:16: <float_array>: expected 12 numbers according to the attribute `count`, found 11",
    ),
    (
        "count=\"4\"",
        "count=\"5\"",
        "7:19: <accessor>: 5 vectors need more than the 12 numbers",
    ),
    (
        "count=\"4\"",
        "count=\"18446744073709551615\"",
        "vectors need more than",
    ),
    (
        "count=\"4\"",
        "count=\"-4\"",
        "expected the attribute `count` to be a non-negative integer, found `-4`",
    ),
    (
        "stride=\"3\"",
        "stride=\"2\"",
        "expected the stride of the accessor to be at least 3, found 2",
    ),
    (
        "stride=\"3\"",
        "stride=\"18446744073709551615\"",
        "need more than",
    ),
    (
        "stride=\"3\"",
        "stride=\"3\" offset=\"18446744073709551615\"",
        "need more than",
    ),
    (
        "<param name=\"Z\"/>",
        "",
        "expected an accessor with at least 3 components, found 2",
    ),
    (
        "source=\"#a\"",
        "source=\"#b\"",
        "expected the id `b` to refer to an element <float_array> or <int_array>, found nothing",
    ),
    (
        "source=\"#a\"",
        "source=\"#s\"",
        "expected the id `s` to refer to an element <float_array> or <int_array>, found <source>",
    ),
    (
        "source=\"#v\" offset=\"0\"",
        "source=\"#v\"",
        "expected an attribute `offset`",
    ),
    (
        "source=\"#v\" offset=\"0\"",
        "source=\"#v\" offset=\"4000000000\"",
        "at most 1000",
    ),
    (
        "\"VERTEX\"",
        "\"WERTEX\"",
        "10:1: <polylist>: expected an input VERTEX",
    ),
    (
        "\"POSITION\"",
        "\"PLACE\"",
        "9:1: <vertices>: expected an input POSITION",
    ),
    (
        "2 2 3 3<",
        "2 2 3 4<",
        "12:18: expected a normal index below 4, found 4",
    ),
    (
        "2 2 3 3<",
        "2 2 9 3<",
        "12:16: expected a position index below 4, found 9",
    ),
    (
        "2 2 3 3<",
        "2 2 -3 3<",
        "12:16: expected an index, found `-3`",
    ),
    (
        "2 2 3 3<",
        "2 2 3<",
        "expected 2 indices for each corner, but the total number of indices, 7, is not a multiple of 2",
    ),
    (
        "2 2 3 3<",
        "2 2<",
        "11:50: <vcount>: expected indices of 4 corners (the sum of the numbers in <vcount>), found indices of 3 corners",
    ),
    (
        "<vcount>4<",
        "<vcount>4294967295 4294967295<",
        "8589934590 corners (the sum of the numbers in <vcount>)",
    ),
    (
        "<vcount>4</vcount>",
        "",
        "expected the numbers of corners in <vcount>",
    ),
    (
        "polylist count=\"1\"",
        "polylist count=\"2\"",
        "expected 2 polygons according to the attribute `count`, found 1",
    ),
    (
        "0 0 0 1</matrix>",
        "0 0 0 2</matrix>",
        "13:59: <matrix>: expected 0 0 0 1 as the last row",
    ),
    (
        "0 0 0 1</matrix>",
        "0 0 1</matrix>",
        "expected 16 numbers, found 15",
    ),
    (
        "<matrix>1",
        "<scale>1e300 1 1</scale><scale>1e300 1 1</scale><matrix>1",
        "not finite",
    ),
    (
        "<matrix>1",
        "<lookat>0 0 0 0 0 0 0 1 0</lookat><matrix>1",
        "expected a view direction",
    ),
    ("url=\"#g\"", "url=\"g\"", "expected url=\"#id\", found `g`"),
    ("url=\"#g\"", "", "expected an attribute `url`"),
    (
        "url=\"#vs\"",
        "url=\"#g\"",
        "expected the id `g` to refer to an element <visual_scene>, found <geometry>",
    ),
    (
        "<instance_geometry url=\"#g\"/>",
        "<instance_node url=\"#n\"/>",
        "the node is its own descendant",
    ),
    (
        "1 0 0</color>",
        "1 0</color>",
        "3:76: <color>: expected 3 or 4 numbers, found 2",
    ),
    (
        "<COLLADA v",
        "<!DOCTYPE x [<!ENTITY a \"b\">]><COLLADA v",
        "document type declaration",
    ),
    (
        ">0 0 0 1 0 0 1 1 0",
        ">&a; 0 0 1 0 0 1 1 0",
        "unknown entity reference 'a'",
    ),
];

#[test]
fn errors_have_a_position_and_a_message() {
    let mut wrong = Vec::new();
    for (from, to, message) in BROKEN {
        assert!(SQUARE.contains(from), "{from}");
        let error = read(SQUARE.replacen(from, to, 1).as_bytes())
            .unwrap_err()
            .to_string();
        if !error.contains(message) || !error.starts_with("a.dae:") {
            wrong.push(format!("{from} -> {to}: {error}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    for bytes in [&b""[..], b"\xff\xfe<\0", b"<", b"<a", b"\0\0\0"] {
        assert!(matches!(read(bytes), Err(ReadError::Text { .. })));
    }
}

/// Reads a file, and checks that reading takes little time.
fn read_quickly(text: &str) -> Result<Loaded, ReadError> {
    let start = Instant::now();
    let result = read(text.as_bytes());
    assert!(
        start.elapsed() < Duration::from_secs(5),
        "{:?}",
        start.elapsed()
    );
    result
}

#[test]
fn deep_nesting_does_not_overflow_the_stack() {
    let deep = 100_000;
    let inner = "<instance_geometry url=\"#g\"/>";
    let nested = format!("{}{inner}{}", "<node>".repeat(deep), "</node>".repeat(deep));
    assert_eq!(
        read_quickly(&SQUARE.replacen(inner, &nested, 1))
            .unwrap()
            .objects
            .len(),
        1
    );
    assert!(read_quickly(&"<a>".repeat(deep)).is_err());
}

#[test]
fn exponentially_growing_instances_are_refused() {
    let mut library = String::from("<library_nodes>");
    for i in 0..64 {
        let next = i + 1;
        write!(
            library,
            "<node id=\"n{i}\"><instance_node url=\"#n{next}\"/><instance_node url=\"#n{next}\"/></node>"
        )
        .unwrap();
    }
    library += "<node id=\"n64\"/></library_nodes><library_visual_scenes>";
    let text = SQUARE
        .replacen("<library_visual_scenes>", &library, 1)
        .replacen(
            "<instance_geometry url=\"#g\"/>",
            "<instance_node url=\"#n0\"/>",
            1,
        );
    let error = read_quickly(&text).unwrap_err().to_string();
    assert!(
        error.contains("repeats its nodes far more often"),
        "{error}"
    );
}

#[test]
fn a_geometry_that_is_repeated_too_often_is_refused() {
    let corners = 20_000;
    let list = format!(
        "<polylist><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>{}</vcount><p>{}</p></polylist>",
        "3 ".repeat(corners / 3),
        "0 ".repeat(corners / 3 * 3)
    );
    let text = SQUARE
        .replacen("</mesh>", &format!("{list}</mesh>"), 1)
        .replacen(
            "<instance_geometry url=\"#g\"/>",
            &"<instance_geometry url=\"#g\"/>".repeat(5000),
            1,
        );
    let error = read_quickly(&text).unwrap_err().to_string();
    assert!(error.contains("repeats its content"), "{error}");
}

#[test]
fn many_sources_of_a_long_array_are_refused() {
    // The accessor of each source has the count 0, but the reader still reads all numbers of the array.
    let source = |i: usize| {
        format!(
            "<source id=\"s{i}\"><technique_common><accessor source=\"#a\" count=\"0\" stride=\"3\">\
             <param name=\"X\"/><param name=\"Y\"/><param name=\"Z\"/></accessor></technique_common></source>"
        )
    };
    let list = |i: usize| {
        format!(
            "<polygons><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\
             <input semantic=\"NORMAL\" source=\"#s{i}\" offset=\"0\"/><p/></polygons>"
        )
    };
    let n = 2000;
    let sources: String = (0..n).map(source).collect();
    let lists: String = (0..n).map(list).collect();
    let text = SQUARE
        .replacen("count=\"12\"", "", 1)
        .replacen(
            "0 1 0</float",
            &format!("0 1 0{}</float", " 0".repeat(200_000)),
            1,
        )
        .replacen("<vertices", &format!("{sources}<vertices"), 1)
        .replacen("</mesh>", &format!("{lists}</mesh>"), 1);
    let error = read_quickly(&text).unwrap_err().to_string();
    assert!(error.contains("repeats its content"), "{error}");
}

#[test]
fn instances_that_repeat_many_materials_or_a_long_name_are_refused() {
    let list = |i: usize| {
        format!(
            "<polygons material=\"x{i}\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p/></polygons>"
        )
    };
    let many = "<instance_geometry url=\"#g\"/>".repeat(2000);
    let repeated = SQUARE.replacen("<instance_geometry url=\"#g\"/>", &many, 1);
    let lists: String = (0..2000).map(list).collect();
    let materials = repeated.replacen("</mesh>", &format!("{lists}</mesh>"), 1);
    let name = format!("<node name=\"{}\"", "n".repeat(1 << 20));
    let names = repeated.replacen("<node", &name, 1);
    for text in [materials, names] {
        let error = read_quickly(&text).unwrap_err().to_string();
        assert!(error.contains("repeats its content"), "{error}");
    }
}

#[test]
fn an_effect_of_many_materials_is_read_once() {
    let n = 5000;
    let materials: Vec<String> = (0..n)
        .map(|i| format!("<material id=\"x{i}\"><instance_effect url=\"#e\"/></material>"))
        .collect();
    let lists: Vec<String> = (0..n)
        .map(|i| {
            format!(
                "<polygons material=\"x{i}\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\
                 <p>0 1 2</p></polygons>"
            )
        })
        .collect();
    let parameters = "<newparam sid=\"x\"/>".repeat(50_000);
    let text = SQUARE
        .replacen("<material", &format!("{}<material", materials.concat()), 1)
        .replacen("</mesh>", &format!("{}</mesh>", lists.concat()), 1)
        .replacen("<technique>", &format!("{parameters}<technique>"), 1)
        .replacen(
            "<color>1 0 0</color>",
            "<texture texture=\"t\" texcoord=\"u\"/>",
            1,
        );
    let loaded = read_quickly(&text).unwrap();
    assert_eq!(loaded.objects[0].materials.len(), n + 1);
}

#[test]
fn xml_that_makes_the_parser_slow_is_refused() {
    let mut attributes = String::from("<COLLADA");
    let mut namespaces = String::from("<COLLADA");
    for i in 0..50_000 {
        write!(attributes, " a{i}=''").unwrap();
        write!(namespaces, " xmlns:a{i}='u'").unwrap();
    }
    assert!(
        read_quickly(&(attributes + "/>"))
            .unwrap_err()
            .to_string()
            .contains("attributes")
    );
    assert!(
        read_quickly(&(namespaces + "/>"))
            .unwrap_err()
            .to_string()
            .contains("at most")
    );
    assert!(read_quickly(&"=".repeat(1_000_000)).is_err());
    assert!(read_quickly(&"<".repeat(1_000_000)).is_err());
}

proptest! {
    #[test]
    fn random_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = read(&bytes);
    }

    #[test]
    fn a_truncated_file_is_refused(end in 0..SQUARE.len() - 1) {
        prop_assert!(read(&SQUARE.as_bytes()[..end]).is_err());
    }

    #[test]
    fn a_file_with_replaced_words_does_not_panic(
        changes in prop::collection::vec((0..SQUARE.len(), "[-0-9#./<>a-z\" ]{1,3}"), 1..4)
    ) {
        let mut text = SQUARE.as_bytes().to_vec();
        for (at, new) in changes {
            let end = (at + new.len()).min(text.len());
            text.splice(at.min(end)..end, new.bytes());
        }
        let _ = read(&text);
    }
}
