//! A union-find structure in which several threads can join sets concurrently.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Disjoint sets of the numbers from 0 to n - 1. Each set is a tree, whose root is the lowest number of the set.
///
/// The final sets depend only on which pairs were joined, not on the order of the joins. A parent is always lower than
/// its child, so that no cycle can arise. A join sets the parent of one of the two roots with a compare-and-swap
/// operation. The join is repeated if another thread changed the root first. Source: Anderson and Woll, "Wait-free
/// Parallel Algorithms for the Union-Find Problem", 1991.
pub(crate) struct UnionFind {
    parent: Vec<AtomicU32>,
}

impl UnionFind {
    /// Creates a separate set for each number below `n`.
    pub(crate) fn new(n: u32) -> Self {
        Self {
            parent: (0..n).map(AtomicU32::new).collect(),
        }
    }

    /// Returns the root of the set of `v`. After all joins are finished, the root is the lowest number of the set.
    pub(crate) fn root(&self, mut v: u32) -> u32 {
        loop {
            let parent = self.parent[v as usize].load(Relaxed);
            if parent == v {
                return v;
            }
            let above = self.parent[parent as usize].load(Relaxed);
            // Halves the path to the root, which makes later calls faster. The new parent of `v` is always an ancestor
            // of the old parent.
            let _ = self.parent[v as usize].compare_exchange(parent, above, Relaxed, Relaxed);
            v = above;
        }
    }

    pub(crate) fn join(&self, a: u32, b: u32) {
        let (mut a, mut b) = (self.root(a), self.root(b));
        while a != b {
            let (low, high) = (a.min(b), a.max(b));
            let at_root = &self.parent[high as usize];
            if at_root
                .compare_exchange(high, low, Relaxed, Relaxed)
                .is_ok()
            {
                return;
            }
            (a, b) = (self.root(low), self.root(high));
        }
    }

    /// Returns for each number the lowest number of its set.
    pub(crate) fn into_lowest(self) -> Vec<u32> {
        let mut lowest: Vec<u32> = self.parent.into_iter().map(AtomicU32::into_inner).collect();
        // A parent has a lower index than its children, so the entry of the parent already contains the root of the
        // set.
        for v in 0..lowest.len() {
            lowest[v] = lowest[lowest[v] as usize];
        }
        lowest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    #[test]
    fn joined_numbers_have_the_lowest_as_root() {
        let sets = UnionFind::new(6);
        sets.join(4, 5);
        sets.join(3, 1);
        sets.join(5, 3);
        assert_eq!(sets.root(4), 1);
        assert_eq!(sets.into_lowest(), [0, 1, 2, 1, 1, 1]);
    }

    #[test]
    fn concurrent_joins_are_not_lost() {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(8)
            .build()
            .unwrap();
        let sets = UnionFind::new(60_000);
        // Each number is joined with the numbers that differ from it by 6 or 10. As a result, all even numbers are in
        // one set, and all odd numbers are in another set.
        pool.install(|| {
            (0..59_990_u32).into_par_iter().for_each(|v| {
                sets.join(v, v + 10);
                sets.join(v + 6, v);
            });
        });
        let lowest = sets.into_lowest();
        assert!((0..).zip(&lowest).all(|(v, &low): (u32, _)| low == v % 2));
    }
}
