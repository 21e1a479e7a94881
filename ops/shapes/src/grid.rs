//! A flat sheet of squares.
//!
//! ```text
//!    6 --- 7 --- 8       y
//!    |  2  |  3  |       |      columns: 2, rows: 2
//!    3 --- 4 --- 5       |
//!    |  0  |  1  |       +--- x
//!    0 --- 1 --- 2
//! ```

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a flat sheet of squares whose normals point to +z.
///
/// The ids of vertices and faces increase along each row from -x to +x, and from row to row towards +y.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// The name of the new object. Defaults to the first of the names `grid`, `grid.2`, `grid.3` and so on that no
    /// other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The number of squares along x. At least 1. Defaults to 10.
    #[serde(default = "crate::ten")]
    pub columns: Count<1>,
    /// The number of squares along y. At least 1. Defaults to 10.
    #[serde(default = "crate::ten")]
    pub rows: Count<1>,
    /// The side length of a square, in scene units. More than 0.
    #[serde(default = "crate::one")]
    pub size: PositiveLength,
    /// The center of the sheet, in scene units.
    #[serde(default)]
    pub center: Vector,
}

impl Grid {
    fn source(&self) -> Source<'_> {
        let (columns, rows) = (u64::from(self.columns.get()), u64::from(self.rows.get()));
        let vertices = (columns + 1).saturating_mul(rows + 1);
        let edges = columns
            .saturating_mul(rows + 1)
            .saturating_add((columns + 1).saturating_mul(rows));
        let faces = columns.saturating_mul(rows);
        let counts = MeshPlan::counted(vertices, edges, faces, Range::exactly(4));
        Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "size",
            [self.size.get(); 3],
            self.center,
        )
    }
}

impl Operation for Grid {
    const NAME: &'static str = "Grid";
    const SUMMARY: &'static str = "Create a flat sheet of squares";
    const EXAMPLE: &'static str = r#"Grid(name: "new", columns: 3, rows: 2)"#;
    const WORDS: &'static [&'static str] = &["plane", "quad", "sheet"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source().insert(scene, cx, || {
            shapes::grid(self.columns.get(), self.rows.get())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, Mesh};

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Grid>(text).unwrap())
    }

    #[test]
    fn a_grid_covers_its_area_and_faces_upwards() {
        let mesh = made(r#"(name: "a", columns: 3, rows: 2, size: 0.5)"#);
        assert_eq!(geometry::area(&mesh), 6.0 * 0.25);
        assert!(mesh.faces().all(|f| mesh.face_normal(f) == DVec3::Z));
        assert_eq!(mesh.n_boundary_loops(), 1);
    }

    #[test]
    fn vertices_are_numbered_in_rows() {
        let mesh = made(r#"(name: "a", columns: 2, rows: 2, center: (1, 1, 5))"#);
        assert_eq!(mesh.positions()[0], DVec3::new(0.0, 0.0, 5.0));
        assert_eq!(mesh.positions()[5], DVec3::new(2.0, 1.0, 5.0));
    }

    #[test]
    fn too_many_squares_are_refused() {
        for n in [u32::MAX, 1 << 16] {
            let text = format!(r#"(name: "a", columns: {n}, rows: {n})"#);
            let step: Grid = op::test::read(&text).unwrap();
            let made = op::test::run(&step, &mut Scene::new());
            assert!(matches!(made, Err(OpError::Budget(_))));
        }
    }
}
