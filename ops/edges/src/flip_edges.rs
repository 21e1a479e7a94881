//! Flip edges: turns the edges between triangles to their other diagonal.
//!
//! ```text
//!        c                   c
//!      /   \               / | \
//!    a --e-- b    -->    a   e   b        V, E and F stay; four flips of an edge are none
//!      \   /               \ | /
//!        d                   d
//! ```
//!
//! Each edge once, or only those that make the mesh better, until none does (module `until`, with
//! what is better in module `goal`).

mod goal;
mod until;

use mesh::{EdgeId, EditError};
use op::prelude::*;

use goal::Goal;

/// Turns edges between triangles to their other diagonal.
///
/// Edges are taken in order of their numbers, each judged as the mesh is at that moment. A flip is
/// refused if the edge is on the boundary, if a face beside it is not a triangle, if the far corners
/// of the triangles share an edge already or are one and the same, and at a seam. No number of an
/// element changes and no vertex moves. Values of vertices, edges and faces stay with their elements;
/// corners take the values of the same vertex in the other triangle.
///
/// With `until: Delaunay` or `until: Valence` an edge is flipped only if that brings the mesh nearer to
/// the goal, and edges are judged again, pass after pass, until none is flipped any more. Such a flip
/// neither folds the surface nor makes a triangle without area. Edges that would be flipped but may not
/// be are no failure: they stay, and the report counts them by reason. The report also says how many
/// passes it took, and whether edges were left because `passes` was reached.
///
/// On a surface that is not flat a flip changes the shape. To keep creases and the edges of a
/// part, leave them out of `edges`: `Flat(below: 30)`, `Not(Tagged("keep"))`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FlipEdges {
    /// Which edges. They are chosen once: an edge keeps its number when it turns.
    pub edges: EdgeSelection,
    /// How often, and which of them.
    #[serde(default)]
    pub until: Until,
    /// The most passes over the edges; `Once` makes one.
    #[serde(default = "hundred")]
    pub passes: Count<1, 1_000_000>,
    /// What to do when a flip is refused; only for `Once`.
    #[serde(default)]
    pub on_refusal: OnRefusal,
    /// What to do at seams.
    #[serde(default)]
    pub seams: Seams,
}

/// Which edges are flipped, and when to stop.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Until {
    /// Each edge once.
    #[default]
    Once,
    /// Until no flip makes the sum of the cotangents of all angles of all triangles smaller: angles far
    /// from flat and from zero. On a flat mesh that is the Delaunay triangulation.
    Delaunay,
    /// Until no flip brings the numbers of edges at vertices nearer to 6, or 4 on the boundary: it
    /// makes the sum of the squares of the differences smaller.
    Valence,
}

const fn hundred() -> Count<1, 1_000_000> {
    Count::literal(100)
}

impl MeshOperation for FlipEdges {
    const NAME: &'static str = "FlipEdges";
    const SUMMARY: &'static str = "Turn edges to the other diagonal of their two triangles";
    const EXAMPLE: &'static str = "FlipEdges(edges: All)";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        // Counts, degrees and attributes stay. Without a triangle every flip is refused.
        if plan.degrees.min > 3 && self.edges.count(plan).min > 0 {
            let message = format!(
                "FlipEdges turns edges between triangles, but every face has at least {} corners",
                plan.degrees.min
            );
            let problem = match self.until {
                Until::Once => self.on_refusal.problem(message),
                Until::Delaunay | Until::Valence => Problem::warning(message),
            };
            problems.push(problem.help("cut the faces into triangles first, with Triangulate"));
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
            n => report.note(format!(
                "seams crossed: {n}; corners there took values of the other side"
            )),
        })
    }
}

/// Flips edges, and counts the seams that this crossed.
struct Flips {
    seams: Seams,
    crossed: u64,
}

impl Flips {
    fn flip(&mut self, mesh: &mut Mesh, e: EdgeId) -> Result<(), EditError> {
        // Asked before the flip: afterwards the seam is gone from the edge.
        let is_seam = self.seams == Seams::Drop && mesh.is_seam(e);
        mesh.flip_edge_with(e, self.seams.into())?;
        self.crossed += u64::from(is_seam);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
