//! Tests of OFF files. Some tests compare the result of reading with the expected result. Other tests check general
//! properties.

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Column, Domain, Mesh, Rule, UV, VERTEX_NORMAL, Values};
use mesh_io::{PeekGeometry, Polygons, ReadError, ReadOptions, WriteOptions};
use proptest::prelude::*;
use scene::Object;

use crate::{Folder, assert_same, only, read, scene, tag, write};

fn found(text: impl AsRef<[u8]>) -> (Polygons, Vec<String>) {
    crate::found("a.off", text)
}

fn plain(text: &str) -> Polygons {
    let (polygons, notes) = found(text);
    assert_eq!(notes, [] as [&str; 0], "{text}");
    polygons
}

#[track_caller]
fn assert_error(text: impl AsRef<[u8]>, expected: &str) {
    let folder = Folder::new();
    let error = read(&folder.with("a.off", text)).unwrap_err();
    assert!(matches!(error, ReadError::Text { .. }), "{error}");
    assert!(
        error.to_string().contains(&format!("a.off:{expected}")),
        "{error}"
    );
}

fn assert_round_trip(mesh: &Mesh, starts: &str) {
    let folder = Folder::new();
    let path = folder.path("it.off");
    let report = write(&path, [Object::mesh("it", mesh.clone())]);
    assert_eq!(report.losses, []);
    let back = only(&path);
    assert_same(back.as_mesh().unwrap(), mesh);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.starts_with(starts), "{text}");
    let again = folder.path("again.off");
    write(&again, [back]);
    assert_eq!(std::fs::read_to_string(&again).unwrap(), text);
}

fn with_faces(values: Values, name: &str) -> Mesh {
    let mut mesh = shapes::tetrahedron();
    let column = Column {
        name: name.to_owned(),
        rule: Rule::Copy,
        values,
    };
    mesh.insert_column(Domain::Face, column);
    mesh
}

#[test]
fn meshes_survive_a_round_trip() {
    let points = Mesh::from_polygons(vec![DVec3::X, DVec3::Y], &[] as &[Vec<u32>])
        .unwrap()
        .0;
    for mesh in [
        Mesh::default(),
        points,
        shapes::cube(),
        shapes::torus(9, 7, 3.0, 1.0),
        shapes::cylinder(30, true),
    ] {
        assert_round_trip(&mesh, "OFF\n");
    }
    let mut mesh = shapes::grid(3, 2);
    for p in mesh.positions_mut() {
        *p = DVec3::new(p.x / 3.0, -0.0, 1e300 * p.y);
    }
    mesh.set(VERTEX_NORMAL, vec![DVec3::new(0.1, 0.2, 0.3); 12]);
    assert_round_trip(&mesh, "NOFF\n");
    mesh.set(COLOR, vec![DVec4::new(0.1, 0.0, 1.0, -1e-9); 12]);
    assert_round_trip(&mesh, "CNOFF\n");
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
        uvs[h.index()] = mesh.position(mesh.origin(h)).truncate();
    }
    mesh.set(UV, uvs);
    assert_round_trip(&mesh, "STCNOFF\n");
}

#[test]
fn colors_survive_a_round_trip() {
    for color in [
        DVec4::new(1.0, 0.2, 7.0 / 255.0, 1.0),
        DVec4::new(1.0 / 255.0, 0.0, 1.0 / 255.0, 1.0 / 255.0),
        DVec4::new(1.0 / 255.0, 0.0, 2.0 / 255.0, 1.0 / 255.0),
        DVec4::ZERO,
        DVec4::ONE,
        DVec4::new(300.0, -2.0, 1.0, 0.0),
        DVec4::new(-0.0, 1e-300, 0.3, 1.0),
    ] {
        let mut mesh = shapes::tetrahedron();
        mesh.set(COLOR, vec![color; 4]);
        assert_round_trip(&mesh, "COFF\n");
        assert_round_trip(&with_faces(Values::Vec4(vec![color; 4]), "color"), "OFF\n");
    }
    assert_round_trip(
        &with_faces(Values::Int(vec![3, -1, 0, -7]), "color_index"),
        "OFF\n",
    );
}

#[test]
fn content_that_off_cannot_store_is_a_loss() {
    let folder = Folder::new();
    let path = folder.path("a.off");
    let mut mesh = shapes::tetrahedron();
    tag(&mut mesh, Domain::Face, "side", vec![true; 4]);
    let uvs = (0..12).map(|i| DVec2::splat(f64::from(i))).collect();
    mesh.set(UV, uvs);
    mesh.set(COLOR, vec![DVec4::splat(f64::NAN); 4]);
    let objects = [Object::mesh("a", mesh), Object::mesh("b", shapes::cube())];
    let options = WriteOptions {
        provenance: Some("by hand\nand feet".into()),
        ..WriteOptions::default()
    };
    let report = mesh_io::write(&store::Disk, &path, &scene(objects), &options).unwrap();
    let lost: Vec<_> = report.losses.iter().map(|l| l.attribute.as_str()).collect();
    assert_eq!(lost, ["name", "uv", "side", "color"]);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(
        text.starts_with("COFF\n# by hand\n# and feet\n12 10 18\n"),
        "{text}"
    );
    assert_eq!(found(text).0.n_faces(), 10);
}

#[test]
fn counts_are_after_the_keyword_or_on_the_next_line() {
    let rest = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let expected = plain(&format!("OFF\n3 1 3\n{rest}"));
    assert_eq!(expected.corners, [0, 1, 2]);
    for start in [
        "OFF 3 1 0\n",
        "OFF 3 1\n",
        "3 1 0\n",
        "\n# a comment\nOFF # another\n\n# more\n3 1 # and counts\n",
        "OFF\r\n3 1 0\r\n\r\n",
        "\u{feff}OFF\n3 1 0\n",
    ] {
        assert_eq!(plain(&format!("{start}{rest}")), expected, "{start}");
    }
}

#[test]
fn the_keyword_declares_the_attributes_of_vertices() {
    let faces = "3 0 1 2\n";
    let vertex = |rest: &str| format!("0 0 0 {rest}\n1 0 0 {rest}\n0 1 0 {rest}\n{faces}");
    let all = plain(&format!(
        "STCNOFF\n3 1 0\n{}",
        vertex("0 0 1  255 0 51  0.5 0.25")
    ));
    assert_eq!(
        all.attributes
            .column(Domain::Vertex, "normal")
            .unwrap()
            .values,
        Values::Vec3(vec![DVec3::Z; 3])
    );
    let color = DVec4::new(1.0, 0.0, 0.2, 1.0);
    assert_eq!(
        all.attributes
            .column(Domain::Vertex, "color")
            .unwrap()
            .values,
        Values::Vec4(vec![color; 3])
    );
    let uvs = Values::Vec2(vec![DVec2::new(0.5, 0.25); 3]);
    assert_eq!(
        all.attributes.column(Domain::Corner, "uv").unwrap().values,
        uvs
    );

    let colors = |text: &str| {
        let polygons = plain(&format!("COFF\n3 1 0\n{}", vertex(text)));
        let Values::Vec4(colors) = &polygons.attributes.of(Domain::Vertex)[0].values else {
            panic!("colors");
        };
        colors[0]
    };
    assert_eq!(colors("255 0 51 102"), DVec4::new(1.0, 0.0, 0.2, 0.4));
    assert_eq!(colors("0.5 1 0"), DVec4::new(0.5, 1.0, 0.0, 1.0));
    assert_eq!(colors("1 1 0 1"), DVec4::new(1.0, 1.0, 0.0, 1.0));
    assert_eq!(colors("2.0 1 0 1"), DVec4::new(2.0, 1.0, 0.0, 1.0));
}

#[test]
fn faces_can_have_colors() {
    let vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
    let text = format!(
        "OFF\n4 4 0\n{vertices}3 0 1 2\n3 0 1 3 255 0 0 # red\n3 1 2 3 0 255 0 51\n3 0 2 3 7\n"
    );
    let (polygons, notes) = found(&text);
    assert_eq!(
        notes[0],
        "2 faces without a color set to gray because other faces have colors"
    );
    let gray = DVec4::new(2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 1.0);
    let colors = vec![
        gray,
        DVec4::new(1.0, 0.0, 0.0, 1.0),
        DVec4::new(0.0, 1.0, 0.0, 0.2),
        gray,
    ];
    assert_eq!(
        polygons
            .attributes
            .column(Domain::Face, "color")
            .unwrap()
            .values,
        Values::Vec4(colors)
    );
    let indices = Values::Int(vec![-1, -1, -1, 7]);
    assert_eq!(
        polygons
            .attributes
            .column(Domain::Face, "color_index")
            .unwrap()
            .values,
        indices
    );
}

#[test]
fn content_left_out_is_counted() {
    let text = "OFF\n3 3 0\n0 0 0 255 0 0\n1 0 0\n0 1 0 1\n2 0 1 255 0 0\n3 0 1 2\n1 2\nand more\n\n# not this\nand more\n";
    assert_eq!(
        found(text).1,
        [
            "2 vertices with extra numbers: these numbers are left out, because the keyword in the first line does not declare them",
            "2 faces with fewer than 3 corners left out",
            "2 lines left out after the last face",
        ]
    );
}

#[test]
fn a_peek_counts_what_reading_gives() {
    let folder = Folder::new();
    let mut mesh = shapes::cylinder(5, true);
    mesh.set(COLOR, vec![DVec4::ONE; mesh.n_vertices()]);
    let path = folder.path("a.off");
    write(&path, [Object::mesh("a", mesh.clone())]);
    let peek = mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap();
    let PeekGeometry::Mesh(peek) = peek.objects[0].geometry else {
        panic!("a mesh");
    };
    assert_eq!(
        (peek.vertices, peek.faces),
        (mesh.n_vertices() as u64, mesh.n_faces() as u64)
    );
    assert_eq!((peek.corners, peek.min_degree, peek.max_degree), (30, 4, 5));
    assert!(peek.colors && !peek.normals && !peek.uvs);
}

// ---- Broken files ------------------------------------------------------------------------------

#[test]
fn unsupported_variants_of_off_are_refused() {
    assert_error(
        "4OFF\n1 0 0\n",
        "1:1: expected an OFF file with three coordinates for each vertex, found `4OFF`",
    );
    assert_error(
        "CnOFF\n3\n1 0 0\n",
        "1:1: expected an OFF file with three coordinates",
    );
    assert_error(
        "OFF BINARY\n",
        "1:5: expected an OFF file as text, found a binary OFF file",
    );
    assert_error(
        "XOFF\n",
        "1:1: expected `OFF` with `ST`, `C` or `N` before it, found `XOFF`",
    );
    assert_error("ply\n", "1:1: expected `OFF`, found `ply`");
    assert_error("", "1:1: expected `OFF`, found the end of the file");
}

#[test]
fn counts_must_be_integers_and_match_the_file() {
    assert_error(
        "OFF\n-3 1 0\n",
        "2:1: expected the number of vertices, found `-3`",
    );
    assert_error(
        "OFF\n3 many\n",
        "2:3: expected the number of faces, found `many`",
    );
    assert_error(
        "OFF\n3\n1\n",
        "2:2: expected the number of faces, found nothing",
    );
    assert_error(
        "OFF\n0 0 0 7\n",
        "2:7: expected the end of the line, found `7`",
    );
    assert_error(
        "OFF\n4000000000 1 0\n0 0 0\n",
        "3:1: the rest of the file is too short for 4000000000 vertices (bytes left: 6)",
    );
    assert_error(
        "OFF\n18446744073709551615 1 0\n",
        "3:1: the rest of the file is too short for 18446744073709551615 vertices",
    );
    assert_error(
        "OFF\n1 4000000000 0\n0 0 0\n",
        "4:1: the rest of the file is too short for 4000000000 faces (bytes left: 0)",
    );
}

#[test]
fn lines_must_have_the_numbers_that_the_header_declares() {
    let off = |vertices: &str, face: &str| format!("OFF\n3 1 0\n{vertices}{face}");
    let good = "0 0 0\n1 0 0\n0 1 0\n";
    assert_error(
        off("0 0 0\n1 0\n0 1 0\n", "3 0 1 2\n"),
        "4:4: expected a vertex with 3 numbers, found 2",
    );
    assert_error(
        off("0 0 0\n1 x 0\n0 1 0\n", "3 0 1 2\n"),
        "4:3: expected a number, found `x`",
    );
    assert_error(
        off("0 0 0\n1 nan 0\n0 1 0\n", "3 0 1 2\n"),
        "4:3: expected a ",
    );
    assert_error(
        off("0 0 0\n1 1e999 0\n0 1 0\n", "3 0 1 2\n"),
        "4:3: expected a finite number",
    );
    assert_error(
        off("0 0 0 # \n1 0.5555 0 # hello\n\n", ""),
        "6:1: expected 3 vertices, found 2",
    );
    assert_error(
        off(good, "3 0 1 3\n"),
        "6:7: expected a vertex index below 3, found `3`",
    );
    assert_error(
        off(good, "3 0 -1 2\n"),
        "6:5: expected a vertex index below 3, found `-1`",
    );
    assert_error(
        off(good, "3 0 1\n"),
        "6:6: expected a face with 3 corners, found 2",
    );
    assert_error(
        off(good, "-3 0 1\n"),
        "6:1: expected the number of corners of a face, found `-3`",
    );
    assert_error(
        off(good, "4000000000 0 1\n"),
        "6:1: expected the number of corners",
    );
    assert_error(
        off(good, "3 0 1 2 5 5\n"),
        "6:9: expected the end of the line, an index into a color map",
    );
    assert_error(
        off(good, "3 0 1 2 red\n"),
        "6:9: expected an index into a color map, found `red`",
    );
    assert_error(off(good, "\n\n"), "8:1: expected 1 faces, found 0");
    assert_error(
        "COFF\n1 0 0\n0 0 0 1.5 1.5\n",
        "3:14: expected a vertex with 6 numbers, found 5",
    );
}

proptest! {
    #[test]
    fn random_text_does_not_panic(text in "(ST)?C?N?(OFF)?[ \n]?[0-3]? [0-3] [0-9 .\n#-]{0,60}") {
        let folder = Folder::new();
        let path = folder.with("a.off", text);
        let _ = read(&path);
        let _ = mesh_io::peek(&store::Disk, &path, &ReadOptions::default());
    }

    #[test]
    fn random_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..100)) {
        let folder = Folder::new();
        let mut text = b"OFF 2 1\n".to_vec();
        text.extend(bytes);
        let path = folder.with("a.off", text);
        let _ = read(&path);
        let _ = mesh_io::peek(&store::Disk, &path, &ReadOptions::default());
    }
}
