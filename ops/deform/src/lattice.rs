//! Lattice: deforms a mesh with a box of control points.
//!
//! ```text
//!    o-----o-----o           o-----o----__o       Each point of the box is a Bernstein sum of the control points:
//!    | +-----+   |           | +--------/ /
//!    o |   o |   o    -->    o |   o   ( o        p = sum over i, j, k of B(i) B(j) B(k) c(i, j, k)
//!    | +-----+   |           | +--------\ \
//!    o-----o-----o           o-----o----~~o
//! ```

use geometry::deform;
use mesh::DVec3;
use op::prelude::*;

use crate::moved::moved;

/// Deforms vertices with a box of control points.
///
/// The box contains a regular grid of control points. `size` gives the number of control points along x, y and z.
/// `moves` gives offsets for some of the control points. The space in the box follows the moved points smoothly. The
/// new position of a point in the box is a weighted sum of the new positions of all control points. The weights are
/// Bernstein polynomials (Sederberg, Parry, "Free-Form Deformation of Solid Geometric Models", 1986). If all control
/// points move by the same offset, the whole box moves by this offset. If only one control point moves, the points in
/// the box move in the same direction, but less far. However, if the control point is at a corner of the box, this
/// corner moves exactly as far as the control point.
///
/// Vertices outside the box do not move. Normals and tangents are dropped. Faces, element ids and other attributes do
/// not change, so textures stretch with the surface. Only vertices move, so refine the mesh first if its faces are
/// large.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Lattice {
    /// The numbers of control points along x, y and z. Each number is from 2 to 16.
    pub size: [Count<2, 16>; 3],
    /// The control points that move. Each entry consists of the three indices of a control point (along x, y and z,
    /// counted from 0) and the offset of this point in scene units. A control point that is listed several times moves
    /// by the sum of its offsets.
    pub moves: Vec<([u32; 3], Vector)>,
    /// The corner of the box with the lowest coordinates. If omitted, the same corner of the bounding box of the mesh
    /// is used.
    #[serde(default)]
    pub min: Option<Vector>,
    /// The corner of the box with the highest coordinates. If omitted, the same corner of the bounding box of the mesh
    /// is used.
    #[serde(default)]
    pub max: Option<Vector>,
    /// The vertices to move. If omitted, all vertices.
    #[serde(default)]
    pub vertices: VertexSelection,
}

impl Lattice {
    /// Returns an error message about the first entry of `moves` whose control point does not exist.
    fn bad_moves(&self) -> Option<String> {
        let [x, y, z] = self.size.map(Count::get);
        let outside = |point: &[u32; 3]| point.iter().zip([x, y, z]).any(|(&i, n)| i >= n);
        let ([i, j, k], _) = self.moves.iter().find(|(point, _)| outside(point))?;
        Some(format!(
            "`moves` names the control point ({i}, {j}, {k}), which does not exist: `size` is ({x}, {y}, {z}), and indices start at 0"
        ))
    }

    /// Returns the lattice that fills the box between the corners `min` and `max`.
    fn lattice(&self, min: DVec3, max: DVec3) -> deform::Lattice {
        let size = self.size.map(|n| n.get() as usize);
        let mut offsets = vec![DVec3::ZERO; size.iter().product()];
        for ([i, j, k], offset) in &self.moves {
            let [i, j, k] = [i, j, k].map(|&n| n as usize);
            offsets[(i * size[1] + j) * size[2] + k] += offset.get();
        }
        deform::Lattice {
            min,
            max,
            size,
            offsets,
        }
    }
}

impl MeshOperation for Lattice {
    const NAME: &'static str = "Lattice";
    const SUMMARY: &'static str = "Deform vertices with a box of control points";
    const EXAMPLE: &'static str = "Lattice(size: (3, 3, 3), moves: [((2, 2, 2), (0.5, 0.5, 0.5))])";
    const WORDS: &'static [&'static str] = &["cage", "ffd", "free-form", "warp"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        let problem = |message| Problem::error(message).at(["moves"]);
        Vec::from_iter(self.bad_moves().map(problem))
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mask = self.vertices.mask(mesh, cx)?;
        if let Some(message) = self.bad_moves() {
            return Err(OpError::Parameter(message));
        }
        cx.advance("deform", 0, 1)?;
        let [low, high] = geometry::bounds(mesh).unwrap_or_default();
        let min = self.min.map_or(low, Vector::get);
        let max = self.max.map_or(high, Vector::get);
        if min.cmpgt(max).any() {
            return Err(OpError::Parameter(format!(
                "`min` must not exceed `max`, found {min} and {max}; an omitted corner defaults to the corner of the \
                 bounding box"
            )));
        }
        let map = self.lattice(min, max);
        moved(mesh, &mask, Self::NAME, "moves", |_, p| map.point(p))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::test::{applied_as_planned, planned, try_applied};

    fn step(text: &str) -> Lattice {
        op::test::read(text).unwrap()
    }

    #[test]
    fn corners_follow_their_control_points() {
        let step = step("(size: (3, 2, 4), moves: [((2, 1, 3), (0.5, 1, 2))])");
        let after = applied_as_planned(&step, &shapes::cube());
        for (p, q) in shapes::cube().positions().iter().zip(after.positions()) {
            let offset = if *p == DVec3::ONE {
                DVec3::new(0.5, 1.0, 2.0)
            } else {
                DVec3::ZERO
            };
            assert!(q.distance(*p + offset) < 1e-12);
        }
    }

    #[test]
    fn moving_all_control_points_moves_the_mesh() {
        let all = (0..3).flat_map(|i| (0..2).flat_map(move |j| (0..2).map(move |k| (i, j, k))));
        let moves: Vec<String> = all.map(|p| format!("({p:?}, (1, -2, 3))")).collect();
        let text = format!("(size: (3, 2, 2), moves: [{}])", moves.join(", "));
        let mesh = shapes::torus(12, 8, 1.0, 0.4);
        let after = applied_as_planned(&step(&text), &mesh);
        let offset = DVec3::new(1.0, -2.0, 3.0);
        let pairs = mesh.positions().iter().zip(after.positions());
        assert!(
            pairs
                .into_iter()
                .all(|(p, q)| q.distance(*p + offset) < 1e-12)
        );
    }

    #[test]
    fn the_middle_follows_the_bernstein_polynomials() {
        // In a direction with 3 control points, the weights at the middle of the lattice are 1/4, 1/2 and 1/4.
        let mut mesh = shapes::cube();
        mesh.set_position(mesh::VertexId::new(0), DVec3::ZERO);
        let step = step("(size: (3, 3, 3), moves: [((1, 1, 1), (8, 0, 0))])");
        let after = applied_as_planned(&step, &mesh);
        let moved = after.position(mesh::VertexId::new(0));
        assert!(moved.distance(DVec3::X) < 1e-12, "{moved}");
    }

    #[test]
    fn vertices_outside_the_box_stay() {
        let step = step(
            "(size: (2, 2, 2), moves: [((1, 1, 1), (1, 1, 1))], min: (0, 0, 0), max: (2, 2, 2))",
        );
        let (after, report) = try_applied(&step, shapes::cube()).unwrap();
        assert_eq!(report.changed, 1);
        assert!(after.positions().contains(&DVec3::splat(1.125)));
    }

    #[test]
    fn missing_control_points_and_reversed_boxes_are_refused() {
        let missing = step("(size: (2, 2, 2), moves: [((2, 0, 0), (1, 0, 0))])");
        let (_, problems) = planned(&missing, &shapes::cube());
        assert_eq!(problems.len(), 1);
        let reversed = step("(size: (2, 2, 2), moves: [], min: (7, 0, 0))");
        for step in [missing, reversed] {
            let refused = try_applied(&step, shapes::cube());
            assert!(matches!(refused, Err(OpError::Parameter(_))), "{refused:?}");
        }
    }
}
