//! Collects the corners at each vertex by a counting sort.

use rayon::prelude::*;

use super::polygons::{pieces, to_id};

/// The maximum number of tasks. Every task reads all corners. With more tasks, reading the corners would take longer
/// than filling the buckets.
const MAX_TASKS: usize = 8;

/// The corners at each vertex, in ascending order.
pub(super) struct Buckets {
    /// The start of the bucket of each vertex, followed by the end of the last bucket.
    first: Vec<u32>,
    corners: Vec<u32>,
}

impl Buckets {
    /// Sorts corners into buckets. `vertices` contains the vertex of each corner. All of these indices must be below
    /// `n_vertices`.
    ///
    /// Each task owns a range of vertices, and selects the corners of these vertices from all corners. Therefore, no
    /// two tasks write to the same entry, and the order of the corners at a vertex does not depend on the number of
    /// tasks.
    pub(super) fn new(n_vertices: usize, vertices: &[u32]) -> Self {
        let n_tasks = rayon::current_num_threads().min(MAX_TASKS);
        let width = n_vertices.div_ceil(n_tasks).max(1);

        // 1. Count the corners of each vertex v, in `first[v + 1]`.
        let mut first: Vec<u32> = crate::zeroed(n_vertices + 1);
        let tasks = first[1..].par_chunks_mut(width).enumerate();
        tasks.for_each(|(task, counts)| {
            for &v in vertices {
                if let Some(count) = counts.get_mut((v as usize).wrapping_sub(task * width)) {
                    *count += 1;
                }
            }
        });
        // 2. Replace each count by the start of the bucket of v.
        let mut sum = 0;
        for count in &mut first[1..] {
            sum += *count;
            *count = sum - *count;
        }
        let starts = first[1..].chunks(width).map(|starts| starts[0] as usize);
        let ends = starts.clone().skip(1).chain([vertices.len()]);
        let lengths: Vec<usize> = starts.zip(ends).map(|(start, end)| end - start).collect();
        let mut corners = crate::zeroed(vertices.len());
        // 3. Fill the buckets. Each stored corner increments the entry of its bucket. When all corners are stored, the
        //    entry of each bucket has become the start of the next bucket.
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

    /// Returns the corners at `v`.
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
    fn buckets_have_the_corners_of_their_vertices_in_order() {
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
