//! Doo-Sabin subdivision: replaces every edge and every vertex with a face.
//!
//! ```text
//!    d --------------- c          d --------------- c
//!    |                 |          |   .---------.   |
//!    |                 |          |   |         |   |        a smaller face in each old face,
//!    |        f        |   --->   |   |    f    |   |        a quad for each old edge,
//!    |                 |          |   |         |   |        a face around each old vertex
//!    |                 |          |   *---------.   |
//!    a --------------- b          a --------------- b
//! ```
//!
//! Every corner of a face becomes a vertex at a weighted mean of the corners of the face. Each boundary edge also gets
//! two new vertices:
//!
//! ```text
//!     3/16 ---- 1/16          1/6
//!      |         |            /  \                    3/4 --*------- 1/4
//!      |    *    |           / *  \
//!      |         |         2/3 --- 1/6
//!     9/16 ---- 3/16
//! ```
//!
//! In a face with n corners, the new vertex of a corner is a weighted mean of all corners of the face. The corner to
//! which the new vertex belongs has the weight (n + 5)/(4n). The j-th corner after this corner has the weight (3 + 2
//! cos(2πj/n))/(4n). Source: Doo and Sabin, "Behaviour of recursive division surfaces near extraordinary points", 1978.
//! On a grid of quads the limit surface is the biquadratic B-spline of the vertices. The limit surface touches every
//! face at the mean of its corners and has a continuous tangent plane. The boundary is a quadratic B-spline curve
//! (Chaikin, "An algorithm for high-speed curve generation", 1974).
//!
//! The crate `subdivision` implements all subdivision schemes.

use op::prelude::*;
use subdivision::{Rules, Scheme};

use crate::step::{Step, Until};

/// Replaces every edge and every vertex with a face and shrinks the old faces. The step repeats this for every level.
///
/// A level turns a closed mesh with V vertices, E edges and F faces into a mesh with 2 E vertices, 4 E edges and V +
/// E + F faces. If the mesh has a boundary, a level creates additional elements along the boundary. The Euler
/// characteristic V - E + F does not change. The shrunk face inside old face f has the id f, and the new face at old
/// edge e has the id F + e. The new faces at old vertices have the highest ids. Isolated vertices are kept. The ids of
/// isolated vertices follow the ids of all other vertices. Two kinds of vertices do not become faces: isolated
/// vertices, and vertices inside the mesh that have only two edges.
///
/// Vertex attributes are smoothed with the same weights as the positions. Corner values are smoothed within each old
/// face separately. The new faces at edges and vertices mix corner values of several old faces. At a seam, the mixed
/// values distort textures. A face inside an old face copies the attribute values of the old face. The new face at an
/// edge or a vertex copies the values of an adjacent face. The two new edges along an old edge copy the values of this
/// edge. All other edges have zero values (no crease, no tags). Normals are dropped, because they would be wrong.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct DooSabin {
    /// The number of levels. Each level multiplies the number of faces by about four. Without `until`, `levels`
    /// defaults to 1. With `until`, `levels` is the maximum number of levels and defaults to 16.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// The condition that ends the subdivision. If omitted, exactly `levels` levels are computed.
    #[serde(default)]
    pub until: Option<Until>,
}

impl DooSabin {
    fn step(&self) -> Step<'_> {
        Step {
            levels: self.levels,
            until: self.until,
            ..Step::new(Rules::of(Scheme::DooSabin))
        }
    }
}

impl MeshOperation for DooSabin {
    const NAME: &'static str = "DooSabin";
    const VERSION: u32 = 2;
    const SUMMARY: &'static str = "Replace every edge and every vertex with a face";
    const EXAMPLE: &'static str = "DooSabin(levels: 1)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
