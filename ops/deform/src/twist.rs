//! Twist: rotates around an axis, by an angle that grows along the axis.
//!
//! ```text
//!    to    +-----+                \---\         A vertex at the height h rotates by
//!          |     |                 )   )
//!          |     |       -->      /   /             angle (h - from) / (to - from)
//!          |     |               (   (
//!    from  +-----+                +---+         limited to the range from 0 to angle.
//! ```

use geometry::deform;
use op::Axis;
use op::prelude::*;

use crate::moved::{Stretch, moved, next};

/// Rotates vertices around an axis, by an angle that grows along the axis.
///
/// Along the axis, the angle grows linearly from 0 at the coordinate `from` to `angle` at the coordinate `to`. Vertices
/// below `from` do not move, and vertices above `to` rotate by `angle`. An exact twist keeps the volume. The edges of a
/// mesh stay straight, so the volume of the mesh changes slightly. The change is small if the mesh is fine. A second
/// twist with the opposite angle and the same other parameters undoes the first twist. Source: Barr, "Global and Local
/// Deformations of Solid Primitives", 1984.
///
/// Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch with
/// the surface. Only vertices move, so refine the mesh first if its faces are large.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Twist {
    /// The direction of the axis of the rotation. The axis goes through the point `about`.
    pub axis: Axis,
    /// The angle at `to`, in degrees, counter-clockwise if the axis points to the viewer.
    pub angle: Angle,
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

impl Twist {
    fn stretch(&self) -> Stretch {
        Stretch::new(self.axis, self.about, self.from, self.to)
    }
}

impl MeshOperation for Twist {
    const NAME: &'static str = "Twist";
    const SUMMARY: &'static str =
        "Rotate vertices around an axis, by an angle that grows along the axis";
    const EXAMPLE: &'static str = "Twist(axis: Z, angle: 90)";
    const WORDS: &'static [&'static str] = &["screw", "turn", "deform"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        self.stretch().problems()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mask = self.vertices.mask(mesh, cx)?;

        cx.advance("twist", 0, 1)?;
        let frame = self.stretch().frame(mesh, next(self.axis))?;
        let map = deform::Twist {
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

    fn parse(text: &str) -> Twist {
        op::test::read(text).unwrap()
    }

    #[test]
    fn the_top_of_a_cube_turns_and_the_bottom_stays() {
        let after = applied_as_planned(&parse("(axis: Z, angle: 90)"), &shapes::cube());
        for (p, q) in shapes::cube().positions().iter().zip(after.positions()) {
            let turned = DVec3::new(-p.y, p.x, p.z);
            assert!(q.distance(if p.z > 0.0 { turned } else { *p }) < 1e-15);
        }
    }

    #[test]
    fn the_opposite_angle_is_the_inverse_along_all_axes() {
        let mesh = shapes::torus(16, 12, 2.0, 0.7);
        for axis in ["X", "Y", "Z"] {
            let text = |angle| {
                format!("(axis: {axis}, angle: {angle}, about: (0.3, -2, 1), from: -0.5, to: 1)")
            };
            let there = applied_as_planned(&parse(&text(77)), &mesh);
            let back = applied_as_planned(&parse(&text(-77)), &there);
            let pairs = mesh.positions().iter().zip(back.positions());
            assert!(pairs.into_iter().all(|(p, q)| p.distance(*q) < 1e-12));
        }
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
