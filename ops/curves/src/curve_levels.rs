//! Shows with polylines how de Casteljau's algorithm constructs a point of a Bezier curve.
//!
//! ```text
//!        p1 ---- q1 ------ p2          p: level 0, the control polygon
//!       /      /    \        \         q: level 1
//!      /      r0--m--r1       \        r: level 2
//!     /      /         \       \       m: level 3, the point of the curve
//!    q0 ----'           '------ q2
//!   /                             \    the points of each level divide the segments
//! p0                               p3  of the level before in the ratio t : 1 - t
//! ```
//!
//! Source: Farin, "Curves and Surfaces for CAGD", 5th edition, 2002, chapter 4.

use op::prelude::*;
use op::{Operation, change_curves, plan_curves};
use scene::Geometry;

/// Replaces each curve with polylines that show the levels of de Casteljau's algorithm.
///
/// A curve with n control points becomes n polylines in the plane z = 0. The first polyline is the control polygon with
/// n points. The points of each later polyline divide the segments of the previous polyline in the ratio t : 1 - t.
/// Each polyline therefore has one point fewer than the previous polyline. The last polyline has a single point, the
/// point of the curve at `t`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CurveLevels {
    /// The curve parameter at which the algorithm computes a point, from 0 (the start of the curve) to 1 (the end).
    pub t: ClosedFraction,
}

/// Returns the size of all levels of a curve with n control points, in bytes. The levels have n (n + 1) / 2 points of
/// 24 bytes each.
fn bytes(n: u64) -> u64 {
    n.saturating_mul(n.saturating_add(1)) / 2 * 24
}

fn too_large(n: u64, budget: u64) -> Option<String> {
    let needed = bytes(n);
    (needed > budget).then(|| {
        format!(
            "the levels of a curve with {n} control points need {} of memory, which exceeds the memory budget of {}",
            op::readable_bytes(needed),
            op::readable_bytes(budget)
        )
    })
}

impl Operation for CurveLevels {
    const NAME: &'static str = "CurveLevels";
    const SUMMARY: &'static str =
        "Replace curves with polylines that show the levels of de Casteljau's algorithm";
    const EXAMPLE: &'static str = "CurveLevels(t: 0)";
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        plan_curves(Self::NAME, plan, cx, |points| {
            let problems = too_large(points.min, cx.budget).map(Problem::error);
            (PlannedGeometry::Polylines, problems.into_iter().collect())
        })
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        change_curves(Self::NAME, scene, cx, |curve| {
            if let Some(message) = too_large(curve.points().len() as u64, cx.budget) {
                return Err(OpError::Budget(message));
            }
            let levels = curve.levels(self.t.get()).into_iter();
            let lines = levels.map(|level| level.iter().map(|p| p.extend(0.0)).collect());
            Ok(Geometry::Polylines(lines.collect()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bezier::{Curve, DVec2, DVec3};
    use scene::Object;

    fn curve() -> Curve<DVec2> {
        Curve::new(vec![
            DVec2::ZERO,
            DVec2::new(0.0, 4.0),
            DVec2::new(4.0, 4.0),
        ])
        .unwrap()
    }

    fn arch() -> Scene {
        let mut scene = Scene::new();
        scene
            .insert(Object::new("arch", Geometry::Curve(curve())))
            .unwrap();
        scene
    }

    fn lines(t: f64) -> Vec<Vec<DVec3>> {
        let mut scene = arch();
        let t = ClosedFraction::literal(t);
        op::test::run(&CurveLevels { t }, &mut scene).unwrap();
        match &scene.objects()[0].geometry {
            Geometry::Polylines(lines) => lines.clone(),
            geometry => panic!("{}", geometry.kind()),
        }
    }

    #[test]
    fn each_level_has_one_point_less() {
        let lines = lines(0.5);
        assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [3, 2, 1]);
        assert_eq!(
            lines[1],
            [DVec3::new(0.0, 2.0, 0.0), DVec3::new(2.0, 4.0, 0.0)]
        );
    }

    #[test]
    fn the_last_level_is_the_point_of_the_curve() {
        for t in [0.0, 0.3, 1.0] {
            assert_eq!(lines(t)[2], [curve().point(t).extend(0.0)]);
        }
    }

    #[test]
    fn levels_that_exceed_the_budget_are_refused_by_plan_and_apply() {
        let files = op::Files::default();
        let t = ClosedFraction::literal(0.5);
        let step = CurveLevels { t };
        let mut cx = Context::new(&op::NoProgress, &files);
        cx.budget = bytes(3) - 1;
        assert!(matches!(
            step.apply(&mut arch(), &mut cx),
            Err(OpError::Budget(_))
        ));

        let mut plan = Plan::default();
        let planned = PlannedGeometry::Curve(Range::exactly(3));
        assert_eq!(plan.insert("arch", planned), None);
        let cx = PlanContext {
            files: &files,
            on: None,
            budget: bytes(3) - 1,
        };
        assert_eq!(step.plan(&mut plan, &cx).len(), 1);
        assert_eq!(plan.objects()[0].geometry, PlannedGeometry::Polylines);
    }
}
