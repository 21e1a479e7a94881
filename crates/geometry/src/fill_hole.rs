//! Filling a hole with triangles, found as a sequence of ears to cut off.
//!
//! ```text
//!      p --- ear               p
//!      |      |      -->       |  \           the loop goes on from p to q
//!      |      |                |    \
//!      + ---- q                + ---- q
//! ```

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use mesh::{DVec3, EditError, FaceId, HalfEdgeId, Mesh, VertexId};

/// Holes of at most this many edges are filled with the triangles of the smallest area: the time grows
/// with the third power, and is about a tenth of a second here.
const EXACT: usize = 500;

/// How much the shape of a triangle counts beside its area, in mean squares of the edges of the hole.
const SHAPE: f64 = 1e-6;

/// Puts triangles over the hole of `h`, a half-edge without a face.
///
/// ```text
///    +-----+-----+          +-----+-----+
///    |           |          | \       / |
///    |           |    -->   |   \   /   |       n edges around it: n - 2 triangles, n - 3 new edges
///    |           |          |     \/    |
///    +-----+--h--+          +-----+-----+
/// ```
///
/// Up to 500 edges the triangles have the smallest total area of all that use the vertices
/// around the hole and no others: Barequet and Sharir, "Filling gaps in the boundary of a polyhedron",
/// 1995, in time n³. Where several choices have the same area, as in a flat hole, the triangles are as
/// near to equilateral as they can be together: a measure of shape is added to each area, at most a
/// millionth of the mean square of the edges around the hole.
///
/// Around larger holes the corner whose neighbours are nearest to each other is cut off again and again,
/// in time n log n; corners that are straight or turn outwards, as seen along the mean normal, come
/// last. In a hole that is far from convex these triangles may overlap.
///
/// No two vertices are joined that share an edge already.
///
/// All ids stay; the new faces and edges are numbered in the order of the triangles returned, which
/// depends on `h` and on the shape of the hole. Faces take the values of the one beside `h`, and edges
/// zero values. All corners at a vertex take those of one corner, as in [`Mesh::fill_hole`].
///
/// Returns the triangles.
///
/// # Errors
///
/// [`EditError::DuplicateEdge`] if there are no triangles without an edge that is there already (for
/// large holes: if none are found), [`EditError::Full`], and those of [`Mesh::fill_hole`]. The
/// mesh is unchanged.
pub fn fill_hole_triangles(mesh: &mut Mesh, h: HalfEdgeId) -> Result<Vec<FaceId>, EditError> {
    let ears = ears(mesh, &mesh.rim(h)?)?;
    mesh.fill_hole_by_ears(h, &ears)
}

/// The places on the rim of the vertices to cut off, in order; two fewer than it has.
fn ears(mesh: &Mesh, rim: &[HalfEdgeId]) -> Result<Vec<usize>, EditError> {
    let hole = Hole::of(mesh, rim);
    let ears = if rim.len() <= EXACT {
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
    /// What the worst shape of a triangle adds to its area.
    shape: f64,
}

/// The cost of the best triangles over a part of the rim, and the third corner of the one at the edge between
/// the ends of the part.
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
            shape: SHAPE * mean_square,
        }
    }

    /// Whether the mesh has an edge between two vertices of the rim.
    fn is_joined(&self, i: usize, k: usize) -> bool {
        let (v, w) = (self.vertices[i], self.vertices[k]);
        self.mesh.find_half_edge(v, w).is_some()
    }

    /// The area of a triangle, and a little more the farther it is from equilateral: Weitzenböck's
    /// inequality says that 4 √3 times the area is at most the sum of the squares of the sides.
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

    /// The triangles of the smallest cost, from the best ones over all shorter parts of the rim. `None` if
    /// all need an edge that is there already.
    fn smallest(&self) -> Option<Vec<usize>> {
        let n = self.points.len();
        let mut best: Vec<Option<Best>> = vec![None; n * n];
        for i in 1..n {
            best[(i - 1) * n + i] = Some((0.0, i));
        }
        for length in 2..n {
            for i in 0..n - length {
                let k = i + length;
                // The last edge of the rim is not a new one.
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
                    // The first one of all, so that coordinates too large to square do no harm.
                    if found.is_none_or(|(least, _)| cost < least) {
                        found = Some((cost, middle));
                    }
                }
                best[i * n + k] = found;
            }
        }

        // A triangle is an ear when the parts on both sides of it are cut off: from the last one back.
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

    /// Cuts off the ear with the shortest edge, again and again. `None` if each that is left needs an edge
    /// that is there already.
    fn nearest_first(&self) -> Option<Vec<usize>> {
        let n = self.points.len();
        let mut next: Vec<usize> = (1..n).chain([0]).collect();
        let mut before: Vec<usize> = [n - 1].into_iter().chain(0..n - 1).collect();
        let normal = self.normal();
        let key = |p: usize, ear: usize, q: usize| {
            let (a, b, c) = (self.points[p], self.points[ear], self.points[q]);
            let is_inward = (b - a).cross(c - b).dot(normal) > 0.0;
            // The bits of numbers that are not negative are in their order.
            (!is_inward, a.distance_squared(c).to_bits())
        };
        let mut queue: BinaryHeap<_> = (0..n)
            .map(|i| Reverse((key(before[i], i, next[i]), i, before[i], next[i])))
            .collect();
        let mut ears = Vec::with_capacity(n - 2);
        let mut is_cut = vec![false; n];
        while ears.len() < n - 3 {
            let Reverse((_, ear, p, q)) = queue.pop()?;
            // Of an ear that was there before its neighbours were cut off, a later entry tells.
            let is_old = is_cut[ear] || before[ear] != p || next[ear] != q;
            if is_old || self.is_joined(p, q) {
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

    /// The area vector of the rim, by Newell's method.
    fn normal(&self) -> DVec3 {
        let first = self.points[0];
        let sides = self.points.windows(2);
        sides.map(|s| (s[0] - first).cross(s[1] - first)).sum()
    }

    /// The first edge that is there already and is in the way.
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

    /// A hole through these points: the rim of one face whose back is open.
    fn sheet(points: &[DVec3]) -> Mesh {
        let corners: Vec<u32> = (0..u32::try_from(points.len()).unwrap()).rev().collect();
        Mesh::from_polygons(points.to_vec(), &[corners]).unwrap().0
    }

    fn rim(mesh: &Mesh) -> Vec<HalfEdgeId> {
        mesh.loop_half_edges(mesh.boundary_loops()[0]).collect()
    }

    /// The triangles that cutting off these ears makes, and what is left of the loop.
    fn triangles(n: usize, ears: &[usize]) -> Vec<[usize; 3]> {
        let mut left: Vec<usize> = (0..n).collect();
        let mut triangles = Vec::new();
        for &ear in ears {
            let at = left.iter().position(|&i| i == ear).expect("not cut before");
            let beside = |by: usize| left[(at + by) % left.len()];
            triangles.push([beside(left.len() - 1), ear, beside(1)]);
            left.remove(at);
        }
        assert_eq!(left.len(), 2);
        triangles
    }

    /// The smallest sum of a cost over all ways to cut the polygon from i to k, tried one by one.
    fn smallest(i: usize, k: usize, cost: &dyn Fn(usize, usize, usize) -> f64) -> f64 {
        if k - i < 2 {
            return 0.0;
        }
        let ways = (i + 1..k).map(|m| cost(i, m, k) + smallest(i, m, cost) + smallest(m, k, cost));
        ways.fold(f64::INFINITY, f64::min)
    }

    /// Points that a small generator makes, between -1 and 1.
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
    fn no_other_triangles_have_a_smaller_area() {
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
    fn both_ways_give_as_many_triangles_as_they_must() {
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
    fn a_round_hole_is_covered_without_overlaps_both_ways() {
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
    fn points_in_one_place_or_very_far_away_still_give_triangles() {
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
