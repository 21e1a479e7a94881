//! The objects that a step acts on: the objects named in `on:`, or all objects of the kind that the operation
//! supports.

use std::borrow::Cow;

use bezier::Curve;
use glam::DVec2;
use scene::{Geometry, Scene};

use crate::source::named_object;
use crate::{Context, OpError, Plan, PlanContext, PlannedGeometry, Problem, Range, Report};

/// The words that messages use for an operation, and for the kind of objects that the operation can change.
#[derive(Clone, Copy, Debug)]
pub struct TargetKind {
    /// The name of the operation.
    pub operation: &'static str,
    /// What the operation does, as a verb phrase such as `changes meshes`.
    pub does: &'static str,
    /// The words, such as `no mesh to change`, that messages use if the scene has no object of this kind.
    pub none: &'static str,
    /// What a recipe must do to get an object of this kind.
    pub help: &'static str,
}

impl TargetKind {
    const fn curves(operation: &'static str) -> Self {
        Self {
            operation,
            does: "changes curves",
            none: "no curve to change",
            help: "load a .bzc file in an earlier step",
        }
    }

    /// Returns the error message for an object of the wrong kind.
    pub fn wrong_kind_message(&self, name: &str, kind: &str) -> String {
        format!(
            "{} {}, but the type of \"{name}\" is {kind}",
            self.operation, self.does
        )
    }

    /// Plans the operation on each object that the step acts on. `change` updates the plan of an object and returns the
    /// problems. `change` returns `None` if the object is of the wrong kind.
    pub fn plan(
        &self,
        plan: &mut Plan,
        cx: &PlanContext,
        mut change: impl FnMut(&mut PlannedGeometry) -> Option<Vec<Problem>>,
    ) -> Vec<Problem> {
        let mut problems = Vec::new();
        let mut n = 0;
        for object in plan.objects_mut() {
            if cx.on.is_some_and(|on| !on.contains(&object.name)) {
                continue;
            }
            match change(&mut object.geometry) {
                Some(found) => {
                    n += 1;
                    for problem in found {
                        if !problems.contains(&problem) {
                            problems.push(problem);
                        }
                    }
                }
                None if cx.on.is_some() => {
                    let message = self.wrong_kind_message(&object.name, object.geometry.kind());
                    problems.push(Problem::error(message));
                }
                None => {}
            }
        }
        if n == 0 && problems.is_empty() && !plan.incomplete {
            let message = format!("{} finds {}", self.operation, self.none);
            problems.push(Problem::error(message).help(self.help));
        }
        problems
    }
}

/// Returns the names of the objects that a step acts on, in the order of the scene. If the step has `on:`, it acts on
/// the objects named there. Otherwise, it acts on each object if `is_wanted` returns true for its geometry.
///
/// # Errors
///
/// Returns [`OpError::Object`] if `on:` names an object that does not exist.
pub fn target_names(
    scene: &Scene,
    cx: &Context,
    is_wanted: impl Fn(&Geometry) -> bool,
) -> Result<Vec<String>, OpError> {
    for name in cx.on.unwrap_or_default() {
        named_object(scene, name)?;
    }
    let objects = scene.objects().iter();
    let targets = objects.filter(|o| {
        cx.on
            .map_or_else(|| is_wanted(&o.geometry), |on| on.contains(&o.name))
    });
    Ok(targets.map(|o| o.name.clone()).collect())
}

/// Returns a scene with the objects that a step acts on. If the step has `on:`, the scene has the objects named there
/// and the nodes that reference them. Without `on:`, the scene has all objects.
pub fn target_scene<'s>(scene: &'s Scene, cx: &Context) -> Cow<'s, Scene> {
    let Some(on) = cx.on else {
        return Cow::Borrowed(scene);
    };
    Cow::Owned(scene.only(|name| on.iter().any(|wanted| wanted == name)))
}

/// Plans an operation on curves. `change` receives the number of control points of a curve, as a range. `change`
/// returns the planned geometry that replaces the curve, and the problems of the step.
pub fn plan_curves(
    operation: &'static str,
    plan: &mut Plan,
    cx: &PlanContext,
    change: impl Fn(Range) -> (PlannedGeometry, Vec<Problem>),
) -> Vec<Problem> {
    TargetKind::curves(operation).plan(plan, cx, |geometry| {
        let PlannedGeometry::Curve(points) = *geometry else {
            return None;
        };
        let (changed, problems) = change(points);
        *geometry = changed;
        Some(problems)
    })
}

/// Runs an operation on curves. `change` returns the geometry that replaces a curve. The report counts the curves.
///
/// # Errors
///
/// Returns [`OpError::Object`] if an object named in `on:` does not exist or is not a curve. Also returns the errors of
/// `change`.
pub fn change_curves(
    operation: &'static str,
    scene: &mut Scene,
    cx: &Context,
    change: impl Fn(&Curve<DVec2>) -> Result<Geometry, OpError>,
) -> Result<Report, OpError> {
    let names = target_names(scene, cx, |g| matches!(g, Geometry::Curve(_)))?;
    cx.advance("curves", 0, names.len() as u64)?;
    for (done, name) in (1..).zip(&names) {
        let (geometry, _) = scene.parts_mut(name).expect("a name of the scene");
        let Geometry::Curve(curve) = geometry else {
            let message = TargetKind::curves(operation).wrong_kind_message(name, geometry.kind());
            return Err(OpError::Object(message));
        };
        *geometry = change(curve)?;
        cx.advance("curves", done, names.len() as u64)?;
    }
    Ok(Report::changed(names.len()))
}
