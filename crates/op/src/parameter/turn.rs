//! Rotations around the coordinate axes.

use geometry::sin_cos_degrees;
use glam::{DMat3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Angle, Axis};

/// A rotation around an axis.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The direction of the axis.
    pub axis: Axis,
    /// The angle of the rotation, in degrees. A positive angle is counter-clockwise if the axis points towards the
    /// viewer. Rotations by multiples of 90 degrees have no rounding errors.
    #[serde(alias = "degrees")]
    #[schemars(extend("aliases" = ["degrees"]))]
    pub angle: Angle,
}

impl Turn {
    /// Returns the rotation matrix.
    pub fn matrix(self) -> DMat3 {
        let (s, c) = sin_cos_degrees(self.angle.get());
        let [x, y, z] = match self.axis {
            Axis::X => [DVec3::X, DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c)],
            Axis::Y => [DVec3::new(c, 0.0, -s), DVec3::Y, DVec3::new(s, 0.0, c)],
            Axis::Z => [DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z],
        };
        DMat3::from_cols(x, y, z)
    }

    /// Returns the matrix of several rotations that are applied in the order of the list.
    pub fn all(turns: &[Self]) -> DMat3 {
        turns
            .iter()
            .fold(DMat3::IDENTITY, |before, turn| turn.matrix() * before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_follow_the_right_hand_rule() {
        for (axis, from, to) in [
            (Axis::X, DVec3::Y, DVec3::Z),
            (Axis::Y, DVec3::Z, DVec3::X),
            (Axis::Z, DVec3::X, DVec3::Y),
        ] {
            let angle = Angle::literal(90.0);
            assert_eq!(Turn { axis, angle }.matrix() * from, to);
        }
    }
}
