//! Tests of OBJ files with their material libraries.

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, CORNER_NORMAL, Domain, MATERIAL, Mesh, SMOOTHING, UV, VERTEX_NORMAL};
use mesh_io::{
    NonManifold, NoteKind, PeekGeometry, Policies, ReadError, ReadOptions, WriteOptions,
};
use scene::{AlphaMode, Geometry, Material, Object, Texture};

use crate::{Folder, assert_same, only, read, scene, tag, write};

/// Returns a mesh with all kinds of content that OBJ can store: polygons, an isolated vertex, seams, groups and
/// materials.
fn rich() -> Object {
    let mut positions = shapes::cube().positions().to_vec();
    positions.push(DVec3::new(0.1, -1e-9, 1e300));
    positions[0].x = -0.0;
    let mut faces: Vec<Vec<u32>> = vec![
        vec![0, 3, 2, 1],
        vec![4, 5, 6],
        vec![4, 6, 7],
        vec![0, 1, 5, 4],
        vec![1, 2, 6, 5],
    ];
    faces.push(vec![2, 3, 7, 6]);
    let (mut mesh, report) = Mesh::from_polygons(positions, &faces).unwrap();
    assert!(report.is_clean());
    let n = mesh.n_half_edges();
    let on_faces = |value: &dyn Fn(usize) -> DVec2| {
        let of = |h: usize| mesh.connectivity().face.get(h).and_then(|f| f.some());
        (0..n)
            .map(|h| of(h).map_or(DVec2::ZERO, |f| value(h) + f.index() as f64))
            .collect()
    };
    let uvs: Vec<DVec2> = on_faces(&|h| DVec2::new(0.1 * (h % 3) as f64, 1.0 / 3.0));
    let normals: Vec<DVec3> = uvs.iter().map(|uv| uv.extend(0.25)).collect();
    let colors = (0..9)
        .map(|i| DVec4::new(0.1 * f64::from(i), 0.5, 0.0, 1.0))
        .collect();
    mesh.set(UV, uvs);
    mesh.set(CORNER_NORMAL, normals);
    mesh.set(COLOR, colors);
    mesh.set(MATERIAL, vec![1, -1, 0, 1, -1, 2]);
    mesh.set(SMOOTHING, vec![0, 1, 1, 0, 2, 0]);
    tag(
        &mut mesh,
        Domain::Face,
        "side",
        vec![false, false, false, true, true, true],
    );
    tag(
        &mut mesh,
        Domain::Face,
        "late",
        vec![false, false, false, false, false, true],
    );
    tag(
        &mut mesh,
        Domain::Face,
        "o:lower half",
        vec![true, false, false, true, false, false],
    );
    tag(
        &mut mesh,
        Domain::Face,
        "o:upper half",
        vec![false, true, true, false, true, true],
    );
    let materials = vec![
        Material {
            base_color: [0.1, 0.2, 0.3, 0.4],
            alpha: AlphaMode::Blend,
            ..Material::new("glass")
        },
        Material {
            metallic: 1.0,
            roughness: 1.0 / 3.0,
            ..Material::new("brushed steel")
        },
        Material {
            base_color_texture: Some(Texture::file("a b.png")),
            ..Material::new("wood")
        },
    ];
    Object {
        materials,
        ..Object::mesh("rich", mesh)
    }
}

fn assert_round_trip(object: &Object) {
    let folder = Folder::new();
    let path = folder.path("it.obj");
    let report = write(&path, [object.clone()]);
    assert_eq!(report.losses, []);
    let back = only(&path);
    assert_same(back.as_mesh().unwrap(), object.as_mesh().unwrap());
    assert_eq!(back.materials, object.materials);
    assert_eq!(back.name, "it");
    // If the object that was read is written again, the two files have the same bytes.
    let again = folder.path("again/it.obj");
    std::fs::create_dir(folder.path("again")).unwrap();
    write(&again, [back]);
    assert_eq!(
        std::fs::read(&path).unwrap(),
        std::fs::read(&again).unwrap()
    );
}

#[test]
fn a_mesh_with_everything_survives_a_round_trip() {
    assert_round_trip(&rich());
}

#[test]
fn shapes_survive_a_round_trip() {
    for mesh in [
        shapes::cube(),
        shapes::grid(3, 2),
        shapes::torus(7, 5, 2.0, 0.5),
        shapes::cylinder(5, true),
        Mesh::default(),
    ] {
        assert_round_trip(&Object::mesh("it", mesh));
    }
}

#[test]
fn corner_normals_that_agree_become_vertex_normals() {
    let mut mesh = shapes::icosahedron();
    mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
    assert_round_trip(&Object::mesh("it", mesh));
}

#[test]
fn groups_and_objects_become_tags() {
    let folder = Folder::new();
    let path = folder.with(
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no left one\ng red big\nf 1 2 3\ng big\nf 1 3 4\no empty\n",
    );
    let loaded = read(&path).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    assert_eq!(mesh.tag(Domain::Face, "red"), Some(&[true, false][..]));
    assert_eq!(mesh.tag(Domain::Face, "big"), Some(&[true, true][..]));
    assert_eq!(
        mesh.tag(Domain::Face, "o:left one"),
        Some(&[true, true][..])
    );
    assert_eq!(mesh.attributes().of(Domain::Face).len(), 3);
    assert_eq!(loaded.notes.len(), 1, "{:?}", loaded.notes);
}

#[test]
fn an_object_tag_on_some_faces_only_is_a_group() {
    let mut mesh = shapes::grid(2, 1);
    tag(&mut mesh, Domain::Face, "o:half", vec![false, true]);
    assert_round_trip(&Object::mesh("it", mesh));
}

#[test]
fn several_objects_become_one_with_tags() {
    let folder = Folder::new();
    let path = folder.path("two.obj");
    let mut second = rich();
    second.name = "second one".into();
    let report = write(&path, [Object::mesh("first", shapes::cube()), second]);
    assert_eq!(report.files, [folder.path("two.mtl"), path.clone()]);

    let loaded = read(&path).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    assert_eq!((mesh.n_vertices(), mesh.n_faces()), (17, 12));
    let second = mesh.tag(Domain::Face, "o:second one").unwrap();
    assert_eq!(second.iter().filter(|&&is| is).count(), 6);
    assert!(mesh.defects().is_empty());
}

#[test]
fn files_with_lines_only_are_polylines_and_survive_a_round_trip() {
    let folder = Folder::new();
    let path = folder.path("lines.obj");
    let lines = vec![
        vec![DVec3::ZERO, DVec3::X, DVec3::ONE],
        vec![DVec3::Y, DVec3::Z],
    ];
    let geometry = Geometry::Polylines(lines);
    write(&path, [Object::new("lines", geometry.clone())]);
    assert_eq!(only(&path).geometry, geometry);

    let beside = folder.with("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\np 1\n");
    let loaded = read(&beside).unwrap();
    assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 1);
    assert_eq!(loaded.notes.len(), 2);
    assert!(
        loaded
            .notes
            .iter()
            .all(|note| note.kind == NoteKind::LeftOut)
    );
}

#[test]
fn an_edge_of_three_faces_is_split_with_a_note() {
    let folder = Folder::new();
    let text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\nf 1 1 2\n";
    let path = folder.with("fan.obj", text);
    let loaded = read(&path).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    assert!(mesh.defects().is_empty());
    assert_eq!((mesh.n_faces(), mesh.n_vertices()), (3, 7));
    let colors = mesh.get(COLOR).unwrap();
    assert_eq!(
        colors[5..].iter().map(|c| c.x + 2.0 * c.y).sum::<f64>(),
        3.0
    );
    assert_eq!(
        loaded
            .notes
            .iter()
            .map(|note| note.count)
            .collect::<Vec<_>>(),
        [1, 2, 1]
    );

    let strict = ReadOptions {
        policies: Policies {
            non_manifold: NonManifold::Refuse,
            ..Policies::default()
        },
        ..ReadOptions::default()
    };
    assert!(matches!(
        mesh_io::read(&store::Disk, &path, &strict),
        Err(ReadError::Mesh { .. })
    ));
}

#[test]
fn a_face_of_opposite_orientation_is_reversed_with_a_note() {
    let folder = Folder::new();
    let points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";
    let uvs = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 1\n";
    let faces = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 2/2 3/3 6/6 5/5\n";
    let path = folder.with("row.obj", format!("{points}{uvs}{faces}"));
    let loaded = read(&path).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    assert!(mesh.defects().is_empty());
    assert_eq!((mesh.n_faces(), mesh.n_vertices()), (3, 6));
    assert!(mesh.faces().all(|f| mesh.face_normal(f).z == 1.0));
    let [note] = &loaded.notes[..] else {
        panic!("expected one note, found {:?}", loaded.notes);
    };
    assert_eq!(
        note.to_string(),
        format!(
            "{}: 1 face reversed to agree with its neighbors (face 2)",
            path.display()
        )
    );
    // After the face is reversed, each corner still has the texture coordinates of its vertex.
    let uvs = mesh.get(UV).unwrap();
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        assert_eq!(uvs[h.index()], mesh.position(mesh.origin(h)).truncate());
    }
}

#[test]
fn missing_libraries_are_notes_and_libraries_outside_of_the_folder_are_errors() {
    let folder = Folder::new();
    let body = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    let missing = folder.with("a.obj", format!("mtllib no.mtl\n{body}"));
    let loaded = read(&missing).unwrap();
    assert_eq!(loaded.objects[0].materials, [Material::new("red")]);
    assert_eq!(loaded.notes[0].line, Some(1));
    assert_eq!(loaded.notes.len(), 2);

    folder.with("outside.mtl", "newmtl red\n");
    for name in [
        "../outside.mtl",
        "/etc/passwd",
        "x/../../outside.mtl",
        "C:\\a.mtl",
    ] {
        let path = folder.with("in/b.obj", format!("# one\nmtllib {name}\n{body}"));
        match read(&path) {
            Err(ReadError::Text {
                line: 2, message, ..
            }) => {
                assert!(message.contains(&name.replace('\\', "\\\\")), "{message}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

#[test]
fn libraries_can_have_blanks_in_their_names_and_be_in_subfolders() {
    let folder = Folder::new();
    folder.with("m/my colors.mtl", "newmtl red\nKd 1 0 0\n");
    folder.with("b.mtl", "newmtl blue\nKd 0 0 1\n");
    let body = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl blue\nf 1 2 3\n";
    let path = folder.with(
        "a.obj",
        format!("mtllib m\\my colors.mtl\nmtllib b.mtl b.mtl\n{body}"),
    );
    let loaded = read(&path).unwrap();
    let names: Vec<_> = loaded.objects[0]
        .materials
        .iter()
        .map(|m| m.name.as_str())
        .collect();
    assert_eq!(names, ["red", "blue"]);
    assert_eq!(
        loaded.objects[0].as_mesh().unwrap().get(MATERIAL),
        Some(&[1][..])
    );
}

#[test]
fn content_that_obj_cannot_store_is_a_loss_or_an_error() {
    let folder = Folder::new();
    let path = folder.path("a.obj");
    let mut mesh = shapes::square();
    mesh.set(mesh::CREASE, vec![1.0; 4]);
    mesh.set(COLOR, vec![DVec4::new(1.0, 1.0, 1.0, 0.5); 4]);
    mesh.set(UV, vec![DVec2::NAN; 8]);
    tag(&mut mesh, Domain::Vertex, "picked", vec![true; 4]);
    tag(&mut mesh, Domain::Face, "two words", vec![true]);
    tag(&mut mesh, Domain::Face, "none", vec![false]);
    let report = write(&path, [Object::mesh("a", mesh)]);
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|loss| loss.attribute.as_str())
        .collect();
    assert_eq!(
        lost,
        ["picked", "crease", "color", "uv", "none", "two words"]
    );
    let back = read(&path).unwrap();
    assert!(
        back.objects[0]
            .as_mesh()
            .unwrap()
            .tag(Domain::Face, "two_words")
            .is_some()
    );

    let patches = Object::new("p", Geometry::Patches(Vec::new()));
    let error = mesh_io::write(
        &store::Disk,
        &path,
        &scene([patches]),
        &WriteOptions::default(),
    )
    .unwrap_err();
    assert!(error.to_string().contains("object `p`"), "{error}");
}

#[test]
fn different_materials_with_the_same_name_are_renamed() {
    let folder = Folder::new();
    let path = folder.path("a.obj");
    let object = |name: &str, red: f64| {
        let mut mesh = shapes::square();
        mesh.set(MATERIAL, vec![0]);
        let material = Material {
            base_color: [red, 0.0, 0.0, 1.0],
            ..Material::new("paint")
        };
        Object {
            materials: vec![material],
            ..Object::mesh(name, mesh)
        }
    };
    let report = write(
        &path,
        [object("a", 1.0), object("b", 0.5), object("c", 1.0)],
    );
    assert_eq!(report.losses.len(), 1);
    let back = read(&path).unwrap().objects.remove(0);
    assert_eq!(back.materials.len(), 2);
    assert_eq!(back.as_mesh().unwrap().get(MATERIAL), Some(&[0, 1, 0][..]));
}

#[test]
fn the_provenance_is_a_comment() {
    let folder = Folder::new();
    let path = folder.path("a.obj");
    let options = WriteOptions {
        provenance: Some("one\ntwo".into()),
        ..WriteOptions::default()
    };
    mesh_io::write(&store::Disk, &path, &scene([rich()]), &options).unwrap();
    for name in ["a.obj", "a.mtl"] {
        let text = std::fs::read_to_string(folder.path(name)).unwrap();
        assert!(text.starts_with("# one\n# two\n"), "{text}");
    }
    read(&path).unwrap();
}

#[test]
fn a_mesh_with_dead_elements_is_written_without_them() {
    let folder = Folder::new();
    let path = folder.path("a.obj");
    let mut mesh = shapes::cube();
    let f = mesh.faces().next().unwrap();
    mesh.delete_face(f).unwrap();
    write(&path, [Object::mesh("a", mesh.clone())]);
    mesh.compact();
    assert_same(only(&path).as_mesh().unwrap(), &mesh);
}

#[test]
fn peeking_counts_what_reading_gives() {
    let folder = Folder::new();
    let path = folder.path("a.obj");
    write(&path, [rich()]);
    let peek = mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap();
    assert_eq!(peek.objects[0].name, "a");
    let PeekGeometry::Mesh(counts) = peek.objects[0].geometry else {
        panic!("{peek:?}")
    };
    assert_eq!((counts.vertices, counts.faces, counts.corners), (9, 6, 22));
    assert_eq!((counts.min_degree, counts.max_degree), (3, 4));
    assert!(counts.uvs && counts.normals && counts.colors && counts.materials);
}
