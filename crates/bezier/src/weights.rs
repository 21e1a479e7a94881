//! The weights 1 - t and t of a parameter t. If a curve is reversed, the two weights are exchanged, bit for bit.

use crate::Point;

/// The weights 1 - t and t of the two ends of a leg.
///
/// Both weights of a parameter t are stored. If only one weight were stored, the result would depend on the direction
/// of the curve, because 1 - t is rounded. With [`Weights::ratio`], evaluating a curve at i/n and the reversed curve at
/// (n - i)/n gives the same products. The products are added in the opposite order, which does not change any bit of
/// the sum. Therefore, two patches that share a boundary have the same samples on this boundary, even if the direction
/// of the boundary differs between the patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weights {
    /// 1 - t.
    pub(crate) s: f64,
    /// t.
    pub(crate) t: f64,
}

impl Weights {
    /// Returns the weights at `t`.
    pub(crate) fn at(t: f64) -> Self {
        Self { s: 1.0 - t, t }
    }

    /// Returns the weights at i/n. `n` must not be 0, and `i` must not exceed `n`.
    pub(crate) fn ratio(i: u32, n: u32) -> Self {
        let count = f64::from(n);
        Self {
            s: f64::from(n - i) / count,
            t: f64::from(i) / count,
        }
    }

    /// Returns s a + t b, where s = 1 - t.
    pub(crate) fn blend<P: Point>(self, a: P, b: P) -> P {
        a * self.s + b * self.t
    }

    /// Returns 0 at the start of a curve (t = 0), 1 at its end (t = 1), and `None` for any other t.
    ///
    /// At an end of the curve, the point is a control point, which is returned without arithmetic. Arithmetic could
    /// turn a coordinate -0 into 0, depending on the other control points.
    pub(crate) fn end(self) -> Option<usize> {
        if self.t == 0.0 {
            Some(0)
        } else if self.s == 0.0 {
            Some(1)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_from_the_other_end_are_exchanged() {
        for n in [1, 3, 10, 49, 1000] {
            for i in 0..=n {
                let (forward, backward) = (Weights::ratio(i, n), Weights::ratio(n - i, n));
                assert_eq!((forward.s, forward.t), (backward.t, backward.s));
                assert!((forward.s + forward.t - 1.0).abs() <= f64::EPSILON);
            }
        }
    }

    #[test]
    fn only_zero_and_one_are_ends() {
        let ends = [0.0, -0.0, 1.0, 0.5, -1.0, f64::NAN].map(|t| Weights::at(t).end());
        assert_eq!(ends, [Some(0), Some(0), Some(1), None, None, None]);
    }
}
