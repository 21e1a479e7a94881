//! Work on all threads, in blocks of elements.
//!
//! One loop of rayon does all of it. The compiler makes a copy of such a loop for every closure that it is
//! called with, and each copy costs more than the work in it: so the loop knows its work by a pointer, which is
//! followed once a block.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

use bytemuck::Zeroable;
use rayon::prelude::*;

/// How many elements a block has: enough that handing them to a thread takes no time beside the work.
pub(crate) const BLOCK: usize = 4096;

/// Calls `work` with each number below `n`.
fn each(n: usize, work: &(dyn Fn(usize) + Sync)) {
    match n {
        0 => {}
        1 => work(0),
        // Any thread may take any of them: each is worth the trouble.
        _ => (0..n).into_par_iter().with_max_len(1).for_each(work),
    }
}

/// Hands each item to `work`, with its number. Returns what it makes of them.
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
    let made = slots
        .into_iter()
        .map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner).1);
    made.flatten().collect()
}

/// What `make` makes of each number below `n`.
pub(crate) fn map<R: Send>(n: usize, make: impl Fn(usize) -> R + Sync) -> Vec<R> {
    consume(0..n, |_, i| make(i))
}

/// What `make` makes of each block of the numbers below `n`.
pub(crate) fn blocks<R: Send>(n: usize, make: impl Fn(Range<usize>) -> R + Sync) -> Vec<R> {
    map(n.div_ceil(BLOCK), |block| {
        make(block * BLOCK..n.min((block + 1) * BLOCK))
    })
}

/// Hands blocks of `out` to `work`, each with the number of its first element.
pub(crate) fn fill<T: Send>(out: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    consume(out.chunks_mut(BLOCK), |block, out| work(block * BLOCK, out));
}

/// The parts of a list that end at these places: the first begins at 0.
pub(crate) fn parts<T>(mut list: &mut [T], ends: impl IntoIterator<Item = usize>) -> Vec<&mut [T]> {
    let mut start = 0;
    let part = |end| {
        let (part, rest) = std::mem::take(&mut list).split_at_mut(end - start);
        (start, list) = (end, rest);
        part
    };
    ends.into_iter().map(part).collect()
}

/// The value of each number below `n`.
pub(crate) fn collect<T: Zeroable + Send>(n: usize, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut all = mesh::zeroed(n);
    fill(&mut all, |first, out| {
        for (i, slot) in (first..).zip(out) {
            *slot = value(i);
        }
    });
    all
}

/// Changes each value of a list.
pub(crate) fn change<T: Send>(all: &mut [T], change: impl Fn(&mut T) + Sync) {
    fill(all, |_, block| block.iter_mut().for_each(&change));
}

/// The numbers below `n` for which `is` holds, in their order.
pub(crate) fn filter(n: usize, is: impl Fn(usize) -> bool + Sync) -> Vec<usize> {
    blocks(n, |block| block.filter(|&i| is(i)).collect::<Vec<_>>()).concat()
}

/// For how many of the numbers below `n` it holds.
pub(crate) fn count(n: usize, is: impl Fn(usize) -> bool + Sync) -> usize {
    blocks(n, |block| block.filter(|&i| is(i)).count())
        .into_iter()
        .sum()
}

/// For each number below `n` whether it is among the `indices`.
pub(crate) fn named(n: usize, indices: &[u32]) -> Vec<AtomicBool> {
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

/// Whether it holds for all numbers below `n`.
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
    fn every_element_is_met_once_and_in_order() {
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
    fn parts_follow_each_other() {
        let mut list = [1, 2, 3, 4];
        let parts = parts(&mut list, [1, 1, 4]);
        assert_eq!(parts, [&[1][..], &[], &[2, 3, 4]]);
    }
}
