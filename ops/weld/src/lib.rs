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

mod cluster;
mod union_find;

use mesh::{Built, EdgeId, FaceId, HalfEdgeId, Mesh, NonManifold, Sources, VertexId};
use op::{Context, MeshOperation, MeshPlan, OpError, PlanContext, Problem, Range, Report};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use cluster::clusters;

/// Merges vertices that lie near each other, and joins the faces at them.
///
/// Vertices at most `distance` apart are linked, and all that links connect become one, even if the ends
/// of such a chain are farther apart. The merged vertex has the position and the values of the lowest
/// number among them; the others go, and numbers close up. Edges between the same two vertices become
/// one, with the values of the first. Corner values stay with their corners: seams of UVs are kept.
///
/// A face loses corners that merge with the next one around it, and goes if fewer than three are left or
/// if it would visit a vertex twice. Where the result would not be a manifold it is split and counted:
/// of three faces at one edge the third gets its own. If no vertices merge, nothing changes at all.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Weld {
    /// How far apart linked vertices may be, in scene units; 0 links equal positions only.
    #[schemars(range(min = 0.0))]
    pub distance: f64,
}

impl Weld {
    fn check(&self) -> Result<(), String> {
        if self.distance >= 0.0 && self.distance.is_finite() {
            Ok(())
        } else {
            let distance = self.distance;
            Err(format!(
                "`distance` must be 0 or a positive number, not {distance}"
            ))
        }
    }
}

impl MeshOperation for Weld {
    const NAME: &'static str = "Weld";
    const SUMMARY: &'static str = "Merge vertices that lie near each other";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        if let Err(message) = self.check() {
            return vec![Problem::error(message).at(["distance"])];
        }
        plan.vertices.min = plan.vertices.min.min(1);
        plan.edges = plan.edges.or_less();
        plan.faces = plan.faces.or_less();
        // Faces may lose corners, but not below three.
        plan.degrees.min = plan.degrees.min.min(3);
        plan.degrees = Range {
            max: plan.degrees.max.max(3),
            ..plan.degrees
        };
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.check().map_err(OpError::Parameter)?;
        let lowest = clusters(mesh.positions(), self.distance, &|done, total| {
            cx.advance("weld", done, total)
        })?;
        let merged = (0..).zip(&lowest).filter(|&(v, &low)| v != low).count();
        if merged == 0 {
            return Ok(Report::default());
        }
        let polygons = Polygons::of(mesh, &lowest);
        let built = mesh::build(
            polygons.positions.clone(),
            &polygons.offsets,
            &polygons.corners,
            NonManifold::Split,
        )?;
        let mut report = Report::changed(merged).note(format!("merged {merged} vertices"));
        if polygons.reduced > 0 {
            let n = polygons.reduced;
            report = report.note(format!("faces that lost corners: {n}"));
        }
        if !built.report.is_clean() {
            report = report.note(built.report.summary());
        }
        mesh.replace(polygons.with_attributes(mesh, built));
        Ok(report)
    }
}

/// The faces of a mesh over the vertices that are left.
struct Polygons {
    /// The vertices that are left, by their old numbers.
    kept: Vec<VertexId>,
    positions: Vec<mesh::DVec3>,
    offsets: Vec<u32>,
    corners: Vec<u32>,
    /// For each corner the half-edge that it was.
    half_edges: Vec<HalfEdgeId>,
    /// How many faces have fewer corners than before, but enough.
    reduced: usize,
}

impl Polygons {
    /// `lowest` has for each vertex the lowest number of those that it merges with.
    fn of(mesh: &Mesh, lowest: &[u32]) -> Self {
        let mut kept = Vec::new();
        let mut number = vec![0; lowest.len()];
        for (v, (&low, i)) in lowest.iter().zip(0_u32..).enumerate() {
            // The lowest one comes before all others of its cluster.
            if low == i {
                number[v] = to_u32(kept.len());
                kept.push(VertexId::new(v));
            } else {
                number[v] = number[low as usize];
            }
        }
        let positions = kept.iter().map(|&v| mesh.position(v)).collect();
        let mut offsets = vec![0];
        let (mut corners, mut half_edges) = (Vec::new(), Vec::new());
        let mut reduced = 0;
        for f in mesh.faces() {
            let first = corners.len();
            let mut is_smaller = false;
            for h in mesh.face_half_edges(f) {
                let [v, w] = [mesh.origin(h), mesh.target(h)].map(|v| number[v.index()]);
                // A side that shrinks to a point goes, and the corner at its origin with it.
                if v == w {
                    is_smaller = true;
                } else {
                    corners.push(v);
                    half_edges.push(h);
                }
            }
            reduced += usize::from(is_smaller && corners.len() - first >= 3);
            // No more corners than before, and those had ids.
            offsets.push(to_u32(corners.len()));
        }
        Self {
            kept,
            positions,
            offsets,
            corners,
            half_edges,
            reduced,
        }
    }

    /// The built mesh with the attributes of the old one.
    fn with_attributes(self, old: &Mesh, built: Built) -> Mesh {
        let mut mesh = built.mesh;
        let mut vertices = self.kept;
        // Copies stand behind all others, in this order.
        for (original, _) in &built.report.split_vertices {
            vertices.push(vertices[original.index()]);
        }
        let mut corners = vec![HalfEdgeId::NONE; mesh.n_half_edges()];
        let mut edges = vec![EdgeId::NONE; mesh.n_edges()];
        for (&old_h, &h) in self.half_edges.iter().zip(&built.half_edge_of_corner) {
            if h != HalfEdgeId::NONE {
                corners[h.index()] = old_h;
                // `NONE` is above all ids.
                let edge = &mut edges[h.edge().index()];
                *edge = old_h.edge().min(*edge);
            }
        }
        let faces: Vec<FaceId> = old
            .faces()
            .zip(&built.face_of_polygon)
            .filter(|&(_, &f)| f != FaceId::NONE)
            .map(|(old_f, _)| old_f)
            .collect();
        let mut attributes = old.attributes().gathered(Sources {
            vertices: &vertices,
            corners: &corners,
            edges: &edges,
            faces: &faces,
        });
        attributes.drop_by_rule();
        mesh.set_attributes(attributes);
        mesh
    }
}

fn to_u32(n: usize) -> u32 {
    u32::try_from(n).expect("ids of a mesh fit 32 bits")
}

#[cfg(test)]
mod tests;
