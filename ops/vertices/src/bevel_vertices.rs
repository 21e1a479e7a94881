//! Bevel vertices: replaces vertices with faces.
//!
//! ```text
//!      \     /              \     /
//!       \   /                +---+
//!         v        -->        \ /           the edges at v are cut at (1 - t) v + t w,
//!         |                    +            where w is the other end and t the fraction
//!         |                    |
//! ```

use geometry::bevel::Cuts;
use op::prelude::*;

/// Replaces vertices with faces.
///
/// Each edge at a selected vertex is cut near this vertex. A new face with a corner at each cut replaces the vertex.
/// For example, if all vertices of a cube are beveled with `fraction: 0.25`, the result is a truncated cube. The
/// distance of a cut from the vertex is `fraction` times the length that the edge had before the step. If both ends of
/// an edge are selected, `fraction` must be below 0.5.
///
/// The selected vertices are removed, so the ids of the vertices after them change. New vertices get the highest ids,
/// in order of the selected vertices and clockwise around each vertex. Old faces keep their ids. New faces get the
/// highest ids, in order of the selected vertices.
///
/// Attribute values at a cut are interpolated between the two ends of the cut edge, so textures do not move on the
/// surface. A new face has the values (material, tags) of one of the faces at the vertex. It is not specified which of
/// these faces is chosen, but the choice is the same in every run. New edges have zero values (no crease, no tags).
/// Normals are dropped.
///
/// A vertex cannot be beveled if it is on the boundary or has fewer than three edges. It also cannot be beveled if an
/// earlier cut has left one of its edges too short for a second cut.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BevelVertices {
    /// The vertices to bevel.
    pub vertices: VertexSelection,
    /// The distance of each cut from the vertex, as a fraction of the length of the cut edge. More than 0 and less
    /// than 1.
    pub fraction: Fraction,
    /// What to do when a vertex cannot be beveled.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for BevelVertices {
    const NAME: &'static str = "BevelVertices";
    const SUMMARY: &'static str = "Replace vertices with faces";
    const EXAMPLE: &'static str = "BevelVertices(vertices: All, fraction: 0.25)";
    const WORDS: &'static [&'static str] = &["chamfer"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let done = self.on_refusal.done(self.vertices.count(plan));
        if done.max > 0 {
            // An edge can be cut near one end, near both ends or not at all. A beveled vertex has at least three edges.
            let cuts = Range::between(done.by(3).min, plan.edges.by(2).max);
            // The number of corners of a new face is the number of edges of its old vertex. An old face gains at most
            // one corner for each of its corners.
            let gained = plan.degrees.by(2).max;
            plan.degrees = Range::between(3, gained.max(plan.edges.max));
            let new = Range::between(done.by(2).min, cuts.max.saturating_sub(done.min));
            plan.grow(new, cuts, done);
        }
        plan.drop_normals();
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let vertices = self.vertices.resolve(mesh, cx)?;
        let mut cuts = Cuts::default();
        let report = edit_each(mesh, &vertices, self.on_refusal, "bevel", cx, |mesh, v| {
            let f = mesh.bevel_vertex_with(v, |e| cuts.fraction(e, self.fraction.get()))?;
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

    fn parse(text: &str) -> BevelVertices {
        op::test::read(text).unwrap()
    }

    #[test]
    fn a_cube_becomes_a_truncated_cube() {
        let step = parse("(vertices: All, fraction: 0.25)");
        let (plan, problems) = planned(&step, &shapes::cube());
        assert_eq!(problems, []);
        assert_eq!(plan.faces, Range::exactly(14));
        let (mesh, report) = try_applied(&step, shapes::cube()).unwrap();
        assert_eq!(report.changed, 8);
        let counts = [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()];
        assert_eq!(counts, [24, 36, 14]);
        assert!(plan.vertices.contains(24) && plan.edges.contains(36));
        // The absolute values of the coordinates of every vertex are 1, 1 and 1/2, in any order.
        for &p in mesh.positions() {
            let mut p = p.abs().to_array();
            p.sort_by(f64::total_cmp);
            assert!((mesh::DVec3::from(p) - mesh::DVec3::new(0.5, 1.0, 1.0)).length() < 1e-15);
        }
        assert!((geometry::volume(&mesh) - 8.0 + 8.0 / 48.0).abs() < 1e-13);
        assert!((6..14).all(|f| mesh.is_triangle(FaceId::new(f))));
    }

    #[test]
    fn a_truncated_icosahedron_has_twelve_pentagons_and_twenty_hexagons() {
        let step = parse("(vertices: All, fraction: 0.3333333333333333)");
        let mesh = applied(&step, shapes::icosahedron());
        let n = |degree| mesh.faces().filter(|&f| mesh.degree(f) == degree).count();
        assert_eq!((n(5), n(6), mesh.n_faces()), (12, 20, 32));
        let lengths = || mesh.edges().map(|e| mesh.length(e.half_edges()[0]));
        let first = lengths().next().unwrap();
        assert!(lengths().all(|l| (l - first).abs() < 1e-14));
    }

    #[test]
    fn a_half_does_not_fit_on_both_ends_of_an_edge() {
        let refused = try_applied(&parse("(vertices: All, fraction: 0.5)"), shapes::cube());
        assert!(
            matches!(refused, Err(OpError::Refused { .. })),
            "{refused:?}"
        );
        // Four corners of the cube that share no edge can be beveled. After these corners are beveled, no other corner
        // has enough space.
        let step = parse("(vertices: All, fraction: 0.5, on_refusal: Skip)");
        let (mesh, report) = try_applied(&step, shapes::cube()).unwrap();
        assert_eq!(report.changed, 4);
        assert_eq!(report.refused[0].count, 4);
        assert_eq!(mesh.n_faces(), 10);
    }

    #[test]
    fn boundary_vertices_are_refused() {
        let step = parse("(vertices: All, fraction: 0.25, on_refusal: Skip)");
        let (mesh, report) = try_applied(&step, shapes::grid(3, 3)).unwrap();
        assert_eq!((report.changed, report.refused[0].count), (4, 12));
        assert!((geometry::area(&mesh) - geometry::area(&shapes::grid(3, 3))).abs() < 1e-14);
        let step = parse("(vertices: All, fraction: 0.25)");
        let refused = try_applied(&step, shapes::grid(3, 3));
        let Err(OpError::Refused { reason, .. }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(reason, op::Refusal::Boundary);
    }
}
