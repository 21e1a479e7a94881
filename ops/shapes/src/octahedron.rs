//! A regular octahedron.
//!
//! ```text
//!          4           z
//!        / | \         |  y
//!      1 - - - 0       | /
//!        \ | /         |/
//!          5           +---- x      2 is behind, 3 is in front
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a regular octahedron with 6 vertices and 8 triangles.
///
/// The vertices are in the directions +x, -x, +y, -y, +z and -z from the center, in this order.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Octahedron {
    /// The name of the new object. Defaults to the first of the names `octahedron`, `octahedron.2`, `octahedron.3` and
    /// so on that no other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The distance from the center to the vertices, in scene units. More than 0.
    #[serde(default = "crate::one")]
    pub radius: PositiveLength,
    /// The center of the octahedron, in scene units.
    #[serde(default)]
    pub center: Vector,
}

impl Octahedron {
    fn source(&self) -> Source<'_> {
        let counts = MeshPlan::counted(6, 12, 8, Range::exactly(3));
        Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "radius",
            [self.radius.get(); 3],
            self.center,
        )
    }
}

impl Operation for Octahedron {
    const NAME: &'static str = "Octahedron";
    const SUMMARY: &'static str = "Create a regular octahedron";
    const EXAMPLE: &'static str = r#"Octahedron(name: "new")"#;

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source().insert(scene, cx, shapes::octahedron)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, Mesh};

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Octahedron>(text).unwrap())
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
    fn the_octahedron_is_closed_and_regular() {
        let mesh = made(r#"(name: "a")"#);
        assert!(mesh.is_closed());
        let side = mesh.length(mesh.edges().next().unwrap().half_edge());
        for e in mesh.edges() {
            assert!((mesh.length(e.half_edge()) - side).abs() < 1e-14);
        }
        // The volume of the regular octahedron with radius 1 is 4 / 3.
        assert!((geometry::volume(&mesh) - 4.0 / 3.0).abs() < 1e-14);
    }
}
