//! Tests of the operation.

use super::*;
use bezier::DVec2;
use geometry::shapes;
use mesh::{CORNER_NORMAL, TANGENT, VERTEX_NORMAL};
use op::Range;
use scene::Object;

fn step(text: &str) -> Transform {
    op::test::read(text).unwrap()
}

fn applied(text: &str, mesh: Mesh) -> Mesh {
    op::test::applied(&step(text), mesh)
}

fn scene_of(geometry: Geometry) -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::new("a", geometry)).unwrap();
    scene
}

#[test]
fn the_default_transform_changes_nothing() {
    assert_eq!(applied("()", shapes::cube()), shapes::cube());
}

#[test]
fn points_are_scaled_then_rotated_then_moved() {
    let text = "(scale: (2, 1, 1), rotate: [(axis: Z, angle: 90)], move: (3, 1, 0))";
    let mesh = applied(text, shapes::square());
    let at = |x, y| DVec3::new(x, y, 0.0);
    assert_eq!(
        mesh.positions(),
        [at(3.0, 1.0), at(3.0, 3.0), at(2.0, 3.0), at(2.0, 1.0)]
    );
}

#[test]
fn rotations_are_applied_in_order() {
    let text = "(rotate: [(axis: Z, angle: 90), (axis: X, angle: 90)])";
    let mesh = applied(text, shapes::square());
    // The first rotation maps x to y, and the second maps y to z.
    assert_eq!(mesh.positions()[1], DVec3::Z);
}

#[test]
fn four_quarter_turns_change_nothing() {
    for axis in ["X", "Y", "Z"] {
        let mut mesh = shapes::cube();
        for _ in 0..4 {
            mesh = applied(&format!("(rotate: [(axis: {axis}, angle: 90)])"), mesh);
        }
        assert_eq!(mesh, shapes::cube());
    }
}

#[test]
fn a_rotation_keeps_area_and_volume() {
    let torus = shapes::torus(7, 5, 2.0, 0.5);
    let text = "(rotate: [(axis: X, angle: 33), (axis: Y, angle: -71.5)], about: Point(4, 5, 6))";
    let mesh = applied(text, torus.clone());
    assert!((geometry::area(&mesh) - geometry::area(&torus)).abs() < 1e-12);
    assert!((geometry::volume(&mesh) - geometry::volume(&torus)).abs() < 1e-12);
}

#[test]
fn scaling_multiplies_the_volume_for_all_signs() {
    for signs in 0..8 {
        let sign = |bit: i32| if signs & bit == 0 { 1 } else { -1 };
        let (x, y, z) = (2 * sign(1), 3 * sign(2), sign(4));
        let text = format!("(scale: ({x}, {y}, {z}))");
        let tetrahedron = shapes::tetrahedron();
        let mesh = applied(&text, tetrahedron.clone());
        assert!(
            (geometry::volume(&mesh) - 6.0 * geometry::volume(&tetrahedron)).abs() < 1e-12,
            "{text}"
        );
    }
}

#[test]
fn two_mirrors_change_nothing() {
    let mesh = shapes::grid(3, 2);
    let once = applied("(scale: (-1, 1, 1))", mesh.clone());
    assert_ne!(once, mesh);
    assert_eq!(applied("(scale: (-1, 1, 1))", once), mesh);
}

#[test]
fn the_center_of_each_object_is_fixed() {
    let far = applied("(move: (100, 200, 300))", shapes::cube());
    let text = "(scale: (2, 2, 2), rotate: [(axis: Y, angle: 90)], about: Center)";
    let [min, max] = geometry::bounds(&applied(text, far)).unwrap();
    assert_eq!(
        (min, max),
        (
            DVec3::new(98.0, 198.0, 298.0),
            DVec3::new(102.0, 202.0, 302.0)
        )
    );
}

#[test]
fn the_point_of_about_is_fixed() {
    let text = "(scale: (3, -3, 5), rotate: [(axis: Z, angle: 90)], about: Point(1, 1, 0))";
    assert_eq!(
        applied(text, shapes::square()).positions()[2],
        DVec3::new(1.0, 1.0, 0.0)
    );
}

#[test]
fn normals_stay_perpendicular_to_their_faces() {
    for scale in ["(1, 1, 1)", "(4, 0.5, 1)", "(-4, 0.5, 1)", "(-1, -2, -3)"] {
        let mut mesh = shapes::icosahedron();
        let corners = mesh
            .half_edges()
            .map(|h| mesh.face_normal(mesh.face(h).unwrap()))
            .collect();
        mesh.set(CORNER_NORMAL, corners);
        mesh.set(VERTEX_NORMAL, vec![DVec3::ZERO; 12]);
        let text = format!("(scale: {scale}, rotate: [(axis: X, angle: 20)])");
        let mesh = applied(&text, mesh);
        let normals = mesh.get(CORNER_NORMAL).unwrap();
        for h in mesh.half_edges() {
            let expected = mesh.face_normal(mesh.face(h).unwrap());
            assert!(normals[h.index()].abs_diff_eq(expected, 1e-14), "{text}");
        }
        assert!(
            mesh.get(VERTEX_NORMAL)
                .unwrap()
                .iter()
                .all(|&n| n == DVec3::ZERO)
        );
    }
}

#[test]
fn normals_are_correct_for_extreme_factors() {
    let mut mesh = shapes::square();
    mesh.set(VERTEX_NORMAL, vec![DVec3::Z; 4]);
    let mesh = applied("(scale: (1e-300, 1, 1e300))", mesh);
    assert_eq!(mesh.get(VERTEX_NORMAL).unwrap(), [DVec3::Z; 4]);
}

#[test]
fn a_mirrored_patch_keeps_its_orientation() {
    let points =
        [0, 1, 2, 3].map(|r| [0, 1, 2, 3].map(|c| DVec3::new(f64::from(c), f64::from(r), 0.0)));
    let mut scene = scene_of(Geometry::Patches(vec![Patch::new(points).unwrap()]));
    op::test::run(&step("(scale: (-1, 1, 1))"), &mut scene).unwrap();
    let Geometry::Patches(patches) = &scene.objects()[0].geometry else {
        panic!("patches");
    };
    assert_eq!(patches[0].normal(0.5, 0.5), DVec3::Z);
    assert_eq!(patches[0].point(1.0, 1.0), DVec3::new(-3.0, 3.0, 0.0));
}

fn curve() -> Geometry {
    Geometry::Curve(
        Curve::new(vec![
            DVec2::ZERO,
            DVec2::new(0.0, 4.0),
            DVec2::new(4.0, 4.0),
        ])
        .unwrap(),
    )
}

#[test]
fn a_curve_rotates_and_moves_in_its_plane() {
    let mut scene = scene_of(curve());
    op::test::run(
        &step("(rotate: [(axis: Z, angle: 90)], move: (1, 0, 0))"),
        &mut scene,
    )
    .unwrap();
    let points = vec![
        DVec2::new(1.0, 0.0),
        DVec2::new(-3.0, 0.0),
        DVec2::new(-3.0, 4.0),
    ];
    assert_eq!(
        scene.objects()[0].geometry,
        Geometry::Curve(Curve::new(points).unwrap())
    );
    // A half turn around the x axis also keeps the curve in the plane z = 0.
    assert!(op::test::run(&step("(rotate: [(axis: X, angle: 180)])"), &mut scene).is_ok());
}

#[test]
fn a_curve_must_not_leave_its_plane() {
    let files = op::Files::default();
    let cx = PlanContext::new(&files);
    for (text, certain) in [
        ("(move: (0, 0, 1))", true),
        ("(scale: (1, 1, 2), about: Point(0, 0, 3))", true),
        ("(rotate: [(axis: X, angle: 30)])", false),
    ] {
        let moved = op::test::run(&step(text), &mut scene_of(curve()));
        assert!(matches!(moved, Err(OpError::Parameter(_))), "{text}");
        let mut plan = Plan::default();
        assert_eq!(
            plan.insert("a", PlannedGeometry::Curve(Range::exactly(3))),
            None
        );
        let problems = step(text).plan(&mut plan, &cx);
        assert_eq!(
            problems.iter().map(|p| !p.is_warning).collect::<Vec<_>>(),
            [certain],
            "{text}"
        );
    }
}

#[test]
fn polylines_move() {
    let mut scene = scene_of(Geometry::Polylines(vec![vec![DVec3::ZERO, DVec3::X]]));
    op::test::run(&step("(move: (0, 0, 1), scale: (2, 2, 2))"), &mut scene).unwrap();
    let moved = vec![DVec3::Z, DVec3::new(2.0, 0.0, 1.0)];
    assert_eq!(
        scene.objects()[0].geometry,
        Geometry::Polylines(vec![moved])
    );
}

#[test]
fn only_objects_named_in_on_change() {
    let mut scene = scene_of(Geometry::Mesh(Arc::new(shapes::cube())));
    scene.insert(Object::mesh("b", shapes::cube())).unwrap();
    let files = op::Files::default();
    let mut cx = Context::new(&op::NoProgress, &files);
    let on = ["b".to_owned()];
    cx.on = Some(&on);
    step("(move: (1, 0, 0))")
        .apply(&mut scene, &mut cx)
        .unwrap();
    assert_eq!(**scene.objects()[0].as_mesh().unwrap(), shapes::cube());
    assert_ne!(**scene.objects()[1].as_mesh().unwrap(), shapes::cube());

    let on = ["c".to_owned()];
    cx.on = Some(&on);
    let missing = step("()").apply(&mut scene, &mut cx);
    assert!(matches!(missing, Err(OpError::Object(_))));
}

#[test]
fn coordinates_that_overflow_are_refused() {
    let text = "(scale: (1e308, 1, 1), move: (1.7e308, 0, 0))";
    assert!(matches!(
        op::test::try_applied(&step(text), shapes::cube()),
        Err(OpError::Parameter(_))
    ));
}

#[test]
fn tangents_of_vertices_stay_tangent_to_the_surface() {
    let mut mesh = shapes::square();
    let along = DVec3::new(0.6, 0.8, 0.0);
    mesh.set(TANGENT, vec![along; 4]);
    let text = "(scale: (2, 1, 1), rotate: [(axis: X, angle: 90)])";
    let expected = DVec3::new(1.2, 0.0, 0.8).normalize();
    let mapped = glam::DAffine3::from_scale(DVec3::new(1.0, 5.0, 1.0));
    for (mesh, expected) in [
        (applied(text, mesh.clone()), expected),
        (
            scene::transformed(&mesh, &mapped),
            DVec3::new(0.6, 4.0, 0.0).normalize(),
        ),
    ] {
        for tangent in mesh.get(TANGENT).unwrap() {
            assert!(tangent.distance(expected) < 1e-15, "{tangent}");
        }
    }
}
