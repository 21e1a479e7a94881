//! Reverses polygons so that neighbors have a consistent orientation.
//!
//! ```text
//!    +-------+-------+           +-------+-------+
//!    | <---  |  ---> |           | <---  | <---  |       If the orientation is consistent, the two sides
//!    |    ^  |  v    |    -->    |    ^  |    ^  |       of an edge run in opposite directions.
//!    | --->  |  <--- |           | --->  | --->  |
//!    +-------+-------+           +-------+-------+
//! ```
//!
//! Two polygons are neighbors if they share an edge that no other polygon has. Polygons that are connected through such
//! edges form a part. If the polygons of a part can get a consistent orientation, they form two groups. The first group
//! has the same orientation as the first polygon of the part, and the second group the opposite orientation. The
//! smaller group is reversed. If both groups have the same size, the second group is reversed.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::buckets::Buckets;
use super::polygons::{NONE, Polygons};
use crate::parallel::BLOCK;

/// The polygons to reverse.
#[derive(Default)]
pub(super) struct Orientation {
    /// The polygons to reverse, in order.
    pub(super) reversed: Vec<usize>,
    /// The first polygon of each part that has no consistent orientation. No polygon of these parts is reversed.
    pub(super) unorientable: Vec<usize>,
}

impl Orientation {
    /// Finds the polygons to reverse.
    pub(super) fn of(polygons: &Polygons, buckets: &Buckets) -> Self {
        let opposite_sides = opposite_sides(polygons, buckets);
        let mut orientation = Self::default();
        let mut is_visited = vec![false; polygons.n()];
        // For each polygon: whether its orientation is opposite to the orientation of the first polygon of its part.
        let mut is_reversed = vec![false; polygons.n()];
        let mut part = Vec::new();
        for first in 0..polygons.n() {
            if is_visited[first] {
                continue;
            }
            is_visited[first] = true;
            part.clear();
            part.push(first);
            let mut is_orientable = true;
            let mut n_done = 0;
            while let Some(&f) = part.get(n_done) {
                n_done += 1;
                for c in polygons.offsets[f]..polygons.offsets[f + 1] {
                    let other = opposite_sides[c as usize];
                    if other == NONE {
                        continue;
                    }
                    let g = polygons.face(other) as usize;
                    // If the two sides of an edge have the same origin, they run in the same direction, so their
                    // polygons have opposite orientations.
                    let reversed = is_reversed[f] ^ (polygons.origin(c) == polygons.origin(other));
                    if is_visited[g] {
                        is_orientable &= is_reversed[g] == reversed;
                    } else {
                        is_visited[g] = true;
                        is_reversed[g] = reversed;
                        part.push(g);
                    }
                }
            }
            if is_orientable {
                let n_reversed = part.iter().filter(|&&f| is_reversed[f]).count();
                let minority = n_reversed <= part.len() - n_reversed;
                orientation
                    .reversed
                    .extend(part.iter().filter(|&&f| is_reversed[f] == minority));
            } else {
                orientation.unorientable.push(first);
            }
        }
        orientation.reversed.sort_unstable();
        orientation
    }

    /// Reverses polygons. `values` has one value for each corner. The first corner of a polygon remains its first
    /// corner.
    pub(super) fn reverse<T>(&self, offsets: &[u32], values: &mut [T]) {
        for &f in &self.reversed {
            values[offsets[f] as usize + 1..offsets[f + 1] as usize].reverse();
        }
    }
}

/// Returns, for each side, the other side of its edge, or `NONE` if the edge does not belong to exactly two polygons.
/// The two sides can run in the same or in opposite directions.
fn opposite_sides(polygons: &Polygons, buckets: &Buckets) -> Vec<u32> {
    let opposite_sides: Vec<AtomicU32> = (0..polygons.corners.len())
        .into_par_iter()
        .map(|_| AtomicU32::new(NONE))
        .collect();
    (0..buckets.n_vertices())
        .into_par_iter()
        .with_min_len(BLOCK)
        .for_each_init(Vec::new, |sides, v| {
            // All sides at this vertex, each with the vertex at its other end.
            sides.clear();
            for &c in buckets.of(v) {
                let before = polygons.prev(c);
                sides.push((polygons.origin(polygons.next(c)), c));
                sides.push((polygons.origin(before), before));
            }
            sides.sort_unstable();
            for edge in sides.chunk_by(|a, b| a.0 == b.0) {
                if let &[(_, c), (_, d)] = edge {
                    // The task for the vertex at the other end of the edge stores the same values, so the order of the
                    // tasks does not matter.
                    opposite_sides[c as usize].store(d, Relaxed);
                    opposite_sides[d as usize].store(c, Relaxed);
                }
            }
        });
    opposite_sides
        .into_iter()
        .map(AtomicU32::into_inner)
        .collect()
}
