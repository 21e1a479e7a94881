//! A regular octahedron.
//!
//! ```text
//!          4           z
//!        / | \         |  y
//!      1 - - - 0       | /
//!        \ | /         |/
//!          5           +---- x      2 is behind, 3 in front
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Makes a regular octahedron: 6 vertices, 8 triangles.
///
/// Its corners lie on the axes through its middle: +x, -x, +y, -y, +z, -z.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Octahedron {
    /// The name of the new object.
    pub name: String,
    /// The distance from the middle to its corners, in scene units; above 0.
    #[serde(default = "crate::one")]
    pub radius: PositiveLength,
    /// Where its middle is, in scene units.
    #[serde(default)]
    pub center: Vector,
}

impl Octahedron {
    fn source(&self) -> Source<'_> {
        let counts = MeshPlan::counted(6, 12, 8, Range::exactly(3));
        Source::new(&self.name, counts).placed(
            Self::NAME,
            "radius",
            [self.radius.get(); 3],
            self.center,
        )
    }
}

impl Operation for Octahedron {
    const NAME: &'static str = "Octahedron";
    const SUMMARY: &'static str = "Make a regular octahedron";
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

    /// The mesh that the recipe text makes.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Octahedron>(text).unwrap())
    }

    #[test]
    fn its_corners_lie_on_the_sphere() {
        let mesh = made(r#"(name: "a", radius: 3, center: (1, 2, 3))"#);
        let center = DVec3::new(1.0, 2.0, 3.0);
        assert!(
            mesh.positions()
                .iter()
                .all(|p| (p.distance(center) - 3.0).abs() < 1e-14)
        );
    }

    #[test]
    fn it_is_closed_and_regular() {
        let mesh = made(r#"(name: "a")"#);
        assert!(mesh.is_closed());
        let side = mesh.length(mesh.edges().next().unwrap().half_edge());
        for e in mesh.edges() {
            assert!((mesh.length(e.half_edge()) - side).abs() < 1e-14);
        }
        // The volume of the regular octahedron of radius 1 is 4 / 3.
        assert!((geometry::volume(&mesh) - 4.0 / 3.0).abs() < 1e-14);
    }
}
