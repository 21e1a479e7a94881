//! Symmetrize: replaces one half of a mesh with the mirror image of the other half.
//!
//! ```text
//!     +---.   |  .                     +---.   |   .---+
//!     |    '--m-'  '                   |    '--m--'    |
//!     |       |     '         -->      |       |       |
//!     |    .--m----'                   |    .--m--.    |
//!     +---'   |                        +---'   |   '---+
//! ```

use geometry::{SymmetrizeError, symmetrize};
use op::prelude::*;

/// Replaces one half of a mesh with the mirror image of the other half.
///
/// The mesh is cut along a plane, as with `Bisect`. The half on the side `from` is kept and mirrored, and the halves
/// are joined at the plane. Vertices near the plane (see `Bisect`) are moved exactly onto the plane, so that the result
/// is symmetric. Faces that lie in the plane are removed, because they would become walls inside the result. A vertex
/// on the plane joins the halves if it is on the boundary of the kept half. Where the surface only touches the plane,
/// without a boundary there, the halves are not joined. The report counts the faces that are removed completely, but
/// not the faces that the plane cuts.
///
/// The elements of the kept half come first, in their old order. The elements of the mirror image follow. Attributes
/// are copied, so both halves have the same texture coordinates, tags and joint weights. Normals and tangents are
/// dropped.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Symmetrize {
    /// A point on the plane.
    #[serde(default)]
    pub point: Vector,
    /// The normal of the plane. It points to the front side. The length of the normal does not matter but must not
    /// be 0.
    pub normal: Direction,
    /// The half that is kept and mirrored.
    #[serde(default)]
    pub from: Side,
}

/// A side of a plane.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SymmetrizeSide")]
pub enum Side {
    /// The side in front of the plane: the normal of the plane points to this side.
    #[default]
    Front,
    /// The side behind the plane: the normal of the plane points away from this side.
    Back,
}

impl MeshOperation for Symmetrize {
    const NAME: &'static str = "Symmetrize";
    const SUMMARY: &'static str =
        "Replace one half of a mesh with the mirror image of the other half";
    const EXAMPLE: &'static str = "Symmetrize(normal: (1, 0, 0))";
    const WORDS: &'static [&'static str] = &["mirror", "reflect", "plane"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // The largest possible counts are twice those in the plan of `Bisect`, because the kept half is doubled.
        let per_face = plan.degrees.max / 2;
        let crossings = plan.edges.or_less();
        let cuts = plan.faces.by(per_face).capped(crossings.max).or_less();
        plan.grow(crossings, crossings.plus(cuts), cuts);
        plan.degrees = Range::between(3, plan.degrees.max.saturating_add(per_face));
        plan.vertices = plan.vertices.plus(plan.edges).by(2).or_less();
        plan.edges = plan.edges.by(2).or_less();
        plan.faces = plan.faces.by(2).or_less();
        plan.drop_normals();
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("symmetrize", 0, 1)?;
        let normal = match self.from {
            Side::Front => self.normal.get(),
            Side::Back => -self.normal.get(),
        };
        let done = symmetrize(mesh, self.point.get(), normal).map_err(|error| match error {
            SymmetrizeError::Cut(error) => OpError::from(error),
            SymmetrizeError::Join(error) => OpError::from(error),
        })?;
        Ok(Report::changed(mesh.n_faces() / 2)
            .count("faces removed", done.removed)
            .count("vertices at which the halves are joined", done.joined))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::test::applied_as_planned;

    fn step(text: &str) -> Symmetrize {
        op::test::read(text).unwrap()
    }

    #[test]
    fn either_half_can_be_kept() {
        let mut mesh = shapes::cube();
        for p in mesh.positions_mut() {
            *p = p.with_x(if p.x > 0.0 { 3.0 } else { -1.0 });
        }
        for (from, volume) in [("Front", 24.0), ("Back", 8.0)] {
            let text = format!("(normal: (2, 0, 0), from: {from})");
            let after = applied_as_planned(&step(&text), &mesh);
            assert!(after.is_closed());
            assert!((geometry::volume(&after) - volume).abs() < 1e-12);
        }
    }

    #[test]
    fn open_meshes_are_joined_at_the_plane_only() {
        let after = applied_as_planned(&step("(normal: (0, 1, 0))"), &shapes::grid(4, 4));
        assert_eq!(op::test::counts(&after), [25, 40, 16]);
    }
}
