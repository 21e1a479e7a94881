//! A regular tetrahedron.
//!
//! ```text
//!        0               the vertices are four of
//!       /|\              the eight corners of a cube
//!      / | \
//!     1--|--3
//!      \ | /
//!        2
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a regular tetrahedron with 4 vertices and 4 triangles.
///
/// The vertices are four of the eight corners of a cube with the same center. The signs of the coordinates of the
/// vertices, relative to the center, are (+, +, +), (-, -, +), (-, +, -) and (+, -, -), in this order.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Tetrahedron {
    /// The name of the new object. Defaults to the first of the names `tetrahedron`, `tetrahedron.2`, `tetrahedron.3`
    /// and so on that no other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The distance from the center to the vertices, in scene units. More than 0.
    #[serde(default = "crate::one")]
    pub radius: PositiveLength,
    /// The center of the tetrahedron, in scene units.
    #[serde(default)]
    pub center: Vector,
}

impl Tetrahedron {
    fn source(&self) -> Source<'_> {
        let counts = MeshPlan::counted(4, 6, 4, Range::exactly(3));
        Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "radius",
            [self.radius.get() / 3.0_f64.sqrt(); 3],
            self.center,
        )
    }
}

impl Operation for Tetrahedron {
    const NAME: &'static str = "Tetrahedron";
    const SUMMARY: &'static str = "Create a regular tetrahedron";
    const EXAMPLE: &'static str = r#"Tetrahedron(name: "new")"#;

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source().insert(scene, cx, shapes::tetrahedron)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, Mesh};

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Tetrahedron>(text).unwrap())
    }

    #[test]
    fn the_vertices_are_on_the_sphere() {
        let mesh = made(r#"(name: "a", radius: 3, center: (1, 2, 3))"#);
        let center = DVec3::new(1.0, 2.0, 3.0);
        assert!(
            mesh.positions()
                .iter()
                .all(|p| (p.distance(center) - 3.0).abs() < 1e-14)
        );
    }

    #[test]
    fn the_tetrahedron_is_closed_and_regular() {
        let mesh = made(r#"(name: "a")"#);
        assert!(mesh.is_closed());
        let side = mesh.length(mesh.edges().next().unwrap().half_edge());
        for e in mesh.edges() {
            assert!((mesh.length(e.half_edge()) - side).abs() < 1e-14);
        }
        // The volume of the regular tetrahedron with radius 1 is 8 / (9 √3).
        assert!((geometry::volume(&mesh) - 8.0 / (9.0 * 3.0_f64.sqrt())).abs() < 1e-14);
    }
}
