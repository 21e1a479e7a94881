//! Midpoint subdivision: splits every face into smaller faces without moving vertices.
//!
//! ```text
//!            c                    d ---- z ---- c
//!          /   \                  |      |      |
//!         y --- x                 |      |      |        x, y, z, w: the middles of the edges
//!        / \   / \                w ---- m ---- y        m: the mean of the corners
//!       /   \ /   \               |      |      |
//!      a --- z --- b              |      |      |
//!                                 a ---- x ---- b
//!
//!     into: Triangles             into: Quads
//! ```
//!
//! The connectivity is the same as in Loop and Catmull-Clark subdivision. The parts of a flat face stay in its plane,
//! so a surface of flat faces keeps its shape. Only the number of faces increases, so that a later step can deform the
//! surface in more detail.
//!
//! The crate `subdivision` implements all subdivision schemes.

use op::prelude::*;
use subdivision::{Rules, Scheme, Split};

use crate::step::{Step, Until};

/// Splits every face into smaller faces without moving vertices. The step repeats this for every level.
///
/// With `into: Triangles`, all faces must be triangles. A level then turns V vertices, E edges and F triangles into V +
/// E vertices, 2 E + 3 F edges and 4 F triangles. Triangle f becomes faces 4f to 4f + 3. With `into: Quads`, faces can
/// have any number of corners, and each corner becomes a quad. A level then turns V vertices, E edges and F faces with
/// C corners in total into V + E + F vertices, 2 E + C edges and C quads. The quads are numbered in the order of the
/// old faces. The new vertex at the center of face f has the id V + E + f. In both cases, old vertices keep their ids
/// and positions, and the new vertex on edge e has the id V + e. Edge e becomes edges 2e and 2e + 1.
///
/// Vertex attributes are interpolated. Corner values are interpolated within each old face separately. When an edge or
/// a face is split, its parts copy its attribute values, including the sharpness of edges. Normals are dropped.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Midpoint {
    /// The number of levels. Each level multiplies the number of faces by about four. Without `until`, `levels`
    /// defaults to 1. With `until`, `levels` is the maximum number of levels and defaults to 16.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// The condition that ends the subdivision. If omitted, exactly `levels` levels are computed.
    #[serde(default)]
    pub until: Option<Until>,
    /// How faces are split.
    #[serde(default)]
    pub into: Split,
    /// The faces to refine. If omitted, all faces. With `into: Triangles`, triangles next to the refined faces are cut
    /// in two or four. With `into: Quads`, a face beside a refined face gets additional corners at the new vertices on
    /// their common edge. The documentation of the Rust function `subdivision::refine_faces` describes the ids of new
    /// elements.
    #[serde(default)]
    pub faces: Option<FaceSelection>,
}

impl Midpoint {
    fn step(&self) -> Step<'_> {
        Step {
            levels: self.levels,
            until: self.until,
            faces: self.faces.as_ref(),
            ..Step::new(Rules::of(Scheme::Midpoint(self.into)))
        }
    }
}

impl MeshOperation for Midpoint {
    const NAME: &'static str = "Midpoint";
    const SUMMARY: &'static str = "Split every face into smaller faces without moving vertices";
    const EXAMPLE: &'static str = "Midpoint(levels: 2, into: Quads)";
    const WORDS: &'static [&'static str] = &["subdivide", "tessellate"];

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
