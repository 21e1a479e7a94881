//! Finds the points where rays meet a surface.

use std::cmp::Ordering::{self, Equal, Less};

use mesh::{DVec2, DVec3, parallel};
use progress::{Cancelled, Meter, Progress};

use super::{Node, SurfaceIndex};
use crate::predicates::orient2d;

/// A point where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// The distance of the point from the origin of the ray, as a multiple of the length of the direction vector. This
    /// number is not negative.
    pub t: f64,
    /// The point.
    pub point: DVec3,
    /// The barycentric coordinates of the point: the weights of the three corners of the triangle. No weight is
    /// negative.
    pub weights: [f64; 3],
    /// The index of the triangle that the ray meets. [`SurfaceIndex::triangle`] returns the triangle with this index.
    pub triangle: u32,
    /// Whether the ray meets the front of the triangle: the side from which its corners are seen in counter-clockwise
    /// order.
    pub is_front: bool,
}

impl SurfaceIndex {
    /// Returns the first point where a ray meets the surface. If the ray meets several triangles at the same point, the
    /// triangle with the lowest index is returned. `direction` can have any length except 0. If the origin of the ray
    /// lies on the surface, the ray meets the surface at the origin.
    ///
    /// The test is watertight: if a ray passes through the surface at an inner edge or vertex, it meets exactly one of
    /// the triangles there. Therefore a ray from outside meets a closed surface an even number of times. A ray does not
    /// meet triangles that are parallel to it. A ray whose direction is zero, or whose origin or direction is not
    /// finite, meets nothing.
    ///
    /// A shear makes the ray parallel to an axis: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", 2013.
    /// The signs of areas are computed exactly. An area of zero gets the sign that it would have after an infinitely
    /// small movement of the ray.
    pub fn ray(&self, origin: DVec3, direction: DVec3) -> Option<RayHit> {
        let mut first: Option<RayHit> = None;
        self.visit_ray(origin, direction, &mut |hit| {
            if first.is_none_or(|first| (hit.t, hit.triangle) < (first.t, first.triangle)) {
                first = Some(hit);
            }
            first.map_or(f64::INFINITY, |first| first.t)
        });
        first
    }

    /// Returns all points where a ray meets the surface, in their order along the ray. Whether the ray meets a triangle
    /// is decided as in [`ray`](Self::ray).
    pub fn ray_all(&self, origin: DVec3, direction: DVec3) -> Vec<RayHit> {
        let mut hits = Vec::new();
        self.visit_ray(origin, direction, &mut |hit| {
            hits.push(hit);
            f64::INFINITY
        });
        hits.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.triangle.cmp(&b.triangle)));
        hits
    }

    /// Returns, for each ray, the first point where it meets the surface, as [`ray`](Self::ray) does. Each ray is given
    /// by its origin and its direction. Runs in parallel.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn first_hits(
        &self,
        rays: &[[DVec3; 2]],
        progress: &dyn Progress,
    ) -> Result<Vec<Option<RayHit>>, Cancelled> {
        let meter = Meter::new(progress, "cast rays", rays.len() as u64);
        let mut hits = vec![None; rays.len()];
        let parts = hits.chunks_mut(256).zip(rays.chunks(256));
        let done = parallel::consume(parts, |_, (hits, rays)| {
            for (hit, [origin, direction]) in hits.iter_mut().zip(rays) {
                *hit = self.ray(*origin, *direction);
            }
            meter.add(rays.len())
        });
        done.into_iter().collect::<Result<(), Cancelled>>()?;
        Ok(hits)
    }

    /// Calls `visit` for each point where the ray meets the surface (a hit), in any order. `visit` returns the largest
    /// distance at which further hits matter. Hits beyond this distance are possibly skipped.
    fn visit_ray(&self, origin: DVec3, direction: DVec3, visit: &mut dyn FnMut(RayHit) -> f64) {
        let Some(ray) = Ray::new(origin, direction) else {
            return;
        };
        let mut until = f64::INFINITY;
        let mut stack = [(0_usize, 0.0); 64];
        let mut height = 0;
        if let Some(enter) = ray.enters(&self.nodes[0]) {
            stack[0] = (0, enter);
            height = 1;
        }
        while height > 0 {
            height -= 1;
            let (i, enter) = stack[height];
            if enter > until {
                continue;
            }
            let node = &self.nodes[i];
            if node.right == 0 {
                for i in node.first..node.last {
                    if let Some(hit) = ray.meets(&self.positions[i as usize], i)
                        && hit.t <= until
                    {
                        until = visit(hit);
                    }
                }
                continue;
            }
            let mut children = [i + 1, node.right as usize]
                .map(|i| ray.enters(&self.nodes[i]).map(|enter| (i, enter)));
            // The nearer child is visited first: if the ray meets a triangle there, the other child can often be
            // skipped.
            if let [Some(one), Some(two)] = children
                && one.1 <= two.1
            {
                children.swap(0, 1);
            }
            for child in children.into_iter().flatten() {
                stack[height] = child;
                height += 1;
            }
        }
    }
}

/// A ray, and the shear that makes it parallel to the axis `axes[2]`.
struct Ray {
    origin: DVec3,
    direction: DVec3,
    /// The three coordinate axes in a suitable order. The last axis is the one along which the direction has its
    /// largest component.
    axes: [usize; 3],
    shear: DVec2,
}

impl Ray {
    fn new(origin: DVec3, direction: DVec3) -> Option<Self> {
        if !origin.is_finite() || !direction.is_finite() || direction == DVec3::ZERO {
            return None;
        }
        let z = direction.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let shear = DVec2::new(direction[x], direction[y]) / direction[z];
        Some(Self {
            origin,
            direction,
            axes: [x, y, z],
            shear,
        })
    }

    /// Returns a lower bound on the distance along the ray at which the ray enters the box of a node. Returns `None` if
    /// the ray misses the box.
    ///
    /// The box is enlarged by a multiple of the rounding error of [`meets`](Self::meets), so that no hit is lost.
    fn enters(&self, node: &Node) -> Option<f64> {
        let (min, max) = (node.min - self.origin, node.max - self.origin);
        let pad = 8.0 * f64::EPSILON * min.abs().max(max.abs()).max_element();
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let (low, high) = (min[axis] - pad, max[axis] + pad);
            let d = self.direction[axis];
            if d == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (low, high) = if d > 0.0 {
                (low / d, high / d)
            } else {
                (high / d, low / d)
            };
            enter = enter.max(low);
            leave = leave.min(high);
        }
        let slack = 1.0 + 8.0 * f64::EPSILON;
        (enter <= leave * slack).then_some(enter / slack)
    }

    fn meets(&self, t: &[DVec3; 3], triangle: u32) -> Option<RayHit> {
        let [x, y, z] = self.axes;
        // This translation rounds a corner in the same way in all triangles that share the corner, so a closed surface
        // is still closed afterwards.
        let moved = t.map(|p| p - self.origin);
        let flat = moved.map(|p| DVec2::new(p[x], p[y]) - self.shear * p[z]);
        let turn = |i: usize| side_of_origin(flat[(i + 1) % 3], flat[(i + 2) % 3]);
        let side = turn(0)?;
        if turn(1)? != side || turn(2)? != side {
            return None;
        }
        let areas = [0, 1, 2].map(|i| {
            let area = flat[(i + 1) % 3].perp_dot(flat[(i + 2) % 3]).abs();
            // The area overflows only if coordinates are above 1e150. An area that overflows counts as 0.
            if area.is_finite() { area } else { 0.0 }
        });
        let sum = areas[0] + areas[1] + areas[2];
        let weights = if sum > 0.0 {
            areas.map(|area| area / sum)
        } else {
            [1.0 / 3.0; 3]
        };
        let depth = weights[0] * moved[0][z] + weights[1] * moved[1][z] + weights[2] * moved[2][z];
        let along = depth / self.direction[z];
        // The three axes, in this order, are right-handed. The front of a triangle with counter-clockwise corners
        // therefore points in the positive direction of the last axis.
        let is_front = (side == Less) == (self.direction[z] > 0.0);
        (along >= 0.0).then(|| RayHit {
            t: along,
            point: weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2],
            weights,
            triangle,
            is_front,
        })
    }
}

/// Returns on which side of the line from `a` to `b` the origin lies. If the origin lies on this line, returns the side
/// of the point (ε, ε²) instead, where ε is positive and infinitely small. Returns `None` if `a` and `b` are equal.
fn side_of_origin(a: DVec2, b: DVec2) -> Option<Ordering> {
    let side = orient2d(a, b, DVec2::ZERO);
    if side != Equal {
        return Some(side);
    }
    // The origin is on the line through a and b, so it is replaced by (ε, ε²) with a tiny positive ε. Twice the area of
    // the triangle a, b, (ε, ε²) is then ε (a.y - b.y) + ε² (b.x - a.x).
    let sides = [a.y.partial_cmp(&b.y), b.x.partial_cmp(&a.x)];
    sides.into_iter().flatten().find(|side| *side != Equal)
}
