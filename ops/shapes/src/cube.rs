//! A cube of 6 squares, or of 12 triangles.
//!
//! ```text
//!      6 ------ 7        z            d ------ c
//!     /|       /|        |  y         |  2nd / |
//!    4 ------ 5 |        | /          |    /   |     with `triangles: true` each square
//!    | 2 -----| 3        |/           |  / 1st |     (a, b, c, d) is cut from a to c
//!    |/       |/         +---- x      |/       |
//!    0 ------ 1                       a ------ b
//! ```
//!
//! The id of a vertex is (x > center) + 2 (y > center) + 4 (z > center), where a true comparison counts as 1. The
//! following list gives the vertices of each square, counter-clockwise seen from outside: -z (0, 2, 3, 1), +z (4, 5, 7,
//! 6), -y (0, 1, 5, 4), +x (1, 3, 7, 5), +y (3, 2, 6, 7) and -x (2, 0, 4, 6). With `triangles: true`, the diagonals of
//! the squares are therefore 0-3, 4-7, 0-5, 1-7, 3-6 and 2-4.

use geometry::shapes;
use op::Operation;
use op::prelude::*;

/// Creates a cube.
///
/// The cube has 8 vertices and 6 squares. In the order of their ids, the squares are on the sides -z, +z, -y, +x, +y
/// and -x. In the same order, the vertex ids of the squares are (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5),
/// (3, 2, 6, 7) and (2, 0, 4, 6). The id of a vertex is a sum: 1 if the vertex is on the side +x, plus 2 if it is on
/// the side +y, plus 4 if it is on the side +z.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Cube {
    /// The name of the new object. Defaults to the first of the names `cube`, `cube.2`, `cube.3` and so on that no
    /// other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The length of the edges, in scene units. More than 0.
    #[serde(default = "crate::two")]
    pub size: PositiveLength,
    /// The center of the cube, in scene units.
    #[serde(default)]
    pub center: Vector,
    /// Whether to cut each square (a, b, c, d) along its diagonal from a to c into the triangles (a, b, c) and (a, c,
    /// d). The square with the id f becomes the faces with the ids 2 f and 2 f + 1. The diagonals of the squares join
    /// the vertices 0-3, 4-7, 0-5, 1-7, 3-6 and 2-4.
    #[serde(default)]
    pub triangles: bool,
}

impl Cube {
    fn source(&self) -> Source<'_> {
        let counts = if self.triangles {
            MeshPlan::counted(8, 18, 12, Range::exactly(3))
        } else {
            MeshPlan::counted(8, 12, 6, Range::exactly(4))
        };
        Source::new(Self::NAME, self.name.as_deref(), counts).placed(
            "size",
            [self.size.get() / 2.0; 3],
            self.center,
        )
    }
}

impl Operation for Cube {
    const NAME: &'static str = "Cube";
    const SUMMARY: &'static str = "Create a cube";
    const EXAMPLE: &'static str = r#"Cube(name: "new", size: 3, center: (1, 2, 3))"#;
    const WORDS: &'static [&'static str] = &["box", "cuboid"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source().insert(scene, cx, || {
            if self.triangles {
                cut(&shapes::cube())
            } else {
                shapes::cube()
            }
        })
    }
}

/// Cuts each square of the cube along the diagonal from its first to its third corner.
fn cut(cube: &Mesh) -> Mesh {
    let mut triangles = Vec::with_capacity(12);
    for f in cube.faces() {
        let corners: Vec<u32> = cube
            .face_vertices(f)
            .map(|v| u32::try_from(v.index()).expect("one of 8"))
            .collect();
        let [a, b, c, d] = corners[..] else {
            unreachable!("the faces of a cube are squares")
        };
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let (mesh, _) = Mesh::from_polygons(cube.positions().to_vec(), &triangles)
        .expect("the corners are those of the cube");
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, FaceId, VertexId};

    /// Returns the mesh that the step creates.
    fn made(text: &str) -> Mesh {
        op::test::made(&op::test::read::<Cube>(text).unwrap())
    }

    #[test]
    fn a_cube_of_size_2_has_its_corners_at_1() {
        let mesh = made(r#"(name: "a")"#);
        assert_eq!(mesh, shapes::cube());
        assert!((geometry::volume(&mesh) - 8.0).abs() < 1e-14);
    }

    #[test]
    fn size_and_center_give_the_bounds() {
        let mesh = made(r#"(name: "a", size: 3, center: (1, 2, 3))"#);
        let [min, max] = geometry::bounds(&mesh).unwrap();
        assert_eq!(min, DVec3::new(-0.5, 0.5, 1.5));
        assert_eq!(max, DVec3::new(2.5, 3.5, 4.5));
    }

    #[test]
    fn the_diagonals_are_as_documented() {
        let mesh = made(r#"(name: "a", triangles: true)"#);
        assert!(mesh.is_closed());
        assert!((geometry::volume(&mesh) - 8.0).abs() < 1e-14);
        let square = shapes::cube();
        let vertex = VertexId::new;
        for (v, w) in [(0, 3), (4, 7), (0, 5), (1, 7), (3, 6), (2, 4)] {
            assert!(
                mesh.find_half_edge(vertex(v), vertex(w)).is_some(),
                "{v}-{w}"
            );
            assert!(
                square.find_half_edge(vertex(v), vertex(w)).is_none(),
                "{v}-{w}"
            );
        }
        for f in mesh.faces() {
            let side = FaceId::new(f.index() / 2);
            assert_eq!(mesh.face_normal(f), square.face_normal(side));
        }
    }
}
