//! The weights of a parameter, symmetric in both directions of a curve.

use crate::Point;

/// The weights 1 - t and t of the two ends of a leg.
///
/// Both are kept, because computing one from the other is not symmetric in floating point. With
/// the pairs of [`Weights::ratio`], walking i/n along a curve and (n - i)/n along the reversed
/// curve takes the same products and adds them in the other order, which changes no bit. So two
/// patches that share a boundary, in whatever direction, sample the same points on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weights {
    /// 1 - t.
    pub(crate) s: f64,
    /// t.
    pub(crate) t: f64,
}

impl Weights {
    /// The weights at `t`.
    pub(crate) fn at(t: f64) -> Self {
        Self { s: 1.0 - t, t }
    }

    /// The weights at i/n. `n` is not 0, and `i` is at most `n`.
    pub(crate) fn ratio(i: u32, n: u32) -> Self {
        let count = f64::from(n);
        Self {
            s: f64::from(n - i) / count,
            t: f64::from(i) / count,
        }
    }

    /// s a + t b.
    pub(crate) fn blend<P: Point>(self, a: P, b: P) -> P {
        a * self.s + b * self.t
    }

    /// 0 at the start, 1 at the end, `None` elsewhere.
    ///
    /// At an end the answer is a control point and needs no arithmetic, which would turn -0 into 0
    /// depending on the other points.
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
    fn the_weights_from_the_other_end_are_the_same_exchanged() {
        for n in [1, 3, 10, 49, 1000] {
            for i in 0..=n {
                let (forth, back) = (Weights::ratio(i, n), Weights::ratio(n - i, n));
                assert_eq!((forth.s, forth.t), (back.t, back.s));
                assert!((forth.s + forth.t - 1.0).abs() <= f64::EPSILON);
            }
        }
    }

    #[test]
    fn only_zero_and_one_are_ends() {
        let ends = [0.0, -0.0, 1.0, 0.5, -1.0, f64::NAN].map(|t| Weights::at(t).end());
        assert_eq!(ends, [Some(0), Some(0), Some(1), None, None, None]);
    }
}
