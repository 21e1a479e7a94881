//! Catmull-Clark subdivision: cuts every face into quads and smooths.
//!
//! ```text
//!    d ----------- c          d ---- . ---- c
//!    |             |          |      |      |
//!    |             |          |  3   |  2   |         f: the new vertex in a face, of n corners
//!    |      f      |   --->   . ---- f ---- .         e: one on each edge
//!    |             |          |  0   |  1   |         0, 1, ..: a quad at each corner
//!    |             |          |      |      |
//!    a ----------- b          a ---- e ---- b
//! ```
//!
//! A vertex in a face is the mean of the corners. The others are means of old vertices and of these:
//!
//! ```text
//!          f: 1/4            1/n²     1/n²     1/n²
//!          |                     f ---- . ---- f
//!    1/2*- 1/4 -- a: 1/4         |      |      |
//!          |                1/n² . -- (n-2)/n  . 1/n²      1/2 --*-- 1/2       1/8 -- 3/4 -- 1/8
//!          f: 1/4                |      |      |
//!                                f ---- . ---- f
//!
//!        new, inside       old, inside, valence n         new, boundary       old, boundary
//! ```
//!
//! Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes", 1978.
//! On a grid of quads the limit surface is the bicubic B-spline of the vertices, and away from old
//! vertices of valence other than 4 and from the middles of faces that are not quads it has continuous
//! curvature. The boundary is a cubic B-spline curve that does not depend on the inside.
//!
//! The crate `subdivision` does the work, for this scheme and the others.

use op::prelude::*;
use subdivision::{Boundary, Creasing, FaceVarying, Rules, Scheme};

use crate::step::{Step, Until};

/// Cuts every face into quads and smooths, as often as `levels` says.
///
/// A level makes a quad for each corner of a face: C quads, 2 E + C edges and V + E + F vertices out of F
/// faces with C corners, E edges and V vertices, so V - E + F stays. Edge e becomes edges 2e and 2e + 1, the
/// quads of a face follow those of the face before, old vertices keep their numbers, the vertex on edge e
/// is V + e and the center of face f is V + E + f.
///
/// Vertex attributes are smoothed with the weights of the positions; texture coordinates and other
/// corner values as `face_varying` says, so that seams stay seams; halves of an edge and parts of a face
/// take the values of the whole. Normals are dropped, because they would be wrong. Edges and vertices that
/// `Crease` made sharp stay so for as many levels as their sharpness says.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CatmullClark {
    /// How often: each level makes a quad of every corner of a face.
    /// 1 if nothing is said; with `until` the most levels that are allowed, 16 if nothing is said.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// When to stop, instead of after a number of levels.
    #[serde(default)]
    pub until: Option<Until>,
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
    /// Which faces are refined, with all that they become; all if nothing is said. Faces beside them
    /// get the new vertices as corners, and what lies outside does not move. The numbers of new elements are those of `subdivision::refine_faces`.
    #[serde(default)]
    pub faces: Option<FaceSelection>,
}

impl CatmullClark {
    fn step(&self) -> Step<'_> {
        Step {
            rules: Rules {
                scheme: Scheme::CatmullClark,
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

impl MeshOperation for CatmullClark {
    const NAME: &'static str = "CatmullClark";
    const SUMMARY: &'static str = "Cut every face into quads and smooth";
    const EXAMPLE: &'static str = "CatmullClark(levels: 0)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
