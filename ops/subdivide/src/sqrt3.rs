//! Sqrt3 subdivision: splits every triangle into three, flips the old edges, and smooths the surface.
//!
//! ```text
//!            c                        c
//!          /   \                    / | \
//!        /       \                /   m   \           m, n: a new vertex in each face; old inner
//!      /     f     \    --->    /   / | \   \         edges are flipped, so that they
//!    a ------------- b         a  -   |   -  b        connect two new vertices
//!      \     g     /            \   \ | /   /
//!        \       /                \   n   /
//!          \   /                    \ | /
//!            d                        d
//! ```
//!
//! A new vertex is the mean of the corners of its triangle, and an old vertex moves to a weighted mean of itself and
//! its neighbors:
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
//! Here a = (4 - 2 cos(2π/n))/9. Only every second level of a step changes the boundary: it cuts each boundary edge in
//! three. Boundary edges are never flipped. Two levels cut every edge in three and replace each triangle with nine
//! triangles. Two levels of Loop subdivision replace each triangle with sixteen triangles. Source: Kobbelt,
//! "√3-Subdivision", 2000. The limit surface has continuous curvature except at old vertices whose valence is not 6.
//!
//! The crate `subdivision` implements all subdivision schemes.

use op::prelude::*;
use subdivision::{Rules, Scheme};

use crate::step::{Step, Until};

/// Splits every triangle into three, flips the old edges, and smooths the surface. The step repeats this for every
/// level.
///
/// A level turns V vertices, E edges and F triangles into V + F vertices, E + 3 F edges and 3 F triangles. Every second
/// level also cuts each boundary edge in three. Each boundary edge that is cut in three adds one vertex and one edge to
/// these counts. The Euler characteristic V - E + F does not change. Old vertices keep their ids. The new vertex in
/// face f has the id V + f, and face f becomes faces 3f to 3f + 2. All faces must be triangles. Each step counts its
/// own levels from 1. One step of two levels therefore cuts the boundary edges. Two steps of one level each leave the
/// boundary edges uncut.
///
/// Vertex attributes are smoothed with the same weights as the positions. Corner values are interpolated linearly
/// within each old triangle separately. A triangle next to a flipped edge covers parts of two old triangles. If the
/// flipped edge was a seam, the triangle mixes texture coordinates of both sides of the seam, which distorts textures.
/// Each new triangle copies the attribute values, such as tags and materials, of the old triangle that was split. Parts
/// of a boundary edge copy the values of the boundary edge. All other edges have zero values (no crease, no tags).
/// Normals are dropped, because they would be wrong.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sqrt3 {
    /// The number of levels. Each level multiplies the number of triangles by three. Without `until`, `levels` defaults
    /// to 1. With `until`, `levels` is the maximum number of levels and defaults to 16.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// The condition that ends the subdivision. If omitted, exactly `levels` levels are computed.
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
    const SUMMARY: &'static str =
        "Split every triangle into three, flip the old edges, and smooth the surface";
    const EXAMPLE: &'static str = "Sqrt3(levels: 1)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
