//! What to do with polygons that make no clean mesh.

/// What to do with polygons that make no clean mesh.
///
/// Two things need no choice: a corner that repeats the one before it is taken once (`f 1 2 2 3` is a
/// triangle), and a face that still visits a vertex twice is left out, because no mesh has it. Whatever is done is counted in a
/// [`Note`](crate::Note) with its elements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policies {
    /// Edges with more than two faces, vertices that join faces which share no edge.
    pub non_manifold: NonManifold,
    /// Neighbors that run the same way along the edge between them.
    pub orientation: Orientation,
    /// Faces with the same vertices in the same circular order, either way round.
    pub duplicates: Duplicates,
    /// Faces without area.
    pub degenerate: Degenerate,
    /// Vertices that no face uses.
    pub isolated: Isolated,
}

/// What to do where faces do not form a manifold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NonManifold {
    /// Split edges and vertices until they do.
    #[default]
    Split,
    /// Fail.
    Refuse,
}

/// What to do where neighboring faces disagree about their orientation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Orientation {
    /// Turn faces round where that makes neighbors agree.
    #[default]
    Orient,
    /// Leave every face as it is; neighbors that disagree are no manifold.
    Keep,
}

/// What to do with a face that is there already.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Duplicates {
    /// Keep each.
    #[default]
    Keep,
    /// Keep the first.
    Drop,
}

/// What to do with faces without area: below 1e-14 of the square of their longest side, which is what
/// rounding leaves of zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Degenerate {
    /// Keep them.
    #[default]
    Keep,
    /// Leave them out.
    Drop,
}

/// What to do with vertices that no face uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Isolated {
    /// Keep them.
    #[default]
    Keep,
    /// Leave them out.
    Drop,
}
