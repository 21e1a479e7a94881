//! The masks: which old vertices a new one is a mean of.

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
    /// Calls `add` with old vertices that new vertex `i` is a sum of, and their weights, in a fixed order.
    /// The weights sum to 1; a vertex may come more than once.
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64));

    /// The values at the `n` vertices of the next level. Equal to the sums of [`mask`](Self::mask) but for
    /// rounding.
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

/// [`Masks`] of any scheme: for code that is compiled once for all of them.
pub(crate) trait AnyMasks: Sync {
    /// As [`Masks::mask`].
    fn mask(&self, i: usize, add: &mut dyn FnMut(usize, f64));

    /// As [`Masks::values`].
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

/// Adds the mask of an old vertex: `smooth(weight, add)` adds the one that holds where nothing is sharp,
/// scaled; the others are the same for all schemes. An isolated vertex stays.
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
