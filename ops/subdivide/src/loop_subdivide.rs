//! Loop subdivision: splits every triangle into four and smooths the surface.
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
//! Each level adds a vertex on every edge, connects the three new vertices of each triangle, and moves each old
//! vertex to a weighted mean of itself and its neighbors:
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
//! Here u = 3/16 if the valence n is 3, and u = 3/(8n) otherwise. Most weights are from Loop, "Smooth Subdivision
//! Surfaces Based on Triangles", 1987. The weights at old vertices are the simpler weights from Warren, "Subdivision
//! Methods for Geometric Design", 1995 (also Warren and Weimer, same title, 2001). The boundary is a cubic B-spline
//! curve that depends on boundary vertices only. The limit surface has continuous curvature except at old vertices
//! whose valence is not 6.
//!
//! The crate `subdivision` implements all subdivision schemes.

use op::prelude::*;
use subdivision::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme};

use crate::step::{Step, Until};

/// Splits every triangle into four and smooths the surface. The step repeats this for every level.
///
/// A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. The Euler
/// characteristic V - E + F does not change. Old vertices keep their ids, and the new vertex on edge e has the id V +
/// e. Edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be triangles.
///
/// Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner values
/// are smoothed as the parameter `face_varying` specifies, and seams are kept. When an edge or a triangle is split, its
/// parts copy its attribute values, such as tags and materials. Normals are dropped, because they would be wrong. If an
/// edge or a vertex has the sharpness s (see `Crease`), it stays sharp for s levels.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LoopSubdivide {
    /// The number of levels. Each level multiplies the number of triangles by four. Without `until`, `levels` defaults
    /// to 1. With `until`, `levels` is the maximum number of levels and defaults to 16.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// The condition that ends the subdivision. If omitted, exactly `levels` levels are computed.
    #[serde(default)]
    pub until: Option<Until>,
    /// The weights that determine the new positions of old vertices. An old vertex moves to a weighted mean of its old
    /// position and its neighbors.
    #[serde(default)]
    pub weights: LoopWeights,
    /// How vertices on the boundary move.
    #[serde(default)]
    pub boundary: Boundary,
    /// How the sharpness of creases decreases from level to level.
    #[serde(default)]
    pub creasing: Creasing,
    /// How texture coordinates and other corner values are smoothed.
    #[serde(default)]
    pub face_varying: FaceVarying,
    /// Whether to move the vertices of the last level to the limit surface and to store the normals and tangents of
    /// this surface.
    #[serde(default)]
    pub to_limit: bool,
    /// The faces to refine. If omitted, all faces. Triangles next to the refined faces are cut in two or four. Without
    /// these cuts, new vertices would lie in the middle of edges of these triangles. The surface outside the refined
    /// faces does not move. The documentation of the Rust function `subdivision::refine_faces` describes the ids of new
    /// elements.
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
    const SUMMARY: &'static str = "Split every triangle into four and smooth the surface";
    const EXAMPLE: &'static str = "LoopSubdivide(levels: 2)";
    const WORDS: &'static [&'static str] = &["smooth", "subdivide", "subdivision", "loop"];

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
