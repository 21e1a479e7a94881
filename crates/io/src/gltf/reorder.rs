//! Orders triangles and vertices to make a compressed file small. Neighboring triangles are close to each other in this
//! order, and vertices are in the order of their first use.
//!
//! Source: Sander, Nehab, Barczak, "Fast Triangle Reordering for Vertex Locality and Reduced Overdraw", 2007. The order
//! consists of fans: all remaining triangles around one vertex, then all remaining triangles around the next vertex,
//! and so on. The center of the next fan is chosen from the vertices of the previous fan. The algorithm prefers a
//! center that will still count as recently used after the triangles of its fan are added.

use std::collections::BTreeMap;

use mesh::Mesh;

use super::faces::{Faces, all_corners};
use super::split::Split;

/// The number of vertices that count as recently used. The codec can refer to about the same number of recent vertices
/// and edges.
const RECENT: usize = 16;

/// Orders the triangles of each material, and then renumbers the vertices in the order of their first use.
pub(super) fn reorder(mesh: &Mesh, split: &mut Split, faces: &mut BTreeMap<i32, Faces>) {
    let mut number_of = vec![u32::MAX; split.n];
    let mut order = Vec::with_capacity(split.n);
    for faces in faces.values_mut() {
        let corners = faces.corners.take();
        let corners = corners.unwrap_or_else(|| all_corners(mesh, split));
        let mut corners = triangles_in_fans(&corners, split.n);
        for corner in &mut corners {
            let number = &mut number_of[*corner as usize];
            if *number == u32::MAX {
                *number = u32::try_from(order.len()).unwrap_or(u32::MAX);
                order.push(*corner);
            }
            *corner = *number;
        }
        faces.corners = Some(corners);
    }
    split.select(mesh, &order);
}

/// Returns the corners of all triangles, ordered as fans.
fn triangles_in_fans(corners: &[u32], n_vertices: usize) -> Vec<u32> {
    let around = Around::new(corners, n_vertices);
    let mut left = around.counts();
    let mut is_done = vec![false; corners.len() / 3];
    let mut last_use = vec![0_usize; n_vertices];
    let mut time = RECENT + 1;
    let mut ordered = Vec::with_capacity(corners.len());
    // `used` contains the vertices of the ordered triangles, with the latest vertex at the end. If no vertex in `used`
    // has triangles left, the next center comes from the range `untried`.
    let mut used: Vec<u32> = Vec::new();
    let mut untried = 0..n_vertices;
    let mut center = untried.next();
    while let Some(v) = center {
        let start = ordered.len();
        for &t in around.triangles(v) {
            if std::mem::replace(&mut is_done[t as usize], true) {
                continue;
            }
            for &corner in &corners[3 * t as usize..][..3] {
                ordered.push(corner);
                used.push(corner);
                let c = corner as usize;
                left[c] -= 1;
                if time - last_use[c] > RECENT {
                    last_use[c] = time;
                    time += 1;
                }
            }
        }
        let mut best = None;
        for &corner in &ordered[start..] {
            let c = corner as usize;
            if left[c] == 0 {
                continue;
            }
            // Prefers vertices that will still count as recently used after the triangles of their fan are added. Among
            // these, prefers the vertex whose last use was the longest time ago. Each triangle of a fan adds at most
            // two vertices.
            let age = time - last_use[c];
            let priority = if age + 2 * left[c] as usize <= RECENT {
                age
            } else {
                0
            };
            if best.is_none_or(|(most, _)| priority > most) {
                best = Some((priority, c));
            }
        }
        let has_left = |&v: &usize| left[v] > 0;
        center = best.map(|(_, v)| v);
        while center.is_none()
            && let Some(v) = used.pop()
        {
            center = Some(v as usize).filter(has_left);
        }
        center = center.or_else(|| untried.find(has_left));
    }
    ordered
}

/// The triangles around each vertex.
struct Around {
    /// For each vertex, the index at which its list of triangles starts.
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Around {
    fn new(corners: &[u32], n_vertices: usize) -> Self {
        let mut starts = vec![0; n_vertices + 1];
        for &corner in corners {
            starts[corner as usize] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        // Each list is filled backward. At first, the entry of a list in `starts` is the end of the list. Each added
        // triangle decreases this entry by 1, until it is the start of the list.
        let mut triangles = vec![0; corners.len()];
        for (i, &corner) in corners.iter().enumerate().rev() {
            let start = &mut starts[corner as usize];
            *start -= 1;
            triangles[*start as usize] = u32::try_from(i / 3).unwrap_or(u32::MAX);
        }
        Self { starts, triangles }
    }

    fn triangles(&self, v: usize) -> &[u32] {
        &self.triangles[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    fn counts(&self) -> Vec<u32> {
        self.starts.windows(2).map(|w| w[1] - w[0]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotated([a, b, c]: [u32; 3]) -> [u32; 3] {
        [[a, b, c], [b, c, a], [c, a, b]]
            .into_iter()
            .min()
            .unwrap_or_default()
    }

    #[test]
    fn triangles_are_permuted() {
        let (n, mut state) = (50_u32, 7_u32);
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % n
        };
        let corners: Vec<u32> = (0..3 * 400).map(|_| random()).collect();
        let sorted = |corners: &[u32]| {
            let mut triangles: Vec<_> =
                corners.as_chunks().0.iter().copied().map(rotated).collect();
            triangles.sort_unstable();
            triangles
        };
        let ordered = triangles_in_fans(&corners, n as usize);
        assert_eq!(sorted(&ordered), sorted(&corners));
    }

    #[test]
    fn a_shuffled_grid_uses_each_vertex_a_few_times_only() {
        let n = 100_u32;
        let mut corners = Vec::new();
        for i in 0..n * n {
            // The loop visits every square once, because 7919 and the number of squares have no common factor.
            let square = i * 7919 % (n * n);
            let v = square / n * (n + 1) + square % n;
            corners.extend([v, v + 1, v + n + 2, v, v + n + 2, v + n + 1]);
        }
        let ordered = triangles_in_fans(&corners, ((n + 1) * (n + 1)) as usize);
        let mut cache: Vec<u32> = Vec::new();
        let mut misses = 0;
        for v in ordered {
            if !cache.contains(&v) {
                misses += 1;
                cache.insert(0, v);
                cache.truncate(16);
            }
        }
        // In an optimal order, the number of cache misses is half the number of triangles.
        assert!(misses < 2 * n * n * 3 / 4, "{misses}");
    }
}
