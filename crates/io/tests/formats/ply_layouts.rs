//! Tests of PLY files with random layouts. A simple writer in this file generates the files.

use glam::DVec3;
use mesh::{Domain, Values};
use mesh_io::{PeekGeometry, Polygons, ReadOptions};
use proptest::prelude::*;
use scene::Object;

use crate::ply_files::{polygons_of, rich};
use crate::{Folder, write};

const TYPES: [&str; 16] = [
    "char", "uchar", "short", "ushort", "int", "uint", "float", "double", "int8", "uint8", "int16",
    "uint16", "int32", "uint32", "float32", "float64",
];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Encoding {
    Text,
    Little,
    Big,
}

/// Appends a value in this encoding, with the type `TYPES[kind]`. The value is a small integer, which every type can
/// store.
fn push(out: &mut Vec<u8>, encoding: Encoding, kind: usize, value: i64) {
    let bytes = match kind % 8 {
        0 | 1 => value.to_be_bytes()[7..].to_vec(),
        2 | 3 => value.to_be_bytes()[6..].to_vec(),
        4 | 5 => value.to_be_bytes()[4..].to_vec(),
        6 => (value as f32).to_be_bytes().to_vec(),
        _ => (value as f64).to_be_bytes().to_vec(),
    };
    match encoding {
        Encoding::Text => out.extend_from_slice(format!("{value} ").as_bytes()),
        Encoding::Little => out.extend(bytes.iter().rev()),
        Encoding::Big => out.extend(bytes),
    }
}

/// The types of a list: first the type of the number of items (an integer type), then the type of the items.
type List = (usize, usize);

#[derive(Clone, Debug)]
struct Layout {
    encoding: Encoding,
    coordinates: [usize; 3],
    before: Option<List>,
    extra: usize,
    faces: List,
    behind: Option<usize>,
    faces_first: bool,
    even: bool,
}

fn layout() -> impl Strategy<Value = Layout> {
    let encodings = [Encoding::Text, Encoding::Little, Encoding::Big];
    let list = || (0..6_usize, 0..16_usize);
    (
        prop::sample::select(encodings.to_vec()),
        prop::array::uniform3(0..16_usize),
        prop::option::of(list()),
        0..16_usize,
        (0..6_usize, 0..6_usize),
        prop::option::of(0..16_usize),
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(
            |(encoding, coordinates, before, extra, faces, behind, faces_first, even)| Layout {
                encoding,
                coordinates,
                before,
                extra,
                faces,
                behind,
                faces_first,
                even,
            },
        )
}

/// Returns a file with this layout, and its expected content.
fn file(layout: &Layout, n: u32, values: &[i8]) -> (Vec<u8>, Polygons, Vec<f64>, Vec<f64>) {
    let encoding = layout.encoding;
    let mut next = values
        .iter()
        .cycle()
        .map(|&x| i64::from(x.unsigned_abs() % 100));
    let mut next = || next.next().unwrap_or(0);
    let format = match encoding {
        Encoding::Text => "ascii",
        Encoding::Little => "binary_little_endian",
        Encoding::Big => "binary_big_endian",
    };
    let list = |(count, item): List, name: &str| {
        format!("property list {} {} {name}\n", TYPES[count], TYPES[item])
    };
    let mut vertex_header = format!("element vertex {n}\n");
    vertex_header += &layout.before.map_or(String::new(), |l| list(l, "before"));
    let [x, y, z] = layout.coordinates.map(|t| TYPES[t]);
    vertex_header += &format!("property {y} y\nproperty {} extra\n", TYPES[layout.extra]);
    vertex_header += &format!("property {z} z\nproperty {x} x\n");
    let mut face_header = format!("element face {n}\n") + &list(layout.faces, "vertex_indices");
    face_header += &layout
        .behind
        .map_or(String::new(), |t| format!("property {} behind\n", TYPES[t]));
    let mut expected = Polygons::default();
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let (mut extras, mut behinds) = (Vec::new(), Vec::new());
    let end = |out: &mut Vec<u8>| out.extend((encoding == Encoding::Text).then_some(b'\n'));
    for _ in 0..n {
        if let Some((count, item)) = layout.before {
            let length = if layout.even { 2 } else { next() % 4 };
            push(&mut vertices, encoding, count, length);
            for _ in 0..length {
                push(&mut vertices, encoding, item, next());
            }
        }
        let position = [next(), next(), next()];
        let extra = next();
        push(&mut vertices, encoding, layout.coordinates[1], position[1]);
        push(&mut vertices, encoding, layout.extra, extra);
        push(&mut vertices, encoding, layout.coordinates[2], position[2]);
        push(&mut vertices, encoding, layout.coordinates[0], position[0]);
        end(&mut vertices);
        expected
            .positions
            .push(DVec3::from_array(position.map(|x| x as f64)));
        extras.push(extra as f64);
    }
    for _ in 0..n {
        let degree = if layout.even { 3 } else { 3 + next() % 4 };
        push(&mut faces, encoding, layout.faces.0, degree);
        for _ in 0..degree {
            let v = next() % i64::from(n);
            push(&mut faces, encoding, layout.faces.1, v);
            expected.corners.push(u32::try_from(v).unwrap());
        }
        let n_corners = u32::try_from(expected.corners.len());
        expected.offsets.push(n_corners.unwrap());
        if let Some(behind) = layout.behind {
            let value = next();
            push(&mut faces, encoding, behind, value);
            behinds.push(value as f64);
        }
        end(&mut faces);
    }
    let header = format!("ply\nformat {format} 1.0\n");
    let mut out = header.into_bytes();
    let parts = [(vertex_header, vertices), (face_header, faces)];
    let order = if layout.faces_first { [1, 0] } else { [0, 1] };
    for i in order {
        out.extend_from_slice(parts[i].0.as_bytes());
    }
    out.extend_from_slice(b"end_header\n");
    for i in order {
        out.extend_from_slice(&parts[i].1);
    }
    (out, expected, extras, behinds)
}

/// The numbers of a column, as floats.
fn whole(polygons: &Polygons, domain: Domain, name: &str) -> Vec<f64> {
    match &polygons.attributes.column(domain, name).unwrap().values {
        Values::Int(values) => values.iter().map(|&x| f64::from(x)).collect(),
        Values::Float(values) => values.clone(),
        other => panic!("{other:?}"),
    }
}

proptest! {
    #[test]
    fn every_layout_is_read(
        layout in layout(),
        n in 1..40_u32,
        values in prop::collection::vec(any::<i8>(), 1..50),
    ) {
        let (bytes, expected, extras, behinds) = file(&layout, n, &values);
        let found = polygons_of("a.ply", &bytes);
        prop_assert_eq!(&found.positions, &expected.positions);
        prop_assert_eq!(&found.offsets, &expected.offsets);
        prop_assert_eq!(&found.corners, &expected.corners);
        prop_assert_eq!(whole(&found, Domain::Vertex, "extra"), extras);
        if layout.behind.is_some() {
            prop_assert_eq!(whole(&found, Domain::Face, "behind"), behinds);
        }
    }
}

#[test]
fn many_rows_are_read_by_all_threads() {
    for encoding in [Encoding::Text, Encoding::Little, Encoding::Big] {
        for even in [true, false] {
            let layout = Layout {
                encoding,
                coordinates: [6, 6, 6],
                before: None,
                extra: 1,
                faces: (1, 4),
                behind: Some(6),
                faces_first: false,
                even,
            };
            let values: Vec<i8> = (0..101).collect();
            let (bytes, expected, extras, behinds) = file(&layout, 20_000, &values);
            let found = polygons_of("a.ply", &bytes);
            assert_eq!(found.positions, expected.positions);
            assert_eq!(
                (&found.offsets, &found.corners),
                (&expected.offsets, &expected.corners)
            );
            assert_eq!(whole(&found, Domain::Vertex, "extra"), extras);
            assert_eq!(whole(&found, Domain::Face, "behind"), behinds);
        }
    }
}

#[test]
fn a_peek_counts_what_reading_gives() {
    let folder = Folder::new();
    let path = folder.path("a.ply");
    write(&path, [Object::mesh("a", rich())]);
    let PeekGeometry::Mesh(mesh) = mesh_io::peek(&store::Disk, &path, &ReadOptions::default())
        .unwrap()
        .objects[0]
        .geometry
    else {
        panic!("a mesh");
    };
    assert_eq!((mesh.vertices, mesh.faces, mesh.corners), (9, 6, 22));
    assert_eq!((mesh.min_degree, mesh.max_degree), (3, 4));
    assert!(mesh.uvs && mesh.normals && mesh.colors && mesh.materials);
}
