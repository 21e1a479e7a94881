//! A torus around the z axis.
//!
//! ```text
//!                 z
//!    .---.        |        .---.
//!   /     \       |       /     \       major: from the z axis to the center of the tube
//!  |   +   |      |<---- + --->  |      minor: the radius of the tube
//!   \     /       | major  minor/
//!    '---'        |        '---'
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a torus of quadrilaterals around the z axis.
///
/// The vertices form rings, one for each cross section of the tube. The number of rings is `around`, and each ring has
/// `across` vertices. With i and j counted from 0, vertex j of ring i has the id `i * across + j`. Ring 0 is in the
/// direction +x from the center of the torus. Vertex 0 of each ring is the vertex farthest from the axis.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Torus {
    /// The name of the new object. Defaults to the first of the names `torus`, `torus.2`, `torus.3` and so on that no
    /// other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The number of faces around the z axis. At least 3. Defaults to 32.
    #[serde(default = "crate::thirty_two")]
    pub around: Count<3>,
    /// The number of faces around the tube. At least 3. Defaults to 16.
    #[serde(default = "sixteen")]
    pub across: Count<3>,
    /// The distance from the z axis to the center of the tube, in scene units. More than 0.
    #[serde(default = "crate::one")]
    pub major: PositiveLength,
    /// The radius of the tube, in scene units. More than 0. If `minor` is not less than `major`, the tube intersects
    /// itself.
    #[serde(default = "quarter")]
    pub minor: PositiveLength,
    /// The center of the torus, in scene units.
    #[serde(default)]
    pub center: Vector,
}

const fn quarter() -> PositiveLength {
    PositiveLength::literal(0.25)
}

const fn sixteen() -> Count<3> {
    Count::literal(16)
}

impl Torus {
    fn source(&self) -> Source<'_> {
        let faces = u64::from(self.around.get()).saturating_mul(u64::from(self.across.get()));
        let edges = faces.saturating_mul(2);
        let counts = MeshPlan::counted(faces, edges, faces, Range::exactly(4));
        let source = Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "major, minor",
            [1.0; 3],
            self.center,
        );
        let reach = self.major.get() + self.minor.get();
        if !reach.is_finite() {
            let message = "`major` + `minor` exceeds the largest number, 1.8e308";
            return source.with(Problem::error(message).at(["major"]));
        }
        if self.minor.get() < self.major.get() {
            return source;
        }
        let warning = Problem::warning("the tube intersects itself").at(["minor"]);
        source.with(warning.help("make `minor` less than `major`, so that the torus has a hole"))
    }
}

impl Operation for Torus {
    const NAME: &'static str = "Torus";
    const SUMMARY: &'static str = "Create a torus";
    const EXAMPLE: &'static str =
        r#"Torus(name: "new", around: 7, across: 5, major: 2, minor: 0.5)"#;
    const WORDS: &'static [&'static str] = &["donut", "ring"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source().insert(scene, cx, || {
            shapes::torus(
                self.around.get(),
                self.across.get(),
                self.major.get(),
                self.minor.get(),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, Mesh};

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Torus>(text).unwrap())
    }

    #[test]
    fn a_torus_has_one_handle() {
        let mesh = made(r#"(name: "a", around: 5, across: 4)"#);
        assert!(mesh.is_closed());
        assert_eq!(geometry::genus(&mesh), 1);
        assert!(geometry::volume(&mesh) > 0.0);
    }

    #[test]
    fn major_and_minor_give_the_bounds() {
        let mesh =
            made(r#"(name: "a", around: 4, across: 4, major: 3, minor: 1, center: (0, 0, 7))"#);
        let [min, max] = geometry::bounds(&mesh).unwrap();
        assert!(min.abs_diff_eq(DVec3::new(-4.0, -4.0, 6.0), 1e-14));
        assert!(max.abs_diff_eq(DVec3::new(4.0, 4.0, 8.0), 1e-14));
    }

    #[test]
    fn a_self_intersecting_torus_is_created_with_a_warning() {
        let step: Torus = op::test::read(r#"(name: "a", around: 5, across: 4, minor: 2)"#).unwrap();
        let problems = step.source().plan(&mut Plan::default());
        assert!(problems.len() == 1 && problems[0].is_warning);
        assert!(op::test::run(&step, &mut Scene::new()).is_ok());
    }

    #[test]
    fn a_torus_whose_coordinates_overflow_is_an_error() {
        let text = r#"(name: "a", around: 5, across: 4, major: 1e308, minor: 1e308)"#;
        let step: Torus = op::test::read(text).unwrap();
        let problems = step.source().plan(&mut Plan::default());
        assert_eq!(problems[0].path, ["major"]);
        let made = op::test::run(&step, &mut Scene::new());
        assert!(matches!(made, Err(OpError::Parameter(_))));
    }

    #[test]
    fn too_many_faces_are_refused() {
        let text = r#"(name: "a", around: 4294967295, across: 4294967295)"#;
        let step: Torus = op::test::read(text).unwrap();
        let made = op::test::run(&step, &mut Scene::new());
        assert!(matches!(made, Err(OpError::Budget(_))));
    }
}
