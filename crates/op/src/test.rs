//! Running one operation in a test.

use mesh::Mesh;
use scene::{Object, Scene};

use crate::{Context, Files, NoProgress, OpError, Operation, Report};

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
