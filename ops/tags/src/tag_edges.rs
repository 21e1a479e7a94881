//! `TagEdges`: tags edges.

use mesh::Domain;
use op::prelude::*;

/// Tags the selected edges and removes the tag from all other edges. In later steps, `Tagged("rim")` selects the edges
/// with the tag `rim`.
///
/// When a tagged edge is split or subdivided, its parts are also tagged. An existing tag of the same name is
/// replaced. If an attribute of another type has this name, the step fails. The geometry does not change. The report
/// counts the edges that gained or lost the tag.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TagEdges {
    /// The name of the tag. The name must not be empty and must not start or end with whitespace.
    pub name: TagName,
    /// The edges to tag. An empty selection gives an empty tag.
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
