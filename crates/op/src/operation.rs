//! The traits that operations implement.

use std::fmt::Debug;
use std::sync::Arc;

use mesh::{Domain, Mesh};
use scene::{Geometry, Scene};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::{
    Context, Loss, MeshPlan, OpError, Plan, PlanContext, PlannedGeometry, Problem, Report,
};

/// An operation that changes one mesh. Over a scene it acts on every mesh, or on those named in `on:`.
pub trait MeshOperation:
    Debug + Send + Sync + Serialize + DeserializeOwned + JsonSchema + 'static
{
    /// The name of the step in recipes: the name of the struct.
    const NAME: &'static str;
    /// Changes whenever the same parameters and input can give another result.
    const VERSION: u32 = 1;
    /// One line for lists: what it does, without a full stop.
    const SUMMARY: &'static str;
    /// Names that recipes used for it before.
    const ALIASES: &'static [&'static str] = &[];

    /// Changes `plan` as [`apply`](Self::apply) will change the mesh, and returns what is wrong.
    /// Runs before any geometry, so it must not take time.
    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem>;

    /// Changes the mesh, which is dense. Calls [`Context::advance`] before its first change.
    ///
    /// # Errors
    ///
    /// [`OpError`]. The mesh may then be changed in part: its driver throws it away and keeps the
    /// mesh from before the step.
    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError>;
}

/// An operation that sees the whole scene.
pub trait Operation:
    Debug + Send + Sync + Serialize + DeserializeOwned + JsonSchema + 'static
{
    /// The name of the step in recipes: the name of the struct.
    const NAME: &'static str;
    /// Changes whenever the same parameters and input can give another result.
    const VERSION: u32 = 1;
    /// One line for lists: what it does, without a full stop.
    const SUMMARY: &'static str;
    /// Names that recipes used for it before.
    const ALIASES: &'static [&'static str] = &[];
    /// Whether a step of it may choose objects with `on:`.
    const TAKES_ON: bool = false;

    /// Changes `plan` as [`apply`](Self::apply) will change the scene, and returns what is wrong.
    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem>;

    /// Changes the scene, whose meshes are dense. Calls [`Context::advance`] before its first change.
    ///
    /// # Errors
    ///
    /// [`OpError`]. The scene may then be changed in part: the runner goes back to the scene from
    /// before the step.
    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError>;
}

impl<T: MeshOperation> Operation for T {
    const NAME: &'static str = <T as MeshOperation>::NAME;
    const VERSION: u32 = <T as MeshOperation>::VERSION;
    const SUMMARY: &'static str = <T as MeshOperation>::SUMMARY;
    const ALIASES: &'static [&'static str] = <T as MeshOperation>::ALIASES;
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        let mut n = 0;
        for object in &mut plan.objects {
            let chosen = cx.on.is_none_or(|on| on.contains(&object.name));
            match &mut object.geometry {
                PlannedGeometry::Mesh(mesh) if chosen => {
                    n += 1;
                    for problem in MeshOperation::plan(self, mesh, cx) {
                        if !problems.contains(&problem) {
                            problems.push(problem);
                        }
                    }
                }
                other if chosen && cx.on.is_some() => problems.push(Problem::error(format!(
                    "{} changes meshes, but \"{}\" is {}",
                    Self::NAME,
                    object.name,
                    other.kind()
                ))),
                _ => {}
            }
        }
        if n == 0 && problems.is_empty() && !plan.incomplete {
            let message = format!("{} finds no mesh to change", Self::NAME);
            problems.push(
                Problem::error(message).help(
                    "load or make a mesh in an earlier step; Tessellate turns patches into one",
                ),
            );
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let names: Vec<String> = scene
            .objects()
            .iter()
            .filter(|o| {
                cx.on
                    .map_or(o.as_mesh().is_some(), |on| on.contains(&o.name))
            })
            .map(|o| o.name.clone())
            .collect();
        let mut report = Report::default();
        for name in &names {
            let (geometry, materials) = scene.parts_mut(name).expect("named above");
            let Geometry::Mesh(mesh) = geometry else {
                let message = format!(
                    "{} changes meshes, but \"{name}\" is {}",
                    Self::NAME,
                    geometry.kind()
                );
                return Err(OpError::Object(message));
            };
            cx.materials = materials.iter().map(|m| m.name.clone()).collect();
            let before = columns(mesh);
            // A copy if the runner still holds the mesh from before the step.
            let mesh = Arc::make_mut(mesh);
            let done = MeshOperation::apply(self, mesh, cx);
            cx.materials.clear();
            let mut done = done?;
            mesh.compact();
            let after = columns(mesh);
            let lost = before.into_iter().filter(|column| !after.contains(column));
            for (domain, column) in lost {
                let reason = format!("{} cannot carry it", Self::NAME);
                done.losses
                    .push(Loss::attribute(name, domain, &column, reason));
            }
            report.merge(done);
        }
        Ok(report)
    }
}

fn columns(mesh: &Mesh) -> Vec<(Domain, String)> {
    mesh.attributes()
        .iter()
        .map(|(domain, c)| (domain, c.name.clone()))
        .collect()
}
