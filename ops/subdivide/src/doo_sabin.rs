//! Doo-Sabin subdivision: cuts off every edge and vertex.
//!
//! ```text
//!    d --------------- c          d --------------- c
//!    |                 |          |   .---------.   |
//!    |                 |          |   |         |   |        a face in each old face, smaller,
//!    |        f        |   --->   |   |    f    |   |        a quad for each old edge,
//!    |                 |          |   |         |   |        a face around each old vertex
//!    |                 |          |   *---------.   |
//!    a --------------- b          a --------------- b
//! ```
//!
//! Every corner of a face becomes a vertex, a mean of the corners of its face; on the boundary there are
//! two on each edge:
//!
//! ```text
//!     3/16 ---- 1/16          1/6
//!      |         |            /  \                    3/4 --*------- 1/4
//!      |    *    |           / *  \
//!      |         |         2/3 --- 1/6
//!     9/16 ---- 3/16
//! ```
//!
//! In a face with n corners, the nearest has the weight (n + 5)/(4n), the j-th from there
//! (3 + 2 cos(2πj/n))/(4n). Doo and Sabin, "Behaviour of recursive division surfaces near extraordinary
//! points", 1978. On a grid of quads the limit surface is the biquadratic B-spline of the vertices. It
//! touches every face in the mean of its corners, and has a continuous tangent plane. The boundary is a
//! quadratic B-spline curve (Chaikin, "An algorithm for high-speed curve generation", 1974).
//!
//! The crate `subdivision` does the work, for this scheme and the others.

use op::prelude::*;
use subdivision::{Rules, Scheme};

use crate::step::{Step, Until};

/// Cuts off every edge and vertex, as often as `levels` says.
///
/// A closed mesh gets F + E + V faces, 4 E edges and 2 E vertices out of F, E and V; a boundary adds to
/// them. V - E + F stays. The face in old face f is f, that of edge e is F + e, and those of vertices follow.
/// Isolated vertices stay, last of all, and become no face; nor does a vertex inside with two edges.
///
/// Vertex attributes are smoothed with the weights of the positions, and corner values within their own
/// old faces, so along a seam texture coordinates are torn across the faces of edges and vertices. A face in
/// an old one takes its values, that of an edge or a vertex those of a face beside it. The two edges along an
/// old one take its values, others have none. Normals are dropped, because they would be wrong.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct DooSabin {
    /// How often: each level has about four times as many faces as the one before.
    /// 1 if nothing is said; with `until` the most levels that are allowed, 16 if nothing is said.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// When to stop, instead of after a number of levels.
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
    const SUMMARY: &'static str = "Cut off every edge and vertex";
    const EXAMPLE: &'static str = "DooSabin(levels: 0)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
