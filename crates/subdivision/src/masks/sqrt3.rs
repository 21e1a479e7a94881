//! The masks of Sqrt3 subdivision.
//!
//! ```text
//!          1/3                 a/n   a/n
//!         /   \                  \   /
//!        /  *  \            a/n - 1-a - a/n       4/27 -- 19/27 -- 4/27      1/27 -- 16/27 -*--- 10/27
//!       /       \                /   \
//!    1/3 ------- 1/3          a/n     a/n
//!
//!      in a face          old, inside, valence n    old, boundary            new, boundary
//! ```
//!
//! Here a = (4 - 2 cos(2π/n))/9. Even levels, counted from 0, leave the boundary unchanged. On odd levels, each
//! boundary edge gets two vertices, by the ternary subdivision of a uniform cubic B-spline curve. Source: Kobbelt,
//! "√3-Subdivision", 2000.

use std::f64::consts::TAU;

use mesh::{HalfEdgeId, VertexId};

use super::{Masks, midpoint::center};
use crate::sqrt3::{Source, Sqrt3};

impl Masks for Sqrt3<'_> {
    #[inline]
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        match self.source(i) {
            Source::Old(v) => self.at_vertex(v, add),
            Source::Center(f) => center(self.mesh, f, 1.0, add),
            Source::Near(h) => self.on_boundary(h, add),
        }
    }
}

impl Sqrt3<'_> {
    #[inline]
    fn at_vertex(&self, v: VertexId, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.mesh;
        match mesh.vertex_half_edge(v) {
            Some(h) if mesh.face(h).is_some() => {
                let n = mesh.valence(v);
                let a = neighbor_weight(n);
                add(v.index(), 1.0 - a);
                for w in mesh.vertex_neighbors(v) {
                    add(w.index(), a / n as f64);
                }
            }
            Some(h) if self.cuts_boundary() => {
                add(v.index(), 19.0 / 27.0);
                add(mesh.target(h).index(), 4.0 / 27.0);
                add(mesh.origin(mesh.prev(h)).index(), 4.0 / 27.0);
            }
            _ => add(v.index(), 1.0),
        }
    }

    /// The boundary edge of `h` gets a new vertex at a third of the way from the origin of `h` to its target. Calls
    /// `add` with each old vertex that contributes to the new vertex, and with the weight of the old vertex.
    fn on_boundary(&self, h: HalfEdgeId, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.mesh;
        // h can be either half-edge of the boundary edge.
        let beyond = if mesh.face(h).is_none() {
            mesh.origin(mesh.prev(h))
        } else {
            mesh.target(mesh.next(h.twin()))
        };
        add(beyond.index(), 1.0 / 27.0);
        add(mesh.origin(h).index(), 16.0 / 27.0);
        add(mesh.target(h).index(), 10.0 / 27.0);
    }
}

/// Returns the total weight a of the `n` neighbors of an inner vertex.
#[inline]
fn neighbor_weight(n: usize) -> f64 {
    match n {
        3 => 5.0 / 9.0,
        4 => 4.0 / 9.0,
        6 => 1.0 / 3.0,
        _ => (4.0 - 2.0 * libm::cos(TAU / n as f64)) / 9.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabulated_weights_equal_the_formula() {
        for n in [3, 4, 6] {
            let formula = (4.0 - 2.0 * libm::cos(TAU / n as f64)) / 9.0;
            assert!((neighbor_weight(n) - formula).abs() < 1e-15, "{n}");
        }
    }
}
