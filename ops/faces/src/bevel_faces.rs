//! Bevel faces: shrinks and raises faces, and surrounds each face with a ring of faces.
//!
//! ```text
//!                                    +------+
//!                                  /    f    \            f is shrunk by the fraction
//!    + ------ f ------ +    -->   + ---------- +           and raised by the distance
//! ```

use op::prelude::*;

/// Shrinks and raises faces, and surrounds each face with a ring of faces.
///
/// The step works like `InsetFaces`, and also moves the inner face along its normal. Each face is beveled separately,
/// even if selected faces share edges. The shrunk inner face keeps the id of the selected face, and existing vertices
/// do not move. For a face with n corners, the step adds n vertices, 2 n edges and n faces with four corners. New
/// vertices and faces get the highest ids. They are numbered in order of the selected faces, and counter-clockwise
/// around each face from its first corner. A zero-area face has no normal, so its inner face is not raised.
///
/// Attribute values at a new corner or vertex are interpolated by `fraction`. Here, 0 stands for the value at the outer
/// corner, and 1 stands for the mean of the values at all corners of the face. The faces of the ring have the values of
/// the old face (material, tags). The edges of the inner face have the values of the old edges beside them. Normals are
/// dropped.
///
/// A face cannot be beveled if it is on both sides of one of its edges.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BevelFaces {
    /// The faces to bevel.
    pub faces: FaceSelection,
    /// The position of the new corners between the old corners (0) and the center of the face (1), before the inner
    /// face is raised. Must be more than 0 and less than 1.
    #[serde(alias = "inset")]
    #[schemars(extend("aliases" = ["inset"]))]
    pub fraction: Fraction,
    /// The distance by which the inner face moves along its normal, in scene units. A negative distance moves the inner
    /// face in the direction opposite to its normal.
    #[serde(alias = "height")]
    #[schemars(extend("aliases" = ["height"]))]
    pub distance: Distance,
    /// What to do when a face cannot be beveled.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for BevelFaces {
    const NAME: &'static str = "BevelFaces";
    const SUMMARY: &'static str =
        "Shrink and raise faces, and surround each face with a ring of faces";
    const EXAMPLE: &'static str = "BevelFaces(faces: All, fraction: 0.25, distance: 0.5)";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        crate::plan_rings(plan, self.on_refusal.done(self.faces.count(plan)));
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let faces = self.faces.resolve(mesh, cx)?;
        let report = edit_each(mesh, &faces, self.on_refusal, "bevel", cx, |mesh, f| {
            mesh.bevel_face(f, self.fraction.get(), self.distance.get())
                .map(drop)
        })?;
        mesh.remove_normals();
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::FaceId;

    use op::test::{applied, planned, try_applied};

    fn parse(text: &str) -> BevelFaces {
        op::test::read(text).unwrap()
    }

    #[test]
    fn a_bevel_adds_a_frustum_to_each_face() {
        let step = parse("(faces: All, fraction: 0.5, distance: 1)");
        let (plan, _) = planned(&step, &shapes::cube());
        assert_eq!(plan.faces, Range::exactly(30));
        let mesh = applied(&step, shapes::cube());
        assert_eq!(mesh.n_faces(), 30);
        // A frustum of height 1 with a base of area 4 and a top of area 1 has the volume (4 + 2 + 1) / 3.
        assert!((geometry::volume(&mesh) - 8.0 - 6.0 * 7.0 / 3.0).abs() < 1e-12);
        let top = mesh.face_center(FaceId::new(1));
        assert!((top - mesh::DVec3::new(0.0, 0.0, 2.0)).length() < 1e-15);
    }

    #[test]
    fn a_negative_distance_goes_inwards() {
        let step = parse("(faces: Faces([1]), fraction: 0.25, distance: -0.5, on_refusal: Skip)");
        let mesh = applied(&step, shapes::cube());
        assert!(geometry::volume(&mesh) < 8.0);
        assert_eq!(mesh.face_center(FaceId::new(1)).z, 0.5);
    }

    #[test]
    fn a_face_whose_coordinates_overflow_is_refused() {
        let mut high = shapes::cube();
        high.positions_mut().iter_mut().for_each(|p| p.z += 1e308);
        let step = parse("(faces: All, fraction: 0.5, distance: 1e308)");
        let refused = try_applied(&step, high);
        assert!(
            matches!(refused, Err(OpError::Refused { .. })),
            "{refused:?}"
        );
    }
}
