//! Parameter types that operations share.
//!
//! The range of a parameter is part of its type. If a value is outside its range, reading the recipe fails. Operations
//! therefore do not check the range again. The JSON schema of a number contains its range.

mod number;
mod turn;
mod vector;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use number::{
    Angle, AngleBetween, ClosedFraction, Count, Distance, Fraction, Length, Levels, Number,
    OutOfRange, PositiveFactor, PositiveLength, Seconds, Sharpness,
};
pub use turn::Turn;
pub use vector::{BadVector, Direction, Factors, Vector};

/// One of the three coordinate axes.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Axis {
    /// The x axis.
    X,
    /// The y axis.
    Y,
    /// The z axis.
    Z,
}
