//! Policies, which decide how a reader handles polygons that do not form a clean mesh.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How to handle polygons that do not form a clean mesh, for example because some edges have more than two faces.
///
/// Repeated vertices in a face are always handled in the same way. A corner that repeats the vertex of the previous
/// corner is removed: `f 1 2 2 3` is a triangle. A face that still contains a vertex twice is left out, because a mesh
/// cannot represent such a face. Every change is reported as a [`Note`](crate::Note) with the affected elements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policies {
    /// How to handle edges with more than two faces, and vertices at which groups of faces meet without a common edge.
    pub non_manifold: NonManifold,
    /// How to handle neighboring faces with opposite orientations, which traverse their common edge in the same
    /// direction.
    pub orientation: Orientation,
    /// How to handle faces with the same vertices as an earlier face, in the same or the opposite circular order.
    pub duplicates: CleanupPolicy,
    /// How to handle faces with zero area. Because of rounding errors, an area counts as zero if it is at most 1e-14
    /// times the square of the longest side.
    pub degenerate: CleanupPolicy,
    /// How to handle vertices without a face.
    pub isolated: CleanupPolicy,
}

/// How to handle edges and vertices at which faces do not form a manifold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum NonManifold {
    /// Split edges and vertices until the faces form a manifold, and list the splits in the report.
    #[default]
    Split,
    /// Refuse to read the file.
    Refuse,
}

/// How to handle neighboring faces with opposite orientations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Orientation {
    /// If possible, reverse faces so that neighboring faces have the same orientation, and list the reversed faces in
    /// the report.
    #[default]
    Orient,
    /// Keep the orientation of every face. An edge between faces with opposite orientations counts as non-manifold.
    Keep,
}

/// How the nodes of a file place its meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Placements {
    /// Keep the nodes. Each mesh becomes one object in its own space, and any number of nodes can place this object in
    /// the scene.
    #[default]
    Keep,
    /// Apply the transforms of the nodes to the points of the meshes. Each node with a mesh becomes an object. The
    /// hierarchy, cameras, lights and animations are left out.
    Bake,
}

/// How to handle elements that are probably not needed, such as duplicate faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum CleanupPolicy {
    /// Keep the elements.
    #[default]
    Keep,
    /// Leave the elements out, and list them in the report. Of several duplicate faces, the first face is kept.
    Drop,
}
