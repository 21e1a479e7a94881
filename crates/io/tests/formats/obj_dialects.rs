//! Tests of OBJ files with spellings that other programs and people use.

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Domain, Mesh, UV, VERTEX_NORMAL};

use crate::{Folder, read};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// Reads a file. Returns the mesh of the file, and the text of the notes without file names.
fn found(content: impl AsRef<[u8]>) -> (Mesh, Vec<String>) {
    let folder = Folder::new();
    let mut loaded = read(&folder.with("a.obj", content)).unwrap();
    let notes = loaded
        .notes
        .iter()
        .map(|note| format!("{} {}", note.count, note.what));
    let notes = notes.collect();
    let mesh = loaded.objects.remove(0).as_mesh().unwrap().as_ref().clone();
    (mesh, notes)
}

fn refused(content: impl AsRef<[u8]>) -> String {
    let folder = Folder::new();
    let path = folder.with("a.obj", content);
    let message = read(&path).unwrap_err().to_string();
    message.replace(&path.display().to_string(), "a.obj")
}

#[test]
fn utf_16_and_utf_32_are_refused_by_name() {
    let text = format!("{TRIANGLE}f 1 2 3\n");
    let wide = |bytes: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
    let expected = "a.obj:1:1: expected text in UTF-8 or ASCII, found UTF-16";
    for (mark, body) in [
        (&b"\xff\xfe"[..], wide(u16::to_le_bytes)),
        (b"\xfe\xff", wide(u16::to_be_bytes)),
        (b"", wide(u16::to_le_bytes)),
        (b"", wide(u16::to_be_bytes)),
    ] {
        assert_eq!(refused([mark, &body].concat()), expected);
    }
}

#[test]
fn non_finite_normals_and_texture_coordinates_become_zero() {
    for nan in ["nan", "-1.#IND", "1.#QNAN00", "-nan(ind)", "1.#INF", "-inf"] {
        let text = format!("{TRIANGLE}vt {nan} 1\nvn 0 {nan} 1\nf 1/1/1 2/1/1 3/1/1\n");
        let (mesh, notes) = found(text);
        assert_eq!(mesh.get(UV).unwrap()[0], DVec2::Y);
        assert_eq!(mesh.get(VERTEX_NORMAL).unwrap()[0], DVec3::Z);
        assert_eq!(
            notes,
            ["2 non-finite numbers in texture coordinates and normals: set to 0"]
        );
        let message = refused(format!("{TRIANGLE}v 0 {nan} 0\nf 1 2 3\n"));
        assert_eq!(
            message,
            format!("a.obj:4:5: expected a finite number, found `{nan}`")
        );
    }
}

#[test]
fn decimal_commas_are_refused_with_a_hint() {
    assert_eq!(
        refused("v 0 0,5 0\n"),
        "a.obj:1:5: expected a number, found `0,5` (use a decimal point instead of a comma)"
    );
}

#[test]
fn numbers_are_read_in_many_forms() {
    let (mesh, notes) = found("v +1.0 1. .5\nv\t1e5 1E+05\t1d5 \nv -.5e-1 1D+00 00\nf 1 2 3");
    let expected = [[1.0, 1.0, 0.5], [1e5; 3], [-0.05, 1.0, 0.0]];
    assert_eq!(mesh.positions(), expected.map(DVec3::from_array));
    assert!(notes.is_empty());
}

#[test]
fn colors_of_zbrush_become_vertex_colors() {
    let text = format!(
        "#Auto scale\n{TRIANGLE}v 1 1 1\n#MRGB ffff0000ff00ff00\r\n  #MRGB ff0000ff00ffffff\n# End\nf 1 2 3\n"
    );
    let (mesh, notes) = found(text);
    let opaque = |r, g, b| DVec4::new(r, g, b, 1.0);
    let expected = [
        opaque(1.0, 0.0, 0.0),
        opaque(0.0, 1.0, 0.0),
        opaque(0.0, 0.0, 1.0),
        DVec4::ONE,
    ];
    assert_eq!(mesh.get(COLOR), Some(&expected[..]));
    assert_eq!(notes, ["1 masks of `#MRGB` comments left out"]);
    let (mesh, notes) = found(format!("{TRIANGLE}#MRGB ffff0000\nf 1 2 3\n"));
    assert_eq!(mesh.get(COLOR), None);
    assert_eq!(
        notes,
        [
            "1 colors of `#MRGB` comments left out: their number differs from the number of vertices, or `v` statements also define colors"
        ]
    );
}

#[test]
fn corners_can_end_with_slashes() {
    for corners in ["1/ 2/ 3/", "1// 2// 3//", "1/1/ 2/1/ 3/1/", "1 2 3\t "] {
        let (mesh, _) = found(format!("{TRIANGLE}vt 0 0 0\nf {corners}\n"));
        assert_eq!(mesh.n_faces(), 1, "{corners}");
    }
}

#[test]
fn files_of_common_programs_are_read() {
    let head = "# 3ds Max Wavefront OBJ Exporter v0.97b - (c)2007 guruware\r\n\r\n#\r\n# object Box001\r\n#\r\n\r\n";
    let body = "v  0.0000 0.0000 0.0000\r\nv  1.0000 0.0000 0.0000\r\nv  0.0000 1.0000 0.0000\r\n# 3 vertices\r\n\r\n\
                vn 0.0000 0.0000 1.0000\r\nvt 0.0000 0.0000 0.0000\r\n\r\ng Box001\r\nusemtl wire_086086086\r\ns 1\r\n\
                f 1/1/1 2/1/1 3/1/1 \r\n# 1 polygons\r\n\r\n";
    let (mesh, notes) = found(format!("{head}{body}"));
    assert_eq!(mesh.tag(Domain::Face, "Box001"), Some(&[true][..]));
    assert_eq!(
        notes,
        ["1 material `wire_086086086` not found in any library: replaced by a white material"]
    );

    let maya =
        "# This file uses centimeters as units for non-parametric coordinates.\n\ng default\n";
    let rest = "vt 0.000000 0.000000\nvn 0.0 0.0 1.0\ns off\ng pCube1\nusemtl\nf 1/1/1 2/1/1 3/1/1\ng\nf 1/1/1 3/1/1 2/1/1\n";
    let (mesh, notes) = found(format!("{maya}{TRIANGLE}{rest}"));
    assert_eq!(mesh.tag(Domain::Face, "pCube1"), Some(&[true, false][..]));
    assert_eq!(notes, ["1 groups and objects left out: they have no faces"]);

    let colored = "vn 0 0 1\nv 0 0 0 1.000000 0.501961 0.000000\nvn 0 0 1\nv 1 0 0 1 1 1\nvn 0 0 1\nv 0 1 0 0 0 0\n";
    let (mesh, notes) = found(format!(
        "####\n# OBJ File Generated by Meshlab\n####\n{colored}f 1//1 2//2 3//3\n"
    ));
    assert_eq!(
        mesh.get(COLOR).unwrap()[0],
        DVec4::new(1.0, 0.501_961, 0.0, 1.0)
    );
    assert!(notes.is_empty());
}

#[test]
fn zero_bytes_are_reported() {
    let (mesh, notes) = found(format!("{TRIANGLE}f 1 2 3\n\0\0\0\0"));
    assert_eq!(mesh.n_faces(), 1);
    assert_eq!(notes.len(), 1);
    let message = refused(format!("{TRIANGLE}f 1 2 3\0\n"));
    assert!(
        message.starts_with("a.obj:4:7: expected a corner"),
        "{message}"
    );
}
