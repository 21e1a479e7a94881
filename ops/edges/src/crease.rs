//! Crease: makes edges and vertices sharp for subdivision.
//!
//! ```text
//!    +-------+-------+            +-------+-------+
//!    |       |       |            |       ‖       |
//!    |       e       |    -->     |       ‖ 2.5   |       a number for each edge, `crease`,
//!    |       |       |            |       ‖       |       and for each vertex, `corner`
//!    +-------+-------+            +-------+-------+
//! ```
//!
//! The numbers are those of DeRose, Kass and Truong, "Subdivision Surfaces in Character Animation", 1998.

use mesh::{Attribute, CREASE, Domain, Id, VERTEX_SHARPNESS};
use op::prelude::*;

/// Makes edges and vertices sharp for subdivision.
///
/// Writes a number into the edge attribute `crease` of the selected edges and the vertex attribute
/// `corner` of the selected vertices; others keep theirs, or get 0 if the mesh had no such attribute. Loop
/// and Catmull-Clark subdivision keep an edge or a vertex sharp for so many levels, and smooth it from
/// then on: 2.5 is sharp for two levels and half sharp in the third, and 10 is sharp for ever. Edges of
/// the boundary are sharp anyway.
///
/// At least one of `edges` and `vertices` must be given. The shape does not change. What is counted are
/// the elements whose number was another one before.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Crease {
    /// Which edges; none if left out.
    #[serde(default)]
    pub edges: Option<EdgeSelection>,
    /// Which vertices; none if left out.
    #[serde(default)]
    pub vertices: Option<VertexSelection>,
    /// For how many levels they stay sharp: from 0, which takes a crease away, to 10, which is for ever.
    pub sharpness: Sharpness,
}

impl MeshOperation for Crease {
    const NAME: &'static str = "Crease";
    const SUMMARY: &'static str = "Make edges and vertices sharp for subdivision";
    const EXAMPLE: &'static str = "Crease(edges: Sharp(above: 40), sharpness: 2.5)";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if self.is_empty() {
            let help = "`edges: All` selects every edge, `vertices: All` every vertex";
            problems.push(Problem::error(NOTHING).help(help));
        }
        if self.edges.is_some() {
            plan.provide(Domain::Edge, CREASE.name);
        }
        if self.vertices.is_some() {
            plan.provide(Domain::Vertex, VERTEX_SHARPNESS.name);
        }
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        if self.is_empty() {
            return Err(OpError::Parameter(NOTHING.to_owned()));
        }
        cx.advance("crease", 0, 1)?;
        // Both are looked up first: an edge can be selected by its vertices.
        let edges = self.edges.as_ref();
        let edges = edges.map(|s| s.resolve(mesh, cx)).transpose()?;
        let vertices = self.vertices.as_ref();
        let vertices = vertices.map(|s| s.resolve(mesh, cx)).transpose()?;
        let mut changed = 0;
        if let Some(edges) = edges {
            changed += sharpen(mesh, CREASE, &edges, self.sharpness.get())?;
        }
        if let Some(vertices) = vertices {
            changed += sharpen(mesh, VERTEX_SHARPNESS, &vertices, self.sharpness.get())?;
        }
        cx.advance("crease", 1, 1)?;
        Ok(Report::changed(changed))
    }
}

const NOTHING: &str = "expected `edges` or `vertices` or both";

impl Crease {
    fn is_empty(&self) -> bool {
        self.edges.is_none() && self.vertices.is_none()
    }
}

/// Gives these elements the number. Returns how many had another one.
fn sharpen<I: Id>(
    mesh: &mut Mesh,
    attribute: Attribute<I, f64>,
    ids: &[I],
    sharpness: f64,
) -> Result<usize, OpError> {
    let name = attribute.name;
    let column = mesh.attributes().column(I::DOMAIN, name);
    let mut numbers = match (mesh.get(attribute), column) {
        (Some(numbers), _) => numbers.to_vec(),
        (None, None) => vec![0.0; mesh.domain_len(I::DOMAIN)],
        (None, Some(column)) => {
            let (domain, kind) = (I::DOMAIN, column.values.type_name());
            return Err(OpError::Parameter(format!(
                "the {domain} attribute \"{name}\" holds values of another type: {kind}"
            )));
        }
    };
    let mut changed = 0;
    for id in ids {
        let number = &mut numbers[id.index()];
        if *number != sharpness {
            changed += 1;
            // Adding 0 makes 0 of -0.
            *number = sharpness + 0.0;
        }
    }
    mesh.set(attribute, numbers);
    Ok(changed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{Column, DVec3, Rule, Values};
    use op::test::{applied, planned, try_applied};

    fn step(text: &str) -> Crease {
        op::test::read(text).unwrap()
    }

    #[test]
    fn the_edges_of_a_cube_become_sharp_and_nothing_else() {
        let cube = shapes::cube();
        let crease = step("(edges: Sharp(above: 40), sharpness: 2.5)");
        let (mesh, report) = try_applied(&crease, cube.clone()).unwrap();
        assert_eq!(mesh.get(CREASE).unwrap(), [2.5; 12]);
        assert_eq!(mesh.get(VERTEX_SHARPNESS), None);
        assert_eq!(report, Report::changed(12));
        assert_eq!(mesh.positions(), cube.positions());
    }

    #[test]
    fn other_edges_keep_their_numbers() {
        let first = step("(edges: Between(0, 1), sharpness: 10)");
        let second = step("(edges: Between(2, 1), sharpness: 0.5)");
        let mesh = applied(&second, applied(&first, shapes::fans(&shapes::square())));
        let number = |a: usize, b: usize| {
            let [a, b] = [a, b].map(mesh::VertexId::new);
            let h = mesh.find_half_edge(a, b).unwrap();
            mesh.get(CREASE).unwrap()[h.edge().index()]
        };
        assert_eq!((number(0, 1), number(1, 2)), (10.0, 0.5));
        let sum: f64 = mesh.get(CREASE).unwrap().iter().sum();
        assert_eq!(sum, 10.5);
    }

    #[test]
    fn vertices_and_edges_can_be_sharpened_together() {
        let crease = step("(edges: Boundary, vertices: Valence(2), sharpness: 3)");
        let (mesh, report) = try_applied(&crease, shapes::grid(2, 1)).unwrap();
        let sum = |numbers: &[f64]| numbers.iter().sum::<f64>();
        assert_eq!(sum(mesh.get(CREASE).unwrap()), 3.0 * 6.0);
        assert_eq!(sum(mesh.get(VERTEX_SHARPNESS).unwrap()), 3.0 * 4.0);
        assert_eq!(report.changed, 10);
    }

    #[test]
    fn zero_takes_a_crease_away_and_what_does_not_change_is_not_counted() {
        let sharp = applied(&step("(edges: All, sharpness: 1)"), shapes::cube());
        let again = try_applied(&step("(edges: All, sharpness: 1)"), sharp.clone()).unwrap();
        assert_eq!((again.0 == sharp, again.1.changed), (true, 0));
        let (smooth, report) = try_applied(&step("(edges: All, sharpness: -0.0)"), sharp).unwrap();
        assert_eq!(report.changed, 12);
        let numbers = smooth.get(CREASE).unwrap();
        assert!(numbers.iter().all(|s| s.to_bits() == 0));
    }

    #[test]
    fn a_selection_of_nothing_still_makes_the_attribute_that_was_planned() {
        let crease = step("(edges: Boundary, sharpness: 1)");
        let (mesh, report) = try_applied(&crease, shapes::cube()).unwrap();
        assert_eq!(mesh.get(CREASE).unwrap(), [0.0; 12]);
        assert_eq!(report.changed, 0);
        let (plan, problems) = planned(&crease, &shapes::cube());
        assert_eq!((plan, problems), (MeshPlan::of(&mesh), vec![]));
    }

    #[test]
    fn without_edges_and_vertices_there_is_nothing_to_do() {
        let crease = step("(sharpness: 1)");
        let problems = planned(&crease, &shapes::cube()).1;
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].message, NOTHING);
        let error = try_applied(&crease, shapes::cube()).unwrap_err();
        assert!(matches!(error, OpError::Parameter(_)));
    }

    #[test]
    fn an_attribute_of_another_type_is_not_overwritten() {
        let mut mesh = shapes::cube();
        let column = Column {
            name: CREASE.name.to_owned(),
            rule: Rule::Interpolate,
            values: Values::Vec3(vec![DVec3::ONE; 12]),
        };
        mesh.insert_column(Domain::Edge, column);
        let error = try_applied(&step("(edges: All, sharpness: 1)"), mesh).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the edge attribute \"crease\" holds values of another type: 3 numbers"
        );
    }
}
