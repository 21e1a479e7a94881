//! The objects that a step acts on: those in `on:`, or else all of the kind that its operation works on.

use std::borrow::Cow;

use bezier::Curve;
use glam::DVec2;
use scene::{Geometry, Scene};

use crate::source::named_object;
use crate::{Context, OpError, Plan, PlanContext, PlannedGeometry, Problem, Range, Report};

/// How the messages of an operation speak of the kind of objects that it works on.
#[derive(Clone, Copy, Debug)]
pub struct TargetKind {
    /// The name of the operation.
    pub operation: &'static str,
    /// What it does: `changes meshes`.
    pub does: &'static str,
    /// What it does not find: `no mesh to change`.
    pub none: &'static str,
    /// How a recipe gets one.
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

    /// The message about an object of another kind.
    pub fn another(&self, name: &str, kind: &str) -> String {
        format!("{} {}, but \"{name}\" is {kind}", self.operation, self.does)
    }

    /// Plans the operation on each object that it acts on. `change` changes its plan and returns what is wrong, or
    /// nothing at all if the object is of another kind.
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
                    let message = self.another(&object.name, object.geometry.kind());
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

/// The names of the objects that a step acts on, in the order of the scene.
///
/// # Errors
///
/// [`OpError::Object`] if one of `on:` is not there.
pub fn chosen(
    scene: &Scene,
    cx: &Context,
    is_wanted: impl Fn(&Geometry) -> bool,
) -> Result<Vec<String>, OpError> {
    for name in cx.on.unwrap_or_default() {
        named_object(scene, name)?;
    }
    let objects = scene.objects().iter();
    let chosen = objects.filter(|o| {
        cx.on
            .map_or_else(|| is_wanted(&o.geometry), |on| on.contains(&o.name))
    });
    Ok(chosen.map(|o| o.name.clone()).collect())
}

/// The objects that a step acts on: those in `on:`, or else all.
pub fn chosen_scene<'s>(scene: &'s Scene, cx: &Context) -> Cow<'s, Scene> {
    let Some(on) = cx.on else {
        return Cow::Borrowed(scene);
    };
    let mut chosen = Scene::new();
    for object in scene.objects().iter().filter(|o| on.contains(&o.name)) {
        chosen.insert(object.clone()).expect("names are unique");
    }
    Cow::Owned(chosen)
}

/// Plans an operation on curves. `change` is called with the number of control points of each and returns what it
/// becomes and what is wrong.
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

/// Runs an operation on curves. `change` returns what each becomes. The report counts them.
///
/// # Errors
///
/// [`OpError::Object`] if an object of `on:` is not there or no curve, and what `change` returns.
pub fn change_curves(
    operation: &'static str,
    scene: &mut Scene,
    cx: &Context,
    change: impl Fn(&Curve<DVec2>) -> Result<Geometry, OpError>,
) -> Result<Report, OpError> {
    let names = chosen(scene, cx, |g| matches!(g, Geometry::Curve(_)))?;
    cx.advance("curves", 0, names.len() as u64)?;
    for (done, name) in (1..).zip(&names) {
        let (geometry, _) = scene.parts_mut(name).expect("a name of the scene");
        let Geometry::Curve(curve) = geometry else {
            let message = TargetKind::curves(operation).another(name, geometry.kind());
            return Err(OpError::Object(message));
        };
        *geometry = change(curve)?;
        cx.advance("curves", done, names.len() as u64)?;
    }
    Ok(Report::changed(names.len()))
}
