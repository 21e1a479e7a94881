//! Runs work on all threads, in blocks of elements.
//!
//! All functions share one loop of the crate `rayon`. The loop calls a function pointer once for each block. A generic
//! loop would be compiled again for every closure, which is expensive.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

use bytemuck::Zeroable;
use rayon::prelude::*;

/// The number of elements in a block. Blocks are large enough to make the cost of scheduling negligible.
pub(crate) const BLOCK: usize = 4096;

/// Calls `work` with each number below `n`.
fn each(n: usize, work: &(dyn Fn(usize) + Sync)) {
    match n {
        0 => {}
        1 => work(0),
        // Each item is large enough to be scheduled separately.
        _ => (0..n).into_par_iter().with_max_len(1).for_each(work),
    }
}

/// Calls `work` with the index of each item and the item, and returns the results in order.
pub(crate) fn consume<P: Send, R: Send>(
    items: impl IntoIterator<Item = P>,
    work: impl Fn(usize, P) -> R + Sync,
) -> Vec<R> {
    let slots = items.into_iter().map(|item| Mutex::new((Some(item), None)));
    let slots: Vec<_> = slots.collect();
    each(slots.len(), &|i| {
        let mut slot = slots[i].lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(item) = slot.0.take() {
            slot.1 = Some(work(i, item));
        }
    });
    let results = slots
        .into_iter()
        .map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner).1);
    results.flatten().collect()
}

/// Returns the result of `make` for each number below `n`.
pub(crate) fn map<R: Send>(n: usize, make: impl Fn(usize) -> R + Sync) -> Vec<R> {
    consume(0..n, |_, i| make(i))
}

/// Divides the numbers below `n` into blocks, and returns the result of `make` for each block.
pub(crate) fn blocks<R: Send>(n: usize, make: impl Fn(Range<usize>) -> R + Sync) -> Vec<R> {
    map(n.div_ceil(BLOCK), |block| {
        make(block * BLOCK..n.min((block + 1) * BLOCK))
    })
}

/// Calls `work` with each block of `out` and the index of its first element.
pub(crate) fn fill<T: Send>(out: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    consume(out.chunks_mut(BLOCK), |block, out| work(block * BLOCK, out));
}

/// Splits a list into parts that end at the given indices. The first part begins at 0.
pub(crate) fn split_at_ends<T>(
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

/// Returns the value for each number below `n`.
pub(crate) fn collect<T: Zeroable + Send>(n: usize, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut all = mesh::zeroed(n);
    fill(&mut all, |first, out| {
        for (i, slot) in (first..).zip(out) {
            *slot = value(i);
        }
    });
    all
}

/// Calls `change` for each value of a list.
pub(crate) fn change<T: Send>(all: &mut [T], change: impl Fn(&mut T) + Sync) {
    fill(all, |_, block| block.iter_mut().for_each(&change));
}

/// Returns the numbers below `n` for which `is` returns true, in order.
pub(crate) fn filter(n: usize, is: impl Fn(usize) -> bool + Sync) -> Vec<usize> {
    blocks(n, |block| block.filter(|&i| is(i)).collect::<Vec<_>>()).concat()
}

/// Counts the numbers below `n` for which `is` returns true.
pub(crate) fn count(n: usize, is: impl Fn(usize) -> bool + Sync) -> usize {
    blocks(n, |block| block.filter(|&i| is(i)).count())
        .into_iter()
        .sum()
}

/// Returns one flag for each number below `n`: whether the number occurs in `indices`.
pub(crate) fn index_flags(n: usize, indices: &[u32]) -> Vec<AtomicBool> {
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

/// Returns whether `is` returns true for all numbers below `n`.
pub(crate) fn all(n: usize, is: impl Fn(usize) -> bool + Sync) -> bool {
    let all = AtomicBool::new(true);
    blocks(n, |mut block| {
        if all.load(Relaxed) && !block.all(&is) {
            all.store(false, Relaxed);
        }
    });
    all.into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_is_processed_once_and_in_order() {
        for n in [0, 1, BLOCK, BLOCK + 1, 5 * BLOCK - 1] {
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
    fn split_parts_follow_each_other() {
        let mut list = [1, 2, 3, 4];
        let parts = split_at_ends(&mut list, [1, 1, 4]);
        assert_eq!(parts, [&[1][..], &[], &[2, 3, 4]]);
    }
}
