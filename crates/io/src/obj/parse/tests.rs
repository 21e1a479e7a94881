//! Tests of parsing the statements of OBJ files, as a whole and in parts.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};
use proptest::prelude::*;

use store::{Memory, Store};

use super::super::file::{NONE, Run};
use super::*;
use crate::ReadOptions;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn read(text: &str) -> ObjFile {
    parse(text.as_bytes()).unwrap()
}

#[test]
fn polygons_of_any_degree_keep_their_corners_and_order() {
    let file = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\nf 3 2 1\n");
    assert_eq!(file.positions.len(), 5);
    assert_eq!(file.offsets, [0, 4, 7]);
    assert_eq!(file.corners[0], [0, 1, 2, 3, 2, 1, 0]);
    assert!(file.corners[1].is_empty() && file.corners[2].is_empty());
}

#[test]
fn corners_have_texture_coordinates_and_normals_in_every_combination() {
    let file = read(&format!(
        "{TRIANGLE}vt 0.5\nvt 1 1 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3\nf 1//1 2//1 3//1\n\
         f 1/1/1 2/-1/-1 3/2/1\nf 1/ 2// 3/2/\n"
    ));
    let n = NONE;
    assert_eq!(
        file.corners[1],
        [n, n, n, 0, 1, n, n, n, n, 0, 1, 1, n, n, 1]
    );
    assert_eq!(
        file.corners[2],
        [n, n, n, n, n, n, 0, 0, 0, 0, 0, 0, n, n, n]
    );
    assert_eq!(file.uvs, [DVec2::new(0.5, 0.0), DVec2::ONE]);
}

#[test]
fn negative_indices_count_back_from_the_line() {
    let file = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 2 2 2\nf -4 -2 -1\n");
    assert_eq!(file.corners[0], [0, 1, 2, 0, 2, 3]);
}

#[test]
fn vertices_can_come_after_the_faces_that_use_them() {
    assert_eq!(read(&format!("f 1 2 3\n{TRIANGLE}")).corners[0], [0, 1, 2]);
}

#[test]
fn colors_and_weights_follow_the_coordinates() {
    let file = read("v 0 0 0\nv 1 0 0 1 0.5 0\nv 1 0 0 1\nv 1 0 0 2.5\nv 1 0 0 0 0 0 0.5\n");
    let color = |r, g, b, a| DVec4::new(r, g, b, a);
    let white = DVec4::ONE;
    let expected = [
        white,
        color(1.0, 0.5, 0.0, 1.0),
        white,
        white,
        color(0.0, 0.0, 0.0, 0.5),
    ];
    assert_eq!(file.colors, expected);
    assert_eq!(file.left_out[&LeftOut::Weights], (1, 4));
}

#[test]
fn line_ends_tabs_continuations_and_exponents_are_parsed() {
    let file = read(
        "\u{feff}# art \\\r\nv\t1e2 -2.5E-1 +3 # here\rv 0 0 \\\n  1\r\n\nv 1 1 1\nf 1 \\\r\n2 3",
    );
    assert_eq!(file.positions[0], DVec3::new(100.0, -0.25, 3.0));
    assert_eq!(file.positions[1], DVec3::Z);
    assert_eq!(file.corners[0], [0, 1, 2]);
    assert!(file.left_out.is_empty(), "{:?}", file.left_out);
}

#[test]
fn runs_hold_groups_object_material_and_smoothing() {
    let file = read(&format!(
        "{TRIANGLE}f 1 2 3\no my thing\ng b a b\nusemtl red paint\ns 3\nf 1 2 3\nf 1 2 3\n\
         g b a\nf 1 2 3\ng\ns off\nusemtl (null)\nf 1 2 3\ng # comment\nf 1 2 3\n"
    ));
    let named = Run {
        first_face: 1,
        groups: 1,
        object: Some(0),
        material: Some(0),
        smoothing: 3,
    };
    let last = Run {
        first_face: 4,
        object: Some(0),
        ..Run::default()
    };
    assert_eq!(file.runs, [Run::default(), named, last]);
    assert_eq!(file.group_sets, [vec![], vec![0, 1]]);
    assert_eq!(file.group_names, ["b", "a"]);
    assert_eq!(file.object_names, ["my thing"]);
    assert_eq!(file.material_names, ["red paint"]);
}

#[test]
fn content_left_out_is_counted_with_its_first_line() {
    let file = read(&format!(
        "{TRIANGLE}vp 1 2\nvp 1 2\ncstype bezier\nwhatever\np 1 2 -1\nl 1 2 3/1\nvt 0 0 0.5\n\
         f 1 2\n"
    ));
    let expected = [
        (LeftOut::Statement("cstype".into()), (1, 6)),
        (LeftOut::Statement("vp".into()), (2, 4)),
        (LeftOut::Unknown("whatever".into()), (1, 7)),
        (LeftOut::Points, (3, 8)),
        (LeftOut::SmallFaces, (1, 11)),
        (LeftOut::Depths, (1, 10)),
    ];
    assert_eq!(file.left_out, BTreeMap::from(expected));
    assert_eq!(file.line_corners, [0, 1, 2]);
}

#[test]
fn errors_name_the_line_and_column() {
    for (text, line, column, words) in [
        ("v 0 0", 4, 1, "found 2 numbers"),
        ("v 0 0 0 1 1", 4, 1, "found 5 numbers"),
        ("v 1 2 3 4 5 6 7 8", 4, 1, "at most 7"),
        ("v 0 x 0", 4, 5, "expected a number, found `x`"),
        ("v 0 0 nan", 4, 7, "finite number, found `nan`"),
        ("v 0 0 -inf", 4, 7, "finite"),
        ("v 1e400 0 0", 4, 3, "finite"),
        ("vt", 4, 1, "found none"),
        ("vt 0 0 0 0", 4, 1, "at most 3"),
        ("vn 0 0", 4, 1, "found 2"),
        ("f 1 2 0", 4, 7, "start at 1"),
        ("f 1 2 4", 4, 7, "vertex 4, but the file defines 3 vertices"),
        (
            "f 1 2 -4",
            4,
            7,
            "vertex -4, but the file defines only 3 vertices before this line",
        ),
        (
            "f 1 2 3/1",
            4,
            7,
            "texture coordinate 1, but the file defines 0 texture coordinates",
        ),
        (
            "f 1 2 3//2\nvn 0 0 1",
            4,
            7,
            "normal 2, but the file defines 1 normal",
        ),
        ("f 1 2 3 \\\n 99999999999", 5, 2, "vertex 99999999999, but"),
        ("f 1 2 99999999999999999999", 4, 7, "expected a corner"),
        (
            "f 1 2 a",
            4,
            7,
            "expected a corner such as 1, 1/2, 1//3 or 1/2/3, found `a`",
        ),
        ("f 1 2 3/4/5/6", 4, 7, "found `3/4/5/6`"),
        ("f 1 2 /1", 4, 7, "expected a corner"),
        ("l 1", 4, 1, "at least 2 vertices, found 1"),
        ("l 1 9", 4, 5, "vertex 9"),
        ("p 9", 4, 3, "vertex 9"),
        ("s many", 4, 3, "found `many`"),
        ("s -1", 4, 3, "found `-1`"),
        ("s", 4, 1, "found nothing"),
    ] {
        let error = parse(format!("{TRIANGLE}{text}").as_bytes()).unwrap_err();
        assert!(error.message.contains(words), "{text:?}: {error:?}");
        assert_eq!(error.place(), (line, column), "{text:?}: {error:?}");
    }
}

#[test]
fn a_file_of_another_format_is_refused() {
    let error = parse(b"# hello\nsolid thing\n").unwrap_err();
    assert_eq!(error.place().0, 2);
    assert!(parse(b"# nothing\n").is_ok());
}

/// Parses a file in order, without cutting it into parts.
fn in_order(bytes: &[u8]) -> Result<ObjFile, Fault> {
    let file = join(vec![parse_whole(bytes)?]);
    match first_unknown(&file) {
        Some(error) if file.positions.is_empty() => Err(error),
        _ => Ok(file),
    }
}

fn assert_independent_of_parts(bytes: &[u8]) {
    let expected = in_order(bytes);
    for size in [1, 2, 3, 5, 8, 13, 21, 34, 55, 1000, PART] {
        assert_eq!(
            parse_in_parts(bytes, size),
            expected,
            "parts of {size} bytes"
        );
    }
}

#[test]
fn parts_end_with_lines_that_are_not_continued() {
    let text = b"a\\\nb\r\nc\\\r\nd\re\n\nf\\\rg";
    let expected: [&[u8]; 5] = [b"a\\\nb\r\n", b"c\\\r\nd\r", b"e\n", b"\nf\\\rg", b""];
    assert_eq!(cut(text, 1), expected);
    for size in 1..30 {
        let parts = cut(text, size);
        assert_eq!(parts.concat(), text);
        let (last, others) = parts.split_last().unwrap();
        let ends_the_text = usize::from(last.is_empty());
        for part in &others[..others.len() - ends_the_text] {
            let line = part.strip_suffix(b"\n").unwrap_or(part);
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            assert!(line.len() < part.len() && !line.ends_with(b"\\"));
        }
    }
}

#[test]
fn names_runs_and_relative_indices_continue_across_parts() {
    let text = format!(
        "\u{feff}# art\n{TRIANGLE}vt 0 0\nvn 0 0 1\no a\ng x y\nusemtl m\ns 1\nf 1 2 3\n\
         f -3/-1 -2 -1//-1\nmtllib a.mtl\nv 1 1 1 1 0 0\ng y\nf -2 -1 -4\nusemtl\ng y x\n\
         l -1 -2 1\nf 1/1/1 2/1/1 3/1/1\no b\nvp 1\nwhat 1\ns off\no a\nusemtl m\n\
         p -1 4\nf 2 3 4 5\nv 5 5 5\nf 3 4 -1\nvp 2\nmtllib b.mtl\nf 3 4 5"
    );
    assert_independent_of_parts(text.as_bytes());
    let file = parse_in_parts(text.as_bytes(), 1).unwrap();
    assert_eq!(file.offsets.len() - 1, 7);
    assert_eq!(file.corners[0][3..9], [0, 1, 2, 2, 3, 0]);
    assert_eq!(file.line_corners, [3, 2, 0]);
    assert_eq!(file.colors[3], DVec4::new(1.0, 0.0, 0.0, 1.0));
    assert_eq!(file.left_out[&LeftOut::Statement("vp".into())], (2, 22));
    let lines: Vec<_> = file.libraries.iter().map(|(place, _)| place.line).collect();
    assert_eq!(lines, [13, 32]);
}

#[test]
fn the_first_error_is_reported_independently_of_the_parts() {
    for text in [
        "v 0 0 0\nv 0 0\nv 0\nf 1 2 0\n",
        "v 0 0 0\nf 1 1 -2\nv 0 0\n",
        "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 4\nf 1 2 5\n",
        "v 0 0 0\nf 1 1 2\n",
        "v 0 0 0\nf 1/1 1/1 1/-1\nvt 0 0\n",
        "v 0 0 0\np -2\n",
        "v 0 0 0\nl -1 -2\n",
        "one\ntwo\nvn 0 0 1\n",
    ] {
        assert!(in_order(text.as_bytes()).is_err(), "{text}");
        assert_independent_of_parts(text.as_bytes());
    }
}

#[test]
fn the_first_unknown_words_are_listed_independently_of_the_parts() {
    let words: Vec<String> = (0..40).map(|i| format!("w{}", i * i % 13)).collect();
    let text = format!("v 0 0 0\n{}\nw3\nzz\n", words.join("\n"));
    assert_independent_of_parts(text.as_bytes());
}

#[test]
fn a_line_of_ten_megabytes_is_one_face() {
    let n = 1_300_000_u32;
    let text = format!("v 0 0 0\nf{}\nf 1 1 1\n", " 1/1/1".repeat(n as usize));
    let text = format!("vt 0 0\nvn 0 0 1\n{text}");
    assert_eq!(read(&text).offsets, [0, n, n + 3]);
    let continued = text.replace(" 1/1/1", " \\\n1/1/1");
    assert_eq!(read(&continued), read(&text));
    let comment = format!("v 0 0 0\n#{}\nf 1 1 1", "x".repeat(10 << 20));
    assert_eq!(read(&comment).offsets.len() - 1, 1);
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let mut text = String::from(TRIANGLE);
    for i in 0..60_000 {
        text += &format!("v {i} 0.1 1e-3\ng g{}\nf -1 -2 {}\n", i % 7, 1 + i % 50);
    }
    let read = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| parse(text.as_bytes()))
    };
    let expected = in_order(text.as_bytes());
    assert!(text.len() > 4 * PART && expected.is_ok());
    for threads in [1, 2, 8] {
        assert_eq!(read(threads), expected);
    }
}

/// A pattern for lines of all kinds. Most of these lines are valid.
const LINES: &str = "(v( -?[0-9]{1,2}(\\.[0-9]{1,20})?){3}( [01]){0,4}|vt( [0-9]\\.[0-9]{1,3}){1,3}|\
    vn( -?[0-9]){3}|f( {1,2}-?[1-9]{1,2}){2,5}|f( [1-4]/[1-3]){3,4}|f( -?[1-3]//-?[1-3]){3}|\
    f( [1-3]/-?[1-2]/[1-3]){3}|l( -?[1-3]){1,3}|p 1 -1|g( [a-d]){0,3}|o [ab]{0,2}|usemtl [a-c]?|\
    s [0-2]|s off|vp 1|# [a-z]{0,9}|mtllib a|[xyz]|v 1 2 \\\\|f 1 2\\t3 |v 1e[0-9]{1,2} +1 .5|)\
    (\n|\r|\r\n)";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn the_result_does_not_depend_on_the_parts(
        start in "(v 1 2 3\n){0,9}(vt 0 0\n){0,3}(vn 0 0 1\n){0,3}",
        lines in prop::collection::vec(LINES, 0..30),
        size in 1..200_usize,
    ) {
        let text = start + &lines.concat();
        let expected = in_order(text.as_bytes());
        prop_assert_eq!(&parse_in_parts(text.as_bytes(), size), &expected);
        prop_assert_eq!(&parse_in_parts(text.as_bytes(), 1), &expected);
        assert_peek_notes_what_reading_leaves_out(text.as_bytes());
    }
}

proptest! {
    #[test]
    fn random_bytes_give_the_same_result_in_parts(
        bytes: Vec<u8>,
        text in "((v|vt|vn|f|l|p|g|o|s|usemtl|mtllib|x)[ \t/0-9a.\\\\\r\\-]{0,12}\n){0,30}",
    ) {
        assert_independent_of_parts(&bytes);
        assert_independent_of_parts(text.as_bytes());
        assert_peek_notes_what_reading_leaves_out(&bytes);
        assert_peek_notes_what_reading_leaves_out(text.as_bytes());
    }
}

fn assert_peek_notes_what_reading_leaves_out(bytes: &[u8]) {
    let (store, path, options) = (Memory::default(), "a.obj".as_ref(), ReadOptions::default());
    store.write(path, bytes).unwrap();
    let peek = crate::peek(&store, path, &options);
    let Ok(read) = crate::read(&store, path, &options) else {
        return;
    };
    let peek = peek.unwrap();
    for note in &peek.left_out {
        assert!(
            read.notes.contains(note),
            "{note} is not in {:?}",
            read.notes
        );
    }
    let names = |object: &scene::Object| object.materials.iter().map(|m| m.name.clone()).collect();
    if let Some(materials) = &peek.objects[0].materials {
        let read: Vec<String> = names(&read.objects[0]);
        assert_eq!(materials, &read);
    }
}
