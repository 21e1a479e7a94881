use super::*;
use geometry::shapes;
use mesh::{CORNER_NORMAL, MATERIAL, UV, VERTEX_NORMAL};
use op::test::{applied, planned, try_applied};

fn parse(text: &str) -> ExtrudeFaces {
    op::test::read(text).unwrap()
}

fn top() -> FaceId {
    FaceId::new(1)
}

#[test]
fn a_face_moves_along_its_normal() {
    let mesh = applied(
        &parse("(faces: Faces([1]), by: Distance(0.5))"),
        shapes::cube(),
    );
    assert_eq!(mesh.face_center(top()), DVec3::new(0.0, 0.0, 1.5));
    assert!((geometry::volume(&mesh) - 10.0).abs() < 1e-13);
    let inwards = applied(
        &parse("(faces: Faces([1]), by: Distance(-0.5))"),
        shapes::cube(),
    );
    assert!((geometry::volume(&inwards) - 6.0).abs() < 1e-13);
}

#[test]
fn an_offset_is_the_same_for_all_regions() {
    let mesh = applied(
        &parse("(faces: Faces([0, 1]), by: Offset((1, 2, 3)))"),
        shapes::cube(),
    );
    assert_eq!(mesh.face_center(FaceId::new(0)), DVec3::new(1.0, 2.0, 2.0));
    assert_eq!(mesh.face_center(top()), DVec3::new(1.0, 2.0, 4.0));
}

#[test]
fn each_region_moves_along_its_normal_and_scales_about_its_center() {
    let mesh = applied(
        &parse("(faces: Or([Faces([0]), Faces([1])]), by: Distance(1), scale: 0.5)"),
        shapes::cube(),
    );
    for (f, z) in [(0, -2.0), (1, 2.0)] {
        let f = FaceId::new(f);
        assert_eq!(mesh.face_center(f), DVec3::new(0.0, 0.0, z));
        assert!((mesh.face_area(f) - 1.0).abs() < 1e-15);
    }
}

#[test]
fn faces_that_share_an_edge_are_one_region_with_a_mean_normal() {
    // The region consists of the front face and the right face of the cube, so its normal is the direction between -y
    // and +x.
    let (mesh, report) = try_applied(
        &parse("(faces: Faces([2, 3]), by: Distance(1))"),
        shapes::cube(),
    )
    .unwrap();
    assert_eq!(
        report.notes,
        ["connected regions of selected faces: 1, new side faces: 6"]
    );
    let moved = mesh.face_center(FaceId::new(2)) - DVec3::new(0.0, -1.0, 0.0);
    let half = 0.5_f64.sqrt();
    assert!((moved - DVec3::new(half, -half, 0.0)).length() < 1e-15);
}

#[test]
fn rotations_and_scale_are_about_the_center_of_the_region() {
    let mesh = applied(
        &parse("(faces: Faces([3]), by: Distance(2), scale: 0.5, rotate: [(axis: Y, angle: 90)])"),
        shapes::cube(),
    );
    let right = FaceId::new(3);
    assert_eq!(mesh.face_center(right), DVec3::new(3.0, 0.0, 0.0));
    assert_eq!(mesh.face_normal(right), DVec3::NEG_Z);
    assert!((mesh.face_area(right) - 1.0).abs() < 1e-15);
}

/// Models a figure from a cube: a body, a head, bent arms and two legs.
#[test]
fn repeated_extrusions_of_a_cube_give_one_closed_component() {
    let mut mesh = shapes::cube();
    for step in [
        // Neck and head.
        "(faces: Faces([1]), by: Distance(0.4), scale: 0.5)",
        "(faces: Faces([1]), by: Distance(0.2))",
        "(faces: Faces([1]), by: Distance(0.4), scale: 1.8)",
        "(faces: Faces([1]), by: Distance(0.8))",
        "(faces: Faces([1]), by: Distance(0.3), scale: 0.6, tag: \"crown\")",
        // Two steps grow both arms, one to the right and one to the left. Two more steps bend the right arm upwards.
        "(faces: Faces([3, 5]), by: Distance(0.5), scale: 0.4, tag: \"arms\")",
        "(faces: Faces([3, 5]), by: Distance(1.5), scale: 0.8)",
        "(faces: Faces([3]), by: Distance(0.5), rotate: [(axis: Y, angle: -60)])",
        "(faces: Faces([3]), by: Distance(1))",
        // One step adds the hips, whose first side face has the id 50. Two legs then grow out of the left and the right
        // side face of the hips.
        "(faces: Faces([0]), by: Distance(1))",
        "(faces: Faces([50, 52]), by: Distance(0.2), scale: 0.5, tag: \"legs\")",
        "(faces: Faces([50]), by: Offset((-0.4, 0, -0.4)), rotate: [(axis: Y, angle: -90)])",
        "(faces: Faces([52]), by: Offset((0.4, 0, -0.4)), rotate: [(axis: Y, angle: 90)])",
        "(faces: Faces([50, 52]), by: Distance(2))",
    ] {
        mesh = applied(&parse(step), mesh);
    }
    assert!(mesh.is_closed());
    assert_eq!(
        (geometry::n_components(&mesh), geometry::genus(&mesh)),
        (1, 0)
    );
    assert!(mesh.faces().all(|f| mesh.degree(f) == 4));
    assert!(mesh.face_normal(FaceId::new(3)).z > 0.8);
    // Side faces of tagged faces are also tagged, even in later steps.
    let arms = mesh.tag(Domain::Face, "arms").unwrap();
    assert_eq!(arms.iter().filter(|&&a| a).count(), 2 + 8 + 8 + 4 + 4);
    let legs = mesh.tag(Domain::Face, "legs").unwrap();
    assert_eq!(legs.iter().filter(|&&l| l).count(), 2 + 3 * 8);
    assert_eq!(mesh.face_normal(FaceId::new(50)), DVec3::NEG_Z);
    assert_eq!(mesh.face_normal(FaceId::new(52)), DVec3::NEG_Z);
}

#[test]
fn elements_are_numbered_as_documented() {
    let mesh = applied(
        &parse("(faces: Faces([5, 3]), by: Distance(1))"),
        shapes::cube(),
    );
    let corners = |f| -> Vec<usize> {
        mesh.face_vertices(FaceId::new(f))
            .map(mesh::VertexId::index)
            .collect()
    };
    // The corners of face 3 were 1, 3, 7, 5, and the corners of face 5 were 2, 0, 4, 6.
    assert_eq!(corners(3), [8, 9, 10, 11]);
    assert_eq!(corners(6), [1, 3, 9, 8]);
    assert_eq!(corners(5), [12, 13, 14, 15]);
    assert_eq!(corners(10), [2, 0, 13, 12]);
}

#[test]
fn normals_are_dropped_and_other_values_are_kept() {
    let mut mesh = shapes::cube();
    mesh.set(VERTEX_NORMAL, vec![DVec3::Z; 8]);
    mesh.set(CORNER_NORMAL, vec![DVec3::Z; 24]);
    mesh.set(MATERIAL, (0..6).collect());
    mesh.set(UV, vec![mesh::DVec2::ONE; 24]);
    let step = parse("(faces: Faces([4]), by: Distance(1), tag: \"back\")");
    let (plan, problems) = planned(&step, &mesh);
    assert_eq!(problems, []);
    let names: Vec<_> = plan.attributes.iter().map(|a| a.name.as_str()).collect();
    assert_eq!(names, ["uv", "material", "back"]);

    let (mesh, report) = try_applied(&step, mesh).unwrap();
    assert_eq!(report.losses.len(), 2);
    assert_eq!(mesh.get(MATERIAL).unwrap()[6..], [4; 4]);
    let uv = mesh.get(UV).unwrap();
    assert!(uv.iter().all(|&uv| uv == mesh::DVec2::ONE));
    assert_eq!(
        mesh.tag(Domain::Face, "back").unwrap(),
        [
            false, false, false, false, true, false, true, true, true, true
        ]
    );
}

#[test]
fn a_closed_part_has_no_normal_but_can_be_moved() {
    let refused = try_applied(
        &parse("(faces: All, by: Distance(1))"),
        shapes::torus(9, 7, 2.0, 1.0),
    );
    assert!(matches!(refused, Err(OpError::Parameter(_))), "{refused:?}");
    let moved = applied(
        &parse("(faces: All, by: Offset((1, 0, 0)))"),
        shapes::cube(),
    );
    assert_eq!(
        geometry::bounds(&moved).unwrap()[0],
        DVec3::new(0.0, -1.0, -1.0)
    );
    assert_eq!(moved.n_faces(), 6);
}

#[test]
fn an_attribute_that_is_not_a_tag_is_not_overwritten() {
    let mut mesh = shapes::cube();
    mesh.set(MATERIAL, vec![0; 6]);
    let refused = try_applied(
        &parse("(faces: All, by: Offset((0, 0, 1)), tag: \"material\")"),
        mesh,
    );
    assert!(matches!(refused, Err(OpError::Parameter(_))), "{refused:?}");
}

#[test]
fn coordinates_that_overflow_are_refused() {
    let far = ExtrudeFaces {
        by: ExtrudeBy::Distance(Distance::literal(f64::MAX)),
        scale: PositiveFactor::literal(1e300),
        ..parse("(faces: Faces([0]), by: Distance(1))")
    };
    assert!(try_applied(&far, shapes::cube()).is_err());
}

#[test]
fn results_are_within_the_plan() {
    for text in [
        "(faces: All, by: Offset((0, 0, 1)))",
        "(faces: Faces([0]), by: Distance(1))",
        "(faces: Expect(count: 2, of: Faces([0, 1])), by: Distance(1))",
        "(faces: Random(count: 3, seed: 1), by: Distance(1))",
    ] {
        for shape in [shapes::cube(), shapes::icosahedron(), shapes::grid(2, 2)] {
            let (plan, _) = planned(&parse(text), &shape);
            let mesh = applied(&parse(text), shape);
            assert!(plan.vertices.contains(mesh.n_vertices() as u64));
            assert!(plan.edges.contains(mesh.n_edges() as u64));
            assert!(plan.faces.contains(mesh.n_faces() as u64));
        }
    }
}

#[test]
fn an_empty_selection_changes_nothing() {
    let (mesh, report) = try_applied(
        &parse("(faces: Faces([]), by: Distance(1))"),
        shapes::cube(),
    )
    .unwrap();
    assert_eq!(mesh, shapes::cube());
    assert_eq!(report.notes, ["nothing was selected"]);
}
