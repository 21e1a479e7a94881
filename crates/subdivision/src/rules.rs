//! What can be chosen about a subdivision surface.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A scheme with its choices: all that decides what one level of a mesh looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// The scheme.
    pub scheme: Scheme,
    /// What holds where the mesh ends.
    pub boundary: Boundary,
    /// How the sharpness of creases decreases.
    pub creasing: Creasing,
    /// How corner values such as texture coordinates are smoothed.
    pub face_varying: FaceVarying,
}

impl Rules {
    /// A scheme with the default choices.
    pub const fn of(scheme: Scheme) -> Self {
        Self {
            scheme,
            boundary: Boundary::EdgesOnly,
            creasing: Creasing::Uniform,
            face_varying: FaceVarying::All,
        }
    }
}

/// A subdivision scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Triangles into four, smooth: Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987.
    Loop(LoopWeights),
    /// Polygons into quads, smooth: Catmull and Clark, "Recursively generated B-spline surfaces on
    /// arbitrary topological meshes", 1978.
    CatmullClark,
    /// Linear: new vertices in the middle, old ones stay.
    Midpoint(Split),
    /// Triangles into four, through the old vertices: Zorin, Schröder and Sweldens, "Interpolating
    /// Subdivision for Meshes with Arbitrary Topology", 1996.
    Butterfly,
    /// Triangles into three, turned: Kobbelt, "√3-Subdivision", 2000.
    Sqrt3,
    /// A face for each old vertex, edge and face: Doo and Sabin, "Behaviour of recursive division
    /// surfaces near extraordinary points", 1978.
    DooSabin,
}

/// The weight u of each of the n neighbors of an old vertex in Loop subdivision; the vertex itself keeps
/// 1 - n u.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum LoopWeights {
    /// 3/16 for n = 3, otherwise 3/(8n): Warren, "Subdivision Methods for Geometric Design", 1995.
    #[default]
    Warren,
    /// (5/8 - (3/8 + cos(2π/n)/4)²)/n: Loop's own, 1987.
    Loop,
}

/// How a linear scheme cuts faces.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum Split {
    /// Every triangle into four; other faces are refused.
    #[default]
    Triangles,
    /// Every face with n corners into n quads around its center.
    Quads,
}

/// What holds where the mesh ends. The words are OpenSubdiv's, where these are the rules of boundary
/// interpolation.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum Boundary {
    /// The boundary is a smooth curve that depends on itself alone.
    #[default]
    EdgesOnly,
    /// As `EdgesOnly`, and vertices with one face stay where they are.
    EdgesAndCorners,
    /// Vertices of the boundary stay where they are; new ones lie in the middle of their edges.
    Fixed,
}

/// How the sharpness of an edge decreases from one level to the next, where it is above 0 and below 10.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum Creasing {
    /// By 1: DeRose, Kass and Truong, "Subdivision Surfaces in Character Animation", 1998.
    #[default]
    Uniform,
    /// By 1 from a mean with the neighbors along the crease, so that sharpness that changes along a
    /// crease changes smoothly: OpenSubdiv's rule after Chaikin's curves. (Where one half of an edge of
    /// sharpness above 1 becomes smooth, the new vertex stays in the middle; OpenSubdiv's goes beyond.)
    Chaikin,
}

/// How corner values are subdivided around a vertex, where seams divide them. The words are OpenSubdiv's,
/// where these are the rules of face-varying linear interpolation.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum FaceVarying {
    /// Smoothed everywhere, along seams as along a boundary.
    None,
    /// As `None`, but sharp where a piece has a single face at a vertex.
    CornersOnly,
    /// As `CornersOnly`, and sharp where three or more pieces meet.
    CornersPlus1,
    /// As `CornersPlus1`, and sharp at the ends of seams, and in all pieces at a vertex where one is.
    CornersPlus2,
    /// Linear along seams and boundaries, smooth elsewhere.
    Boundaries,
    /// Linear everywhere: each new value is a mean within its own old face.
    #[default]
    All,
}

impl Scheme {
    /// Its name, as sentences begin with.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Loop(_) => "Loop subdivision",
            Self::CatmullClark => "Catmull-Clark subdivision",
            Self::Midpoint(_) => "Midpoint subdivision",
            Self::Butterfly => "Butterfly subdivision",
            Self::Sqrt3 => "Sqrt3 subdivision",
            Self::DooSabin => "Doo-Sabin subdivision",
        }
    }

    /// Whether it takes triangles only.
    pub const fn needs_triangles(self) -> bool {
        matches!(
            self,
            Self::Loop(_) | Self::Midpoint(Split::Triangles) | Self::Butterfly | Self::Sqrt3
        )
    }

    /// Whether its limit surface is known in closed form.
    pub const fn has_limit(self) -> bool {
        self.has_creases()
    }

    /// Whether sharpness shapes its surfaces.
    pub(crate) const fn has_creases(self) -> bool {
        matches!(self, Self::Loop(_) | Self::CatmullClark)
    }
}
