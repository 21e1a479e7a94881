//! Measure: stores a quantity, such as a curvature or a distance, as an attribute of vertices or faces.
//!
//! ```text
//!      .-""-.                  .2""2.
//!     /      \       -->      2      2      one number for each vertex or face
//!    |   ()   |              1   -3   1
//! ```

use std::sync::Arc;

use mesh::{Column, Domain, Rule, Values};
use op::prelude::*;
use op::{AttributeName, Number, Operation, Statistics, readable, target_names};
use scene::Geometry;

use crate::MeasureOf;

/// Stores a quantity, such as a curvature or a distance, as an attribute of vertices or faces.
///
/// Later steps can use the attribute to select elements (`Where`) or to move vertices (`Displace`). They can also show
/// it in a picture (`Picture`) or save it to a file (`Save`). If a later step changes the mesh, the quantity is not
/// computed again. Positions and other attributes do not change. Quantities are computed from the coordinates that the
/// mesh stores. The transforms of the nodes that place the mesh in the scene are not applied. For each object, the
/// report states the lowest, the mean and the highest value.
///
/// If the mesh already has an attribute of this name, the attribute is replaced. The step fails if the existing
/// attribute belongs to a different kind of element, or does not have one floating-point number per element.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Measure {
    /// The quantity.
    pub of: MeasureOf,
    /// The name of the attribute. If omitted, the attribute gets the name of the quantity in lower case, for example
    /// `mean_curvature` for `MeanCurvature`. For principal curvatures, the default names are `largest_curvature` and
    /// `smallest_curvature`.
    #[serde(default)]
    pub name: Option<AttributeName>,
    /// The value for elements at which the quantity is not defined. For example, a vertex without faces has no
    /// curvature. The report counts these elements. If omitted, the value is 0 for quantities that can be negative,
    /// and -1 for all other quantities.
    #[serde(default)]
    pub missing: Option<Number>,
}

impl Measure {
    fn name(&self) -> &str {
        match &self.name {
            Some(name) => name.as_str(),
            None => self.of.default_name(),
        }
    }

    /// Whether a step without `on` leaves out `object`, because the quantity is measured relative to this object. For
    /// example, a step that measures the distances to an object leaves out this object.
    fn leaves_out(&self, object: &str) -> bool {
        self.of.other().is_some_and(|(other, _)| other == object)
    }
}

impl Operation for Measure {
    const NAME: &'static str = "Measure";
    const SUMMARY: &'static str =
        "Store a quantity, such as a curvature or a distance, as an attribute of vertices or faces";
    const EXAMPLE: &'static str = "Measure(of: MeanCurvature)";
    const WORDS: &'static [&'static str] = &[
        "curvature",
        "quality",
        "analyse",
        "analyze",
        "inspect",
        "attribute",
        "wall thickness",
        "geodesic",
        "ambient occlusion",
        "winding number",
    ];
    const DONE: &'static str = "measured";
    const TAKES_ON: bool = true;
    const ATOMIC: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if let Some((other, path)) = self.of.other() {
            problems.extend(plan.missing(other, path));
            if let Some(object) = plan.object(other)
                && !matches!(object.geometry, PlannedGeometry::Mesh(_))
            {
                let message = format!("{} needs a mesh, but \"{other}\" is not one", Self::NAME);
                problems.push(Problem::error(message).at(path));
            }
        }
        let (name, domain) = (self.name(), self.of.domain());
        let mut n = 0;
        for object in plan.objects_mut() {
            let is_target = match cx.on {
                Some(on) => on.contains(&object.name),
                None => !self.leaves_out(&object.name),
            };
            match &mut object.geometry {
                PlannedGeometry::Mesh(mesh) if is_target => {
                    n += 1;
                    mesh.provide(domain, name);
                }
                other if is_target && cx.on.is_some() => {
                    problems.push(Problem::error(wrong_kind(&object.name, other.kind())));
                }
                _ => {}
            }
        }
        if n == 0 && problems.is_empty() && !plan.incomplete {
            let problem = Problem::error("Measure finds no mesh to measure");
            problems.push(problem.help("load or make a mesh in an earlier step"));
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let mut targets = target_names(scene, cx, |g| matches!(g, Geometry::Mesh(_)))?;
        if cx.on.is_none() {
            targets.retain(|object| !self.leaves_out(object));
        }
        if targets.is_empty() {
            return Err(OpError::Object(
                "the scene has no mesh to measure".to_owned(),
            ));
        }
        let (name, domain) = (self.name(), self.of.domain());
        let missing = (self.missing).map_or(self.of.default_missing(), Number::get);
        let mut report = Report::default();
        let mut columns = Vec::new();
        for (done, object) in (0..).zip(&targets) {
            cx.advance("measure", done, targets.len() as u64)?;
            let found = scene.object(object).expect("a name of the scene");
            let Geometry::Mesh(mesh) = &found.geometry else {
                return Err(OpError::Object(wrong_kind(object, found.geometry.kind())));
            };
            cx.materials = found.materials.iter().map(|m| m.name.clone()).collect();
            check_free(mesh, object, domain, name)?;
            let mut values = self.of.values(mesh, scene, cx)?;
            let found = Statistics::of(&values);
            if let Some(found) = &found {
                let [min, mean, max] = [found.min, found.mean, found.max].map(readable);
                let note = format!("\"{object}\": {name} from {min} to {max}, mean {mean}");
                report = report.note(note);
            }
            let n = found.map_or(0, |found| found.n);
            let (without, value) = (values.len() - n, readable(missing));
            let what = format!(
                "\"{object}\": elements that get the value {value}, because {name} is not defined for them"
            );
            report = report.count(&what, without);
            report.changed += n as u64;
            for x in &mut values {
                if !x.is_finite() {
                    *x = missing;
                }
            }
            columns.push(values);
        }
        cx.materials.clear();
        for (object, values) in targets.iter().zip(columns) {
            let (geometry, _) = scene.parts_mut(object).expect("a name of the scene");
            let Geometry::Mesh(mesh) = geometry else {
                unreachable!("only meshes were measured");
            };
            let column = Column {
                name: name.to_owned(),
                rule: match domain {
                    Domain::Vertex => Rule::Interpolate,
                    _ => Rule::Copy,
                },
                values: Values::Float(values),
            };
            Arc::make_mut(mesh).insert_column(domain, column);
        }
        Ok(report)
    }
}

fn wrong_kind(object: &str, kind: &str) -> String {
    format!("Measure measures meshes, but the type of \"{object}\" is {kind}")
}

/// Checks that the step can replace the attribute of this name, if the mesh has one.
fn check_free(mesh: &Mesh, object: &str, domain: Domain, name: &str) -> Result<(), OpError> {
    let mut columns = mesh.attributes().iter();
    let is_other = |(of, column): &(Domain, &Column)| {
        column.name == name && (*of != domain || !matches!(column.values, Values::Float(_)))
    };
    columns.find(is_other).map_or(Ok(()), |(of, column)| {
        Err(OpError::Parameter(format!(
            "name: \"{object}\" already has the {of} attribute \"{name}\" of the type {}, which cannot be replaced \
             with one number for each {domain}; choose another name",
            column.values.type_name()
        )))
    })
}

#[cfg(test)]
mod tests;
