//! A regular icosahedron.
//!
//! ```text
//!       0 ---- 1         the corners of three rectangles of sides 1 : (1 + √5) / 2,
//!      / \   / \         one in each of the planes of the axes
//!    ...   5   ...
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Makes a regular icosahedron: 12 vertices, 20 triangles.
///
/// Its corners are those of three golden rectangles in the planes of the axes.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Icosahedron {
    /// The name of the new object.
    pub name: String,
    /// The distance from the middle to its corners, in scene units; above 0.
    #[serde(default = "crate::one")]
    pub radius: PositiveLength,
    /// Where its middle is, in scene units.
    #[serde(default)]
    pub center: Vector,
}

impl Icosahedron {
    fn source(&self) -> Source<'_> {
        let counts = MeshPlan::counted(12, 30, 20, Range::exactly(3));
        Source::new(&self.name, counts).placed(
            Self::NAME,
            "radius",
            [self.radius.get(); 3],
            self.center,
        )
    }
}

impl Operation for Icosahedron {
    const NAME: &'static str = "Icosahedron";
    const SUMMARY: &'static str = "Make a regular icosahedron";
    const EXAMPLE: &'static str = r#"Icosahedron(name: "new")"#;

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source().insert(scene, cx, shapes::icosahedron)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, Mesh};

    /// The mesh that the recipe text makes.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Icosahedron>(text).unwrap())
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
        // The volume of the regular icosahedron of radius 1: 5 (3 + √5) a³ / 12, a = 4 / √(10 + 2 √5).
        assert!((geometry::volume(&mesh) - 2.536_150_710_120_409).abs() < 1e-14);
    }
}
