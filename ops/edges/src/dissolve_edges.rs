//! Dissolve edges: removes edges and merges the faces beside them.
//!
//! ```text
//!    +-----b-----+          +-----b-----+
//!    |  f  e  g  |   -->    |           |
//!    +-----a-----+          +-----a-----+
//! ```

use op::prelude::*;

/// Removes edges and merges the faces beside them.
///
/// Edges are removed in order of their ids. Each removal is checked against the mesh that the earlier removals have
/// produced. A removal reduces the number of edges by 1 and the number of faces by 1. Of the two faces beside the edge,
/// the face with the lower id is kept, with its values. No vertex is removed or moved. To remove vertices that are left
/// with two edges, use `DissolveVertices(vertices: Valence(2))` in a later step. The remaining elements keep their
/// order and their values but get new ids.
///
/// An edge cannot be removed if it is on the boundary or if the same face is on both of its sides. It also cannot be
/// removed if one of its ends has only two edges. The two faces beside the edge must have no common vertices except the
/// ends of the edge. A seam is removed only if `seams` is `Drop`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct DissolveEdges {
    /// The edges to remove.
    pub edges: EdgeSelection,
    /// What to do when an edge cannot be removed.
    #[serde(default)]
    pub on_refusal: OnRefusal,
    /// What to do with a seam (an edge whose corner values, such as UVs, differ between its two sides).
    #[serde(default)]
    pub seams: Seams,
}

impl MeshOperation for DissolveEdges {
    const NAME: &'static str = "DissolveEdges";
    const SUMMARY: &'static str = "Remove edges and merge the faces beside them";
    const EXAMPLE: &'static str = "DissolveEdges(edges: Between(0, 1))";
    const WORDS: &'static [&'static str] = &["remove", "delete"];
    const DONE: &'static str = "dissolved";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let chosen = self.edges.count(plan);
        let n = self.on_refusal.done(chosen);
        // Removing n edges merges at most n + 1 faces into one face. Each removed edge was a side of two faces, so it
        // reduces the total number of sides by two.
        let sides = plan.degrees.max.saturating_sub(2);
        let merged = n.max.saturating_mul(sides).saturating_add(plan.degrees.max);
        plan.degrees.max = merged
            .min(plan.edges.max.saturating_mul(2))
            .max(plan.degrees.max);
        plan.edges = plan.edges.minus(n);
        plan.faces = plan.faces.minus(n);
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let edges = self.edges.resolve(mesh, cx)?;
        let seams = self.seams.into();
        edit_each(mesh, &edges, self.on_refusal, "dissolve", cx, |mesh, e| {
            mesh.dissolve_edge_with(e, seams).map(drop)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec2, UV};
    use op::test::{applied, is_as_planned, planned, try_applied};
    use op::{Range, Refusal};
    use proptest::prelude::*;

    fn parse(text: &str) -> DissolveEdges {
        op::test::read(text).unwrap()
    }

    fn refused(text: &str, mesh: Mesh) -> Refusal {
        op::test::refused(&parse(text), mesh)
    }

    #[test]
    fn the_diagonals_of_a_triangulated_grid_are_removed() {
        let sheet = shapes::grid(4, 3);
        let diagonals = "(edges: Longest(count: 12))";
        let mesh = applied(&parse(diagonals), shapes::fans(&sheet));
        assert_eq!((mesh.n_edges(), mesh.n_faces()), (sheet.n_edges(), 12));
        assert!(mesh.faces().all(|f| mesh.degree(f) == 4));
    }

    #[test]
    fn edges_whose_faces_cannot_be_merged_are_refused() {
        assert_eq!(
            refused("(edges: Boundary)", shapes::square()),
            Refusal::Boundary
        );
        // After two of the four edges at the middle vertex are removed, this vertex has only two edges.
        let around = "(edges: Between(1, 4))";
        let mut mesh = applied(&parse(around), shapes::grid(2, 2));
        mesh = applied(&parse("(edges: Between(3, 4))"), mesh);
        assert_eq!(refused("(edges: Between(4, 5))", mesh), Refusal::FewEdges);
        // A tube of three squares.
        let tube = applied(&parse("(edges: Between(0, 3))"), shapes::cylinder(3, false));
        assert_eq!(
            refused("(edges: Between(1, 4))", tube),
            Refusal::RepeatedVertex
        );
    }

    #[test]
    fn a_seam_is_refused_unless_seams_are_dropped() {
        let mut mesh = shapes::grid(2, 1);
        let uvs = mesh.half_edges().map(|h| {
            DVec2::splat(if mesh.face(h).is_some_and(|f| f.index() == 1) {
                1.0
            } else {
                0.0
            })
        });
        let uvs = uvs.collect();
        mesh.set(UV, uvs);
        assert_eq!(
            refused("(edges: Between(1, 4))", mesh.clone()),
            Refusal::Seam
        );
        let merged = applied(&parse("(edges: Between(1, 4), seams: Drop)"), mesh);
        assert_eq!(merged.n_faces(), 1);
    }

    #[test]
    fn skipped_refusals_are_counted() {
        let skip = parse("(edges: All, on_refusal: Skip)");
        let (mesh, report) = try_applied(&skip, shapes::grid(2, 1)).unwrap();
        assert_eq!(
            (mesh.n_faces(), report.changed, report.refused[0].count),
            (1, 1, 6)
        );
        assert!(is_as_planned(&skip, &shapes::grid(2, 1), &mesh));
    }

    #[test]
    fn the_plan_is_exact_if_refusals_are_errors() {
        let (plan, _) = planned(&parse("(edges: Longest(count: 2))"), &shapes::cube());
        assert_eq!(
            (plan.edges, plan.faces),
            (Range::exactly(10), Range::exactly(4))
        );
        assert_eq!(plan.degrees, Range { min: 4, max: 8 });
    }

    proptest! {
        #[test]
        fn topology_and_plan_hold_for_any_selection(
            count in 0..60_u32, seed in 0..1000_u64, which in 0..5_usize,
        ) {
            let before = [
                Mesh::default(),
                shapes::grid(4, 3),
                shapes::cube(),
                shapes::icosahedron(),
                shapes::torus(4, 3, 2.0, 1.0),
            ][which].clone();
            let edges = EdgeSelection::Random { count, of: Box::default(), seed };
            let dissolve =
                DissolveEdges { edges, on_refusal: OnRefusal::Skip, seams: Seams::Refuse };
            let (after, report) = try_applied(&dissolve, before.clone()).unwrap();
            prop_assert!(is_as_planned(&dissolve, &before, &after));
            prop_assert_eq!(after.euler_characteristic(), before.euler_characteristic());
            prop_assert_eq!(after.n_edges() as u64 + report.changed, before.n_edges() as u64);
            if report.refused.is_empty() {
                let strict = DissolveEdges { on_refusal: OnRefusal::Error, ..dissolve };
                prop_assert!(is_as_planned(&strict, &before, &after));
            }
        }
    }
}
