//! Sqrt3 subdivision: cuts every triangle into three, turned, and smooths.
//!
//! ```text
//!            c                        c
//!          /   \                    / | \
//!        /       \                /   m   \           m: a new vertex in each face; old edges
//!      /     f     \    --->    /   / | \   \         inside are flipped, so that they join two
//!    a ------------- b         a  -   |   -  b        of them
//!      \     g     /            \   \ | /   /
//!        \       /                \   n   /
//!          \   /                    \ | /
//!            d                        d
//! ```
//!
//! New vertices are the means of their triangles, and old ones move to a mean with their neighbors:
//!
//! ```text
//!          1/3                 a/n   a/n
//!         /   \                  \   /
//!        /  *  \            a/n - 1-a - a/n       4/27 -- 19/27 -- 4/27      1/27 -- 16/27 -*--- 10/27
//!       /       \                /   \
//!    1/3 ------- 1/3          a/n     a/n
//!
//!      in a face          old, inside, valence n    old, boundary            new, boundary
//! ```
//!
//! with a = (4 - 2 cos(2π/n))/9. A boundary changes on every second level of a step, where each of its edges
//! is cut in three; between them it stays, and its edges are not flipped. Two levels cut every edge in
//! three and make nine triangles out of one: between Loop's four and sixteen. Kobbelt, "√3-Subdivision",
//! 2000. The limit surface has continuous curvature away from old vertices of valence other than 6.
//!
//! The crate `subdivision` does the work, for this scheme and the others.

use op::prelude::*;
use subdivision::{Rules, Scheme};

use crate::step::{Step, Until};

/// Cuts every triangle into three, turned, and smooths, as often as `levels` says.
///
/// A level makes 3 F triangles out of F; on a closed mesh E + 3 F edges and V + F vertices, and on every
/// second level one more of both for each edge of the boundary. V - E + F stays. Old vertices keep their
/// numbers, the vertex in face f is V + f, and the triangles beside it are 3f to 3f + 2. The mesh must
/// consist of triangles. Levels are counted from the begin of the step, so two steps of one level leave a
/// boundary as it is, where one step of two levels cuts it.
///
/// Vertex attributes are smoothed with the weights of the positions. Corner values are linear within the
/// old triangles; the triangles beside a flipped edge lie in two, so along a seam texture coordinates are
/// torn across these. New triangles take the values of their old one, and parts of a boundary edge those
/// of the edge; other edges are new and have none. Normals are dropped, because they would be wrong.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sqrt3 {
    /// How often: each level has three times as many triangles as the one before.
    /// 1 if nothing is said; with `until` the most levels that are allowed, 16 if nothing is said.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// When to stop, instead of after a number of levels.
    #[serde(default)]
    pub until: Option<Until>,
}

impl Sqrt3 {
    fn step(&self) -> Step<'_> {
        Step {
            levels: self.levels,
            until: self.until,
            ..Step::new(Rules::of(Scheme::Sqrt3))
        }
    }
}

impl MeshOperation for Sqrt3 {
    const NAME: &'static str = "Sqrt3";
    const SUMMARY: &'static str = "Cut every triangle into three, turned, and smooth";
    const EXAMPLE: &'static str = "Sqrt3(levels: 0)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
