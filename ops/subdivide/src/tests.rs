//! Tests of the operations: counts, plan, memory budget, refusals, progress, threads, recipes.

use std::fmt::Debug;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use geometry::shapes;
use mesh::{DVec2, DVec3, Mesh, UV, VERTEX_NORMAL};
use op::test::{applied, applied_as_planned, counts, planned, read, refused, try_applied};
use op::{
    Context, Files, MeshOperation, MeshPlan, NoProgress, OpError, PlanContext, Progress, Refusal,
};
use subdivision::Split;

use crate::{Butterfly, CatmullClark, DooSabin, LoopSubdivide, Midpoint, Sqrt3};

/// Returns an operation with the given number of levels and default parameters.
fn levels<T: MeshOperation>(levels: u32) -> T {
    read(&format!("(levels: {levels})")).unwrap()
}

#[test]
fn recipes_can_omit_the_levels_and_reject_unknown_or_invalid_parameters() {
    fn check<T: MeshOperation + Default + Debug + PartialEq>() {
        assert_eq!(read::<T>("()"), Ok(T::default()));
        assert_ne!(read::<T>("(levels: 3)"), Ok(T::default()));
        assert!(read::<T>("(levels: 16, until: EdgeLength(below: 0.1))").is_ok());
        for wrong in [
            "(level: 3)",
            "(levels: -1)",
            "(levels: 17)",
            "(until: EdgeLength(below: 0.0))",
            "(until: LimitDistance(below: NaN))",
        ] {
            assert!(read::<T>(wrong).is_err(), "{wrong}");
        }
    }
    check::<LoopSubdivide>();
    check::<CatmullClark>();
    check::<Midpoint>();
    check::<Butterfly>();
    check::<Sqrt3>();
    check::<DooSabin>();
}

#[test]
fn counts_after_one_and_two_levels_are_as_planned() {
    fn check<T: MeshOperation>(mesh: &Mesh, expected: [[usize; 3]; 2]) {
        for (n, expected) in (1..).zip(expected) {
            let new = applied_as_planned(&levels::<T>(n), mesh);
            assert_eq!(counts(&new), expected, "{} {n}", T::NAME);
        }
    }
    let [cube, icosahedron] = [shapes::cube(), shapes::icosahedron()];
    check::<LoopSubdivide>(&icosahedron, [[42, 120, 80], [162, 480, 320]]);
    check::<CatmullClark>(&cube, [[26, 48, 24], [98, 192, 96]]);
    check::<Midpoint>(&icosahedron, [[42, 120, 80], [162, 480, 320]]);
    check::<Butterfly>(&icosahedron, [[42, 120, 80], [162, 480, 320]]);
    check::<Sqrt3>(&icosahedron, [[32, 90, 60], [92, 270, 180]]);
    check::<DooSabin>(&cube, [[24, 48, 26], [96, 192, 98]]);
}

#[test]
fn schemes_for_triangles_refuse_polygons_in_the_plan() {
    fn check<T: MeshOperation + Default>() {
        let cube = shapes::cube();
        assert_eq!(refused(&T::default(), cube.clone()), Refusal::NotTriangle);
        let (_, problems) = planned(&T::default(), &cube);
        assert_eq!(problems.len(), 1);
        assert!(problems[0].message.contains("at least 4 corners"));
    }
    check::<LoopSubdivide>();
    check::<Midpoint>();
    check::<Butterfly>();
    check::<Sqrt3>();
}

#[test]
fn polygons_of_all_degrees_become_quads() {
    let new = applied_as_planned(&CatmullClark::default(), &shapes::cylinder(7, true));
    assert!(new.faces().all(|f| new.degree(f) == 4));
    assert_eq!(new.n_faces(), 7 * 4 + 2 * 7);
}

#[test]
fn midpoint_splits_a_cube_into_24_quads_of_the_same_total_area() {
    let quads = Midpoint {
        into: Split::Quads,
        ..Midpoint::default()
    };
    let new = applied_as_planned(&quads, &shapes::cube());
    assert_eq!(counts(&new), [26, 48, 24]);
    assert!((geometry::area(&new) - geometry::area(&shapes::cube())).abs() < 1e-14);
}

#[test]
fn sqrt3_cuts_a_boundary_on_every_second_level() {
    let mesh = shapes::fans(&shapes::grid(3, 2));
    let n_outer = |n| {
        let new = applied_as_planned(&levels::<Sqrt3>(n), &mesh);
        new.edges().filter(|&e| new.is_boundary_edge(e)).count()
    };
    assert_eq!([1, 2, 3, 4].map(n_outer), [10, 30, 30, 90]);
}

/// Applies one level of Loop subdivision.
fn once(mesh: &Mesh) -> Mesh {
    applied(&LoopSubdivide::default(), mesh.clone())
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads() {
    let mut mesh = shapes::icosahedron();
    mesh.set(
        UV,
        (0..60).map(|i| DVec2::splat(f64::from(i) / 7.0)).collect(),
    );
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| applied(&levels::<LoopSubdivide>(6), mesh.clone()))
    };
    let one = with(1);
    assert_eq!(one.n_faces(), 20 << 12);
    for threads in [2, 8] {
        let other = with(threads);
        // The test compares bits, because `==` treats -0 and 0 as equal.
        let bits = |m: &Mesh| -> Vec<[u64; 3]> {
            let bits = m.positions().iter().map(|p| p.to_array().map(f64::to_bits));
            bits.collect()
        };
        assert_eq!(bits(&other), bits(&one));
        assert!(other == one);
    }
}

#[test]
fn levels_can_be_computed_one_by_one_and_zero_levels_change_nothing() {
    let mesh = shapes::fans(&shapes::grid(3, 2));
    let apply = |n| applied(&levels::<LoopSubdivide>(n), mesh.clone());
    assert!(apply(0) == mesh);
    assert!(apply(3) == once(&once(&once(&mesh))));
}

#[test]
fn the_refusal_names_the_first_polygon() {
    let at = |x, y| DVec3::new(x, y, 0.0);
    let points = vec![at(0., 0.), at(1., 0.), at(1., 1.), at(0., 1.), at(2., 0.)];
    let polygons = [vec![1, 4, 2], vec![0, 1, 2, 3]];
    let (mesh, _) = Mesh::from_polygons(points, &polygons).unwrap();
    let error = try_applied(&LoopSubdivide::default(), mesh).unwrap_err();
    assert_eq!(
        error.to_string(),
        "Loop subdivision needs triangles, but f1 has 4 corners; triangulate the faces first, with Triangulate"
    );
    let OpError::Refused { reason, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(reason, Refusal::NotTriangle);
}

#[test]
fn fourteen_levels_of_an_icosahedron_are_refused_before_anything_runs() {
    let operation = levels::<LoopSubdivide>(14);
    let error = try_applied(&operation, shapes::icosahedron()).unwrap_err();
    assert!(matches!(error, OpError::Budget(_)));
    assert!(
        error
            .to_string()
            .ends_with("the highest level that fits is 13"),
        "{error}"
    );

    let (_, problems) = planned(&operation, &shapes::icosahedron());
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].path, ["levels"]);
    assert_eq!(
        problems[0].help.as_deref(),
        Some("the highest level that fits is 13")
    );
}

#[test]
fn the_plan_and_the_operation_keep_the_memory_budget() {
    let mesh = shapes::icosahedron();
    let budget = once(&once(&mesh)).bytes() as u64;
    let files = Files::default();
    let run = |n, budget| {
        let mut cx = Context::new(&NoProgress, &files);
        cx.budget = budget;
        let mut mesh = mesh.clone();
        let plan_cx = PlanContext {
            files: &files,
            on: None,
            budget,
        };
        let problems = levels::<LoopSubdivide>(n).plan(&mut MeshPlan::of(&mesh), &plan_cx);
        let result = MeshOperation::apply(&levels::<LoopSubdivide>(n), &mut mesh, &mut cx);
        assert_eq!(result.is_ok(), problems.is_empty());
        result
    };
    assert!(run(2, budget).is_ok());
    let error = run(2, budget - 1).unwrap_err();
    assert!(
        error
            .to_string()
            .ends_with("the highest level that fits is 1"),
        "{error}"
    );
}

/// Receives progress reports, cancels the run after `limit` calls, and records the largest progress.
struct StopAfter {
    calls: AtomicU64,
    furthest: AtomicU64,
    total: AtomicU64,
    limit: u64,
}

impl StopAfter {
    fn new(limit: u64) -> Self {
        let zero = || AtomicU64::new(0);
        Self {
            calls: zero(),
            furthest: zero(),
            total: zero(),
            limit,
        }
    }
}

impl Progress for StopAfter {
    fn advance(&self, _: &str, result: u64, total: u64) -> bool {
        self.furthest.fetch_max(result, Relaxed);
        self.total.store(total, Relaxed);
        self.calls.fetch_add(1, Relaxed) < self.limit
    }
}

#[test]
fn every_progress_call_can_cancel_and_progress_reaches_the_total() {
    let files = Files::default();
    let run = |listener: &StopAfter| {
        let mut mesh = shapes::icosahedron();
        let mut cx = Context::new(listener, &files);
        MeshOperation::apply(&levels::<LoopSubdivide>(6), &mut mesh, &mut cx)
    };
    let unlimited = StopAfter::new(u64::MAX);
    run(&unlimited).unwrap();
    assert_eq!(
        unlimited.furthest.load(Relaxed),
        unlimited.total.load(Relaxed)
    );
    let calls = unlimited.calls.load(Relaxed);
    assert!(calls > 40, "{calls}");
    for limit in 0..calls {
        assert!(
            matches!(run(&StopAfter::new(limit)), Err(OpError::Cancelled)),
            "{limit}"
        );
    }
}

#[test]
fn normals_are_dropped_and_reported() {
    let mut mesh = shapes::octahedron();
    mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
    let (new, report) = try_applied(&LoopSubdivide::default(), mesh).unwrap();
    assert_eq!(new.get(VERTEX_NORMAL), None);
    assert_eq!(report.losses.len(), 1);
    assert_eq!(report.changed, 32);
}
