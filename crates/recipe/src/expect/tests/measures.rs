//! Tests of the expectations about areas, volumes, bounds, angles, lengths and positions.

use geometry::shapes;
use mesh::{Column, DVec3, Domain, Rule, Values};
use scene::Scene;

use super::{check, cube, holds_and_fails, lines, mesh_from, scene};
use crate::expect::violation::rounded;

#[test]
fn self_intersections_are_counted_by_face() {
    let mut torus = shapes::torus(12, 8, 2.0, 0.7);
    assert_eq!(
        check(
            &scene([("torus", torus.clone())]),
            "SelfIntersections(eq: 0)"
        ),
        Ok(())
    );
    torus.positions_mut()[0] *= -1.0;
    let crossed = scene([("torus", torus)]);
    assert_eq!(check(&crossed, "SelfIntersections(min: 5)"), Ok(()));
    let error = check(&crossed, "SelfIntersections(eq: 0)").unwrap_err();
    assert!(
        error.starts_with("expected 0 self-intersecting faces, found "),
        "{error}"
    );
}

#[test]
fn thickness_is_measured_at_vertices() {
    holds_and_fails(
        &cube(),
        "Thickness(min: 1.999, max: 2.001)",
        "Thickness(of: Vertices([3]), min: 3)",
        "expected v3 to have a thickness of at least 3, found 2",
    );
    assert!(check(&cube(), "Thickness(of: Not(All), min: 0)").is_err());
    let sheet = scene([("sheet", shapes::square())]);
    assert_eq!(check(&sheet, "Thickness(min: 1e9)"), Ok(()));
    assert!(check(&sheet, "Thickness(max: 1e9)").is_err());
}

#[test]
fn area_and_volume_are_compared_within_a_tolerance() {
    holds_and_fails(
        &cube(),
        "Area(eq: 24)",
        "Area(eq: 23.5)",
        "expected an area of 23.5, found 24",
    );
    holds_and_fails(
        &cube(),
        "Area(eq: 23.5, tolerance: 0.5)",
        "Area(min: 25)",
        "expected an area of at least 25, found 24",
    );
    holds_and_fails(
        &cube(),
        "Volume(eq: 8)",
        "Volume(eq: 8.25, tolerance: 0.125)",
        &format!(
            "expected a volume of 8.25, found {}",
            geometry::volume(&shapes::cube())
        ),
    );
    holds_and_fails(
        &cube(),
        "Volume(min: 7.99, max: 8.01)",
        "Volume(max: 7.5)",
        "expected a volume of at most 7.5, found 8",
    );
}

#[test]
fn bounds_are_those_of_all_points() {
    holds_and_fails(
        &cube(),
        "Bounds(min: (-1, -1, -1), max: (1, 1, 1))",
        "Bounds(min: (-1, -1, -1), max: (1, 1, 2))",
        "expected bounds from [-1, -1, -1] to [1, 1, 2], found [-1, -1, -1] to [1, 1, 1]",
    );
    let nothing = Scene::new();
    assert_eq!(
        check(&nothing, "Bounds(min: (0, 0, 0), max: (0, 0, 0))"),
        Err("expected at least 1 point, found none".to_owned())
    );
}

#[test]
fn valences_lie_in_a_range() {
    holds_and_fails(
        &cube(),
        "Valence(min: 3, max: 3)",
        "Valence(min: 4)",
        "expected at least 4 edges at v0, found 3",
    );
    holds_and_fails(
        &cube(),
        "Valence(of: Vertices([5]), max: 3)",
        "Valence(of: Boundary, max: 3)",
        "the selection contains no vertices",
    );
}

#[test]
fn dihedral_angles_lie_in_a_range() {
    // The mesh is a strip along x. It is first flat, and then bends up by a right angle.
    let p = |x: f64, z: f64| [DVec3::new(x, 0.0, z), DVec3::new(x, 1.0, z)];
    let positions: Vec<DVec3> = [p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(2.0, 1.0)].concat();
    let stairs = scene([(
        "stairs",
        mesh_from(&positions, &[&[0, 2, 3, 1], &[2, 4, 5, 3], &[4, 6, 7, 5]]),
    )]);
    holds_and_fails(
        &stairs,
        "DihedralAngle(min: 0, max: 90.000001, reaches: 89.999999)",
        "DihedralAngle(reaches: 91)",
        "expected a largest dihedral angle of at least 91, found 90",
    );
    holds_and_fails(
        &stairs,
        "DihedralAngle(of: Between(2, 3), max: 0)",
        "DihedralAngle(of: Between(2, 3), min: 1)",
        "expected the edge v2-v3 to have a dihedral angle of at least 1, found 0",
    );
    assert_eq!(
        check(&stairs, "DihedralAngle(of: Boundary, max: 180)"),
        Err("the selection contains no edges between two faces".to_owned())
    );
}

#[test]
fn the_mean_area_of_faces_is_in_proportion_to_the_median() {
    // The areas of the faces are 1, 1 and 4.
    let positions: Vec<DVec3> = [0.0, 1.0, 2.0, 6.0]
        .map(|x| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 1.0, 0.0)])
        .concat();
    let strip = scene([(
        "strip",
        mesh_from(&positions, &[&[0, 2, 3, 1], &[2, 4, 5, 3], &[4, 6, 7, 5]]),
    )]);
    holds_and_fails(
        &strip,
        "MeanFaceArea(of: Faces([0, 2]), min: 2.5, max: 2.5)",
        "MeanFaceArea(of: Faces([2]), max: 3)",
        "expected a ratio of mean to median face area of at most 3, found 4",
    );
    assert_eq!(
        check(&strip, "MeanFaceArea(of: Degree(3), max: 3)"),
        Err("the selection contains no faces".to_owned())
    );
}

#[test]
fn lengths_of_edges_and_angles_of_corners_are_measured() {
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    // The triangle has angles of 90, 60 and 30 degrees, and sides of 1, 2 and √3.
    let triangle = scene([(
        "a",
        mesh_from(
            &[p(0.0, 0.0), p(1.0, 0.0), p(0.0, 3_f64.sqrt())],
            &[&[0, 1, 2]],
        ),
    )]);
    holds_and_fails(
        &triangle,
        "EdgeLength(min: 1, max: 2.000001)",
        "EdgeLength(of: Between(0, 1), max: 0.5)",
        "expected the edge v0-v1 to have a length of at most 0.5, found 1",
    );
    assert!(check(&triangle, "MinAngle(min: 29.9999, max: 30.0001)").is_ok());
    let error = check(&triangle, "MinAngle(min: 31)").unwrap_err();
    assert!(
        error.starts_with("expected a smallest corner angle (at f0) of at least 31, found 30"),
        "{error}"
    );
    assert!(check(&triangle, "MeanMinAngle(min: 29.9999, max: 30.0001)").is_ok());
    assert!(check(&triangle, "MeanMinAngle(of: Not(All), min: 0)").is_err());
    assert!(check(&triangle, "EdgeLength(of: Not(All), min: 0)").is_err());
    assert!(check(&triangle, "MinAngle(of: Not(All), min: 0)").is_err());
}

#[test]
fn one_vertex_is_at_a_place() {
    holds_and_fails(
        &cube(),
        "Position(of: Vertices([7]), is: (1, 1, 1))",
        "Position(of: Vertices([7]), is: (1, 1, 1.5), tolerance: 0.25)",
        "expected v7 at [1, 1, 1.5], found it at [1, 1, 1]",
    );
    assert_eq!(
        check(&cube(), "Position(of: Vertices([6, 7]), is: (1, 1, 1))"),
        Err("expected exactly 1 selected vertex, found 2".to_owned())
    );
}

#[test]
fn one_point_of_a_polyline_is_at_a_place() {
    holds_and_fails(
        &lines(),
        "Point(index: 2, is: (3, 1, 0))",
        "Point(line: 0, index: 2, is: (3, 2, 0))",
        "expected point 2 of polyline 0 at [3, 2, 0], found it at [3, 1, 0]",
    );
    assert_eq!(
        check(&lines(), "Point(index: 3, is: (0, 0, 0))"),
        Err("point 3 of polyline 0 does not exist".to_owned())
    );
    assert_eq!(
        check(&cube(), "Point(index: 0, is: (0, 0, 0))"),
        Err("this expectation needs exactly 1 object with polylines, found 0".to_owned())
    );
}

#[test]
fn values_of_attributes_are_in_a_range() {
    let mut mesh = shapes::cube();
    let mut insert = |domain, name: &str, values| {
        let (name, rule) = (name.to_owned(), Rule::Copy);
        mesh.insert_column(domain, Column { name, rule, values });
    };
    let numbers = (1..=8).map(f64::from).collect();
    insert(Domain::Vertex, "wall", Values::Float(numbers));
    insert(Domain::Face, "kind", Values::Int((0..6).collect()));
    insert(Domain::Face, "flow", Values::Vec3(vec![DVec3::Y; 6]));
    let scene = scene([("cube", mesh)]);
    holds_and_fails(
        &scene,
        "Attribute(name: \"wall\", min: 1, max: 8)",
        "Attribute(name: \"wall\", min: 1.5)",
        "expected the attribute \"wall\" at v0 to have a value of at least 1.5, found 1",
    );
    holds_and_fails(
        &scene,
        "Attribute(name: \"wall\", of: Vertices(Where(attribute: \"wall\", above: 4)), min: 5)",
        "Attribute(name: \"wall\", of: Faces(All), min: 5)",
        "expected the face attribute \"wall\", but \"cube\" does not have it",
    );
    holds_and_fails(
        &scene,
        "Attribute(name: \"kind\", max: 5)",
        "Attribute(name: \"kind\", max: 4)",
        "expected the attribute \"kind\" at f5 to have a value of at most 4, found 5",
    );
    holds_and_fails(
        &scene,
        "Attribute(name: \"flow\", component: 1, min: 1)",
        "Attribute(name: \"flow\", component: 0, min: 1)",
        "expected the attribute \"flow\" at f0 to have a value of at least 1, found 0",
    );
    for (text, expected) in [
        (
            "Attribute(name: \"flow\", min: 1)",
            "the type of the face attribute \"flow\" is 3 numbers: choose one number with `component`, counted from 0",
        ),
        (
            "Attribute(name: \"wall\", of: Vertices(Not(All)), min: 1)",
            "no element has a value of the attribute \"wall\"",
        ),
    ] {
        assert_eq!(check(&scene, text), Err(expected.to_owned()));
    }
}

#[test]
fn textures_are_stretched_and_overlap() {
    let sheet = |x: f64| {
        let mut mesh = shapes::grid(1, 1);
        let uvs = mesh.half_edges().map(|h| {
            let p = mesh.position(mesh.origin(h));
            mesh::DVec2::new(p.x * x, p.y)
        });
        let uvs = uvs.collect();
        mesh.set(mesh::UV, uvs);
        mesh
    };
    let wide = scene([("mesh", sheet(2.0))]);
    assert!(check(&wide, "UvStretch(max: 2.001)").is_ok());
    let error = check(&wide, "UvStretch(max: 1.5)").unwrap_err();
    assert!(
        error.starts_with("expected a stretch of at most 1.5, found 2"),
        "{error}"
    );
    assert!(check(&wide, "UvOverlap(eq: 0)").is_ok());
    assert!(check(&wide, "UvOverlap(uv: \"light\", eq: 0)").is_err());
    let mut twice = sheet(1.0);
    let uvs: Vec<_> = twice
        .get(mesh::UV)
        .unwrap()
        .iter()
        .map(|uv| *uv / 2.0)
        .collect();
    let mut stacked = shapes::cube();
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(mesh::DVec2::from);
    let mut corners = vec![mesh::DVec2::ZERO; stacked.n_half_edges()];
    for f in stacked.faces() {
        for (h, uv) in stacked.face_half_edges(f).zip(square) {
            corners[h.index()] = uv;
        }
    }
    stacked.set(mesh::UV, corners);
    twice.set(mesh::UV, uvs);
    let error = check(&scene([("mesh", stacked)]), "UvOverlap(max: 0)").unwrap_err();
    assert!(error.contains("found 6"), "{error}");
    assert!(check(&scene([("mesh", twice)]), "UvOverlap(max: 0)").is_ok());
}

#[test]
fn a_number_beyond_a_limit_has_six_digits_unless_these_hide_it() {
    for (found, limit, text) in [
        (6.383_174_544_719_917_5, 100.0, "6.38317"),
        (0.1, 0.1, "0.1"),
        (0.100_000_000_001, 0.1, "0.100000000001"),
        (9.999_999_999, 10.0, "9.999999999"),
    ] {
        assert_eq!(rounded(found, limit), text);
    }
}
