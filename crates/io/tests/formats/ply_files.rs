//! PLY files, against a slow and simple writer of this file and against laws.

use glam::{DVec2, DVec3, DVec4};
use mesh::{
    COLOR, CORNER, CORNER_NORMAL, CREASE, Column, Domain, MATERIAL, Mesh, Rule, TANGENT, UV,
    VERTEX_NORMAL, Values, shapes,
};
use mesh_io::{NoteKind, PeekGeometry, Polygons, ReadOptions, WriteOptions};
use proptest::prelude::*;
use scene::{Material, Object};

use crate::{Folder, assert_same, only, polygons, read, scene, tag, write};

fn polygons_of(name: &str, bytes: impl AsRef<[u8]>) -> Polygons {
    let folder = Folder::new();
    let path = folder.with(name, bytes);
    let mut all = mesh_io::read_polygons(&path, &ReadOptions::default()).unwrap();
    all.remove(0).1
}

fn put(mesh: &mut Mesh, domain: Domain, name: &str, rule: Rule, values: Values) {
    let name = name.to_owned();
    mesh.insert_column(domain, Column { name, rule, values });
}

/// For each corner of a face a value made of its half-edge's number, zero elsewhere.
fn on_corners<T: Default + Clone>(mesh: &Mesh, value: impl Fn(f64) -> T) -> Vec<T> {
    let mut all = vec![T::default(); mesh.n_half_edges()];
    for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
        all[h.index()] = value(1.0 + h.index() as f64);
    }
    all
}

/// A mesh with polygons, an isolated vertex and attributes of every domain and type.
fn rich() -> Mesh {
    let mut positions = shapes::cube().positions().to_vec();
    positions.push(DVec3::new(0.1, -1e-9, 1e300));
    positions[0].x = -0.0;
    let faces: Vec<Vec<u32>> = vec![
        vec![0, 3, 2, 1],
        vec![4, 5, 6],
        vec![4, 6, 7],
        vec![0, 1, 5, 4],
        vec![1, 2, 6, 5],
        vec![2, 3, 7, 6],
    ];
    let (mut mesh, _) = Mesh::from_polygons(positions, &faces).unwrap();
    let vertices = |value: &dyn Fn(f64) -> f64| (0..9).map(|i| value(f64::from(i))).collect();
    mesh.set(VERTEX_NORMAL, vec![DVec3::new(0.1, 0.2, -0.3); 9]);
    mesh.set(TANGENT, vec![DVec3::new(0.5, 1.0, -0.3); 9]);
    mesh.set(
        COLOR,
        (0..9).map(|i| DVec4::splat(f64::from(i) / 255.0)).collect(),
    );
    mesh.set(CORNER, vertices(&|i| i / 3.0));
    let float = |rule, values| (rule, Values::Float(values));
    for (name, (rule, values)) in [
        ("quality", float(Rule::Interpolate, vertices(&|i| i / 7.0))),
        ("x", float(Rule::Interpolate, vertices(&|i| i))),
        ("two words", float(Rule::Interpolate, vertices(&|i| -i))),
        ("two_words", float(Rule::Copy, vertices(&|i| -i))),
        ("", float(Rule::Drop, vertices(&|i| -0.0 * i))),
        ("label", (Rule::Copy, Values::Int((-4..5).collect()))),
        (
            "marked \"quoted\"\n",
            (
                Rule::Copy,
                Values::Tag((0..9).map(|i| i % 2 == 0).collect()),
            ),
        ),
        (
            "pair",
            (
                Rule::Interpolate,
                Values::Vec2(vec![DVec2::new(0.1, 0.7); 9]),
            ),
        ),
        (
            "four",
            (
                Rule::Copy,
                Values::Vec4(vec![DVec4::new(0.1, 0.2, 0.3, 0.4); 9]),
            ),
        ),
    ] {
        put(&mut mesh, Domain::Vertex, name, rule, values);
    }
    mesh.set(MATERIAL, vec![1, -1, 0, 1, -1, 2]);
    let colors = vec![DVec4::new(0.5, 0.25, 0.1, 0.5); 6];
    put(
        &mut mesh,
        Domain::Face,
        "color",
        Rule::Copy,
        Values::Vec4(colors),
    );
    let normals = vec![DVec3::new(0.6, 0.8, 0.0); 6];
    put(
        &mut mesh,
        Domain::Face,
        "normal",
        Rule::Normal,
        Values::Vec3(normals),
    );
    tag(
        &mut mesh,
        Domain::Face,
        "vertex_indices",
        vec![true, false, true, false, true, true],
    );
    let uvs = on_corners(&mesh, |x| DVec2::new(x / 3.0, x));
    mesh.set(UV, uvs);
    let normals = on_corners(&mesh, |x| DVec3::new(x, x / 7.0, 0.1));
    mesh.set(CORNER_NORMAL, normals);
    let ints = on_corners(&mesh, |x| if x > 5.0 { 3 } else { -1 });
    put(
        &mut mesh,
        Domain::Corner,
        "number",
        Rule::Copy,
        Values::Int(ints),
    );
    let tags = on_corners(&mesh, |x| x % 3.0 == 0.0);
    put(
        &mut mesh,
        Domain::Corner,
        "picked",
        Rule::Copy,
        Values::Tag(tags),
    );
    mesh
}

fn assert_round_trip(mesh: &Mesh) {
    let folder = Folder::new();
    let path = folder.path("it.ply");
    let report = write(&path, [Object::mesh("it", mesh.clone())]);
    assert_eq!(report.losses, []);
    let back = only(&path);
    assert_same(back.as_mesh().unwrap(), mesh);
    let again = folder.path("again.ply");
    write(&again, [back]);
    assert_eq!(
        std::fs::read(&path).unwrap(),
        std::fs::read(&again).unwrap()
    );
}

#[test]
fn a_mesh_with_everything_comes_back_the_same() {
    assert_round_trip(&rich());
}

#[test]
fn plain_shapes_come_back_the_same() {
    let points = Mesh::from_polygons(vec![DVec3::X, DVec3::Y], &[] as &[Vec<u32>])
        .unwrap()
        .0;
    let many_sided = shapes::cylinder(300, true);
    for mesh in [
        Mesh::default(),
        points,
        shapes::cube(),
        shapes::torus(9, 7, 3.0, 1.0),
        many_sided,
    ] {
        assert_round_trip(&mesh);
    }
}

#[test]
fn colors_are_bytes_floats_or_doubles_as_they_need() {
    for (color, form) in [
        (
            DVec4::new(1.0, 0.2, 7.0 / 255.0, 1.0),
            "property uchar blue\nelement",
        ),
        (
            DVec4::new(1.0, 0.2, 7.0 / 255.0, 0.0),
            "property uchar alpha",
        ),
        (
            DVec4::new(0.5, 0.25, 2.0, 1.0),
            "property float blue\nelement",
        ),
        (
            DVec4::new(0.1, 0.25, -0.0, 1.0),
            "property double blue\nelement",
        ),
    ] {
        let mut mesh = shapes::tetrahedron();
        mesh.set(COLOR, vec![color; 4]);
        assert_round_trip(&mesh);
        let folder = Folder::new();
        let path = folder.path("a.ply");
        write(&path, [Object::mesh("a", mesh)]);
        let bytes = std::fs::read(&path).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.contains(form), "{text}");
    }
}

#[test]
fn texture_coordinates_without_seams_belong_to_vertices() {
    let mut mesh = shapes::grid(3, 2);
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
        uvs[h.index()] = mesh.position(mesh.origin(h)).truncate();
    }
    mesh.set(UV, uvs);
    assert_round_trip(&mesh);
    let folder = Folder::new();
    let path = folder.path("a.ply");
    write(&path, [Object::mesh("a", mesh)]);
    let bytes = std::fs::read(&path).unwrap();
    assert!(String::from_utf8_lossy(&bytes).contains("property float t\n"));
}

#[test]
fn several_objects_become_one_with_tags() {
    let folder = Folder::new();
    let path = folder.path("both.ply");
    let mut ball = shapes::icosahedron();
    ball.set(MATERIAL, vec![0; 20]);
    let ball = Object {
        materials: vec![Material::new("gold")],
        ..Object::mesh("ball", ball)
    };
    let report = write(&path, [ball, Object::mesh("box", shapes::cube())]);
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|l| (l.attribute.as_str(), l.count))
        .collect();
    assert_eq!(lost, [("materials", 1), ("name", 2)]);
    let both = only(&path);
    let mesh = both.as_mesh().unwrap();
    assert_eq!((mesh.n_vertices(), mesh.n_faces()), (20, 26));
    assert_eq!(mesh.defects(), []);
    let marks = mesh.tag(Domain::Face, "o:ball").unwrap();
    assert_eq!(marks.iter().filter(|&&m| m).count(), 20);
    assert_eq!(
        mesh.tag(Domain::Face, "o:box")
            .unwrap()
            .iter()
            .filter(|&&m| m)
            .count(),
        6
    );
}

#[test]
fn what_a_file_does_not_hold_is_a_loss() {
    let folder = Folder::new();
    let mut mesh = shapes::cube();
    mesh.set(CREASE, vec![1.0; 12]);
    mesh.set(CORNER, vec![f64::NAN; 8]);
    let path = folder.path("a.ply");
    let report = write(&path, [Object::mesh("a", mesh)]);
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|l| (l.attribute.as_str(), l.count))
        .collect();
    assert_eq!(lost, [("crease", 12), ("corner", 8)]);
    let curve = bezier::Patch::new([[DVec3::ONE; 4]; 4]).unwrap();
    let patch = Object::new("p", scene::Geometry::Patches(vec![curve]));
    assert!(mesh_io::write(&path, &scene([patch]), &WriteOptions::default()).is_err());
}

#[test]
fn the_provenance_is_a_comment() {
    let folder = Folder::new();
    let path = folder.path("a.ply");
    let options = WriteOptions {
        provenance: Some("one\ntwo".into()),
    };
    mesh_io::write(&path, &scene([Object::mesh("a", shapes::cube())]), &options).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert!(String::from_utf8_lossy(&bytes).contains("comment one\ncomment two\n"));
    assert_eq!(polygons(only(&path).as_mesh().unwrap()).len(), 6);
}

// ---- Dialects ----------------------------------------------------------------------------------

#[test]
fn a_file_of_meshlab_is_read() {
    let text = "ply\nformat ascii 1.0\ncomment VCGLIB generated\ncomment TextureFile a.png\n\
        obj_info made by hand\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n\
        property float quality\nelement face 1\nproperty list uchar int vertex_indices\n\
        property list uchar float texcoord\nproperty int texnumber\nend_header\n\
        0 0 0 255 0 51 255 0.5 \n1 0 0 0 0 0 255 nan \n0 1 0 0 0 0 0 1e3 \n\
        3 0 1 2 6 0.1 0.2 0.3 0.4 0.5 0.6 0 \n";
    let folder = Folder::new();
    let loaded = read(&folder.with("a.ply", text)).unwrap();
    assert_eq!(loaded.notes.len(), 1);
    assert!(
        loaded.notes[0]
            .to_string()
            .contains("1 values of `quality`"),
        "{}",
        loaded.notes[0]
    );
    let mesh = loaded.objects[0].as_mesh().unwrap();
    assert_eq!(mesh.get(COLOR).unwrap()[0], DVec4::new(1.0, 0.0, 0.2, 1.0));
    let quality = &mesh
        .attributes()
        .column(Domain::Vertex, "quality")
        .unwrap()
        .values;
    assert_eq!(*quality, Values::Float(vec![0.5, 0.0, 1000.0]));
    let number = &mesh
        .attributes()
        .column(Domain::Face, "texnumber")
        .unwrap()
        .values;
    assert_eq!(*number, Values::Int(vec![0]));
    let uvs = mesh.get(UV).unwrap();
    let f = mesh.faces().next().unwrap();
    let of_face: Vec<_> = mesh.face_half_edges(f).map(|h| uvs[h.index()]).collect();
    assert!(of_face.contains(&DVec2::new(0.3, 0.4)), "{of_face:?}");
}

#[test]
fn unknown_elements_and_lists_are_counted() {
    let text = "ply\nformat ascii 1.0\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n\
        element vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
        property list uchar int near\nelement face 2\nproperty list uchar int vertex_index\n\
        element range_grid 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 1\n1 2\n\n0 0 0 0\n1 0 0 2 5 6\n0 1 0 1 7\n3 0 1 2\n2 0 1\n1 0\nand more\n";
    let folder = Folder::new();
    let loaded = read(&folder.with("a.ply", text)).unwrap();
    let notes: Vec<_> = loaded
        .notes
        .iter()
        .map(|n| (n.count, n.line, n.what.as_str()))
        .collect();
    assert_eq!(
        notes,
        [
            (1, Some(25), "lines behind the last element left out"),
            (2, Some(3), "rows of element `edge` left out"),
            (1, Some(13), "rows of element `range_grid` left out"),
            (3, Some(10), "lists `near` of element `vertex` left out"),
            (1, None, "faces with fewer than 3 corners left out"),
        ]
    );
    assert!(loaded.notes.iter().all(|n| n.kind == NoteKind::LeftOut));
    assert_eq!(polygons(loaded.objects[0].as_mesh().unwrap()), [[0, 1, 2]]);
}

#[test]
fn strips_become_triangles() {
    let mut file =
        b"ply\r\nformat binary_big_endian 1.0\r\nelement vertex 6\r\nproperty float x\r\n\
        property float y\r\nproperty float z\r\nelement tristrips 1\r\n\
        property list int int vertex_indices\r\nend_header\r\n"
            .to_vec();
    for i in 0..18_u8 {
        file.extend_from_slice(&f32::from(i).to_be_bytes());
    }
    let strip = [0, 1, 2, 3, 3, 4, -1, 3, 4, 5];
    file.extend_from_slice(&10_i32.to_be_bytes());
    file.extend(strip.iter().flat_map(|i: &i32| i.to_be_bytes()));
    let folder = Folder::new();
    let path = folder.with("a.ply", &file);
    let found = polygons_of("a.ply", &file);
    assert_eq!(found.corners, [0, 1, 2, 2, 1, 3, 3, 4, 5]);
    assert_eq!(found.offsets, [0, 3, 6, 9]);
    let notes: Vec<_> = read(&path)
        .unwrap()
        .notes
        .iter()
        .map(ToString::to_string)
        .collect();
    assert!(
        notes[0].ends_with("2 triangle strips became 3 triangles"),
        "{notes:?}"
    );
    let peek = mesh_io::peek(&path, &ReadOptions::default()).unwrap();
    let PeekGeometry::Mesh(mesh) = peek.objects[0].geometry else {
        panic!("a mesh");
    };
    assert_eq!((mesh.vertices, mesh.faces, mesh.corners), (6, 3, 9));
}

#[test]
fn old_macs_end_lines_with_a_return() {
    let text = "ply\rformat ascii 1.0\relement vertex 1\rproperty float x\rproperty float y\r\
        property float z\rend_header\r1 2 3";
    assert_eq!(
        polygons_of("a.ply", text).positions,
        [DVec3::new(1.0, 2.0, 3.0)]
    );
}

#[test]
fn large_whole_numbers_become_floats() {
    let text = |n: u64| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
             property float z\nproperty uint id\nend_header\n1 2 3 {n}\n"
        )
    };
    let id = |n| polygons_of("a.ply", text(n)).attributes.of(Domain::Vertex)[0].clone();
    assert_eq!(id(7).values, Values::Int(vec![7]));
    assert_eq!(id(4_000_000_000).values, Values::Float(vec![4e9]));
    assert_eq!(id(4_000_000_000).rule, Rule::Copy);
}

// ---- Against a simple writer -------------------------------------------------------------------

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

/// A value of a type as bytes or as a word; it is a small whole number, which every type holds.
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

/// The types of a list: of the count (whole numbers) and of the items.
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

/// A file with this layout, and what it holds.
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

/// The numbers of a column.
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
    let PeekGeometry::Mesh(mesh) = mesh_io::peek(&path, &ReadOptions::default())
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
