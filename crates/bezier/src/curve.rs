//! Bezier curves of any degree, by de Casteljau's algorithm.
//!
//! ```text
//!        p1 ---- q1 ------ p2          p: control points (level 0)
//!       /      /    \        \         q: level 1
//!      /      r0--m--r1       \        r: level 2
//!     /      /         \       \       m: level 3, the point of the curve
//!    q0 ----'           '------ q2
//!   /                             \    the points of each level divide the legs of the
//! p0                               p3  level before in the ratio t : 1 - t
//! ```
//!
//! Sources: Farin, "Curves and Surfaces for CAGD", 5th edition, 2002, chapters 4 and 5;
//! de Casteljau, "Outillages méthodes calcul", Citroën, 1959.

use crate::weights::Weights;
use crate::{BezierError, Point};

/// The largest number of control points of a [`Curve`].
///
/// For n control points, all levels of de Casteljau's algorithm together have n (n + 1) / 2 points. With at most
/// `MAX_POINTS` control points, one evaluation takes at most about 8 million steps, and [`Curve::levels`] takes at most
/// about 200 MB of memory.
pub const MAX_POINTS: usize = 4096;

/// A Bezier curve of degree n, given by n + 1 control points.
///
/// The curve starts at the first control point (t = 0) and ends at the last (t = 1). At its ends, the curve is tangent
/// to the first and the last leg of the control polygon; a leg joins two consecutive control points. For t from 0 to 1,
/// the curve is inside the convex hull of the control points. Every function also accepts parameters outside the range
/// from 0 to 1, and continues the polynomial of the curve there. If the parameter is NaN, all results that depend on it
/// have NaN coordinates; no function panics.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<P> {
    /// The control points: at least one, at most [`MAX_POINTS`].
    points: Vec<P>,
}

impl<P: Point> Curve<P> {
    /// Creates a curve from its control points, first to last.
    ///
    /// # Errors
    ///
    /// Returns [`BezierError::NoPoints`] if the list is empty, and [`BezierError::TooManyPoints`] if it has more than
    /// [`MAX_POINTS`] points. Returns [`BezierError::NotFinite`] for the first point that is not finite.
    pub fn new(points: Vec<P>) -> Result<Self, BezierError> {
        if points.is_empty() {
            return Err(BezierError::NoPoints);
        }
        if points.len() > MAX_POINTS {
            return Err(BezierError::TooManyPoints {
                count: points.len(),
            });
        }
        match points.iter().position(|p| !p.is_finite()) {
            Some(index) => Err(BezierError::NotFinite { index }),
            None => Ok(Self { points }),
        }
    }

    /// Returns the control points, first to last. A curve has at least one control point.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// Returns the degree: the number of control points minus one.
    pub fn degree(&self) -> usize {
        self.points.len() - 1
    }

    /// Returns a copy of the curve in which control point `index` is moved to `point`.
    ///
    /// # Errors
    ///
    /// Returns [`BezierError::NoSuchPoint`] if the control point does not exist, and [`BezierError::NotFinite`] if
    /// `point` is not finite.
    pub fn with_point(&self, index: usize, point: P) -> Result<Self, BezierError> {
        if index >= self.points.len() {
            return Err(BezierError::NoSuchPoint {
                index,
                count: self.points.len(),
            });
        }
        let mut points = self.points.clone();
        points[index] = point;
        Self::new(points)
    }

    /// Returns all levels of de Casteljau's algorithm at `t`. The number of levels is the degree plus 1.
    ///
    /// The first level consists of the control points. Each level has one point fewer than the previous level. The last
    /// level has one point: the point of the curve at `t`.
    pub fn levels(&self, t: f64) -> Vec<Vec<P>> {
        let mut levels = vec![self.points.clone()];
        for k in 0..self.degree() {
            levels.push(one_step(&levels[k], t));
        }
        levels
    }

    /// Returns the point of the curve at `t`. At 0, the point is exactly the first control point; at 1, it is
    /// exactly the last.
    pub fn point(&self, t: f64) -> P {
        casteljau(self.points.clone(), Weights::at(t))
    }

    /// Returns the derivative of the curve at `t`. The derivative is zero if the degree is 0.
    ///
    /// The derivative is n times the Bezier curve of the differences of the control points (Farin 2002, §5.3).
    pub fn derivative(&self, t: f64) -> P {
        let n = self.degree() as f64;
        let differences = self.points.windows(2).map(|pair| (pair[1] - pair[0]) * n);
        match differences.collect::<Vec<P>>() {
            differences if differences.is_empty() => P::default(),
            differences => casteljau(differences, Weights::at(t)),
        }
    }

    /// Returns the n + 1 points of the curve at the parameters i/n for i from 0 to n, where n is `segments`. The first
    /// and the last point are exactly the first and the last control point.
    ///
    /// For 0 segments, returns only the start point. If the order of the control points is reversed, the function
    /// returns the same points in reverse order, equal bit for bit.
    pub fn sample(&self, segments: u32) -> impl Iterator<Item = P> {
        let points = &self.points;
        (0..=segments).map(move |i| match i {
            0 => points[0],
            i => casteljau(points.clone(), Weights::ratio(i, segments)),
        })
    }
}

/// Performs one step of de Casteljau's algorithm: computes (1 - t) a + t b for each pair of neighbors a, b.
///
/// The returned list has one point fewer than `points`. If `points` has at most one point, the list is empty.
pub fn one_step<P: Point>(points: &[P], t: f64) -> Vec<P> {
    let weights = Weights::at(t);
    points
        .windows(2)
        .map(|pair| weights.blend(pair[0], pair[1]))
        .collect()
}

/// Returns a point of the curve with the control points `points`: the only point of the last level of de Casteljau's
/// algorithm. `points` must not be empty.
fn casteljau<P: Point>(mut points: Vec<P>, weights: Weights) -> P {
    if let Some(end) = weights.end() {
        return points[end * (points.len() - 1)];
    }
    for remaining in (1..points.len()).rev() {
        for i in 0..remaining {
            points[i] = weights.blend(points[i], points[i + 1]);
        }
    }
    points[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Lcg, assert_close};
    use crate::oracle;
    use glam::{DVec2, DVec3};

    /// Returns random curves of degree 0 to 12.
    fn curves(seed: u64) -> Vec<Curve<DVec3>> {
        let mut random = Lcg::new(seed);
        (1..=13)
            .map(|n| Curve::new((0..n).map(|_| random.point()).collect()).unwrap())
            .collect()
    }

    #[test]
    fn points_and_derivatives_agree_with_the_bernstein_form() {
        let mut random = Lcg::new(1);
        for curve in curves(2) {
            for _ in 0..50 {
                let t = random.unit();
                assert_close(curve.point(t), oracle::point(curve.points(), t), 1e-12);
                assert_close(
                    curve.derivative(t),
                    oracle::derivative(curve.points(), t),
                    1e-12,
                );
            }
        }
    }

    #[test]
    fn the_ends_equal_the_end_control_points_bit_for_bit() {
        let points = vec![
            DVec2::new(-0.0, 0.1),
            DVec2::new(3.0, 0.7),
            DVec2::new(0.3, -0.0),
        ];
        let curve = Curve::new(points.clone()).unwrap();
        let samples: Vec<DVec2> = curve.sample(7).collect();

        assert_eq!(samples.len(), 8);
        for (p, q) in [(samples[0], points[0]), (samples[7], points[2])] {
            assert_eq!(
                p.to_array().map(f64::to_bits),
                q.to_array().map(f64::to_bits)
            );
        }
        assert_eq!((curve.point(0.0), curve.point(1.0)), (points[0], points[2]));
    }

    #[test]
    fn each_level_has_one_point_less_and_the_last_is_the_point_of_the_curve() {
        let points = [[0.0, 0.0], [0.0, 4.0], [4.0, 4.0]].map(DVec2::from_array);
        let levels = Curve::new(points.to_vec()).unwrap().levels(0.5);

        assert_eq!(levels.iter().map(Vec::len).collect::<Vec<_>>(), [3, 2, 1]);
        assert_eq!(levels[0], points);
        assert_eq!(levels[1], [DVec2::new(0.0, 2.0), DVec2::new(2.0, 4.0)]);
        assert_eq!(levels[2], [DVec2::new(1.0, 3.0)]);
    }

    #[test]
    fn an_affine_map_commutes_with_evaluation() {
        let map = glam::DAffine3::from_mat3_translation(
            glam::DMat3::from_cols_array(&[1.0, 2.0, 0.0, -1.0, 0.5, 3.0, 0.25, 0.0, -2.0]),
            DVec3::new(5.0, -3.0, 2.0),
        );
        for curve in curves(5) {
            let points = curve
                .points()
                .iter()
                .map(|&p| map.transform_point3(p))
                .collect();
            let moved = Curve::new(points).unwrap();
            for t in [0.1, 0.37, 0.5, 0.93] {
                assert_close(moved.point(t), map.transform_point3(curve.point(t)), 1e-12);
            }
        }
    }

    #[test]
    fn the_curve_is_inside_the_bounding_box_of_its_control_points() {
        for curve in curves(6) {
            let low = curve.points().iter().copied().reduce(DVec3::min).unwrap();
            let high = curve.points().iter().copied().reduce(DVec3::max).unwrap();
            let margin = DVec3::splat(1e-14);
            for p in curve.sample(100) {
                assert!(p.cmpge(low - margin).all() && p.cmple(high + margin).all());
            }
        }
    }

    #[test]
    fn the_derivative_is_the_limit_of_difference_quotients() {
        let h = 1e-5;
        for curve in curves(7) {
            for t in [0.0, 0.3, 0.77, 1.0] {
                let quotient = (curve.point(t + h) - curve.point(t - h)) / (2.0 * h);
                assert_close(curve.derivative(t), quotient, 1e-7);
            }
        }
    }

    #[test]
    fn the_reversed_curve_gives_the_same_samples_bit_for_bit() {
        for curve in curves(8) {
            let reversed = Curve::new(curve.points().iter().rev().copied().collect()).unwrap();
            for n in [1, 3, 7, 49, 100] {
                let forward: Vec<DVec3> = curve.sample(n).collect();
                let backward: Vec<DVec3> = reversed.sample(n).collect();
                for (p, q) in forward.iter().zip(backward.iter().rev()) {
                    assert_eq!(
                        p.to_array().map(f64::to_bits),
                        q.to_array().map(f64::to_bits)
                    );
                }
            }
        }
    }

    #[test]
    fn moving_a_control_point_moves_the_curve_by_its_bernstein_weight() {
        let curve = &curves(9)[5];
        let shift = DVec3::new(0.0, 2.0, 0.0);
        let moved = curve.with_point(2, curve.points()[2] + shift).unwrap();

        let weight = oracle::weight(5, 2, 0.4);
        assert_close(moved.point(0.4) - curve.point(0.4), shift * weight, 1e-12);
    }

    #[test]
    fn bad_points_are_refused() {
        let nan = DVec2::new(0.0, f64::NAN);
        let curve = Curve::new(vec![DVec2::ZERO, DVec2::ONE]).unwrap();

        assert_eq!(Curve::<DVec2>::new(vec![]), Err(BezierError::NoPoints));
        assert_eq!(
            Curve::new(vec![DVec2::ZERO, nan]),
            Err(BezierError::NotFinite { index: 1 })
        );
        assert_eq!(
            Curve::new(vec![DVec2::ZERO; MAX_POINTS + 1]),
            Err(BezierError::TooManyPoints {
                count: MAX_POINTS + 1
            })
        );
        assert_eq!(
            curve.with_point(0, nan),
            Err(BezierError::NotFinite { index: 0 })
        );
        assert_eq!(
            curve.with_point(2, DVec2::ONE),
            Err(BezierError::NoSuchPoint { index: 2, count: 2 })
        );
    }

    #[test]
    fn infinite_and_nan_parameters_never_panic() {
        for curve in curves(10) {
            for t in [
                f64::NAN,
                f64::INFINITY,
                f64::NEG_INFINITY,
                f64::MAX,
                -f64::MAX,
            ] {
                let (_, _, _) = (curve.point(t), curve.derivative(t), curve.levels(t));
            }
        }
    }

    #[test]
    fn one_step_of_one_point_is_empty() {
        assert!(one_step(&[DVec2::ONE], 0.5).is_empty());
        assert!(one_step::<DVec2>(&[], 0.5).is_empty());
        assert_eq!(
            one_step(&[DVec2::ZERO, DVec2::ONE], 0.25),
            [DVec2::splat(0.25)]
        );
    }
}
