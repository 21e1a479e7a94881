//! Helpers for tests that run one operation.

use mesh::Mesh;
use scene::{Object, Scene};

use crate::{
    Context, Files, MeshOperation, MeshPlan, NoProgress, OpError, Operation, Plan, PlanContext,
    PlannedGeometry, Problem, Refusal, Report,
};

/// Reads the parameters of an operation from text in the form used in recipes, such as `(levels: 2)`.
pub use ron_tree::from_str as read;

/// Applies `operation` to a mesh and returns the resulting mesh.
///
/// # Panics
///
/// Panics if the operation fails, or the resulting mesh breaks an invariant.
#[expect(clippy::needless_pass_by_value, reason = "reads better in tests")]
pub fn applied(operation: &impl Operation, mesh: Mesh) -> Mesh {
    try_applied(operation, mesh.clone())
        .expect("the operation succeeds")
        .0
}

/// Applies `operation` to a mesh, and returns the resulting mesh and the report.
///
/// # Errors
///
/// Returns the error of the operation.
///
/// # Panics
///
/// Panics if the resulting mesh breaks an invariant.
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

/// Runs `operation` on a scene. Files are read relative to the working directory, and the memory budget is unlimited.
///
/// # Errors
///
/// Returns the error of the operation.
pub fn run(operation: &impl Operation, scene: &mut Scene) -> Result<Report, OpError> {
    let files = Files {
        input: ".".into(),
        output: "out".into(),
        ..Files::default()
    };
    operation.apply(scene, &mut Context::new(&NoProgress, &files))
}

/// Runs an operation that creates an object in an empty scene, and returns the mesh of the object.
///
/// # Panics
///
/// Panics if the operation fails or does not create exactly one object. Also panics if the plan of the operation has
/// errors or differs from the mesh, or if the mesh breaks an invariant.
pub fn made(operation: &impl Operation) -> Mesh {
    let files = Files::default();
    let mut plan = Plan::default();
    let cx = PlanContext::new(&files);
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
    // Materials belong to the object, not to the mesh, so `MeshPlan::of` does not know them.
    let materials = Some(object.materials.iter().map(|m| m.name.clone()).collect());
    let expected = MeshPlan {
        materials,
        ..MeshPlan::of(mesh)
    };
    assert_eq!(planned.geometry, PlannedGeometry::Mesh(expected));
    mesh.as_ref().clone()
}

/// Plans `operation` on a mesh. Returns the plan of the resulting mesh and the problems of the step.
pub fn planned(operation: &impl MeshOperation, mesh: &Mesh) -> (MeshPlan, Vec<Problem>) {
    let files = Files::default();
    let cx = PlanContext::new(&files);
    let mut plan = MeshPlan::of(mesh);
    let problems = MeshOperation::plan(operation, &mut plan, &cx);
    (plan, problems)
}

/// Applies `operation` to a mesh, checks the counts and degrees of the resulting mesh against the plan, and returns
/// this mesh.
///
/// # Panics
///
/// Panics in the same cases as [`applied`]. Also panics if a count or a degree is outside of its planned range.
pub fn applied_as_planned(operation: &impl MeshOperation, mesh: &Mesh) -> Mesh {
    let new = applied(operation, mesh.clone());
    assert!(is_as_planned(operation, mesh, &new), "the plan holds");
    new
}

/// Returns the number of vertices, of edges, and of faces.
pub fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

/// Whether the counts and degrees of the mesh `after` are within their planned ranges. `operation` created `after` from
/// `before`.
pub fn is_as_planned(operation: &impl MeshOperation, before: &Mesh, after: &Mesh) -> bool {
    let (plan, _) = planned(operation, before);
    plan.vertices.contains(after.n_vertices() as u64)
        && plan.edges.contains(after.n_edges() as u64)
        && plan.faces.contains(after.n_faces() as u64)
        && after
            .faces()
            .all(|f| plan.degrees.contains(after.degree(f) as u64))
}

/// Returns the reason why `operation` is refused.
///
/// # Panics
///
/// Panics if the operation succeeds, or fails for a reason that is not a refusal.
pub fn refused(operation: &impl Operation, mesh: Mesh) -> Refusal {
    match try_applied(operation, mesh) {
        Err(OpError::Refused { reason, .. }) => reason,
        other => panic!("expected a refusal, got {other:?}"),
    }
}
