//! What can be wrong with the input of this crate.

use thiserror::Error;

use crate::Counts;

/// Why a curve, a patch or a tessellation was refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum BezierError {
    /// A curve without control points.
    #[error("expected at least one control point, found none")]
    NoPoints,
    /// A curve with more control points than [`MAX_POINTS`](crate::MAX_POINTS).
    #[error("expected at most {} control points, found {count}", crate::MAX_POINTS)]
    TooManyPoints {
        /// How many there were.
        count: usize,
    },
    /// A coordinate that is infinite or no number. In a patch, `index` is 4 * row + column.
    #[error("expected finite coordinates, but control point {index} has an infinity or a NaN")]
    NotFinite {
        /// The place of the control point, from 0.
        index: usize,
    },
    /// A coordinate of a patch beyond [`MAX_COORDINATE`](crate::MAX_COORDINATE).
    /// `index` is 4 * row + column.
    #[error(
        "expected coordinates up to {:e} in magnitude, but control point {index} has a larger one",
        crate::MAX_COORDINATE
    )]
    TooLarge {
        /// The place of the control point, from 0.
        index: usize,
    },
    /// A control point was asked for that is not there.
    #[error("expected a control point below {count}, found {index}")]
    NoSuchPoint {
        /// The place that was asked for, from 0.
        index: usize,
        /// How many control points there are.
        count: usize,
    },
    /// A tessellation with no segments.
    #[error("expected at least 1 segment per side, found 0")]
    NoSegments,
    /// A tessellation that does not fit ids of 32 bits. Numbers beyond 64 bits are given as the
    /// largest that fits.
    #[error(
        "expected at most {} of each, found {} vertices, {} faces and {} face corners",
        u32::MAX, .0.vertices, .0.faces, .0.corners
    )]
    TooManyElements(Counts),
    /// The system has no memory for a tessellation of this size.
    #[error("not enough memory for {} vertices and {} faces", .0.vertices, .0.faces)]
    OutOfMemory(Counts),
}
