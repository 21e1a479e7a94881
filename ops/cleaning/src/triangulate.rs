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
//! A face with n corners becomes n - 2 triangles. In the list of faces, the triangles take the place of the face.
//! Vertices and edges keep their ids, and the n - 3 diagonals get the highest edge ids. [`Triangulate`] documents which
//! diagonals are chosen. The half-edges of the mesh are kept, and new half-edges are added. The mesh is not built again
//! from triangles, so a closed mesh stays closed even where two diagonals join the same two vertices.

mod assemble;
mod duplicates;

use geometry::triangulate::{Cut, Cutter};
use mesh::parallel;
use op::Refusal;
use op::prelude::*;

/// Cuts polygons into triangles.
///
/// A quadrilateral is cut along its shorter diagonal. If both diagonals have the same length, the diagonal at the
/// vertex with the lowest id is used. Two lengths count as the same if the relative difference of their squares is at
/// most 1e-12. A diagonal is bad if one of its two triangles has zero area or is turned over. A triangle is turned over
/// if it is clockwise where the face is counter-clockwise. If exactly one diagonal is bad, the good diagonal is used,
/// regardless of lengths and ids. A quadrilateral with a reflex corner (an angle above 180 degrees) is therefore cut at
/// that corner. A diagonal is a duplicate if its ends are also joined by an edge or by a diagonal of another face. A
/// duplicate is replaced with the other diagonal of the quadrilateral, unless the other diagonal is worse or also a
/// duplicate. The report counts the duplicates that remain.
///
/// A face with more than four corners is projected along its normal. If the face has at most 4096 corners, it is cut
/// into triangles by ear clipping. A larger face is first cut into monotone polygons, which are then cut into
/// triangles. Then diagonals are flipped until the triangulation is a constrained Delaunay triangulation. Some faces
/// cannot be triangulated in this way: faces with zero area, faces with crossing sides, and faces with more than ten
/// million corners. A face with overlapping sides also cannot be triangulated in this way if it has more than 4096
/// corners. Each of these faces becomes a triangle fan around its vertex with the lowest id. The report counts these
/// faces.
///
/// In the list of faces, the triangles of a face take the place of this face, so faces with higher ids get new ids. The
/// triangles have the values of the face. Vertices and edges keep their ids. Each corner of a triangle has the values
/// that the face had at the same corner.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Triangulate {
    /// The faces to cut.
    #[serde(default)]
    pub faces: FaceSelection,
}

impl MeshOperation for Triangulate {
    const NAME: &'static str = "Triangulate";
    const SUMMARY: &'static str = "Cut polygons into triangles";
    const EXAMPLE: &'static str = "Triangulate()";
    // Since version 2 of the operation, faces with more than 4096 corners are first cut into smaller polygons. Since
    // version 3, these polygons are monotone. Each of these two versions can choose other diagonals than the version
    // before it, but only where several diagonals are equally good.
    const VERSION: u32 = 3;
    const WORDS: &'static [&'static str] = &["triangles", "ears"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let cut = self.faces.count(plan);
        // A face of degree d gets d - 3 diagonals. All faces together get fewer diagonals than they have corners.
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
        let progress = cx.progress();
        let is_cancelled = || !progress.advance("triangulate", 0, 3);
        let mut cuts = parallel::collect(mesh.n_faces(), |_| Cut::Keep);
        parallel::fill(&mut cuts, |first, cuts| {
            let mut cutter = Cutter::default();
            for (f, cut) in (first..).zip(cuts).filter(|(f, _)| chosen[*f]) {
                *cut = cutter.cut_unless(&is_cancelled, mesh, mesh::FaceId::new(f));
            }
        });
        cx.advance("triangulate", 0, 3)?;
        let diagonals = parallel::sum(cuts.len(), |f| cuts[f].n_diagonals());
        let n_cut = parallel::count(cuts.len(), |f| cuts[f].n_diagonals() > 0);
        if n_cut == 0 {
            return Ok(Report::default());
        }
        if 2 * (mesh.n_edges() + diagonals) >= u32::MAX as usize {
            let message = format!(
                "with {diagonals} new edges, the mesh would exceed the supported number of edges"
            );
            return Err(OpError::refused(Refusal::Full, message));
        }
        cx.advance("triangulate", 1, 3)?;
        let duplicates = duplicates::avoid(mesh, &mut cuts);
        cx.advance("triangulate", 2, 3)?;
        // For each half-edge, the arrays of the new mesh store three ids, and `assemble` stores one more id in
        // `corner_sources`. While an array is extended, its old and its new memory can be in use at the same time.
        let n_half_edges = mesh.n_half_edges() + 2 * diagonals;
        mesh::require_memory(24 * n_half_edges + 24 * mesh.n_vertices());
        mesh.replace(assemble::assemble(mesh, &cuts, diagonals));

        let fans = cuts.iter().filter(|cut| cut.is_fan()).count();
        let fan_note = "faces with zero area or with crossing sides, cut into fans";
        let duplicate_note = "diagonals between vertices that are also joined by another edge";
        let report = Report::changed(n_cut).count(fan_note, fans);
        Ok(report.count(duplicate_note, duplicates))
    }
}

#[cfg(test)]
mod tests;
