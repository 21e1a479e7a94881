//! Collapse edges: merges the two ends of each edge.
//!
//! ```text
//!        c               c
//!      / | \             |
//!    a --e-- b    -->    v        v = (1 - at) a + at b
//!      \ | /             |
//!        d               d
//! ```

use op::prelude::*;

/// Collapses edges, so that the two ends of each edge become one vertex.
///
/// In a mesh of triangles, the collapse of an inner edge removes 1 vertex, 3 edges and 2 faces. The collapse of a
/// boundary edge removes 1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the face
/// is not removed and only loses a corner. Of the two ends, the vertex with the lower id is kept. Edges are collapsed
/// in order of their ids. An edge that an earlier collapse removed counts as refused.
///
/// A collapse is refused if it would change the topology of the surface, or if two different elements would become one.
/// The report or the error message gives one of these reasons:
///
/// - `JoinsBoundaries`: both ends of the edge are on the boundary, but the edge itself is not.
/// - `Link`: the ends have a common neighboring vertex that is not a corner of a triangle beside the edge. Examples are
///   the edges around a tube with three sides, and the edges of a hole with three edges.
/// - `DuplicateEdge`: a second edge joins the same two vertices.
/// - `RepeatedVertex`: both ends are also corners of a face that is not beside the edge.
/// - `Vanishes`: at the remaining vertex, the collapse would leave no face (as for a single triangle), or only two
///   faces that lie back to back (as for a tetrahedron).
/// - `SameFace`: the same face is on both sides of the edge, or the collapse would put the same face on both sides of
///   another edge.
/// - `SameOpposite`: the two triangles beside the edge share another edge.
///
/// Attribute values at the remaining vertex and at its corners are interpolated between the ends of the edge. A seam is
/// an edge whose corner values, such as UVs, differ between its two sides. At a seam, the corner values of each side
/// are interpolated separately. When two edges become one, the remaining edge gets the larger crease value (sharpness
/// for subdivision) and the tags of both edges. Normals are dropped.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CollapseEdges {
    /// The edges to collapse.
    pub edges: EdgeSelection,
    /// The position of the remaining vertex on the old edge, as a fraction of the length of the edge, from 0 to 1.
    ///
    /// If `edges` is `Between(v, w)`, position 0 is at v and position 1 is at w. For all other selections, position 0
    /// is at the end whose vertex has the lower id.
    #[serde(default = "half")]
    pub at: ClosedFraction,
    /// What to do when a collapse is refused.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

const fn half() -> ClosedFraction {
    ClosedFraction::literal(0.5)
}

impl MeshOperation for CollapseEdges {
    const NAME: &'static str = "CollapseEdges";
    const SUMMARY: &'static str = "Collapse edges to points";
    const EXAMPLE: &'static str = "CollapseEdges(edges: All, on_refusal: Skip)";
    const WORDS: &'static [&'static str] = &["merge", "contract"];
    const DONE: &'static str = "collapsed";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let selected = self.edges.count(plan);
        let n = self.on_refusal.done(selected);
        // A triangle beside the edge is removed, and its two other edges become one. A face beside the edge with more
        // than three corners is not removed.
        let least = u64::from(plan.is_triangles());
        let faces = n.times(Range { min: least, max: 2 });
        plan.vertices = plan.vertices.minus(n);
        plan.edges = plan.edges.minus(n.plus(faces));
        plan.faces = plan.faces.minus(faces);
        plan.degrees.min = plan.degrees.min.min(3);
        plan.drop_normals();
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let edges = self.edges.resolve(mesh, cx)?;
        cx.advance("collapse", 0, edges.len() as u64)?;
        mesh.remove_normals();
        edit_each(mesh, &edges, self.on_refusal, "collapse", cx, |mesh, e| {
            let t = self.edges.place_on(mesh, e, self.at.get());
            mesh.collapse_edge_at(e, t).map(drop)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, VERTEX_NORMAL, VertexId};
    use op::Refusal;
    use op::test::{applied, planned, try_applied};
    use proptest::prelude::*;

    fn parse(text: &str) -> CollapseEdges {
        op::test::read(text).unwrap()
    }

    #[test]
    fn the_position_is_measured_from_the_first_named_vertex() {
        // The vertices of the square are (0,0), (1,0), (1,1), (0,1).
        let x = |text, v| {
            let mesh = applied(&parse(text), shapes::square());
            mesh.position(VertexId::new(v)).x
        };
        assert_eq!(x("(edges: Between(0, 1), at: 0.25)", 0), 0.25);
        assert_eq!(x("(edges: Between(1, 0), at: 0.25)", 0), 0.75);
        assert_eq!(x("(edges: Between(2, 3), at: 0.25)", 2), 0.75);
        assert_eq!(x("(edges: Between(3, 2), at: 0.25)", 2), 0.25);
        assert_eq!(x("(edges: Between(0, 1))", 0), 0.5);
    }

    #[test]
    fn otherwise_the_position_is_measured_from_the_lower_number() {
        let before = shapes::icosahedron();
        let longest = "(edges: Longest(count: 1), at: 0)";
        let mesh = applied(&parse(longest), before.clone());
        // With `at: 0`, the collapse moves no vertex and only removes the end with the higher id.
        assert_eq!(mesh.n_vertices(), 11);
        assert!(
            mesh.positions()
                .iter()
                .all(|p| before.positions().contains(p))
        );
        let mesh = applied(&parse("(edges: Longest(count: 1), at: 1)"), before.clone());
        assert!(
            mesh.positions()
                .iter()
                .all(|p| before.positions().contains(p))
        );
    }

    #[test]
    fn a_refusal_names_the_edge_by_its_vertices() {
        let refused = try_applied(&parse("(edges: Between(0, 1))"), shapes::tetrahedron());
        let Err(OpError::Refused {
            reason, message, ..
        }) = refused
        else {
            panic!("{refused:?}");
        };
        assert_eq!(reason, Refusal::Vanishes);
        assert!(message.contains("Between(0, 1)"), "{message}");
    }

    #[test]
    fn edges_removed_by_earlier_collapses_count_as_refused() {
        let all = parse("(edges: All, on_refusal: Skip)");
        let (mesh, report) = try_applied(&all, shapes::icosahedron()).unwrap();
        assert_eq!(mesh.n_vertices() as u64, 12 - report.changed);
        let refused: u64 = report.refused.iter().map(|r| r.count).sum();
        assert_eq!(report.changed + refused, 30);
        let missing = report.refused.iter().find(|r| r.reason == Refusal::Missing);
        assert!(missing.is_some_and(|r| r.count >= 2 * report.changed));
    }

    #[test]
    fn normals_are_dropped() {
        let mut mesh = shapes::icosahedron();
        mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
        let collapse = parse("(edges: Longest(count: 1))");
        let (plan, _) = planned(&collapse, &mesh);
        assert_eq!(plan.attributes, []);
        assert!(applied(&collapse, mesh).get(VERTEX_NORMAL).is_none());
    }

    #[test]
    fn the_plan_of_triangles_has_the_exact_number_of_vertices() {
        let (plan, problems) = planned(&parse("(edges: Between(0, 1))"), &shapes::octahedron());
        assert_eq!(problems, []);
        assert_eq!(plan.vertices, Range::exactly(5));
        assert_eq!(plan.edges, Range { min: 9, max: 10 });
        assert_eq!(plan.faces, Range { min: 6, max: 7 });
        assert!(plan.is_triangles());
    }

    #[test]
    fn only_the_edges_are_required() {
        let collapse = parse("(edges: Random(count: 3, seed: 7))");
        assert_eq!(
            (collapse.at, collapse.on_refusal),
            (half(), OnRefusal::Error)
        );
        assert!(op::test::read::<CollapseEdges>("(at: 0.5)").is_err());
    }

    proptest! {
        #[test]
        fn topology_and_plan_hold_for_any_selection(
            count in 0..40_u32, seed in 0..1000_u64, at in 0.0..=1.0_f64, which in 0..6_usize,
        ) {
            let before = [
                Mesh::default(),
                shapes::grid(3, 2),
                shapes::fans(&shapes::grid(4, 4)),
                shapes::cube(),
                shapes::icosahedron(),
                shapes::cylinder(5, true),
            ][which].clone();
            let edges = EdgeSelection::Random { count, of: Box::default(), seed };
            let at = ClosedFraction::literal(at);
            let collapse = CollapseEdges { edges, at, on_refusal: OnRefusal::Skip };
            let after = applied(&collapse, before.clone());
            let (plan, _) = planned(&collapse, &before);
            prop_assert!(plan.vertices.contains(after.n_vertices() as u64));
            prop_assert!(plan.edges.contains(after.n_edges() as u64));
            prop_assert!(plan.faces.contains(after.n_faces() as u64));
            prop_assert!(after.faces().all(|f| plan.degrees.contains(after.degree(f) as u64)));
            prop_assert_eq!(after.euler_characteristic(), before.euler_characteristic());
            prop_assert_eq!(after.n_boundary_loops(), before.n_boundary_loops());
            // Each merged vertex is on an edge of the old mesh, and therefore inside the bounding box of the old mesh.
            if let (Some([low, high]), Some([min, max])) = (geometry::bounds(&before), geometry::bounds(&after)) {
                let slack = DVec3::splat(1e-12);
                prop_assert!((low - slack).cmple(min).all() && max.cmple(high + slack).all());
            }
        }
    }
}
