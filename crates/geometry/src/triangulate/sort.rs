//! Sorts long lists, and checks for cancellation while it sorts.

use std::cmp::Ordering;

/// The number of elements that are sorted or merged between two checks for cancellation. Sorting this number of
/// elements takes a few milliseconds.
const BLOCK: usize = 1 << 16;

/// Sorts a list. If the list has more than 65,536 elements, `is_cancelled` is called many times. If `is_cancelled`
/// returns `true`, the function returns `None`, and the list has the same elements in an unspecified order.
pub(super) fn sort_unless<T: Copy>(
    is_cancelled: &dyn Fn() -> bool,
    list: &mut Vec<T>,
    compare: impl Fn(&T, &T) -> Ordering,
) -> Option<()> {
    let n = list.len();
    for block in list.chunks_mut(BLOCK) {
        if n > BLOCK && is_cancelled() {
            return None;
        }
        block.sort_unstable_by(&compare);
    }
    let mut width = BLOCK;
    while width < n {
        let mut merged = Vec::with_capacity(n);
        for pair in list.chunks(2 * width) {
            let (mut a, mut b) = pair.split_at(width.min(pair.len()));
            while let ([first, a_rest @ ..], [second, b_rest @ ..]) = (a, b) {
                if merged.len() % BLOCK == 0 && is_cancelled() {
                    return None;
                }
                if compare(second, first) == Ordering::Less {
                    merged.push(*second);
                    b = b_rest;
                } else {
                    merged.push(*first);
                    a = a_rest;
                }
            }
            merged.extend(a);
            merged.extend(b);
        }
        *list = merged;
        width *= 2;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn long_lists_are_sorted_or_keep_their_elements() {
        for n in [0, 1, BLOCK, BLOCK + 1, 3 * BLOCK - 1, 5 * BLOCK] {
            let list: Vec<u64> = (0..n as u64).map(|i| i * 7919 % 10_007).collect();
            let mut expected = list.clone();
            expected.sort_unstable();
            let (mut found, calls) = (list.clone(), Cell::new(0));
            let count = |limit: usize| {
                calls.set(calls.get() + 1);
                calls.get() > limit
            };
            assert!(sort_unless(&|| count(usize::MAX), &mut found, Ord::cmp).is_some());
            assert_eq!(found, expected);
            let n_calls = calls.take();
            assert_eq!(n_calls > 0, n > BLOCK);
            for limit in 0..n_calls {
                let mut found = list.clone();
                calls.set(0);
                assert!(sort_unless(&|| count(limit), &mut found, Ord::cmp).is_none());
                found.sort_unstable();
                assert_eq!(found, expected);
            }
        }
    }
}
