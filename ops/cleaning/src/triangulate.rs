//! Triangulate: cuts polygons into triangles.
//!
//! ```text
//!    d ------- c          d ------- c          .---.                  .---.
//!    |         |          |      /  |         /     \                /|\   \
//!    |    f    |   -->    |   /     |        .       .      -->     . | \   .
//!    |         |          | /       |         \     /                \|  \ /
//!    a ------- b          a ------- b          '---'                  '---'
//! ```
//!
//! A face with n corners becomes n - 2 triangles, which stand where it stood; every vertex and every edge
//! keeps its number and the n - 3 diagonals come behind. Which diagonals, is told by [`Triangulate`].
//! The mesh is cut face by face inside its own half-edges, not built again from triangles, so that what
//! was closed stays closed even where two diagonals join the same two vertices.

mod assemble;
mod doubles;

use geometry::triangulate::{Cut, Cutter};
use op::Refusal;
use op::prelude::*;
use rayon::prelude::*;

/// Cuts polygons into triangles.
///
/// A quadrilateral is cut along its shorter diagonal; if both are equally long (squares of lengths
/// within 1e-12 of each other) along the one at its lowest vertex. But a diagonal with a triangle that
/// has no area or is turned over, seen along the normal of the face, is taken only if the other one is no
/// better: a quadrilateral with a reflex corner is cut there. And where the diagonal would join two
/// vertices that share an edge or another diagonal already, the other one is taken if it can be;
/// what remains is counted.
///
/// A larger face is projected along its normal, cut by ears, and improved by turning diagonals until it
/// is a Delaunay triangulation inside its sides. A face that cannot be cut this way, because it has no
/// area or its sides cross, becomes a fan around its lowest vertex, and is counted.
///
/// The triangles of a face stand where it stood and have its values. Vertices and edges keep their
/// numbers. Corners keep the values of the same vertex in the same face.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Triangulate {
    /// Which faces.
    #[serde(default)]
    pub faces: FaceSelection,
}

impl MeshOperation for Triangulate {
    const NAME: &'static str = "Triangulate";
    const SUMMARY: &'static str = "Cut polygons into triangles";
    const EXAMPLE: &'static str = "Triangulate()";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let cut = self.faces.count(plan);
        // A face of degree d gains d - 3 diagonals, and all together have fewer than corners.
        let diagonals = cut.times(plan.degrees.less(3)).capped(plan.edges.by(2).max);
        plan.grow(Range::exactly(0), diagonals, diagonals);
        if self.faces == FaceSelection::All {
            plan.degrees = Range::exactly(3);
        } else if cut.max > 0 {
            plan.degrees.min = 3;
        }
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let chosen = self.faces.mask(mesh, cx)?;
        cx.advance("triangulate", 0, 3)?;
        let mut cuts: Vec<Cut> = (0..mesh.n_faces())
            .into_par_iter()
            .with_min_len(256)
            .map_init(Cutter::default, |cutter, f| {
                if chosen[f] {
                    cutter.cut(mesh, mesh::FaceId::new(f))
                } else {
                    Cut::Keep
                }
            })
            .collect();
        let diagonals: usize = cuts.par_iter().map(Cut::n_diagonals).sum();
        let n_cut = cuts.par_iter().filter(|cut| cut.n_diagonals() > 0).count();
        if n_cut == 0 {
            return Ok(Report::default());
        }
        if 2 * (mesh.n_edges() + diagonals) >= u32::MAX as usize {
            let message = format!("{diagonals} more edges are more than ids can number");
            return Err(OpError::refused(Refusal::Full, message));
        }
        cx.advance("triangulate", 1, 3)?;
        let doubles = doubles::avoid(mesh, &mut cuts);
        cx.advance("triangulate", 2, 3)?;
        mesh.replace(assemble::assemble(mesh, &cuts, diagonals));

        let fans = cuts.iter().filter(|cut| cut.is_fan()).count();
        let of_fans = "faces without area or with crossing sides, cut into fans";
        let of_doubles = "diagonals between vertices that share another edge";
        let report = Report::changed(n_cut).count(of_fans, fans);
        Ok(report.count(of_doubles, doubles))
    }
}

#[cfg(test)]
mod tests;
