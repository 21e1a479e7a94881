//! A regular icosahedron.
//!
//! ```text
//!       0 ---- 1         the vertices are the corners of three rectangles with the side
//!      / \   / \         ratio 1 : (1 + √5) / 2, one in each coordinate plane
//!    ...   5   ...
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a regular icosahedron with 12 vertices and 20 triangles.
///
/// The vertices are the corners of three rectangles with the side ratio 1 : (1 + √5) / 2. The rectangles have the same
/// center, and each is parallel to a different coordinate plane.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Icosahedron {
    /// The name of the new object. Defaults to the first of the names `icosahedron`, `icosahedron.2`, `icosahedron.3`
    /// and so on that no other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The distance from the center to the vertices, in scene units. More than 0.
    #[serde(default = "crate::one")]
    pub radius: PositiveLength,
    /// The center of the icosahedron, in scene units.
    #[serde(default)]
    pub center: Vector,
}

impl Icosahedron {
    fn source(&self) -> Source<'_> {
        let counts = MeshPlan::counted(12, 30, 20, Range::exactly(3));
        Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "radius",
            [self.radius.get(); 3],
            self.center,
        )
    }
}

impl Operation for Icosahedron {
    const NAME: &'static str = "Icosahedron";
    const SUMMARY: &'static str = "Create a regular icosahedron";
    const EXAMPLE: &'static str = r#"Icosahedron(name: "new")"#;
    const WORDS: &'static [&'static str] = &["icosphere", "ball"];

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

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Icosahedron>(text).unwrap())
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
    fn the_icosahedron_is_closed_and_regular() {
        let mesh = made(r#"(name: "a")"#);
        assert!(mesh.is_closed());
        let side = mesh.length(mesh.edges().next().unwrap().half_edge());
        for e in mesh.edges() {
            assert!((mesh.length(e.half_edge()) - side).abs() < 1e-14);
        }
        // The volume of the regular icosahedron with radius 1 is 5 (3 + √5) a³ / 12, where a = 4 / √(10 + 2 √5).
        assert!((geometry::volume(&mesh) - 2.536_150_710_120_409).abs() < 1e-14);
    }
}
