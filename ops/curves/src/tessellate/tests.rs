use super::*;
use mesh::VertexId;
use op::{Files, NoProgress, Progress};
use scene::Object;

/// Returns a patch over the unit square. `height(row, column)` is the height of a control point.
fn hill(height: impl Fn(usize, usize) -> f64) -> Patch {
    let third = |i: usize| i as f64 / 3.0;
    let point = |r: usize, c: usize| DVec3::new(third(c), third(r), height(r, c));
    Patch::new([0, 1, 2, 3].map(|r| [0, 1, 2, 3].map(|c| point(r, c)))).unwrap()
}

/// Returns a patch with collapsed sides: bits 0 to 3 of `mask` stand for the sides v = 0, u = 1, v = 1, u = 0.
fn collapsed(mask: u32) -> Patch {
    let mut points = *hill(|r, c| ((r * 5 + c * 3) % 7) as f64 * 0.1).points();
    // The loop collapses each side of `mask` twice. After only one pass, two adjacent collapsed sides could still have
    // different points.
    for _ in 0..2 {
        for k in (0..4).filter(|k| mask & (1 << k) != 0) {
            let side = [0, 1, 2, 3].map(|i| [(0, i), (i, 3), (3, 3 - i), (3 - i, 0)][k]);
            let (r, c) = side[0];
            let point = points[r][c];
            for (r, c) in side {
                points[r][c] = point;
            }
        }
    }
    Patch::new(points).unwrap()
}

fn scene_of(patches: Vec<Patch>) -> Scene {
    let mut scene = Scene::new();
    scene
        .insert(Object::new("pot", Geometry::Patches(patches)))
        .unwrap();
    scene
}

fn parse(text: &str) -> Tessellate {
    op::test::read(text).unwrap()
}

fn run(operation: &Tessellate, patches: Vec<Patch>) -> (Mesh, Report) {
    let mut scene = scene_of(patches);
    let report = op::test::run(operation, &mut scene).unwrap();
    let mesh = scene.object("pot").unwrap().as_mesh().unwrap();
    assert_eq!(mesh.defects(), []);
    (mesh.as_ref().clone(), report)
}

fn problems(operation: &Tessellate, plan: &mut Plan, on: Option<&[String]>) -> Vec<Problem> {
    let files = Files::default();
    let cx = PlanContext {
        files: &files,
        on,
        budget: u64::MAX,
    };
    operation.plan(plan, &cx)
}

fn patches_plan(n: u64) -> Plan {
    let mut plan = Plan::default();
    plan.insert("pot", PlannedGeometry::Patches(Range::exactly(n)));
    plan
}

#[test]
fn a_flat_patch_becomes_a_regular_grid() {
    let (mesh, report) = run(
        &parse("(segments: 4, faces: Quads)"),
        vec![hill(|_, _| 0.0)],
    );
    assert_eq!(
        (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
        (25, 40, 16)
    );
    assert_eq!(report, Report::changed(16));
    assert!((geometry::area(&mesh) - 1.0).abs() < 1e-15);
    for (p, i) in mesh.positions().iter().zip(0..) {
        let expected = DVec3::new(f64::from(i % 5) / 4.0, f64::from(i / 5) / 4.0, 0.0);
        assert!(p.distance(expected) < 1e-15);
    }
}

#[test]
fn counts_are_within_the_plan_for_all_sets_of_collapsed_sides() {
    for mask in 0..16 {
        for n in 1..6 {
            for faces in [Faces::Triangles, Faces::Quads] {
                let operation = Tessellate {
                    segments: Count::literal(n),
                    faces,
                    ..parse("(uvs: true, normals: true)")
                };
                let (mesh, _) = run(&operation, vec![collapsed(mask)]);
                let plan = operation.planned(1);
                let case = format!("sides {mask:04b}, {n} segments, {faces:?}");
                assert!(plan.vertices.contains(mesh.n_vertices() as u64), "{case}");
                assert!(plan.edges.contains(mesh.n_edges() as u64), "{case}");
                assert!(plan.faces.contains(mesh.n_faces() as u64), "{case}");
                let is_planned = |f| plan.degrees.contains(mesh.degree(f) as u64);
                assert!(mesh.faces().all(is_planned), "{case}");
                assert_eq!(MeshPlan::of(&mesh).attributes.len(), plan.attributes.len());
            }
        }
    }
    let plan = parse("(segments: 5)").planned(1);
    let (mesh, _) = run(&parse("(segments: 5)"), vec![collapsed(0)]);
    assert_eq!(plan.edges.max, mesh.n_edges() as u64);
}

#[test]
fn the_mesh_has_no_attributes_by_default() {
    let (mesh, _) = run(&parse("()"), vec![hill(|r, c| (r * c) as f64)]);
    assert_eq!(mesh.n_faces(), 128);
    assert_eq!(mesh.attributes().iter().count(), 0);
}

#[test]
fn uvs_and_normals_are_those_of_the_patch() {
    let patch = hill(|r, c| (r * c) as f64 * 0.1);
    let (mesh, _) = run(
        &parse("(segments: 3, uvs: true, normals: true)"),
        vec![patch],
    );
    let (uvs, normals) = (mesh.get(UV).unwrap(), mesh.get(VERTEX_NORMAL).unwrap());
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        let (uv, v) = (uvs[h.index()], mesh.origin(h));
        assert!(patch.point(uv.x, uv.y).distance(mesh.position(v)) < 1e-14);
        assert!(patch.normal(uv.x, uv.y).distance(normals[v.index()]) < 1e-12);
    }
}

#[test]
fn vertices_are_in_the_order_of_patches_and_not_shared() {
    let (mesh, _) = run(
        &parse("(segments: 2)"),
        vec![hill(|_, _| 0.0), hill(|_, _| 1.0)],
    );
    assert_eq!((mesh.n_vertices(), geometry::n_components(&mesh)), (18, 2));
    assert_eq!(mesh.position(VertexId::new(9)), DVec3::Z);
}

#[test]
fn empty_patches_are_reported_and_no_patches_give_an_empty_mesh() {
    let point = Patch::new([[DVec3::ONE; 4]; 4]).unwrap();
    let (mesh, report) = run(&parse("()"), vec![point, hill(|_, _| 0.0), point]);
    assert_eq!(mesh.n_faces(), 128);
    assert_eq!(
        report.notes,
        ["zero-area patches, which give no faces: 2 (the first is patch 0)"]
    );
    assert_eq!(run(&parse("()"), Vec::new()).0, Mesh::default());
}

#[test]
fn other_objects_do_not_change_and_objects_in_on_must_be_patches() {
    let mut scene = scene_of(vec![hill(|_, _| 0.0)]);
    scene
        .insert(Object::mesh("cube", geometry::shapes::cube()))
        .unwrap();
    let before = scene.clone();
    op::test::run(&parse("()"), &mut scene).unwrap();
    assert_eq!(scene.object("cube"), before.object("cube"));
    assert_eq!(scene.objects()[0].name, "pot");

    let files = Files::default();
    let on = ["cube".to_owned()];
    let mut cx = Context::new(&NoProgress, &files);
    cx.on = Some(&on);
    let error = parse("()").apply(&mut before.clone(), &mut cx).unwrap_err();
    assert_eq!(
        error.to_string(),
        "Tessellate cuts patches, but the type of \"cube\" is mesh"
    );
    let mut plan = patches_plan(1);
    plan.insert("cube", PlannedGeometry::Mesh(MeshPlan::unknown()));
    let problems = problems(&parse("()"), &mut plan, Some(&on));
    assert_eq!(problems[0].message, error.to_string());
}

#[test]
fn the_plan_turns_patches_into_a_mesh() {
    let mut plan = patches_plan(32);
    assert_eq!(
        problems(&parse("(segments: 10, uvs: true)"), &mut plan, None),
        []
    );
    let PlannedGeometry::Mesh(mesh) = &plan.objects()[0].geometry else {
        panic!("a mesh");
    };
    assert_eq!(mesh.faces, Range::at_most(6400));
    assert!(mesh.is_triangles());
    assert_eq!(mesh.attributes[0].name, "uv");
    // The plan now has no patches left, so planning the step again reports a problem.
    assert_eq!(problems(&parse("()"), &mut plan, None).len(), 1);
}

#[test]
fn too_many_elements_are_refused_before_anything_is_computed() {
    let many = vec![hill(|_, _| 0.0); 50];
    let result = op::test::run(&parse("(segments: 4096)"), &mut scene_of(many));
    assert!(matches!(result, Err(OpError::Parameter(_))), "{result:?}");

    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    cx.budget = 1000;
    let result = parse("()").apply(&mut scene_of(vec![hill(|_, _| 0.0)]), &mut cx);
    assert!(matches!(result, Err(OpError::Budget(_))), "{result:?}");
}

#[test]
fn it_can_be_cancelled_between_patches() {
    struct CancelAfterFirst;
    impl Progress for CancelAfterFirst {
        fn advance(&self, _: &str, done: u64, _: u64) -> bool {
            done < 1
        }
    }
    let files = Files::default();
    let mut scene = scene_of(vec![hill(|_, _| 0.0); 3]);
    let mut cx = Context::new(&CancelAfterFirst, &files);
    let result = parse("()").apply(&mut scene, &mut cx);
    assert!(matches!(result, Err(OpError::Cancelled)));
}

#[test]
fn all_parameters_have_defaults() {
    let operation = parse("()");
    assert_eq!(
        (operation.segments, operation.faces),
        (eight(), Faces::Triangles)
    );
    assert!(!operation.uvs && !operation.normals);
    assert!(op::test::read::<Tessellate>("(faces: Hexagons)").is_err());
    assert!(op::test::read::<Tessellate>("(segment: 8)").is_err());
}
