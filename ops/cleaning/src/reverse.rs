//! Reverse: turns faces over, so that their other side is the outside.
//!
//! ```text
//!       c                    c
//!     /   ^                ^   \
//!   /   f   \     --->   /   f   \       V, E and F stay, and so do all numbers
//!  v         \          /         v
//!  a ------> b          a <------ b
//! ```

use op::prelude::*;

/// Turns faces over, so that their other side is the outside.
///
/// The two faces at an edge run along it in opposite directions, so only whole components can be turned:
/// if a face that is not selected shares an edge with one that is, the step is refused. No vertex moves
/// and no number changes; the first corner of a face stays the first, the others follow in reverse.
/// Normals are turned over too. Other attributes stay with their elements, corner values with their
/// vertex and face.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Reverse {
    /// Which faces: whole components.
    #[serde(default)]
    pub faces: FaceSelection,
}

impl MeshOperation for Reverse {
    const NAME: &'static str = "Reverse";
    const SUMMARY: &'static str = "Turn faces over";
    const EXAMPLE: &'static str = "Reverse()";

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

    /// A cube and a tetrahedron beside it, whose faces are the last four.
    fn two() -> Mesh {
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
    fn a_reversed_mesh_is_inside_out_and_twice_reversed_as_before() {
        let mesh = two();
        let reversed = applied(&Reverse::default(), mesh.clone());
        assert_eq!(geometry::volume(&reversed), -geometry::volume(&mesh));
        assert_eq!(applied(&Reverse::default(), reversed), mesh);
    }

    #[test]
    fn one_component_may_be_chosen() {
        let mesh = two();
        let (turned, report) = try_applied(&faces(&[6, 7, 8, 9]), mesh.clone()).unwrap();
        let small = geometry::volume(&shapes::tetrahedron());
        assert!(
            (geometry::volume(&turned) - (geometry::volume(&mesh) - 2.0 * small)).abs() < 1e-12
        );
        assert_eq!(report.changed, 4);
        // One after the other is both at once.
        let both = applied(&faces(&[0, 1, 2, 3, 4, 5]), turned);
        assert_eq!(both, mesh.reversed());
    }

    #[test]
    fn a_part_of_a_component_is_refused() {
        let refused = try_applied(&faces(&[0]), two());
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
    fn nothing_selected_changes_nothing() {
        let (mesh, report) = try_applied(&faces(&[]), two()).unwrap();
        assert_eq!(mesh, two());
        assert_eq!(report.notes, ["nothing was selected"]);
    }

    #[test]
    fn a_recipe_may_choose_faces() {
        let parse = |text| op::test::read::<Reverse>(text);
        assert_eq!(parse("()").unwrap().faces, FaceSelection::All);
        let tagged = FaceSelection::Tagged("lid".into());
        assert_eq!(parse(r#"(faces: Tagged("lid"))"#).unwrap().faces, tagged);
        assert!(parse("(side: Back)").is_err());
    }
}
