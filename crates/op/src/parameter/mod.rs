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
    PositiveFactor, PositiveLength,
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
/// Checks a parameter that must lie between 0 and 1, neither included.
///
/// # Errors
///
/// A message that names the parameter, `field`, and its value.
pub fn check_fraction(field: &str, value: f64) -> Result<(), String> {
    if value > 0.0 && value < 1.0 {
        Ok(())
    } else {
        Err(format!("`{field}` must lie between 0 and 1, not {value}"))
    }
}
