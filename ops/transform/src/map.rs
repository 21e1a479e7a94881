//! The map that the parameters describe: where points and normals go.

use glam::{DMat3, DVec3};
use op::Axis;

use crate::{Transform, Turn};

/// p -> L (p - center) + center + shift, where L scales and then turns.
pub(crate) struct Map {
    linear: DMat3,
    turns: DMat3,
    scale: DVec3,
    shift: DVec3,
}

impl Map {
    /// The map of parameters that are valid.
    pub(crate) fn new(transform: &Transform) -> Self {
        let scale = DVec3::from(transform.scale);
        let mut turns = DMat3::IDENTITY;
        for turn in &transform.rotate {
            turns = rotation(turn) * turns;
        }
        Self {
            linear: turns * DMat3::from_diagonal(scale),
            turns,
            scale,
            shift: transform.translate.into(),
        }
    }

    /// Where a point goes.
    pub(crate) fn point(&self, p: DVec3, center: DVec3) -> DVec3 {
        if self.only_moves() {
            // Without the rounding of p - center + center.
            return p + self.shift;
        }
        self.linear * (p - center) + center + self.shift
    }

    /// Where a unit normal goes: zero stays zero.
    ///
    /// By the inverse transpose of R S, which is R S^-1 (Turkowski, "Properties of Surface-Normal
    /// Transformations", 1990). Only the direction counts: the smallest factor that matters
    /// multiplies S^-1, so that nothing overflows and not everything underflows.
    pub(crate) fn normal(&self, n: DVec3) -> DVec3 {
        let zero = n.cmpeq(DVec3::ZERO);
        if zero.all() {
            return DVec3::ZERO;
        }
        let smallest = DVec3::select(zero, DVec3::INFINITY, self.scale.abs()).min_element();
        let inverse = DVec3::select(zero, DVec3::ZERO, smallest / self.scale);
        let turned = self.turns * (n * inverse);
        (turned / turned.abs().max_element()).normalize()
    }

    /// Whether points are neither scaled nor turned.
    pub(crate) fn only_moves(&self) -> bool {
        self.linear == DMat3::IDENTITY
    }

    /// The z coordinate of all points of the plane z = 0 afterwards, or `None` if they differ.
    pub(crate) fn height_of_plane(&self, center: DVec3) -> Option<f64> {
        let level = self.linear.x_axis.z == 0.0 && self.linear.y_axis.z == 0.0;
        level.then(|| self.point(DVec3::new(center.x, center.y, 0.0), center).z)
    }
}

/// The matrix of one turn, counter-clockwise for someone towards whom the axis points.
fn rotation(turn: &Turn) -> DMat3 {
    let (s, c) = sin_cos(turn.degrees);
    let [x, y, z] = match turn.axis {
        Axis::X => [DVec3::X, DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c)],
        Axis::Y => [DVec3::new(c, 0.0, -s), DVec3::Y, DVec3::new(s, 0.0, c)],
        Axis::Z => [DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z],
    };
    DMat3::from_cols(x, y, z)
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
                rotation(&Turn {
                    axis,
                    degrees: 90.0
                }) * from,
                to
            );
        }
    }
}
