//! Cuts a large polygon into pieces by diagonals, because the time of ear clipping can grow with the square of the
//! number of corners.
//!
//! ```text
//!        .------- b         A ray from corner a into the polygon meets a side. The end b of this side is visible
//!       /    /    |         from a, unless other corners lie in the triangle between a, b and the point that the
//!      /    / . ' |         ray meets. In this case, the corner next to the ray is visible.
//!     '--- a -----'
//! ```

use std::cmp::Ordering::Less;

use mesh::DVec2;

use super::Triangle;
use crate::predicates::orient2d;

/// Larger polygons are cut. A polygon with this number of corners takes ear clipping at most about 50 ms.
const LARGEST: usize = 4096;
/// A polygon with fewer corners is clipped without a check for cancellation, because this takes little time.
pub(super) const LEAST: usize = 256;
/// The number of corners that are tried as an end of a diagonal.
const TRIES: usize = 32;
/// A diagonal is used only if the smaller of its two parts has at least 1 / `LEAST_PART` of the corners. Without this
/// limit, a polygon could be cut once for each corner.
const LEAST_PART: usize = 64;

/// Triangulates a large counter-clockwise polygon. `clip` triangulates a smaller one.
///
/// Returns `None` if the polygon is not large or cannot be cut, if `clip` fails, or if a triangle is turned over, because
/// the sides of the polygon cross.
pub(super) fn triangulate(
    points: &[[f64; 2]],
    clip: &mut impl FnMut(&[[f64; 2]]) -> Option<Vec<Triangle>>,
) -> Option<Vec<Triangle>> {
    if points.len() <= LARGEST {
        return None;
    }
    let mut open: Vec<Vec<u32>> = vec![(0..).zip(points).map(|(i, _)| i).collect()];
    let mut triangles = Vec::with_capacity(points.len());
    while let Some(corners) = open.pop() {
        let piece = Piece {
            points,
            corners: &corners,
        };
        if let Some([i, j]) = piece.diagonal() {
            open.push([&corners[..=i], &corners[j..]].concat());
            open.push(corners[i..=j].to_vec());
        } else if corners.len() < points.len() {
            let at = |&i: &u32| points[i as usize];
            let own = clip(&corners.iter().map(at).collect::<Vec<_>>())?;
            // The corners of a piece are in ascending order, and so are the corners of its triangles.
            let own = own.into_iter();
            triangles.extend(own.map(|triangle| triangle.map(|i| corners[i as usize])));
        }
    }
    let faces_up = |triangle: &Triangle| {
        let [a, b, c] = triangle.map(|i| points[i as usize].into());
        orient2d(a, b, c) != Less
    };
    triangles.sort_unstable();
    (!triangles.is_empty() && triangles.iter().all(faces_up)).then_some(triangles)
}

/// A part of a polygon.
struct Piece<'a> {
    points: &'a [[f64; 2]],
    corners: &'a [u32],
}

impl Piece<'_> {
    /// The position of a corner of the piece. Corners after the last one start again at the first.
    fn at(&self, i: usize) -> DVec2 {
        self.points[self.corners[i % self.corners.len()] as usize].into()
    }

    /// Returns the ends of a diagonal with many corners on each side, the lower end first. `None` if the piece is small
    /// enough, or if no diagonal is found.
    fn diagonal(&self) -> Option<[usize; 2]> {
        let n = self.corners.len();
        if n <= LARGEST {
            return None;
        }
        // Distant corners are usually visible from the corners near the center.
        let center = (0..n).map(|i| self.at(i)).sum::<DVec2>() / n as f64;
        let distance = |i: &usize| self.at(*i).distance_squared(center);
        let near = |k: usize| {
            let block = k * n / TRIES..(k + 1) * n / TRIES;
            block.min_by(|i, j| distance(i).total_cmp(&distance(j)))
        };
        let mut best = None;
        for i in (0..TRIES).filter_map(near) {
            for j in self.visible(i).into_iter().flatten() {
                let part = i.abs_diff(j).min(n - i.abs_diff(j));
                if best.is_none_or(|(most, _)| part > most) && self.is_diagonal(i, j) {
                    best = Some((part, [i.min(j), i.max(j)]));
                }
            }
            if best.is_some_and(|(part, _)| part >= n / 4) {
                break;
            }
        }
        let (part, ends) = best?;
        (part >= n / LEAST_PART).then_some(ends)
    }

    /// Returns corners that are visible from corner `i`, on the two sides of a ray that halves the angle at the corner.
    fn visible(&self, i: usize) -> Option<[usize; 2]> {
        let n = self.corners.len();
        let from = self.at(i);
        let next = (self.at(i + 1) - from).try_normalize()?;
        let last = (self.at(i + n - 1) - from).try_normalize()?;
        let ray = (next.perp() - last.perp()).try_normalize()?;
        // The sides that do not end at the corner.
        let sides = (i + 1..i + n - 1).filter_map(|k| {
            let [a, b] = [self.at(k) - from, self.at(k + 1) - from];
            let [left, right] = [ray.perp_dot(a), ray.perp_dot(b)];
            let distance = ray.dot(a + (b - a) * (left / (left - right)));
            let is_met = (left < 0.0) != (right < 0.0) && distance > 0.0;
            is_met.then_some((distance, k))
        });
        let (distance, side) = sides.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let met = from + distance * ray;
        let found = [side, side + 1].map(|end| {
            let mut found = end;
            for k in i + 1..i + n {
                let [q, old] = [self.at(k) - from, self.at(found) - from];
                let turn = ray.perp_dot(old).signum();
                let is_nearer = q.perp_dot(old) * turn > 0.0 && ray.perp_dot(q) * turn >= 0.0;
                if is_nearer && (self.at(end) - met).perp_dot(from + q - met) * turn > 0.0 {
                    found = k;
                }
            }
            found % n
        });
        Some(found)
    }

    /// Whether the segment between two corners touches no side that does not end at one of these corners.
    fn is_diagonal(&self, i: usize, j: usize) -> bool {
        let n = self.corners.len();
        let [from, to] = [self.at(i), self.at(j)];
        (0..n).all(|k| {
            let ends = [k, (k + 1) % n];
            let [a, b] = ends.map(|k| self.at(k));
            let splits = |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| {
                let (c, d) = (orient2d(a, b, c), orient2d(a, b, d));
                c.is_eq() || d.is_eq() || c != d
            };
            ends.contains(&i)
                || ends.contains(&j)
                || !splits([from, to], [a, b])
                || !splits([a, b], [from, to])
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn circle(angle: f64, radius: f64) -> [f64; 2] {
        [radius * libm::cos(angle), radius * libm::sin(angle)]
    }

    /// A zigzag of this width whose corners are far apart: the worst case for ear clipping.
    fn comb(n: u32) -> Vec<[f64; 2]> {
        let upper = |i: u32| if i.is_multiple_of(2) { 0.0 } else { 100.0 };
        let there = (0..n / 2).map(|i| [f64::from(i), upper(i)]);
        let back = (0..n / 2).rev().map(|i| [f64::from(i), upper(i) + 5.0]);
        there.chain(back).collect()
    }

    /// A corridor that winds around the origin ten times.
    fn spiral(n: u32) -> Vec<[f64; 2]> {
        let at = |i: u32, radius: f64| {
            let t = 20.0 * f64::from(i) / f64::from(n);
            circle(TAU * t, radius + t)
        };
        let outside = (0..n / 2).map(|i| at(i, 1.5));
        outside
            .chain((0..n / 2).rev().map(|i| at(i, 1.0)))
            .collect()
    }

    fn star(n: u32) -> Vec<[f64; 2]> {
        let at = |i: u32| {
            let radius = 1.0 + f64::from(i * 7919 % 1000) / 1000.0;
            circle(TAU * f64::from(i) / f64::from(n), radius)
        };
        (0..n).map(at).collect()
    }

    /// Returns a fan. It is not a valid triangulation of every polygon with `n` corners, but has the right number of
    /// triangles.
    fn fan(n: usize) -> Vec<Triangle> {
        let n = u32::try_from(n).unwrap();
        (2..n).map(|i| [0, i - 1, i]).collect()
    }

    #[test]
    fn polygons_that_are_slow_to_clip_are_cut_into_small_pieces() {
        // Few corners of a star are visible from each other, so a piece can stay larger: at most a quarter of the star.
        for (polygon, largest) in [
            (comb(20_000), LARGEST),
            (spiral(20_000), LARGEST),
            (star(20_000), 5000),
        ] {
            let mut sizes = Vec::new();
            triangulate(&polygon, &mut |points| {
                sizes.push(points.len());
                Some(fan(points.len()))
            });
            assert!(sizes.iter().all(|size| *size <= largest), "{sizes:?}");
            // Each diagonal belongs to two pieces.
            let sum: usize = sizes.iter().sum();
            assert_eq!(sum, polygon.len() + 2 * (sizes.len() - 1));
        }
    }

    #[test]
    fn the_pieces_are_triangulated_without_turned_triangles() {
        let mut earcut = earcut::Earcut::new();
        let mut indices = Vec::new();
        let mut clip = |points: &[[f64; 2]]| super::super::clip(&mut earcut, &mut indices, points);
        for polygon in [comb(10_000), spiral(10_000), star(10_000)] {
            let found = triangulate(&polygon, &mut clip).unwrap();
            assert!(super::super::is_triangulation(polygon.len(), &found));
        }
        // A figure of eight: one of its halves is clockwise.
        let eight = |i: u32| {
            let angle = TAU * f64::from(i) / 9999.0;
            [libm::sin(angle) + 0.1, libm::sin(2.0 * angle)]
        };
        let crossing: Vec<[f64; 2]> = (0..9999).map(eight).collect();
        assert!(triangulate(&crossing, &mut clip).is_none());
        // Small polygons are not cut.
        assert!(triangulate(&star(4000), &mut clip).is_none());
    }
}
