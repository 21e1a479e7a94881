//! The points of curves and patches.

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

use glam::{DVec2, DVec3};

/// A point or a vector, in 2D or 3D. The default is the origin.
pub trait Point:
    Copy
    + Debug
    + Default
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<f64, Output = Self>
{
    /// Whether all coordinates are finite.
    fn is_finite(self) -> bool;
}

impl Point for DVec2 {
    fn is_finite(self) -> bool {
        DVec2::is_finite(self)
    }
}

impl Point for DVec3 {
    fn is_finite(self) -> bool {
        DVec3::is_finite(self)
    }
}
