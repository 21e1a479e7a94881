//! Turns around the coordinate axes.

use glam::{DMat3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Axis;

/// One turn around an axis.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The direction of the axis.
    pub axis: Axis,
    /// How far, counter-clockwise for someone towards whom the axis points. Multiples of 90 are exact.
    pub degrees: f64,
}

impl Turn {
    /// The matrix of the turn.
    pub fn matrix(self) -> DMat3 {
        let (s, c) = sin_cos(self.degrees);
        let [x, y, z] = match self.axis {
            Axis::X => [DVec3::X, DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c)],
            Axis::Y => [DVec3::new(c, 0.0, -s), DVec3::Y, DVec3::new(s, 0.0, c)],
            Axis::Z => [DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z],
        };
        DMat3::from_cols(x, y, z)
    }

    /// The matrix of several turns, one after the other.
    pub fn all(turns: &[Self]) -> DMat3 {
        turns
            .iter()
            .fold(DMat3::IDENTITY, |before, turn| turn.matrix() * before)
    }
}

/// Sine and cosine of an angle in degrees, exact for multiples of 90.
fn sin_cos(degrees: f64) -> (f64, f64) {
    let degrees = degrees % 360.0; // the remainder is exact
    match degrees.abs() {
        0.0 => (0.0, 1.0),
        90.0 => (degrees.signum(), 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-degrees.signum(), 0.0),
        _ => libm::sincos(degrees.to_radians()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_have_exact_sines_and_cosines() {
        let quarters = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
        for k in -9..=9 {
            let exact = quarters[usize::try_from(i32::rem_euclid(k, 4)).unwrap()];
            assert_eq!(sin_cos(90.0 * f64::from(k)), exact, "{k} quarters");
        }
    }

    #[test]
    fn other_angles_lie_on_the_circle() {
        for degrees in [1.0, 30.0, -45.0, 89.999_999, 1e6, -1e300] {
            let (s, c) = sin_cos(degrees);
            assert!((s * s + c * c - 1.0).abs() < 1e-15);
        }
        assert!((sin_cos(30.0).0 - 0.5).abs() < 1e-15);
    }

    #[test]
    fn turns_follow_the_right_hand() {
        for (axis, from, to) in [
            (Axis::X, DVec3::Y, DVec3::Z),
            (Axis::Y, DVec3::Z, DVec3::X),
            (Axis::Z, DVec3::X, DVec3::Y),
        ] {
            assert_eq!(
                Turn {
                    axis,
                    degrees: 90.0
                }
                .matrix()
                    * from,
                to
            );
        }
    }
}
