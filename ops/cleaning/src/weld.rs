//! Weld: merges vertices that are close together, so that the faces at these vertices become connected.
//!
//! ```text
//!    +-----+ +-----+            +-----+-----+
//!    |     a b     |            |     |     |       a and b merge at the position of the one
//!    |     | |     |    -->     |     |     |       with the lower id; so do c and d;
//!    |     c d     |            |     |     |       the two edges become one
//!    +-----+ +-----+            +-----+-----+
//! ```
//!
//! Vertices at most `distance` apart are linked, and vertices that are connected by links merge into one. For example,
//! two vertices that are 0.9 times `distance` apart always merge. Two vertices that are 1.1 times `distance` apart
//! merge only if a chain of other vertices links them. The choice of the vertices to merge does not depend on the order
//! of the vertices or on the number of threads.

use mesh::{VERTEX_NORMAL, counted};
use op::prelude::*;

/// Merges vertices that are close together, so that the faces at these vertices become connected.
///
/// Two vertices are linked if they are at most `distance` apart. Vertices that are connected by a chain of links merge
/// into one, even if the ends of the chain are farther apart than `distance`. Of the vertices that merge, the vertex
/// with the lowest id remains, with its position and values. The other vertices are removed, so vertices with higher
/// ids get new ids. If several edges then join the same two vertices, they become one edge. The merged edge gets the
/// values of the edge with the lowest id. Corner values, such as UVs, stay with the corners of the faces, so UV seams
/// are kept.
///
/// If neighboring corners of a face merge, the face loses a corner. A face is removed if it has fewer than three
/// corners left or would contain a vertex twice. After the merge, neighboring faces can have opposite orientations. If
/// possible, the step then reverses faces, so that all faces of a connected part have the same orientation: the more
/// frequent one. The report counts the reversed faces. If faces are reversed, the normals of vertices and corners are
/// dropped. If the result is still not a manifold, vertices and edges are copied. For example, if three faces share an
/// edge, one of these faces gets a copy of the edge. The report counts the copies. If no vertices merge, the mesh does
/// not change.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Weld {
    /// The largest distance between linked vertices, in scene units. With 0, only vertices at equal positions merge.
    pub distance: Length,
}

impl MeshOperation for Weld {
    const NAME: &'static str = "Weld";
    const SUMMARY: &'static str = "Merge vertices that are close together";
    const EXAMPLE: &'static str = "Weld(distance: 0)";
    const WORDS: &'static [&'static str] = &["merge", "doubles", "deduplicate"];
    const DONE: &'static str = "merged";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // If the step reverses faces, it drops the normals. The plan therefore cannot tell whether the mesh has normals
        // after the step.
        for attribute in &mut plan.attributes {
            attribute.certain &= attribute.name != VERTEX_NORMAL.name;
        }
        plan.vertices.min = plan.vertices.min.min(1);
        plan.edges = plan.edges.or_less();
        plan.faces = plan.faces.or_less();
        // Faces can lose corners, but each remaining face has at least three corners.
        plan.degrees = plan.degrees.or(Range::exactly(3));
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let merged = geometry::merge_vertices(mesh, self.distance.get(), cx.progress())?;
        if merged.vertices == 0 {
            return Ok(Report::default());
        }
        let n = merged.vertices;
        let mut report = Report::changed(n).note(format!("merged {}", counted(n, "vertex")));
        report = report.count("faces that lost corners", merged.smaller_faces);
        if !merged.report.is_clean() {
            report = report.note(merged.report.summary());
        }
        Ok(report)
    }
}

#[cfg(test)]
mod tests;
