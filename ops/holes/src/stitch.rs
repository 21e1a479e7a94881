//! Stitch: joins boundary edges that coincide.
//!
//! ```text
//!    +-----+ +-----+          +-----+-----+
//!    |     a b     |          |     |     |       a and b merge at the position of the one
//!    |     | |     |    -->   |     |     |       with the lower id; so do c and d;
//!    |     c d     |          |     |     |       the two edges become one
//!    +-----+ +-----+          +-----+-----+
//! ```

mod pairs;

use mesh::HalfEdgeId;
use op::Refusal;
use op::prelude::*;

use pairs::Pairs;

/// Joins boundary edges that coincide.
///
/// Two boundary edges coincide if each end of one edge is at most `distance` from the corresponding end of the other
/// edge. Two edges that coincide only with each other form a pair and are joined. An edge that coincides with several
/// edges cannot be joined (reason: `NonManifold`). To avoid this, choose a `distance` that is less than the lengths of
/// the edges. `Weld` merges all vertices that are close together, but `Stitch` merges only the ends of edges that it
/// joins.
///
/// When two vertices become one, the vertex with the lower id is kept, with its position and values. When two edges
/// become one, the edge with the lower id is kept, with its values. The other vertex or edge is removed, so all
/// vertices or edges with higher ids get new ids. Faces and corners do not change, so an edge whose sides have
/// different UVs becomes a seam. If a hole with only two edges remains beside a joined edge, the two edges of this hole
/// are also joined.
///
/// A pair of edges cannot be joined if both edges belong to the same face (reason: `SameFace`), or if two other edges
/// would then join the same two vertices (reason: `DuplicateEdge`). A pair also cannot be joined if both ends of
/// another edge would become one vertex (reason: `WrongPlace`), or if a face would contain a vertex twice (reason:
/// `RepeatedVertex`).
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Stitch {
    /// The largest distance between corresponding ends of two edges, in scene units. With 0, only ends at equal
    /// positions are joined.
    pub distance: Length,
    /// What to do when a pair of coinciding edges cannot be joined, or when an edge coincides with several edges.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for Stitch {
    const NAME: &'static str = "Stitch";
    const SUMMARY: &'static str = "Join boundary edges that coincide";
    const EXAMPLE: &'static str = "Stitch(distance: 0)";
    const WORDS: &'static [&'static str] = &["sew", "zip", "close"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.vertices.min = plan.vertices.min.min(1);
        // An edge is joined to at most one other edge, so at least half of the edges remain.
        plan.edges.min = plan.edges.min.div_ceil(2);
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let Pairs { pairs, ambiguous } = Pairs::of(mesh, self.distance.get(), cx)?;
        let mut report = Report::default();
        for h in ambiguous {
            let [v, w] = [mesh.origin(h), mesh.target(h)].map(mesh::VertexId::index);
            let message = format!(
                "the edge Between({v}, {w}) coincides with several other boundary edges; a smaller `distance` can help"
            );
            let refused = OpError::refused(Refusal::NonManifold, message).about([h.edge()]);
            self.on_refusal.refuse(refused, &mut report)?;
        }
        if pairs.is_empty() {
            return Ok(report.note("there are no pairs of coinciding boundary edges to join"));
        }
        let edit = |mesh: &mut Mesh, [h, g]: [HalfEdgeId; 2]| {
            // Some pairs are already joined here, because joining the neighboring edges of a pair can also join the
            // pair.
            if is_closed(mesh, h) && is_closed(mesh, g) {
                return Ok(());
            }
            mesh.stitch_edges(h, g).map(drop)
        };
        report.merge(edit_each(
            mesh,
            &pairs,
            self.on_refusal,
            "stitch",
            cx,
            edit,
        )?);
        Ok(report)
    }
}

/// Whether the edge of `h` has already been joined to another edge. Before the step, `h` was a boundary half-edge.
fn is_closed(mesh: &Mesh, h: HalfEdgeId) -> bool {
    !mesh.has_edge(h.edge()) || mesh.face(h).is_some()
}

#[cfg(test)]
mod tests;
