//! Types of parameters that operations share.
//!
//! A parameter that has a range has it in its type: a value outside is refused when the recipe is read, its
//! schema says so, and an operation never checks it again.

mod number;
mod turn;
mod vector;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use number::{
    Angle, AngleBetween, ClosedFraction, Count, Distance, Fraction, Length, Levels, OutOfRange,
    PositiveFactor, PositiveLength, Seconds, Sharpness,
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
