//! Fills a hole with triangles by cutting off ears, one after another. An ear is a vertex at the border of the hole
//! that a new triangle cuts off. The corners of this triangle are the ear and its two neighbors around the hole, p and
//! q. The hole that remains has an edge from p to q and no longer touches the ear.
//!
//! ```text
//!      p --- ear               p
//!      |      |      -->       |  \           the loop continues from p to q
//!      |      |                |    \
//!      + ---- q                + ---- q
//! ```

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use mesh::{DVec3, EditError, FaceId, HalfEdgeId, Mesh, VertexId};

/// If a hole has at most this number of edges, the triangulation with the smallest cost is computed. The time for this
/// computation is proportional to the third power of the number of edges: about a tenth of a second for 500 edges.
const MAX_EXACT_EDGES: usize = 500;

/// The largest value of the shape term, as a fraction of the mean squared edge length of the hole. The cost of a
/// triangle is its area plus a shape term.
const SHAPE_WEIGHT: f64 = 1e-6;

/// Fills a hole with triangles. `h` is a half-edge without a face, at the border of the hole.
///
/// ```text
///    +-----+-----+          +-----+-----+
///    |           |          | \       / |
///    |           |    -->   |   \   /   |       a hole with n edges: n - 2 triangles, n - 3 new edges
///    |           |          |     \/    |
///    +-----+--h--+          +-----+-----+
/// ```
///
/// If the hole has at most 500 edges, the triangulation with the smallest cost is used. The cost is the total area,
/// plus a shape term for each triangle. The shape term is at most 1e-6 times the mean squared edge length of the hole.
/// If several triangulations have the same area, for example in a flat hole, the shape terms select the triangulation
/// whose triangles are closest to equilateral. Source: Barequet and Sharir, "Filling gaps in the boundary of a
/// polyhedron", 1995. The time is proportional to n³ for n edges.
///
/// In a hole with more than 500 edges, corners are cut off one after another. The next corner is always the convex
/// corner whose two neighbors are nearest to each other. Corners that are straight or reflex, as seen along the mean
/// normal, are cut off last. Cutting off all corners takes time proportional to n log n for n edges. In a hole that is
/// far from convex, the triangles can overlap.
///
/// A new edge never connects two vertices that already share an edge.
///
/// All ids stay valid. The new faces and edges are numbered in the order of the returned triangles. The order of the
/// triangles depends on `h` and on the shape of the hole. New faces copy the values of the face on the other side of
/// `h`, and new edges have zero values. All new corners at a vertex copy the values of one existing corner, as in
/// [`Mesh::fill_hole`].
///
/// Returns the triangles.
///
/// # Errors
///
/// Returns [`EditError::DuplicateEdge`] if every triangulation needs an edge that already exists. In a hole of more
/// than 500 edges, a triangulation can exist despite this error, because the search tries only one order of the
/// corners. Also returns [`EditError::Full`] and the errors of [`Mesh::fill_hole`]. After an error, the mesh is
/// unchanged.
pub fn fill_hole_triangles(mesh: &mut Mesh, h: HalfEdgeId) -> Result<Vec<FaceId>, EditError> {
    let ears = ears(mesh, &mesh.rim(h)?)?;
    mesh.fill_hole_by_ears(h, &ears)
}

/// Returns the vertices to cut off, in order. `rim` lists the half-edges around the hole. A vertex is given by the
/// index of the half-edge that starts at the vertex. The two vertices that remain at the end are not returned.
fn ears(mesh: &Mesh, rim: &[HalfEdgeId]) -> Result<Vec<usize>, EditError> {
    let hole = Hole::of(mesh, rim);
    let ears = if rim.len() <= MAX_EXACT_EDGES {
        hole.smallest()
    } else {
        hole.nearest_first()
    };
    ears.ok_or_else(|| hole.duplicate())
}

struct Hole<'m> {
    mesh: &'m Mesh,
    vertices: Vec<VertexId>,
    points: Vec<DVec3>,
    /// The largest shape term: the cost that is added to the area of a degenerate triangle.
    shape: f64,
}

/// The cheapest triangulation of a part of the rim (consecutive vertices around the hole). The first number is the cost
/// of the triangulation. The second number is the index of a vertex of the part. This vertex and the two ends of the
/// part are the corners of one of the triangles.
type Best = (f64, usize);

impl<'m> Hole<'m> {
    fn of(mesh: &'m Mesh, rim: &[HalfEdgeId]) -> Self {
        let vertices: Vec<VertexId> = rim.iter().map(|&h| mesh.origin(h)).collect();
        let points: Vec<DVec3> = vertices.iter().map(|&v| mesh.position(v)).collect();
        let lengths = rim.iter().map(|&h| mesh.length(h));
        let mean_square = lengths.map(|l| l * l).sum::<f64>() / rim.len() as f64;
        Self {
            mesh,
            vertices,
            points,
            shape: SHAPE_WEIGHT * mean_square,
        }
    }

    /// Whether the mesh has an edge between two vertices of the rim.
    fn is_joined(&self, i: usize, k: usize) -> bool {
        let (v, w) = (self.vertices[i], self.vertices[k]);
        self.mesh.find_half_edge(v, w).is_some()
    }

    /// Returns the cost of a triangle: its area plus a shape term that grows with the deviation from an equilateral
    /// triangle. By Weitzenböck's inequality, 4 √3 times the area is at most the sum of the squared sides, so
    /// `roundness` is at most 1. The value of `roundness` is 1 for an equilateral triangle.
    fn cost(&self, i: usize, m: usize, k: usize) -> f64 {
        let (a, b, c) = (self.points[i], self.points[m], self.points[k]);
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let twice = ab.cross(bc).length();
        let squares = ab.length_squared() + bc.length_squared() + ca.length_squared();
        let roundness = if squares > 0.0 {
            12.0_f64.sqrt() * twice / squares
        } else {
            0.0
        };
        0.5 * twice + self.shape * (1.0 - roundness)
    }

    /// Finds the triangulation with the smallest total cost, by dynamic programming over parts of the rim (consecutive
    /// vertices around the hole). Returns the ears in the order in which they are cut off. Returns `None` if every
    /// triangulation needs an edge that already exists.
    fn smallest(&self) -> Option<Vec<usize>> {
        let n = self.points.len();
        let mut best: Vec<Option<Best>> = vec![None; n * n];
        for i in 1..n {
            best[(i - 1) * n + i] = Some((0.0, i));
        }
        for length in 2..n {
            for i in 0..n - length {
                let k = i + length;
                // The part of the hole between the corners i and k is filled separately, so it needs a new edge from i
                // to k. If the mesh already has this edge, the part cannot be filled separately. The part with all
                // corners is an exception: its edge from i to k is an old edge at the border of the hole.
                if length < n - 1 && self.is_joined(i, k) {
                    continue;
                }
                let mut found: Option<Best> = None;
                for middle in i + 1..k {
                    let parts = (best[i * n + middle], best[middle * n + k]);
                    let (Some((left, _)), Some((right, _))) = parts else {
                        continue;
                    };
                    let cost = left + right + self.cost(i, middle, k);
                    // Accepts the first candidate even if its cost is not finite. Otherwise, no candidate would be
                    // found for a hole with very large coordinates.
                    if found.is_none_or(|(least, _)| cost < least) {
                        found = Some((cost, middle));
                    }
                }
                best[i * n + k] = found;
            }
        }

        // The corner `middle` of a triangle is cut off only after the two parts of the hole beside the triangle are
        // filled. The loop below visits each triangle before the two parts beside it, so the order is reversed at the
        // end.
        let mut ears = Vec::with_capacity(n - 2);
        let mut parts = vec![(0, n - 1)];
        while let Some((i, k)) = parts.pop() {
            if k - i > 1 {
                let (_, middle) = best[i * n + k]?;
                ears.push(middle);
                parts.extend([(i, middle), (middle, k)]);
            }
        }
        ears.reverse();
        Some(ears)
    }

    /// Repeatedly cuts off the ear with the shortest new edge, convex ears first. Returns the ears in the order in
    /// which they are cut off. Returns `None` if every remaining ear needs an edge that already exists.
    fn nearest_first(&self) -> Option<Vec<usize>> {
        let n = self.points.len();
        let mut next: Vec<usize> = (1..n).chain([0]).collect();
        let mut before: Vec<usize> = [n - 1].into_iter().chain(0..n - 1).collect();
        let normal = self.normal();
        let key = |p: usize, ear: usize, q: usize| {
            let (a, b, c) = (self.points[p], self.points[ear], self.points[q]);
            let is_inward = (b - a).cross(c - b).dot(normal) > 0.0;
            // The heap compares the bits of `f64` numbers. For non-negative numbers, the bits (read as an integer) have
            // the same order as the numbers.
            (!is_inward, a.distance_squared(c).to_bits())
        };
        let mut queue: BinaryHeap<_> = (0..n)
            .map(|i| Reverse((key(before[i], i, next[i]), i, before[i], next[i])))
            .collect();
        let mut ears = Vec::with_capacity(n - 2);
        let mut is_cut = vec![false; n];
        while ears.len() < n - 3 {
            let Reverse((_, ear, p, q)) = queue.pop()?;
            // An entry is out of date if its corner, or one of the two neighbors of the corner, was cut off. Entries
            // that are out of date are skipped. The queue has a newer entry for each corner that remains.
            let is_outdated = is_cut[ear] || before[ear] != p || next[ear] != q;
            if is_outdated || self.is_joined(p, q) {
                continue;
            }
            ears.push(ear);
            is_cut[ear] = true;
            (next[p], before[q]) = (q, p);
            for i in [p, q] {
                queue.push(Reverse((key(before[i], i, next[i]), i, before[i], next[i])));
            }
        }
        ears.push(is_cut.iter().position(|cut| !cut)?);
        Some(ears)
    }

    /// Returns twice the area vector of the polygon around the hole, by Newell's method.
    fn normal(&self) -> DVec3 {
        let first = self.points[0];
        let sides = self.points.windows(2);
        sides.map(|s| (s[0] - first).cross(s[1] - first)).sum()
    }

    /// Returns the error for a hole that cannot be filled. The error names the first two vertices that already share an
    /// edge without being neighbors around the hole.
    fn duplicate(&self) -> EditError {
        let n = self.points.len();
        let pairs = (0..n).flat_map(|i| (i + 2..n).map(move |k| (i, k)));
        let mut inner = pairs.filter(|&(i, k)| k - i < n - 1);
        let (i, k) = inner
            .find(|&(i, k)| self.is_joined(i, k))
            .unwrap_or_default();
        EditError::DuplicateEdge(self.vertices[i], self.vertices[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    /// Returns a mesh of one face with corners at the given points. The boundary of this face counts as a hole.
    fn sheet(points: &[DVec3]) -> Mesh {
        let corners: Vec<u32> = (0..u32::try_from(points.len()).unwrap()).rev().collect();
        Mesh::from_polygons(points.to_vec(), &[corners]).unwrap().0
    }

    fn rim(mesh: &Mesh) -> Vec<HalfEdgeId> {
        mesh.loop_half_edges(mesh.boundary_loops()[0]).collect()
    }

    /// Returns the triangles made by cutting off the given ears.
    fn triangles(n: usize, ears: &[usize]) -> Vec<[usize; 3]> {
        let mut remaining: Vec<usize> = (0..n).collect();
        let mut triangles = Vec::new();
        for &ear in ears {
            let place = remaining
                .iter()
                .position(|&i| i == ear)
                .expect("not cut before");
            let neighbor = |by: usize| remaining[(place + by) % remaining.len()];
            triangles.push([neighbor(remaining.len() - 1), ear, neighbor(1)]);
            remaining.remove(place);
        }
        assert_eq!(remaining.len(), 2);
        triangles
    }

    /// Returns the smallest total cost of all triangulations of the polygon from i to k, by exhaustive search.
    fn smallest(i: usize, k: usize, cost: &dyn Fn(usize, usize, usize) -> f64) -> f64 {
        if k - i < 2 {
            return 0.0;
        }
        let ways = (i + 1..k).map(|m| cost(i, m, k) + smallest(i, m, cost) + smallest(m, k, cost));
        ways.fold(f64::INFINITY, f64::min)
    }

    /// Returns pseudo-random points with coordinates between -1 and 1.
    fn points(n: usize, seed: u32) -> Vec<DVec3> {
        let mut state = seed;
        let mut number = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 23) - 1.0
        };
        (0..n)
            .map(|_| DVec3::new(number(), number(), number()))
            .collect()
    }

    #[test]
    fn the_exact_method_finds_the_smallest_area() {
        for n in 3..=9 {
            for seed in 0..20 {
                let mesh = sheet(&points(n, seed));
                let rim = rim(&mesh);
                let hole = Hole::of(&mesh, &rim);
                let ears = hole.smallest().unwrap();
                let sum = |cost: &dyn Fn(usize, usize, usize) -> f64| {
                    let triangles = triangles(n, &ears);
                    let costs = triangles.iter().map(|&[i, m, k]| cost(i, m, k));
                    (costs.sum::<f64>(), smallest(0, n - 1, cost))
                };
                let (found, least) = sum(&|i, m, k| hole.cost(i, m, k));
                assert!((found - least).abs() < 1e-12, "{found} {least}");
                let p = &hole.points;
                let area =
                    |i: usize, m: usize, k: usize| (p[m] - p[i]).cross(p[k] - p[i]).length() / 2.0;
                let (found, least) = sum(&area);
                assert!(found - least < hole.shape * n as f64, "{found} {least}");
            }
        }
    }

    #[test]
    fn both_methods_return_n_minus_2_triangles() {
        for n in [3, 4, 7, 20] {
            for seed in 0..10 {
                let mesh = sheet(&points(n, seed));
                let rim = rim(&mesh);
                let hole = Hole::of(&mesh, &rim);
                for ears in [hole.smallest().unwrap(), hole.nearest_first().unwrap()] {
                    assert_eq!(triangles(n, &ears).len(), n - 2);
                }
            }
        }
    }

    #[test]
    fn both_methods_cover_a_round_hole_without_overlaps() {
        let mesh = shapes::cylinder(24, false);
        let rim = rim(&mesh);
        let hole = Hole::of(&mesh, &rim);
        for ears in [hole.smallest().unwrap(), hole.nearest_first().unwrap()] {
            let p = &hole.points;
            let normals = triangles(24, &ears)
                .into_iter()
                .map(|[i, m, k]| (p[m] - p[i]).cross(p[k] - p[m]));
            let up = hole.normal();
            let areas: f64 = normals.clone().map(|n| n.length() / 2.0).sum();
            assert!(normals.clone().all(|n| n.dot(up) > 0.0));
            assert!((areas - up.length() / 2.0).abs() < 1e-12);
        }
    }

    #[test]
    fn coincident_and_very_distant_points_are_triangulated() {
        for points in [
            vec![DVec3::ONE; 5],
            points(5, 1).into_iter().map(|p| p * 1e300).collect(),
        ] {
            let mesh = sheet(&points);
            let rim = rim(&mesh);
            let hole = Hole::of(&mesh, &rim);
            for ears in [hole.smallest().unwrap(), hole.nearest_first().unwrap()] {
                assert_eq!(triangles(5, &ears).len(), 3);
            }
        }
    }
}
