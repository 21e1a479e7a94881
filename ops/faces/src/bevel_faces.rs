//! Bevel faces: raises a smaller copy of faces, with a ring of faces around it.
//!
//! ```text
//!                                    +------+
//!                                  /    f    \            f is smaller by the fraction
//!    + ------ f ------ +    -->   + ---------- +           and higher by the distance
//! ```

use op::prelude::*;

/// Raises a smaller copy of faces, with a ring of faces around it.
///
/// As `InsetFaces`, with the inner face moved along its normal. Each face by itself, also where they
/// share edges. The inner face keeps the number, and all that was there stays where it was; a face with
/// n corners adds n vertices, 2 n edges and n faces of four corners. New vertices and faces are numbered
/// behind all others: the selected faces in order of their numbers, around each counter-clockwise from
/// its first corner. A face without area has no normal and stays flat.
///
/// Values at the new corners and vertices lie between those of the outer corner and the mean of the
/// face. The ring has the values of the face (material, tags), the inner edges have those of the outer
/// ones. Normals are dropped.
///
/// A face that lies on both sides of one of its edges is refused.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BevelFaces {
    /// Which faces.
    pub faces: FaceSelection,
    /// How far the corners move towards the middle of the face: strictly between 0 (not at all)
    /// and 1 (all the way).
    #[serde(alias = "inset")]
    #[schemars(extend("aliases" = ["inset"]))]
    pub fraction: Fraction,
    /// How far the inner face moves along its normal, in scene units; below 0 inwards.
    #[serde(alias = "height")]
    #[schemars(extend("aliases" = ["height"]))]
    pub distance: Distance,
    /// What to do when a face is refused.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for BevelFaces {
    const NAME: &'static str = "BevelFaces";
    const SUMMARY: &'static str = "Raise a smaller copy of faces, with a ring of faces around it";
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
        // A frustum from area 4 to area 1 and of height 1 has volume (4 + 2 + 1) / 3.
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
    fn a_face_beyond_all_numbers_is_refused() {
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
