//! Inset faces: shrinks faces and surrounds each face with a ring of faces.
//!
//! ```text
//!    + ------------- +              + ------------- +
//!    |               |              | \           / |
//!    |               |              |   +------- +  |
//!    |       f       |     -->      |   |   f    |  |       new corners are at (1 - t) v + t c, where c
//!    |               |              |   +------- +  |       is the mean of the corners and t the fraction
//!    |               |              | /           \ |
//!    + ------------- +              + ------------- +
//! ```

use op::prelude::*;

/// Shrinks faces and surrounds each face with a ring of faces.
///
/// Each face is inset separately, even if selected faces share edges. The shrunk inner face keeps the id of the
/// selected face, and existing vertices do not move. For a face with n corners, the step adds n vertices, 2 n edges and
/// n faces with four corners. New vertices and faces get the highest ids. They are numbered in order of the selected
/// faces, and counter-clockwise around each face from its first corner.
///
/// Attribute values at a new corner or vertex are interpolated in the same way as its position, so textures do not move
/// on the surface. The interpolation is between the value at the outer corner and the mean of the values at all corners
/// of the face. The faces of the ring have the values of the old face (material, tags). The edges of the inner face
/// have the values of the old edges beside them. Normals are dropped.
///
/// A face cannot be inset if it is on both sides of one of its edges.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct InsetFaces {
    /// The faces to inset.
    pub faces: FaceSelection,
    /// The position of the new corners between the old corners (0) and the center of the face (1). Must be more than 0
    /// and less than 1.
    pub fraction: Fraction,
    /// What to do when a face cannot be inset.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for InsetFaces {
    const NAME: &'static str = "InsetFaces";
    const SUMMARY: &'static str = "Shrink faces and surround each face with a ring of faces";
    const EXAMPLE: &'static str = "InsetFaces(faces: All, fraction: 0.25)";
    const WORDS: &'static [&'static str] = &["shrink"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        crate::plan_rings(plan, self.on_refusal.done(self.faces.count(plan)));
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let faces = self.faces.resolve(mesh, cx)?;
        let report = edit_each(mesh, &faces, self.on_refusal, "inset", cx, |mesh, f| {
            mesh.inset_face(f, self.fraction.get()).map(drop)
        })?;
        mesh.remove_normals();
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{FaceId, VERTEX_NORMAL};

    use op::test::{applied, planned, try_applied};

    fn parse(text: &str) -> InsetFaces {
        op::test::read(text).unwrap()
    }

    #[test]
    fn every_face_of_a_cube_gets_a_ring() {
        let step = parse("(faces: All, fraction: 0.5)");
        let (plan, problems) = planned(&step, &shapes::cube());
        assert_eq!(problems, []);
        let (mesh, report) = try_applied(&step, shapes::cube()).unwrap();
        assert_eq!(report.changed, 6);
        let counts = [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()];
        assert_eq!(counts, [32, 60, 30]);
        let exactly = |n: usize| Range::exactly(n as u64);
        assert_eq!([plan.vertices, plan.edges, plan.faces], counts.map(exactly));
        assert_eq!(plan.degrees, Range::exactly(4));
        assert!((geometry::area(&mesh) - 24.0).abs() < 1e-13);
        for f in shapes::cube().faces() {
            assert!((mesh.face_area(f) - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn rings_are_numbered_in_order_of_the_faces() {
        let mesh = applied(
            &parse("(faces: Faces([4, 1]), fraction: 0.25)"),
            shapes::cube(),
        );
        for (ring, f) in [(6..10, 1), (10..14, 4)] {
            let normal = mesh.face_normal(FaceId::new(f));
            for side in ring {
                assert_eq!(mesh.face_normal(FaceId::new(side)), normal);
            }
        }
    }

    #[test]
    fn normals_are_dropped() {
        let mut mesh = shapes::square();
        mesh.set(VERTEX_NORMAL, vec![mesh::DVec3::Z; 4]);
        let step = parse("(faces: Degree(4), fraction: 0.5, on_refusal: Skip)");
        let (plan, _) = planned(&step, &mesh);
        assert_eq!(plan.attributes, []);
        let (mesh, report) = try_applied(&step, mesh).unwrap();
        assert_eq!(mesh.get(VERTEX_NORMAL), None);
        assert_eq!(report.losses.len(), 1);
    }
}
