//! `TagVertices`: tags vertices.

use mesh::Domain;
use op::prelude::*;

/// Gives a tag (a named mark) to the selected vertices and removes this tag from all other vertices. For example, if
/// the name of the tag is `rim`, `Tagged("rim")` selects the tagged vertices in later steps.
///
/// If a later step copies a tagged vertex, as `ExtrudeFaces` does, the copy is also tagged. If a later step adds a
/// vertex on an edge, as `SplitEdges` does, the new vertex is not tagged. An existing vertex tag of the same name is
/// replaced. The step fails if the mesh has a vertex attribute of this name that is not a tag. The geometry does not
/// change. The report counts the vertices that gained or lost the tag.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TagVertices {
    /// The name of the tag. The name must not be empty and must not start or end with whitespace.
    pub name: TagName,
    /// The vertices to tag. If the selection is empty, the tag exists but no vertex has it.
    pub vertices: VertexSelection,
}

impl MeshOperation for TagVertices {
    const NAME: &'static str = "TagVertices";
    const SUMMARY: &'static str = "Tag vertices";
    const EXAMPLE: &'static str = r#"TagVertices(name: "some", vertices: Boundary)"#;
    const WORDS: &'static [&'static str] = &["select", "group", "mark"];

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
    fn selected_vertices_are_tagged_and_nothing_else_changes() {
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
    fn a_second_tag_of_the_same_name_replaces_the_first() {
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
    fn an_attribute_of_another_type_is_an_error() {
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
