//! Tests on any surface: compares flips with energies that are computed here over the whole mesh.

use geometry::shapes;
use mesh::{Attribute, DVec2, DVec3, EdgeId, Mesh, Rule, UV};
use op::test::{applied, try_applied};
use op::{Context, Files, NoProgress, Refusal, Report};
use proptest::prelude::*;

use super::parse;
use crate::flip_edges::goal::Goal;
use crate::flip_edges::until::flip_until;
use crate::flip_edges::{FlipEdges, Until};

const UNLIMITED_PASSES: u32 = 100_000;

/// Returns the number of zero-area triangles, and the sum of the cotangents of the angles of all other triangles.
fn energy(mesh: &Mesh) -> (usize, f64) {
    let mut without_area = 0;
    let mut sum = 0.0;
    for f in mesh.faces() {
        if mesh.area_vector(f) == DVec3::ZERO {
            without_area += 1;
            continue;
        }
        for h in mesh.face_half_edges(f) {
            let p = mesh.position(mesh.origin(h));
            let to_next = mesh.position(mesh.target(h)) - p;
            let to_last = mesh.position(mesh.origin(mesh.prev(h))) - p;
            sum += to_next.dot(to_last) / to_next.cross(to_last).length();
        }
    }
    (without_area, sum)
}

/// Returns the sum over all vertices of (valence - target)².
fn irregularity(mesh: &Mesh) -> u64 {
    let squares = mesh.vertices().map(|v| {
        let target = if mesh.is_boundary_vertex(v) { 4 } else { 6 };
        let difference = mesh.valence(v).abs_diff(target) as u64;
        difference * difference
    });
    squares.sum()
}

/// Whether a flip is an improvement and does not fold the surface. `old` is the mesh before the flip of the edge `e`,
/// and `new` is the mesh after the flip.
fn is_better(until: Until, e: EdgeId, new: &Mesh, old: &Mesh) -> bool {
    let areas = |mesh: &Mesh| mesh.edge_faces(e).map(|f| mesh.area_vector(f.unwrap()));
    let [n, m] = areas(new);
    if areas(old) == [DVec3::ZERO; 2] && [n, m] == [DVec3::ZERO; 2] {
        // All four corners are collinear.
        let length = |mesh: &Mesh| mesh.length(e.half_edge());
        return until == Until::Delaunay && length(new) < length(old);
    }
    let is_less = match until {
        Until::Once => false,
        Until::Delaunay => {
            let ((flat, sum), (old_flat, old_sum)) = (energy(new), energy(old));
            // The tolerance covers the rounding error of sums of a few hundred terms.
            flat < old_flat || flat == old_flat && sum < old_sum - 1e-9 * old_sum.abs()
        }
        Until::Valence => irregularity(new) < irregularity(old),
    };
    // The normals of both new triangles are nonzero and point to the same side.
    is_less && n.dot(n + m) > 0.0 && m.dot(n + m) > 0.0
}

/// Flips edges until the goal is reached, and checks after each flip that it improved the whole mesh.
fn flip_with_checks(mesh: &mut Mesh, until: Until) -> Report {
    let goal = match until {
        Until::Valence => Goal::valence(mesh),
        _ => Goal::Delaunay,
    };
    let edges: Vec<EdgeId> = mesh.edges().collect();
    let files = Files::default();
    let cx = Context::new(&NoProgress, &files);
    let flip = |mesh: &mut Mesh, e| {
        let before = mesh.clone();
        mesh.flip_edge(e)?;
        assert!(is_better(until, e, mesh, &before), "the flip of {e}");
        Ok(())
    };
    flip_until(mesh, &edges, goal, UNLIMITED_PASSES, &cx, flip).unwrap()
}

/// Returns every edge whose flip would improve the mesh.
fn remaining_improvements(mesh: &Mesh, until: Until) -> Vec<EdgeId> {
    let improves = |&e: &EdgeId| {
        let mut flipped = mesh.clone();
        flipped.flip_edge(e).is_ok() && is_better(until, e, &flipped, mesh)
    };
    mesh.edges().filter(improves).collect()
}

/// Generates triangle meshes. Up to 20 vertices get small integer coordinates, so that many vertices coincide or are
/// collinear. Then some edges are flipped.
fn surfaces() -> impl Strategy<Value = Mesh> {
    let shapes = [
        shapes::fans(&shapes::torus(5, 4, 2.0, 1.0)),
        shapes::fans(&shapes::grid(4, 3)),
        shapes::fans(&shapes::cylinder(6, true)),
        shapes::icosahedron(),
    ];
    let coordinates = prop::collection::vec(prop::array::uniform3(-3..=3_i32), 20);
    let flipped = prop::collection::vec(0..60_usize, 0..60);
    let shape = prop::sample::select(shapes.to_vec());
    (shape, coordinates, flipped).prop_map(|(mut mesh, coordinates, flipped)| {
        for (p, at) in mesh.positions_mut().iter_mut().zip(coordinates) {
            *p = DVec3::from_array(at.map(f64::from));
        }
        for e in flipped.into_iter().map(EdgeId::new) {
            // Refused flips are ignored.
            let _ = mesh.flip_edge(e);
        }
        mesh
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn each_flip_improves_the_mesh_until_no_flip_does(
        mesh in surfaces(), until in prop::sample::select(vec![Until::Delaunay, Until::Valence]),
    ) {
        let mut mesh = mesh;
        flip_with_checks(&mut mesh, until);
        prop_assert_eq!(mesh.defects(), []);
        prop_assert_eq!(remaining_improvements(&mesh, until), []);
        // A second run of the operation changes nothing.
        let at_goal = mesh.clone();
        let report = flip_with_checks(&mut mesh, until);
        prop_assert_eq!(report.changed, 0);
        prop_assert_eq!(mesh, at_goal);
    }
}

/// Returns a torus with displaced vertices and half of its edges flipped.
fn rough_torus(around: u32, across: u32) -> Mesh {
    let mut mesh = shapes::fans(&shapes::torus(around, across, 2.0, 1.0));
    let size = 2.0 / f64::from(around);
    for (i, p) in (0..).zip(mesh.positions_mut()) {
        let noise = |k: u32| f64::from((k * 7919) % 1009) / 1009.0 - 0.5;
        *p += size * DVec3::new(noise(i), noise(i + 300), noise(i + 700));
    }
    let count = mesh.n_edges() / 2;
    let flip = format!("(edges: Random(count: {count}, seed: 3), on_refusal: Skip)");
    applied(&parse(&flip), mesh)
}

fn delaunay() -> FlipEdges {
    parse("(edges: All, until: Delaunay)")
}

#[test]
fn a_second_run_on_a_large_torus_changes_nothing() {
    for until in ["Delaunay", "Valence"] {
        let flip = parse(&format!("(edges: All, until: {until})"));
        let (mesh, report) = try_applied(&flip, rough_torus(250, 200)).unwrap();
        assert!(report.changed > 10_000, "{report:?}");
        let [note] = &report.notes[..] else {
            panic!("one note: {report:?}");
        };
        assert!(
            note.ends_with("improve the mesh") && !note.contains("more passes"),
            "{note}"
        );
        assert_eq!(applied(&flip, rough_torus(250, 200)), mesh);
        let (twice, report) = try_applied(&flip, mesh.clone()).unwrap();
        assert_eq!((twice, report.changed), (mesh, 0));
    }
}

#[test]
fn a_flipped_edge_of_a_regular_mesh_is_flipped_back_for_the_valence() {
    let mut regular = shapes::fans(&shapes::torus(7, 6, 2.0, 1.0));
    regular.flip_edge(EdgeId::new(50)).unwrap();
    assert_eq!(irregularity(&regular), 4);
    let (mesh, report) =
        try_applied(&parse("(edges: All, until: Valence)"), regular.clone()).unwrap();
    assert_eq!((report.changed, irregularity(&mesh)), (1, 0));
    regular.flip_edge(EdgeId::new(50)).unwrap();
    assert_eq!(
        mesh.edge_vertices(EdgeId::new(50)),
        regular.edge_vertices(EdgeId::new(50))
    );
}

#[test]
fn edges_that_are_not_selected_are_not_flipped() {
    let mut mesh = rough_torus(20, 12);
    let kept = Attribute::<EdgeId, bool>::new("kept", Rule::Copy);
    mesh.set(kept, mesh.edges().map(|e| e.index() % 3 == 0).collect());
    let flip = parse("(edges: Not(Tagged(\"kept\")), until: Delaunay)");
    let (flipped, report) = try_applied(&flip, mesh.clone()).unwrap();
    assert!(report.changed > 50);
    for e in mesh.edges().filter(|e| e.index() % 3 == 0) {
        assert_eq!(flipped.edge_vertices(e), mesh.edge_vertices(e));
    }
}

#[test]
fn refused_flips_at_seams_are_counted() {
    let mut mesh = rough_torus(20, 12);
    let uvs = |h| match mesh.face(h) {
        Some(f) if f.index() < 200 => DVec2::X,
        _ => DVec2::ZERO,
    };
    mesh.set(UV, mesh.half_edges().map(uvs).collect());
    let seams: Vec<EdgeId> = mesh.edges().filter(|&e| mesh.is_seam(e)).collect();
    assert!(seams.len() > 20);

    let (kept, report) = try_applied(&delaunay(), mesh.clone()).unwrap();
    assert!(report.changed > 50);
    let refused = report.refused.iter().find(|r| r.reason == Refusal::Seam);
    let refused = refused.expect("some flips at seams would help");
    assert!((1..=seams.len() as u64).contains(&refused.count));
    assert!(refused.first.contains("Between("), "{}", refused.first);
    for &e in &seams {
        assert!(kept.is_seam(e));
        assert_eq!(kept.edge_vertices(e), mesh.edge_vertices(e));
    }

    let drop = parse("(edges: All, until: Delaunay, seams: Drop)");
    let (_, report) = try_applied(&drop, mesh).unwrap();
    assert!(report.notes.iter().any(|note| note.starts_with("flipped ")));
    assert!(report.refused.iter().all(|r| r.reason != Refusal::Seam));
}

#[test]
fn an_improving_flip_that_is_refused_is_counted() {
    // A short edge already joins the corners opposite to the long edge.
    let mut sliver = shapes::tetrahedron();
    let positions = [(-9., 0., 0.), (9., 0., 0.), (0., 1., -0.1), (0., -1., -0.1)];
    for (p, at) in sliver.positions_mut().iter_mut().zip(positions) {
        *p = DVec3::from(at);
    }
    let (mesh, report) = try_applied(&delaunay(), sliver.clone()).unwrap();
    assert_eq!(mesh, sliver);
    let [refused] = &report.refused[..] else {
        panic!("one reason: {report:?}");
    };
    assert_eq!(refused.reason, Refusal::DuplicateEdge);
    assert!(refused.first.contains("Between("), "{}", refused.first);
}

#[test]
fn edges_of_polygons_are_refused_and_counted() {
    let (mesh, report) = try_applied(&delaunay(), shapes::cube()).unwrap();
    assert_eq!(mesh, shapes::cube());
    let counts: Vec<_> = report.refused.iter().map(|r| (r.reason, r.count)).collect();
    assert_eq!(counts, [(Refusal::NotTriangle, 12)]);
}

#[test]
fn a_second_run_has_the_same_refusals() {
    let (mesh, report) = try_applied(&delaunay(), rough_torus(30, 20)).unwrap();
    assert_eq!(
        remaining_improvements(&mesh, Until::Delaunay),
        [],
        "{report:?}"
    );
    let (_, second_report) = try_applied(&delaunay(), mesh).unwrap();
    assert_eq!(second_report.refused, report.refused);
}

#[test]
fn a_step_that_reaches_the_limit_of_passes_reports_it() {
    let once = parse("(edges: All, until: Delaunay, passes: 1)");
    let (mesh, report) = try_applied(&once, rough_torus(20, 12)).unwrap();
    assert!(
        report.notes[0].starts_with("passes: 1, which is the limit"),
        "{report:?}"
    );
    let (_, more) = try_applied(&delaunay(), mesh).unwrap();
    assert!(more.changed > 0);
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let scaled = |scale: f64| {
        let mut mesh = rough_torus(20, 12);
        for p in mesh.positions_mut() {
            *p *= scale;
        }
        mesh
    };
    for until in ["Delaunay", "Valence"] {
        let flip = parse(&format!("(edges: All, until: {until})"));
        let expected = applied(&flip, scaled(1.0));
        // Multiplying coordinates by a power of two causes no rounding error.
        for scale in [1_f64 / (1_u64 << 40) as f64, (1_u64 << 40) as f64] {
            for scale in [scale, scale * scale, scale * scale * scale] {
                let mesh = applied(&flip, scaled(scale));
                assert_eq!(mesh.connectivity(), expected.connectivity());
            }
        }
        // Meshes that are too small or too large to compute do not change.
        for scale in [0.0, 1e-300, 1e-160, 1e-80, 1e80, 1e160, 1e300] {
            assert_eq!(applied(&flip, scaled(scale)), scaled(scale), "{scale}");
        }
    }
}
