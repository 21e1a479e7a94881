//! Bevel edges: replaces edges with faces.
//!
//! ```text
//!     \               /            \               /
//!      \             /              + ----------- +
//!       a --- e --- b      -->      |             |       the other edges at a and b are cut at a
//!      /             \              + ----------- +       fraction of their lengths from a and b
//!     /               \            /               \
//! ```

use geometry::bevel::Cuts;
use op::prelude::*;

/// Replaces edges with faces.
///
/// A selected edge and both of its ends are removed. Each other edge at these ends is cut at a fraction of the length
/// that it had before the step, and a new face joins the cuts. The face has four corners if three edges met at each
/// end. Edges are beveled in order of their numbers, in the mesh as edited so far: an edge that an earlier bevel has
/// cut starts at the cut. If an edge is cut at both ends, the fraction must be below 0.5.
///
/// The ends of the edges are removed, and later vertices are renumbered. New vertices are numbered last, in order of
/// the edges and clockwise around each edge. Faces keep their numbers; new faces are numbered last, in order of the
/// edges.
///
/// Values at the cuts are interpolated between the ends of the edge, so textures do not change. A new face has the
/// values (material, tags) of one of the two faces beside the edge. Which one is not specified, but it is the same in
/// every run. New edges have zero values (no crease, no tags). Normals are dropped.
///
/// An edge is refused if it or one of its ends is on the boundary, if an end has fewer than three edges, if its ends
/// are also joined by another edge, or if earlier cuts leave too little of an edge at one of its ends.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BevelEdges {
    /// The edges to bevel.
    pub edges: EdgeSelection,
    /// The distance of the cuts from the ends of the edge, as a fraction of the lengths of the edges that are cut. From
    /// 0 to 1, exclusive.
    pub fraction: Fraction,
    /// What to do when an edge is refused.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for BevelEdges {
    const NAME: &'static str = "BevelEdges";
    const SUMMARY: &'static str = "Replace edges with faces";
    const EXAMPLE: &'static str = "BevelEdges(edges: Between(0, 2), fraction: 0.25)";
    const WORDS: &'static [&'static str] = &["chamfer"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let done = self.on_refusal.done(self.edges.count(plan));
        if done.max > 0 {
            // Each edge makes at least four cuts. An old vertex is removed with the first of its edges. All edges
            // together have two ends each, and a new vertex has three edges.
            let cuts = Range::between(done.by(4).min, plan.edges.by(2).plus(done.by(4)).max);
            // A new face has as many corners as there are cuts, and later bevels can double the number.
            let largest = plan.degrees.max.max(plan.edges.max.saturating_add(3));
            plan.degrees = Range::between(plan.degrees.min.min(4), largest.saturating_mul(2));
            let cuts_minus = |removed: u64| Range {
                min: cuts.min - removed * done.min.min(cuts.min / 4),
                max: cuts.max.saturating_sub(done.min.saturating_mul(removed)),
            };
            plan.grow(cuts_minus(2), cuts_minus(1), done);
        }
        plan.drop_normals();
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let edges = self.edges.resolve(mesh, cx)?;
        let mut cuts = Cuts::default();
        let report = edit_each(mesh, &edges, self.on_refusal, "bevel", cx, |mesh, e| {
            let f = mesh.bevel_edge_with(e, |e| cuts.fraction(e, self.fraction.get()))?;
            cuts.cut(mesh, f, self.fraction.get());
            Ok(())
        })?;
        mesh.remove_normals();
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::FaceId;

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
        assert_eq!(plan.faces, Range::exactly(10));
        let mesh = applied(&step, shapes::cube());
        let counts = [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()];
        assert_eq!(counts, [16, 24, 10]);
        // The base of the prism is an octagon: a square of side 2 without four triangles with legs of 1/2.
        assert!((geometry::volume(&mesh) - 2.0 * (4.0 - 0.5)).abs() < 1e-13);
        for &p in mesh.positions() {
            let (x, y) = (p.x.abs(), p.y.abs());
            assert!((x.min(y) - 0.5).abs() < 1e-15 && (x.max(y) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn all_edges_of_a_cube_leave_a_valid_mesh() {
        for fraction in ["0.1", "0.25", "0.5", "0.75"] {
            let step = parse(&format!(
                "(edges: All, fraction: {fraction}, on_refusal: Skip)"
            ));
            let (mesh, report) = try_applied(&step, shapes::cube()).unwrap();
            assert!(report.changed >= 4, "{report:?}");
            assert!(mesh.is_closed());
            assert_eq!(geometry::genus(&mesh), 0);
            let (plan, _) = planned(&step, &shapes::cube());
            assert!(plan.vertices.contains(mesh.n_vertices() as u64));
            assert!(plan.edges.contains(mesh.n_edges() as u64));
            assert!(plan.faces.contains(mesh.n_faces() as u64));
        }
    }

    #[test]
    fn edges_at_the_boundary_are_refused() {
        let step = parse("(edges: All, fraction: 0.25, on_refusal: Skip)");
        let (_, report) = try_applied(&step, shapes::grid(3, 3)).unwrap();
        // Only the four edges in the middle are not at the boundary.
        assert_eq!(report.changed, 4);
        let step = parse("(edges: All, fraction: 0.25)");
        let refused = try_applied(&step, shapes::grid(3, 3));
        assert!(
            matches!(refused, Err(OpError::Refused { .. })),
            "{refused:?}"
        );
    }
}
