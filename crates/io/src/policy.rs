//! What to do with polygons that make no clean mesh.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What to do with polygons that make no clean mesh.
///
/// Two things need no choice: a corner that repeats the one before it is taken once (`f 1 2 2 3` is a
/// triangle), and a face that still visits a vertex twice is left out, because no mesh has it. Whatever is
/// done is counted in a [`Note`](crate::Note) with its elements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policies {
    /// Edges with more than two faces, vertices that join faces which share no edge.
    pub non_manifold: NonManifold,
    /// Neighbors that run the same way along the edge between them.
    pub orientation: Orientation,
    /// Faces with the same vertices as an earlier one in the same circular order, either way round.
    pub duplicates: CleanupPolicy,
    /// Faces without area: below 1e-14 of the square of their longest side, which is what rounding leaves
    /// of zero.
    pub degenerate: CleanupPolicy,
    /// Vertices that no face uses.
    pub isolated: CleanupPolicy,
}

/// What to do where faces do not form a manifold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum NonManifold {
    /// Split edges and vertices until they do, and list it.
    #[default]
    Split,
    /// Fail.
    Refuse,
}

/// What to do where neighboring faces disagree about their orientation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Orientation {
    /// Reverse faces where that makes neighbors agree, and list them.
    #[default]
    Orient,
    /// Leave every face as it is. Neighbors that disagree form no manifold.
    Keep,
}

/// What to do with elements that may be of no use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum CleanupPolicy {
    /// Keep them.
    #[default]
    Keep,
    /// Leave them out, and list them. Of duplicates the first stays.
    Drop,
}
