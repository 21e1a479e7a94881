//! Moves one control point of a Bezier curve.
//!
//! ```text
//!                            p1'
//!      p1 --- p2            /   \
//!     /  .---. \    --->   / .-.  p2        all points except the ends move, most of all near p1
//!    / /      \ \         / /   \  \
//!   p0          p3       p0        p3
//! ```

use bezier::DVec2;
use op::prelude::*;
use op::{Operation, change_curves, plan_curves};
use scene::Geometry;

/// Moves one control point of each curve.
///
/// The other control points do not move. The point of the curve at a parameter t moves by B(t) d. Here, d is the
/// displacement of the control point, and B is the Bernstein polynomial of the control point.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MoveControlPoint {
    /// The index of the control point, from 0. Every curve on which the step acts must have a control point with this
    /// index.
    pub index: u32,
    /// The new position: `(x, y)` in the plane z = 0, in scene units.
    pub to: PlanePoint,
}

/// A point in the plane z = 0: `(x, y)`, in scene units.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct PlanePoint(pub f64, pub f64);

impl Operation for MoveControlPoint {
    const NAME: &'static str = "MoveControlPoint";
    const SUMMARY: &'static str = "Move one control point of each curve";
    const EXAMPLE: &'static str = "MoveControlPoint(index: 1, to: (2, -3.5))";
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        plan_curves(Self::NAME, plan, cx, |points| {
            let (index, max) = (self.index, points.max);
            let message = format!("expected a control point index below {max}, found {index}");
            let missing = (u64::from(index) >= max).then(|| Problem::error(message).at(["index"]));
            (
                PlannedGeometry::Curve(points),
                missing.into_iter().collect(),
            )
        })
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let to = DVec2::new(self.to.0, self.to.1);
        change_curves(Self::NAME, scene, cx, |curve| {
            let moved = curve.with_point(self.index as usize, to);
            moved
                .map(Geometry::Curve)
                .map_err(|e| OpError::Parameter(e.to_string()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bezier::Curve;
    use op::Range;
    use scene::Object;

    fn step(text: &str) -> MoveControlPoint {
        op::test::read(text).unwrap()
    }

    fn points() -> Vec<DVec2> {
        vec![DVec2::ZERO, DVec2::new(0.0, 4.0), DVec2::new(4.0, 4.0)]
    }

    fn arch() -> Scene {
        let mut scene = Scene::new();
        let curve = Geometry::Curve(Curve::new(points()).unwrap());
        scene.insert(Object::new("arch", curve)).unwrap();
        scene
    }

    #[test]
    fn only_the_given_control_point_moves() {
        let mut scene = arch();
        op::test::run(&step("(index: 1, to: (2, -3.5))"), &mut scene).unwrap();
        let mut moved = points();
        moved[1] = DVec2::new(2.0, -3.5);
        assert_eq!(
            scene.objects()[0].geometry,
            Geometry::Curve(Curve::new(moved).unwrap())
        );
    }

    #[test]
    fn a_missing_control_point_or_a_nan_is_refused_and_nothing_changes() {
        for text in ["(index: 3, to: (0, 0))", "(index: 0, to: (NaN, 0))"] {
            let mut scene = arch();
            let result = op::test::run(&step(text), &mut scene);
            assert!(matches!(result, Err(OpError::Parameter(_))));
            assert_eq!(scene, arch());
        }
    }

    #[test]
    fn the_plan_reports_an_index_that_no_curve_can_have() {
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        let problem_fields = |points, text| {
            let mut plan = Plan::default();
            assert_eq!(plan.insert("arch", PlannedGeometry::Curve(points)), None);
            let problems = step(text).plan(&mut plan, &cx);
            assert_eq!(plan.objects()[0].geometry, PlannedGeometry::Curve(points));
            problems
                .iter()
                .map(|p| p.path.join("."))
                .collect::<Vec<_>>()
        };
        let three = Range::exactly(3);
        assert_eq!(problem_fields(three, "(index: 2, to: (0, 0))"), [""; 0]);
        assert_eq!(problem_fields(three, "(index: 3, to: (1, 0))"), ["index"]);
        let any = Range::ANY;
        assert_eq!(problem_fields(any, "(index: 3, to: (0, 0))"), [""; 0]);
    }
}
