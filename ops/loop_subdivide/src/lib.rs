//! Loop subdivision: cuts every triangle into four and smooths.
//!
//! ```text
//!            c                      c
//!          /   \                  / 2 \
//!        /       \              y ---- x          x, y, z: new vertices, one on each edge
//!      /     f     \    --->   / \ 3  / \         0, 1, 2: the triangles at a, b, c
//!    /               \       / 0  \ / 1  \        3: the triangle in the middle
//!   a --------------- b     a ---- z ---- b
//! ```
//!
//! Each level puts a vertex on every edge, joins the three of each triangle, and moves old vertices
//! to a weighted mean of themselves and their neighbors:
//!
//! ```text
//!          1/8                  u     u
//!         /   \                  \   /
//!      3/8 -*- 3/8           u - 1-nu - u            1/2 --*-- 1/2       1/8 -- 3/4 -- 1/8
//!         \   /                  /   \
//!          1/8                  u     u
//!
//!     new, inside          old, inside, valence n    new, boundary      old, boundary
//! ```
//!
//! with u = 3/16 for n = 3 and u = 3/(8n) otherwise. The masks are those of Loop, "Smooth Subdivision
//! Surfaces Based on Triangles", 1987, with the simpler weights at old vertices of Warren,
//! "Subdivision Methods for Geometric Design", 1995 (also Warren and Weimer, same title, 2001). The
//! boundary is a cubic B-spline curve that does not depend on the inside. Away from old vertices of
//! valence other than 6 the limit surface has continuous curvature.
//!
//! [`LoopSubdivide`] is the operation; [`subdivide`] makes one level of a mesh that is at hand. A
//! level is not a sequence of edits: its arrays are computed in closed form from the old ones (module
//! `topology`), each element by itself, in parallel, with the same bytes for any number of threads.

mod attributes;
mod forecast;
mod meter;
mod positions;
mod topology;

use mesh::{FaceId, Mesh};
use op::{
    Context, MeshOperation, MeshPlan, OpError, PlanContext, Problem, Progress, Range, Refusal,
    Report,
};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use forecast::Counts;
use meter::{Meter, Through};

/// The most levels that a step may ask for: a single triangle fills the ids before.
const MAX_LEVELS: u32 = 16;

/// Cuts every triangle into four and smooths, as often as `levels` says.
///
/// A level makes 4 F triangles, 2 E + 3 F edges and V + E vertices out of F, E and V, so V - E + F
/// stays. Edge e becomes edges 2e and 2e + 1, face f becomes faces 4f to 4f + 3, old vertices keep
/// their numbers, and the vertex on edge e is V + e. The mesh must consist of triangles.
///
/// Vertex attributes are smoothed with the weights of the positions; texture coordinates and other
/// corner values are interpolated within their own triangle, so that seams stay seams; halves of an
/// edge and parts of a triangle take the values of the whole. Normals are dropped, because they would
/// be wrong. The sharpness of creases is handed on, but this operation smooths across them.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LoopSubdivide {
    /// How often: each level has four times as many triangles as the one before. 0 does nothing.
    #[serde(default = "one")]
    #[schemars(range(min = 0, max = 16))]
    pub levels: u32,
}

const fn one() -> u32 {
    1
}

impl Default for LoopSubdivide {
    /// One level.
    fn default() -> Self {
        Self { levels: one() }
    }
}

impl MeshOperation for LoopSubdivide {
    const NAME: &'static str = "LoopSubdivide";
    const SUMMARY: &'static str = "Cut every triangle into four and smooth";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if self.levels == 0 {
            return problems;
        }
        if self.levels > MAX_LEVELS {
            problems.push(Problem::error(self.too_many_levels()).at(["levels"]));
        }
        if plan.degrees.min > 3 && plan.faces.max > 0 {
            let message = format!(
                "{} needs triangles, but the faces have at least {} corners",
                Self::NAME,
                plan.degrees.min
            );
            problems.push(Problem::error(message).help("cut the faces into triangles before"));
        }
        plan.degrees = Range::exactly(3);
        plan.drop_normals();

        let mut levels = self.levels.min(MAX_LEVELS);
        let least = Counts::least_of(plan);
        if let Err(too_large) = least.check(levels, cx.budget) {
            problems.push(
                Problem::error(too_large.message())
                    .at(["levels"])
                    .help(too_large.help()),
            );
            // The plan goes on with what fits, so that later steps are not blamed for this one.
            levels = too_large.fits.unwrap_or(0);
        }
        for _ in 0..levels {
            plan.vertices = plan.vertices.plus(plan.edges);
            plan.edges = plan.edges.by(2).plus(plan.faces.by(3));
            plan.faces = plan.faces.by(4);
        }
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        if self.levels > MAX_LEVELS {
            return Err(OpError::Parameter(self.too_many_levels()));
        }
        cx.advance("Loop subdivision", 0, 1)?;
        if self.levels == 0 {
            return Ok(Report::default());
        }
        mesh.compact();
        check_triangles(mesh)?;
        let counts = Counts::of(mesh);
        counts
            .check(self.levels, cx.budget)
            .map_err(|too_large| OpError::Budget(too_large.to_string()))?;

        let total = (0..self.levels).map(|level| counts.after(level).work());
        let through = Through(cx);
        let meter = Meter::new(&through, total.sum());
        for _ in 0..self.levels {
            mesh.replace(finer(mesh, &meter)?);
        }
        Ok(Report::changed(mesh.n_faces()))
    }
}

impl LoopSubdivide {
    fn too_many_levels(&self) -> String {
        let levels = self.levels;
        format!("levels must lie between 0 and {MAX_LEVELS}, not {levels}")
    }
}

/// One level of Loop subdivision, with the ids, the weights and the attributes of [`LoopSubdivide`].
///
/// A mesh with dead elements is compacted first, and the ids are those of the compacted mesh.
/// Progress is reported from the threads that work.
///
/// # Errors
///
/// [`OpError::Refused`] with [`Refusal::NotTriangle`] if a face has more than three corners,
/// [`OpError::Budget`] if the elements would outnumber the ids, [`OpError::Cancelled`].
///
/// # Examples
///
/// ```
/// let mesh = loop_subdivide::subdivide(&mesh::shapes::icosahedron(), &op::NoProgress)?;
/// assert_eq!((mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()), (42, 120, 80));
/// # Ok::<(), op::OpError>(())
/// ```
pub fn subdivide(mesh: &Mesh, progress: &dyn Progress) -> Result<Mesh, OpError> {
    if !mesh.is_dense() {
        let mut dense = mesh.clone();
        dense.compact();
        return subdivide(&dense, progress);
    }
    check_triangles(mesh)?;
    let counts = Counts::of(mesh);
    counts
        .check(1, u64::MAX)
        .map_err(|too_large| OpError::Budget(too_large.to_string()))?;
    finer(mesh, &Meter::new(progress, counts.work()))
}

/// One level over a dense mesh of triangles whose next level fits.
fn finer(mesh: &Mesh, meter: &Meter) -> Result<Mesh, OpError> {
    let connectivity = topology::finer(mesh, meter)?;
    let positions = positions::finer(mesh, meter)?;
    let attributes = attributes::finer(mesh, meter)?;
    let mut finer = Mesh::from_arrays(connectivity, positions);
    finer.set_attributes(attributes);
    Ok(finer)
}

fn check_triangles(mesh: &Mesh) -> Result<(), OpError> {
    let is_polygon = |i: usize| !mesh.is_triangle(FaceId::new(i));
    match (0..mesh.n_faces())
        .into_par_iter()
        .position_first(is_polygon)
        .map(FaceId::new)
    {
        None => Ok(()),
        Some(f) => Err(OpError::refused(
            Refusal::NotTriangle,
            format!(
                "Loop subdivision needs triangles, but {f} has {} corners",
                mesh.degree(f)
            ),
        )),
    }
}

#[cfg(test)]
mod fixtures;
#[cfg(test)]
mod oracle;
#[cfg(test)]
mod tests;
