//! Tests with scenes that differ in one property at a time.

use geometry::shapes;
use mesh::{DVec2, DVec3, Domain, Mesh, UV, VertexId};
use scene::Material;

use super::*;

fn scene(name: &str, mesh: Mesh) -> Scene {
    with(Object::mesh(name, mesh))
}

fn with(object: Object) -> Scene {
    let mut scene = Scene::new();
    scene.insert(object).unwrap();
    scene
}

fn mesh_difference(a: Mesh, b: Mesh) -> MeshDifference {
    let difference = Difference::between(&scene("a", a), &scene("a", b));
    assert!(!difference.identical);
    *difference.objects[0].mesh.clone().unwrap()
}

#[test]
fn the_name_of_the_only_object_does_not_matter() {
    let difference = Difference::between(&scene("a", shapes::cube()), &scene("b", shapes::cube()));
    assert!(difference.identical && difference.is_within(0.0));
    assert_eq!(difference.objects[0].names, ["a", "b"]);
    let mesh = difference.objects[0].mesh.as_ref().unwrap();
    assert_eq!(mesh.distance, None);
    assert_eq!((mesh.connectivity, mesh.moved), (Connectivity::Same, None));
}

#[test]
fn objects_are_matched_by_name_and_the_others_are_listed() {
    let mut first = scene("a", shapes::cube());
    first.insert(Object::mesh("x", shapes::cube())).unwrap();
    first.insert(Object::mesh("y", shapes::cube())).unwrap();
    let mut second = scene("z", shapes::cube());
    second.insert(Object::mesh("a", shapes::cube())).unwrap();
    let difference = Difference::between(&first, &second);
    assert_eq!(
        (difference.only_first, difference.only_second),
        (vec!["x".to_owned(), "y".to_owned()], vec!["z".to_owned()],)
    );
    assert!(!difference.identical && difference.objects[0].identical);
}

#[test]
fn a_moved_vertex_is_reported_and_allowed_within_a_tolerance() {
    let mut moved = shapes::cube();
    moved.positions_mut()[3].z += 0.25;
    let difference = mesh_difference(shapes::cube(), moved);
    let expected = Moved {
        count: 1,
        vertex: VertexId::new(3),
        by: 0.25,
    };
    assert_eq!(difference.moved, Some(expected));
    assert!(difference.is_within(0.25) && !difference.is_within(0.24));
    let distance = difference.distance.unwrap();
    assert!(distance.largest() > 0.0 && distance.at_most() <= 0.250_001);
}

#[test]
fn different_faces_are_a_different_connectivity() {
    let difference = mesh_difference(shapes::cube(), shapes::fans(&shapes::cube()));
    assert_eq!(difference.connectivity, Connectivity::Different);
    assert!(!difference.is_within(1e9));
    assert!(difference.distance.unwrap().at_most() < 1e-14);
    let counts = difference.counts.map(|c| (c.vertices, c.edges, c.faces));
    assert_eq!(counts, [(8, 12, 6), (8, 18, 12)]);
}

#[test]
fn a_different_order_of_vertices_is_reported() {
    let cube = shapes::cube();
    let number = |v: VertexId| u32::try_from(7 - v.index()).unwrap();
    let positions: Vec<DVec3> = (0..8).rev().map(|i| cube.positions()[i]).collect();
    let polygons: Vec<Vec<u32>> = cube
        .faces()
        .map(|f| cube.face_vertices(f).map(number).collect())
        .collect();
    let polygons: Vec<&[u32]> = polygons.iter().map(Vec::as_slice).collect();
    let reordered = Mesh::from_polygons(positions, &polygons).unwrap().0;
    let difference = mesh_difference(cube, reordered);
    assert_eq!(difference.connectivity, Connectivity::Reordered);
}

#[test]
fn attributes_are_compared_value_by_value() {
    let painted = |x: f64| {
        let mut mesh = shapes::cube();
        let mut values = vec![DVec2::ZERO; mesh.domain_len(Domain::Corner)];
        values[7] = DVec2::new(x, 0.5);
        mesh.set(UV, values);
        mesh
    };
    let difference = mesh_difference(painted(0.5), painted(0.75));
    let [uv] = &difference.attributes[..] else {
        panic!("{difference:?}");
    };
    let ColumnDifference::Values { count, by, .. } = &uv.difference else {
        panic!("{uv:?}");
    };
    assert_eq!((*count, *by, uv.name.as_str()), (1, 0.25, "uv"));
    assert!(difference.is_within(0.25) && !difference.is_within(0.1));
    let one_sided = mesh_difference(painted(0.5), shapes::cube());
    assert_eq!(
        one_sided.attributes[0].difference,
        ColumnDifference::OnlyFirst
    );
    assert!(!one_sided.is_within(1.0));
}

#[test]
fn materials_are_compared_by_name() {
    let material = |name: &str, roughness| Material {
        roughness,
        ..Material::new(name)
    };
    let object = |materials: Vec<Material>| Object {
        materials,
        ..Object::mesh("a", shapes::cube())
    };
    let first = with(object(vec![material("skin", 0.5), material("cloth", 0.5)]));
    let second = with(object(vec![material("skin", 0.25), material("hair", 0.5)]));
    let difference = Difference::between(&first, &second);
    let object = &difference.objects[0];
    assert_eq!(object.materials_differ, ["skin"]);
    assert_eq!(object.materials_only_first, ["cloth"]);
    assert_eq!(object.materials_only_second, ["hair"]);
    assert!(!object.identical && !object.is_within(1.0));
}
