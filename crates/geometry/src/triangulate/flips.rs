//! Flips diagonals of a triangulation until it is a constrained Delaunay triangulation.
//!
//! ```text
//!        l                l
//!      / | \            /   \
//!    p   |   q   -->   p --- q      q is inside the circle through p, r and l
//!      \ | /            \   /
//!        r                r
//! ```
//!
//! Source: Lawson, "Software for C1 Surface Interpolation", 1977. The flips are the same as in the crate `earcut`, in
//! the same order and with the same tolerance. The flip function of `earcut` is not used, because it cannot be canceled
//! and does not limit the number of flips.

use mesh::DVec2;

use super::sort::sort_unless;
use super::{Triangle, with_sorted_corners};

/// The largest number of flips is this number times the number of corners of the polygon. Without this limit, the
/// number of flips can grow with the square of the number of corners, for example in a long, bent corridor. Polygons
/// with at most 4096 corners never reach the limit.
const MAX_FLIPS: usize = 1024;
/// The number of diagonals that are examined between two checks for cancellation.
const CHECK: usize = 1 << 16;
/// Marks a side of the polygon in the list `mates`. A side of the polygon belongs to only one triangle, so it has no
/// mate.
const NONE: u32 = u32::MAX;

/// Improves triangulations, one after another, and uses the same buffers for all of them.
///
/// The sides of triangles are numbered: the side with the index 3 t + k begins at corner k of triangle t.
#[derive(Default)]
pub(super) struct Flips {
    /// The ends of each side, the lower corner first, with the index of the side.
    sides: Vec<([u32; 2], u32)>,
    /// For each side, its mate: the index of the same side in the other triangle, or [`NONE`] for a side of the
    /// polygon.
    mates: Vec<u32>,
    /// The diagonals that possibly have to be flipped. Each diagonal is given by one of its two sides.
    stack: Vec<u32>,
    is_queued: Vec<bool>,
}

impl Flips {
    /// Improves a triangulation by flips, and sorts its triangles. The triangles must be counter-clockwise, and the
    /// corners of each triangle in ascending order. Stops early if the number of flips reaches [`MAX_FLIPS`] times the
    /// number of corners of the polygon, or if `is_cancelled` returns `true`. The triangulation is then valid, but some
    /// of its diagonals are possibly not Delaunay.
    pub(super) fn improve(
        &mut self,
        points: &[[f64; 2]],
        triangles: &mut Vec<Triangle>,
        is_cancelled: &dyn Fn() -> bool,
    ) {
        if self.find_mates(is_cancelled, triangles).is_none() {
            return;
        }
        if self.sides.len() > CHECK && is_cancelled() {
            return;
        }
        let corners = triangles.as_flattened_mut();
        self.stack.clear();
        self.is_queued.clear();
        self.is_queued.resize(corners.len(), false);
        for side in 0..corners.len() {
            let mate = self.mates[side];
            if (mate as usize) < side {
                self.queue(mate);
            }
        }
        if corners.len() > CHECK && is_cancelled() {
            return;
        }
        let (mut n_flips, mut n_examined) = (0, 0_usize);
        while let Some(side) = self.stack.pop() {
            self.is_queued[side as usize] = false;
            n_flips += usize::from(self.flip(points, corners, side));
            n_examined += 1;
            let is_over = n_flips >= MAX_FLIPS * points.len();
            if is_over || n_examined.is_multiple_of(CHECK) && is_cancelled() {
                break;
            }
        }
        for triangle in triangles.iter_mut() {
            *triangle = with_sorted_corners(*triangle);
        }
        // If the sort is canceled, the triangles stay valid but are not sorted.
        let _ = sort_unless(is_cancelled, triangles, Ord::cmp);
    }

    /// Finds the mate of each side: the same side in the other triangle. Returns `None` if `is_cancelled` returns
    /// `true`.
    fn find_mates(
        &mut self,
        is_cancelled: &dyn Fn() -> bool,
        triangles: &[Triangle],
    ) -> Option<()> {
        self.sides.clear();
        let mut index = 0..;
        for part in triangles.chunks(CHECK) {
            if triangles.len() > CHECK && is_cancelled() {
                return None;
            }
            let sides = part.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [a, c]]);
            self.sides.extend(sides.zip(&mut index));
        }
        sort_unless(is_cancelled, &mut self.sides, Ord::cmp)?;
        if self.sides.len() > CHECK && is_cancelled() {
            return None;
        }
        self.mates.clear();
        self.mates.resize(self.sides.len(), NONE);
        for pair in self.sides.windows(2) {
            let [(ends, side), (other_ends, other)] = [pair[0], pair[1]];
            if ends == other_ends {
                self.mates[side as usize] = other;
                self.mates[other as usize] = side;
            }
        }
        Some(())
    }

    fn queue(&mut self, side: u32) {
        if self.mates[side as usize] != NONE && !self.is_queued[side as usize] {
            self.is_queued[side as usize] = true;
            self.stack.push(side);
        }
    }

    fn join(&mut self, side: u32, mate: u32) {
        self.mates[side as usize] = mate;
        if mate != NONE {
            self.mates[mate as usize] = side;
        }
    }

    /// Flips the diagonal at the side with the index `a`, if the diagonal is not Delaunay and the new triangles have a
    /// positive area. Returns whether the diagonal was flipped.
    fn flip(&mut self, points: &[[f64; 2]], corners: &mut [u32], a: u32) -> bool {
        let b = self.mates[a as usize];
        if b == NONE {
            // Another flip has changed the triangle of this side since the side was put on the stack. The side with
            // this index is now a side of the polygon, which cannot be flipped.
            return false;
        }
        let turned = |side: u32, by: u32| side - side % 3 + (side + by) % 3;
        let [a_next, a_last] = [turned(a, 1), turned(a, 2)];
        let [b_next, b_last] = [turned(b, 1), turned(b, 2)];
        let [r, l, p, q] = [a, a_next, a_last, b_last].map(|side| corners[side as usize]);
        let [from_r, from_l, from_p, at_q] =
            [r, l, p, q].map(|corner| DVec2::from(points[corner as usize]));
        if is_legal([from_p, from_r, from_l], at_q)
            || area(from_p, from_r, at_q) <= 0.0
            || area(from_p, at_q, from_l) <= 0.0
        {
            return false;
        }
        corners[a as usize] = q;
        corners[b as usize] = p;
        let (behind_p, behind_q) = (self.mates[a_last as usize], self.mates[b_last as usize]);
        self.join(a, behind_q);
        self.join(b, behind_p);
        self.join(a_last, b_last);
        for side in [a, b, a_next, b_next] {
            self.queue(side);
        }
        true
    }
}

/// Returns twice the signed area of a triangle.
fn area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether `q` is not inside the circle through the corners of a triangle, up to a tolerance.
fn is_legal(triangle: [DVec2; 3], q: DVec2) -> bool {
    let [d, e, f] = triangle.map(|p| p - q);
    let [a, b, c] = [d, e, f].map(DVec2::length_squared);
    let determinant =
        d.x * (e.y * c - b * f.y) - d.y * (e.x * c - b * f.x) + a * (e.x * f.y - e.y * f.x);
    let scale = a + b + c;
    determinant <= 1e-13 * scale * scale || determinant.is_nan()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::triangulate::{is_triangulation, monotone, to_triangles};

    fn circle(angle: f64, radius: f64) -> [f64; 2] {
        [radius * libm::cos(angle), radius * libm::sin(angle)]
    }

    /// A corridor that goes around the origin almost once. Its triangulation by a sweep needs many flips.
    fn corridor(n: u32) -> Vec<[f64; 2]> {
        let at = |i: u32, radius: f64| circle(0.9 * TAU * f64::from(i) / f64::from(n / 2), radius);
        let outside = (0..n / 2).map(|i| at(i, 1.5));
        outside
            .chain((0..n / 2).rev().map(|i| at(i, 1.0)))
            .collect()
    }

    #[test]
    fn the_flips_are_those_of_the_crate_earcut() {
        for n in [50, 500, 2000] {
            let points = corridor(n);
            let before = monotone::triangulate(&points, &|| false).unwrap();
            let mut indices = before.as_flattened().to_vec();
            earcut::refine(&mut indices, &points);
            let mut expected = to_triangles(&indices);
            expected.sort_unstable();
            let mut found = before.clone();
            Flips::default().improve(&points, &mut found, &|| false);
            assert_eq!(found, expected);
            assert_ne!(found, before);
        }
    }

    #[test]
    fn canceled_flips_leave_a_valid_triangulation() {
        let points = corridor(10_000);
        let mut found = monotone::triangulate(&points, &|| false).unwrap();
        let before = found.clone();
        Flips::default().improve(&points, &mut found, &|| true);
        assert!(found != before && is_triangulation(points.len(), &found));
    }
}
