//! Tests of invalid PLY files. The reader returns errors with a position.

use std::time::{Duration, Instant};

use mesh_io::{ReadError, ReadOptions};
use proptest::prelude::*;
use scene::Object;

use crate::{Folder, read, write};

const VERTEX: &str = "property float x\nproperty float y\nproperty float z\n";

fn error(bytes: impl AsRef<[u8]>) -> String {
    let folder = Folder::new();
    let path = folder.with("a.ply", bytes);
    let error = read(&path).unwrap_err();
    assert!(
        matches!(error, ReadError::Text { .. } | ReadError::Binary { .. }),
        "{error}"
    );
    let text = error.to_string();
    text.split_once("a.ply:")
        .map_or(text.clone(), |(_, rest)| rest.to_owned())
}

#[track_caller]
fn assert_error(bytes: impl AsRef<[u8]>, expected: &str) {
    let found = error(bytes);
    assert!(found.contains(expected), "{found}");
}

/// Returns a text file with three vertices and one face.
fn text(vertices: &str, face: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\n{VERTEX}element face 1\n\
         property list uchar int vertex_indices\nend_header\n{vertices}{face}"
    )
}

const CORNERS: &str = "0 0 0\n1 0 0\n0 1 0\n";

fn binary(face: &[u8]) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\n{VERTEX}element face 1\n\
         property list int int vertex_indices\nend_header\n"
    )
    .into_bytes();
    bytes.extend((0..9_u8).flat_map(|i| f32::from(i * i).to_le_bytes()));
    bytes.extend_from_slice(face);
    bytes
}

fn ints(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[test]
fn errors_in_the_header_name_the_line() {
    assert_error("", "1:1: expected `ply`, found nothing");
    assert_error("plx\n", "1:1: expected `ply`, found `plx`");
    assert_error(
        "ply\nformat ascii 1.0\nelement vertex 0\n",
        "4:1: expected `end_header`",
    );
    assert_error("ply\nend_header\n", "2:1: expected a `format` line");
    assert_error(
        "ply\nformat ascii 1.0\nend_header\n",
        "expected an element `vertex`",
    );
    assert_error(
        "ply\nformat ascii 2.0\n",
        "2:14: expected version 1.0, found `2.0`",
    );
    assert_error(
        "ply\nformat binary 1.0\n",
        "2:8: expected ascii, binary_little_endian or",
    );
    assert_error(
        "ply\nformat ascii 1.0\nformat ascii 1.0\n",
        "3:1: expected one `format` line",
    );
    assert_error("ply\nproperty float x\n", "2:1: expected an element before");
    assert_error(
        "ply\nelement vertex many\n",
        "2:16: expected the number of rows, found `many`",
    );
    assert_error(
        "ply\nelement vertex -1\n",
        "2:16: expected the number of rows",
    );
    assert_error(
        "ply\nelement vertex 1 2\n",
        "2:18: expected the end of the line, found `2`",
    );
    assert_error(
        "ply\nelement v 1\nproperty real x\n",
        "3:10: expected a type such as float",
    );
    assert_error(
        "ply\nelement v 1\nproperty list float int x\n",
        "3:15: expected an integer type",
    );
    assert_error(
        "ply\nelement v 1\nproperty float\n",
        "3:15: expected the name of a property",
    );
    assert_error(
        "ply\nsolid\n",
        "2:1: expected a line of a PLY header, found `solid`",
    );
}

#[test]
fn names_are_unique() {
    assert_error(
        "ply\nelement vertex 1\nproperty float x\nproperty int x\n",
        "4:14: property `x` of `vertex` is declared twice",
    );
    assert_error(
        "ply\nelement v 1\nelement v 1\n",
        "3:9: element `v` is declared twice",
    );
}

#[test]
fn properties_with_standard_names_must_have_the_right_type() {
    let header = |vertex: &str, face: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 1\n{vertex}element face 1\n{face}end_header\n"
        )
    };
    let list = "property list uchar int vertex_indices\n";
    assert_error(
        header(
            "property float x\nproperty list uchar float y\nproperty float z\n",
            list,
        ),
        "5:27: expected a scalar property `y` in element `vertex`, found a list",
    );
    assert_error(
        header("property float x\n", list),
        "3:9: expected a scalar property `y`",
    );
    assert_error(
        header(VERTEX, "property int vertex_indices\n"),
        "found a scalar",
    );
    assert_error(
        header(VERTEX, "property int corners\n"),
        "7:9: expected a list property `vertex_indices`",
    );
    assert_error(
        header(VERTEX, "property list uchar float vertex_index\n"),
        "expected a list of integers, found a list of type float",
    );
}

#[test]
fn counts_that_the_file_cannot_hold_are_refused_at_once() {
    for (format, before) in [
        ("ascii", "too short for "),
        ("binary_little_endian", "rows: "),
    ] {
        for count in ["4000000000", "18446744073709551615", "3074457345618258603"] {
            let header = format!(
                "ply\nformat {format} 1.0\nelement vertex {count}\n{VERTEX}end_header\n0 0 0\n"
            );
            assert_error(header, &format!("{before}{count}"));
        }
    }
    let no_properties = format!(
        "ply\nformat ascii 1.0\nelement a 4000000000\nelement vertex 0\n{VERTEX}end_header\n"
    );
    let folder = Folder::new();
    assert!(read(&folder.with("a.ply", no_properties)).is_ok());
}

#[test]
fn vertices_of_faces_must_exist() {
    assert_error(
        text(CORNERS, "3 0 1 3\n"),
        "13:7: expected a vertex index below 3, found 3",
    );
    assert_error(
        text(CORNERS, "3 0 -1 2\n"),
        "13:5: expected a vertex index below 3, found -1",
    );
    let at = binary(&[]).len();
    let expected = format!("byte {}: expected a vertex index below 3, found 3", at + 8);
    assert_error(binary(&ints(&[3, 0, 3, 2])), &expected);
    assert_error(binary(&ints(&[3, 0, 1, -7])), "found -7");
}

#[test]
fn counts_of_lists_must_be_valid() {
    let at = binary(&[]).len();
    assert_error(
        binary(&ints(&[-1, 0, 1, 2])),
        &format!(
            "byte {at}: expected a non-negative list count, found -1 in `vertex_indices` of row 0"
        ),
    );
    assert_error(
        binary(&ints(&[i32::MAX, 0, 1, 2])),
        &format!("byte {at}: expected 2147483647 values of 4 bytes each, found only 12 bytes"),
    );
    assert_error(
        text(CORNERS, "-3 0 1 2\n"),
        "13:1: expected an integer from 0 to 255",
    );
    assert_error(
        text(CORNERS, "200 0 1 2\n"),
        "13:1: expected a valid list count, found `200`",
    );
}

#[test]
fn files_that_end_too_early_are_refused() {
    let whole = binary(&ints(&[3, 0, 1, 2]));
    let start = whole.len() - 16 - 36;
    assert_error(
        &whole[..whole.len() - 17],
        &format!(
            "byte {start}: the rest of the file is too short for all rows of element `vertex` (rows: 3,"
        ),
    );
    assert_error(
        &whole[..whole.len() - 1],
        "expected 3 values of 4 bytes each, found only 11 bytes",
    );
    assert_error(
        text("0 0 0\n1 0 0\n", ""),
        "the rest of the file is too short for 3 lines of element `vertex`",
    );
    assert_error(
        text(CORNERS, ""),
        "the rest of the file is too short for 1 line of element `face`",
    );
}

#[test]
fn lines_must_have_the_values_that_the_header_declares() {
    assert_error(
        text("0 0 0\n1 0\n0 1 0\n", "3 0 1 2\n"),
        "11:4: expected a value of the property `z`",
    );
    assert_error(
        text("0 0 0\n1 0 0 0\n0 1 0\n", "3 0 1 2\n"),
        "11:7: expected the end of the line",
    );
    assert_error(
        text(CORNERS, "3 0 1\n"),
        "13:6: expected a value of the property `vertex_indices`",
    );
    assert_error(text(CORNERS, "3 0 1 2.5\n"), "13:7: expected an integer");
    assert_error(
        text("0 0 0\n1 a 0\n0 1 0\n", "3 0 1 2\n"),
        "11:3: expected a number, found `a`",
    );
}

#[test]
fn positions_must_be_finite() {
    for (word, message) in [
        ("nan", "expected the coordinate `y` to be a finite number"),
        ("inf", "expected the coordinate `y` to be a finite number"),
        ("-INF", "expected the coordinate `y` to be a finite number"),
        (
            "-nan(ind)",
            "expected the coordinate `y` to be a finite number",
        ),
        ("1e999", "expected a finite number, found `1e999`"),
    ] {
        let vertices = format!("0 0 0\n1 {word} 0\n0 1 0\n");
        assert_error(text(&vertices, "3 0 1 2\n"), &format!("11:3: {message}"));
    }
    let mut bytes = binary(&ints(&[3, 0, 1, 2]));
    let at = bytes.len() - 16 - 8;
    bytes[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_error(
        bytes,
        &format!("byte {at}: expected the coordinate `y` to be a finite number, found NaN"),
    );
}

#[test]
fn a_carriage_return_before_binary_values_is_part_of_the_line_end() {
    let unix = binary(&ints(&[3, 0, 1, 2]));
    let end = unix.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let header = String::from_utf8(unix[..end].to_vec())
        .unwrap()
        .replace('\n', "\r\n");
    let mut windows = header.into_bytes();
    windows.extend_from_slice(&unix[end..]);
    let folder = Folder::new();
    let meshes = [&unix, &windows].map(|bytes| read(&folder.with("a.ply", bytes)).unwrap());
    assert_eq!(meshes[0], meshes[1]);
    assert_eq!(meshes[0].notes, []);
}

#[test]
fn bytes_after_the_last_element_are_noted() {
    let folder = Folder::new();
    let loaded = read(&folder.with("a.ply", binary(&ints(&[3, 0, 1, 2, 7])))).unwrap();
    assert_eq!(loaded.notes.len(), 1);
    assert!(
        loaded.notes[0]
            .to_string()
            .ends_with("4 bytes left out after the last element")
    );
}

fn whatever(bytes: &[u8]) {
    let folder = Folder::new();
    let path = folder.with("a.ply", bytes);
    let _ = read(&path);
    let _ = mesh_io::peek(&store::Disk, &path, &ReadOptions::default());
}

/// Returns a valid binary file. Its faces have lists of texture coordinates, because the mesh has seams.
fn valid() -> Vec<u8> {
    let folder = Folder::new();
    let path = folder.path("a.ply");
    write(&path, [Object::mesh("a", crate::gltf_written::sphere())]);
    std::fs::read(path).unwrap()
}

proptest! {
    #[test]
    fn random_bytes_do_not_panic(body in prop::collection::vec(any::<u8>(), 0..200), lists in any::<bool>()) {
        let face = if lists { "property list char short vertex_indices\nproperty list int float texcoord\n" }
            else { "property list uint uchar vertex_indices\n" };
        let strips = if lists { "element face 3\n" } else { "element tristrips 2\n" };
        let mut bytes = format!(
            "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty char x\nproperty short y\n\
             property char z\n{strips}{face}end_header\n").into_bytes();
        bytes.extend(body);
        whatever(&bytes);
    }

    #[test]
    fn damaged_files_do_not_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        cut in any::<prop::sample::Index>(),
        keep in any::<bool>(),
    ) {
        let mut bytes = valid();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if !keep {
            bytes.truncate(cut.index(bytes.len()));
        }
        whatever(&bytes);
        let mut text = text(CORNERS, "3 0 1 2\n").into_bytes();
        let at = cut.index(text.len());
        text[at] = bytes.first().copied().unwrap_or(0);
        whatever(&text);
    }
}

#[test]
fn repeated_comments_for_a_list_do_not_take_long() {
    // Each of the 20,000 equal comments describes the list `values`. The list of the last face has a wrong length, so
    // the comments are not valid. Comparing every comment with all faces would take a long time.
    let n = 50_000;
    let comment = "comment meshwright corner float copy values \"a\"\n".repeat(20_000);
    let head = format!(
        "ply\nformat ascii 1.0\n{comment}element vertex 3\n{VERTEX}element face {n}\n\
         property list uchar int vertex_indices\nproperty list uchar int values\nend_header\n{CORNERS}"
    );
    let face = "3 0 1 2 3 0 0 0\n".repeat(n - 1) + "3 0 1 2 1 0\n";
    let folder = Folder::new();
    let path = folder.with("a.ply", head + &face);
    let start = Instant::now();
    read(&path).unwrap();
    assert!(start.elapsed() < Duration::from_secs(5));
}

#[test]
fn too_many_elements_are_refused() {
    let elements: Vec<_> = (0..100_000).map(|i| format!("element a{i} 0\n")).collect();
    let elements = elements.concat();
    let file = format!("ply\nformat ascii 1.0\n{elements}element vertex 0\n{VERTEX}end_header\n");
    assert_error(file, "1027:9: expected a header with at most 1024 elements");
}
