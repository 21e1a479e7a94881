//! Laws of Loop subdivision, and comparisons with two other ways to compute it.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use mesh::{
    COLOR, CREASE, Column, DVec2, DVec3, DVec4, Domain, EdgeId, FaceId, HalfEdgeId, MATERIAL, Mesh,
    Rule, UV, VERTEX_NORMAL, Values, VertexId, shapes,
};
use op::{Context, Files, MeshOperation, MeshPlan, NoProgress, OpError, PlanContext, Progress};

use crate::fixtures::{self, corners, sheet, triangles};
use crate::{LoopSubdivide, oracle, subdivide};

fn once(mesh: &Mesh) -> Mesh {
    let new = subdivide(mesh, &NoProgress).unwrap();
    assert_eq!(new.defects(), []);
    new
}

fn distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .map(|(a, b)| a.distance(*b))
        .fold(0.0, f64::max)
}

fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    for t in &mut triangles {
        while t[0] != *t.iter().min().unwrap() {
            t.rotate_left(1);
        }
    }
    triangles.sort_unstable();
    triangles
}

// ---- Other ways -------------------------------------------------------------------------------------

#[test]
fn it_is_what_splitting_all_edges_and_flipping_the_new_ones_gives() {
    // The halves of a pillow share all vertices, so flips are refused on the way.
    for (name, mesh) in fixtures::all().into_iter().filter(|(n, _)| *n != "pillow") {
        let mut old = mesh;
        for level in 1..=2 {
            let new = once(&old);
            let expected = oracle::by_splits_and_flips(&old);
            assert_eq!(expected.defects(), [], "{name} {level}");
            assert_eq!(triangles(&new), triangles(&expected), "{name} {level}");
            let far = distance(new.positions(), expected.positions());
            assert!(far < 1e-14, "{name} {level}: {far:e}");
            old = new;
        }
    }
}

#[test]
fn it_is_what_a_list_of_triangles_gives() {
    for (name, mesh) in fixtures::all() {
        // From its first level on, a pillow has two edges between the same vertices.
        let levels = if name == "pillow" { 1 } else { 2 };
        let mut old = mesh;
        for level in 1..=levels {
            let new = once(&old);
            let (positions, expected) = oracle::over_polygons_of(&old);
            assert_eq!(triangles(&new), sorted(expected), "{name} {level}");
            let far = distance(new.positions(), &positions);
            assert!(far < 1e-14, "{name} {level}: {far:e}");
            old = new;
        }
    }
}

// ---- Laws of the connectivity -----------------------------------------------------------------------

#[test]
fn invariants_hold_on_all_levels_and_the_kind_of_surface_stays() {
    for (name, mesh) in fixtures::all() {
        let mut new = mesh.clone();
        for _ in 0..3 {
            new = once(&new);
        }
        let kind = |m: &Mesh| {
            (
                m.euler_characteristic(),
                m.n_components(),
                m.n_boundary_loops(),
                m.n_isolated_vertices(),
            )
        };
        assert_eq!(kind(&new), kind(&mesh), "{name}");
        assert_eq!(new.n_faces(), 64 * mesh.n_faces(), "{name}");
    }
}

#[test]
fn elements_are_numbered_as_the_documentation_says() {
    for (name, old) in fixtures::all() {
        let new = once(&old);
        let on = |h: HalfEdgeId| VertexId::new(old.n_vertices() + h.edge().index());
        for e in old.edges() {
            let [a, b] = old.edge_vertices(e);
            let m = on(e.half_edge());
            let halves = [2 * e.index(), 2 * e.index() + 1].map(EdgeId::new);
            let ends = halves.map(|e| new.edge_vertices(e));
            assert_eq!(ends, [[a, m], [m, b]], "{name} {e}");
        }
        for f in old.faces() {
            let h: Vec<HalfEdgeId> = old.face_half_edges(f).collect();
            for k in 0..3 {
                let part = corners(&new, FaceId::new(4 * f.index() + k));
                let before = h[(k + 2) % 3];
                let expected = [old.origin(h[k]), on(h[k]), on(before)].map(fixtures::number);
                assert_eq!(part, expected, "{name} {f}");
            }
        }
        for v in old.vertices() {
            assert_eq!(new.valence(v), old.valence(v), "{name} {v}");
        }
    }
}

#[test]
fn dead_elements_are_left_out() {
    let mut mesh = sheet(3, 3);
    mesh.delete_face(FaceId::new(4)).unwrap();
    mesh.delete_face(FaceId::new(9)).unwrap();
    let mut dense = mesh.clone();
    dense.compact();
    assert!(!mesh.is_dense());
    assert_eq!(once(&mesh), once(&dense));
}

// ---- Laws of the positions --------------------------------------------------------------------------

#[test]
fn a_flat_regular_sheet_stays_on_its_grid() {
    let old = sheet(5, 4);
    let new = once(&old);
    let cut = |v: VertexId| old.has_vertex(v) && old.valence(v) <= 3 && is_corner(&old, v);
    for v in old.vertices().filter(|&v| !cut(v)) {
        assert_eq!(new.position(v), old.position(v), "{v}");
    }
    for e in old.edges() {
        let [a, b] = old.edge_vertices(e).map(|v| old.position(v));
        let m = VertexId::new(old.n_vertices() + e.index());
        assert_eq!(new.position(m), (a + b) / 2.0, "{e}");
    }
}

/// Whether `v` is one of the four corners of a sheet.
fn is_corner(mesh: &Mesh, v: VertexId) -> bool {
    let [min, max] = mesh.bounds().unwrap();
    let p = mesh.position(v);
    (p.x == min.x || p.x == max.x) && (p.y == min.y || p.y == max.y)
}

#[test]
fn subdividing_commutes_with_affine_maps() {
    let map = |p: DVec3| {
        let sheared = DVec3::new(p.x + 0.5 * p.y, 2.0 * p.y - p.z, 0.3 * p.x + p.z);
        sheared + DVec3::new(3.0, -2.0, 1.0)
    };
    for (name, mesh) in fixtures::all() {
        let mut mapped = mesh.clone();
        mapped.positions_mut().iter_mut().for_each(|p| *p = map(*p));
        let expected: Vec<DVec3> = once(&mesh).positions().iter().map(|&p| map(p)).collect();
        let far = distance(once(&mapped).positions(), &expected);
        assert!(far < 1e-13, "{name} {far:e}");
    }
}

#[test]
fn nothing_leaves_the_convex_hull() {
    let directions = (0..50).map(|i| {
        let (sin, cos) = libm::sincos(2.4 * f64::from(i));
        DVec3::new(cos, sin, f64::from(i) / 25.0 - 1.0)
    });
    let directions: Vec<DVec3> = directions.collect();
    for (name, mesh) in fixtures::all() {
        let new = once(&mesh);
        for &d in &directions {
            let reach = |m: &Mesh| {
                let along = m.positions().iter().map(|p| p.dot(d));
                along.fold(f64::NEG_INFINITY, f64::max)
            };
            assert!(reach(&new) <= reach(&mesh) + 1e-14, "{name}");
        }
    }
}

#[test]
fn the_boundary_depends_on_the_boundary_only() {
    for (name, mesh) in fixtures::all() {
        let mut inside_moved = mesh.clone();
        for v in mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)) {
            inside_moved.positions_mut()[v.index()] += DVec3::new(1.0, 2.0, 3.0);
        }
        let (new, moved) = (once(&once(&mesh)), once(&once(&inside_moved)));
        for v in new.vertices().filter(|&v| new.is_boundary_vertex(v)) {
            assert_eq!(new.position(v), moved.position(v), "{name} {v}");
        }
    }
}

#[test]
fn splitting_all_edges_at_a_vertex_halves_its_displacement() {
    for (name, mesh) in fixtures::all() {
        if name == "pillow" {
            continue; // Its two edges at a vertex go round to the same faces.
        }
        let inside = mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v));
        for v in inside.filter(|&v| mesh.vertex_half_edge(v).is_some()) {
            let mut split = mesh.clone();
            for h in mesh.vertex_half_edges(v) {
                split.split_edge(h.edge(), 0.5).unwrap();
            }
            assert_eq!(split.valence(v), mesh.valence(v));
            let displacement = |m: &Mesh| once(m).position(v) - m.position(v);
            let far = displacement(&split).distance(0.5 * displacement(&mesh));
            assert!(far < 1e-12, "{name} {v} {far:e}");
        }
    }
}

#[test]
fn a_tetrahedron_shrinks_by_the_number_that_the_mask_gives() {
    // The neighbors of p sum to -p, so p becomes (7/16 - 3/16) p, and the middle of an edge a b becomes
    // 3/8 (a + b) + 1/8 (c + d) = 1/4 (a + b).
    let old = shapes::tetrahedron();
    let new = once(&old);
    for v in old.vertices() {
        assert_eq!(new.position(v), 0.25 * old.position(v));
    }
    let [a, b] = old.edge_vertices(EdgeId::new(0)).map(|v| old.position(v));
    assert_eq!(new.position(VertexId::new(4)), 0.25 * (a + b));
}

// ---- Attributes -------------------------------------------------------------------------------------

#[test]
fn vertex_values_move_with_the_positions() {
    for (name, mut mesh) in fixtures::all() {
        let colors =
            |m: &Mesh| -> Vec<DVec4> { m.positions().iter().map(|p| p.extend(1.0)).collect() };
        mesh.set(COLOR, colors(&mesh));
        let new = once(&mesh);
        for (color, expected) in new.get(COLOR).unwrap().iter().zip(colors(&new)) {
            assert_eq!(color.truncate(), expected.truncate(), "{name}");
            assert!((color.w - 1.0).abs() < 1e-15, "{name}");
        }
    }
}

#[test]
fn texture_coordinates_that_are_affine_in_the_position_stay_so_on_a_flat_sheet() {
    let mut mesh = sheet(4, 3);
    let affine = |p: DVec3| DVec2::new(0.5 * p.x + 1.0, p.y - 0.25 * p.x);
    let uvs = mesh
        .half_edges()
        .map(|h| affine(mesh.position(mesh.origin(h))));
    mesh.set(UV, uvs.collect());
    let new = once(&mesh);
    let uvs = new.get(UV).unwrap();
    let inside = |h: HalfEdgeId| new.face(h).is_some();
    // The four corners of the sheet are rounded off.
    let rounded = |v: VertexId| mesh.has_vertex(v) && is_corner(&mesh, v);
    let mut n = 0;
    for h in new
        .half_edges()
        .filter(|&h| inside(h) && !rounded(new.origin(h)))
    {
        assert_eq!(uvs[h.index()], affine(new.position(new.origin(h))), "{h}");
        n += 1;
    }
    assert!(n > 200);
}

#[test]
fn corner_values_stay_within_their_own_triangle() {
    for (name, mut mesh) in fixtures::all() {
        // Every triangle has values of its own, so every edge is a seam.
        let value = |h: HalfEdgeId| {
            mesh.face(h).map_or(DVec2::ZERO, |f| {
                DVec2::new(f.index() as f64, (7 * h.index() % 16) as f64)
            })
        };
        let uvs: Vec<DVec2> = mesh.half_edges().map(value).collect();
        mesh.set(UV, uvs.clone());
        let new = once(&mesh);
        let new_uvs = new.get(UV).unwrap();
        let around = |m: &Mesh, f: FaceId, uvs: &[DVec2]| {
            let mut h = m.face_half_edges(f).map(|h| uvs[h.index()]);
            [(); 3].map(|()| h.next().unwrap())
        };
        for f in mesh.faces() {
            let [a, b, c] = around(&mesh, f, &uvs);
            let [x, y, z] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
            let parts = [0, 1, 2, 3].map(|k| around(&new, FaceId::new(4 * f.index() + k), new_uvs));
            assert_eq!(parts[..3], [[a, x, z], [b, y, x], [c, z, y]], "{name} {f}");
            // The middle triangle begins at z.
            assert_eq!(parts[3], [z, x, y], "{name} {f}");
        }
        for h in new.half_edges().filter(|&h| new.face(h).is_none()) {
            assert_eq!(new_uvs[h.index()], DVec2::ZERO, "{name} {h}");
        }
    }
}

#[test]
fn copied_values_go_to_the_parts_and_nowhere_else() {
    let mut mesh = sheet(2, 2);
    let n = |domain| mesh.domain_len(domain);
    let tags = |n: usize| Values::Tag((0..n).map(|i| i % 3 == 0).collect());
    let columns = Domain::ALL.map(|d| (d, tags(n(d))));
    for (domain, values) in columns {
        let name = "chosen".to_owned();
        mesh.insert_column(
            domain,
            Column {
                name,
                rule: Rule::Copy,
                values,
            },
        );
    }
    mesh.set(MATERIAL, (0..).take(mesh.n_faces()).collect());
    mesh.set(CREASE, (0..mesh.n_edges()).map(|e| e as f64).collect());
    let new = once(&mesh);

    let tag = |d| new.tag(d, "chosen").unwrap();
    for (v, &chosen) in tag(Domain::Vertex).iter().enumerate() {
        assert_eq!(chosen, v < mesh.n_vertices() && v % 3 == 0, "v{v}");
    }
    for (e, &chosen) in tag(Domain::Edge).iter().enumerate() {
        assert_eq!(chosen, e < 2 * mesh.n_edges() && (e / 2) % 3 == 0, "e{e}");
        let crease = if e < 2 * mesh.n_edges() {
            (e / 2) as f64
        } else {
            0.0
        };
        assert_eq!(new.get(CREASE).unwrap()[e], crease);
    }
    for (f, &chosen) in tag(Domain::Face).iter().enumerate() {
        assert_eq!(chosen, (f / 4) % 3 == 0, "f{f}");
        assert_eq!(new.get(MATERIAL).unwrap()[f], i32::try_from(f / 4).unwrap());
    }
    let old_corners = mesh.tag(Domain::Corner, "chosen").unwrap();
    for h in new.half_edges().filter(|&h| new.face(h).is_some()) {
        let parent = FaceId::new(new.face(h).unwrap().index() / 4);
        let at = mesh
            .face_half_edges(parent)
            .find(|&old| mesh.origin(old) == new.origin(h));
        let expected = at.is_some_and(|old| old_corners[old.index()]);
        assert_eq!(tag(Domain::Corner)[h.index()], expected, "{h}");
    }
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

// ---- The operation ----------------------------------------------------------------------------------

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
        pool.install(|| op::test::applied(&LoopSubdivide { levels: 6 }, mesh.clone()))
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
    let mesh = sheet(3, 2);
    let apply = |levels| op::test::applied(&LoopSubdivide { levels }, mesh.clone());
    assert!(apply(0) == mesh);
    assert!(apply(3) == once(&once(&once(&mesh))));
}

#[test]
fn the_plan_is_the_result_on_every_fixture() {
    let files = Files::default();
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: u64::MAX,
    };
    for (name, mesh) in fixtures::all() {
        for levels in 0..3 {
            let operation = LoopSubdivide { levels };
            let mut plan = MeshPlan::of(&mesh);
            assert_eq!(operation.plan(&mut plan, &cx), [], "{name}");
            let new = op::test::applied(&operation, mesh.clone());
            assert_eq!(plan, MeshPlan::of(&new), "{name}");
        }
    }
}

#[test]
fn polygons_are_refused_and_the_first_is_named() {
    let at = |x, y| DVec3::new(x, y, 0.0);
    let points = vec![at(0., 0.), at(1., 0.), at(1., 1.), at(0., 1.), at(2., 0.)];
    let polygons = [vec![1, 4, 2], vec![0, 1, 2, 3]];
    let (mesh, _) = Mesh::from_polygons(points, &polygons).unwrap();
    let error = subdivide(&mesh, &NoProgress).unwrap_err();
    assert_eq!(
        error.to_string(),
        "Loop subdivision needs triangles, but f1 has 4 corners"
    );
    let error = op::test::try_applied(&LoopSubdivide::default(), mesh).unwrap_err();
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
    let operation = LoopSubdivide { levels: 14 };
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
        let problems = LoopSubdivide { levels }.plan(&mut MeshPlan::of(&mesh), &plan_cx);
        let done = MeshOperation::apply(&LoopSubdivide { levels }, &mut mesh, &mut cx);
        assert_eq!(done.is_ok(), problems.is_empty());
        done
    };
    assert!(run(2, budget).is_ok());
    let error = run(2, budget - 1).unwrap_err();
    assert!(error.to_string().ends_with("level 1 fits"), "{error}");
}

#[test]
fn levels_out_of_range_are_an_error() {
    let operation = LoopSubdivide { levels: u32::MAX };
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
        MeshOperation::apply(&LoopSubdivide { levels: 6 }, &mut mesh, &mut cx)
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
    let parsed = |text| ron::from_str::<LoopSubdivide>(text);
    assert_eq!(parsed("(levels: 3)"), Ok(LoopSubdivide { levels: 3 }));
    assert_eq!(parsed("()"), Ok(LoopSubdivide { levels: 1 }));
    assert!(parsed("(level: 3)").is_err());
    assert!(parsed("(levels: -1)").is_err());
}
