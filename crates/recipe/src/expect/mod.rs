//! Expectations: what must hold for the scene after a step or at the end.

mod check;
mod output;
mod places;
mod same;
mod subject;
mod symmetry;

use std::fmt;

use mesh::Domain;
use op::{EdgeSelection, Elements, FaceSelection, Vector, VertexSelection};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub(crate) use output::golden;
pub(crate) use same::same_faces;
pub use subject::{ActualValue, Reader, Subject, Violation};
pub use symmetry::Group;

/// What must hold for a scene. Where it speaks of the mesh, it means all meshes together, or those of
/// the objects that `on:` names.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Expectation {
    /// How many objects there are.
    Objects {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many vertices; points of polylines count too.
    Vertices {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many edges.
    Edges {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many faces.
    Faces {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many connected parts.
    Components {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many holes.
    BoundaryLoops {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// V - E + F.
    EulerCharacteristic {
        /// Exactly this.
        eq: Option<i64>,
        /// At least this.
        min: Option<i64>,
        /// At most this.
        max: Option<i64>,
    },
    /// How many handles.
    Genus {
        /// Exactly so many.
        eq: Option<i64>,
        /// At least so many.
        min: Option<i64>,
        /// At most so many.
        max: Option<i64>,
    },
    /// The sum of the areas of the faces.
    Area {
        /// This, within the tolerance.
        eq: Option<f64>,
        /// At least this.
        min: Option<f64>,
        /// At most this.
        max: Option<f64>,
        /// How far from `eq` it may be.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The volume inside.
    Volume {
        /// This, within the tolerance.
        eq: Option<f64>,
        /// At least this.
        min: Option<f64>,
        /// At most this.
        max: Option<f64>,
        /// How far from `eq` it may be.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The lowest and highest coordinates of all points.
    Bounds {
        /// The lowest coordinates.
        min: Vector,
        /// The highest coordinates.
        max: Vector,
        /// How far each coordinate may be from that.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// There is a mesh, and every mesh is a valid manifold; so is each that this program builds, and
    /// this checks it anew. No two edges join the same vertices.
    Manifold,
    /// There is a mesh, and no edge is on a boundary.
    Closed,
    /// How many elements a selection has.
    Count {
        /// Which elements.
        of: Elements,
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// The valences of all vertices of a selection, which must not be empty.
    Valence {
        /// Which vertices.
        #[serde(default)]
        of: VertexSelection,
        /// The lowest is at least this.
        min: Option<u64>,
        /// The highest is at most this.
        max: Option<u64>,
    },
    /// The angles, in degrees, by which the faces turn at all edges of a selection that have two; there
    /// must be one.
    DihedralAngle {
        /// Which edges.
        #[serde(default)]
        of: EdgeSelection,
        /// The smallest is at least this.
        min: Option<f64>,
        /// The largest is at most this.
        max: Option<f64>,
        /// Some angle is at least this.
        reaches: Option<f64>,
    },
    /// The lengths, in scene units, of all edges of a selection, which must not be empty.
    EdgeLength {
        /// Which edges.
        #[serde(default)]
        of: EdgeSelection,
        /// The shortest is at least this.
        min: Option<f64>,
        /// The longest is at most this.
        max: Option<f64>,
    },
    /// The smallest corner angle, in degrees, of all faces of a selection, which must not be empty.
    MinAngle {
        /// Which faces.
        #[serde(default)]
        of: FaceSelection,
        /// At least this.
        min: Option<f64>,
        /// At most this.
        max: Option<f64>,
    },
    /// The mean area of the faces of a selection, in proportion to the median area of all faces.
    MeanFaceArea {
        /// Which faces.
        of: FaceSelection,
        /// At least this; 1 is the median.
        min: Option<f64>,
        /// At most this; 1 is the median.
        max: Option<f64>,
    },
    /// The place of the one vertex of a selection.
    Position {
        /// Which vertex.
        of: VertexSelection,
        /// Where it is.
        is: Vector,
        /// How far it may be from there.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The place of a point of a polyline.
    Point {
        /// Which polyline of the object, from 0.
        #[serde(default)]
        line: u32,
        /// Which of its points, from 0.
        index: u32,
        /// Where it is.
        is: Vector,
        /// How far it may be from there.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The mesh has the same vertices as another, up to their order, and the same faces.
    Same {
        /// The other.
        r#as: Other,
        /// How far vertices may lie apart.
        #[serde(default)]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
        /// Whether the faces must be the same too.
        #[serde(default = "yes")]
        connectivity: bool,
    },
    /// The largest distance between the surfaces of the mesh and another: the Hausdorff distance, both ways.
    /// What cannot be told from the limit does not hold.
    DistanceTo {
        /// The other.
        other: Other,
        /// Less than this.
        #[schemars(range(min = 0.0))]
        below: f64,
    },
    /// The mesh comes back onto itself under the motions of a group about the origin: under all of them
    /// unless a number is given.
    SymmetricUnder {
        /// The group.
        group: Group,
        /// Under exactly so many, the one that moves nothing included.
        eq: Option<u64>,
        /// Under at least so many.
        min: Option<u64>,
        /// Under at most so many.
        max: Option<u64>,
        /// How far a moved vertex may be from another one.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
        /// Whether faces must come onto faces too.
        #[serde(default = "yes")]
        connectivity: bool,
    },
    /// Every mesh has an attribute.
    HasAttribute {
        /// On what.
        domain: AttributeDomain,
        /// Of this name.
        name: String,
    },
    /// A file that a step writes is the same as one beside the recipe, which `meshwright test --update` makes and
    /// renews. Of pictures (.png, .apng) the pixels count, of meshes what is read; of other files the bytes. What a
    /// file says of where it comes from does not count.
    Output {
        /// The file that is written, seen from the output folder as in the step.
        path: String,
        /// The file that it is held against, seen from the recipe's folder and in it.
        r#as: String,
        /// By how many steps of 255 the colors of a picture may differ.
        #[serde(default)]
        tolerance: u8,
    },
    /// The digest of the scene, as `run` prints it.
    Digest(String),
    /// The contrary holds. What cannot be told, as about a file that cannot be read, does not.
    Not(Box<Self>),
}

/// Another mesh to compare with.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Other {
    /// An object of the scene.
    Object(String),
    /// The first mesh in a file, seen from the recipe's folder.
    File(String),
}

/// What an attribute belongs to.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum AttributeDomain {
    /// Vertices.
    Vertex,
    /// Corners.
    Corner,
    /// Edges.
    Edge,
    /// Faces.
    Face,
}

impl From<AttributeDomain> for Domain {
    fn from(domain: AttributeDomain) -> Self {
        match domain {
            AttributeDomain::Vertex => Self::Vertex,
            AttributeDomain::Corner => Self::Corner,
            AttributeDomain::Edge => Self::Edge,
            AttributeDomain::Face => Self::Face,
        }
    }
}

const fn tolerance() -> f64 {
    1e-9
}

const fn yes() -> bool {
    true
}

impl Expectation {
    /// What is wrong with the expectation itself: one that can never fail is an error.
    pub fn problem(&self) -> Option<&'static str> {
        let needs_bound = match self {
            Self::Objects { eq, min, max }
            | Self::Vertices { eq, min, max }
            | Self::Edges { eq, min, max }
            | Self::Faces { eq, min, max }
            | Self::Components { eq, min, max }
            | Self::BoundaryLoops { eq, min, max }
            | Self::Count { eq, min, max, .. } => eq.is_none() && min.is_none() && max.is_none(),
            Self::EulerCharacteristic { eq, min, max } | Self::Genus { eq, min, max } => {
                eq.is_none() && min.is_none() && max.is_none()
            }
            Self::Area { eq, min, max, .. } | Self::Volume { eq, min, max, .. } => {
                eq.is_none() && min.is_none() && max.is_none()
            }
            Self::Valence { min, max, .. } => min.is_none() && max.is_none(),
            Self::DihedralAngle {
                min, max, reaches, ..
            } => min.is_none() && max.is_none() && reaches.is_none(),
            Self::MeanFaceArea { min, max, .. }
            | Self::EdgeLength { min, max, .. }
            | Self::MinAngle { min, max, .. } => min.is_none() && max.is_none(),
            Self::Output {
                path, tolerance, ..
            } if *tolerance > 0 && !output::is_picture(path) => {
                return Some(
                    "a tolerance is for pictures whose pixels are compared: .png and .apng",
                );
            }
            Self::Not(inner) => return inner.problem(),
            _ => false,
        };
        needs_bound.then_some("it has no bound, so it can never fail")
    }

    /// The file that a step writes and the one beside the recipe, if it is about these.
    pub fn output(&self) -> Option<(&str, &str)> {
        match self {
            Self::Output { path, r#as, .. } => Some((path, r#as)),
            Self::Not(inner) => inner.output(),
            _ => None,
        }
    }

    /// The objects and files that it compares with.
    pub fn others(&self) -> Option<&Other> {
        match self {
            Self::Same { r#as, .. } => Some(r#as),
            Self::DistanceTo { other, .. } => Some(other),
            Self::Not(inner) => inner.others(),
            _ => None,
        }
    }
}

impl fmt::Display for Expectation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&ron::to_string(self).map_err(|_| fmt::Error)?)
    }
}

#[cfg(test)]
mod tests;
