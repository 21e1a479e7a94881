//! Slabs: pairs of parallel planes around the triangles of a node.
//!
//! ```text
//!   +-----------+      From a distant point in the upper right, the corner of the box is much nearer than the surface.
//!   |\  \       |      All boxes up to a distance of about √(size of the box · radius of curvature) from the nearest
//!   |  \  \     |      point would be visited: hundreds of boxes in a fine mesh. The slab, parallel to the surface,
//!   |    \  \   |      shows that the triangles of a box are too far away.
//!   +-----------+
//! ```

use mesh::DVec3;

use super::SurfaceIndex;

/// A node with more than this number of triangles gets no slab. The triangles of a larger node usually do not lie near
/// one plane. A slab would then not be thinner than the box of the node.
const MOST: usize = 512;

/// The maximum number of values of λ for which a bound is computed; see [`SurfaceIndex::slab_distance_squared`].
const STEPS: usize = 3;

/// All points of the triangles of a node satisfy `low <= normal · point <= high`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    /// The direction of the sum of the area vectors of the triangles. The area vector of a triangle is its unit normal
    /// times its area. The length of `normal` is 1 up to rounding.
    normal: [f32; 3],
    low: f64,
    high: f64,
}

impl Slab {
    /// A slab that contains all of space, for nodes without a slab.
    pub(super) const EVERYTHING: Self = Self {
        normal: [0.0; 3],
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// Returns the slab (two parallel planes) around `n` triangles. `normal` is the sum of the area vectors of the
    /// triangles, or a multiple of this sum.
    pub(super) fn of<'a>(
        triangles: impl Iterator<Item = &'a [DVec3; 3]>,
        n: usize,
        normal: DVec3,
    ) -> Self {
        let Some(normal) = normal.try_normalize().filter(|_| n <= MOST) else {
            return Self::EVERYTHING;
        };
        let normal = normal.as_vec3();
        let heights = triangles.flatten().map(|p| normal.as_dvec3().dot(*p));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
            (low.min(h), high.max(h))
        });
        Self {
            normal: normal.to_array(),
            low,
            high,
        }
    }
}

impl SurfaceIndex {
    /// Returns a lower bound on the squared distance from `p` to the triangles of a node. `squared` is the squared
    /// distance to the box of the node.
    ///
    /// The triangles lie in the part of the box that is in the slab. Each λ ≥ 0 gives a lower bound on the squared
    /// distance from `p` to this part. The bound is the minimum of |p - x|² + 2 λ (n·x - high) over all points x of the
    /// box. Here n is the normal of the slab on the side of p, and n·x <= high for all points x of the slab. The
    /// minimum is at x = p - λ n, clamped to the box. Newton steps improve λ. Source: Boyd, Vandenberghe, "Convex
    /// Optimization", 2004, §5.1.3.
    pub(super) fn slab_distance_squared(&self, p: DVec3, i: usize, squared: f64) -> f64 {
        let (node, slab) = (&self.nodes[i], &self.slabs[i]);
        let [x, y, z] = slab.normal.map(f64::from);
        let (mut normal, mut limit) = (DVec3::new(x, y, z), slab.high);
        let mut height = normal.dot(p);
        if height < slab.low {
            (normal, limit, height) = (-normal, -slab.low, -height);
        }
        let mut bound = squared;
        let mut factor = height - limit;
        if factor.is_nan() || factor <= 0.0 || !factor.is_finite() {
            return bound;
        }
        for _ in 0..STEPS {
            let free = p - factor * normal;
            let at = free.max(node.min).min(node.max);
            let (above, distance) = (normal.dot(at) - limit, p.distance_squared(at));
            let product = 2.0 * factor * above;
            // This margin is subtracted so that rounding errors of the terms and of the heights cannot make the bound
            // too large.
            let rounding = 1e-14
                * (distance + product.abs() + factor * (limit.abs() + at.abs().element_sum()));
            bound = bound.max(distance + product - rounding);
            let slope = DVec3::select(free.cmpeq(at), normal * normal, DVec3::ZERO).element_sum();
            if slope == 0.0 {
                break;
            }
            factor = (factor + above / slope).max(0.0);
        }
        bound
    }
}
