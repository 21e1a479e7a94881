//! Moves one control point of Bezier patches.
//!
//! ```text
//!      12--13--14--15                12--13--14--15
//!      |   |   |   |                 |   |   |   |
//!      8---9---10--11     10         8---9--.|   11
//!      |   |   |   |     --->        |   |   '10-|        the patch follows, most of all near the point
//!      4---5---6---7                 4---5---6---7
//!      |   |   |   |                 |   |   |   |
//!      0---1---2---3                 0---1---2---3
//! ```

use bezier::Patch;
use mesh::DVec3;
use op::prelude::*;
use op::{Operation, TargetKind, target_names};
use scene::Geometry;

/// Moves one control point of Bezier patches.
///
/// The step acts on the objects that its parameter `on` lists. Without `on`, the step acts on all objects that consist
/// of Bezier patches. If other control points of the object are at the same position, they also move, so that patches
/// with a common side stay joined. The point of a patch at the parameters (u, v) moves by B(u) C(v) d. Here, d is the
/// displacement of the control point, B is the Bernstein polynomial of its column, and C is the Bernstein polynomial of
/// its row. The report counts the changed objects.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MovePatchPoint {
    /// The index of the control point in the object: 16 p + 4 r + c. Here, p is the index of the patch, r is the row
    /// and c is the column, all counted from 0. Every object on which the step acts must have a control point with this
    /// index.
    pub index: u32,
    /// The new position `(x, y, z)`, in scene units.
    pub to: [f64; 3],
}

/// The number of control points of a patch.
const POINTS: u32 = 16;

const TARGET: TargetKind = TargetKind {
    operation: MovePatchPoint::NAME,
    does: "changes patches",
    none: "no patches to change",
    help: "load a .bez file in an earlier step",
};

impl Operation for MovePatchPoint {
    const NAME: &'static str = "MovePatchPoint";
    const SUMMARY: &'static str = "Move one control point of Bezier patches";
    const EXAMPLE: &'static str = "MovePatchPoint(index: 5, to: (1, 2, 0.5))";
    const WORDS: &'static [&'static str] = &["patches", "control point"];
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        TARGET.plan(plan, cx, |geometry| {
            let PlannedGeometry::Patches(patches) = *geometry else {
                return None;
            };
            let max = patches.max.saturating_mul(u64::from(POINTS));
            let missing = (u64::from(self.index) >= max).then(|| {
                let message = expected(max, self.index);
                Problem::error(message).at(["index"])
            });
            Some(missing.into_iter().collect())
        })
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let names = target_names(scene, cx, |g| matches!(g, Geometry::Patches(_)))?;
        for (done, name) in (0..).zip(&names) {
            cx.advance("patches", done, names.len() as u64)?;
            let (geometry, _) = scene.parts_mut(name).expect("the object was chosen above");
            let Geometry::Patches(patches) = geometry else {
                let message = TARGET.wrong_kind_message(name, geometry.kind());
                return Err(OpError::Object(message));
            };
            *patches = self.moved(patches)?;
        }
        Ok(Report::changed(names.len()))
    }
}

impl MovePatchPoint {
    /// Returns copies of the patches in which the control point is moved.
    fn moved(&self, patches: &[Patch]) -> Result<Vec<Patch>, OpError> {
        let all = patches.iter().flat_map(|p| p.points().as_flattened());
        let Some(&from) = all.clone().nth(self.index as usize) else {
            let n = all.count() as u64;
            return Err(OpError::Parameter(expected(n, self.index)));
        };
        let to = DVec3::from(self.to);
        let moved = patches.iter().map(|patch| {
            let points = patch.points();
            Patch::new(points.map(|row| row.map(|p| if p == from { to } else { p })))
        });
        let moved: Result<_, _> = moved.collect();
        moved.map_err(|e| OpError::Parameter(e.to_string()))
    }
}

fn expected(max: u64, found: u32) -> String {
    format!("expected a control point index below {max}, found {found}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use op::Range;
    use scene::Object;

    fn step(text: &str) -> MovePatchPoint {
        op::test::read(text).unwrap()
    }

    /// Returns the control points of a flat patch. The points of its first column have the x coordinate `x`.
    fn patch(x: f64) -> [[DVec3; 4]; 4] {
        let steps = [0.0, 1.0, 2.0, 3.0];
        steps.map(|row| steps.map(|column| DVec3::new(x + column, row, 0.0)))
    }

    /// Returns two patches with a common side.
    fn strip() -> Scene {
        let patches = [0.0, 3.0].map(|x| Patch::new(patch(x)).unwrap());
        let mut scene = Scene::new();
        let object = Object::new("strip", Geometry::Patches(patches.to_vec()));
        scene.insert(object).unwrap();
        scene
    }

    fn points(scene: &Scene) -> Vec<DVec3> {
        let Geometry::Patches(patches) = &scene.objects()[0].geometry else {
            panic!()
        };
        let all = patches.iter().flat_map(|p| p.points().as_flattened());
        all.copied().collect()
    }

    #[test]
    fn an_inner_control_point_moves_alone_and_a_shared_one_with_its_double() {
        let to = DVec3::new(2.0, -1.0, 5.0);
        for (index, moved) in [(5, &[5][..]), (16 + 4, &[7, 20]), (7, &[7, 20])] {
            let mut scene = strip();
            let step = step(&format!("(index: {index}, to: (2, -1, 5))"));
            op::test::run(&step, &mut scene).unwrap();
            let expected = points(&strip()).into_iter().enumerate();
            let expected: Vec<DVec3> = expected
                .map(|(i, p)| if moved.contains(&i) { to } else { p })
                .collect();
            assert_eq!(points(&scene), expected, "{index}");
        }
    }

    #[test]
    fn a_missing_control_point_or_a_nan_is_refused_and_nothing_changes() {
        for text in [
            "(index: 32, to: (0, 0, 0))",
            "(index: 0, to: (NaN, 0, 0))",
            "(index: 0, to: (0, 0, inf))",
        ] {
            let mut scene = strip();
            let result = op::test::run(&step(text), &mut scene);
            assert!(matches!(result, Err(OpError::Parameter(_))), "{text}");
            assert_eq!(scene, strip());
        }
    }

    #[test]
    fn the_plan_reports_an_index_that_no_patch_can_have() {
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        for (index, n_problems) in [(31, 0), (32, 1)] {
            let mut plan = Plan::default();
            let two = PlannedGeometry::Patches(Range::exactly(2));
            assert_eq!(plan.insert("strip", two), None);
            let problems = step(&format!("(index: {index}, to: (0, 0, 0))")).plan(&mut plan, &cx);
            assert_eq!(problems.len(), n_problems, "{index}");
        }
    }
}
