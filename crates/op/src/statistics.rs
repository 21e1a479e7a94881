//! Statistics of values of elements, such as the values of an attribute.

use mesh::parallel;

/// Statistics of the finite values in a list. Values that are not finite count as missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// The number of finite values, at least 1.
    pub n: usize,
    /// The lowest value.
    pub min: f64,
    /// The highest value.
    pub max: f64,
    /// The mean of the values.
    pub mean: f64,
}

impl Statistics {
    /// Returns the statistics of the finite values; `None` if no value is finite. The bits of the result do not depend
    /// on the number of threads.
    pub fn of(values: &[f64]) -> Option<Self> {
        let finite = || values.iter().copied().filter(|x| x.is_finite());
        let first = finite().next()?;
        let n = finite().count();
        let share = |i: usize| {
            let x = values[i];
            // Each value is divided by n before it is added, so that the mean of large values is finite.
            if x.is_finite() { x / n as f64 } else { 0.0 }
        };
        Some(Self {
            n,
            min: finite().fold(first, f64::min),
            max: finite().fold(first, f64::max),
            mean: parallel::sum(values.len(), share),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_values_are_left_out() {
        let statistics = Statistics::of(&[f64::NAN, 3.0, 1.0, f64::INFINITY, 2.0]).unwrap();
        assert_eq!(statistics.n, 3);
        assert_eq!((statistics.min, statistics.max), (1.0, 3.0));
        assert!((statistics.mean - 2.0).abs() < 1e-15);
        assert!(Statistics::of(&[f64::NAN]).is_none());
        assert!(Statistics::of(&[1e308; 9]).unwrap().mean.is_finite());
    }
}
