//! Poke faces: inserts a vertex at the center of each face and connects it to the corners of the face.
//!
//! ```text
//!    d ------- c          d ------- c
//!    |         |          | \     / |
//!    |    f    |   -->    |    m    |        m = (a + b + c + d) / 4 + distance n
//!    |         |          | /     \ |        n = unit normal of f
//!    a ------- b          a ------- b
//! ```

use op::prelude::*;

/// Inserts a vertex at the center of each face and connects it to the corners of the face.
///
/// A face with n corners becomes n triangles. Each poked face adds 1 vertex, n edges and n - 1 faces. The first
/// triangle keeps the id of the face. The other triangles and the new vertices and edges get the highest ids, in order
/// of the poked faces. The new vertex is at the mean of the positions of the corners, moved along the normal of the
/// face by `distance`. At the new vertex, interpolated attributes, such as UVs, get the mean of their values at the
/// corners of the face. The triangles have the values of their face, and the new edges have zero values (no crease, no
/// tags). If `distance` is not 0, normals are dropped.
///
/// A face cannot be poked if it contains a vertex twice, or if the position of the new vertex would not be finite. No
/// face can be poked if the mesh already has the largest supported number of elements.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PokeFaces {
    /// The faces to poke.
    #[serde(default)]
    pub faces: FaceSelection,
    /// The distance of the new vertex from the center of the face, along the normal of the face, in scene units. A
    /// negative distance moves the vertex inwards.
    ///
    /// A zero-area face has no normal, so its new vertex is at the center.
    #[serde(default, alias = "offset")]
    #[schemars(extend("aliases" = ["offset"]))]
    pub distance: Distance,
    /// What to do when a face cannot be poked.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for PokeFaces {
    const NAME: &'static str = "PokeFaces";
    const SUMMARY: &'static str =
        "Insert a vertex at the center of each face and connect it to the corners";
    const EXAMPLE: &'static str = "PokeFaces()";
    const WORDS: &'static [&'static str] = &["fan", "center"];
    const DONE: &'static str = "poked";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let n = self.on_refusal.done(self.faces.count(plan));
        let corners = plan.corners_of(n);
        let cuts = n.times(plan.degrees.less(1)).capped(corners.max);
        if n.max > 0 {
            plan.degrees.min = 3;
        }
        if n.min >= plan.faces.max {
            plan.degrees.max = 3;
        }
        plan.grow(n, corners, cuts);
        if self.distance != Distance::default() {
            plan.drop_normals();
        }
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let faces = self.faces.resolve(mesh, cx)?;
        let report = edit_each(mesh, &faces, self.on_refusal, "poke", cx, |mesh, f| {
            let position = mesh.face_center(f) + self.distance.get() * mesh.face_normal(f);
            mesh.poke_face_at(f, position).map(drop)
        })?;
        if self.distance != Distance::default() {
            mesh.remove_normals();
        }
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, VERTEX_NORMAL, VertexId};

    use op::test::{applied, is_as_planned, planned, try_applied};
    use proptest::prelude::*;

    fn parse(text: &str) -> PokeFaces {
        op::test::read(text).unwrap()
    }

    #[test]
    fn a_square_becomes_four_triangles() {
        let mesh = applied(&PokeFaces::default(), shapes::square());
        assert_eq!(mesh.n_faces(), 4);
        assert!(mesh.faces().all(|f| mesh.is_triangle(f)));
    }

    #[test]
    fn the_distance_follows_the_normal() {
        let mesh = applied(&parse("(distance: 2)"), shapes::square());
        assert_eq!(mesh.position(VertexId::new(4)), DVec3::new(0.5, 0.5, 2.0));
        // The result is a cube with a pyramid of height 1 on each side. The sides of the cube are squares with the side
        // length 2.
        let mesh = applied(&parse("(distance: 1)"), shapes::cube());
        assert!((geometry::volume(&mesh) - (8.0 + 6.0 * 4.0 / 3.0)).abs() < 1e-12);
    }

    #[test]
    fn new_vertices_are_in_order_of_the_faces() {
        let cube = shapes::cube();
        let mesh = applied(&parse("(faces: Faces([5, 2]))"), cube.clone());
        for (m, f) in [(8, 2), (9, 5)] {
            let center = cube.face_center(mesh::FaceId::new(f));
            assert_eq!(mesh.position(VertexId::new(m)), center);
        }
        assert_eq!((mesh.n_vertices(), mesh.n_faces()), (10, 12));
    }

    #[test]
    fn normals_are_dropped_only_if_the_distance_is_not_zero() {
        let mut mesh = shapes::grid(2, 1);
        mesh.set(VERTEX_NORMAL, vec![DVec3::Z; 6]);
        let flat = applied(&parse("()"), mesh.clone());
        assert_eq!(flat.get(VERTEX_NORMAL).unwrap(), [DVec3::Z; 8]);
        let raised = applied(&parse("(distance: 0.5)"), mesh);
        assert!(raised.get(VERTEX_NORMAL).is_none());
    }

    #[test]
    fn a_vertex_whose_coordinates_overflow_is_refused_or_skipped() {
        let far = parse("(distance: 1e308)");
        let mut mesh = shapes::square();
        for p in mesh.positions_mut() {
            p.z = 1e308;
        }
        let refused = try_applied(&far, mesh.clone());
        assert!(
            matches!(refused, Err(OpError::Refused { .. })),
            "{refused:?}"
        );
        let skip = PokeFaces {
            on_refusal: OnRefusal::Skip,
            ..far
        };
        let (after, report) = try_applied(&skip, mesh.clone()).unwrap();
        assert_eq!(
            (&after, report.changed, report.refused[0].count),
            (&mesh, 0, 1)
        );
        assert!(is_as_planned(&skip, &mesh, &after));
    }

    #[test]
    fn the_plan_of_all_squares_is_exact() {
        let (plan, problems) = planned(&parse("()"), &shapes::cube());
        assert_eq!(problems, []);
        assert_eq!(plan.vertices, Range::exactly(14));
        assert_eq!(plan.edges, Range::exactly(36));
        assert_eq!(plan.faces, Range::exactly(24));
        assert!(plan.is_triangles());
    }

    proptest! {
        #[test]
        fn topology_and_plan_hold_for_any_selection(
            count in 0..12_u32, seed in 0..1000_u64, which in 0..5_usize,
        ) {
            let before = [
                Mesh::default(),
                shapes::grid(3, 2),
                shapes::cube(),
                shapes::tetrahedron(),
                shapes::cylinder(5, true),
            ][which].clone();
            let faces = FaceSelection::Random { count, of: Box::default(), seed };
            let poke = PokeFaces { faces, ..PokeFaces::default() };
            let after = applied(&poke, before.clone());
            prop_assert!(is_as_planned(&poke, &before, &after));
            prop_assert_eq!(after.euler_characteristic(), before.euler_characteristic());
            prop_assert!((geometry::area(&after) - geometry::area(&before)).abs() < 1e-12 * geometry::area(&before).max(1.0));
        }
    }
}
