//! The errors of this crate.

use thiserror::Error;

use crate::Counts;

/// Why a curve or a patch could not be created, or a tessellation could not be computed.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum BezierError {
    /// The curve has no control points.
    #[error("expected at least one control point, found none")]
    NoPoints,
    /// The curve has more control points than [`MAX_POINTS`](crate::MAX_POINTS).
    #[error("expected at most {} control points, found {count}", crate::MAX_POINTS)]
    TooManyPoints {
        /// The number of control points.
        count: usize,
    },
    /// A coordinate is infinite or not a number. In a patch, `index` is 4 * row + column.
    #[error(
        "expected finite coordinates, but a coordinate of control point {index} is infinite or NaN"
    )]
    NotFinite {
        /// The index of the control point, from 0.
        index: usize,
    },
    /// The magnitude of a coordinate of a patch exceeds [`MAX_COORDINATE`](crate::MAX_COORDINATE). `index` is
    /// 4 * row + column.
    #[error(
        "expected coordinates with a magnitude of at most {:e}, but control point {index} has a larger coordinate",
        crate::MAX_COORDINATE
    )]
    TooLarge {
        /// The index of the control point, from 0.
        index: usize,
    },
    /// The requested control point does not exist.
    #[error("expected a control point index below {count}, found {index}")]
    NoSuchPoint {
        /// The requested index, from 0.
        index: usize,
        /// The number of control points.
        count: usize,
    },
    /// The number of segments of a tessellation is 0.
    #[error("expected at least 1 segment for each side of a patch, found 0")]
    NoSegments,
    /// The tessellation would have more elements than there are 32-bit ids. A count that exceeds 64 bits is
    /// replaced by the largest 64-bit number.
    #[error(
        "expected at most {} elements of each kind, found {} vertices, {} faces and {} face corners",
        u32::MAX, .0.vertices, .0.faces, .0.corners
    )]
    TooManyElements(Counts),
    /// There is not enough memory for a tessellation of this size.
    #[error("not enough memory for {} vertices and {} faces", .0.vertices, .0.faces)]
    OutOfMemory(Counts),
}
