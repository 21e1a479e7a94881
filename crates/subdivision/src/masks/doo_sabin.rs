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

use super::Masks;
use crate::doo_sabin::{DooSabin, Source};
use crate::topology::pulled;

impl Masks for DooSabin<'_> {
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
