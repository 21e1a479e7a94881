//! The traits that operations implement.

use std::fmt::Debug;
use std::sync::Arc;

use mesh::{Change, Domain, Mesh};
use scene::{Geometry, Scene};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::{
    Context, Loss, MeshPlan, OpError, Plan, PlanContext, PlannedGeometry, PlannedObject, Problem,
    Report, TargetKind, target_names,
};

/// An operation that changes one mesh at a time. A step applies the operation to every mesh of the scene. If the step
/// has `on:`, only the meshes named there are changed.
pub trait MeshOperation:
    Debug + Send + Sync + Serialize + DeserializeOwned + JsonSchema + 'static
{
    /// The name of the operation in recipes. The struct has the same name.
    const NAME: &'static str;
    /// The version of the operation's results. Increase this number whenever a change of the code can lead to a
    /// different result for the same parameters and input.
    const VERSION: u32 = 1;
    /// What the operation does, in one line without a full stop, for lists of operations.
    const SUMMARY: &'static str;
    /// An example step as in a recipe, such as `Weld(distance: 0.001)`, for the documentation and the tests.
    const EXAMPLE: &'static str;
    /// Earlier names of the operation. Recipes can still use these names.
    const ALIASES: &'static [&'static str] = &[];
    /// Names for the operation in other programs, in lower case. If a recipe uses one of these words as the name of a
    /// step, the error suggests this operation.
    const WORDS: &'static [&'static str] = &[];
    /// The word after the number of changed elements in tables of steps, such as `flipped` in `12 flipped`. If the word
    /// is empty, the tables do not show this number.
    const DONE: &'static str = "";

    /// Returns the other objects whose meshes the operation reads with [`Context::other_mesh`]. Each pair consists of
    /// the name of an object and the name of the parameter that contains this name. A step without `on:` does not
    /// change the objects that this method returns.
    fn reads(&self) -> Vec<(&str, &'static str)> {
        Vec::new()
    }

    /// Returns the paths of the files that the operation reads, as written in the recipe.
    fn files(&self) -> Vec<&str> {
        Vec::new()
    }

    /// Returns the problems that the mesh of the object `name` would cause in this step. `name` is one of the names
    /// that [`reads`](Self::reads) returns, and `mesh` is the plan of this object's mesh.
    fn plan_reading(&self, name: &str, mesh: &MeshPlan) -> Vec<Problem> {
        let _ = (name, mesh);
        Vec::new()
    }

    /// Changes `plan` in the same way as [`apply`](Self::apply) will change the mesh. Returns the problems of the step.
    /// This method runs before any geometry exists, and must be fast.
    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem>;

    /// Changes the mesh. The mesh [is dense](Mesh::is_dense), that is, it has no deleted elements. Ids are therefore
    /// indices into the arrays of the mesh, such as `positions()`. This method must call [`Context::advance`] before
    /// the first change. An operation that computes a new mesh stores it with [`Mesh::replace`].
    ///
    /// # Errors
    ///
    /// Returns an [`OpError`]. When an error is returned, some elements of the mesh can already be changed. The caller
    /// records all changes of the mesh, and undoes them after an error.
    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError>;
}

/// An operation that works on the whole scene.
pub trait Operation:
    Debug + Send + Sync + Serialize + DeserializeOwned + JsonSchema + 'static
{
    /// The name of the operation in recipes. The struct has the same name.
    const NAME: &'static str;
    /// The version of the operation's results. Increase this number whenever a change of the code can lead to a
    /// different result for the same parameters and input.
    const VERSION: u32 = 1;
    /// What the operation does, in one line without a full stop, for lists of operations.
    const SUMMARY: &'static str;
    /// An example step as in a recipe, such as `Weld(distance: 0.001)`, for the documentation and the tests.
    const EXAMPLE: &'static str;
    /// Earlier names of the operation. Recipes can still use these names.
    const ALIASES: &'static [&'static str] = &[];
    /// Names for the operation in other programs, in lower case. If a recipe uses one of these words as the name of a
    /// step, the error suggests this operation.
    const WORDS: &'static [&'static str] = &[];
    /// The word after the number of changed elements in tables of steps, such as `flipped` in `12 flipped`. If the word
    /// is empty, the tables do not show this number.
    const DONE: &'static str = "";
    /// Whether a step can choose objects with `on:`.
    const TAKES_ON: bool = false;
    /// Whether the operation leaves the scene unchanged when it fails. If false, the run keeps the meshes in their
    /// state before the step, and the operation changes copies of these meshes.
    const ATOMIC: bool = false;

    /// Changes `plan` in the same way as [`apply`](Self::apply) will change the scene. Returns the problems of the
    /// step.
    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem>;

    /// Changes the scene. All meshes of the scene [are dense](Mesh::is_dense), that is, they have no deleted elements.
    /// This method must call [`Context::advance`] before the first change.
    ///
    /// # Errors
    ///
    /// Returns an [`OpError`]. When an error is returned, parts of the scene can already be changed. The caller then
    /// restores the scene to its state before the step.
    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError>;
}

impl<T: MeshOperation> Operation for T {
    const NAME: &'static str = <T as MeshOperation>::NAME;
    const VERSION: u32 = <T as MeshOperation>::VERSION;
    const SUMMARY: &'static str = <T as MeshOperation>::SUMMARY;
    const EXAMPLE: &'static str = <T as MeshOperation>::EXAMPLE;
    const ALIASES: &'static [&'static str] = <T as MeshOperation>::ALIASES;
    const WORDS: &'static [&'static str] = <T as MeshOperation>::WORDS;
    const DONE: &'static str = <T as MeshOperation>::DONE;
    const TAKES_ON: bool = true;
    const ATOMIC: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let files = self.files().into_iter();
        plan.inputs.extend(files.map(|path| cx.files.to_read(path)));
        let reads = self.reads();
        let mut problems = Vec::new();
        for &(name, parameter) in &reads {
            problems.extend(plan.missing(name, [parameter]));
            let is_target = |on: &[String]| on.iter().any(|target| target == name);
            if cx.on.is_some_and(is_target) {
                let message = format!(
                    "`{parameter}` and `on` both name \"{name}\", but the step must not act on the object that `{parameter}` names"
                );
                problems.push(Problem::error(message).at([parameter]));
            }
            match plan.object(name).map(|object| &object.geometry) {
                Some(PlannedGeometry::Mesh(mesh)) => problems.extend(self.plan_reading(name, mesh)),
                Some(other) => {
                    let message = format!(
                        "{} needs a mesh, but the type of \"{name}\" is {}",
                        <T as MeshOperation>::NAME,
                        other.kind()
                    );
                    problems.push(Problem::error(message).at([parameter]));
                }
                None => {}
            }
        }
        let is_target = |o: &&PlannedObject| {
            matches!(o.geometry, PlannedGeometry::Mesh(_)) && reads.iter().all(|r| r.0 != o.name)
        };
        let targets = plan.objects().iter().filter(is_target);
        let targets: Vec<String> = targets.map(|o| o.name.clone()).collect();
        let on = if reads.is_empty() || cx.on.is_some() {
            cx.on
        } else {
            Some(&targets[..])
        };
        let target_cx = PlanContext { on, ..*cx };
        let found = target_kind::<T>().plan(plan, &target_cx, |geometry| match geometry {
            PlannedGeometry::Mesh(mesh) => Some(MeshOperation::plan(self, mesh, cx)),
            _ => None,
        });
        problems.extend(found);
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let mut names = target_names(scene, cx, |g| matches!(g, Geometry::Mesh(_)))?;
        if cx.on.is_none() {
            let reads = self.reads();
            names.retain(|name| reads.iter().all(|read| read.0 != name));
        }
        let mut report = Report::default();
        let mut changes = Vec::new();
        for name in &names {
            match apply_to(self, scene, name, cx) {
                Ok((done, change)) => {
                    report.merge(done);
                    changes.push((name, change));
                }
                Err(error) => {
                    for (name, change) in changes.into_iter().rev() {
                        mesh_mut(scene, name)?.revert(change);
                    }
                    return Err(error);
                }
            }
        }
        for (name, change) in changes {
            // `change` is the record for undoing the step, and can contain a whole mesh. The record is dropped here so
            // that its memory is free before `compact` allocates memory.
            drop(change);
            mesh_mut(scene, name)?.compact();
        }
        Ok(report)
    }
}

const fn target_kind<T: MeshOperation>() -> TargetKind {
    TargetKind {
        operation: <T as MeshOperation>::NAME,
        does: "changes meshes",
        none: "no mesh to change",
        help: "load or create a mesh in an earlier step; Tessellate converts patches to a mesh",
    }
}

/// Applies an operation to the mesh of the object `name`. If the operation fails, this mesh is unchanged.
fn apply_to<T: MeshOperation>(
    operation: &T,
    scene: &mut Scene,
    name: &str,
    cx: &mut Context,
) -> Result<(Report, Change), OpError> {
    cx.set_object(scene, name);
    let (geometry, _) = scene.parts_mut(name).expect("a name of the scene");
    let Geometry::Mesh(mesh) = geometry else {
        let message = target_kind::<T>().wrong_kind_message(name, geometry.kind());
        return Err(OpError::Object(message));
    };
    let before = columns(mesh);
    // Copies the mesh if another `Arc` also points to it.
    let mesh = Arc::make_mut(mesh);
    mesh.begin();
    let done = operation.apply(mesh, cx);
    cx.clear_object();
    // If an operation assigns a new mesh to `*mesh`, the record of the changes is lost, and the changes cannot be
    // undone. Operations must call `Mesh::replace` instead.
    let is_recording = mesh.is_recording();
    let mut report = match done {
        Ok(report) => report,
        Err(error) => {
            let error = error.placed(name, mesh);
            if is_recording {
                mesh.rollback();
            }
            return Err(error);
        }
    };
    let change = if is_recording { mesh.commit() } else { None };
    let after = columns(mesh);
    let lost = before.into_iter().filter(|column| !after.contains(column));
    for (domain, column) in lost {
        let reason = format!("{} cannot preserve it", <T as MeshOperation>::NAME);
        report
            .losses
            .push(Loss::attribute(name, domain, &column, reason));
    }
    Ok((report, change.unwrap_or_default()))
}

fn mesh_mut<'s>(scene: &'s mut Scene, name: &str) -> Result<&'s mut Mesh, OpError> {
    match scene.parts_mut(name) {
        Some((Geometry::Mesh(mesh), _)) => Ok(Arc::make_mut(mesh)),
        _ => Err(OpError::Object(format!("\"{name}\" is no longer a mesh"))),
    }
}

fn columns(mesh: &Mesh) -> Vec<(Domain, String)> {
    mesh.attributes()
        .iter()
        .map(|(domain, c)| (domain, c.name.clone()))
        .collect()
}
