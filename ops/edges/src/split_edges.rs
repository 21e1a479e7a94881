//! Split edges: inserts a vertex on each edge and joins it to the opposite corners of the triangles.
//!
//! ```text
//!        c                 c
//!      /   \             / | \
//!    a --e-- b    -->   a--m--b        m = (1 - at) a + at b
//!      \   /             \ | /
//!        d                 d
//! ```

use op::prelude::*;

/// Inserts a vertex on each edge and joins this vertex to the opposite corners of the triangles beside the edge.
///
/// In a mesh of triangles, the split of an inner edge adds 1 vertex, 3 edges and 2 faces. The split of a boundary edge
/// adds 1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the face is not cut and
/// only gains the new vertex as a corner. Edges are split in order of their ids; new edges are not split again. New
/// vertices get the highest ids, in the order of the splits. Attribute values at the new vertex and at its corners are
/// interpolated between the ends of the edge. A seam is an edge whose corner values, such as UVs, differ between its
/// two sides. At a seam, the corner values of each side are interpolated separately.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SplitEdges {
    /// The edges to split.
    pub edges: EdgeSelection,
    /// The position of the new vertex on the edge, as a fraction of the length of the edge. Above 0 and below 1.
    ///
    /// If `edges` is `Between(v, w)`, position 0 is at v and position 1 is at w. For all other selections, position 0
    /// is at the end whose vertex has the lower id.
    #[serde(default = "half")]
    pub at: Fraction,
    /// What to do when a split is refused.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

const fn half() -> Fraction {
    Fraction::literal(0.5)
}

impl MeshOperation for SplitEdges {
    const NAME: &'static str = "SplitEdges";
    const SUMMARY: &'static str =
        "Insert a vertex on each edge and join the vertex to the opposite corners";
    const EXAMPLE: &'static str = "SplitEdges(edges: All)";
    const WORDS: &'static [&'static str] = &["insert", "refine", "divide"];
    const DONE: &'static str = "split";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // A split cuts at most two faces. At a boundary edge, or beside a face with more than three corners, a split
        // cuts fewer faces.
        let n = self.edges.count(plan);
        let cuts = n.times(Range::between(u64::from(plan.is_triangles()), 2));
        plan.grow(n, n.plus(cuts), cuts);
        if !plan.is_triangles() {
            // A face with more than three corners gains one corner for each of its split sides.
            plan.degrees.max = plan.degrees.max.saturating_mul(2);
        }
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let edges = self.edges.resolve(mesh, cx)?;
        edit_each(mesh, &edges, self.on_refusal, "split", cx, |mesh, e| {
            // If `at` is tiny, 1 - at rounds to 1, which is not inside the edge.
            let t = self.edges.place_on(mesh, e, self.at.get());
            let t = t.min(1.0_f64.next_down());
            mesh.split_edge(e, t).map(drop)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, VertexId};

    use op::test::{applied, planned, try_applied};
    use proptest::prelude::*;

    fn parse(text: &str) -> SplitEdges {
        op::test::read(text).unwrap()
    }

    #[test]
    fn the_position_is_measured_from_the_first_named_vertex() {
        // The vertices of the square are (0,0), (1,0), (1,1), (0,1).
        let x = |text| {
            let mesh = applied(&parse(text), shapes::square());
            mesh.position(VertexId::new(4)).x
        };
        assert_eq!(x("(edges: Between(0, 1), at: 0.25)"), 0.25);
        assert_eq!(x("(edges: Between(1, 0), at: 0.25)"), 0.75);
        assert_eq!(x("(edges: Between(2, 3), at: 0.25)"), 0.75);
        assert_eq!(x("(edges: Between(3, 2), at: 0.25)"), 0.25);
    }

    #[test]
    fn otherwise_the_position_is_measured_from_the_lower_number() {
        let mesh = applied(&parse("(edges: All, at: 0.25)"), shapes::icosahedron());
        let before = shapes::icosahedron();
        // New vertices are in the order of the edges, and each new vertex is closer to the end with the lower id.
        for (e, m) in before.edges().zip(12..) {
            let [a, b] = before.edge_vertices(e);
            let (low, high) = (a.min(b), a.max(b));
            let expected = 0.75 * before.position(low) + 0.25 * before.position(high);
            assert!(mesh.position(VertexId::new(m)).distance(expected) < 1e-15);
        }
    }

    #[test]
    fn a_tiny_position_works_from_both_ends() {
        for text in [
            "(edges: Between(0, 1), at: 1e-300)",
            "(edges: Between(1, 0), at: 1e-300)",
        ] {
            assert_eq!(applied(&parse(text), shapes::square()).n_vertices(), 5);
        }
    }

    #[test]
    fn each_split_of_a_closed_triangle_mesh_adds_one_vertex_three_edges_and_two_faces() {
        let (mesh, report) = try_applied(&parse("(edges: All)"), shapes::icosahedron()).unwrap();
        assert_eq!(
            (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
            (42, 120, 80)
        );
        assert_eq!(report.changed, 30);
        assert!(mesh.faces().all(|f| mesh.is_triangle(f)));
    }

    #[test]
    fn the_plan_of_triangles_has_the_exact_number_of_vertices() {
        let (plan, problems) = planned(&parse("(edges: All)"), &shapes::tetrahedron());
        assert_eq!(problems, []);
        assert_eq!(plan.vertices, Range::exactly(10));
        assert_eq!(plan.edges, Range { min: 18, max: 24 });
        assert!(plan.is_triangles());
    }

    #[test]
    fn only_the_edges_are_required() {
        let split = parse("(edges: Longest(count: 2))");
        assert_eq!((split.at, split.on_refusal), (half(), OnRefusal::Error));
        assert!(op::test::read::<SplitEdges>("(at: 0.5)").is_err());
    }

    proptest! {
        #[test]
        fn topology_and_plan_hold_for_any_selection(
            count in 0..40_u32, seed in 0..1000_u64, at in 0.01..0.99_f64, which in 0..5_usize,
        ) {
            let before = [
                Mesh::default(),
                shapes::grid(3, 2),
                shapes::cube(),
                shapes::tetrahedron(),
                shapes::cylinder(5, true),
            ][which].clone();
            let edges = EdgeSelection::Random { count, of: Box::default(), seed };
            let at = Fraction::literal(at);
            let split = SplitEdges { edges, at, on_refusal: OnRefusal::Error };
            let after = applied(&split, before.clone());
            let (plan, _) = planned(&split, &before);
            prop_assert!(plan.vertices.contains(after.n_vertices() as u64));
            prop_assert!(plan.edges.contains(after.n_edges() as u64));
            prop_assert!(plan.faces.contains(after.n_faces() as u64));
            prop_assert!(after.faces().all(|f| plan.degrees.contains(after.degree(f) as u64)));
            prop_assert_eq!(after.euler_characteristic(), before.euler_characteristic());
            prop_assert!((geometry::area(&after) - geometry::area(&before)).abs() < 1e-12 * geometry::area(&before).max(1.0));
            let is_kept = |p: DVec3| after.positions().contains(&p);
            prop_assert!(before.positions().iter().all(|&p| is_kept(p)));
        }
    }
}
