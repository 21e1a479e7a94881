//! Tests of PLY files as other programs write them.

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Domain, Rule, UV, Values};
use mesh_io::{NoteKind, PeekGeometry, ReadOptions};

use crate::ply_files::polygons_of;
use crate::{Folder, polygons, read};

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
    let notes: Vec<String> = loaded.notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes.len(), 2);
    let texture = "1 texture file of comments `TextureFile` left out";
    for expected in [texture, "1 non-finite value of `quality`"] {
        assert!(
            notes.iter().any(|note| note.contains(expected)),
            "{notes:?}"
        );
    }
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
            (1, Some(25), "lines left out after the last element"),
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
        notes[0].ends_with("2 triangle strips converted to 3 triangles"),
        "{notes:?}"
    );
    let peek = mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap();
    let PeekGeometry::Mesh(mesh) = peek.objects[0].geometry else {
        panic!("a mesh");
    };
    assert_eq!((mesh.vertices, mesh.faces, mesh.corners), (6, 3, 9));
}

#[test]
fn lines_can_end_in_a_carriage_return() {
    let text = "ply\rformat ascii 1.0\relement vertex 1\rproperty float x\rproperty float y\r\
        property float z\rend_header\r1 2 3";
    assert_eq!(
        polygons_of("a.ply", text).positions,
        [DVec3::new(1.0, 2.0, 3.0)]
    );
}

#[test]
fn large_integers_become_floats() {
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
