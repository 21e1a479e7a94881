//! `TagFaces`: marks faces with a tag.

use mesh::Domain;
use op::prelude::*;

/// Marks the selected faces, and no others, with a tag: `Tagged("rim")` selects them in later steps.
///
/// The parts of a marked face are marked too, in splits and in subdivision. A tag of the same name is replaced; an attribute of the same name that is no tag is refused. The shape
/// does not change. What is counted are the faces that are marked now and were not, or the other way round.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TagFaces {
    /// The name of the tag, without blanks around it.
    pub name: TagName,
    /// Which faces; none are an empty tag.
    pub faces: FaceSelection,
}

impl MeshOperation for TagFaces {
    const NAME: &'static str = "TagFaces";
    const SUMMARY: &'static str = "Mark faces with a tag";
    const EXAMPLE: &'static str =
        r#"TagFaces(name: "some", faces: Facing(direction: (0, 0, 1), within: 45))"#;

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
    fn the_selected_are_marked_and_nothing_else_changes() {
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
    fn a_second_tag_of_the_name_replaces_the_first() {
        let first = applied(&step("(name: \"some\", faces: Faces([3]))"), shapes::cube());
        let all = step("(name: \"some\", faces: Not(Tagged(\"some\")))");
        let (mesh, report) = try_applied(&all, first).unwrap();
        assert_eq!(report, Report::changed(6));
        let marks = mesh.tag(Domain::Face, "some").unwrap();
        assert_eq!(marks.iter().filter(|&&mark| mark).count(), 6 - 1);
    }
}
