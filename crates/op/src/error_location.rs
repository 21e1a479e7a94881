//! The locations in a scene to which the error of an operation refers.

pub use scene::ErrorLocation;

#[cfg(test)]
mod tests {
    use geometry::shapes;
    use mesh::{EdgeId, EditError, Element, Mesh, VertexId};
    use scene::{Object, Scene};
    use schemars::JsonSchema;
    use serde::{Deserialize, Serialize};

    use super::*;
    use crate::{
        Context, Files, MeshOperation, MeshPlan, NoProgress, OnRefusal, OpError, Operation,
        PlanContext, Problem, Report, edit_each,
    };

    /// An operation that splits edge 0, and then flips the edges with the ids in `edges`.
    #[derive(Debug, Deserialize, JsonSchema, Serialize)]
    struct SplitAndFlip {
        edges: Vec<usize>,
    }

    impl MeshOperation for SplitAndFlip {
        const NAME: &'static str = "SplitAndFlip";
        const SUMMARY: &'static str = "Split and flip";
        const EXAMPLE: &'static str = "SplitAndFlip(edges: [0])";

        fn plan(&self, _: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
            Vec::new()
        }

        fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
            mesh.split_edge(EdgeId::new(0), 0.25)?;
            let edges: Vec<EdgeId> = self.edges.iter().map(|&e| EdgeId::new(e)).collect();
            let flip = |mesh: &mut Mesh, e| mesh.flip_edge(e).map(drop);
            edit_each(mesh, &edges, OnRefusal::Error, "flip", cx, flip)
        }
    }

    /// Applies `SplitAndFlip` to a tetrahedron. Returns the error of the operation and the locations in the error.
    fn refused(edges: &[usize]) -> (OpError, Vec<ErrorLocation>) {
        let mut scene = Scene::new();
        let mesh = shapes::tetrahedron();
        scene.insert(Object::mesh("mesh", mesh)).unwrap();
        let before = scene.clone();
        let files = Files::default();
        let mut cx = Context::new(&NoProgress, &files);
        let operation = SplitAndFlip {
            edges: edges.to_vec(),
        };
        let error = Operation::apply(&operation, &mut scene, &mut cx).unwrap_err();
        assert_eq!(scene, before);
        let places = error.places().to_vec();
        (error, places)
    }

    #[test]
    fn locations_of_a_refusal_are_those_at_the_time_of_the_refusal() {
        let mut mesh = shapes::tetrahedron();
        mesh.split_edge(EdgeId::new(0), 0.25).unwrap();
        let refused_edge = mesh
            .edges()
            .find(|&e| matches!(mesh.clone().flip_edge(e), Err(EditError::DuplicateEdge(..))))
            .expect("opposite vertices of a tetrahedron are joined");

        let (error, places) = refused(&[refused_edge.index()]);

        // The error has three locations: the two vertices that are already joined, and the edge whose flip is refused.
        let Some(EditError::DuplicateEdge(v, w)) = mesh.clone().flip_edge(refused_edge).err()
        else {
            panic!("{error}");
        };
        let expected = [v.into(), w.into(), Element::Edge(refused_edge)];
        assert_eq!(error.elements(), expected);
        let expected = expected.map(|e| ErrorLocation::of("mesh", &mesh, e).unwrap());
        assert_eq!(places, expected);
        let [v, w] = mesh.edge_vertices(refused_edge).map(VertexId::index);
        let message = error.to_string();
        assert!(
            message.ends_with(&format!("; at Between({v}, {w})")),
            "{message}"
        );
    }

    #[test]
    fn an_element_that_does_not_exist_has_no_location() {
        let (error, places) = refused(&[999]);

        assert_eq!(error.elements(), [EdgeId::new(999).into()]);
        assert!(places.is_empty());
    }
}
