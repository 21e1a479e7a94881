//! Computes generalized winding numbers, which tell whether a point is inside a surface.

use std::f64::consts::PI;

use mesh::{DVec3, parallel};
use progress::{Cancelled, Meter, Progress};

use super::{Node, SurfaceIndex, unit_scale};

/// Computes how often a surface winds around a point.
///
/// The winding number is the signed solid angle of the surface as seen from the point, divided by 4π. For a closed
/// surface that faces outward, the winding number is 1 inside and 0 outside. If the surface has several closed parts,
/// which can be nested or overlap, the winding numbers of the parts are added. For an open surface or a list of
/// unconnected triangles, the winding number changes smoothly near the gaps. For a surface with gaps, a point is best
/// counted as inside if its winding number is above 1/2: Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside
/// Segmentation using Generalized Winding Numbers", 2013.
///
/// Far parts of the surface are replaced by the first three terms of the Taylor series of their solid angle: Barill,
/// Dickson, Schmidt, Levin, Jacobson, "Fast Winding Numbers for Soups and Clouds", 2018. A part is far if its distance
/// from the point is more than twice the radius of the part. The error of the winding number is usually below 1e-3, and
/// below 0.01 in all tests.
#[derive(Clone, Debug)]
pub struct Winding<'a> {
    index: &'a SurfaceIndex,
    /// A power of two that scales the coordinates to a size near 1, so that none of the products overflows or
    /// underflows.
    scale: f64,
    /// The moments of each node, in the scaled coordinates. The moments of leaves are not used.
    moments: Vec<Moments>,
}

/// A part of the surface counts as far if its distance from the point is more than this factor times the radius of the
/// part.
const FAR: f64 = 2.0;

/// The number of nodes or points in a block. One thread processes all nodes or points of a block.
const BLOCK: usize = 256;

/// Integrals over the triangles of a node, for the Taylor series about the center c. Here n is the unit normal of a
/// triangle, and x = p − c for a point p of the triangle. Of the tensors M and T, only the symmetric parts are stored,
/// with their components in the order below.
///
/// ```text
/// normal   N_i  = ∫ n_i dA
/// first    M_ij = ∫ n_i x_j dA                    stored as xx yy zz yz zx xy
/// second   T_ijk = ∫ n_i x_j x_k dA               stored as xxx yyy zzz, xxy yyz zzx, xxz yyx zzy, and xyz separately
/// trace    u_k  = Σ_i 2 T_iik + T_kii
/// ```
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    center: DVec3,
    /// The largest distance from the center to a corner of a triangle.
    radius: f64,
    normal: DVec3,
    first: [DVec3; 2],
    second: [DVec3; 3],
    xyz: f64,
    trace: DVec3,
}

impl<'a> Winding<'a> {
    /// Prepares the computation of winding numbers. For n triangles, the preparation takes time proportional to n log
    /// n.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn new(index: &'a SurfaceIndex, progress: &dyn Progress) -> Result<Self, Cancelled> {
        let [min, max] = index.bounds();
        let scale = unit_scale(min.abs().max(max.abs()).max_element());
        let meter = Meter::new(
            progress,
            "prepare winding numbers",
            index.nodes.len() as u64,
        );
        let mut moments = vec![Moments::default(); index.nodes.len()];
        let parts = moments.chunks_mut(BLOCK).zip(index.nodes.chunks(BLOCK));
        let done = parallel::consume(parts, |_, (moments, nodes)| {
            for (moments, node) in moments.iter_mut().zip(nodes) {
                if node.right != 0 {
                    *moments = Moments::of(index.triangles_of(node), node, scale);
                }
            }
            meter.add(nodes.len())
        });
        done.into_iter().collect::<Result<(), Cancelled>>()?;
        Ok(Self {
            index,
            scale,
            moments,
        })
    }

    /// Returns the winding number at `p`. On a face, the winding number is the mean of the values on both sides of the
    /// face, up to rounding. Returns 0 if `p` is not finite or is extremely far away.
    pub fn at(&self, p: DVec3) -> f64 {
        let p = p * self.scale;
        if p.is_nan() || p.abs().max_element() > 1e30 {
            return 0.0;
        }
        let mut angle = 0.0;
        // Each child has half of the triangles of its parent, and there are fewer than 2^32 triangles, so the depth of
        // the tree is at most 32.
        let mut stack = [0_usize; 64];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let i = stack[height];
            let node = &self.index.nodes[i];
            if node.right == 0 {
                for t in self.index.triangles_of(node) {
                    angle += solid_angle(&t.map(|q| q * self.scale - p));
                }
                continue;
            }
            let moments = &self.moments[i];
            let r = moments.center - p;
            let far = FAR * moments.radius;
            if r.length_squared() > far * far {
                angle += moments.solid_angle(r);
                continue;
            }
            stack[height] = node.right as usize;
            stack[height + 1] = i + 1;
            height += 2;
        }
        angle / (4.0 * PI)
    }

    /// Whether `p` is inside the surface: whether the magnitude of the winding number exceeds 1/2. It does not matter
    /// whether the faces point inward or outward.
    pub fn contains(&self, p: DVec3) -> bool {
        self.at(p).abs() > 0.5
    }

    /// Returns the winding number at each of the given points, in the order of the points. Runs in parallel; the result
    /// does not depend on the number of threads.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn at_points(
        &self,
        points: &[DVec3],
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, Cancelled> {
        let meter = Meter::new(progress, "compute winding numbers", points.len() as u64);
        let mut found = vec![0.0; points.len()];
        let parts = found.chunks_mut(BLOCK).zip(points.chunks(BLOCK));
        let done = parallel::consume(parts, |_, (found, points)| {
            for (found, p) in found.iter_mut().zip(points) {
                *found = self.at(*p);
            }
            meter.add(points.len())
        });
        done.into_iter().collect::<Result<(), Cancelled>>()?;
        Ok(found)
    }
}

impl Moments {
    fn of(triangles: &[[DVec3; 3]], node: &Node, scale: f64) -> Self {
        let triangles = || triangles.iter().map(|t| t.map(|p| p * scale));
        let middle = (node.min * scale).midpoint(node.max * scale);
        let (mut weighted, mut total) = (DVec3::ZERO, 0.0);
        for [a, b, c] in triangles() {
            let area = (b - a).cross(c - a).length();
            weighted += area * ((a - middle) + (b - middle) + (c - middle)) / 3.0;
            total += area;
        }
        let center = if total > 0.0 {
            middle + weighted / total
        } else {
            middle
        };
        let mut moments = Self {
            center,
            ..Self::default()
        };
        let mut radius_squared = 0.0_f64;
        for t in triangles() {
            let x = t.map(|p| p - center);
            radius_squared = x
                .iter()
                .fold(radius_squared, |r, x| r.max(x.length_squared()));
            let n = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
            let g = (x[0] + x[1] + x[2]) / 3.0;
            moments.normal += n;
            moments.first[0] += n * g;
            moments.first[1] += yzx(n) * zxy(g) + zxy(n) * yzx(g);
            // The integral ∫ x_j x_k dA over a triangle with area 1, computed from the corners of the triangle and from
            // their mean g.
            let square = (x.iter().map(|x| *x * *x).sum::<DVec3>() + 9.0 * g * g) / 12.0;
            let mixed =
                (x.iter().map(|x| yzx(*x) * zxy(*x)).sum::<DVec3>() + 9.0 * yzx(g) * zxy(g)) / 12.0;
            // The components of `mixed` are the integrals of yz, zx and xy. The coefficient of x² y is a sum of three
            // components of the tensor T: the components with the indices xxy, xyx and yxx.
            let [yz, zx, xy] = mixed.to_array();
            moments.second[0] += n * square;
            moments.second[1] += yzx(n) * square + 2.0 * n * DVec3::new(xy, yz, zx);
            moments.second[2] += zxy(n) * square + 2.0 * n * DVec3::new(zx, xy, yz);
            moments.xyz += 2.0 * n.dot(mixed);
            let across = DVec3::new(
                n.y * xy + n.z * zx,
                n.x * xy + n.z * yz,
                n.x * zx + n.y * yz,
            );
            moments.trace += 2.0 * (n * square + across) + n * square.element_sum();
        }
        // The radius is increased a little, because rounding must not make it too small.
        moments.radius = radius_squared.sqrt() * (1.0 + 1e-12);
        moments
    }

    /// Returns the approximate solid angle of the triangles of a node, as seen from a point. `r` is the vector from
    /// this point to the center of the node.
    ///
    /// The solid angle, as seen from the origin, is ∫ n · f(p) dA with f(p) = p / |p|³. With R = |r|, the terms of the
    /// Taylor series of f are
    ///
    /// ```text
    /// N · r / R³
    /// (tr M) / R³ − 3 (r · M r) / R⁵
    /// ½ (15 Σ T_ijk r_i r_j r_k / R⁷ − 3 u · r / R⁵)
    /// ```
    fn solid_angle(&self, r: DVec3) -> f64 {
        let squared = r.length_squared();
        let cube = 1.0 / (squared * squared.sqrt());
        let fifth = cube / squared;
        let [x, y, z] = r.to_array();
        let squares = r * r;
        let mixed = yzx(r) * zxy(r);
        let first = self.first[0].dot(squares) + self.first[1].dot(mixed);
        let second = self.second[0].dot(r * squares)
            + self.second[1].dot(squares * yzx(r))
            + self.second[2].dot(squares * zxy(r))
            + self.xyz * x * y * z;
        let trace = self.first[0].element_sum();
        (self.normal.dot(r) + trace) * cube - 3.0 * (first + 0.5 * self.trace.dot(r)) * fifth
            + 7.5 * second * fifth / squared
    }
}

fn yzx(p: DVec3) -> DVec3 {
    DVec3::new(p.y, p.z, p.x)
}

fn zxy(p: DVec3) -> DVec3 {
    DVec3::new(p.z, p.x, p.y)
}

/// Returns the solid angle of a triangle as seen from the origin. The result is positive if the front of the triangle
/// faces away from the origin. Returns 0 if the origin lies in the plane of the triangle.
///
/// Source: Van Oosterom, Strackee, "The Solid Angle of a Plane Triangle", 1983.
fn solid_angle(&[a, b, c]: &[DVec3; 3]) -> f64 {
    let volume = a.dot(b.cross(c));
    if volume == 0.0 {
        return 0.0;
    }
    let [u, v, w] = [a, b, c].map(DVec3::length);
    let angle = libm::atan2(
        volume,
        u * v * w + a.dot(b) * w + b.dot(c) * u + c.dot(a) * v,
    );
    2.0 * angle
}
