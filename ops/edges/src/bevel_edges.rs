//! Bevel edges: replaces edges with faces of constant width.
//!
//! ```text
//!     \               /            \               /
//!      \             /              + ----------- +
//!       a --- e --- b      -->      |             |       the new edges have the same distance from e,
//!      /             \              + ----------- +       and the other edges at a and b are cut there
//!     /               \            /               \
//! ```

use geometry::bevel::{BevelRefusal, Beveled, bevel_edges, shortest_edge_at};
use mesh::{EdgeId, VertexId};
use op::prelude::*;
use op::{Refusal, readable};

/// Replaces edges with faces of constant width.
///
/// A selected edge and both of its ends are removed, and a new face replaces the edge. On both sides, the new face
/// extends up to the distance `width` from the old edge. An edge that is not selected, but ends at a vertex of a
/// selected edge, is shortened at this vertex. If the shortened edge and the selected edge are neighboring sides of a
/// face, the new end of the shortened edge is at the distance `width` from the selected edge. However, the edge is
/// shortened by at most four times `width`. If the two edges are not neighboring sides of a face, the edge is shortened
/// by `width`. If two selected edges are neighboring sides of a face, a new vertex inside this face replaces the corner
/// between them. If three or more new vertices replace an old vertex, another new face joins the new vertices. All
/// selected edges are beveled at once. For example, a cube with 12 selected edges keeps all of its symmetries.
///
/// The vertices at the ends of selected edges are removed, so vertices with higher ids get new ids. New vertices get
/// the highest ids. Faces keep their ids. New faces get the highest ids: first the faces that replace edges, in order
/// of these edges, then the faces that replace vertices. Edges get new ids.
///
/// The values of a new vertex are interpolated between corners of an old face, so textures stay in place. A new face
/// has the values (material, tags) of one of the old faces beside it. It is not specified which of these faces is used,
/// but the choice is the same in every run. New edges have zero values (no crease, no tags). Normals are dropped.
///
/// An edge cannot be beveled if it is on the boundary (reason: `Boundary`), or if one of its ends has only one other
/// edge and this other edge is not selected (reason: `FewEdges`). If the bevels at the two ends of any edge would
/// overlap, the selected edges at these ends cannot be beveled (reason: `OutsideEdge`). If the result would not be
/// manifold, no edge is beveled (reason: `NonManifold`).
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BevelEdges {
    /// The edges to bevel.
    pub edges: EdgeSelection,
    /// The distance of each new edge from the old edge, in scene units. Two new edges replace the old edge: one in each
    /// of the faces beside it. Either `width` or `fraction` must be given.
    #[serde(default)]
    pub width: Option<PositiveLength>,
    /// The width as a fraction of a length: the length of the shortest edge that is selected or shares a vertex with a
    /// selected edge. Above 0 and below 1.
    #[serde(default)]
    pub fraction: Option<Fraction>,
    /// What to do when an edge cannot be beveled.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for BevelEdges {
    const NAME: &'static str = "BevelEdges";
    const SUMMARY: &'static str = "Replace edges with faces";
    const EXAMPLE: &'static str = "BevelEdges(edges: Between(0, 2), width: 0.25)";
    const WORDS: &'static [&'static str] = &["chamfer"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let message = match (self.width, self.fraction) {
            (Some(_), Some(_)) => Some("`width` and `fraction` cannot be combined"),
            (None, None) => Some("BevelEdges needs `width` or `fraction`"),
            _ => None,
        };
        let problem = message.map(|message| {
            Problem::error(message).help("write, for example, `BevelEdges(edges: All, width: 0.1)`")
        });
        let done = self.on_refusal.done(self.edges.count(plan));
        if done.max > 0 {
            let degrees = plan.degrees.max.max(plan.edges.max);
            plan.degrees = Range::between(plan.degrees.min.min(3), degrees.saturating_mul(2));
            // There is at most one new vertex near the start of each half-edge. Each edge and each of its two ends gets
            // at most one new face.
            let faces = Range::between(done.min, done.max.saturating_mul(3));
            let vertices = Range::between(0, plan.edges.by(2).max);
            let edges = Range::between(done.min, vertices.plus(faces).max);
            plan.grow(vertices, edges, faces);
        }
        plan.drop_normals();
        Vec::from_iter(problem)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let edges = self.edges.resolve(mesh, cx)?;
        cx.advance("bevel", 0, 1)?;
        let width = match (self.width, self.fraction) {
            (Some(width), _) => width.get(),
            (None, Some(fraction)) => fraction.get() * shortest_edge_at(mesh, &edges),
            (None, None) => 0.0,
        };
        let mut report = Report::default();
        if edges.is_empty() {
            return Ok(report.note("nothing was selected"));
        }
        let beveled = bevel_edges(mesh, &edges, width);
        for &(e, refusal) in &beveled.refused {
            self.on_refusal
                .refuse(refused(mesh, e, refusal, width), &mut report)?;
        }
        let Beveled { mesh: new, refused } = beveled;
        report.changed = (edges.len() - refused.len()) as u64;
        if report.changed > 0 {
            mesh.replace(new);
        }
        mesh.remove_normals();
        Ok(report)
    }
}

fn refused(mesh: &Mesh, e: EdgeId, refusal: BevelRefusal, width: f64) -> OpError {
    let [v, w] = mesh.edge_vertices(e).map(VertexId::index);
    let (reason, why) = match refusal {
        BevelRefusal::Boundary => (Refusal::Boundary, "is on the boundary".to_owned()),
        BevelRefusal::FewEdges(v) => {
            let why = format!("ends at {v}, which has only one other edge");
            (Refusal::FewEdges, why)
        }
        BevelRefusal::TooWide => {
            let why = format!("leaves no space for a bevel of width {}", readable(width));
            (Refusal::OutsideEdge, why)
        }
        BevelRefusal::NonManifold => {
            let why = "cannot be beveled, because the result would not be manifold".to_owned();
            (Refusal::NonManifold, why)
        }
    };
    let message = format!("Between({}, {}) {why}", v.min(w), v.max(w));
    OpError::refused(reason, message).about([e])
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, FaceId};

    use op::test::{applied, planned, try_applied};

    fn parse(text: &str) -> BevelEdges {
        op::test::read(text).unwrap()
    }

    #[test]
    fn one_edge_of_a_cube_becomes_a_quad() {
        let step = parse("(edges: Between(4, 5), fraction: 0.5)");
        let (mesh, report) = try_applied(&step, shapes::cube()).unwrap();
        assert_eq!(report.changed, 1);
        assert_eq!(mesh.degree(FaceId::new(6)), 4);
        assert!((geometry::volume(&mesh) - 7.0).abs() < 1e-13);
    }

    #[test]
    fn beveling_four_parallel_edges_gives_a_prism() {
        let upright = "Or([Between(0, 4), Between(1, 5), Between(2, 6), Between(3, 7)])";
        let step = parse(&format!(
            "(edges: Expect(count: 4, of: {upright}), fraction: 0.25)"
        ));
        let (plan, problems) = planned(&step, &shapes::cube());
        assert_eq!(problems, []);
        assert!(plan.faces.contains(10));
        let mesh = applied(&step, shapes::cube());
        let counts = [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()];
        assert_eq!(counts, [16, 24, 10]);
        // The base of the prism is an octagon: a square of side 2 from which four triangles with legs of 1/2 are cut.
        assert!((geometry::volume(&mesh) - 2.0 * (4.0 - 0.5)).abs() < 1e-13);
        for &p in mesh.positions() {
            let (x, y) = (p.x.abs(), p.y.abs());
            assert!((x.min(y) - 0.5).abs() < 1e-15 && (x.max(y) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn a_cube_beveled_at_all_edges_keeps_its_rotations() {
        let step = parse("(edges: All, width: 0.5)");
        let (mesh, report) = try_applied(&step, shapes::cube()).unwrap();
        assert_eq!(report.changed, 12);
        assert!(mesh.is_closed());
        let (plan, _) = planned(&step, &shapes::cube());
        assert!(plan.vertices.contains(mesh.n_vertices() as u64));
        assert!(plan.edges.contains(mesh.n_edges() as u64));
        assert!(plan.faces.contains(mesh.n_faces() as u64));
        let quarter = applied(&parse("(edges: All, fraction: 0.25)"), shapes::cube());
        assert_eq!(quarter, mesh);
    }

    #[test]
    fn a_width_or_a_fraction_is_needed() {
        for text in ["(edges: All)", "(edges: All, width: 1, fraction: 0.5)"] {
            let (_, problems) = planned(&parse(text), &shapes::cube());
            assert_eq!(problems.len(), 1, "{text}");
        }
    }

    #[test]
    fn too_wide_bevels_are_refused_with_their_edges() {
        let refused = try_applied(&parse("(edges: All, width: 1)"), shapes::cube());
        let message = refused.unwrap_err().to_string();
        assert!(
            message.contains("leaves no space for a bevel of width 1"),
            "{message}"
        );
        let step = parse("(edges: All, fraction: 0.75, on_refusal: Skip)");
        let (mesh, report) = try_applied(&step, shapes::cube()).unwrap();
        assert_eq!((report.changed, report.refused[0].count), (0, 12));
        assert_eq!(mesh.n_faces(), 6);
    }

    #[test]
    fn results_that_are_not_manifold_are_refused_as_such() {
        // Two hexagons back to back. `bisect` cuts each hexagon along a new edge from vertex 0 to vertex 3, so two
        // edges join the same two vertices. A mesh with two edges between the same vertices cannot be built from
        // polygons.
        let points = [(2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2)];
        let points = points.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0));
        let faces = [[0_u32, 1, 2, 3, 4, 5], [5, 4, 3, 2, 1, 0]];
        let (mut mesh, _) = Mesh::from_polygons(points.to_vec(), &faces).unwrap();
        geometry::bisect(&mut mesh, DVec3::ZERO, DVec3::Y).unwrap();
        let face = mesh.vertex_faces(VertexId::new(4)).next().unwrap();
        mesh.poke_face(face).unwrap();
        assert!(mesh.is_valid());
        let step = parse("(edges: Between(4, 6), width: 0.01)");
        assert_eq!(op::test::refused(&step, mesh), Refusal::NonManifold);
    }

    #[test]
    fn edges_at_the_boundary_are_refused() {
        let step = parse("(edges: All, fraction: 0.25, on_refusal: Skip)");
        let (_, report) = try_applied(&step, shapes::grid(3, 3)).unwrap();
        // The 12 inner edges are beveled, although eight of them end at the boundary.
        assert_eq!(report.changed, 12);
        let step = parse("(edges: All, fraction: 0.25)");
        let refused = try_applied(&step, shapes::grid(3, 3));
        assert!(
            matches!(refused, Err(OpError::Refused { .. })),
            "{refused:?}"
        );
    }
}
