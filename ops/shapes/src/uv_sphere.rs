//! A sphere of meridians and rings, as on a globe.
//!
//! ```text
//!          .-^-.            triangles at the poles,
//!        /  / \  \          quadrilaterals between
//!       |--|---|--|
//!       |--|---|--|         around: meridians; rings: bands of faces from pole to pole
//!        \  \ /  /
//!          '-v-'
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a sphere whose edges follow meridians and circles of latitude, with poles at -z and +z.
///
/// Vertex 0 is the pole at -z. The vertices between the poles follow, circle by circle from -z to +z. The first vertex
/// of each circle is in the direction +x from the axis, and the others follow counter-clockwise, seen from +z. The last
/// vertex is the pole at +z.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct UvSphere {
    /// The name of the new object. Defaults to the first of the names `uvsphere`, `uvsphere.2`, `uvsphere.3` and so on
    /// that no other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The number of meridians. At least 3. Defaults to 32.
    #[serde(default = "crate::thirty_two")]
    pub around: Count<3>,
    /// The number of bands of faces from pole to pole. At least 2. Defaults to 16.
    #[serde(default = "sixteen")]
    pub rings: Count<2>,
    /// The distance from the center to the vertices, in scene units. More than 0.
    #[serde(default = "crate::one")]
    pub radius: PositiveLength,
    /// The center of the sphere, in scene units.
    #[serde(default)]
    pub center: Vector,
}

const fn sixteen() -> Count<2> {
    Count::literal(16)
}

impl UvSphere {
    fn source(&self) -> Source<'_> {
        let (around, rings) = (u64::from(self.around.get()), u64::from(self.rings.get()));
        // The sphere has `rings - 1` circles of vertices. `rings` is at least 2.
        let circles = rings.saturating_sub(1);
        let on_circles = around.saturating_mul(circles);
        let faces = around.saturating_mul(rings);
        let edges = on_circles.saturating_add(faces);
        let degrees = Range::between(3, if rings > 2 { 4 } else { 3 });
        let counts = MeshPlan::counted(on_circles.saturating_add(2), edges, faces, degrees);
        Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "radius",
            [self.radius.get(); 3],
            self.center,
        )
    }
}

impl Operation for UvSphere {
    const NAME: &'static str = "UvSphere";
    const SUMMARY: &'static str =
        "Create a sphere whose edges follow meridians and circles of latitude";
    const EXAMPLE: &'static str = r#"UvSphere(name: "new", around: 8, rings: 4, radius: 2)"#;
    const WORDS: &'static [&'static str] = &["sphere", "ball"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source().insert(scene, cx, || {
            shapes::uv_sphere(self.around.get(), self.rings.get())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, Mesh};

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<UvSphere>(text).unwrap())
    }

    #[test]
    fn spheres_are_closed_for_every_number_of_rings() {
        for (around, rings) in [(3, 2), (4, 3), (7, 5)] {
            let mesh = made(&format!(r#"(name: "a", around: {around}, rings: {rings})"#));
            assert!(mesh.is_closed());
            assert_eq!(mesh.euler_characteristic(), 2);
            assert!(geometry::volume(&mesh) > 0.0);
        }
    }

    #[test]
    fn the_vertices_are_on_the_sphere() {
        let mesh = made(r#"(name: "a", around: 8, rings: 6, radius: 2, center: (0, 3, 0))"#);
        let center = DVec3::new(0.0, 3.0, 0.0);
        assert!(
            mesh.positions()
                .iter()
                .all(|p| (p.distance(center) - 2.0).abs() < 1e-14)
        );
    }

    #[test]
    fn too_many_faces_are_refused() {
        let text = r#"(name: "a", around: 4294967295, rings: 4294967295)"#;
        let step: UvSphere = op::test::read(text).unwrap();
        let made = op::test::run(&step, &mut Scene::new());
        assert!(matches!(made, Err(OpError::Budget(_))));
    }
}
