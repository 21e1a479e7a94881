//! Tests of STL files. Some tests compare the result of reading with the result of a simple reader in this file. Other
//! tests check general properties.

use geometry::shapes;
use glam::DVec3;
use mesh::{COLOR, Domain, Mesh};
use mesh_io::{NoteKind, PeekGeometry, Polygons, ReadError, ReadOptions, WriteOptions};
use proptest::prelude::*;
use scene::{Material, Object};

use crate::{Folder, polygons, read, scene, write};

fn found(bytes: impl AsRef<[u8]>) -> (Polygons, Vec<String>) {
    crate::found("a.stl", bytes)
}

#[track_caller]
fn assert_error(bytes: impl AsRef<[u8]>, expected: &str) {
    let folder = Folder::new();
    let path = folder.with("a.stl", bytes);
    let error = read(&path).unwrap_err();
    assert!(
        matches!(error, ReadError::Text { .. } | ReadError::Binary { .. }),
        "{error}"
    );
    assert!(
        error.to_string().contains(&format!("a.stl:{expected}")),
        "{error}"
    );
}

/// Returns a binary STL file with these facets. Each facet consists of a normal and three corners.
fn binary(facets: &[[[f32; 3]; 4]]) -> Vec<u8> {
    let mut out = b"solid from a program that says so anyway".to_vec();
    out.resize(80, b' ');
    out.extend_from_slice(&u32::try_from(facets.len()).unwrap().to_le_bytes());
    for facet in facets {
        out.extend(facet.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        out.extend_from_slice(&[0, 0]);
    }
    out
}

const UP: [f32; 3] = [0.0, 0.0, 1.0];
const FLAT: [[f32; 3]; 4] = [UP, [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const NEXT: [[f32; 3]; 4] = [UP, [1.0, 0.0, -0.0], [1.0, 1.0, 0.0], [-0.0, 1.0, 0.0]];

/// Reads the corners of all triangles directly from the bytes of a binary file.
fn naive(bytes: &[u8]) -> Vec<DVec3> {
    let mut corners = Vec::new();
    for facet in bytes[84..].chunks(50) {
        for corner in facet[12..48].chunks(12) {
            let number = |i: usize| {
                f64::from(f32::from_le_bytes(
                    corner[4 * i..4 * i + 4].try_into().unwrap(),
                ))
            };
            corners.push(DVec3::new(number(0), number(1), number(2)));
        }
    }
    corners
}

/// The positions of the corners of all faces.
fn corners(polygons: &Polygons) -> Vec<DVec3> {
    polygons
        .corners
        .iter()
        .map(|&v| polygons.positions[v as usize])
        .collect()
}

fn written(mesh: Mesh) -> Vec<u8> {
    let folder = Folder::new();
    let path = folder.path("a.stl");
    write(&path, [Object::mesh("a", mesh)]);
    std::fs::read(path).unwrap()
}

#[test]
fn the_size_determines_whether_a_file_is_binary() {
    let (polygons, notes) = found(binary(&[FLAT, NEXT]));
    assert_eq!(
        notes,
        ["6 corners merged into 4 vertices with distinct positions"]
    );
    assert_eq!(polygons.corners, [0, 1, 2, 1, 3, 2]);
    assert_eq!(polygons.offsets, [0, 3, 6]);
}

#[test]
fn triangles_survive_a_round_trip() {
    for mesh in [
        shapes::icosahedron(),
        shapes::fans(&shapes::cube()),
        shapes::fans(&shapes::torus(9, 7, 3.0, 1.0)),
        Mesh::default(),
    ] {
        let first = written(mesh.clone());
        let (polygons, _) = found(&first);
        let expected: Vec<DVec3> = mesh
            .faces()
            .flat_map(|f| mesh.face_vertices(f))
            .map(|v| mesh.position(v).as_vec3().as_dvec3())
            .collect();
        assert_eq!(corners(&polygons), expected);
        assert_eq!(corners(&polygons), naive(&first));
        assert_eq!(polygons.positions.len(), mesh.n_vertices());

        let folder = Folder::new();
        let loaded = read(&folder.with("a.stl", &first)).unwrap();
        let again = loaded.objects[0].as_mesh().unwrap();
        assert_eq!(written(Mesh::clone(again)), first);
    }
}

#[test]
fn text_and_binary_files_give_the_same_mesh() {
    let text = "solid a b\n  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n\
        vertex 0 1 0\n endloop\n endfacet\nFACET NORMAL 0 0 1 OUTER LOOP\nVERTEX 1 0 -0 VERTEX 1 1 0\r\n\
        VERTEX -0 1 0 ENDLOOP ENDFACET\nendsolid a b\n\n";
    let (of_text, notes) = found(text);
    assert_eq!(
        notes,
        ["6 corners merged into 4 vertices with distinct positions"]
    );
    assert_eq!(of_text, found(binary(&[FLAT, NEXT])).0);
}

#[test]
fn several_solids_become_tags() {
    let facet = |x: i32| {
        format!(
            "facet normal 0 0 0\nouter loop\nvertex {x} 0 0\nvertex {x} 1 0\nvertex {x} 0 1\nendloop\nendfacet\n"
        )
    };
    let text = format!(
        "solid left one\n{}endsolid left one\nsolid\nendsolid\nsolid right\n{}{}endsolid\nsolid left one\n{}endsolid",
        facet(0),
        facet(1),
        facet(2),
        facet(3)
    );
    let folder = Folder::new();
    let loaded = read(&folder.with("a.stl", text)).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    assert_eq!(
        mesh.tag(Domain::Face, "o:left one").unwrap(),
        [true, false, false, true]
    );
    assert_eq!(
        mesh.tag(Domain::Face, "o:right").unwrap(),
        [false, true, true, false]
    );
    assert!(
        loaded
            .notes
            .iter()
            .any(|n| n.what == "solids without facets left out")
    );
}

#[test]
fn normals_that_disagree_are_noted() {
    let turned = [[0.0, 0.0, -1.0], FLAT[1], FLAT[2], FLAT[3]];
    let tilted = [[1.0, 0.0, 1.0], FLAT[1], FLAT[2], FLAT[3]];
    let none = [[0.0; 3], FLAT[1], FLAT[2], FLAT[3]];
    let broken = [[f32::NAN; 3], FLAT[1], FLAT[2], FLAT[3]];
    let flat = [UP, FLAT[1], FLAT[1], FLAT[2]];
    let (_, notes) = found(binary(&[turned, turned, tilted, none, broken, flat, FLAT]));
    assert_eq!(
        notes[0],
        "2 facet normals recomputed from the corners because they point away from the front of the facet"
    );
    assert_eq!(
        notes[1],
        "1 facet normals recomputed from the corners because they are not perpendicular to the facet"
    );
}

#[test]
fn attribute_bytes_are_left_out() {
    let mut bytes = binary(&[FLAT, NEXT]);
    let end = bytes.len();
    bytes[end - 1] = 0x80;
    let folder = Folder::new();
    let loaded = read(&folder.with("a.stl", &bytes)).unwrap();
    assert_eq!(
        (loaded.notes[0].kind, loaded.notes[0].count),
        (NoteKind::LeftOut, 1)
    );
    assert!(loaded.notes[0].what.contains("attribute bytes"));
}

#[test]
fn bytes_after_the_last_facet_are_noted() {
    let mut bytes = binary(&[FLAT]);
    bytes[0] = b'S';
    bytes[83..84].copy_from_slice(&[0]);
    bytes.extend_from_slice(b"more");
    bytes[1] = 0;
    let (polygons, notes) = found(&bytes);
    assert_eq!(polygons.n_faces(), 1);
    assert_eq!(notes[0], "4 bytes left out after the last facet");
}

#[test]
fn degenerate_facets_are_kept() {
    let (polygons, _) = found(binary(&[[UP, [1.0; 3], [1.0; 3], [2.0; 3]]]));
    assert_eq!(polygons.corners, [0, 0, 1]);
}

#[test]
fn content_that_stl_cannot_store_is_a_loss() {
    let folder = Folder::new();
    let path = folder.path("a.stl");
    let mut mesh = shapes::cube();
    mesh.set(COLOR, vec![glam::DVec4::ONE; 8]);
    mesh.positions_mut()[3].x = 0.1;
    let object = Object {
        materials: vec![Material::new("gold")],
        ..Object::mesh("a", mesh)
    };
    let options = WriteOptions {
        provenance: Some("recipe 12ab".into()),
        ..WriteOptions::default()
    };
    let scene = scene([object, Object::mesh("b", shapes::tetrahedron())]);
    let report = mesh_io::write(&store::Disk, &path, &scene, &options).unwrap();
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|l| (l.attribute.as_str(), l.count))
        .collect();
    assert_eq!(
        lost,
        [
            ("materials", 1),
            ("name", 2),
            ("color", 12),
            ("position", 1),
            ("position", 4),
            ("polygon", 6)
        ]
    );
    let bytes = std::fs::read(&path).unwrap();
    let header = String::from_utf8_lossy(&bytes[..80]);
    assert!(
        header.starts_with("meshwright ") && header.contains("recipe 12ab"),
        "{header}"
    );
    assert_eq!(found(bytes).0.n_faces(), 16);
}

#[test]
fn written_normals_are_unit_vectors_and_match_the_corners() {
    let bytes = written(shapes::icosahedron());
    for facet in bytes[84..].chunks(50) {
        let number = |i: usize| f32::from_le_bytes(facet[4 * i..4 * i + 4].try_into().unwrap());
        let length: f32 = (0..3).map(|i| number(i) * number(i)).sum();
        assert!((length - 1.0).abs() < 1e-6);
    }
    assert_eq!(
        found(bytes).1,
        ["60 corners merged into 12 vertices with distinct positions"]
    );
}

#[test]
fn positions_outside_of_the_32_bit_range_are_refused() {
    let mut mesh = shapes::tetrahedron();
    mesh.positions_mut()[1].y = 1e300;
    let folder = Folder::new();
    let scene = scene([Object::mesh("a", mesh)]);
    let error = mesh_io::write(
        &store::Disk,
        &folder.path("a.stl"),
        &scene,
        &WriteOptions::default(),
    )
    .unwrap_err();
    assert!(
        error
            .to_string()
            .contains("exceeds the range of the 32-bit floats of STL"),
        "{error}"
    );
}

#[test]
fn a_peek_counts_what_reading_gives() {
    let folder = Folder::new();
    let text = "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid";
    for path in [
        folder.with("a.stl", text),
        folder.with("b.stl", binary(&[FLAT])),
    ] {
        let peek = mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap();
        let PeekGeometry::Mesh(mesh) = peek.objects[0].geometry else {
            panic!("a mesh");
        };
        assert_eq!((mesh.vertices, mesh.faces, mesh.corners), (3, 1, 3));
    }
}

// ---- Broken files ------------------------------------------------------------------------------

#[test]
fn errors_in_texts_name_the_expected_word() {
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    assert_error(
        "solid a\nfaset",
        "2:1: expected `facet` or `endsolid`, found `faset`",
    );
    assert_error(
        "solid a\n",
        "2:1: expected `facet` or `endsolid`, found nothing",
    );
    assert_error(
        format!("solid a\n{facet}endloop"),
        "6:1: expected `vertex`, found `endloop`",
    );
    assert_error(
        format!("solid a\n{facet}vertex 1 x 0"),
        "6:10: expected a number, found `x`",
    );
    assert_error(
        format!("solid a\n{facet}vertex 1 nan 0"),
        "6:10: expected a ",
    );
    assert_error(
        format!("solid a\n{facet}vertex 1 2 0\nvertex"),
        "7:1: expected `endloop`",
    );
    assert_error(
        "solid a\nendsolid a\nsolip",
        "3:1: expected `solid`, found `solip`",
    );
    assert_error(
        "solid a\nfacet normal 0 0 up",
        "2:18: expected a number, found `up`",
    );
}

#[test]
fn normals_of_a_text_can_be_nan() {
    let text = "solid\nfacet normal nan -nan inf outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid";
    assert_eq!(found(text).1.len(), 1);
}

#[test]
fn counts_that_the_file_cannot_hold_are_refused_at_once() {
    let mut bytes = binary(&[FLAT]);
    bytes[0] = 0;
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_error(
        &bytes,
        " byte 80: the file declares 4294967295 facets, which need 214748364834 bytes in total, but the file has only 134 bytes",
    );
    assert_error(
        b"",
        " byte 0: expected text that begins with `solid`, or a binary file of at least 84 bytes, found a file of 0 bytes",
    );
    assert_error(
        &binary(&[FLAT, NEXT])[..180],
        " byte 80: the file declares 2 facets, which need 184 bytes in total, but the file has only 180 bytes",
    );
}

#[test]
fn positions_must_be_finite() {
    let mut bytes = binary(&[FLAT, NEXT]);
    bytes[84 + 50 + 16..84 + 50 + 20].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert_error(&bytes, " byte 150: expected a finite number, found inf");
}

#[test]
fn many_facets_are_read_by_all_threads() {
    let mesh = shapes::fans(&shapes::torus(100, 60, 3.0, 1.0));
    let bytes = written(mesh.clone());
    let (polygons, _) = found(&bytes);
    assert_eq!(corners(&polygons), naive(&bytes));
    assert_eq!(polygons.positions.len(), mesh.n_vertices());
    let folder = Folder::new();
    let loaded = read(&folder.with("a.stl", bytes)).unwrap();
    assert_eq!(
        loaded.objects[0].as_mesh().unwrap().euler_characteristic(),
        0
    );
    assert_eq!(polygons_of(&mesh), 12_000);
}

fn polygons_of(mesh: &Mesh) -> usize {
    polygons(mesh).len()
}

fn whatever(bytes: &[u8]) {
    let folder = Folder::new();
    let path = folder.with("a.stl", bytes);
    let _ = read(&path);
    let _ = mesh_io::peek(&store::Disk, &path, &ReadOptions::default());
}

proptest! {
    #[test]
    fn random_bytes_do_not_panic(start in "(solid )?", body in prop::collection::vec(any::<u8>(), 0..300)) {
        let mut bytes = start.into_bytes();
        bytes.extend(body);
        whatever(&bytes);
    }

    #[test]
    fn random_facets_do_not_panic(body in prop::collection::vec(any::<u8>(), 0..8).prop_map(|b| b.repeat(50))) {
        let mut bytes = vec![0; 80];
        bytes.extend_from_slice(&u32::try_from(body.len() / 50).unwrap().to_le_bytes());
        bytes.extend(body);
        whatever(&bytes);
    }

    #[test]
    fn damaged_texts_do_not_panic(at in any::<prop::sample::Index>(), value in any::<u8>(), cut in any::<prop::sample::Index>()) {
        let mut text = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n".to_vec();
        let i = at.index(text.len());
        text[i] = value;
        whatever(&text);
        text.truncate(cut.index(text.len()));
        whatever(&text);
    }
}
