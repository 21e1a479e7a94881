//! The schemes and their options.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A scheme and its options. Only Loop and Catmull-Clark use the options. The next level depends only on the rules and
/// the mesh; for Sqrt3, it also depends on the index of the level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// The scheme.
    pub scheme: Scheme,
    /// How vertices on the boundary move.
    pub boundary: Boundary,
    /// How the sharpness of creases decreases from level to level.
    pub creasing: Creasing,
    /// How corner values, for example texture coordinates, are smoothed.
    pub face_varying: FaceVarying,
}

impl Rules {
    /// Returns the rules of a scheme, with default options.
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
    /// Smooth: splits each triangle into four. Source: Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987.
    Loop(LoopWeights),
    /// Smooth: splits each face into quads. Source: Catmull and Clark, "Recursively generated B-spline surfaces on
    /// arbitrary topological meshes", 1978.
    CatmullClark,
    /// Linear: new vertices lie in the middle of edges and faces, and old vertices stay in place.
    Midpoint(Split),
    /// Smooth: splits each triangle into four, and the surface passes through the old vertices. Source: Zorin, Schröder
    /// and Sweldens, "Interpolating Subdivision for Meshes with Arbitrary Topology", 1996.
    Butterfly,
    /// Smooth: splits each triangle into three and flips the old edges. Source: Kobbelt, "√3-Subdivision", 2000.
    Sqrt3,
    /// Smooth: makes one face from each old vertex, each old edge and each old face. Source: Doo and Sabin, "Behaviour
    /// of recursive division surfaces near extraordinary points", 1978.
    DooSabin,
}

/// The weight u of each of the n neighbors of an old vertex in Loop subdivision. The weight of the vertex itself
/// is 1 - n u.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum LoopWeights {
    /// The weight u of a neighbor is 3/16 if the vertex has n = 3 neighbors, and otherwise 3/(8n). Source: Warren,
    /// "Subdivision Methods for Geometric Design", 1995.
    #[default]
    Warren,
    /// If the vertex has n neighbors, the weight u of a neighbor is (5/8 - (3/8 + cos(2π/n)/4)²)/n, as in Loop's
    /// thesis, 1987.
    Loop,
}

/// How midpoint subdivision splits faces.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum Split {
    /// Splits each triangle into four. Fails if a face is not a triangle.
    #[default]
    Triangles,
    /// Splits each face with n corners into n quads around its center.
    Quads,
}

/// How vertices on the boundary move. `EdgesOnly` and `EdgesAndCorners` correspond to the rules `EDGE_ONLY` and
/// `EDGE_AND_CORNER` of OpenSubdiv.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum Boundary {
    /// The boundary becomes a smooth curve that depends on boundary vertices only.
    #[default]
    EdgesOnly,
    /// Like `EdgesOnly`, but boundary vertices with one face stay in place.
    EdgesAndCorners,
    /// Boundary vertices stay in place, and each new vertex on the boundary lies in the middle of an old boundary edge.
    Fixed,
}

/// How the sharpness of an edge decreases from one level of the subdivision to the next. Only a sharpness above 0 and
/// below 10 decreases. A sharpness of 10 or more never decreases.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum Creasing {
    /// The sharpness decreases by 1. Source: DeRose, Kass and Truong, "Subdivision Surfaces in Character
    /// Animation", 1998.
    #[default]
    Uniform,
    /// The sharpness is averaged with the sharpness of the neighboring edges of the crease, then decreases by 1. So
    /// sharpness varies smoothly along a crease. This is OpenSubdiv's Chaikin rule, with one difference. A level
    /// divides each edge into two halves. Suppose that an edge has a sharpness above 1, and that one of its halves gets
    /// the sharpness 0. Then the new vertex between the halves lies in the middle of the edge, while OpenSubdiv moves
    /// this vertex beyond the middle.
    Chaikin,
}

/// How corner values, such as texture coordinates, are subdivided at seams. A seam is an edge whose two sides have
/// different values. The names are those of OpenSubdiv's face-varying linear interpolation rules.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum FaceVarying {
    /// Values are smoothed everywhere. Along a seam, values are smoothed as along the boundary of the mesh.
    None,
    /// Like `None`, but a value at a vertex stays unchanged if only one face at this vertex has the value.
    CornersOnly,
    /// Like `CornersOnly`, but values also stay unchanged at a vertex with three or more different values. At a vertex
    /// with two different values, each value belongs to a set of faces. Both values stay unchanged if one of these sets
    /// is not contiguous, or if a sharp edge runs between two faces of the same set.
    CornersPlus1,
    /// Like `CornersPlus1`, but values also stay unchanged at the ends of seams. If one value at a vertex stays
    /// unchanged, all values at this vertex stay unchanged.
    CornersPlus2,
    /// Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
    Boundaries,
    /// Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
    #[default]
    All,
}

impl Scheme {
    /// Returns the name of the scheme for messages. The name starts with a capital letter.
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

    /// Whether the scheme takes triangles only.
    pub const fn needs_triangles(self) -> bool {
        matches!(
            self,
            Self::Loop(_) | Self::Midpoint(Split::Triangles) | Self::Butterfly | Self::Sqrt3
        )
    }

    /// Whether [`limit`](crate::limit()) supports the scheme.
    pub const fn has_limit(self) -> bool {
        self.has_creases()
    }

    /// Whether the sharpness of edges and vertices shapes the surface.
    pub(crate) const fn has_creases(self) -> bool {
        matches!(self, Self::Loop(_) | Self::CatmullClark)
    }
}
