//! Bridge loops: joins two holes with a band of faces.
//!
//! ```text
//!      .-------.               .-------.
//!     (  first  )             (    |    )
//!      '---*---'               '---*---'
//!                     -->      |   |   |       the first new edge joins the two vertices
//!      .---*---.               .---*---.
//!     (  second )             (    |    )
//!      '-------'               '-------'
//! ```

use mesh::VertexId;
use op::Refusal;
use op::prelude::*;

/// Joins two holes with a band of faces.
///
/// A hole is a boundary loop: a closed loop of edges, each of which has a face on one side only. The parameter `first`
/// gives a vertex of one hole, and the parameter `second` gives a vertex of the other hole. The band starts at a new
/// edge that joins these two vertices, and runs once around both holes. Let n and m be the numbers of edges of the two
/// holes, where n is at least m. The band then consists of m quadrilaterals and n - m evenly spread triangles. The step
/// adds n edges and no vertices. Both holes can be in one connected part of the mesh, which then gets a tunnel or a
/// handle. They can also be in two separate parts of the mesh, which then become connected. To bridge holes of two
/// objects, first use `Join` to make one mesh of the objects.
///
/// Each new face is beside one edge of the hole that has more edges. If both holes have the same number of edges, this
/// edge belongs to the hole of the vertex `first`. The new face copies the attribute values of the old face on the
/// other side of this edge. A new corner has the values of an existing corner at the same vertex. Normals are dropped.
///
/// The step is refused if one of the given vertices is not on the boundary (reason: `NotBoundary`), or if both are on
/// the same hole (reason: `WrongPlace`). The step is also refused if a new edge would join two vertices that an edge
/// already joins (reason: `DuplicateEdge`). In this last case, try other vertices of the same holes.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BridgeLoops {
    /// The id of a vertex on the first hole.
    pub first: u32,
    /// The id of a vertex on the second hole. A new edge joins this vertex to the vertex `first`.
    pub second: u32,
}

impl MeshOperation for BridgeLoops {
    const NAME: &'static str = "BridgeLoops";
    const SUMMARY: &'static str = "Join two holes with a band of faces";
    const EXAMPLE: &'static str = "BridgeLoops(first: 0, second: 5)";
    const WORDS: &'static [&'static str] = &["loft"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        for (field, v) in [("first", self.first), ("second", self.second)] {
            let missing = plan.missing_vertex_message(v).map(Problem::error);
            problems.extend(missing.map(|p| p.at([field])));
        }
        if self.first == self.second {
            let message =
                "`first` and `second` must be on different holes, but they are the same vertex";
            problems.push(Problem::error(message).at(["second"]));
        }
        // Let n be the number of edges of the larger hole. The band between the holes then has n faces. Every hole has
        // at least two edges.
        let band = Range::between(2, plan.edges.max);
        plan.grow(Range::exactly(0), band, band);
        plan.degrees = plan.degrees.or(Range::between(3, 4));
        plan.drop_normals();
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("bridge", 0, 1)?;
        let [first, second] = [self.first, self.second].map(|v| boundary_vertex(mesh, v, cx));
        let (first, second) = (first?, second?);
        let (Some(h), Some(g)) = (mesh.vertex_half_edge(first), mesh.vertex_half_edge(second))
        else {
            unreachable!("vertices on the boundary have edges");
        };
        let band = mesh.bridge_loops(h, mesh.prev(g))?;
        mesh.remove_normals();
        Ok(Report::changed(band.len()))
    }
}

/// Returns the vertex with this id, which must be on the boundary.
fn boundary_vertex(mesh: &Mesh, number: u32, cx: &Context) -> Result<VertexId, OpError> {
    let v = VertexSelection::Vertices(vec![number]).resolve(mesh, cx)?[0];
    if mesh.is_boundary_vertex(v) {
        Ok(v)
    } else {
        let message = format!("vertex {number} is not on the boundary");
        Err(OpError::refused(Refusal::NotBoundary, message).about([v]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, FaceId, VERTEX_NORMAL};
    use op::test::{applied, try_applied};

    fn parse(text: &str) -> BridgeLoops {
        op::test::read(text).unwrap()
    }

    fn refusal(text: &str, mesh: Mesh) -> Refusal {
        match try_applied(&parse(text), mesh) {
            Err(OpError::Refused { reason, .. }) => reason,
            other => panic!("expected a refusal, got {other:?}"),
        }
    }

    /// Returns a flat sheet with an outer rim of 16 edges and a hole of 8 edges.
    fn sheet_with_a_hole() -> Mesh {
        let mut mesh = shapes::grid(4, 4);
        let mut ring = vec![5, 6, 9, 10];
        while !ring.is_empty() {
            ring.retain(|&f| mesh.delete_face(FaceId::new(f)).is_err());
        }
        mesh.delete_isolated_vertices();
        mesh.compact();
        mesh
    }

    #[test]
    fn a_tunnel_through_an_icosahedron_increases_the_genus() {
        let mut mesh = shapes::icosahedron();
        for f in [0, 13] {
            mesh.delete_face(FaceId::new(f)).unwrap();
        }
        mesh.compact();
        mesh.set(VERTEX_NORMAL, vec![DVec3::Z; 12]);
        let (joined, report) = try_applied(&parse("(first: 0, second: 3)"), mesh).unwrap();
        assert!(joined.is_closed());
        assert_eq!((geometry::genus(&joined), report.changed), (1, 3));
        let v = VertexId::new;
        assert!(joined.find_half_edge(v(0), v(3)).is_some());
        assert!(joined.get(VERTEX_NORMAL).is_none());
    }

    #[test]
    fn joining_the_hole_and_the_rim_of_a_sheet_gives_a_torus() {
        let mesh = sheet_with_a_hole();
        assert_eq!(mesh.n_boundary_loops(), 2);
        // The first new edge joins a corner of the outer rim to the opposite corner of the hole.
        let mut corners = mesh.vertices().filter(|&v| {
            let p = mesh.position(v);
            p == DVec3::new(1.0, 1.0, 0.0)
        });
        let far = corners.next().unwrap().index();
        let joined = applied(&parse(&format!("(first: 0, second: {far})")), mesh.clone());
        assert!(joined.is_closed());
        assert_eq!(geometry::genus(&joined), 1);
        assert_eq!(joined.n_faces(), mesh.n_faces() + 16);
    }

    #[test]
    fn vertices_that_are_not_on_two_holes_are_refused() {
        let mesh = sheet_with_a_hole;
        assert_eq!(refusal("(first: 0, second: 999)", mesh()), Refusal::Missing);
        assert_eq!(
            refusal("(first: 0, second: 1)", mesh()),
            Refusal::WrongPlace
        );
        assert_eq!(
            refusal("(first: 0, second: 0)", mesh()),
            Refusal::WrongPlace
        );
        let cube = refusal("(first: 0, second: 1)", shapes::cube());
        assert_eq!(cube, Refusal::NotBoundary);
        let tube = refusal("(first: 0, second: 4)", shapes::cylinder(4, false));
        assert_eq!(tube, Refusal::DuplicateEdge);
    }

    #[test]
    fn both_vertices_are_required() {
        assert!(op::test::read::<BridgeLoops>("(first: 3)").is_err());
        assert!(op::test::read::<BridgeLoops>("(first: -1, second: 2)").is_err());
        assert_eq!(parse("(first: 3, second: 17)").second, 17);
    }
}
