//! Crease: makes edges and vertices sharp for subdivision.
//!
//! ```text
//!    +-------+-------+            +-------+-------+
//!    |       |       |            |       ‖       |
//!    |       e       |    -->     |       ‖ 2.5   |       edges have a sharpness in the attribute `crease`,
//!    |       |       |            |       ‖       |       vertices in the attribute `corner`
//!    +-------+-------+            +-------+-------+
//! ```
//!
//! Sharpness is defined as in DeRose, Kass and Truong, "Subdivision Surfaces in Character Animation", 1998.

use mesh::{Attribute, CREASE, Domain, Id, VERTEX_SHARPNESS};
use op::prelude::*;

/// Makes edges and vertices sharp for subdivision.
///
/// The step sets two attributes to `sharpness`: the edge attribute `crease` of the selected edges, and the vertex
/// attribute `corner` of the selected vertices. Elements that are not selected keep their values, or get 0 if the
/// attribute did not exist before the step. In Loop and Catmull-Clark subdivision, an edge or a vertex with sharpness s
/// stays sharp in the first s levels and becomes smooth in later levels. For example, an edge with sharpness 2.5 is
/// sharp in the first two levels. The third level places the vertices halfway between the sharp and the smooth result.
/// An edge with sharpness 10 stays sharp, however many levels follow. Boundary edges are always sharp.
///
/// At least one of `edges` and `vertices` must be given. The geometry does not change. The report counts the elements
/// whose value changed.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Crease {
    /// The edges to change. If omitted, no edges.
    #[serde(default)]
    pub edges: Option<EdgeSelection>,
    /// The vertices to change. If omitted, no vertices.
    #[serde(default)]
    pub vertices: Option<VertexSelection>,
    /// The number of subdivision levels for which the elements stay sharp, from 0 to 10. With 0, creases are removed.
    /// With 10, the elements are sharp at every level.
    pub sharpness: Sharpness,
}

impl MeshOperation for Crease {
    const NAME: &'static str = "Crease";
    const SUMMARY: &'static str = "Make edges and vertices sharp for subdivision";
    const EXAMPLE: &'static str = "Crease(edges: Sharp(above: 40), sharpness: 2.5)";
    const WORDS: &'static [&'static str] = &["sharpness", "sharp", "hard"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if self.is_empty() {
            let help = "`edges: All` selects every edge, and `vertices: All` selects every vertex";
            problems.push(Problem::error(NO_SELECTION).help(help));
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
            return Err(OpError::Parameter(NO_SELECTION.to_owned()));
        }
        cx.advance("crease", 0, 1)?;
        // Both selections are evaluated before the first change.
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

const NO_SELECTION: &str = "expected `edges`, `vertices` or both";

impl Crease {
    fn is_empty(&self) -> bool {
        self.edges.is_none() && self.vertices.is_none()
    }
}

/// Sets the attribute of the given elements to `sharpness`. Returns the number of values that changed.
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
                "expected the {domain} attribute \"{name}\" to hold one number for each {domain}, found {kind}"
            )));
        }
    };
    let mut changed = 0;
    for id in ids {
        let number = &mut numbers[id.index()];
        if *number != sharpness {
            changed += 1;
            // Adding 0 turns -0 into 0, so that the sharpness is never -0.
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
    fn other_edges_keep_their_sharpness() {
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
    fn zero_removes_a_crease_and_unchanged_values_are_not_counted() {
        let sharp = applied(&step("(edges: All, sharpness: 1)"), shapes::cube());
        let twice = try_applied(&step("(edges: All, sharpness: 1)"), sharp.clone()).unwrap();
        assert_eq!((twice.0 == sharp, twice.1.changed), (true, 0));
        let (smooth, report) = try_applied(&step("(edges: All, sharpness: -0.0)"), sharp).unwrap();
        assert_eq!(report.changed, 12);
        let numbers = smooth.get(CREASE).unwrap();
        assert!(numbers.iter().all(|s| s.to_bits() == 0));
    }

    #[test]
    fn an_empty_selection_still_creates_the_planned_attribute() {
        let crease = step("(edges: Boundary, sharpness: 1)");
        let (mesh, report) = try_applied(&crease, shapes::cube()).unwrap();
        assert_eq!(mesh.get(CREASE).unwrap(), [0.0; 12]);
        assert_eq!(report.changed, 0);
        let (plan, problems) = planned(&crease, &shapes::cube());
        assert_eq!((plan, problems), (MeshPlan::of(&mesh), vec![]));
    }

    #[test]
    fn a_step_without_edges_and_vertices_is_an_error() {
        let crease = step("(sharpness: 1)");
        let problems = planned(&crease, &shapes::cube()).1;
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].message, NO_SELECTION);
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
            "expected the edge attribute \"crease\" to hold one number for each edge, found 3 numbers"
        );
    }
}
