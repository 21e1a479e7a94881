//! The masks of Loop subdivision.
//!
//! ```text
//!          1/8                  u     u
//!         /   \                  \   /
//!      3/8 -*- 3/8           u - 1-nu - u            1/2 --*-- 1/2       1/8 -- 3/4 -- 1/8
//!         \   /                  /   \
//!          1/8                  u     u
//!
//!     new, smooth          old, smooth, valence n    new, sharp         old, crease
//! ```
//!
//! Source: Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987. [`LoopWeights`] defines u.

use mesh::{EdgeId, Mesh, VertexId};

use super::{Masks, at_vertex};
use crate::rules::LoopWeights;
use crate::sharpness::Sharpness;

pub(crate) struct LoopMasks<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) sharpness: Sharpness<'a>,
    pub(crate) weights: LoopWeights,
}

impl LoopWeights {
    /// Returns the weight u of each neighbor of a vertex of valence `n`.
    #[inline]
    pub(crate) fn of(self, n: usize) -> f64 {
        let valence = n as f64;
        match (self, n) {
            (_, 6) => 1.0 / 16.0,
            (Self::Warren | Self::Loop, 3) => 3.0 / 16.0,
            (Self::Warren, _) => 3.0 / (8.0 * valence),
            (Self::Loop, _) => {
                let b = 0.375 + 0.25 * libm::cos(std::f64::consts::TAU / valence);
                (0.625 - b * b) / valence
            }
        }
    }
}

impl Masks for LoopMasks<'_> {
    #[inline]
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        let n_vertices = self.mesh.positions().len();
        if i < n_vertices {
            let v = VertexId::new(i);
            at_vertex(self.mesh, &self.sharpness, v, add, |weight, add| {
                let n = self.mesh.valence(v);
                let u = self.weights.of(n);
                add(i, (1.0 - n as f64 * u) * weight);
                for w in self.mesh.vertex_neighbors(v) {
                    add(w.index(), u * weight);
                }
            });
        } else {
            self.on_edge(EdgeId::new(i - n_vertices), add);
        }
    }
}

impl LoopMasks<'_> {
    /// Calls `add` with each old vertex that contributes to the new vertex on an edge, and with the weight of the old
    /// vertex.
    #[inline]
    fn on_edge(&self, e: EdgeId, add: &mut impl FnMut(usize, f64)) {
        let [h, twin] = e.half_edges();
        let [a, b] = [h, twin].map(|h| self.mesh.origin(h).index());
        let sharp = self.sharpness.weight_at_edge(e);
        if sharp >= 1.0 {
            add(a, 0.5);
            add(b, 0.5);
            return;
        }
        // In a triangle, the next half-edge ends at the opposite vertex.
        let [c, d] = [h, twin].map(|h| self.mesh.target(self.mesh.next(h)).index());
        let end = 0.5 * sharp + 0.375 * (1.0 - sharp);
        add(a, end);
        add(b, end);
        add(c, 0.125 * (1.0 - sharp));
        add(d, 0.125 * (1.0 - sharp));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_weights_agree_at_valences_three_and_six() {
        for n in [3, 6] {
            let [a, b] = [LoopWeights::Warren, LoopWeights::Loop].map(|w| w.of(n));
            assert_eq!(a, b, "{n}");
        }
        // Loop's formula for the weight u of each of the 3 neighbors: 3u = 5/8 - (3/8 - 1/8)^2 = 9/16.
        assert_eq!(LoopWeights::Loop.of(3), 9.0 / 16.0 / 3.0);
    }
}
