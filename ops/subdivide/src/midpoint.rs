//! Midpoint subdivision: cuts every face into smaller ones without moving anything.
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
//! The connectivity is that of Loop and of Catmull-Clark subdivision. Flat faces keep their plane, so the
//! surface stays what it was; it only has more faces, for a later step to move.
//!
//! The crate `subdivision` does the work, for this scheme and the others.

use op::prelude::*;
use subdivision::{Rules, Scheme, Split};

use crate::step::{Step, Until};

/// Cuts every face into smaller ones without moving anything, as often as `levels` says.
///
/// `into: Triangles` takes triangles only and makes 4 F triangles, 2 E + 3 F edges and V + E vertices out
/// of F, E and V. `into: Quads` takes any polygons and makes a quad for each corner: C quads, 2 E + C edges
/// and V + E + F vertices out of F faces with C corners. Old vertices keep their numbers and places, the
/// vertex on edge e is V + e, edge e becomes edges 2e and 2e + 1. Triangle f becomes faces 4f to 4f + 3; the
/// quads of a face follow those of the face before, and its center is V + E + f.
///
/// Vertex attributes are interpolated, and so are corner values, each within its own old face; halves of an
/// edge and parts of a face take the values of the whole, sharpness too. Normals are dropped.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Midpoint {
    /// How often: each level has about four times as many faces as the one before.
    /// 1 if nothing is said; with `until` the most levels that are allowed, 16 if nothing is said.
    #[serde(default)]
    pub levels: Option<Levels>,
    /// When to stop, instead of after a number of levels.
    #[serde(default)]
    pub until: Option<Until>,
    /// How faces are cut.
    #[serde(default)]
    pub into: Split,
    /// Which faces are refined, with all that they become; all if nothing is said. Triangles beside
    /// them are cut in two or four, other faces get the new vertices as corners. The numbers of new elements are those of `subdivision::refine_faces`.
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
    const SUMMARY: &'static str = "Cut every face into smaller ones without moving anything";
    const EXAMPLE: &'static str = "Midpoint(levels: 0)";

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        self.step().plan(Self::NAME, plan, cx)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        self.step().apply(mesh, cx)
    }
}
