//! Butterfly subdivision: splits every triangle into four, and smooths the surface without moving the old vertices.
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
//!     both ends regular      one extraordinary end       on the boundary
//! ```
//!
//! Each level adds a vertex on every edge and connects the three new vertices of each triangle. Old vertices do not
//! move, so the surface passes through all of them. An inner vertex is extraordinary if its valence n is not 6. If an
//! end of an edge is extraordinary, the new vertex on this edge has a special mask. In this mask, neighbor j of the
//! extraordinary end has the weight (1/4 + cos(2πj/n) + cos(4πj/n)/2)/n. For valence 3 and valence 4, other weights are
//! used. If both ends of an edge are extraordinary, the mask of each end is applied, and the new vertex is the mean of
//! the two results. The scheme is the modified butterfly scheme of Zorin, Schröder and Sweldens, "Interpolating
//! Subdivision for Meshes with Arbitrary Topology", 1996. The modified scheme extends the scheme of Dyn, Levin and
//! Gregory, "A Butterfly Subdivision Scheme for Surface Interpolation with Tension Control", 1990. The limit surface
//! has a continuous tangent plane. The surface can ripple where a coarse mesh bends sharply, and it can leave the
//! convex hull of the mesh.
//!
//! The crate `subdivision` implements all subdivision schemes.

use op::prelude::*;
use subdivision::{Rules, Scheme};

use crate::step::{Step, Until};

/// Splits every triangle into four and smooths the surface without moving the old vertices. The step repeats this for
/// every level.
///
/// A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. The Euler
/// characteristic V - E + F does not change. Old vertices keep their ids, and the new vertex on edge e has the id V +
/// e. Edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be triangles.
///
/// Vertex attributes are interpolated with the same weights as the positions. Corner values are interpolated linearly,
/// separately in each old triangle. When an edge or a triangle is split, its parts copy its attribute values, such as
/// tags and materials. Normals are dropped, because they would be wrong. The sharpness that `Crease` sets has no effect
/// and is copied unchanged.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Butterfly {
    /// The number of levels. Each level multiplies the number of triangles by four. Without `until`, `levels` defaults
    /// to 1. With `until`, `levels` is the maximum number of levels and defaults to 16.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// The condition that ends the subdivision. If omitted, exactly `levels` levels are computed.
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
        "Split every triangle into four and smooth the surface without moving the old vertices";
    const EXAMPLE: &'static str = "Butterfly(levels: 1)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
