//! Taper: scales around an axis, by a factor that changes along the axis.
//!
//! ```text
//!    to    +-----+                 +---+         A vertex at the height h is scaled by
//!          |     |                /     \
//!          |     |       -->     /       \           1 + (factor - 1) (h - from) / (to - from)
//!    from  +-----+              +---------+
//!                                               limited to the range from 1 to factor.
//! ```

use geometry::deform;
use op::Axis;
use op::prelude::*;

use crate::moved::{Stretch, moved, next};

/// Scales vertices towards or away from an axis, by a factor that changes along the axis.
///
/// Along the axis, the factor changes linearly from 1 at the coordinate `from` to `factor` at the coordinate `to`.
/// Vertices below `from` do not move, and vertices above `to` are scaled by `factor`. Coordinates along the axis do not
/// change. Source: Barr, "Global and Local Deformations of Solid Primitives", 1984.
///
/// Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch with
/// the surface. Only vertices move, so refine the mesh first if its faces are large.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Taper {
    /// The direction of the axis. The axis goes through the point `about`, and points on the axis do not move.
    pub axis: Axis,
    /// The scale factor at the coordinate `to`. More than 0. A factor below 1 makes the upper end narrower.
    pub factor: PositiveFactor,
    /// A point on the axis. The coordinate of the point along the axis does not matter.
    #[serde(default)]
    pub about: Vector,
    /// The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate of the mesh
    /// along the axis.
    #[serde(default)]
    pub from: Option<Distance>,
    /// The coordinate along the axis at which the deformation reaches its full amount. If omitted, the highest
    /// coordinate of the mesh along the axis. Must not be less than `from`.
    #[serde(default)]
    pub to: Option<Distance>,
    /// The vertices to move. If omitted, all vertices.
    #[serde(default)]
    pub vertices: VertexSelection,
}

impl Taper {
    fn stretch(&self) -> Stretch {
        Stretch::new(self.axis, self.about, self.from, self.to)
    }
}

impl MeshOperation for Taper {
    const NAME: &'static str = "Taper";
    const SUMMARY: &'static str =
        "Scale vertices around an axis, by a factor that changes along the axis";
    const EXAMPLE: &'static str = "Taper(axis: Z, factor: 0.5)";
    const WORDS: &'static [&'static str] = &["cone", "narrow", "scale", "deform"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        self.stretch().problems()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mask = self.vertices.mask(mesh, cx)?;

        cx.advance("taper", 0, 1)?;
        let frame = self.stretch().frame(mesh, next(self.axis))?;
        let map = deform::Taper {
            frame,
            factor: self.factor.get(),
        };
        moved(mesh, &mask, Self::NAME, "its parameters", |_, p| {
            map.point(p)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::DVec3;
    use op::test::{applied_as_planned, planned, try_applied};

    fn parse(text: &str) -> Taper {
        op::test::read(text).unwrap()
    }

    #[test]
    fn a_cube_becomes_a_frustum() {
        for axis in ["X", "Y", "Z"] {
            let step = parse(&format!("(axis: {axis}, factor: 0.5)"));
            let after = applied_as_planned(&step, &shapes::cube());
            let expected = 2.0 / 3.0 * (4.0 + 1.0 + 2.0);
            assert!((geometry::volume(&after) - expected).abs() < 1e-13);
        }
    }

    #[test]
    fn only_the_upper_end_moves_and_the_point_sets_the_axis() {
        let after = applied_as_planned(
            &parse("(axis: Z, factor: 3, about: (1, 1, 5))"),
            &shapes::cube(),
        );
        for (p, q) in shapes::cube().positions().iter().zip(after.positions()) {
            let wide = DVec3::new(1.0 + 3.0 * (p.x - 1.0), 1.0 + 3.0 * (p.y - 1.0), p.z);
            assert!(q.distance(if p.z > 0.0 { wide } else { *p }) < 1e-15);
        }
    }

    #[test]
    fn a_range_that_ends_before_it_starts_is_refused() {
        let step = parse("(axis: Z, factor: 2, from: 1, to: 0)");
        let (_, problems) = planned(&step, &shapes::cube());
        assert_eq!(problems.len(), 1);
        let beyond = parse("(axis: Z, factor: 2, from: 7)");
        for step in [step, beyond] {
            let refused = try_applied(&step, shapes::cube());
            assert!(matches!(refused, Err(OpError::Parameter(_))), "{refused:?}");
        }
    }
}
