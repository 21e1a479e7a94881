//! `TagEdges`: marks edges with a tag.

use mesh::Domain;
use op::prelude::*;

/// Marks the selected edges, and no others, with a tag: `Tagged("rim")` selects them in later steps.
///
/// The parts of a marked edge are marked too, in splits and in subdivision. A tag of the same name is replaced; an attribute of the same name that is no tag is refused. The shape
/// does not change. What is counted are the edges that are marked now and were not, or the other way round.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TagEdges {
    /// The name of the tag, without blanks around it.
    pub name: TagName,
    /// Which edges; none are an empty tag.
    pub edges: EdgeSelection,
}

impl MeshOperation for TagEdges {
    const NAME: &'static str = "TagEdges";
    const SUMMARY: &'static str = "Mark edges with a tag";
    const EXAMPLE: &'static str = r#"TagEdges(name: "marked", edges: EdgeLoop(Longest(count: 2)))"#;

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.provide(Domain::Edge, self.name.as_str());
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        op::tag(mesh, &self.name, &self.edges, cx).map(Report::changed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::test::{applied, planned, try_applied};

    fn step(text: &str) -> TagEdges {
        op::test::read(text).unwrap()
    }

    #[test]
    fn the_selected_are_marked_and_nothing_else_changes() {
        let cube = shapes::cube();
        let (mesh, report) = try_applied(
            &step("(name: \"some\", edges: Between(0, 1))"),
            cube.clone(),
        )
        .unwrap();
        let marks = mesh.tag(Domain::Edge, "some").unwrap();
        assert_eq!(marks.iter().filter(|&&mark| mark).count(), 1);
        assert_eq!(report, Report::changed(1));
        assert_eq!(mesh.positions(), cube.positions());
        let (plan, problems) = planned(&step("(name: \"some\", edges: Between(0, 1))"), &cube);
        assert_eq!((plan, problems), (MeshPlan::of(&mesh), vec![]));
    }

    #[test]
    fn a_second_tag_of_the_name_replaces_the_first() {
        let first = applied(
            &step("(name: \"some\", edges: Between(0, 1))"),
            shapes::cube(),
        );
        let all = step("(name: \"some\", edges: Not(Tagged(\"some\")))");
        let (mesh, report) = try_applied(&all, first).unwrap();
        assert_eq!(report, Report::changed(12));
        let marks = mesh.tag(Domain::Edge, "some").unwrap();
        assert_eq!(marks.iter().filter(|&&mark| mark).count(), 12 - 1);
    }
}
