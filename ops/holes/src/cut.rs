//! Cut: opens the mesh along edges.
//!
//! ```text
//!    +-----+-----+          +-----+ +-----+
//!    |     |     |          |     | |     |
//!    +-----+-----+    -->   +-----+ +-----+       drawn apart for clarity: the sides of the cut
//!    |     |     |          |     | |     |       stay at the same position
//!    +-----+-----+          +-----+ +-----+
//! ```

use mesh::{EdgeId, EditError};
use op::prelude::*;

/// Opens the mesh along edges.
///
/// The edges can form paths, loops and trees. A closed loop can separate a region of faces from the rest of the mesh.
/// Each cut edge becomes two boundary edges, one for each side of the cut. Cuts can divide the faces around a vertex
/// into several groups. The group that contains the face with the lowest id then keeps the old vertex, and each other
/// group gets a copy of the vertex. The copies get the highest ids. Faces keep their ids, and no vertex moves. Copies
/// of vertices and edges have the values of the originals. Corners keep their values. `Stitch` is the inverse
/// operation: it joins the two sides of a cut.
///
/// An edge on the boundary cannot be cut (reason: `Boundary`). An edge also cannot be cut if it touches neither the
/// boundary nor another edge to cut (reason: `DuplicateEdge`). Both sides of the cut would still join the same two
/// vertices, so the mesh would not open. However, a path of several edges inside the mesh can be cut, because all edges
/// are cut at once.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Cut {
    /// The edges to cut.
    pub edges: EdgeSelection,
    /// What to do when an edge cannot be cut.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for Cut {
    const NAME: &'static str = "Cut";
    const SUMMARY: &'static str = "Open the mesh along edges";
    const EXAMPLE: &'static str = "Cut(edges: All)";
    const WORDS: &'static [&'static str] = &["rip", "open"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let n = self.edges.count(plan);
        let cut = self.on_refusal.done(n);
        // A vertex gets at most one copy for each cut edge that ends at the vertex.
        plan.grow(n.by(2).or_less(), cut, Range::exactly(0));
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let edges = self.edges.resolve(mesh, cx)?;
        cx.advance("cut", 0, edges.len() as u64)?;
        let mut report = Report::default();
        let edges = self.allowed(mesh, &edges, &mut report)?;
        if edges.is_empty() {
            return Ok(report.note("no edge was cut"));
        }
        let before = mesh.n_vertices();
        report.changed = mesh.cut_edges(&edges)?.len() as u64;
        let copies = mesh.n_vertices() - before;
        Ok(report.note(format!("new vertices: {copies}")))
    }
}

impl Cut {
    /// Returns the edges in `edges` that can be cut together. If an edge cannot be cut, the function returns an error.
    /// With `on_refusal: Skip`, it leaves out the edge and counts it in the report instead.
    fn allowed(
        &self,
        mesh: &Mesh,
        edges: &[EdgeId],
        report: &mut Report,
    ) -> Result<Vec<EdgeId>, OpError> {
        let slits = mesh.slits(edges);
        let mut allowed = Vec::with_capacity(edges.len());
        for &e in edges {
            let [v, w] = mesh.edge_vertices(e);
            let (refusal, message) = if mesh.is_boundary_edge(e) {
                (EditError::Boundary(e), "is on the boundary")
            } else if slits.binary_search(&e).is_ok() {
                let why = "cannot be cut open, because both ends are inside the mesh and no other cut continues at \
                           either end";
                (EditError::DuplicateEdge(v, w), why)
            } else {
                allowed.push(e);
                continue;
            };
            let (v, w) = (v.min(w).index(), v.max(w).index());
            let message = format!("Between({v}, {w}) {message}");
            let refused = OpError::refused(refusal.into(), message).about([e]);
            self.on_refusal.refuse(refused, report)?;
        }
        Ok(allowed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::Refusal;
    use op::test::{applied, try_applied};

    fn parse(text: &str) -> Cut {
        op::test::read(text).unwrap()
    }

    fn refusal(text: &str, mesh: Mesh) -> Refusal {
        match try_applied(&parse(text), mesh) {
            Err(OpError::Refused { reason, .. }) => reason,
            other => panic!("expected a refusal, got {other:?}"),
        }
    }

    #[test]
    fn a_path_across_a_sheet_separates_it() {
        // The vertex ids of the sheet, seen from above:
        //
        // 6 7 8
        // 3 4 5
        // 0 1 2
        let path = parse("(edges: Or([Between(1, 4), Between(4, 7)]))");
        let (mesh, report) = try_applied(&path, shapes::grid(2, 2)).unwrap();
        assert_eq!((geometry::n_components(&mesh), mesh.n_vertices()), (2, 12));
        assert_eq!((mesh.n_edges(), mesh.n_faces()), (14, 4));
        assert_eq!(report.changed, 2);
        assert_eq!(report.notes, ["new vertices: 3"]);
    }

    #[test]
    fn cutting_sharp_edges_separates_the_faces_of_a_cube() {
        let mesh = applied(&parse("(edges: Sharp(above: 30))"), shapes::cube());
        assert_eq!((geometry::n_components(&mesh), mesh.n_vertices()), (6, 24));
        assert_eq!(geometry::area(&mesh), 24.0);
    }

    #[test]
    fn edges_that_cannot_be_cut_fail_or_are_counted() {
        let grid = || shapes::grid(3, 3);
        assert_eq!(refusal("(edges: All)", grid()), Refusal::Boundary);
        assert_eq!(
            refusal("(edges: Between(5, 6))", grid()),
            Refusal::DuplicateEdge
        );
        let skip = parse("(edges: All, on_refusal: Skip)");
        let (mesh, report) = try_applied(&skip, grid()).unwrap();
        assert_eq!(geometry::n_components(&mesh), 9);
        let counts: Vec<_> = report.refused.iter().map(|r| (r.reason, r.count)).collect();
        assert_eq!(counts, [(Refusal::Boundary, 12)]);
        let skip = parse("(edges: Between(5, 6), on_refusal: Skip)");
        let (mesh, report) = try_applied(&skip, grid()).unwrap();
        assert_eq!(mesh, grid());
        assert_eq!(report.refused[0].reason, Refusal::DuplicateEdge);
        assert!(report.refused[0].first.starts_with("Between(5, 6)"));
    }

    #[test]
    fn the_edges_are_required() {
        assert!(op::test::read::<Cut>("()").is_err());
        assert!(op::test::read::<Cut>("(edges: All, at: 0.5)").is_err());
        assert_eq!(parse("(edges: All)").on_refusal, OnRefusal::Error);
    }
}
