//! Stitch: glues boundary edges that lie on each other.
//!
//! ```text
//!    +-----+ +-----+          +-----+-----+
//!    |     a b     |          |     |     |       a, b become the one of the lower number,
//!    |     | |     |    -->   |     |     |       where that is; the two edges become one
//!    |     c d     |          |     |     |
//!    +-----+ +-----+          +-----+-----+
//! ```

mod pairs;

use mesh::HalfEdgeId;
use op::Refusal;
use op::prelude::*;

use pairs::Pairs;

/// Glues boundary edges that lie on each other.
///
/// Two boundary edges are a pair if both ends of the one are at most `distance` from those of the other,
/// and no third edge is as near to either: choose a distance below the length of the edges. Where there are
/// more, none of them is glued, and they are refused (`NonManifold`). Unlike Weld this never merges vertices
/// inside the surface, nor ones whose edges do not meet.
///
/// Of the vertices and of the edges of a pair those of the lower number stay where they are and keep their
/// values; the others go, and numbers close up. Faces and corners stay: UVs that differ become a seam.
/// Holes of two edges that are left over are closed as well.
///
/// Refused is what would not be a clean mesh: the two sides of one face (`SameFace`), an edge whose ends would
/// become one vertex or a face that would visit a vertex twice (`WrongPlace`), and two edges between the
/// same vertices (`DuplicateEdge`).
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Stitch {
    /// How far apart the ends of the edges of a pair may be, in scene units; 0 for equal positions only.
    pub distance: Length,
    /// What to do when a pair is refused, or an edge has several partners.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for Stitch {
    const NAME: &'static str = "Stitch";
    const SUMMARY: &'static str = "Glue boundary edges that lie on each other";
    const EXAMPLE: &'static str = "Stitch(distance: 0)";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.vertices.min = plan.vertices.min.min(1);
        // An edge is glued to one other at most.
        plan.edges.min = plan.edges.min.div_ceil(2);
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let Pairs { pairs, crowded } = Pairs::of(mesh, self.distance.get(), cx)?;
        let mut report = Report::default();
        for h in crowded {
            let [v, w] = [mesh.origin(h), mesh.target(h)].map(mesh::VertexId::index);
            let message = format!("several boundary edges lie on Between({v}, {w})");
            let refused = OpError::refused(Refusal::NonManifold, message).about([h.edge()]);
            self.on_refusal.refuse(refused, &mut report)?;
        }
        if pairs.is_empty() {
            return Ok(report.note("no two boundary edges lie on each other alone"));
        }
        let edit = |mesh: &mut Mesh, [h, g]: [HalfEdgeId; 2]| {
            // Two edges that are left between others that were glued are closed together with these.
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

/// Whether the edge of `h`, which was on the boundary, is glued by now.
fn is_closed(mesh: &Mesh, h: HalfEdgeId) -> bool {
    !mesh.has_edge(h.edge()) || mesh.face(h).is_some()
}

#[cfg(test)]
mod tests;
