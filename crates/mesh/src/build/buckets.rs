//! The corners at each vertex: a counting sort.

use rayon::prelude::*;

use super::polygons::{pieces, to_id};

/// With more tasks than this, reading all corners in each would take longer than filling a share.
const MOST_TASKS: usize = 8;

/// The corners at each vertex, in order.
pub(super) struct Buckets {
    /// For each vertex where its bucket begins, and at last where the last one ends.
    first: Vec<u32>,
    corners: Vec<u32>,
}

impl Buckets {
    /// `vertices` has for each corner its vertex, below `n_vertices`.
    ///
    /// Each task owns a range of vertices and picks theirs among all corners: no two tasks write to
    /// the same place, and the corners stay in order however many tasks there are.
    pub(super) fn new(n_vertices: usize, vertices: &[u32]) -> Self {
        let n_tasks = rayon::current_num_threads().min(MOST_TASKS);
        let width = n_vertices.div_ceil(n_tasks).max(1);

        // Counts first, each one place further than it belongs, ...
        let mut first: Vec<u32> = crate::zeroed(n_vertices + 1);
        let tasks = first[1..].par_chunks_mut(width).enumerate();
        tasks.for_each(|(task, counts)| {
            for &v in vertices {
                if let Some(count) = counts.get_mut((v as usize).wrapping_sub(task * width)) {
                    *count += 1;
                }
            }
        });
        // ... then the start of each bucket there, ...
        let mut sum = 0;
        for count in &mut first[1..] {
            sum += *count;
            *count = sum - *count;
        }
        let starts = first[1..].chunks(width).map(|starts| starts[0] as usize);
        let ends = starts.clone().skip(1).chain([vertices.len()]);
        let lengths: Vec<usize> = starts.zip(ends).map(|(start, end)| end - start).collect();
        let mut corners = crate::zeroed(vertices.len());
        // ... which, counted up while the bucket is filled, becomes the start of the next one.
        first[1..]
            .par_chunks_mut(width)
            .zip(pieces(&mut corners, lengths))
            .enumerate()
            .for_each(|(task, (places, corners))| {
                let start = places[0];
                for (c, &v) in (0..).zip(vertices) {
                    if let Some(place) = places.get_mut((v as usize).wrapping_sub(task * width)) {
                        corners[(*place - start) as usize] = c;
                        *place += 1;
                    }
                }
            });
        debug_assert_eq!(first.last(), Some(&to_id(vertices.len())));
        Self { first, corners }
    }

    /// The corners at `v`.
    #[inline]
    pub(super) fn of(&self, v: usize) -> &[u32] {
        &self.corners[self.first[v] as usize..self.first[v + 1] as usize]
    }

    pub(super) fn n_vertices(&self) -> usize {
        self.first.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_stand_at_their_vertices_in_order() {
        let vertices = [4, 0, 4, 2, 0, 4];
        for threads in [1, 2, 3, 8, 20] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let buckets = pool.build().unwrap().install(|| Buckets::new(6, &vertices));
            let of: Vec<&[u32]> = (0..6).map(|v| buckets.of(v)).collect();
            assert_eq!(of, [&[1, 4][..], &[], &[3], &[], &[0, 2, 5], &[]]);
        }
    }

    #[test]
    fn without_vertices_there_are_no_buckets() {
        assert_eq!(Buckets::new(0, &[]).n_vertices(), 0);
    }
}
