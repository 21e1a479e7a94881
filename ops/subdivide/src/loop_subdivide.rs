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
//! The crate `subdivision` does the work, for this scheme and the others.

use op::prelude::*;
use subdivision::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme};

use crate::step::{Step, Until};

/// Cuts every triangle into four and smooths, as often as `levels` says.
///
/// A level makes 4 F triangles, 2 E + 3 F edges and V + E vertices out of F, E and V, so V - E + F
/// stays. Edge e becomes edges 2e and 2e + 1, face f becomes faces 4f to 4f + 3, old vertices keep
/// their numbers, and the vertex on edge e is V + e. The mesh must consist of triangles.
///
/// Vertex attributes are smoothed with the weights of the positions; texture coordinates and other
/// corner values as `face_varying` says, so that seams stay seams; halves of an edge and parts of a
/// triangle take the values of the whole. Normals are dropped, because they would be wrong. Edges and
/// vertices that `Crease` made sharp stay so for as many levels as their sharpness says.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LoopSubdivide {
    /// How often: each level has four times as many triangles as the one before. 1 if nothing is said; with
    /// `until` the most levels that are allowed, 16 if nothing is said.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// When to stop, instead of after a number of levels.
    #[serde(default)]
    pub until: Option<Until>,
    /// The weights at old vertices.
    #[serde(default)]
    pub weights: LoopWeights,
    /// What holds where the mesh ends.
    #[serde(default)]
    pub boundary: Boundary,
    /// How the sharpness of creases decreases.
    #[serde(default)]
    pub creasing: Creasing,
    /// How texture coordinates and other corner values are smoothed.
    #[serde(default)]
    pub face_varying: FaceVarying,
    /// Whether vertices are pushed to the limit surface in the end, and get its normals and tangents.
    #[serde(default)]
    pub to_limit: bool,
    /// Which faces are refined, with all that they become; all if nothing is said. Faces beside them are
    /// cut in two or four, so that no vertex lies on an edge of another face, and what lies outside
    /// does not move. The numbers of new elements are those of `subdivision::refine_faces`.
    #[serde(default)]
    pub faces: Option<FaceSelection>,
}

impl LoopSubdivide {
    fn step(&self) -> Step<'_> {
        Step {
            rules: Rules {
                scheme: Scheme::Loop(self.weights),
                boundary: self.boundary,
                creasing: self.creasing,
                face_varying: self.face_varying,
            },
            levels: self.levels,
            until: self.until,
            to_limit: self.to_limit,
            faces: self.faces.as_ref(),
        }
    }
}

impl MeshOperation for LoopSubdivide {
    const NAME: &'static str = "LoopSubdivide";
    const VERSION: u32 = 2;
    const SUMMARY: &'static str = "Cut every triangle into four and smooth";
    const EXAMPLE: &'static str = "LoopSubdivide(levels: 0)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
