//! Turning polygons round until neighbors agree.
//!
//! ```text
//!    +-------+-------+           +-------+-------+
//!    | <---  |  ---> |           | <---  | <---  |       Along the edge between them, the sides of
//!    |    ^  |  v    |    -->    |    ^  |    ^  |       neighbors that agree run opposite ways.
//!    | --->  |  <--- |           | --->  | --->  |
//!    +-------+-------+           +-------+-------+
//! ```
//!
//! Neighbors are polygons on an edge with exactly two sides. Of polygons that hang together through
//! such edges the minority is turned; of two halves the one without the first polygon.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::buckets::Buckets;
use super::polygons::{NONE, Polygons};
use crate::blocks::BLOCK;

/// Which polygons to turn round.
#[derive(Default)]
pub(super) struct Orientation {
    /// The polygons to turn, in order.
    pub(super) reversed: Vec<usize>,
    /// The first polygon of each part that has no consistent orientation. Nothing of it is turned.
    pub(super) unorientable: Vec<usize>,
}

impl Orientation {
    /// Finds the polygons to turn.
    pub(super) fn of(polygons: &Polygons, buckets: &Buckets) -> Self {
        let across = sides_across(polygons, buckets);
        let mut found = Self::default();
        let mut seen = vec![false; polygons.n()];
        let mut is_turned = vec![false; polygons.n()];
        let mut part = Vec::new();
        for first in 0..polygons.n() {
            if seen[first] {
                continue;
            }
            seen[first] = true;
            part.clear();
            part.push(first);
            let mut is_orientable = true;
            let mut done = 0;
            while let Some(&f) = part.get(done) {
                done += 1;
                for c in polygons.offsets[f]..polygons.offsets[f + 1] {
                    let other = across[c as usize];
                    if other == NONE {
                        continue;
                    }
                    let g = polygons.face(other) as usize;
                    // Two sides that leave from one vertex run the same way.
                    let turned = is_turned[f] ^ (polygons.origin(c) == polygons.origin(other));
                    if seen[g] {
                        is_orientable &= is_turned[g] == turned;
                    } else {
                        seen[g] = true;
                        is_turned[g] = turned;
                        part.push(g);
                    }
                }
            }
            if is_orientable {
                let n_turned = part.iter().filter(|&&f| is_turned[f]).count();
                let minority = n_turned <= part.len() - n_turned;
                found
                    .reversed
                    .extend(part.iter().filter(|&&f| is_turned[f] == minority));
            } else {
                found.unorientable.push(first);
            }
        }
        found.reversed.sort_unstable();
        found
    }

    /// Turns polygons round, or values of their corners with them. The first corner stays the first.
    pub(super) fn reverse<T>(&self, offsets: &[u32], values: &mut [T]) {
        for &f in &self.reversed {
            values[offsets[f] as usize + 1..offsets[f + 1] as usize].reverse();
        }
    }
}

/// For each side the other one if its edge has exactly two, whichever way they run; else `NONE`.
fn sides_across(polygons: &Polygons, buckets: &Buckets) -> Vec<u32> {
    let across: Vec<AtomicU32> = (0..polygons.corners.len())
        .into_par_iter()
        .map(|_| AtomicU32::new(NONE))
        .collect();
    (0..buckets.n_vertices())
        .into_par_iter()
        .with_min_len(BLOCK)
        .for_each_init(Vec::new, |sides, v| {
            // All sides that end here, with their other ends.
            sides.clear();
            for &c in buckets.of(v) {
                let before = polygons.prev(c);
                sides.push((polygons.origin(polygons.next(c)), c));
                sides.push((polygons.origin(before), before));
            }
            sides.sort_unstable();
            for edge in sides.chunk_by(|a, b| a.0 == b.0) {
                if let &[(_, c), (_, d)] = edge {
                    // Its other vertex finds the same.
                    across[c as usize].store(d, Relaxed);
                    across[d as usize].store(c, Relaxed);
                }
            }
        });
    across.into_iter().map(AtomicU32::into_inner).collect()
}
