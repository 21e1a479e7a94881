//! Bicubic Bezier patches.
//!
//! ```text
//!   v                                   each row of control points is the control polygon
//!   ^   p30 -- p31 -- p32 -- p33        of a cubic in u; the points of these four cubics at u
//!   |    |      |      |      |         are the control polygon of a cubic in v
//!   |   p20 -- p21 -- p22 -- p23
//!   |    |      |      |      |         prc: row r, column c
//!   |   p10 -- p11 -- p12 -- p13        (u, v) = (0, 0) at p00, (1, 0) at p03,
//!   |    |      |      |      |                  (0, 1) at p30, (1, 1) at p33
//!   |   p00 -- p01 -- p02 -- p03
//!   +---------------------------> u     the normal du x dv points at the reader
//! ```
//!
//! Source: Farin, "Curves and Surfaces for CAGD", 5th edition, 2002, chapter 14.

use glam::{DVec2, DVec3};

use crate::BezierError;
use crate::normal::{self, size};
use crate::weights::Weights;

/// The largest magnitude of a coordinate of a [`Patch`].
///
/// This limit is far larger than the coordinates of any model (the largest `f32` is 3.4e38), but small enough that
/// products of two derivatives do not overflow.
pub const MAX_COORDINATE: f64 = 1e100;

/// A bicubic Bezier patch: a surface in two parameters, u along the rows of its control points
/// and v across them.
///
/// Every function also accepts parameters outside the range from 0 to 1, and continues the polynomials of the patch
/// there. If a parameter is NaN, the resulting point has NaN coordinates and the normal is zero; no function panics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    points: [[DVec3; 4]; 4],
}

impl Patch {
    /// Creates a patch from its control points, `points[row][column]`.
    ///
    /// # Errors
    ///
    /// Returns [`BezierError::NotFinite`] or [`BezierError::TooLarge`] for the first control point with an invalid
    /// coordinate: a coordinate that is not finite, or a coordinate whose magnitude exceeds [`MAX_COORDINATE`].
    #[expect(
        clippy::large_types_passed_by_value,
        reason = "the constructor stores the points"
    )]
    pub fn new(points: [[DVec3; 4]; 4]) -> Result<Self, BezierError> {
        for (index, p) in points.as_flattened().iter().enumerate() {
            if !p.is_finite() {
                return Err(BezierError::NotFinite { index });
            }
            if size(*p) > MAX_COORDINATE {
                return Err(BezierError::TooLarge { index });
            }
        }
        Ok(Self { points })
    }

    /// Returns the control points, `points[row][column]`.
    pub fn points(&self) -> &[[DVec3; 4]; 4] {
        &self.points
    }

    /// Returns the patch with u and v exchanged: the same surface with reversed normals.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let p = &self.points;
        Self {
            points: [0, 1, 2, 3].map(|c| [p[0][c], p[1][c], p[2][c], p[3][c]]),
        }
    }

    /// Returns the point at (`u`, `v`). Evaluates each row of control points at u. The four resulting points are the
    /// control points of a cubic, which is evaluated at v.
    ///
    /// On the boundary of the patch, the result is equal bit for bit to the point of the boundary curve. The control
    /// points of the boundary curve are the first or last row or column of the patch. At a corner of the patch, the
    /// result is a control point.
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.point_at(Weights::at(u), Weights::at(v))
    }

    /// Returns the derivatives with respect to u and v at (`u`, `v`), not normalized.
    pub fn derivatives(&self, u: f64, v: f64) -> (DVec3, DVec3) {
        self.derivatives_at(Weights::at(u), Weights::at(v))
    }

    /// Returns the unit normal at (`u`, `v`), in the direction of du x dv.
    ///
    /// If du x dv is zero, as at the pole of a surface of revolution, returns the limit of the normals at nearby points
    /// inside the patch. The module [`normal`](mod@crate::normal) explains how the limit is computed. Returns zero only
    /// if the patch has no normal anywhere near the point, for example if the patch is a curve or a point.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        self.normal_at(Weights::at(u), Weights::at(v), self.max_steps())
    }

    /// Returns the point at the parameters u and v. Each parameter t is given by its weights 1 - t and t.
    pub(crate) fn point_at(&self, u: Weights, v: Weights) -> DVec3 {
        cubic(self.points.map(|row| cubic(row, u)), v)
    }

    /// Returns the normal at the parameters u and v. Each parameter t is given by its weights 1 - t and t. `max_steps`
    /// is the result of [`Patch::max_steps`].
    pub(crate) fn normal_at(&self, u: Weights, v: Weights, max_steps: DVec2) -> DVec3 {
        if max_steps.x == 0.0 || max_steps.y == 0.0 {
            return DVec3::ZERO;
        }
        let (du, dv) = self.derivatives_at(u, v);
        normal::unit((du / max_steps.x).cross(dv / max_steps.y))
            .or_else(|| normal::limit(&self.expansion(u, v), max_steps, DVec2::new(u.t, v.t)))
            .unwrap_or(DVec3::ZERO)
    }

    /// Returns the largest coordinate difference between neighboring control points, along u and along v.
    ///
    /// To decide whether a normal is treated as zero, the derivatives are first divided by these differences.
    pub(crate) fn max_steps(&self) -> DVec2 {
        let along = |patch: &Self| {
            let pairs = patch.points.iter().flat_map(|row| row.windows(2));
            pairs
                .map(|pair| size(pair[1] - pair[0]))
                .fold(0.0, f64::max)
        };
        DVec2::new(along(self), along(&self.transposed()))
    }

    /// Returns the derivatives at the parameters u and v. Each parameter t is given by its weights 1 - t and t.
    fn derivatives_at(&self, u: Weights, v: Weights) -> (DVec3, DVec3) {
        let du = cubic(self.points.map(|row| slope(row, u)), v);
        let dv = slope(self.points.map(|row| cubic(row, u)), v);
        (du, dv)
    }

    /// Returns the Taylor coefficients c of the patch at (u, v): the point at (u + x, v + y) is the sum of c\[i\]\[j\]
    /// x^i y^j.
    fn expansion(&self, u: Weights, v: Weights) -> [[DVec3; 4]; 4] {
        let rows = self.points.map(|row| taylor(row, u));
        [0, 1, 2, 3].map(|i| taylor(rows.map(|coefficients| coefficients[i]), v))
    }
}

/// Returns the point of the cubic curve with control points `p`, at the parameter with weights `w`.
pub(crate) fn cubic(p: [DVec3; 4], w: Weights) -> DVec3 {
    match w.end() {
        Some(0) => p[0],
        Some(_) => p[3],
        None => quadratic([0, 1, 2].map(|i| w.blend(p[i], p[i + 1])), w),
    }
}

/// Returns the point of the quadratic curve with control points `p`.
fn quadratic(p: [DVec3; 3], w: Weights) -> DVec3 {
    w.blend(w.blend(p[0], p[1]), w.blend(p[1], p[2]))
}

/// Returns the derivative of the cubic curve with control points `p`.
fn slope(p: [DVec3; 4], w: Weights) -> DVec3 {
    quadratic([p[1] - p[0], p[2] - p[1], p[3] - p[2]], w) * 3.0
}

/// Returns the Taylor coefficients of a cubic. Coefficient k is the derivative of order k divided by k!.
///
/// The derivative of order k is computed from the k-th differences of the control points (Farin 2002,
/// §5.3).
fn taylor(p: [DVec3; 4], w: Weights) -> [DVec3; 4] {
    let first = [p[1] - p[0], p[2] - p[1], p[3] - p[2]];
    let second = [first[1] - first[0], first[2] - first[1]];
    let third = second[1] - second[0];
    [
        cubic(p, w),
        quadratic(first, w) * 3.0,
        w.blend(second[0], second[1]) * 3.0,
        third,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Lcg, assert_close};
    use crate::oracle;

    #[test]
    fn points_and_derivatives_agree_with_the_bernstein_form() {
        let mut random = Lcg::new(11);
        for _ in 0..20 {
            let patch = random.patch();
            for _ in 0..20 {
                let (u, v) = (random.unit(), random.unit());
                let [point, by_u, by_v] = oracle::patch(patch.points(), u, v);
                let (du, dv) = patch.derivatives(u, v);
                assert_close(patch.point(u, v), point, 1e-12);
                assert_close(du, by_u, 1e-12);
                assert_close(dv, by_v, 1e-12);
                assert_close(patch.normal(u, v), by_u.cross(by_v).normalize(), 1e-10);
            }
        }
    }

    #[test]
    fn corners_are_control_points_and_u_runs_along_a_row() {
        let patch = Lcg::new(12).patch();
        let p = patch.points();

        assert_eq!(patch.point(0.0, 0.0), p[0][0]);
        assert_eq!(patch.point(1.0, 0.0), p[0][3]);
        assert_eq!(patch.point(0.0, 1.0), p[3][0]);
        assert_eq!(patch.point(1.0, 1.0), p[3][3]);
    }

    #[test]
    fn the_taylor_expansion_continues_the_patch() {
        let patch = Lcg::new(13).patch();
        let (u, v, x, y) = (0.3, 0.8, 0.4_f64, -0.7_f64);
        let mut sum = DVec3::ZERO;
        for (row, x) in patch
            .expansion(Weights::at(u), Weights::at(v))
            .iter()
            .zip(powers(x))
        {
            for (&c, y) in row.iter().zip(powers(y)) {
                sum += c * x * y;
            }
        }
        assert_close(sum, patch.point(u + x, v + y), 1e-12);
    }

    fn powers(x: f64) -> [f64; 4] {
        [1.0, x, x * x, x * x * x]
    }

    #[test]
    fn transposing_reverses_normals_and_keeps_points() {
        let patch = Lcg::new(14).patch();
        let transposed = patch.transposed();

        assert_close(transposed.point(0.2, 0.7), patch.point(0.7, 0.2), 1e-14);
        assert_close(transposed.normal(0.2, 0.7), -patch.normal(0.7, 0.2), 1e-12);
        assert_eq!(transposed.transposed(), patch);
    }

    #[test]
    fn errors_for_bad_control_points_have_their_index() {
        let mut points = *Lcg::new(15).patch().points();
        points[2][1].y = -1e101;
        assert_eq!(Patch::new(points), Err(BezierError::TooLarge { index: 9 }));
        points[1][3].z = f64::INFINITY;
        assert_eq!(Patch::new(points), Err(BezierError::NotFinite { index: 7 }));
    }

    #[test]
    fn infinite_and_nan_parameters_never_panic() {
        let patch = Lcg::new(16).patch();
        for t in [f64::NAN, f64::INFINITY, f64::MAX, -f64::MAX] {
            let _ = (patch.point(t, 0.5), patch.derivatives(0.5, t));
            let normal = patch.normal(t, 0.5);
            assert!(normal == DVec3::ZERO || normal.is_normalized());
        }
        assert_eq!(patch.normal(f64::NAN, 0.5), DVec3::ZERO);
    }
}
