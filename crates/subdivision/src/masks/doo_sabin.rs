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
//! In a face with n corners, the new vertex of a corner is a weighted mean of all corners of the face. The corner
//! itself has the weight (n + 5)/(4n), and the j-th corner after it has the weight (3 + 2 cos(2πj/n))/(4n). Source: Doo
//! and Sabin, "Behaviour of recursive division surfaces near extraordinary points", 1978. The mask on the boundary is
//! from Chaikin, "An algorithm for high-speed curve generation", 1974.

use mesh::DVec3;
use progress::{Cancelled, Meter};

use super::Masks;
use crate::doo_sabin::{DooSabin, Source};
use crate::parallel::{computed, fill};
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

    fn values(&self, n: usize, old: &[DVec3], meter: &Meter) -> Result<Vec<DVec3>, Cancelled> {
        let origin = |h| self.mesh.origin(h).index();
        let sums = computed(self.large_faces.n_sums(), meter, |i| {
            let mut sum = DVec3::ZERO;
            let add = |h, w| sum += old[origin(h)] * w;
            self.large_faces.add_sum(self.mesh, i, add);
            sum
        })?;
        let mut new: Vec<DVec3> = mesh::zeroed(n);
        fill(&mut new, meter, |i| {
            let mut sum = DVec3::ZERO;
            if let (false, Source::Corner(h)) = (sums.is_empty(), self.source(i)) {
                let value = |i: usize| old.get(i).unwrap_or_else(|| &sums[i - old.len()]);
                let indices = [origin(h), old.len()];
                let mut add = |source, w| sum += value(source) * w;
                if self.large_faces.add_doo_sabin(h, indices, &mut add) {
                    return sum;
                }
            }
            self.mask(i, &mut |source, w| sum += old[source] * w);
            sum
        })?;
        Ok(new)
    }
}
