//! Sets of numbers that threads may join at the same time.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Numbers from 0, each in one set. Every set has its lowest number as root.
///
/// Which sets there are at the end depends only on what was joined, not on the order. A parent is always
/// below its child, so that no cycle can arise; a join is one compare-and-swap at a root, tried again if
/// another thread was first. Anderson and Woll, "Wait-free Parallel Algorithms for the Union-Find
/// Problem", 1991.
pub(super) struct UnionFind {
    parent: Vec<AtomicU32>,
}

impl UnionFind {
    /// Numbers below `n`, each alone.
    pub(super) fn new(n: u32) -> Self {
        Self {
            parent: (0..n).map(AtomicU32::new).collect(),
        }
    }

    /// The root of the set of `v`: its lowest number, once no other thread joins.
    pub(super) fn root(&self, mut v: u32) -> u32 {
        loop {
            let parent = self.parent[v as usize].load(Relaxed);
            if parent == v {
                return v;
            }
            let above = self.parent[parent as usize].load(Relaxed);
            // Halves the way for the next one. A parent only ever moves to one of its ancestors.
            let _ = self.parent[v as usize].compare_exchange(parent, above, Relaxed, Relaxed);
            v = above;
        }
    }

    /// Joins the sets of `a` and `b`.
    pub(super) fn join(&self, a: u32, b: u32) {
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

    /// The lowest number of each set, for all its members.
    pub(super) fn into_lowest(self) -> Vec<u32> {
        let mut lowest: Vec<u32> = self.parent.into_iter().map(AtomicU32::into_inner).collect();
        // Parents are below their children, so theirs is final already.
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
    fn threads_that_join_at_the_same_time_lose_nothing() {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(8)
            .build()
            .unwrap();
        let sets = UnionFind::new(60_000);
        // Steps of 6 and 10 connect all even and all odd numbers.
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
