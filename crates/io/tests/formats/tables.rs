//! Tests of writing `.csv` and `.npz` files.

use std::collections::BTreeMap;

use geometry::shapes;
use glam::{DVec2, DVec3};
use mesh::{Column, Domain, Mesh, Rule, Values};
use mesh_io::{Rows, WriteOptions};
use scene::{Object, Scene};
use store::Disk;

use crate::{Folder, read, scene, write};

/// Returns a mesh of a square and a triangle that share an edge. The mesh has attributes.
fn sheet() -> Mesh {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.1]];
    let points = points.map(|[x, y]| DVec3::new(x, y, -0.5)).to_vec();
    let faces: [&[u32]; 2] = [&[0, 1, 2, 3], &[1, 4, 2]];
    let mut mesh = Mesh::from_polygons(points, &faces).unwrap().0;
    let mut insert = |domain, name: &str, values| {
        let (name, rule) = (name.to_owned(), Rule::Copy);
        mesh.insert_column(domain, Column { name, rule, values });
    };
    let wall = vec![0.1, f64::NAN, f64::NEG_INFINITY, 1e300, -0.0];
    insert(Domain::Vertex, "wall, \"thin\"", Values::Float(wall));
    insert(Domain::Vertex, "x", Values::Int(vec![1, 2, 3, 4, -5]));
    let flow = vec![DVec3::new(1.0, 2.0, 3.0); 2];
    insert(Domain::Face, "flow", Values::Vec3(flow));
    insert(Domain::Face, "a/b", Values::Tag(vec![true, false]));
    insert(Domain::Face, "a_b", Values::Tag(vec![false, true]));
    let n = mesh.half_edges().count();
    let uvs = (0..n).map(|i| DVec2::new(i as f64, 0.5)).collect();
    let (name, rule, values) = ("uv".to_owned(), Rule::Interpolate, Values::Vec2(uvs));
    mesh.insert_column(Domain::Corner, Column { name, rule, values });
    let n = mesh.n_edges();
    let (name, rule, values) = ("w".to_owned(), Rule::Copy, Values::Float(vec![2.0; n]));
    mesh.insert_column(Domain::Edge, Column { name, rule, values });
    mesh
}

/// Writes a mesh as a `.csv` file. Returns the text of the file and the names of the lost attributes.
fn csv(rows: Option<Rows>) -> (String, Vec<String>) {
    let folder = Folder::new();
    let path = folder.path("a.csv");
    let options = WriteOptions {
        rows,
        ..WriteOptions::default()
    };
    let scene = scene([Object::mesh("sheet", sheet())]);
    let report = mesh_io::write(&Disk, &path, &scene, &options).unwrap();
    let lost = report
        .losses
        .into_iter()
        .map(|loss| loss.attribute)
        .collect();
    (std::fs::read_to_string(path).unwrap(), lost)
}

#[test]
fn tables_have_a_row_for_each_vertex_face_or_corner() {
    let (text, lost) = csv(None);
    let expected = "vertex,x,y,z,\"wall, \"\"thin\"\"\",x (2)\n\
        0,0,0,-0.5,0.1,1\n1,1,0,-0.5,nan,2\n2,1,1,-0.5,-inf,3\n3,0,1,-0.5,1e300,4\n4,2,0.1,-0.5,-0,-5\n";
    assert_eq!(text, expected);
    assert_eq!(lost, ["uv", "w", "a/b", "a_b", "flow"]);
    let (text, lost) = csv(Some(Rows::Faces));
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("face,x,y,z,a/b,a_b,flow[0],flow[1],flow[2]")
    );
    assert_eq!(lines.next(), Some("0,0.5,0.5,-0.5,1,0,1,2,3"));
    assert_eq!(lines.count(), 1);
    assert_eq!(lost, ["wall, \"thin\"", "x", "uv", "w"]);
    let (text, _) = csv(Some(Rows::Corners));
    let mesh = sheet();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("face,vertex,x,y,z,uv[0],uv[1]"));
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            let (v, p) = (mesh.origin(h), mesh.position(mesh.origin(h)));
            let row = format!(
                "{},{},{},{},{},{},0.5",
                f.index(),
                v.index(),
                p.x,
                p.y,
                p.z,
                h.index()
            );
            assert_eq!(lines.next(), Some(&row[..]));
        }
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn rows_are_only_for_csv_files() {
    let folder = Folder::new();
    let options = WriteOptions {
        rows: Some(Rows::Faces),
        ..WriteOptions::default()
    };
    let scene = scene([Object::mesh("sheet", sheet())]);
    let refused = mesh_io::write(&Disk, &folder.path("a.npz"), &scene, &options);
    let message = refused.unwrap_err().to_string();
    assert!(message.ends_with("only .csv files have rows"), "{message}");
}

#[test]
fn tables_cannot_be_read() {
    let folder = Folder::new();
    for name in ["a.csv", "a.npz", "a.csv.gz"] {
        let message = read(&folder.with(name, "vertex,x,y,z\n"))
            .unwrap_err()
            .to_string();
        assert!(message.contains("one of .obj, .gltf"), "{message}");
        assert!(!message.contains(".csv,"), "{message}");
    }
}

#[test]
fn arrays_of_objects_follow_each_other_and_this_is_a_loss() {
    let folder = Folder::new();
    let objects = || ["a", "b"].map(|name| Object::mesh(name, shapes::tetrahedron()));
    let report = write(&folder.path("two.npz"), objects());
    assert_eq!(report.losses.len(), 1);
    assert_eq!(report.losses[0].attribute, "name");
    assert_eq!(arrays(&folder, "two.npz")["faces"].shape, [8, 3]);
    let nothing = write(
        &folder.path("none.npz"),
        [Object::mesh("none", Mesh::default())],
    );
    assert_eq!(nothing.losses, []);
    assert_eq!(arrays(&folder, "none.npz")["faces"].shape, [0, 3]);
}

#[test]
fn tables_of_several_objects_have_a_column_with_their_names() {
    let folder = Folder::new();
    let names = ["a", "b, c"];
    for (rows, header, n, last) in [
        (Rows::Vertices, "object,vertex,x,y,z", 4, "\"b, c\",3,"),
        (Rows::Faces, "object,face,x,y,z", 4, "\"b, c\",3,"),
        (Rows::Corners, "object,face,vertex,x,y,z", 12, "\"b, c\",3,"),
    ] {
        let options = WriteOptions {
            rows: Some(rows),
            ..WriteOptions::default()
        };
        let path = folder.path("two.csv");
        let objects = names.map(|name| Object::mesh(name, shapes::tetrahedron()));
        let report = mesh_io::write(&Disk, &path, &scene(objects), &options).unwrap();
        assert_eq!(report.losses, []);
        let text = std::fs::read_to_string(path).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!((lines[0], lines.len()), (header, 2 * n + 1));
        let of = |name: &str| {
            let rows = lines[1..].iter().filter_map(|line| line.strip_prefix(name));
            rows.map(str::to_owned).collect::<Vec<_>>()
        };
        // Both objects have equal meshes, so their rows differ only in the name of the object.
        assert_eq!(of("a,"), of("\"b, c\","));
        assert_eq!(of("a,").len(), n);
        assert!(lines[2 * n].starts_with(last), "{}", lines[2 * n]);
    }
}

/// An array of a `.npz` file.
struct Array {
    kind: String,
    shape: Vec<usize>,
    data: Vec<u8>,
}

impl Array {
    fn words<const N: usize>(&self) -> Vec<[u8; N]> {
        self.data
            .chunks(N)
            .map(|word| word.try_into().unwrap())
            .collect()
    }

    fn floats(&self) -> Vec<f64> {
        assert_eq!(self.kind, "<f8");
        self.words().into_iter().map(f64::from_le_bytes).collect()
    }

    fn wholes(&self) -> Vec<i64> {
        assert_eq!(self.kind, "<i8");
        self.words().into_iter().map(i64::from_le_bytes).collect()
    }
}

/// Reads the arrays of a `.npz` file, and checks that the central directory of the archive agrees with the headers of
/// its files.
fn arrays(folder: &Folder, name: &str) -> BTreeMap<String, Array> {
    let bytes = std::fs::read(folder.path(name)).unwrap();
    let short = |at: usize| usize::from(u16::from_le_bytes(bytes[at..at + 2].try_into().unwrap()));
    let long = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let end = bytes.len() - 22;
    assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
    let mut at = long(end + 16);
    assert_eq!(at + long(end + 12), end);
    let mut found = BTreeMap::new();
    for _ in 0..short(end + 10) {
        assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
        let (size, length, local) = (long(at + 20), short(at + 28), long(at + 42));
        assert_eq!(&bytes[local..local + 4], b"PK\x03\x04");
        assert_eq!(bytes[local + 4..local + 30], bytes[at + 6..at + 32]);
        let name = &bytes[at + 46..at + 46 + length];
        assert_eq!(&bytes[local + 30..local + 30 + length], name);
        let file = &bytes[local + 30 + length..][..size];
        let mut crc = flate2::Crc::new();
        crc.update(file);
        assert_eq!(crc.sum() as usize, long(at + 16));
        let name = String::from_utf8(name.to_vec()).unwrap();
        let name = name.strip_suffix(".npy").unwrap().to_owned();
        assert!(found.insert(name, array(file)).is_none());
        at += 46 + length;
    }
    assert_eq!(at, end);
    found
}

fn array(file: &[u8]) -> Array {
    assert_eq!(&file[..8], b"\x93NUMPY\x01\x00");
    let start = 10 + usize::from(u16::from_le_bytes([file[8], file[9]]));
    assert_eq!(start % 64, 0);
    let header = std::str::from_utf8(&file[10..start]).unwrap();
    let between = |a: &str, b: &str| {
        let rest = &header[header.find(a).unwrap() + a.len()..];
        rest[..rest.find(b).unwrap()].to_owned()
    };
    let sizes = between("'shape': (", ")");
    let sizes = sizes
        .split(',')
        .map(str::trim)
        .filter(|size| !size.is_empty());
    Array {
        kind: between("'descr': '", "'"),
        shape: sizes.map(|size| size.parse().unwrap()).collect(),
        data: file[start..].to_vec(),
    }
}

#[test]
fn arrays_have_all_values_bit_for_bit() {
    let folder = Folder::new();
    let mesh = sheet();
    let report = write(&folder.path("a.npz"), [Object::mesh("sheet", mesh.clone())]);
    assert_eq!(report.losses, []);
    let found = arrays(&folder, "a.npz");
    let names: Vec<&str> = found.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "corner/uv",
            "edge/w",
            "edges",
            "face/a_b",
            "face/a_b (2)",
            "face/flow",
            "faces",
            "offsets",
            "vertex/wall, \"thin\"",
            "vertex/x",
            "vertices"
        ]
    );
    assert_eq!(found["vertices"].shape, [5, 3]);
    let positions = mesh.positions().iter().flat_map(DVec3::to_array);
    assert_eq!(found["vertices"].floats(), positions.collect::<Vec<_>>());
    assert_eq!(found["faces"].wholes(), [0, 1, 2, 3, 1, 4, 2]);
    assert_eq!(found["offsets"].wholes(), [0, 4, 7]);
    assert_eq!(found["edges"].shape, [mesh.n_edges(), 2]);
    assert_eq!(found["face/flow"].shape, [2, 3]);
    assert_eq!(found["face/a_b"].kind, "|b1");
    assert_eq!(found["face/a_b"].data, [1, 0]);
    assert_eq!(found["face/a_b (2)"].data, [0, 1]);
    assert_eq!(found["vertex/x"].kind, "<i4");
    assert_eq!(found["corner/uv"].shape, [7, 2]);
    let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    let uvs = corners.flat_map(|h| [h.index() as f64, 0.5]);
    assert_eq!(found["corner/uv"].floats(), uvs.collect::<Vec<_>>());
    let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    let wall = &mesh
        .attributes()
        .column(Domain::Vertex, "wall, \"thin\"")
        .unwrap()
        .values;
    let Values::Float(wall) = wall else { panic!() };
    assert_eq!(
        bits(found["vertex/wall, \"thin\""].floats()),
        bits(wall.clone())
    );
}

#[test]
fn faces_with_equal_numbers_of_corners_are_a_matrix() {
    let folder = Folder::new();
    write(
        &folder.path("a.npz"),
        [Object::mesh("cube", shapes::cube())],
    );
    let found = arrays(&folder, "a.npz");
    assert_eq!(found["faces"].shape, [6, 4]);
    assert!(!found.contains_key("offsets") && !found.contains_key("edges"));
}

#[test]
fn other_geometry_is_refused() {
    let folder = Folder::new();
    let lines = scene::Geometry::Polylines(vec![vec![DVec3::ZERO, DVec3::X]]);
    let mut scene = Scene::new();
    scene.insert(Object::new("lines", lines)).unwrap();
    for name in ["a.csv", "a.npz"] {
        let refused = mesh_io::write(&Disk, &folder.path(name), &scene, &WriteOptions::default());
        assert!(refused.is_err());
    }
}
