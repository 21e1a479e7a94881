//! The masks of Doo-Sabin subdivision.
//!
//! ```text
//!     3/16 ---- 1/16          1/6
//!      |         |            /  \                    3/4 --*------- 1/4
//!      |    *    |           / *  \
//!      |         |         2/3 --- 1/6
//!     9/16 ---- 3/16
//!
//!      in a quad               in a triangle          on the boundary
//! ```
//!
//! In a face with n corners, the point of a corner has the weight (n + 5)/(4n) at that corner and (3 + 2
//! cos(2πj/n))/(4n) at the j-th corner after that corner. Source: Doo and Sabin, "Behaviour of recursive
//! division surfaces near extraordinary points", 1978. The mask on the boundary is from Chaikin, "An algorithm
//! for high-speed curve generation", 1974.

use super::Masks;
use crate::doo_sabin::{DooSabin, Source};
use crate::topology::add_doo_sabin;

impl Masks for DooSabin<'_> {
    #[inline]
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.mesh;
        match self.source(i) {
            Source::Corner(h) => add_doo_sabin(mesh, h, |h, w| add(mesh.origin(h).index(), w)),
            Source::Near(h) => {
                add(mesh.origin(h).index(), 0.75);
                add(mesh.target(h).index(), 0.25);
            }
            Source::Isolated(v) => add(v.index(), 1.0),
        }
    }
}
