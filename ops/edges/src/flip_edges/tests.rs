//! Tests of parameters, refusals, seams and plans.

mod planar;
mod until;

use super::*;
use geometry::shapes;
use mesh::{DVec2, EdgeId, UV};
use op::test::{applied, try_applied};
use op::{Files, Refusal, Region};
use proptest::prelude::*;

fn parse(text: &str) -> FlipEdges {
    op::test::read(text).unwrap()
}

/// Returns a square of two triangles with a UV seam along the edge between vertices 0 and 2.
fn sheet_with_a_seam() -> Mesh {
    let positions = shapes::square().positions().to_vec();
    let (mut mesh, _) = Mesh::from_polygons(positions, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for h in mesh.face_half_edges(mesh::FaceId::new(1)) {
        uvs[h.index()] = DVec2::X;
    }
    mesh.set(UV, uvs);
    mesh
}

#[test]
fn an_edge_between_two_vertices_joins_the_other_two() {
    let mesh = applied(&parse("(edges: Between(0, 2))"), {
        let mut mesh = sheet_with_a_seam();
        mesh.remove_column(mesh::Domain::Corner, UV.name);
        mesh
    });
    let v = mesh::VertexId::new;
    assert!(mesh.find_half_edge(v(1), v(3)).is_some());
    assert!(mesh.find_half_edge(v(0), v(2)).is_none());
}

#[test]
fn four_flips_restore_the_mesh() {
    let mesh = shapes::icosahedron();
    let e = EdgeId::new(0);
    let once = parse("(edges: Tagged(\"it\"))");
    let mut tagged = mesh.clone();
    let tag = mesh::Attribute::<EdgeId, bool>::new("it", mesh::Rule::Copy);
    tagged.set(tag, tagged.edges().map(|other| other == e).collect());
    let mut flipped = tagged.clone();
    for _ in 0..4 {
        flipped = applied(&once, flipped);
    }
    assert_eq!(flipped.connectivity().next, tagged.connectivity().next);
    assert_eq!(flipped.connectivity().origin, tagged.connectivity().origin);
}

#[test]
fn a_refused_flip_fails_the_step_with_a_reason() {
    let refused = try_applied(&parse("(edges: Boundary)"), sheet_with_a_seam());
    let Err(OpError::Refused { reason, .. }) = refused else {
        panic!("expected a refusal, got {refused:?}");
    };
    assert_eq!(reason, Refusal::Boundary);
}

#[test]
fn skipped_refusals_are_counted_by_reason() {
    let skip = parse("(edges: All, on_refusal: Skip)");
    let (mesh, report) = try_applied(&skip, sheet_with_a_seam()).unwrap();
    assert_eq!(mesh, sheet_with_a_seam());
    assert_eq!(report.changed, 0);
    let counts: Vec<_> = report.refused.iter().map(|r| (r.reason, r.count)).collect();
    assert_eq!(counts, [(Refusal::Boundary, 4), (Refusal::Seam, 1)]);
}

#[test]
fn a_crossed_seam_is_counted() {
    let drop = parse("(edges: Between(0, 2), seams: Drop)");
    let (_, report) = try_applied(&drop, sheet_with_a_seam()).unwrap();
    assert_eq!(report.changed, 1);
    assert!(report.notes[0].starts_with("flipped 1 seam edge; "));
}

#[test]
fn the_plan_reports_a_mesh_without_triangles() {
    let files = Files::default();
    let cx = PlanContext::new(&files);
    let plan = |operation: &FlipEdges, mesh: &Mesh| {
        MeshOperation::plan(operation, &mut MeshPlan::of(mesh), &cx)
    };
    let all = parse("(edges: All)");
    assert_eq!(plan(&all, &shapes::octahedron()), []);
    assert_eq!(plan(&all, &Mesh::default()), []);
    for until in ["Delaunay", "Valence"] {
        let flip = parse(&format!("(edges: All, until: {until})"));
        assert_eq!(plan(&flip, &shapes::octahedron()), []);
        let [problem] = &plan(&flip, &shapes::cube())[..] else {
            panic!("one problem")
        };
        assert!(problem.is_warning, "{until}");
    }
}

#[test]
fn an_edge_between_polygons_is_flipped_once_as_planned() {
    let cube = shapes::cube();
    let once = parse("(edges: Between(0, 1))");
    assert_eq!(op::test::planned(&once, &cube).1, []);
    let mesh = op::test::applied_as_planned(&once, &cube);
    let v = mesh::VertexId::new;
    assert!(mesh.find_half_edge(v(0), v(1)).is_none());
    assert!(mesh.faces().all(|f| mesh.degree(f) == 4));
    assert_eq!(op::test::counts(&mesh), op::test::counts(&cube));
    // The two faces together form a polygon with six corners, and a flip moves each end of the edge to the next corner.
    // Six flips bring the edge back.
    let e = cube.find_half_edge(v(0), v(1)).unwrap().edge();
    let mut back = mesh;
    for _ in 0..5 {
        back.flip_edge(e).unwrap();
    }
    assert_eq!(back.connectivity().next, cube.connectivity().next);
}

#[test]
fn edges_are_required_and_unknown_fields_are_errors() {
    assert!(op::test::read::<FlipEdges>("()").is_err());
    assert!(op::test::read::<FlipEdges>("(edges: All, seam: Drop)").is_err());
    let flip = parse("(edges: Random(count: 3, seed: 7))");
    assert_eq!(flip.seams, Seams::Refuse);
    assert_eq!(flip.on_refusal, OnRefusal::Error);
    assert_eq!((flip.until, flip.passes), (Until::Once, hundred()));
}

proptest! {
    #[test]
    fn flips_keep_counts_positions_and_the_euler_characteristic(
        count in 0..60_u32, seed in 0..1000_u64, radius in 0.2..2.0_f64,
    ) {
        let edges = EdgeSelection::Or(vec![
            EdgeSelection::Random { count, of: Box::default(), seed },
            EdgeSelection::Inside(Region::Sphere {
                center: Vector::literal(1.0, 0.0, 0.0),
                radius: Length::literal(radius),
            }),
        ]);
        let flip = FlipEdges { edges, ..parse("(edges: All, on_refusal: Skip)") };
        let before = shapes::icosahedron();
        let (after, report) = try_applied(&flip, before.clone()).unwrap();
        prop_assert_eq!(after.n_edges(), before.n_edges());
        prop_assert_eq!(after.positions(), before.positions());
        prop_assert_eq!(after.euler_characteristic(), 2);
        prop_assert!(after.is_closed());
        let refused: u64 = report.refused.iter().map(|r| r.count).sum();
        prop_assert!(report.changed + refused >= u64::from(count.min(30)));
    }
}
