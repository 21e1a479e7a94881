//! Expectations: conditions on the scene after a step or at the end of the recipe.

mod attribute;
mod check;
mod output;
mod placed;
mod places;
mod same;
mod subject;
mod symmetry;
mod text;
mod textures;
mod violation;

use std::fmt;

use mesh::Domain;
use op::{EdgeSelection, Elements, FaceSelection, Vector, VertexSelection};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub(crate) use attribute::values;
pub(crate) use output::golden;
pub(crate) use placed::PlacedSubject;
pub(crate) use same::same_faces;
pub use subject::{Reader, Subject};
pub use symmetry::Group;
pub use violation::{ActualValue, Violation};

/// A condition on a scene. The condition is checked for all meshes together, or only for the meshes of the objects that
/// `on:` names.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Expectation {
    /// The number of objects.
    Objects {
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The number of vertices, including the points of polylines, curves and patches.
    Vertices {
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The number of edges.
    Edges {
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The number of faces.
    Faces {
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The number of connected components.
    Components {
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The number of boundary loops: closed loops of boundary edges.
    BoundaryLoops {
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The Euler characteristic: vertices - edges + faces.
    EulerCharacteristic {
        /// Exactly this value.
        eq: Option<i64>,
        /// At least this value.
        min: Option<i64>,
        /// At most this value.
        max: Option<i64>,
    },
    /// The genus, which is the number of handles: 0 for a sphere, 1 for a torus.
    Genus {
        /// Exactly this number.
        eq: Option<i64>,
        /// At least this number.
        min: Option<i64>,
        /// At most this number.
        max: Option<i64>,
    },
    /// The sum of the areas of the faces of all meshes.
    Area {
        /// The value must equal this number within the tolerance.
        eq: Option<f64>,
        /// At least this value.
        min: Option<f64>,
        /// At most this value.
        max: Option<f64>,
        /// The allowed deviation from `eq`.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The enclosed volume, summed over all meshes.
    Volume {
        /// The value must equal this number within the tolerance.
        eq: Option<f64>,
        /// At least this value.
        min: Option<f64>,
        /// At most this value.
        max: Option<f64>,
        /// The allowed deviation from `eq`.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The bounding box of all points.
    Bounds {
        /// The lowest coordinates.
        min: Vector,
        /// The highest coordinates.
        max: Vector,
        /// The allowed deviation of each coordinate.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// There is at least one mesh. Every mesh is a valid manifold, and no two edges of a mesh join the same vertices.
    /// Meshes are always built as manifolds. The expectation `Manifold` checks the meshes once more.
    Manifold,
    /// There is at least one mesh, and no mesh has boundary edges.
    Closed,
    /// The number of elements that a selection matches.
    Count {
        /// Which elements.
        of: Elements,
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The valence (number of edges) of every selected vertex. Fails if the selection is empty.
    Valence {
        /// Which vertices.
        #[serde(default)]
        of: VertexSelection,
        /// Each valence is exactly this number.
        eq: Option<u64>,
        /// The lowest valence is at least this number.
        min: Option<u64>,
        /// The highest valence is at most this number.
        max: Option<u64>,
    },
    /// The dihedral angle of every selected edge between two faces, in degrees. The dihedral angle is the angle between
    /// the normals of the two faces: 0 if the faces are coplanar. Edges of a face with zero area are skipped. Fails if
    /// no selected edge has an angle.
    DihedralAngle {
        /// Which edges.
        #[serde(default)]
        of: EdgeSelection,
        /// The smallest angle is at least this value.
        min: Option<f64>,
        /// The largest angle is at most this value.
        max: Option<f64>,
        /// The largest angle is at least this value.
        reaches: Option<f64>,
    },
    /// The length, in scene units, of every selected edge. Fails if the selection is empty.
    EdgeLength {
        /// Which edges.
        #[serde(default)]
        of: EdgeSelection,
        /// The shortest edge has at least this length.
        min: Option<f64>,
        /// The longest edge has at most this length.
        max: Option<f64>,
    },
    /// The smallest corner angle, in degrees, of all selected faces. Fails if the selection is empty.
    MinAngle {
        /// Which faces.
        #[serde(default)]
        of: FaceSelection,
        /// At least this value.
        min: Option<f64>,
        /// At most this value.
        max: Option<f64>,
    },
    /// The smallest corner angle of each selected face, averaged over these faces, in degrees. The smallest corner
    /// angle of an equilateral triangle is 60. Fails if the selection is empty.
    MeanMinAngle {
        /// Which faces.
        #[serde(default)]
        of: FaceSelection,
        /// At least this value.
        min: Option<f64>,
        /// At most this value.
        max: Option<f64>,
    },
    /// The thickness of the solid at each selected vertex, in scene units. `Measure(of: Thickness, ..)` measures the
    /// thickness in the same way. The thickness is infinite where the surface has no opposite side, for example on an
    /// open sheet. Fails if the selection is empty.
    Thickness {
        /// Which vertices.
        #[serde(default)]
        of: VertexSelection,
        /// At least this value.
        min: Option<f64>,
        /// At most this value.
        max: Option<f64>,
    },
    /// The number of faces that intersect another face of the same object. Neighboring faces intersect only if they
    /// have points in common beyond their shared vertices and edges.
    SelfIntersections {
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// The mean area of the selected faces, divided by the median area of all faces. Fails if the selection
    /// is empty.
    MeanFaceArea {
        /// Which faces.
        of: FaceSelection,
        /// The ratio is at least this value.
        min: Option<f64>,
        /// The ratio is at most this value.
        max: Option<f64>,
    },
    /// The position of one vertex.
    Position {
        /// Which vertex. The selection must match exactly one vertex.
        of: VertexSelection,
        /// The expected position.
        is: Vector,
        /// The allowed distance from the expected position.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The position of one point of a polyline. The position is in object space, because the nodes of a scene place
    /// only meshes.
    Point {
        /// The index of the polyline in its object, starting at 0.
        #[serde(default)]
        line: u32,
        /// The index of the point in the polyline, starting at 0.
        index: u32,
        /// The expected position.
        is: Vector,
        /// The allowed distance from the expected position.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The mesh has the same vertices and faces as another mesh, in any order.
    Same {
        /// The mesh to compare with.
        r#as: OtherMesh,
        /// The allowed distance between two matching vertices.
        #[serde(default)]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
        /// Whether the faces of the two meshes must also be the same.
        #[serde(default = "yes")]
        connectivity: bool,
    },
    /// The two-sided Hausdorff distance between the surface of the mesh and the surface of another mesh. The Hausdorff
    /// distance is the largest distance from a point of either surface to the other surface. Fails unless the distance
    /// is proven to be below the limit `below`.
    DistanceTo {
        /// The mesh to compare with.
        other: OtherMesh,
        /// The distance must be below this limit, in scene units.
        #[schemars(range(min = 0.0))]
        below: f64,
    },
    /// The number of motions (rotations and reflections) that map the mesh onto itself. The motions belong to a
    /// symmetry group about the origin. If `eq`, `min` and `max` are omitted, all motions of the group must map the
    /// mesh onto itself.
    SymmetricUnder {
        /// The symmetry group.
        group: Group,
        /// Exactly this number of motions, including the identity.
        eq: Option<u64>,
        /// At least this number of motions.
        min: Option<u64>,
        /// At most this number of motions.
        max: Option<u64>,
        /// The allowed distance between a moved vertex and the vertex that it must match.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
        /// Whether each motion must also map every face onto a face.
        #[serde(default = "yes")]
        connectivity: bool,
    },
    /// The stretch of texture coordinates. A small circle on the surface becomes an ellipse in the texture. The stretch
    /// is the ratio of the axes of this ellipse: 1 where angles are preserved. The value of a mesh is the stretch that
    /// is not exceeded on 95 % of the surface area. If there are several meshes, the largest of their values is
    /// checked. Fails if no mesh has the texture coordinates.
    UvStretch {
        /// The name of the texture coordinates. Defaults to `uv`.
        #[serde(default = "uv")]
        uv: String,
        /// At most this value.
        #[schemars(range(min = 1.0))]
        max: f64,
    },
    /// The number of faces that overlap another face of the same mesh in the texture. Faces that only share corners or
    /// sides do not overlap. Fails if no mesh has the texture coordinates.
    UvOverlap {
        /// The name of the texture coordinates. Defaults to `uv`.
        #[serde(default = "uv")]
        uv: String,
        /// Exactly this number.
        eq: Option<u64>,
        /// At least this number.
        min: Option<u64>,
        /// At most this number.
        max: Option<u64>,
    },
    /// There is at least one mesh, and every mesh has this attribute.
    HasAttribute {
        /// The domain of the attribute.
        domain: AttributeDomain,
        /// The name of the attribute.
        name: String,
    },
    /// The values of an attribute, for example of an attribute that `Measure` stored. Every mesh must have the
    /// attribute. Fails if no element has a value.
    Attribute {
        /// The name of the attribute.
        name: String,
        /// Which elements. If omitted, all elements of the kind that has the attribute are checked. If several kinds
        /// have an attribute of this name, the first of these kinds is used: vertices, faces, corners, edges.
        of: Option<Elements>,
        /// The index of the component of a vector, starting at 0. Required for vectors.
        #[schemars(range(max = 3))]
        component: Option<u32>,
        /// Every value is at least this number.
        min: Option<f64>,
        /// Every value is at most this number.
        max: Option<f64>,
    },
    /// A file that a step writes is equal to a reference file. `meshwright test --update` creates and updates the
    /// reference file. Pictures (.png, .apng) are compared pixel by pixel. Mesh files are compared by the objects that
    /// are read from them, and all other files byte by byte. Differences in the recorded provenance, which says how the
    /// file was made, are ignored.
    Output {
        /// The path of the written file, relative to the output folder, as in the step that writes the file.
        path: String,
        /// The path of the reference file, relative to the recipe's folder. The file must be inside this folder.
        r#as: String,
        /// The allowed difference between the colors of two pictures, in steps of 1/255. Defaults to 0.
        #[serde(default)]
        tolerance: u8,
    },
    /// The digest of the scene, as `meshwright run` prints it.
    Digest(String),
    /// The inner expectation must not hold. `Not` also fails if the inner expectation cannot be checked, for example
    /// because a file cannot be read or a selection is empty.
    Not(Box<Self>),
}

/// The mesh with which an expectation such as `Same` compares the checked meshes.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum OtherMesh {
    /// The name of an object of the scene.
    Object(String),
    /// The first mesh in a file. The value is the path of the file, relative to the recipe's folder.
    File(String),
}

/// The kind of elements to which an attribute gives values.
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

fn uv() -> String {
    mesh::UV.name.to_owned()
}

const fn yes() -> bool {
    true
}

impl Expectation {
    /// Returns an error if the expectation is invalid for every scene. An expectation that can never fail is invalid,
    /// too.
    pub fn problem(&self) -> Option<&'static str> {
        let needs_bound = match self {
            Self::Objects { eq, min, max }
            | Self::Vertices { eq, min, max }
            | Self::Edges { eq, min, max }
            | Self::Faces { eq, min, max }
            | Self::Components { eq, min, max }
            | Self::BoundaryLoops { eq, min, max }
            | Self::SelfIntersections { eq, min, max }
            | Self::UvOverlap { eq, min, max, .. }
            | Self::Count { eq, min, max, .. }
            | Self::Valence { eq, min, max, .. } => eq.is_none() && min.is_none() && max.is_none(),
            Self::EulerCharacteristic { eq, min, max } | Self::Genus { eq, min, max } => {
                eq.is_none() && min.is_none() && max.is_none()
            }
            Self::Area { eq, min, max, .. } | Self::Volume { eq, min, max, .. } => {
                eq.is_none() && min.is_none() && max.is_none()
            }
            Self::DihedralAngle {
                min, max, reaches, ..
            } => min.is_none() && max.is_none() && reaches.is_none(),
            Self::MeanFaceArea { min, max, .. }
            | Self::EdgeLength { min, max, .. }
            | Self::MinAngle { min, max, .. }
            | Self::MeanMinAngle { min, max, .. }
            | Self::Thickness { min, max, .. }
            | Self::Attribute { min, max, .. } => min.is_none() && max.is_none(),
            Self::Output {
                path, tolerance, ..
            } if *tolerance > 0 && !output::is_picture(path) => {
                return Some("`tolerance` applies only to pictures: .png and .apng");
            }
            Self::Not(inner) => return inner.problem(),
            _ => false,
        };
        needs_bound.then_some("the expectation has no bound, so it can never fail")
    }

    /// If this is an `Output` expectation, returns the paths of the written file and of the reference file.
    pub fn output(&self) -> Option<(&str, &str)> {
        match self {
            Self::Output { path, r#as, .. } => Some((path, r#as)),
            Self::Not(inner) => inner.output(),
            _ => None,
        }
    }

    /// If the expectation is not about objects and therefore does not take `on`, returns its name.
    pub(crate) fn without_objects(&self) -> Option<&'static str> {
        match self {
            Self::Digest(_) => Some("Digest"),
            Self::Output { .. } => Some("Output"),
            Self::Not(inner) => inner.without_objects(),
            _ => None,
        }
    }

    /// Returns the mesh with which the expectation compares the checked meshes, if there is one.
    pub fn other_mesh(&self) -> Option<&OtherMesh> {
        match self {
            Self::Same { r#as, .. } => Some(r#as),
            Self::DistanceTo { other, .. } => Some(other),
            Self::Not(inner) => inner.other_mesh(),
            _ => None,
        }
    }
}

impl fmt::Display for Expectation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&op::to_ron(self))
    }
}

#[cfg(test)]
mod tests;
