//! Running one operation in a test.

use mesh::Mesh;
use scene::{Object, Scene};

use crate::{
    Context, Files, MeshOperation, MeshPlan, NoProgress, OpError, Operation, Plan, PlanContext,
    PlannedGeometry, Problem, Refusal, Report,
};

/// Reads the parameters of an operation as recipes write them: `(levels: 2)`.
pub use ron_tree::from_str as read;

/// The mesh after `operation`.
///
/// # Panics
///
/// If the operation fails, or leaves a mesh that breaks an invariant.
#[expect(clippy::needless_pass_by_value, reason = "reads better in tests")]
pub fn applied(operation: &impl Operation, mesh: Mesh) -> Mesh {
    try_applied(operation, mesh.clone())
        .expect("the operation succeeds")
        .0
}

/// The mesh after `operation`, and its report.
///
/// # Errors
///
/// What the operation returns.
///
/// # Panics
///
/// If the operation leaves a mesh that breaks an invariant.
pub fn try_applied(operation: &impl Operation, mesh: Mesh) -> Result<(Mesh, Report), OpError> {
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("mesh", mesh))
        .expect("the first object");
    let report = run(operation, &mut scene)?;
    let mesh = scene
        .object("mesh")
        .and_then(Object::as_mesh)
        .expect("the mesh is still there");
    assert_eq!(mesh.defects(), [], "the operation leaves a valid mesh");
    Ok((mesh.as_ref().clone(), report))
}

/// Runs `operation` on a scene, in the working directory and without a budget.
///
/// # Errors
///
/// What the operation returns.
pub fn run(operation: &impl Operation, scene: &mut Scene) -> Result<Report, OpError> {
    let files = Files {
        input: ".".into(),
        output: "out".into(),
        ..Files::default()
    };
    operation.apply(scene, &mut Context::new(&NoProgress, &files))
}

/// The one mesh that a source makes in an empty scene.
///
/// # Panics
///
/// If the operation fails, makes another number of objects, its plan has problems or other counts than
/// the mesh, or the mesh breaks an invariant.
pub fn made(operation: &impl Operation) -> Mesh {
    let files = Files::default();
    let mut plan = Plan::default();
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: u64::MAX,
    };
    let problems = operation.plan(&mut plan, &cx);
    assert!(
        problems.iter().all(|p| p.is_warning),
        "the plan has problems: {problems:?}"
    );

    let mut scene = Scene::new();
    run(operation, &mut scene).expect("the operation succeeds");
    let ([object], [planned]) = (scene.objects(), plan.objects()) else {
        panic!("a source makes one object");
    };
    let mesh = object.as_mesh().expect("the object is a mesh");
    assert_eq!(mesh.defects(), [], "the source makes a valid mesh");
    assert_eq!(planned.name, object.name);
    assert_eq!(planned.geometry, PlannedGeometry::Mesh(MeshPlan::of(mesh)));
    mesh.as_ref().clone()
}

/// What `operation` says of a mesh before it runs: the plan after it, and the problems.
pub fn planned(operation: &impl MeshOperation, mesh: &Mesh) -> (MeshPlan, Vec<Problem>) {
    let files = Files::default();
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: u64::MAX,
    };
    let mut plan = MeshPlan::of(mesh);
    let problems = MeshOperation::plan(operation, &mut plan, &cx);
    (plan, problems)
}

/// The mesh after `operation`, whose counts and degrees were planned.
///
/// # Panics
///
/// As [`applied`], and if they are outside of the plan.
pub fn applied_as_planned(operation: &impl MeshOperation, mesh: &Mesh) -> Mesh {
    let new = applied(operation, mesh.clone());
    assert!(is_as_planned(operation, mesh, &new), "the plan holds");
    new
}

/// The numbers of vertices, edges and faces.
pub fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

/// Whether the counts and degrees of `after`, which `operation` made of `before`, are within its plan.
pub fn is_as_planned(operation: &impl MeshOperation, before: &Mesh, after: &Mesh) -> bool {
    let (plan, _) = planned(operation, before);
    plan.vertices.contains(after.n_vertices() as u64)
        && plan.edges.contains(after.n_edges() as u64)
        && plan.faces.contains(after.n_faces() as u64)
        && after
            .faces()
            .all(|f| plan.degrees.contains(after.degree(f) as u64))
}

/// The reason for which `operation` is refused.
///
/// # Panics
///
/// If it is done, or fails in another way.
pub fn refused(operation: &impl Operation, mesh: Mesh) -> Refusal {
    match try_applied(operation, mesh) {
        Err(OpError::Refused { reason, .. }) => reason,
        other => panic!("expected a refusal, got {other:?}"),
    }
}
