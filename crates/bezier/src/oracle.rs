//! The Bernstein form of curves and patches: a test oracle that shares no code with de Casteljau's
//! algorithm.
//!
//! ```text
//! c(t) = sum of p_i B(n, i)(t),   B(n, i)(t) = binomial(n, i) t^i (1 - t)^(n - i)
//! B(n, i)'(t) = n (B(n - 1, i - 1)(t) - B(n - 1, i)(t))
//! ```
//!
//! Source: Farin, "Curves and Surfaces for CAGD", 5th edition, 2002, §5.1 and §5.3.

use glam::DVec3;

/// Returns the Bernstein polynomial B(n, i) at `t`, or 0 if i is not from 0 to n.
pub(crate) fn weight(n: i32, i: i32, t: f64) -> f64 {
    if i < 0 || i > n {
        return 0.0;
    }
    let binomial = (0..i).fold(1.0, |b, k| b * f64::from(n - k) / f64::from(k + 1));
    let power = |x: f64, k: i32| (0..k).fold(1.0, |product, _| product * x);
    binomial * power(t, i) * power(1.0 - t, n - i)
}

/// Returns the derivative of the Bernstein polynomial B(n, i) at `t`.
pub(crate) fn weight_derivative(n: i32, i: i32, t: f64) -> f64 {
    f64::from(n) * (weight(n - 1, i - 1, t) - weight(n - 1, i, t))
}

/// Returns the point at `t` of the curve with control points `points`.
pub(crate) fn point(points: &[DVec3], t: f64) -> DVec3 {
    sum(points, |n, i| weight(n, i, t))
}

/// Returns the derivative at `t` of the curve with control points `points`.
pub(crate) fn derivative(points: &[DVec3], t: f64) -> DVec3 {
    sum(points, |n, i| weight_derivative(n, i, t))
}

/// For the patch with control points `points`, returns the point and the derivatives with respect to u and v.
pub(crate) fn patch(points: &[[DVec3; 4]; 4], u: f64, v: f64) -> [DVec3; 3] {
    let rows = points.map(|row| point(&row, u));
    let slopes = points.map(|row| derivative(&row, u));
    [point(&rows, v), point(&slopes, v), derivative(&rows, v)]
}

/// Returns the sum of the products of point i and `weight(n, i)`, where n is the degree: the number of points minus
/// one.
fn sum(points: &[DVec3], weight: impl Fn(i32, i32) -> f64) -> DVec3 {
    let n = i32::try_from(points.len()).unwrap() - 1;
    (0..=n).zip(points).map(|(i, &p)| p * weight(n, i)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_sum_to_one_and_their_derivatives_to_zero() {
        for n in 0..12 {
            for t in [0.0, 0.2, 0.5, 0.9, 1.0] {
                let total: f64 = (0..=n).map(|i| weight(n, i, t)).sum();
                let slope: f64 = (0..=n).map(|i| weight_derivative(n, i, t)).sum();
                assert!((total - 1.0).abs() < 1e-14 && slope.abs() < 1e-12);
            }
        }
    }
}
