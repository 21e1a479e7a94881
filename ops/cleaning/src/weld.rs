//! Weld: merges vertices that lie near each other, and joins the faces at them.
//!
//! ```text
//!    +-----+ +-----+            +-----+-----+
//!    |     a b     |            |     |     |       a, b become the one of the lower number,
//!    |     | |     |    -->     |     |     |       where that is; the two edges become one
//!    |     c d     |            |     |     |
//!    +-----+ +-----+            +-----+-----+
//! ```
//!
//! Vertices at most `distance` apart are linked, and all vertices that links connect become one. So two
//! at 0.9 times the distance always merge, wherever they lie, and two at 1.1 times only through others
//! between them. Neither depends on the order of vertices or on the number of threads.

use mesh::VERTEX_NORMAL;
use op::prelude::*;

/// Merges vertices that lie near each other, and joins the faces at them.
///
/// Vertices at most `distance` apart are linked, and all that links connect become one, even if the ends
/// of such a chain are farther apart. The merged vertex has the position and the values of the lowest
/// number among them; the others go, and numbers close up. Edges between the same two vertices become
/// one, with the values of the first. Corner values stay with their corners: seams of UVs are kept.
///
/// A face loses corners that merge with the next one around it, and goes if fewer than three are left or
/// if it would visit a vertex twice. Where faces that hang together then run different ways round, the
/// smaller number of them is reversed if that makes all agree; they are counted, and normals of vertices
/// and corners are dropped. Where the result would still not be a manifold it is split and counted: of
/// three faces at one edge the third gets its own. If no vertices merge, nothing changes at all.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Weld {
    /// How far apart linked vertices may be, in scene units; 0 links equal positions only.
    pub distance: Length,
}

impl MeshOperation for Weld {
    const NAME: &'static str = "Weld";
    const SUMMARY: &'static str = "Merge vertices that lie near each other";
    const EXAMPLE: &'static str = "Weld(distance: 0)";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // Where faces are reversed, normals go.
        for attribute in &mut plan.attributes {
            attribute.certain &= attribute.name != VERTEX_NORMAL.name;
        }
        plan.vertices.min = plan.vertices.min.min(1);
        plan.edges = plan.edges.or_less();
        plan.faces = plan.faces.or_less();
        // Faces may lose corners, but not below three.
        plan.degrees = plan.degrees.or(Range::exactly(3));
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let merged = geometry::merge_vertices(mesh, self.distance.get(), cx.progress())?;
        if merged.vertices == 0 {
            return Ok(Report::default());
        }
        let n = merged.vertices;
        let vertices = if n == 1 { "vertex" } else { "vertices" };
        let mut report = Report::changed(n).note(format!("merged {n} {vertices}"));
        report = report.count("faces that lost corners", merged.smaller_faces);
        if !merged.report.is_clean() {
            report = report.note(merged.report.summary());
        }
        Ok(report)
    }
}

#[cfg(test)]
mod tests;
