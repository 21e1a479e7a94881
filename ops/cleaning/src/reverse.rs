//! Reverse: reverses the orientation of faces, so that inside and outside are exchanged.
//!
//! ```text
//!       c                    c
//!     /   ^                ^   \
//!   /   f   \     --->   /   f   \       all counts and ids stay the same
//!  v         \          /         v
//!  a ------> b          a <------ b
//! ```

use op::prelude::*;

/// Reverses the orientation of faces, so that their inside and outside are exchanged.
///
/// Adjacent faces must have the same orientation, so only whole connected components can be reversed. If a selected
/// face shares an edge with a face that is not selected, the step fails. No vertex moves, and all elements keep their
/// ids. The first corner of a face stays first, and the other corners follow in reverse order. Normals are negated.
/// Attributes that do not survive changes of the connectivity (edit rule `Drop`), such as tangents of corners, are
/// removed. Vertices, edges and faces keep all other values. The values of a corner stay at the same vertex of the same
/// face.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Reverse {
    /// The faces to reverse. The faces must form whole connected components.
    #[serde(default)]
    pub faces: FaceSelection,
}

impl MeshOperation for Reverse {
    const NAME: &'static str = "Reverse";
    const SUMMARY: &'static str = "Reverse the orientation of faces";
    const EXAMPLE: &'static str = "Reverse()";
    const WORDS: &'static [&'static str] = &["invert", "orientation", "winding"];
    const DONE: &'static str = "reversed";

    fn plan(&self, _: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        Vec::new() // counts, degrees and attributes stay as they are
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let faces = self.faces.resolve(mesh, cx)?;
        cx.advance("reverse", 0, 1)?;
        if faces.is_empty() {
            return Ok(Report::default().note("nothing was selected"));
        }
        if faces.len() == mesh.n_faces() {
            mesh.reverse();
        } else {
            mesh.reverse_faces(&faces)?;
        }
        Ok(Report::changed(faces.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::Refusal;
    use op::test::{applied, try_applied};

    /// Returns a mesh of a cube and a tetrahedron. The last four faces belong to the tetrahedron.
    fn cube_and_tetrahedron() -> Mesh {
        let (cube, other) = (shapes::cube(), shapes::tetrahedron());
        let mut positions = cube.positions().to_vec();
        positions.extend(other.positions().iter().map(|&p| p + 5.0));
        let corners = |mesh: &Mesh, first: usize| -> Vec<Vec<u32>> {
            let number = |v: mesh::VertexId| u32::try_from(v.index() + first).unwrap();
            mesh.faces()
                .map(|f| mesh.face_vertices(f).map(number).collect())
                .collect()
        };
        let polygons = [corners(&cube, 0), corners(&other, 8)].concat();
        Mesh::from_polygons(positions, &polygons).unwrap().0
    }

    fn faces(numbers: &[u32]) -> Reverse {
        let faces = FaceSelection::Faces(numbers.to_vec());
        Reverse { faces }
    }

    #[test]
    fn reversing_negates_the_volume_and_reversing_twice_changes_nothing() {
        let mesh = cube_and_tetrahedron();
        let reversed = applied(&Reverse::default(), mesh.clone());
        assert_eq!(geometry::volume(&reversed), -geometry::volume(&mesh));
        assert_eq!(applied(&Reverse::default(), reversed), mesh);
    }

    #[test]
    fn a_single_component_can_be_reversed() {
        let mesh = cube_and_tetrahedron();
        let (reversed, report) = try_applied(&faces(&[6, 7, 8, 9]), mesh.clone()).unwrap();
        let small = geometry::volume(&shapes::tetrahedron());
        assert!(
            (geometry::volume(&reversed) - (geometry::volume(&mesh) - 2.0 * small)).abs() < 1e-12
        );
        assert_eq!(report.changed, 4);
        // Reversing the components one after the other has the same result as reversing the whole mesh.
        let both = applied(&faces(&[0, 1, 2, 3, 4, 5]), reversed);
        assert_eq!(both, mesh.reversed());
    }

    #[test]
    fn a_part_of_a_component_is_refused() {
        let refused = try_applied(&faces(&[0]), cube_and_tetrahedron());
        assert!(
            matches!(
                refused,
                Err(OpError::Refused {
                    reason: Refusal::PartOfComponent,
                    ..
                })
            ),
            "{refused:?}"
        );
    }

    #[test]
    fn an_empty_selection_changes_nothing() {
        let (mesh, report) = try_applied(&faces(&[]), cube_and_tetrahedron()).unwrap();
        assert_eq!(mesh, cube_and_tetrahedron());
        assert_eq!(report.notes, ["nothing was selected"]);
    }

    #[test]
    fn parameters_are_read() {
        let parse = |text| op::test::read::<Reverse>(text);
        assert_eq!(parse("()").unwrap().faces, FaceSelection::All);
        let tagged = FaceSelection::Tagged("lid".into());
        assert_eq!(parse(r#"(faces: Tagged("lid"))"#).unwrap().faces, tagged);
        assert!(parse("(side: Back)").is_err());
    }
}
