//! The masks of Doo-Sabin subdivision.
//!
//! ```text
//!     3/16 ---- 1/16          1/6
//!      |         |            /  \                    3/4 --*------- 1/4
//!      |    *    |           / *  \
//!      |         |         2/3 --- 1/6
//!     9/16 ---- 3/16
//!
//!      at the corner          likewise                on the boundary
//! ```
//!
//! In a face with n corners, the one that the point is pulled in from has the weight (n + 5)/(4n), the j-th
//! from there (3 + 2 cos(2πj/n))/(4n). Doo and Sabin, "Behaviour of recursive division surfaces near
//! extraordinary points", 1978. On the boundary Chaikin, "An algorithm for high-speed curve generation", 1974.

use std::f64::consts::TAU;

use mesh::{HalfEdgeId, Mesh};

use super::Masks;
use crate::doo_sabin::{DooSabin, Source};
use crate::links::Links;

impl Masks for DooSabin<'_> {
    fn n_vertices(&self) -> usize {
        self.counts()[0]
    }

    #[inline]
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.mesh;
        match self.source(i) {
            Source::Corner(h) => pulled(mesh, h, |h, w| add(mesh.origin(h).index(), w)),
            Source::Near(h) => {
                add(mesh.origin(h).index(), 0.75);
                add(mesh.target(h).index(), 0.25);
            }
            Source::Isolated(v) => add(v.index(), 1.0),
        }
    }
}

/// Adds the corners of the face of `h`, by the half-edges that leave them, with their weights in the point
/// pulled in from the origin of `h`.
#[inline]
pub(crate) fn pulled(mesh: &Mesh, h: HalfEdgeId, mut add: impl FnMut(HalfEdgeId, f64)) {
    let n = mesh.loop_half_edges(h).count();
    for (j, h) in mesh.loop_half_edges(h).enumerate() {
        add(h, weight(n, j));
    }
}

/// The weight of the `j`-th corner of a face with `n`.
#[inline]
fn weight(n: usize, j: usize) -> f64 {
    match (n, j) {
        (4, 0) => 9.0 / 16.0,
        (4, 2) => 1.0 / 16.0,
        (4, _) => 3.0 / 16.0,
        (3, 0) => 2.0 / 3.0,
        (3, _) => 1.0 / 6.0,
        (_, 0) => (n + 5) as f64 / (4 * n) as f64,
        _ => (3.0 + 2.0 * libm::cos(TAU * (j as f64 / n as f64))) / (4 * n) as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_of_a_face_sum_to_one_and_pull_a_regular_polygon_in_by_half() {
        for n in 3..30 {
            let ring = |k: f64| -> f64 {
                let at = |j: usize| libm::cos(k * TAU * j as f64 / n as f64);
                (0..n).map(|j| weight(n, j) * at(j)).sum()
            };
            assert!((ring(0.0) - 1.0).abs() < 1e-15, "{n}");
            assert!((ring(1.0) - 0.5).abs() < 1e-15, "{n}");
        }
    }
}
