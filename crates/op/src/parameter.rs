//! Types of parameters that operations share.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A point or a direction: `(x, y, z)`, in scene units.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Vector(pub f64, pub f64, pub f64);

impl From<Vector> for DVec3 {
    fn from(v: Vector) -> Self {
        Self::new(v.0, v.1, v.2)
    }
}

impl From<DVec3> for Vector {
    fn from(v: DVec3) -> Self {
        Self(v.x, v.y, v.z)
    }
}

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
