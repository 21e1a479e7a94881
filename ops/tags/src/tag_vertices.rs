//! `TagVertices`: marks vertices with a tag.

use mesh::Domain;
use op::prelude::*;

/// Marks the selected vertices, and no others, with a tag: `Tagged("rim")` selects them in later steps.
///
/// Vertices that edits make are not marked. A tag of the same name is replaced; an attribute of the same name that is no tag is refused. The shape
/// does not change. What is counted are the vertices that are marked now and were not, or the other way round.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TagVertices {
    /// The name of the tag, without blanks around it.
    pub name: TagName,
    /// Which vertices; none are an empty tag.
    pub vertices: VertexSelection,
}

impl MeshOperation for TagVertices {
    const NAME: &'static str = "TagVertices";
    const SUMMARY: &'static str = "Mark vertices with a tag";
    const EXAMPLE: &'static str = r#"TagVertices(name: "some", vertices: Boundary)"#;

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.provide(Domain::Vertex, self.name.as_str());
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        op::tag(mesh, &self.name, &self.vertices, cx).map(Report::changed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::test::{applied, planned, try_applied};

    fn step(text: &str) -> TagVertices {
        op::test::read(text).unwrap()
    }

    #[test]
    fn the_selected_are_marked_and_nothing_else_changes() {
        let cube = shapes::cube();
        let (mesh, report) = try_applied(
            &step("(name: \"some\", vertices: Vertices([1, 2]))"),
            cube.clone(),
        )
        .unwrap();
        let marks = mesh.tag(Domain::Vertex, "some").unwrap();
        assert_eq!(marks.iter().filter(|&&mark| mark).count(), 2);
        assert_eq!(report, Report::changed(2));
        assert_eq!(mesh.positions(), cube.positions());
        let (plan, problems) =
            planned(&step("(name: \"some\", vertices: Vertices([1, 2]))"), &cube);
        assert_eq!((plan, problems), (MeshPlan::of(&mesh), vec![]));
    }

    #[test]
    fn a_second_tag_of_the_name_replaces_the_first() {
        let first = applied(
            &step("(name: \"some\", vertices: Vertices([1, 2]))"),
            shapes::cube(),
        );
        let all = step("(name: \"some\", vertices: Not(Tagged(\"some\")))");
        let (mesh, report) = try_applied(&all, first).unwrap();
        assert_eq!(report, Report::changed(8));
        let marks = mesh.tag(Domain::Vertex, "some").unwrap();
        assert_eq!(marks.iter().filter(|&&mark| mark).count(), 8 - 2);
    }

    #[test]
    fn an_attribute_of_another_type_is_refused() {
        let numbers =
            mesh::Attribute::<mesh::VertexId, f64>::new("weight", mesh::Rule::Interpolate);
        let mut mesh = shapes::cube();
        mesh.set(numbers, vec![0.0; 8]);
        let error = try_applied(&step("(name: \"weight\", vertices: All)"), mesh).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the vertex attribute \"weight\" is not a tag: its type is number"
        );
    }
}
