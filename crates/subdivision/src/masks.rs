//! The masks of the schemes. A mask contains the weight of each old vertex that contributes to a vertex of the next
//! level.

mod butterfly;
mod catmull_clark;
mod doo_sabin;
mod loop_masks;
mod midpoint;
mod sqrt3;

pub(crate) use butterfly::ButterflyMasks;
pub(crate) use catmull_clark::CatmullClarkMasks;
pub(crate) use loop_masks::LoopMasks;
pub(crate) use midpoint::MidpointMasks;

use mesh::{DVec3, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use crate::parallel::fill;
use crate::sharpness::{Sharpness, VertexRule};

/// The masks of a scheme on one mesh.
pub(crate) trait Masks: Sync {
    /// Vertex `i` of the next level is a weighted mean of old vertices. Calls `add` with each of these old vertices and
    /// its weight, in a fixed order. The weights sum to 1. A vertex can be passed to `add` more than once.
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64));

    /// Computes the values at the `n` vertices of the next level. Up to rounding, each value is the mean of `old` with
    /// the weights of [`mask`](Self::mask).
    fn values(&self, n: usize, old: &[DVec3], meter: &Meter) -> Result<Vec<DVec3>, Cancelled> {
        let mut new: Vec<DVec3> = mesh::zeroed(n);
        fill(&mut new, meter, |i| {
            let mut sum = DVec3::ZERO;
            self.mask(i, &mut |source, w| sum += old[source] * w);
            sum
        })?;
        Ok(new)
    }
}

/// The object-safe form of [`Masks`], for code that is compiled once for all schemes.
pub(crate) trait AnyMasks: Sync {
    /// Does the same as [`Masks::mask`].
    fn mask(&self, i: usize, add: &mut dyn FnMut(usize, f64));

    /// Does the same as [`Masks::values`].
    fn values(&self, n: usize, old: &[DVec3], meter: &Meter) -> Result<Vec<DVec3>, Cancelled>;
}

impl<M: Masks> AnyMasks for M {
    fn mask(&self, i: usize, add: &mut dyn FnMut(usize, f64)) {
        Masks::mask(self, i, &mut |source, w| add(source, w));
    }

    fn values(&self, n: usize, old: &[DVec3], meter: &Meter) -> Result<Vec<DVec3>, Cancelled> {
        Masks::values(self, n, old, meter)
    }
}

/// Calls `add` with the old vertices that determine the new position of vertex `v`, and with their weights.
/// `smooth(weight, add)` calls `add` with the smooth mask of the scheme, multiplied by `weight`. The masks of creases
/// and corners are the same for all schemes. An isolated vertex stays in place.
#[inline]
fn at_vertex<A: FnMut(usize, f64)>(
    mesh: &Mesh,
    sharpness: &Sharpness,
    v: VertexId,
    add: &mut A,
    smooth: impl Fn(f64, &mut A),
) {
    let Some(h) = mesh.vertex_half_edge(v) else {
        return add(v.index(), 1.0);
    };
    let part = |rule: VertexRule<HalfEdgeId>, weight: f64, add: &mut A| match rule {
        VertexRule::Smooth => smooth(weight, add),
        VertexRule::Crease([a, b]) => {
            add(v.index(), 0.75 * weight);
            add(mesh.target(a).index(), 0.125 * weight);
            add(mesh.target(b).index(), 0.125 * weight);
        }
        VertexRule::Corner => add(v.index(), weight),
    };
    let blend = sharpness.at_vertex(v, h);
    match blend.next {
        None => part(blend.now, 1.0, add),
        Some((next, weight)) => {
            part(blend.now, weight, add);
            part(next, 1.0 - weight, add);
        }
    }
}
