//! Flip edges: replaces the edge between two triangles with the other diagonal of their quadrilateral.
//!
//! ```text
//!        c                   c
//!      /   \               / | \
//!    a --e-- b    -->    a   e   b        no counts change; four flips of an edge restore the mesh
//!      \   /               \ | /
//!        d                   d
//! ```
//!
//! With `until: Once`, each edge is flipped once. Otherwise, the module `until` flips edges until no flip improves the
//! mesh. The module `goal` defines which flips improve the mesh.

mod goal;
mod until;

use mesh::{EdgeId, EditError, counted};
use op::prelude::*;

use goal::Goal;

/// Replaces the edge between two triangles with the other diagonal of the quadrilateral that they form.
///
/// Edges are flipped in order of their ids. Each flip is checked against the mesh that the earlier flips have produced.
/// A flip is refused if the edge is on the boundary or if the same face is on both sides of the edge. A flip is also
/// refused if an end of the edge has only two edges. A flip is also refused if the new edge would join a vertex to
/// itself, or would join two vertices that an edge already joins. The flip of a seam is refused unless `seams` is
/// `Drop`. All elements keep their ids, and no vertex moves. Vertices, edges and faces keep their values. Each of the
/// two faces gets one new corner. The new corner of a face gets its values from the corner of the other face at the
/// same vertex. All other corners keep their values.
///
/// If a face beside the edge has more than three corners, the edge turns inside the polygon that the two faces form
/// together. Each end of the edge moves to the next corner of this polygon, counter-clockwise. With `until: Delaunay`
/// or `until: Valence`, only edges between two triangles are flipped.
///
/// With `until: Delaunay` or `until: Valence`, an edge is flipped only if the flip improves the angles of the triangles
/// (`Delaunay`) or the numbers of edges at the vertices (`Valence`). The step makes several passes over the edges. It
/// stops after a pass that flips no edge, or after `passes` passes. The flips neither fold the surface nor create
/// zero-area triangles. If a flip that would improve the mesh is refused, the edge is left unchanged, and the step does
/// not fail. The report counts the refused flips for each reason. The report also states the number of passes, and
/// whether the step stopped because of the limit `passes`.
///
/// On a surface that is not flat, a flip changes the shape. To keep creases and other edges, exclude them from `edges`.
/// For example, `Flat(below: 30)` selects only edges at which the surface bends by less than 30 degrees.
/// `Not(Tagged("keep"))` selects only edges without the tag "keep".
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FlipEdges {
    /// The edges to flip. The edges are selected before the first flip. An edge keeps its id when it is flipped.
    pub edges: EdgeSelection,
    /// Which edges are flipped, and when to stop.
    #[serde(default)]
    pub until: Until,
    /// The largest number of passes over the edges. Ignored with `until: Once`, which makes one pass.
    #[serde(default = "hundred")]
    pub passes: Count<1, 1_000_000>,
    /// What to do when a flip is refused. Used only with `until: Once`.
    #[serde(default)]
    pub on_refusal: OnRefusal,
    /// What to do with a seam (an edge whose corner values, such as UVs, differ between its two sides).
    #[serde(default)]
    pub seams: Seams,
}

/// Which edges are flipped, and when to stop.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FlipUntil")]
pub enum Until {
    /// Flip each edge once.
    #[default]
    Once,
    /// Flip edges until no flip reduces the sum of the cotangents of all angles of all triangles. The result has fewer
    /// very small and very large angles than the original mesh. If all edges of a flat mesh are selected and no seam
    /// prevents a flip, the result is the Delaunay triangulation within the boundary.
    Delaunay,
    /// Flip edges until no flip brings the valences (the numbers of edges) of the vertices closer to their targets. The
    /// target is 6 for inner vertices and 4 for boundary vertices. Each flip reduces the sum of the squared differences
    /// between valences and targets.
    Valence,
}

const fn hundred() -> Count<1, 1_000_000> {
    Count::literal(100)
}

impl MeshOperation for FlipEdges {
    const NAME: &'static str = "FlipEdges";
    const SUMMARY: &'static str =
        "Replace the edge between two triangles with the other diagonal of their quadrilateral";
    const EXAMPLE: &'static str = "FlipEdges(edges: All)";
    const WORDS: &'static [&'static str] = &["swap", "delaunay", "rotate"];
    const DONE: &'static str = "flipped";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        // A flip does not change the counts of elements, the degrees of faces or the attributes. Edges between polygons
        // can be flipped, but only flips between triangles improve a mesh.
        let needs_triangles = match self.until {
            Until::Once => false,
            Until::Delaunay | Until::Valence => true,
        };
        if needs_triangles && plan.degrees.min > 3 && self.edges.count(plan).min > 0 {
            let message = format!(
                "with `until: {:?}`, FlipEdges flips only edges between triangles, but every face has at least {} \
                 corners",
                self.until, plan.degrees.min
            );
            let problem = Problem::warning(message);
            problems.push(problem.help("triangulate the faces first, with `Triangulate`"));
        }
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let edges = self.edges.resolve(mesh, cx)?;
        let mut flips = Flips {
            seams: self.seams,
            crossed: 0,
        };
        let goal = match self.until {
            Until::Once => None,
            Until::Delaunay => Some(Goal::Delaunay),
            Until::Valence => Some(Goal::valence(mesh)),
        };
        let report = match goal {
            None => edit_each(mesh, &edges, self.on_refusal, "flip", cx, |mesh, e| {
                flips.flip(mesh, e)
            })?,
            Some(goal) => {
                until::flip_until(mesh, &edges, goal, self.passes.get(), cx, |mesh, e| {
                    flips.flip(mesh, e)
                })?
            }
        };
        Ok(match flips.crossed {
            0 => report,
            n => {
                let edges = counted(n, "seam edge");
                report.note(format!(
                    "flipped {edges}; in both faces of each edge, the new corner copies the attribute values of the other face's corner at the same vertex"
                ))
            }
        })
    }
}

/// Flips edges, and counts the flipped seams.
struct Flips {
    seams: Seams,
    crossed: u64,
}

impl Flips {
    fn flip(&mut self, mesh: &mut Mesh, e: EdgeId) -> Result<(), EditError> {
        // The seam is checked before the flip, because the flip removes the seam from the edge.
        let is_seam = self.seams == Seams::Drop && mesh.is_seam(e);
        mesh.flip_edge_with(e, self.seams.into())?;
        self.crossed += u64::from(is_seam);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
