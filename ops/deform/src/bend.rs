//! Bend: bends a mesh, so that an axis becomes an arc of a circle.
//!
//! ```text
//!    to    +---+                     .---+
//!          |   |                  .'     |       The axis keeps its length. Its upper end turns by the angle
//!          |   |       -->       /   .---+       towards a second axis.
//!          |   |                |   |
//!    from  +---+                +---+
//! ```

use geometry::deform;
use op::Axis;
use op::prelude::*;

use crate::moved::{Stretch, moved, next};

/// Bends a mesh, so that an axis becomes an arc of a circle.
///
/// The parameters `from` and `to` are coordinates along the axis. Vertices at or below `from` do not move. Between
/// `from` and `to`, the axis becomes an arc of the same length. The direction of the arc turns by `angle` from one end
/// to the other. The part above `to` moves rigidly with the end of the arc. On the side of the axis towards the center
/// of the circle, vertices move closer together. On the other side, vertices move apart. The distance between the
/// center of the circle and the axis is (to - from) / angle, with the angle in radians. Parts of the mesh that lie
/// beyond the center of the circle, as seen from the axis, turn inside out. Source: Barr, "Global and Local
/// Deformations of Solid Primitives", 1984.
///
/// Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch with
/// the surface. Only vertices move, so refine the mesh first if its faces are large.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Bend {
    /// The direction of the axis that becomes an arc. The axis goes through the point `about`.
    pub axis: Axis,
    /// The angle by which the axis turns between `from` and `to`, in degrees. A negative angle bends to the other side.
    pub angle: Angle,
    /// The upper end bends in the positive direction of this coordinate axis. If omitted, this is the axis after `axis`
    /// in the order x, y, z, x.
    #[serde(default)]
    pub towards: Option<Axis>,
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

impl Bend {
    fn stretch(&self) -> Stretch {
        Stretch::new(self.axis, self.about, self.from, self.to)
    }

    /// Returns an error message if `towards` is the same axis as `axis`.
    fn same_axis(&self) -> Option<String> {
        let message = || format!("`towards` must not be the bent axis {:?}", self.axis);
        (self.towards == Some(self.axis)).then(message)
    }
}

impl MeshOperation for Bend {
    const NAME: &'static str = "Bend";
    const SUMMARY: &'static str = "Bend a mesh, so that an axis becomes an arc of a circle";
    const EXAMPLE: &'static str = "Bend(axis: Z, angle: 90)";
    const WORDS: &'static [&'static str] = &["curve", "arc", "curl", "deform"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        let mut problems = self.stretch().problems();
        problems.extend(
            self.same_axis()
                .map(|message| Problem::error(message).at(["towards"])),
        );
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mask = self.vertices.mask(mesh, cx)?;
        if let Some(message) = self.same_axis() {
            return Err(OpError::Parameter(message));
        }
        cx.advance("bend", 0, 1)?;
        let frame = self
            .stretch()
            .frame(mesh, self.towards.unwrap_or_else(|| next(self.axis)))?;
        let map = deform::Bend {
            frame,
            angle: self.angle.get(),
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

    fn parse(text: &str) -> Bend {
        op::test::read(text).unwrap()
    }

    #[test]
    fn the_ends_of_a_bar_are_at_right_angles_for_all_pairs_of_axes() {
        use std::f64::consts::PI;
        // The cube extends from -1 to 1. Its axis becomes a quarter of a circle with the radius 4 / pi.
        let radius = 4.0 / PI;
        let units = [("X", DVec3::X), ("Y", DVec3::Y), ("Z", DVec3::Z)];
        for (axis, a) in units {
            for (towards, t) in units {
                if axis == towards {
                    continue;
                }
                let step = parse(&format!("(axis: {axis}, angle: 90, towards: {towards})"));
                let after = applied_as_planned(&step, &shapes::cube());
                for (p, q) in shapes::cube().positions().iter().zip(after.positions()) {
                    let other = *p - a * a.dot(*p) - t * t.dot(*p);
                    let expected = if a.dot(*p) < 0.0 {
                        *p
                    } else {
                        other + t * radius + a * (radius - t.dot(*p) - 1.0)
                    };
                    assert!(q.distance(expected) < 1e-14, "{axis} {towards} {p} {q}");
                }
            }
        }
    }

    #[test]
    fn bending_towards_the_bent_axis_is_refused() {
        let step = parse("(axis: Z, angle: 90, towards: Z)");
        assert_eq!(planned(&step, &shapes::cube()).1.len(), 1);
        assert!(matches!(
            try_applied(&step, shapes::cube()),
            Err(OpError::Parameter(_))
        ));
    }

    #[test]
    fn an_angle_of_zero_moves_nothing() {
        let (after, _) = try_applied(&parse("(axis: X, angle: 0)"), shapes::cube()).unwrap();
        assert_eq!(after.positions(), shapes::cube().positions());
    }

    #[test]
    fn a_range_that_ends_before_it_starts_is_refused() {
        let step = parse("(axis: Z, angle: 2, from: 1, to: 0)");
        let (_, problems) = planned(&step, &shapes::cube());
        assert_eq!(problems.len(), 1);
        let beyond = parse("(axis: Z, angle: 2, from: 7)");
        for step in [step, beyond] {
            let refused = try_applied(&step, shapes::cube());
            assert!(matches!(refused, Err(OpError::Parameter(_))), "{refused:?}");
        }
    }
}
