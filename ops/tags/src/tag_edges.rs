//! `TagEdges`: tags edges.

use mesh::Domain;
use op::prelude::*;

/// Gives a tag (a named mark) to the selected edges and removes this tag from all other edges. For example, if the name
/// of the tag is `rim`, `Tagged("rim")` selects the tagged edges in later steps.
///
/// When a later step splits or subdivides a tagged edge, the parts of this edge are also tagged. An existing edge tag
/// of the same name is replaced. The step fails if the mesh has an edge attribute of this name that is not a tag. The
/// geometry does not change. The report counts the edges that gained or lost the tag.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TagEdges {
    /// The name of the tag. The name must not be empty and must not start or end with whitespace.
    pub name: TagName,
    /// The edges to tag. If the selection is empty, the tag exists but no edge has it.
    pub edges: EdgeSelection,
}

impl MeshOperation for TagEdges {
    const NAME: &'static str = "TagEdges";
    const SUMMARY: &'static str = "Tag edges";
    const EXAMPLE: &'static str = r#"TagEdges(name: "marked", edges: EdgeLoop(Longest(count: 2)))"#;
    const WORDS: &'static [&'static str] = &["select", "group", "mark"];

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
    fn selected_edges_are_tagged_and_nothing_else_changes() {
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
    fn a_second_tag_of_the_same_name_replaces_the_first() {
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
