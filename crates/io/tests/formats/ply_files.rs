//! Tests of general properties of PLY files.

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{
    COLOR, CORNER_NORMAL, CREASE, Column, Domain, MATERIAL, Mesh, Rule, TANGENT, UV, VERTEX_NORMAL,
    VERTEX_SHARPNESS, Values,
};
use mesh_io::{Polygons, ReadOptions, WriteOptions};
use scene::{Material, Object};

use crate::{Folder, assert_same, only, polygons, scene, tag, write};

pub(crate) fn polygons_of(name: &str, bytes: impl AsRef<[u8]>) -> Polygons {
    let folder = Folder::new();
    let path = folder.with(name, bytes);
    let mut all = mesh_io::read_polygons(&store::Disk, &path, &ReadOptions::default()).unwrap();
    all.remove(0).1
}

fn put(mesh: &mut Mesh, domain: Domain, name: &str, rule: Rule, values: Values) {
    let name = name.to_owned();
    mesh.insert_column(domain, Column { name, rule, values });
}

/// Returns a value for each half-edge. If the half-edge has a face, its value is computed from its index. Otherwise, it
/// gets zero.
fn on_corners<T: Default + Clone>(mesh: &Mesh, value: impl Fn(f64) -> T) -> Vec<T> {
    let mut all = vec![T::default(); mesh.n_half_edges()];
    for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
        all[h.index()] = value(1.0 + h.index() as f64);
    }
    all
}

/// Returns a mesh with polygons, an isolated vertex and attributes of every domain and type.
pub(crate) fn rich() -> Mesh {
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
    mesh.set(VERTEX_SHARPNESS, vertices(&|i| i / 3.0));
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
fn a_mesh_with_everything_survives_a_round_trip() {
    assert_round_trip(&rich());
}

#[test]
fn shapes_survive_a_round_trip() {
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
fn colors_use_the_smallest_exact_type() {
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
fn texture_coordinates_without_seams_are_written_per_vertex() {
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
fn an_attribute_whose_type_differs_is_lost_under_the_name_of_its_object() {
    let folder = Folder::new();
    let ball = |name: &str, values: Values| {
        let mut mesh = shapes::icosahedron();
        put(&mut mesh, Domain::Face, "a", Rule::Copy, values);
        Object::mesh(name, mesh)
    };
    let objects = [
        ball("first", Values::Float(vec![1.0; 20])),
        ball("second", Values::Int(vec![1; 20])),
    ];
    let report = write(&folder.path("both.ply"), objects);
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|l| (l.object.as_str(), l.attribute.as_str(), l.count))
        .collect();
    assert_eq!(lost, [("first", "name", 2), ("second", "a", 20)]);
}

#[test]
fn content_that_ply_cannot_store_is_a_loss() {
    let folder = Folder::new();
    let mut mesh = shapes::cube();
    mesh.set(CREASE, vec![1.0; 12]);
    mesh.set(VERTEX_SHARPNESS, vec![f64::NAN; 8]);
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
    assert!(
        mesh_io::write(
            &store::Disk,
            &path,
            &scene([patch]),
            &WriteOptions::default()
        )
        .is_err()
    );
}

#[test]
fn the_provenance_is_a_comment() {
    let folder = Folder::new();
    let path = folder.path("a.ply");
    let options = WriteOptions {
        provenance: Some("one\ntwo".into()),
        ..WriteOptions::default()
    };
    mesh_io::write(
        &store::Disk,
        &path,
        &scene([Object::mesh("a", shapes::cube())]),
        &options,
    )
    .unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert!(String::from_utf8_lossy(&bytes).contains("comment one\ncomment two\n"));
    assert_eq!(polygons(only(&path).as_mesh().unwrap()).len(), 6);
}
