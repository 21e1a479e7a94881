//! Dissolve vertices: removes vertices and merges the faces around them.
//!
//! ```text
//!    +-----+-----+          +-----+-----+          +-----------+          +-----------+
//!    |     |     |          |           |          |           |          |           |
//!    +-----v-----+   -->    +           +          a-----v-----b   -->    a-----------b
//!    |     |     |          |           |          |           |          |           |
//!    +-----+-----+          +-----+-----+          +-----------+          +-----------+
//! ```

use op::prelude::*;

/// Removes vertices and merges the faces around them.
///
/// Vertices are removed in order of their ids. Each removal is checked against the mesh that the earlier removals have
/// produced. If a vertex has three or more edges, all faces around it become one face. The merged face replaces the old
/// face with the lowest id, and has the values of this old face. If the vertex is on the boundary, its two boundary
/// edges also become one edge. If the vertex has only two edges, these edges become one edge, and each face beside this
/// edge loses a corner. When two edges become one, the edge with the lower id is kept, with its values. The remaining
/// elements keep their order and their values but get new ids. Normals are dropped.
///
/// A vertex cannot be removed if it is isolated or has a single edge. It also cannot be removed if a neighboring vertex
/// would be left with a single edge, because this edge would end inside a face. A removal is also refused if a face
/// would contain a vertex twice or have fewer than three corners. A removal is also refused if it would join two
/// vertices that an edge already joins. A vertex on a seam (an edge whose corner values, such as UVs, differ between
/// its two sides) is removed only if `seams` is `Drop`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct DissolveVertices {
    /// The vertices to remove.
    pub vertices: VertexSelection,
    /// What to do when a vertex cannot be removed.
    #[serde(default)]
    pub on_refusal: OnRefusal,
    /// What to do at seams.
    #[serde(default)]
    pub seams: Seams,
}

impl MeshOperation for DissolveVertices {
    const NAME: &'static str = "DissolveVertices";
    const SUMMARY: &'static str = "Remove vertices and merge the faces around them";
    const EXAMPLE: &'static str = "DissolveVertices(vertices: Vertices([1]))";
    const WORDS: &'static [&'static str] = &["remove", "delete"];
    const DONE: &'static str = "dissolved";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        let chosen = self.vertices.count(plan);
        if chosen.max == 0 {
            return Vec::new();
        }
        let n = self.on_refusal.done(chosen);
        plan.vertices = plan.vertices.minus(n);
        // The removal of a vertex also removes at least one edge. If the mesh has faces, at least one face with at
        // least three edges remains.
        plan.edges = Range::between(plan.edges.min.min(3), plan.edges.minus(n).max);
        plan.faces.min = plan.faces.min.min(1);
        plan.degrees = Range::between(3, plan.edges.by(2).max.max(3));
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let vertices = self.vertices.resolve(mesh, cx)?;
        let seams = self.seams.into();
        let word = "dissolve";
        let report = edit_each(mesh, &vertices, self.on_refusal, word, cx, |mesh, v| {
            mesh.dissolve_vertex_with(v, seams).map(drop)
        })?;
        mesh.remove_normals();
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec2, DVec3, UV, VERTEX_NORMAL};
    use op::Refusal;
    use op::test::{applied, is_as_planned, try_applied};
    use proptest::prelude::*;

    fn parse(text: &str) -> DissolveVertices {
        op::test::read(text).unwrap()
    }

    fn refused(text: &str, mesh: Mesh) -> Refusal {
        op::test::refused(&parse(text), mesh)
    }

    #[test]
    fn an_icosahedron_without_two_poles_has_two_pentagons() {
        // In the icosahedron, the vertices 0 and 3 lie opposite each other.
        let poles = parse("(vertices: Vertices([0, 3]))");
        let mesh = applied(&poles, shapes::icosahedron());
        assert_eq!(
            (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
            (10, 20, 12)
        );
        let pentagons = mesh.faces().filter(|&f| mesh.degree(f) == 5).count();
        assert_eq!(pentagons, 2);
        assert!(is_as_planned(&poles, &shapes::icosahedron(), &mesh));
    }

    #[test]
    fn vertices_on_straight_edges_are_removed() {
        let mut mesh = shapes::square();
        for e in 0..4 {
            mesh.split_edge(mesh::EdgeId::new(e), 0.5).unwrap();
        }
        let middles = parse("(vertices: Vertices([4, 5, 6, 7]))");
        let (after, report) = try_applied(&middles, mesh).unwrap();
        assert_eq!(report.changed, 4);
        assert_eq!(after.positions(), shapes::square().positions());
        assert_eq!((after.n_edges(), geometry::area(&after)), (4, 1.0));
    }

    #[test]
    fn vertices_that_cannot_be_removed_are_refused() {
        let isolated = {
            let mut mesh = shapes::square();
            mesh.delete_face(mesh::FaceId::new(0)).unwrap();
            mesh
        };
        assert_eq!(
            refused("(vertices: Vertices([2]))", isolated),
            Refusal::FewEdges
        );
        let tube = shapes::cylinder(3, false);
        assert_eq!(
            refused("(vertices: Vertices([2]))", tube),
            Refusal::DuplicateEdge
        );
        let triangle = applied(&parse("(vertices: Vertices([3]))"), shapes::square());
        assert_eq!(refused("(vertices: All)", triangle), Refusal::FewCorners);
    }

    #[test]
    fn a_vertex_at_a_seam_is_refused_unless_seams_are_dropped() {
        let mut mesh = shapes::grid(2, 2);
        let shift = |h| {
            mesh.face(h)
                .map_or(0.0, |f| if f.index() == 0 { 1.0 } else { 0.0 })
        };
        let uvs = mesh.half_edges().map(|h| DVec2::splat(shift(h))).collect();
        mesh.set(UV, uvs);
        assert_eq!(
            refused("(vertices: Vertices([4]))", mesh.clone()),
            Refusal::Seam
        );
        let merged = applied(&parse("(vertices: Vertices([4]), seams: Drop)"), mesh);
        assert_eq!(merged.n_faces(), 1);
    }

    #[test]
    fn normals_are_dropped() {
        let mut mesh = shapes::grid(2, 2);
        mesh.set(VERTEX_NORMAL, vec![DVec3::Z; 9]);
        let (after, report) = try_applied(&parse("(vertices: Vertices([4]))"), mesh).unwrap();
        assert!(after.get(VERTEX_NORMAL).is_none());
        assert_eq!(report.losses.len(), 1);
    }

    #[test]
    fn skipped_refusals_are_counted() {
        let skip = parse("(vertices: All, on_refusal: Skip)");
        let (mesh, report) = try_applied(&skip, shapes::square()).unwrap();
        assert_eq!(
            (mesh.n_vertices(), report.changed, report.refused[0].count),
            (3, 1, 3)
        );
    }

    proptest! {
        #[test]
        fn topology_and_plan_hold_for_any_selection(
            count in 0..20_u32, seed in 0..1000_u64, which in 0..5_usize,
        ) {
            let before = [
                Mesh::default(),
                shapes::grid(4, 3),
                shapes::cube(),
                shapes::icosahedron(),
                shapes::torus(4, 3, 2.0, 1.0),
            ][which].clone();
            let vertices = VertexSelection::Random { count, of: Box::default(), seed };
            let dissolve =
                DissolveVertices { vertices, on_refusal: OnRefusal::Skip, seams: Seams::Refuse };
            let (after, report) = try_applied(&dissolve, before.clone()).unwrap();
            prop_assert!(is_as_planned(&dissolve, &before, &after));
            prop_assert_eq!(after.euler_characteristic(), before.euler_characteristic());
            prop_assert_eq!(after.n_boundary_loops(), before.n_boundary_loops());
            if report.refused.is_empty() {
                let strict = DissolveVertices { on_refusal: OnRefusal::Error, ..dissolve };
                prop_assert!(is_as_planned(&strict, &before, &after));
            }
        }
    }
}
