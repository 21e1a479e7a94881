//! Parallel sums in a fixed order, independent of the number of threads.

use rayon::prelude::*;

/// The number of terms in a block. One thread adds the terms of a block. The number does not depend on the number
/// of threads, because the order of the additions determines the last bits of a sum.
pub const BLOCK: usize = 4096;

/// Returns the sum of `term(i)` for i from 0 to n - 1. Blocks of [`BLOCK`] terms are summed in
/// parallel, each from its first to its last term; then the block sums are added in order. The result is
/// identical bit for bit for any number of threads.
pub fn sum<T>(n: usize, term: impl Fn(usize) -> T + Sync) -> T
where
    T: Default + Copy + Send + Sync + std::ops::Add<Output = T>,
{
    fold(n, T::default(), term, |a, b| a + b)
}

/// Folds like [`sum`], with the operation `join` instead of addition and `start` instead of zero. Every block starts
/// with `start`, so joining a value with `start` must not change the value.
pub fn fold<T: Copy + Send + Sync>(
    n: usize,
    start: T,
    term: impl Fn(usize) -> T + Sync,
    join: impl Fn(T, T) -> T + Sync,
) -> T {
    let blocks: Vec<T> = (0..n.div_ceil(BLOCK))
        .into_par_iter()
        .map(|b| (b * BLOCK..n.min((b + 1) * BLOCK)).fold(start, |s, i| join(s, term(i))))
        .collect();
    blocks.into_iter().fold(start, join)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_has_the_same_bits_for_any_number_of_threads() {
        #[expect(clippy::cast_precision_loss, reason = "small numbers")]
        let term = |i: usize| 1.0 / (i as f64 + 1.0);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| sum(100_000, term).to_bits())
        };
        assert_eq!(with(1), with(8));
        assert!((sum(100_000, term) - 12.090_146).abs() < 1e-6);
    }
}
