//! Samples a Bezier curve at equal steps of the parameter and joins the points with a polyline.
//!
//! ```text
//!      p1 ------- p2              . --- .
//!     /   .---.     \           /       \        segments: 3
//!    /  /       \    \   --->  |         |       points at t = 0, 1/3, 2/3, 1
//!   p0             p3         |         |
//! ```

use op::prelude::*;
use op::{Operation, change_curves, plan_curves};
use scene::Geometry;

/// Replaces curves with polylines whose points lie on the curves.
///
/// Each curve becomes one polyline in the plane z = 0. The polyline has `segments` + 1 points, at the curve parameters
/// 0, 1 / segments, 2 / segments and so on, up to 1. The first and the last point are exactly the first and the last
/// control point of the curve.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SampleCurve {
    /// The number of straight segments of each polyline.
    pub segments: Count<1, 65536>,
}

impl Operation for SampleCurve {
    const NAME: &'static str = "SampleCurve";
    const SUMMARY: &'static str = "Replace curves with polylines whose points lie on the curves";
    const EXAMPLE: &'static str = "SampleCurve(segments: 1)";
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        plan_curves(Self::NAME, plan, cx, |_| {
            (PlannedGeometry::Polylines, Vec::new())
        })
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let segments = self.segments.get();
        change_curves(Self::NAME, scene, cx, |curve| {
            // The time for a point grows with the square of the degree. Progress is reported about once per million
            // steps of the algorithm.
            let report_interval = 1 + (1 << 20) / (1 + curve.degree() * curve.degree());
            let mut line = Vec::with_capacity(segments as usize + 1);
            for p in curve.sample(segments) {
                if line.len() % report_interval == 0 {
                    cx.advance("sample", line.len() as u64, u64::from(segments) + 1)?;
                }
                line.push(p.extend(0.0));
            }
            Ok(Geometry::Polylines(vec![line]))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bezier::{Curve, DVec2, DVec3};
    use scene::Object;

    fn sample(segments: u32) -> SampleCurve {
        let segments = Count::literal(segments);
        SampleCurve { segments }
    }

    fn arch() -> Scene {
        let points = vec![DVec2::ZERO, DVec2::new(0.0, 4.0), DVec2::new(4.0, 4.0)];
        let mut scene = Scene::new();
        scene
            .insert(Object::new(
                "arch",
                Geometry::Curve(Curve::new(points).unwrap()),
            ))
            .unwrap();
        scene
    }

    #[test]
    fn the_polyline_lies_on_the_curve() {
        let mut scene = arch();
        let step: SampleCurve = op::test::read("(segments: 2)").unwrap();
        assert_eq!(op::test::run(&step, &mut scene).unwrap().changed, 1);
        let line = vec![
            DVec3::ZERO,
            DVec3::new(1.0, 3.0, 0.0),
            DVec3::new(4.0, 4.0, 0.0),
        ];
        assert_eq!(scene.objects()[0].geometry, Geometry::Polylines(vec![line]));
    }

    #[test]
    fn the_polyline_has_one_point_more_than_segments() {
        let mut scene = arch();
        op::test::run(&sample(65536), &mut scene).unwrap();
        let Geometry::Polylines(lines) = &scene.objects()[0].geometry else {
            panic!("polylines");
        };
        assert_eq!(lines[0].len(), 65537);
    }

    #[test]
    fn the_plan_turns_curves_into_polylines_and_reports_missing_curves() {
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        let step = sample(8);
        let mut plan = Plan::default();
        assert_eq!(step.plan(&mut plan, &cx).len(), 1);
        let curve = PlannedGeometry::Curve(Range::exactly(3));
        assert_eq!(plan.insert("arch", curve), None);
        assert_eq!(step.plan(&mut plan, &cx), []);
        assert_eq!(plan.objects()[0].geometry, PlannedGeometry::Polylines);
    }

    #[test]
    fn an_object_in_on_that_is_not_a_curve_is_refused() {
        let mut scene = arch();
        scene
            .insert(Object::new("lines", Geometry::Polylines(Vec::new())))
            .unwrap();
        let on = ["lines".to_owned()];
        let files = op::Files::default();
        let mut cx = Context::new(&op::NoProgress, &files);
        cx.on = Some(&on);
        let error = sample(8).apply(&mut scene, &mut cx).unwrap_err();
        assert_eq!(
            error.to_string(),
            "SampleCurve changes curves, but the type of \"lines\" is polylines"
        );
    }
}
