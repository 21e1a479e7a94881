//! Butterfly subdivision: cuts every triangle into four, smooth through the old vertices.
//!
//! ```text
//!    -1/16 ---- 1/8 ---- -1/16           s2    s1
//!        \     /   \     /                 \  /
//!         \   /     \   /            s3 -- 3/4 -*- s0       -1/16 -- 9/16 -*- 9/16 -- -1/16
//!          1/2 --*-- 1/2                   /  \
//!         /   \     /   \                s4    s5
//!        /     \   /     \
//!    -1/16 ---- 1/8 ---- -1/16
//!
//!     both ends regular           one end is not             on the boundary
//! ```
//!
//! Each level puts a vertex on every edge and joins the three of each triangle. Old vertices stay, so the
//! surface goes through all of them. At an end inside whose valence n is not 6, the weights of the
//! neighbors are (1/4 + cos(2πj/n) + cos(4πj/n)/2)/n, with others for n = 3 and 4; if both ends are such, the
//! new vertex is the mean. That is the modified scheme of Zorin, Schröder and Sweldens, "Interpolating
//! Subdivision for Meshes with Arbitrary Topology", 1996, after Dyn, Levin and Gregory, "A Butterfly
//! Subdivision Scheme for Surface Interpolation with Tension Control", 1990. The limit surface has a
//! continuous tangent plane. It may ripple where a coarse mesh bends sharply, and leave its convex hull.
//!
//! The crate `subdivision` does the work, for this scheme and the others.

use op::prelude::*;
use subdivision::{Rules, Scheme};

use crate::step::{Step, Until};

/// Cuts every triangle into four and smooths, without moving old vertices, as often as `levels` says.
///
/// A level makes 4 F triangles, 2 E + 3 F edges and V + E vertices out of F, E and V, so V - E + F
/// stays. Edge e becomes edges 2e and 2e + 1, face f becomes faces 4f to 4f + 3, old vertices keep
/// their numbers, and the vertex on edge e is V + e. The mesh must consist of triangles.
///
/// Vertex attributes are interpolated with the weights of the positions, corner values linearly within
/// their own old triangles; halves of an edge and parts of a triangle take the values of the whole. Normals
/// are dropped, because they would be wrong. Sharp edges are none here; their numbers are handed on.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Butterfly {
    /// How often: each level has four times as many triangles as the one before.
    /// 1 if nothing is said; with `until` the most levels that are allowed, 16 if nothing is said.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// When to stop, instead of after a number of levels.
    #[serde(default)]
    pub until: Option<Until>,
}

impl Butterfly {
    fn step(&self) -> Step<'_> {
        Step {
            levels: self.levels,
            until: self.until,
            ..Step::new(Rules::of(Scheme::Butterfly))
        }
    }
}

impl MeshOperation for Butterfly {
    const NAME: &'static str = "Butterfly";
    const SUMMARY: &'static str =
        "Cut every triangle into four and smooth through the old vertices";
    const EXAMPLE: &'static str = "Butterfly(levels: 0)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
