//! Runs work on all threads, in blocks of elements. No result depends on the number of threads.
//!
//! All functions share one loop of the crate `rayon`. The loop calls a `dyn` closure: a generic loop would be compiled
//! again for every closure, which would slow down builds.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use crate::zeroed::reserved;

/// The number of elements in a block. With this size, the cost of scheduling a block is negligible. The size must not
/// depend on the number of threads. Sums are computed block by block, and the order of the additions determines the
/// last bits of a sum.
pub const BLOCK: usize = 4096;

/// Calls `work` with each number below `n`. Each call is scheduled separately. Scheduling costs little only if a call
/// takes at least a few microseconds.
pub fn each(n: usize, work: &(dyn Fn(usize) + Sync)) {
    match n {
        0 => {}
        1 => work(0),
        _ => (0..n).into_par_iter().with_max_len(1).for_each(work),
    }
}

/// For each item, calls `work` with the index of the item and the item itself. Returns the results in order. Each call
/// is scheduled separately.
pub fn consume<P: Send, R: Send>(
    items: impl IntoIterator<Item = P>,
    work: impl Fn(usize, P) -> R + Sync,
) -> Vec<R> {
    let items: Vec<_> = items
        .into_iter()
        .map(|item| Mutex::new(Some(item)))
        .collect();
    map(items.len(), |i| {
        let item = items[i]
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        work(i, item.expect("each item is taken once"))
    })
}

/// Returns the result of `make` for each number below `n`. Each call is scheduled separately. If a call takes less than
/// a few microseconds, use [`collect`] instead.
pub fn map<R: Send>(n: usize, make: impl Fn(usize) -> R + Sync) -> Vec<R> {
    results(n, &make)
}

// The functions `results` and `fill_blocks` take `dyn` closures. Therefore, they are compiled once for each type of
// results or elements, and not once for each closure.

fn results<R: Send>(n: usize, make: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
    let mut results: Vec<Mutex<Option<R>>> = Vec::with_capacity(n);
    results.resize_with(n, Mutex::default);
    each(n, &|i| {
        let result = make(i);
        *results[i].lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
    });
    let mut made = Vec::with_capacity(n);
    for result in results {
        made.extend(result.into_inner().unwrap_or_else(PoisonError::into_inner));
    }
    made
}

/// Divides the numbers below `n` into blocks of [`BLOCK`] numbers, and returns the result of `make` for each block.
pub fn blocks<R: Send>(n: usize, make: impl Fn(Range<usize>) -> R + Sync) -> Vec<R> {
    map(n.div_ceil(BLOCK), |block| {
        make(block * BLOCK..n.min((block + 1) * BLOCK))
    })
}

/// Calls `work(first, block)` for each block of `out`. The first element of the block has the index `first` in `out`.
pub fn fill<T: Send>(out: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    fill_blocks(out, &work);
}

fn fill_blocks<T: Send>(out: &mut [T], work: &(dyn Fn(usize, &mut [T]) + Sync)) {
    let block = block_for(out.len());
    let blocks: Vec<_> = out.chunks_mut(block).map(Mutex::new).collect();
    each(blocks.len(), &|i| {
        let mut out = blocks[i].lock().unwrap_or_else(PoisonError::into_inner);
        work(i * block, &mut out);
    });
}

/// Returns `value(i)` for each number i below `n`, in order.
///
/// # Panics
///
/// Unwinds with [`OutOfMemory`](crate::OutOfMemory) if the system has no memory for the values.
pub fn collect<T: Send>(n: usize, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut all = reserved(n);
    fill(&mut all.spare_capacity_mut()[..n], |first, out| {
        for (i, slot) in (first..).zip(out) {
            slot.write(value(i));
        }
    });
    #[expect(
        unsafe_code,
        reason = "some types have no zero value, so safe code would collect blocks and then copy all values once more"
    )]
    // SAFETY: the capacity is at least n. The call of `fill` has written a value to each of the first n slots. If the
    // closure `value` panics, `set_len` is not called.
    unsafe {
        all.set_len(n);
    }
    all
}

/// Returns a copy of a list. For large lists, this function takes less than half the time of `clone`, because the memory
/// of the copy is requested in large pages, and several threads fill it.
pub fn copied<T: Copy + Send + Sync>(all: &[T]) -> Vec<T> {
    collect(all.len(), |i| all[i])
}

/// Calls `change` for each value of a list.
pub fn change<T: Send>(all: &mut [T], change: impl Fn(&mut T) + Sync) {
    fill(all, |_, block| block.iter_mut().for_each(&change));
}

/// Returns the numbers below `n` for which `is` returns true, in order.
pub fn filter(n: usize, is: impl Fn(usize) -> bool + Sync) -> Vec<usize> {
    blocks(n, |block| block.filter(|&i| is(i)).collect::<Vec<_>>()).concat()
}

/// Counts the numbers below `n` for which `is` returns true.
pub fn count(n: usize, is: impl Fn(usize) -> bool + Sync) -> usize {
    blocks(n, |block| block.filter(|&i| is(i)).count())
        .into_iter()
        .sum()
}

/// Returns one flag for each number below `n`: whether the number occurs in `indices`.
pub fn index_flags(n: usize, indices: &[u32]) -> Vec<AtomicBool> {
    let named: Vec<AtomicBool> = (0..n).map(|_| AtomicBool::new(false)).collect();
    blocks(indices.len(), |block| {
        for &index in &indices[block] {
            if let Some(flag) = named.get(index as usize) {
                flag.store(true, Relaxed);
            }
        }
    });
    named
}

/// Splits a list into parts that end at the given indices. The first part begins at 0.
///
/// # Panics
///
/// Panics if an index is larger than the length of the list, or smaller than the index before it.
pub fn split_at_ends<T>(
    mut list: &mut [T],
    ends: impl IntoIterator<Item = usize>,
) -> Vec<&mut [T]> {
    let mut start = 0;
    let part = |end| {
        let (part, rest) = std::mem::take(&mut list).split_at_mut(end - start);
        (start, list) = (end, rest);
        part
    };
    ends.into_iter().map(part).collect()
}

/// Returns whether `is` returns true for all numbers below `n`.
pub fn all(n: usize, is: impl Fn(usize) -> bool + Sync) -> bool {
    let all = AtomicBool::new(true);
    blocks(n, |mut block| {
        if all.load(Relaxed) && !block.all(&is) {
            all.store(false, Relaxed);
        }
    });
    all.into_inner()
}

/// Returns the sum of `term(i)` for i from 0 to n - 1. Blocks of [`BLOCK`] terms are summed in
/// parallel, each from its first to its last term; then the block sums are added in order. The result is
/// identical bit for bit for any number of threads.
pub fn sum<T>(n: usize, term: impl Fn(usize) -> T + Sync) -> T
where
    T: Default + Copy + Send + Sync + std::ops::Add<Output = T>,
{
    fold(n, T::default(), term, |a, b| a + b)
}

/// Folds like [`sum`], with the operation `join` instead of addition and `start` instead of zero. The fold of every
/// block begins with `start`. Therefore, joining a value with `start` must not change the value.
pub fn fold<T: Copy + Send + Sync>(
    n: usize,
    start: T,
    term: impl Fn(usize) -> T + Sync,
    join: impl Fn(T, T) -> T + Sync,
) -> T {
    let blocks = blocks(n, |block| block.fold(start, |s, i| join(s, term(i))));
    blocks.into_iter().fold(start, join)
}

/// Returns the number of elements in a block of a list of `n` elements. Short lists are divided into smaller blocks
/// than long lists, so that the work is spread over all threads. Sums do not call this function: their blocks always
/// have [`BLOCK`] elements.
fn block_for(n: usize) -> usize {
    const SMALLEST: usize = 64;
    (n / (8 * rayon::current_num_threads())).clamp(SMALLEST, BLOCK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_is_processed_once_and_in_order() {
        for n in [0, 1, 63, BLOCK, BLOCK + 1, 5 * BLOCK - 1] {
            assert_eq!(map(n, |i| i), (0..n).collect::<Vec<_>>());
            assert_eq!(collect(n, |i| i), (0..n).collect::<Vec<_>>());
            assert_eq!(blocks(n, |block| block.len()).iter().sum::<usize>(), n);
            assert_eq!(
                filter(n, |i| i % 3 == 1),
                (0..n).filter(|i| i % 3 == 1).collect::<Vec<_>>()
            );
            assert_eq!(
                count(n, |i| i % 3 == 1),
                (0..n).filter(|i| i % 3 == 1).count()
            );
            assert!(all(n, |i| i < n));
            assert_eq!(all(n, |i| i + 1 < n), n == 0);
            let mut list: Vec<usize> = vec![1; n];
            change(&mut list, |x| *x += 1);
            assert_eq!(list, vec![2; n]);
        }
    }

    #[test]
    fn collected_values_may_own_memory() {
        let texts = collect(10_000, |i| i.to_string());
        assert!(
            texts
                .iter()
                .enumerate()
                .all(|(i, text)| *text == i.to_string())
        );
    }

    #[test]
    fn a_panic_while_values_are_collected_reaches_the_caller() {
        let collected = std::panic::catch_unwind(|| {
            collect(10_000, |i| {
                if i == 7_000 {
                    panic!("7000")
                } else {
                    i.to_string()
                }
            })
        });
        assert!(collected.is_err());
    }

    #[test]
    fn split_parts_follow_each_other() {
        let mut list = [1, 2, 3, 4];
        let parts = split_at_ends(&mut list, [1, 1, 4]);
        assert_eq!(parts, [&[1][..], &[], &[2, 3, 4]]);
    }

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
