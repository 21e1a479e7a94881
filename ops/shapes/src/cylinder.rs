//! A cylinder around the z axis.
//!
//! ```text
//!     .--------.        caps: two faces with `around` corners
//!    |\________/|
//!    |  |    |  |       `around` rectangles
//!    |  |    |  |
//!     \_|____|_/
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a cylinder around the z axis.
///
/// The vertices of the rim at -z come first, and then the vertices of the rim at +z. The first vertex of each rim is in
/// the direction +x from the axis, and the others follow counter-clockwise, seen from +z. The rectangles around the
/// axis are the faces with the lowest ids. With `caps: true`, the two caps follow: first the cap at -z, then the cap
/// at +z. Each cap is one polygon.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// The name of the new object. Defaults to the first of the names `cylinder`, `cylinder.2`, `cylinder.3` and so on
    /// that no other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The number of rectangles around the axis. At least 3. Defaults to 32.
    #[serde(default = "crate::thirty_two")]
    pub around: Count<3>,
    /// The distance from the axis to the vertices, in scene units. More than 0.
    #[serde(default = "crate::one")]
    pub radius: PositiveLength,
    /// The height along z, in scene units. More than 0.
    #[serde(default = "crate::two")]
    pub height: PositiveLength,
    /// Whether each end is closed by a face.
    #[serde(default = "crate::yes")]
    pub caps: bool,
    /// The center of the cylinder, in scene units.
    #[serde(default)]
    pub center: Vector,
}

impl Cylinder {
    fn source(&self) -> Source<'_> {
        let n = u64::from(self.around.get());
        let (caps, degrees) = if self.caps {
            (2, Range::exactly(4).or(Range::exactly(n)))
        } else {
            (0, Range::exactly(4))
        };
        let counts = MeshPlan::counted(2 * n, 3 * n, n + caps, degrees);
        let (radius, height) = (self.radius.get(), self.height.get());
        Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "radius, height",
            [radius, radius, height / 2.0],
            self.center,
        )
    }
}

impl Operation for Cylinder {
    const NAME: &'static str = "Cylinder";
    const SUMMARY: &'static str = "Create a cylinder";
    const EXAMPLE: &'static str =
        r#"Cylinder(name: "new", around: 6, radius: 1, height: 2, caps: true)"#;
    const WORDS: &'static [&'static str] = &["tube", "prism"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source()
            .insert(scene, cx, || shapes::cylinder(self.around.get(), self.caps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::Mesh;

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Cylinder>(text).unwrap())
    }

    #[test]
    fn a_cylinder_of_four_sides_is_a_box() {
        let mesh = made(r#"(name: "a", around: 4, radius: 3, height: 5, center: (0, 0, 1))"#);
        // The base is a square with diagonals of 6.
        assert!((geometry::volume(&mesh) - 18.0 * 5.0).abs() < 1e-12);
        let [min, max] = geometry::bounds(&mesh).unwrap();
        assert_eq!((min.z, max.z), (-1.5, 3.5));
    }

    #[test]
    fn caps_close_the_cylinder() {
        for around in [3, 4, 7] {
            assert!(made(&format!(r#"(name: "a", around: {around})"#)).is_closed());
            let open = made(&format!(r#"(name: "a", around: {around}, caps: false)"#));
            assert_eq!(open.n_boundary_loops(), 2);
        }
    }

    #[test]
    fn too_many_sides_are_refused() {
        let step: Cylinder = op::test::read(r#"(name: "a", around: 4294967295)"#).unwrap();
        let made = op::test::run(&step, &mut Scene::new());
        assert!(matches!(made, Err(OpError::Budget(_))));
    }
}
