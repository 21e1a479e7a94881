//! Catmull-Clark subdivision: splits every face into quads and smooths the surface.
//!
//! ```text
//!    d ----------- c          d ---- . ---- c
//!    |             |          |      |      |
//!    |             |          |  3   |  2   |         f: the new vertex in a face
//!    |      f      |   --->   . ---- f ---- .         e: the new vertex on an edge
//!    |             |          |  0   |  1   |         0, 1, ..: a quad at each corner
//!    |             |          |      |      |
//!    a ----------- b          a ---- e ---- b
//! ```
//!
//! The new vertex in a face is the mean of the corners of the face. All other vertices are weighted means of old
//! vertices and of the new vertices in faces:
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
//! Source: Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes", 1978. On a
//! grid of quads the limit surface is the bicubic B-spline of the vertices. The limit surface has continuous curvature
//! except at old vertices whose valence is not 4 and at the centers of faces that are not quads. The boundary is a
//! cubic B-spline curve that depends on boundary vertices only.
//!
//! The crate `subdivision` implements all subdivision schemes.

use op::prelude::*;
use subdivision::{Boundary, Creasing, FaceVarying, Rules, Scheme};

use crate::step::{Step, Until};

/// Splits every face into quads and smooths the surface. The step repeats this for every level.
///
/// Each level creates one quad at each corner of each old face. A level turns V vertices, E edges and F faces with C
/// corners in total into V + E + F vertices, 2 E + C edges and C quads. The Euler characteristic V - E + F does not
/// change. Old vertices keep their ids. The vertex on edge e has the id V + e, and the vertex at the center of face f
/// has the id V + E + f. Edge e becomes edges 2e and 2e + 1. The quads are numbered face by face, in the order of the
/// old faces. The quads of an old face are in the order of the corners of this face.
///
/// Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner values
/// are smoothed as the parameter `face_varying` specifies, and seams are kept. When an edge or a face is split, its
/// parts copy its attribute values, such as tags and materials. Normals are dropped, because they would be wrong. If an
/// edge or a vertex has the sharpness s (see `Crease`), it stays sharp for s levels.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CatmullClark {
    /// The number of levels. Each level replaces every corner of a face with a quad. Without `until`, `levels` defaults
    /// to 1. With `until`, `levels` is the maximum number of levels and defaults to 16.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// The condition that ends the subdivision. If omitted, exactly `levels` levels are computed.
    #[serde(default)]
    pub until: Option<Until>,
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
    /// The faces to refine. If omitted, all faces. A face beside a refined face gets additional corners at the new
    /// vertices on their common edge. The surface outside the refined faces does not move. The documentation of the
    /// Rust function `subdivision::refine_faces` describes the ids of new elements.
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
    const SUMMARY: &'static str = "Split every face into quads and smooth the surface";
    const EXAMPLE: &'static str = "CatmullClark(levels: 2)";
    const WORDS: &'static [&'static str] = &["smooth", "subdivide", "subdivision", "catmull"];

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
