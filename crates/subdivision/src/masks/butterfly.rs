//! The masks of modified Butterfly subdivision: old vertices stay in place, and new vertices lie on a smooth
//! surface through them.
//!
//! ```text
//!    -1/16 ---- 1/8 ---- -1/16           s2    s1
//!        \     /   \     /                 \  /
//!         \   /     \   /            s3 -- 3/4 -*- s0       -1/16 -- 9/16 -*- 9/16 -- -1/16
//!          1/2 --*-- 1/2                   /  \
//!         /   \     /   \                s4    s5
//!        /     \   /     \
//!    -1/16 ---- 1/8 ---- -1/16
//!
//!    inside, both ends regular     at an extraordinary end       on the boundary
//! ```
//!
//! An inner vertex is extraordinary if its valence n is not 6. The neighbors of an extraordinary vertex have the
//! indices j = 0 to n - 1, starting at the other end of the edge, and the weights
//!
//! - 5/12, -1/12, -1/12 for n = 3 and 3/8, 0, -1/8, 0 for n = 4,
//! - (1/4 + cos(2πj/n) + cos(4πj/n)/2)/n for n ≥ 5.
//!
//! If both ends of an edge are extraordinary, the new vertex is the mean of the points that the two masks give. Source:
//! Zorin, Schröder and Sweldens, "Interpolating Subdivision for Meshes with Arbitrary Topology", 1996. The mask on the
//! boundary is from Dyn, Levin and Gregory, "A 4-point interpolatory subdivision scheme for curve design", 1987. The
//! two cited papers leave three cases open:
//!
//! - If a vertex with weight -1/16 would lie beyond a boundary edge, this vertex is missing. The corner opposite to the
//!   boundary edge, reflected through the middle of the edge, replaces the missing vertex. In this way, the new
//!   vertices of a flat regular grid lie on the refined grid, up to the boundary.
//! - Boundary vertices are never extraordinary.
//! - For n = 2, the neighbors have the weights 3/8 and -1/8. These two weights are the weights for n = 4 without the
//!   two zeros.

use std::f64::consts::TAU;

use mesh::{EdgeId, HalfEdgeId, Mesh};

use super::Masks;

pub(crate) struct ButterflyMasks<'a>(pub(crate) &'a Mesh);

impl Masks for ButterflyMasks<'_> {
    #[inline]
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        match i.checked_sub(self.0.n_vertices()) {
            None => add(i, 1.0),
            Some(e) => self.on_edge(EdgeId::new(e), add),
        }
    }
}

impl ButterflyMasks<'_> {
    #[inline]
    fn on_edge(&self, e: EdgeId, add: &mut impl FnMut(usize, f64)) {
        let halves = e.half_edges();
        if let Some(h) = halves.into_iter().find(|&h| self.0.face(h).is_none()) {
            return self.on_boundary(h, add);
        }
        match halves.map(|h| self.extraordinary(h)) {
            [None, None] => {
                for h in halves {
                    self.regular_half(h, add);
                }
            }
            [Some(n), None] => self.at_extraordinary(halves[0], n, 1.0, add),
            [None, Some(n)] => self.at_extraordinary(halves[1], n, 1.0, add),
            [Some(n), Some(m)] => {
                self.at_extraordinary(halves[0], n, 0.5, add);
                self.at_extraordinary(halves[1], m, 0.5, add);
            }
        }
    }

    /// Returns the valence of the origin of `h` if that vertex is extraordinary; otherwise `None`.
    #[inline]
    fn extraordinary(&self, h: HalfEdgeId) -> Option<usize> {
        let v = self.0.origin(h);
        let n = self.0.valence(v);
        (n != 6 && !self.0.is_boundary_vertex(v)).then_some(n)
    }

    /// The terms of the regular mask form two groups, one for each half-edge of the edge. Calls `add` for the group of
    /// `h`: the origin of `h`, and the vertices on the same side of the edge as the triangle of `h`.
    #[inline]
    fn regular_half(&self, h: HalfEdgeId, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.0;
        let [to_apex, to_origin] = [mesh.next(h), mesh.next(mesh.next(h))];
        add(mesh.origin(h).index(), 0.5);
        add(mesh.origin(to_origin).index(), 0.125);
        for side in [to_apex, to_origin] {
            let beyond = side.twin();
            if mesh.face(beyond).is_some() {
                add(mesh.target(mesh.next(beyond)).index(), -0.0625);
            } else {
                let opposite = mesh.target(mesh.next(side));
                add(mesh.origin(side).index(), -0.0625);
                add(mesh.target(side).index(), -0.0625);
                add(opposite.index(), 0.0625);
            }
        }
    }

    /// The origin of `h` is an extraordinary vertex of valence `n`. Calls `add` with the weights of this vertex and its
    /// neighbors, multiplied by `scale`.
    fn at_extraordinary(
        &self,
        h: HalfEdgeId,
        n: usize,
        scale: f64,
        add: &mut impl FnMut(usize, f64),
    ) {
        add(self.0.origin(h).index(), 0.75 * scale);
        let mut spoke = h;
        for j in 0..n {
            add(self.0.target(spoke).index(), ring_weight(n, j) * scale);
            spoke = self.0.next(spoke.twin());
        }
    }

    /// `h` is the boundary half-edge of a boundary edge. Calls `add` with each old vertex that contributes to the new
    /// vertex on this edge, and with the weight of the old vertex.
    fn on_boundary(&self, h: HalfEdgeId, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.0;
        add(mesh.origin(mesh.prev(h)).index(), -0.0625);
        add(mesh.origin(h).index(), 0.5625);
        add(mesh.target(h).index(), 0.5625);
        add(mesh.target(mesh.next(h)).index(), -0.0625);
    }
}

/// Returns the weight of the `j`-th of the `n` neighbors of an extraordinary vertex. The weights sum to 1/4.
fn ring_weight(n: usize, j: usize) -> f64 {
    match (n, j) {
        (3, 0) => 5.0 / 12.0,
        (3, _) => -1.0 / 12.0,
        (2 | 4, 0) => 3.0 / 8.0,
        (2, 1) | (4, 2) => -1.0 / 8.0,
        (4, _) => 0.0,
        _ => {
            let angle = TAU * (j as f64 / n as f64);
            (0.25 + libm::cos(angle) + 0.5 * libm::cos(2.0 * angle)) / n as f64
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_of_a_ring_sum_to_a_quarter() {
        for n in 2..40 {
            let sum: f64 = (0..n).map(|j| ring_weight(n, j)).sum();
            assert!((sum - 0.25).abs() < 1e-15, "{n} {sum}");
        }
    }

    #[test]
    fn quadratic_functions_around_a_vertex_are_reproduced_exactly() {
        // In polar coordinates r and t around the old vertex, the new vertex is at r = 1/2 and t = 0, halfway to the
        // one-ring. At the new vertex, r cos t is 1/2 and r² cos 2t is 1/4. The mask reproduces r² cos 2t only if the
        // old vertex has at least five neighbors.
        for n in 5..20 {
            let ring = |k: f64| -> f64 {
                let at = |j: usize| libm::cos(k * TAU * j as f64 / n as f64);
                (0..n).map(|j| ring_weight(n, j) * at(j)).sum()
            };
            assert!((ring(1.0) - 0.5).abs() < 1e-14, "{n}");
            assert!((ring(2.0) - 0.25).abs() < 1e-14, "{n}");
        }
    }
}
