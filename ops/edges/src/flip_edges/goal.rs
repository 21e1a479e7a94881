//! Goals of flips. A goal decides whether a flip is an improvement. A flip that would fold the surface is never an
//! improvement.
//!
//! **Delaunay.** The energy of a triangle is the sum of the cotangents of its angles,
//!
//! ```text
//!    cot(a) + cot(b) + cot(c) = (|ab|² + |bc|² + |ca|²) / (4 area)
//! ```
//!
//! The energy is lowest for the equilateral triangle and grows without bound as the area approaches 0. A flip is an
//! improvement if the two new triangles together have a lower energy than the two old triangles. The energies of all
//! triangles add up to the trace of the cotangent Laplacian of the mesh (Pinkall and Polthier, "Computing Discrete
//! Minimal Surfaces and Their Conjugates", 1993). The hat function of a vertex is 1 at this vertex, 0 at all other
//! vertices, and linear in each triangle. The trace is the sum of the Dirichlet energies of all hat functions. In the
//! plane, a flip does not change the Dirichlet energy of linear functions. For any values at the four corners, a flip
//! changes the Dirichlet energy by a quadratic form of rank 1 in these values. Its sign depends on whether one corner
//! is inside the circle through the other three corners (Rippa, "Minimal Roughness Property of the Delaunay
//! Triangulation", 1990). In the plane, a flip therefore reduces the energy if and only if the edge does not satisfy
//! the Delaunay condition. If edges that do not satisfy the condition are flipped repeatedly, the result is the
//! Delaunay triangulation (Lawson, "Software for C1 Surface Interpolation", 1977). Four times the sum of the energies
//! of all triangles is the harmonic index of Musin, "Properties of the Delaunay Triangulation", 1997. The energy is
//! also defined for surfaces in space.
//!
//! A flip that reduces the number of zero-area triangles is an improvement. If all four corners are collinear, both
//! diagonals give zero-area triangles, and the shorter diagonal is better. Together, these two rules let flips resolve
//! groups of zero-area triangles.
//!
//! **Valence.** The target valence is 6 for inner vertices and 4 for boundary vertices. A flip is an improvement if it
//! reduces the sum of (valence - target)² over all vertices. Source: Botsch and Kobbelt, "A Remeshing Approach to
//! Multiresolution Modeling", 2004.

use std::ops::Range;

use mesh::{DVec3, EdgeId, Mesh, VertexId};

/// A triangle counts as a zero-area triangle if its height is less than this fraction of its size. The computed area of
/// such a triangle consists only of rounding errors.
const NO_AREA: f64 = 1e-14;

/// The energy of a triangle is computed only if the sum of its squared side lengths is in this range. Products of four
/// side lengths then neither underflow nor overflow. The longest side is then between about 1e-60 and 1e60 scene units.
const SIZES: Range<f64> = 1e-120..1e120;

/// Energies whose relative difference is less than this value count as equal. If all four corners lie on a circle, as
/// in a square, the diagonal is therefore not flipped.
const TIE: f64 = 1e-12;

/// The energies of two triangles that both have no area.
const BOTH_WITHOUT_AREA: [f64; 2] = [f64::INFINITY; 2];

/// What the flips try to reach.
pub(crate) enum Goal {
    /// A sum of the cotangents of all angles that is as low as possible.
    Delaunay,
    /// Valences that are close to their targets. The target is 6 for inner vertices and 4 for boundary vertices.
    Valence {
        /// For each vertex, its valence minus its target.
        excess: Vec<i32>,
    },
}

impl Goal {
    /// Creates the goal that brings the valences of this mesh close to their targets.
    pub(crate) fn valence(mesh: &Mesh) -> Self {
        let mut excess = vec![0; mesh.positions().len()];
        for v in mesh.vertices() {
            excess[v.index()] = if mesh.is_boundary_vertex(v) { -4 } else { -6 };
        }
        for h in mesh.half_edges() {
            excess[mesh.origin(h).index()] += 1;
        }
        Self::Valence { excess }
    }

    /// Whether flipping the edge between the two triangles of `quad` is an improvement.
    ///
    /// For both goals, the sequence of improving flips is finite, regardless of rounding. For `Valence`, each improving
    /// flip decreases the sum of the squared differences, which is an integer. For `Delaunay`, the computed energy of a
    /// triangle depends only on its three vertices. Three values are compared in this order: the number of zero-area
    /// triangles, the exact sum of the energies of all other triangles, and the sum of the squared lengths of all
    /// edges. An improving flip decreases one of these values and does not change the values before it.
    pub(crate) fn is_improvement(&self, mesh: &Mesh, quad: &Quad) -> bool {
        match self {
            Self::Delaunay => {
                let flipped = quad.flipped();
                let (before, after) = (quad.energies(mesh), flipped.energies(mesh));
                if before == BOTH_WITHOUT_AREA && after == BOTH_WITHOUT_AREA {
                    return flipped.length_squared(mesh) < quad.length_squared(mesh) * (1.0 - TIE);
                }
                after[0] + after[1] < (before[0] + before[1]) * (1.0 - TIE)
                    && quad.flips_without_fold(mesh)
            }
            Self::Valence { excess } => {
                let [a, b, c, d] = [quad.a, quad.b, quad.c, quad.d].map(|v| excess[v.index()]);
                // The flip reduces the valences of a and b by 1 and increases the valences of c and d by 1. The square
                // of an excess x changes by (x - 1)² - x² = 1 - 2x or by (x + 1)² - x² = 1 + 2x. If a, b, c, d stand
                // for the four excesses, the sum of the four changes is 4 - 2 (a + b - c - d). The flip is an
                // improvement if this sum is below 0.
                a + b - c - d > 2
                    && quad.flipped().energies(mesh).iter().all(|x| x.is_finite())
                    && quad.flips_without_fold(mesh)
            }
        }
    }

    /// Updates the goal after a flip of the edge between the two triangles of `quad`.
    pub(crate) fn flipped(&mut self, quad: &Quad) {
        if let Self::Valence { excess } = self {
            for v in [quad.a, quad.b] {
                excess[v.index()] -= 1;
            }
            for v in [quad.c, quad.d] {
                excess[v.index()] += 1;
            }
        }
    }
}

/// The four corners of two triangles a b c and b a d that share the edge from a to b.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quad {
    pub(crate) a: VertexId,
    pub(crate) b: VertexId,
    pub(crate) c: VertexId,
    pub(crate) d: VertexId,
}

impl Quad {
    /// Returns the triangles beside the edge `e`, which must have a triangle on each side.
    pub(crate) fn beside(mesh: &Mesh, e: EdgeId) -> Self {
        let [ab, ba] = e.half_edges();
        Self {
            a: mesh.origin(ab),
            b: mesh.origin(ba),
            c: mesh.target(mesh.next(ab)),
            d: mesh.target(mesh.next(ba)),
        }
    }

    /// Returns the triangles after a flip. After the flip, the edge goes from d to c.
    const fn flipped(&self) -> Self {
        let Self { a, b, c, d } = *self;
        Self {
            a: d,
            b: c,
            c: a,
            d: b,
        }
    }

    /// Returns the energies of both triangles.
    fn energies(&self, mesh: &Mesh) -> [f64; 2] {
        let Self { a, b, c, d } = *self;
        [energy(mesh, [a, b, c]), energy(mesh, [b, a, d])]
    }

    /// Returns the squared length of the edge.
    fn length_squared(&self, mesh: &Mesh) -> f64 {
        mesh.position(self.a)
            .distance_squared(mesh.position(self.b))
    }

    /// The area vector of a triangle is its normal, multiplied by its area. Returns whether the normals of both new
    /// triangles point to the same side as the sum of the two area vectors. A flip does not change this sum. In the
    /// plane, the result is true if and only if the quad is convex.
    fn flips_without_fold(&self, mesh: &Mesh) -> bool {
        let [a, b, c, d] = [self.a, self.b, self.c, self.d].map(|v| mesh.position(v));
        let (left, right) = ((c - d).cross(a - d), (d - c).cross(b - c));
        let both: DVec3 = left + right;
        left.dot(both) > 0.0 && right.dot(both) > 0.0
    }
}

/// Returns the sum of the cotangents of the angles of a triangle. Returns NaN if the sum of the squared side lengths is
/// outside [`SIZES`]. Otherwise, returns infinity for a zero-area triangle. If the energy of a new triangle is NaN, the
/// flip is never an improvement.
///
/// The corners are sorted by their ids, so that the bits of the result do not depend on the order of the corners.
fn energy(mesh: &Mesh, mut corners: [VertexId; 3]) -> f64 {
    corners.sort_unstable();
    let [p, q, r] = corners.map(|v| mesh.position(v));
    let squares = p.distance_squared(q) + q.distance_squared(r) + r.distance_squared(p);
    let double_area = (q - p).cross(r - p).length();
    if !SIZES.contains(&squares) {
        f64::NAN
    } else if double_area > NO_AREA * squares {
        squares / (2.0 * double_area)
    } else {
        f64::INFINITY
    }
}
