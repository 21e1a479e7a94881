//! `TagFaces`: tags faces.

use mesh::Domain;
use op::prelude::*;

/// Gives a tag (a named mark) to the selected faces and removes this tag from all other faces. For example, if the name
/// of the tag is `rim`, `Tagged("rim")` selects the tagged faces in later steps.
///
/// When a later step splits or subdivides a tagged face, the parts of this face are also tagged. An existing face tag
/// of the same name is replaced. The step fails if the mesh has a face attribute of this name that is not a tag. The
/// geometry does not change. The report counts the faces that gained or lost the tag.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TagFaces {
    /// The name of the tag. The name must not be empty and must not start or end with whitespace.
    pub name: TagName,
    /// The faces to tag. If the selection is empty, the tag exists but no face has it.
    pub faces: FaceSelection,
}

impl MeshOperation for TagFaces {
    const NAME: &'static str = "TagFaces";
    const SUMMARY: &'static str = "Tag faces";
    const EXAMPLE: &'static str =
        r#"TagFaces(name: "some", faces: Facing(direction: (0, 0, 1), within: 45))"#;
    const WORDS: &'static [&'static str] = &["select", "group", "mark"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.provide(Domain::Face, self.name.as_str());
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        op::tag(mesh, &self.name, &self.faces, cx).map(Report::changed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::test::{applied, planned, try_applied};

    fn step(text: &str) -> TagFaces {
        op::test::read(text).unwrap()
    }

    #[test]
    fn selected_faces_are_tagged_and_nothing_else_changes() {
        let cube = shapes::cube();
        let (mesh, report) =
            try_applied(&step("(name: \"some\", faces: Faces([3]))"), cube.clone()).unwrap();
        let marks = mesh.tag(Domain::Face, "some").unwrap();
        assert_eq!(marks.iter().filter(|&&mark| mark).count(), 1);
        assert_eq!(report, Report::changed(1));
        assert_eq!(mesh.positions(), cube.positions());
        let (plan, problems) = planned(&step("(name: \"some\", faces: Faces([3]))"), &cube);
        assert_eq!((plan, problems), (MeshPlan::of(&mesh), vec![]));
    }

    #[test]
    fn a_second_tag_of_the_same_name_replaces_the_first() {
        let first = applied(&step("(name: \"some\", faces: Faces([3]))"), shapes::cube());
        let all = step("(name: \"some\", faces: Not(Tagged(\"some\")))");
        let (mesh, report) = try_applied(&all, first).unwrap();
        assert_eq!(report, Report::changed(6));
        let marks = mesh.tag(Domain::Face, "some").unwrap();
        assert_eq!(marks.iter().filter(|&&mark| mark).count(), 6 - 1);
    }
}
