//! Move vertices: moves selected vertices, and moves nearby vertices by a smaller distance.
//!
//! ```text
//!                                  v                     v
//!    ---+---v---+---   -->        / \         or     .-'   '-.
//!                             ---+   +---         --+         +--
//!                                            `falloff` is greater than 0
//! ```

use geometry::deform::{falloff, vertex_directions};
use mesh::{DMat3, DVec3, VertexId};
use op::prelude::*;
use op::{Axis, Turn};

use crate::moved::moved;

/// Moves vertices.
///
/// Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch with
/// the surface.
///
/// With `falloff: r`, vertices that are nearer than r to a selected vertex also move, but less far. At the distance d
/// from the nearest selected vertex, the movement is multiplied by the weight (1 - (d/r)²)². The weight is 1 at
/// selected vertices and falls smoothly to 0 at the distance r. Distances are measured along straight lines, not along
/// the surface.
///
/// With `by: Distance(..)`, each vertex moves along its own normal: the area-weighted mean of its face normals.
/// Vertices without a normal, such as isolated vertices, do not move. The report counts these vertices.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MoveVertices {
    /// The vertices to move.
    pub vertices: VertexSelection,
    /// How the vertices move.
    pub by: MoveBy,
    /// The distance from the selected vertices at which the movement becomes 0, in scene units. If omitted, only the
    /// selected vertices move.
    #[serde(default)]
    pub falloff: Option<PositiveLength>,
}

/// How vertices move.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum MoveBy {
    /// Moves by this offset along x, y and z, in scene units.
    Offset(Vector),
    /// Moves each vertex by this distance along its normal, in scene units. A negative distance moves vertices inwards.
    Distance(Distance),
    /// Moves all selected vertices by the same offset, so that the mean of their positions becomes this point.
    To(Vector),
    /// Rotates around an axis through the mean of the positions of the selected vertices.
    Rotate {
        /// The direction of the axis.
        axis: Axis,
        /// The angle in degrees, counter-clockwise when the axis points towards the viewer.
        angle: Angle,
    },
    /// Scales along x, y and z about the mean of the positions of the selected vertices. A factor of 0 along an axis
    /// gives all selected vertices the same coordinate along this axis.
    Scale(Vector),
}

impl MeshOperation for MoveVertices {
    const NAME: &'static str = "MoveVertices";
    const SUMMARY: &'static str = "Move vertices, and move nearby vertices by a smaller distance";
    const EXAMPLE: &'static str = "MoveVertices(vertices: Vertices([0]), by: Offset((0, 0, 0.5)))";
    const WORDS: &'static [&'static str] =
        &["translate", "drag", "proportional", "push", "inflate"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mut mask = self.vertices.mask(mesh, cx)?;
        cx.advance("move", 0, 1)?;
        let center = center(mesh, &mask).unwrap_or_default();
        let weights = self
            .falloff
            .map(|radius| falloff(mesh.positions(), &mask, radius.get()));
        if let Some(weights) = &weights {
            for (selected, &weight) in mask.iter_mut().zip(weights) {
                *selected = weight > 0.0;
            }
        }
        let weight = |v: VertexId| weights.as_ref().map_or(1.0, |w| w[v.index()]);
        let about = |map: DMat3| move |v, p: DVec3| p.lerp(center + map * (p - center), weight(v));
        match self.by {
            MoveBy::Offset(offset) => by(mesh, &mask, |v, p| p + weight(v) * offset.get()),
            MoveBy::To(point) => {
                let offset = point.get() - center;
                by(mesh, &mask, |v, p| p + weight(v) * offset)
            }
            MoveBy::Rotate { axis, angle } => by(mesh, &mask, about(Turn { axis, angle }.matrix())),
            MoveBy::Scale(factors) => by(mesh, &mask, about(DMat3::from_diagonal(factors.get()))),
            MoveBy::Distance(distance) => {
                let normals = vertex_directions(mesh);
                let selected = normals.iter().zip(&mask).filter(|(_, selected)| **selected);
                let without = selected.filter(|(n, _)| **n == DVec3::ZERO).count();
                let report = by(mesh, &mask, |v, p| {
                    p + weight(v) * distance.get() * normals[v.index()]
                })?;
                Ok(report.count("vertices without a normal, not moved", without))
            }
        }
    }
}

/// Moves the vertices of `mask` to new positions.
fn by(
    mesh: &mut Mesh,
    mask: &[bool],
    position: impl Fn(VertexId, DVec3) -> DVec3 + Sync,
) -> Result<Report, OpError> {
    moved(mesh, mask, MoveVertices::NAME, "by", position)
}

/// Returns the mean of the positions of the selected vertices.
fn center(mesh: &Mesh, mask: &[bool]) -> Option<DVec3> {
    let n = mask.iter().filter(|&&selected| selected).count() as f64;
    let selected = mesh.positions().iter().zip(mask).filter(|p| *p.1);
    let sum: DVec3 = selected.map(|p| *p.0 / n).sum();
    (n > 0.0).then_some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::VERTEX_NORMAL;
    use op::test::{applied_as_planned, try_applied};

    fn parse(text: &str) -> MoveVertices {
        op::test::read(text).unwrap()
    }

    #[test]
    fn only_selected_vertices_move_and_normals_are_dropped() {
        let mut cube = shapes::cube();
        cube.set(VERTEX_NORMAL, vec![DVec3::Z; 8]);
        let step = parse("(vertices: Vertices([0, 3]), by: Offset((1, 2, 3)))");
        let after = applied_as_planned(&step, &cube);
        for (i, (p, q)) in cube.positions().iter().zip(after.positions()).enumerate() {
            let by = if i == 0 || i == 3 {
                DVec3::new(1.0, 2.0, 3.0)
            } else {
                DVec3::ZERO
            };
            assert_eq!(*q, *p + by);
        }
        assert!(after.get(VERTEX_NORMAL).is_none());
    }

    #[test]
    fn the_opposite_offset_is_the_inverse() {
        let mesh = shapes::torus(12, 9, 2.0, 0.7);
        let text = |z| format!("(vertices: Vertices([5]), by: Offset((0, 0, {z})))");
        let there = applied_as_planned(&parse(&text(1)), &mesh);
        let back = applied_as_planned(&parse(&text(-1)), &there);
        for (p, q) in mesh.positions().iter().zip(back.positions()) {
            assert!(p.distance(*q) < 1e-15);
        }
        assert!(
            op::test::read::<MoveVertices>("(vertices: All, by: Distance(1), falloff: 0)").is_err()
        );
    }

    #[test]
    fn the_center_of_the_selection_comes_to_the_point() {
        let step = parse("(vertices: Vertices([0, 1, 4, 5]), by: To((1, 2, 3)))");
        let after = applied_as_planned(&step, &shapes::cube());
        let moved = [0, 1, 4, 5].map(|v| after.positions()[v]);
        assert!((moved.iter().sum::<DVec3>() / 4.0).distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-15);
    }

    #[test]
    fn a_rotation_and_a_scaling_keep_the_mean_of_the_selection() {
        let cube = shapes::cube();
        let top = [0, 1, 4, 5];
        let mean = |mesh: &Mesh| top.map(|v| mesh.positions()[v]).iter().sum::<DVec3>() / 4.0;
        let center = mean(&cube);
        let step = |by| parse(&format!("(vertices: Vertices([0, 1, 4, 5]), by: {by})"));
        let quarter = applied_as_planned(&step("Rotate(axis: Y, angle: 90)"), &cube);
        let scaled = applied_as_planned(&step("Scale((2, 1, 0))"), &cube);
        for after in [&quarter, &scaled] {
            assert_eq!(mean(after), center);
            for v in [2, 3, 6, 7] {
                assert_eq!(after.positions()[v], cube.positions()[v]);
            }
        }
        for v in top {
            let [before, turned, scaled] =
                [&cube, &quarter, &scaled].map(|mesh| mesh.positions()[v] - center);
            assert_eq!(turned, DVec3::new(before.z, before.y, -before.x));
            assert_eq!(scaled, DVec3::new(2.0 * before.x, before.y, 0.0));
        }
        let half = shapes::grid(8, 8);
        let with = |by| {
            let text = format!("(vertices: Nearest(to: (0, 0, 0)), by: {by}, falloff: 0.5)");
            applied_as_planned(&parse(&text), &half)
        };
        // The selected vertex is the center of the scaling and does not move. The scale factor is at most 3. A vertex
        // at the distance d from the selected vertex therefore moves by at most 2 d. Only vertices with d < 0.5 move.
        let after = with("Scale((3, 3, 3))");
        let moved = half.positions().iter().zip(after.positions());
        assert!(
            moved
                .filter(|(p, q)| p != q)
                .all(|(p, q)| q.distance(*p) <= 2.0 * 0.5)
        );
    }

    #[test]
    fn the_movement_falls_with_the_distance() {
        let grid = shapes::grid(20, 20);
        let step = parse("(vertices: Nearest(to: (0, 0, 0)), by: Offset((0, 0, 1)), falloff: 0.5)");
        let (after, report) = try_applied(&step, grid.clone()).unwrap();
        let top = after.positions().iter().position(|p| p.z == 1.0).unwrap();
        for (p, q) in grid.positions().iter().zip(after.positions()) {
            let d = p.distance(grid.positions()[top]).min(0.5) / 0.5;
            assert!((q.z - (1.0 - d * d) * (1.0 - d * d)).abs() < 1e-12);
        }
        let raised = after.positions().iter().filter(|p| p.z > 0.0).count();
        assert_eq!(report.changed, raised as u64);
    }

    #[test]
    fn a_sphere_grows_along_its_normals() {
        let mesh = shapes::icosahedron();
        let after = applied_as_planned(&parse("(vertices: All, by: Distance(0.5))"), &mesh);
        for (p, q) in mesh.positions().iter().zip(after.positions()) {
            assert!(q.distance(1.5 * *p) < 1e-14);
        }
    }

    #[test]
    fn vertices_without_a_normal_are_counted() {
        let mut mesh = shapes::cube();
        mesh.positions_mut().fill(DVec3::ONE);
        let (after, report) =
            try_applied(&parse("(vertices: All, by: Distance(1))"), mesh).unwrap();
        assert_eq!(after.positions()[0], DVec3::ONE);
        assert_eq!(report.notes, ["vertices without a normal, not moved: 8"]);
    }

    #[test]
    fn coordinates_that_are_too_large_are_refused() {
        let mut mesh = shapes::cube();
        mesh.positions_mut()[0].x = 1.7e308;
        let step = parse("(vertices: All, by: Offset((1.7e308, 0, 0)))");
        assert!(matches!(
            try_applied(&step, mesh),
            Err(OpError::Parameter(_))
        ));
    }
}
