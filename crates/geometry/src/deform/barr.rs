//! Bend, twist and taper.

use mesh::DVec3;

use crate::sin_cos_degrees;

/// The coordinate system of a deformation: an origin and three orthogonal unit vectors, which form a right-handed
/// system. The third vector is the axis. The height of a point is its coordinate along the axis. The amount of the
/// deformation changes only between the heights `from` and `to`. Points below the height `from` do not move. Points
/// above the height `to` move together as a rigid body; for [`Taper`], they are scaled by a constant factor instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The origin.
    pub origin: DVec3,
    /// The three unit vectors; the last one is the axis.
    pub axes: [DVec3; 3],
    /// The height at which the deformation starts.
    pub from: f64,
    /// The height at which the deformation reaches its full amount. This height is at least `from`.
    pub to: f64,
}

impl Frame {
    /// Converts a point from scene coordinates to the coordinates of this frame.
    fn local(&self, p: DVec3) -> DVec3 {
        let p = p - self.origin;
        DVec3::from_array(self.axes.map(|axis| axis.dot(p)))
    }

    /// Converts a point from the coordinates of this frame to scene coordinates.
    fn global(&self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        self.origin + p.x * x + p.y * y + p.z * z
    }

    /// Returns how much of the deformation applies at the given height: a number from 0 (nothing) to 1 (all of it). If
    /// `from` equals `to`, the number jumps from 0 to 1 at this height.
    fn part(&self, height: f64) -> f64 {
        if height <= self.from {
            0.0
        } else if height >= self.to {
            1.0
        } else {
            (height - self.from) / (self.to - self.from)
        }
    }
}

/// Rotates points around the axis, by an angle that changes with the height. A point (x, y, z) moves to
/// (x cos θ - y sin θ, x sin θ + y cos θ, z), where θ changes linearly from 0 at the height `from` to `angle` at the
/// height `to`. The twist preserves volume. The inverse of a twist is the twist by the opposite angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// The coordinate system, and the heights between which the angle changes.
    pub frame: Frame,
    /// The angle of rotation at the height `to`, in degrees.
    pub angle: f64,
}

impl Twist {
    /// Returns the new position of a point.
    pub fn point(&self, p: DVec3) -> DVec3 {
        let p = self.frame.local(p);
        let (s, c) = sin_cos_degrees(self.angle * self.frame.part(p.z));
        self.frame
            .global(DVec3::new(c * p.x - s * p.y, s * p.x + c * p.y, p.z))
    }
}

/// Scales points around the axis, by a factor that changes with the height. A point (x, y, z) moves to (s x, s y, z),
/// where s changes linearly from 1 at the height `from` to `factor` at the height `to`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taper {
    /// The coordinate system, and the heights between which the scale factor changes.
    pub frame: Frame,
    /// The scale factor at the height `to`.
    pub factor: f64,
}

impl Taper {
    /// Returns the scale factor at the given height.
    fn factor_at(&self, height: f64) -> f64 {
        let part = self.frame.part(height);
        (1.0 - part) + self.factor * part
    }

    /// Returns the new position of a point.
    pub fn point(&self, p: DVec3) -> DVec3 {
        let p = self.frame.local(p);
        let factor = self.factor_at(p.z);
        self.frame
            .global(DVec3::new(factor * p.x, factor * p.y, p.z))
    }
}

/// Bends the axis of the [`Frame`] into an arc of a circle, towards the first of the three unit vectors of the frame:
///
/// ```text
///     to    |                     .--  to      The axis keeps its length. d is z - from, clamped to [0, to - from].
///           |                   /              With θ = angle d / (to - from), a point moves to
///           |         -->      |                   x' = x cos θ + (1 - cos θ) / k + (z - from - d) sin θ
///     from  |                  |   from            z' = from - x sin θ + sin θ / k + (z - from - d) cos θ
///                                              where k = angle / (to - from) is the curvature, with the
///                                              angle in radians.
/// ```
///
/// Points at the height `from` or below do not move. Between the heights `from` and `to`, volumes are multiplied by 1 -
/// k x, where k is the curvature. The center of the circle is at x = 1 / k. For points beyond the center, the factor
/// 1 - k x is negative: there, the bent shape is turned inside out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The coordinate system, and the heights between which the axis is bent.
    pub frame: Frame,
    /// The angle between the directions of the bent axis at its two ends, in degrees. A negative angle bends the axis
    /// away from the first unit vector of the [`Frame`].
    pub angle: f64,
}

impl Bend {
    /// Returns the new position of a point.
    pub fn point(&self, p: DVec3) -> DVec3 {
        let Frame { from, to, .. } = self.frame;
        let p = self.frame.local(p);
        let part = self.frame.part(p.z);
        let length = part * (to - from);
        let beyond = p.z - from - length;
        let (s, c) = sin_cos_degrees(self.angle * part);
        // The bent part is an arc with the angle θ and the curvature k. Its chord forms the angle θ / 2 with the unbent
        // axis. The length of the chord is 2 sin(θ / 2) / k, which is `length` times a factor that tends to 1 for small
        // angles.
        let (half_sin, half_cos) = sin_cos_degrees(0.5 * self.angle * part);
        let half_angle = (0.5 * self.angle * part).to_radians();
        let chord = if half_angle == 0.0 {
            length
        } else {
            length * (half_sin / half_angle)
        };
        self.frame.global(DVec3::new(
            p.x * c + chord * half_sin + beyond * s,
            p.y,
            from - p.x * s + chord * half_cos + beyond * c,
        ))
    }
}
