//! The operation: plan, budget, refusals, progress, threads, recipes.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use mesh::{DVec2, DVec3, Mesh, UV, VERTEX_NORMAL, shapes};
use op::{Context, Files, MeshOperation, MeshPlan, NoProgress, OpError, PlanContext, Progress};

use crate::loop_subdivide::LoopSubdivide;

/// One level, by the operation.
fn once(mesh: &Mesh) -> Mesh {
    op::test::applied(&LoopSubdivide::default(), mesh.clone())
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
        pool.install(|| op::test::applied(&LoopSubdivide::levels(6), mesh.clone()))
    };
    let one = with(1);
    assert_eq!(one.n_faces(), 20 << 12);
    for threads in [2, 8] {
        let other = with(threads);
        // Equal as bits: `==` would take -0 for 0.
        let bits = |m: &Mesh| -> Vec<[u64; 3]> {
            let bits = m.positions().iter().map(|p| p.to_array().map(f64::to_bits));
            bits.collect()
        };
        assert_eq!(bits(&other), bits(&one));
        assert!(other == one);
    }
}

#[test]
fn levels_follow_one_another_and_none_changes_nothing() {
    let mesh = shapes::fans(&shapes::grid(3, 2));
    let apply = |levels| op::test::applied(&LoopSubdivide::levels(levels), mesh.clone());
    assert!(apply(0) == mesh);
    assert!(apply(3) == once(&once(&once(&mesh))));
}

#[test]
fn polygons_are_refused_and_the_first_is_named() {
    let at = |x, y| DVec3::new(x, y, 0.0);
    let points = vec![at(0., 0.), at(1., 0.), at(1., 1.), at(0., 1.), at(2., 0.)];
    let polygons = [vec![1, 4, 2], vec![0, 1, 2, 3]];
    let (mesh, _) = Mesh::from_polygons(points, &polygons).unwrap();
    let error = op::test::try_applied(&LoopSubdivide::default(), mesh).unwrap_err();
    assert_eq!(
        error.to_string(),
        "Loop subdivision needs triangles, but f1 has 4 corners"
    );
    let OpError::Refused { reason, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(reason, op::Refusal::NotTriangle);
}

#[test]
fn a_plan_knows_that_squares_will_be_refused() {
    let files = Files::default();
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: u64::MAX,
    };
    let problems = LoopSubdivide::default().plan(&mut MeshPlan::of(&shapes::cube()), &cx);
    assert_eq!(problems.len(), 1);
    assert!(problems[0].message.contains("at least 4 corners"));
}

#[test]
fn fourteen_levels_of_an_icosahedron_are_refused_before_anything_runs() {
    let operation = LoopSubdivide::levels(14);
    let error = op::test::try_applied(&operation, shapes::icosahedron()).unwrap_err();
    assert!(matches!(error, OpError::Budget(_)));
    assert!(error.to_string().ends_with("level 13 fits"), "{error}");

    let files = Files::default();
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: u64::MAX,
    };
    let mut plan = MeshPlan::of(&shapes::icosahedron());
    let problems = operation.plan(&mut plan, &cx);
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].path, ["levels"]);
    assert_eq!(problems[0].help.as_deref(), Some("level 13 fits"));
}

#[test]
fn the_budget_is_kept_by_the_plan_and_by_the_operation() {
    let mesh = shapes::icosahedron();
    let budget = once(&once(&mesh)).bytes() as u64;
    let files = Files::default();
    let run = |levels, budget| {
        let mut cx = Context::new(&NoProgress, &files);
        cx.budget = budget;
        let mut mesh = mesh.clone();
        let plan_cx = PlanContext {
            files: &files,
            on: None,
            budget,
        };
        let problems = LoopSubdivide::levels(levels).plan(&mut MeshPlan::of(&mesh), &plan_cx);
        let done = MeshOperation::apply(&LoopSubdivide::levels(levels), &mut mesh, &mut cx);
        assert_eq!(done.is_ok(), problems.is_empty());
        done
    };
    assert!(run(2, budget).is_ok());
    let error = run(2, budget - 1).unwrap_err();
    assert!(error.to_string().ends_with("level 1 fits"), "{error}");
}

#[test]
fn levels_out_of_range_are_an_error() {
    let operation = LoopSubdivide::levels(u32::MAX);
    let error = op::test::try_applied(&operation, Mesh::default()).unwrap_err();
    assert!(matches!(error, OpError::Parameter(_)));
    let files = Files::default();
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: u64::MAX,
    };
    assert_eq!(operation.plan(&mut MeshPlan::unknown(), &cx).len(), 1);
}

/// Stops after so many calls, and remembers how far it was.
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
    fn advance(&self, _: &str, done: u64, total: u64) -> bool {
        self.furthest.fetch_max(done, Relaxed);
        self.total.store(total, Relaxed);
        self.calls.fetch_add(1, Relaxed) < self.limit
    }
}

#[test]
fn it_can_be_cancelled_at_any_call_and_otherwise_arrives_at_the_end() {
    let files = Files::default();
    let run = |listener: &StopAfter| {
        let mut mesh = shapes::icosahedron();
        let mut cx = Context::new(listener, &files);
        MeshOperation::apply(&LoopSubdivide::levels(6), &mut mesh, &mut cx)
    };
    let free = StopAfter::new(u64::MAX);
    run(&free).unwrap();
    assert_eq!(free.furthest.load(Relaxed), free.total.load(Relaxed));
    let calls = free.calls.load(Relaxed);
    assert!(calls > 40, "{calls}");
    for limit in 0..calls {
        assert!(
            matches!(run(&StopAfter::new(limit)), Err(OpError::Cancelled)),
            "{limit}"
        );
    }
}

#[test]
fn a_recipe_can_leave_the_levels_out_and_nothing_else_is_taken() {
    let parsed =
        |text: &str| ron::from_str::<LoopSubdivide>(&format!("#![enable(implicit_some)]{text}"));
    assert_eq!(parsed("(levels: 3)"), Ok(LoopSubdivide::levels(3)));
    assert_eq!(parsed("()"), Ok(LoopSubdivide::default()));
    assert!(parsed("(level: 3)").is_err());
    assert!(parsed("(levels: -1)").is_err());
}

#[test]
fn normals_are_dropped_and_reported() {
    let mut mesh = shapes::octahedron();
    mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
    let (new, report) = op::test::try_applied(&LoopSubdivide::default(), mesh).unwrap();
    assert_eq!(new.get(VERTEX_NORMAL), None);
    assert_eq!(report.losses.len(), 1);
    assert_eq!(report.changed, 32);
}
