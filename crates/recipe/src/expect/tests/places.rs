//! Tests of the elements that violate an expectation.

use geometry::shapes;
use mesh::{DVec3, EdgeId, VertexId};
use op::{ErrorLocation, Files};
use scene::Scene;

use super::counts::with_double_edges;
use super::{cube, expectation, lines, mesh_from, scene};
use crate::expect::Subject;
use crate::tests::objects;

fn places(scene: &Scene, text: &str) -> Vec<ErrorLocation> {
    let files = Files::default();
    let octahedron = scene::Object::mesh("octahedron", shapes::octahedron());
    let reader = objects(|_, _| Ok(vec![octahedron.clone()]));
    expectation(text).places(Subject {
        scene,
        on: None,
        files: &files,
        reader: &reader,
        progress: &op::NoProgress,
    })
}

/// Returns the names of the locations.
fn names(scene: &Scene, text: &str) -> Vec<String> {
    places(scene, text).into_iter().map(|p| p.name).collect()
}

/// Returns a scene with a square and, beside the square, a triangle with sides of length 1, 2 and √5.
fn square_and_triangle() -> Scene {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = [
        at(0.0, 0.0),
        at(1.0, 0.0),
        at(1.0, 1.0),
        at(0.0, 1.0),
        at(5.0, 0.0),
        at(7.0, 0.0),
        at(7.0, 1.0),
    ];
    scene([("two", mesh_from(&positions, &[&[0, 1, 2, 3], &[4, 5, 6]]))])
}

#[test]
fn only_the_selected_elements_out_of_bounds_are_named() {
    let two = square_and_triangle();

    assert_eq!(names(&two, "MinAngle(min: 30)"), ["f1"]);
    assert_eq!(names(&two, "MinAngle(min: 20)"), [""; 0]);
    let long = places(&two, "EdgeLength(max: 2.1)");
    assert_eq!(long.len(), 1);
    assert_eq!(
        long[0].points[0].distance(long[0].points[1]),
        5.0_f64.sqrt()
    );
    assert_eq!(places(&two, "EdgeLength(min: 1.5, max: 2.1)").len(), 6);
    assert_eq!(names(&cube(), "Valence(min: 4)").len(), 8);
    assert_eq!(names(&cube(), "Valence(eq: 4)").len(), 8);
    assert!(names(&cube(), "Valence(eq: 3)").is_empty());
    assert_eq!(names(&cube(), "Valence(of: Vertices([3]), max: 2)"), ["v3"]);
    assert_eq!(names(&cube(), "DihedralAngle(max: 80)").len(), 12);
    assert_eq!(
        names(&cube(), "Count(of: Faces(Faces([2, 4])), eq: 1)"),
        ["f2", "f4"]
    );
}

#[test]
fn boundary_edges_violate_closed() {
    assert_eq!(places(&square_and_triangle(), "Closed").len(), 7);
    assert!(places(&cube(), "Closed").is_empty());
    assert_eq!(
        places(&square_and_triangle(), "BoundaryLoops(eq: 1)").len(),
        7
    );
}

#[test]
fn double_edges_violate_manifold() {
    let mesh = with_double_edges();
    let between = |e| {
        let [v, w] = mesh.edge_vertices(e).map(VertexId::index);
        (v.min(w), v.max(w))
    };
    let is_double = |&e: &EdgeId| {
        mesh.edges()
            .any(|other| other != e && between(other) == between(e))
    };
    let mut expected: Vec<String> =
        (mesh.edges().filter(is_double).map(|e| e.to_string())).collect();
    assert!(expected.len() > 1 && expected.len() < mesh.n_edges());

    let mut found = names(&scene([("double", mesh.clone())]), "Manifold");

    expected.sort();
    found.sort();
    assert_eq!(found, expected);
    assert!(places(&cube(), "Manifold").is_empty());
}

#[test]
fn a_wrong_position_has_an_actual_and_an_expected_place() {
    let found = places(&cube(), "Position(of: Vertices([0]), is: (5, 5, 5))");
    assert_eq!(found[0].name, "v0");
    assert_eq!(
        (&*found[1].name, found[1].points[0]),
        (ErrorLocation::EXPECTED, DVec3::splat(5.0))
    );

    let found = places(&lines(), "Point(index: 2, is: (0, 0, 9))");
    assert_eq!(found[0].points, [DVec3::new(3.0, 1.0, 0.0)]);
    assert_eq!(found[1].points, [DVec3::new(0.0, 0.0, 9.0)]);
}

#[test]
fn unmatched_vertices_of_both_meshes_are_named() {
    let scene = scene([("cube", shapes::cube())]);

    let found = places(&scene, "Same(as: File(\"octahedron.obj\"))");

    let expected = found.iter().filter(|p| p.name == ErrorLocation::EXPECTED);
    assert_eq!((found.len(), expected.count()), (14, 6));
}

#[test]
fn the_farthest_points_of_two_surfaces_are_joined() {
    let scene = scene([("cube", shapes::cube())]);

    let found = places(
        &scene,
        "DistanceTo(other: File(\"octahedron.obj\"), below: 0.1)",
    );

    let [on, way] = &found[..] else {
        panic!("{found:?}");
    };
    assert!(!on.name.is_empty() && way.name.is_empty());
    assert!(way.points[0].distance(way.points[1]) > 0.1);
}

#[test]
fn vertices_with_an_unmatched_image_violate_a_symmetry() {
    assert!(places(&cube(), "SymmetricUnder(group: CubeMotions)").is_empty());
    let mut mesh = shapes::cube();
    mesh.positions_mut()[5] *= 1.5;
    let scene = scene([("cube", mesh)]);

    let found = names(&scene, "SymmetricUnder(group: CubeRotations)");

    // No vertex is at the old position of the moved vertex. Each vertex is mapped to this position by some rotation, so
    // all 8 vertices are named.
    assert_eq!(found.len(), 8);
}

#[test]
fn expectations_that_are_not_about_elements_have_no_places() {
    for text in [
        "Genus(eq: 3)",
        "Not(Closed)",
        "Digest(\"0\")",
        "Area(eq: 1)",
    ] {
        assert!(places(&cube(), text).is_empty(), "{text}");
    }
    // A selection that is refused selects no elements.
    let text = "Count(of: Edges(Between(0, 99)), eq: 1)";
    assert!(places(&cube(), text).is_empty());
}

#[test]
fn stretched_and_overlapping_faces_are_named() {
    // In the texture, the second square has half the width of the first square, and overlaps the first square.
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)];
    let positions = positions.map(|(x, y)| at(f64::from(x), f64::from(y)));
    let mut mesh = mesh_from(&positions, &[&[0, 1, 4, 3], &[1, 2, 5, 4]]);
    let mut uvs = vec![mesh::DVec2::ZERO; mesh.n_half_edges()];
    for h in mesh.half_edges() {
        let p = mesh.position(mesh.origin(h));
        let is_second = mesh.face(h) == Some(mesh::FaceId::new(1));
        let u = if is_second { 0.5 * (p.x - 1.0) } else { p.x };
        uvs[h.index()] = mesh::DVec2::new(u, p.y);
    }
    mesh.set(mesh::UV, uvs);
    let scene = scene([("squares", mesh)]);

    assert_eq!(names(&scene, "UvStretch(max: 1.5)"), ["f1"]);
    assert_eq!(names(&scene, "UvStretch(max: 2.5)"), [""; 0]);
    assert_eq!(names(&scene, "UvOverlap(eq: 0)"), ["f0", "f1"]);
}
