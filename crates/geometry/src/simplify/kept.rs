//! Removes from lists the values of elements that no longer exist.

use mesh::{Id, parallel};

/// Returns the old indices of the elements that still exist. `map` contains the new id of each old element.
pub(super) fn kept<I: Id>(map: &[I]) -> Vec<usize> {
    parallel::filter(map.len(), |i| map[i] != I::NONE)
}

/// Keeps only the values at the given indices.
pub(super) fn keep<T: Copy + Send + Sync>(values: &mut Vec<T>, kept: &[usize]) {
    let old = std::mem::take(values);
    *values = parallel::collect(kept.len(), |i| old[kept[i]]);
}
