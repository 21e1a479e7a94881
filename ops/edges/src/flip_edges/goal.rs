//! What makes a flip an improvement.
//!
//! **Delaunay.** The energy of a triangle is the sum of the cotangents of its angles,
//!
//! ```text
//!    cot(a) + cot(b) + cot(c) = (|ab|² + |bc|² + |ca|²) / (4 area)
//! ```
//!
//! least for the equilateral one, without bound towards no area; a flip is an improvement if the energy
//! of the two new triangles is less than that of the two old ones. The sum over a mesh is the trace of
//! its cotangent Laplacian (Pinkall and Polthier, "Computing Discrete Minimal Surfaces and Their
//! Conjugates", 1993): the Dirichlet energy of the functions that are 1 at one vertex and 0 at the
//! others, summed over the vertices. In the plane a flip leaves the Dirichlet energy of linear functions
//! alone, so it changes that of all others by multiples of one form of rank one, whose sign says
//! whether the far corner lies in the circle through the others (Rippa, "Minimal Roughness Property of
//! the Delaunay Triangulation", 1990). So there an edge improves the energy exactly if it is not
//! Delaunay, and flipping such edges ends with the Delaunay triangulation (Lawson, "Software for C1
//! Surface Interpolation", 1977). Four times the sum is the harmonic index of Musin, "Properties of the
//! Delaunay Triangulation", 1997. In space the energy is as well defined.
//!
//! Of triangles without area fewer are better. Where all four corners lie in one line, and so neither
//! diagonal leaves an area, the shorter one is better: it leads out of heaps of such triangles.
//!
//! **Valence.** The sum over the vertices of the square of valence minus target, where the target is 6
//! inside and 4 on the boundary: Botsch and Kobbelt, "A Remeshing Approach to Multiresolution
//! Modeling", 2004.

use std::ops::Range;

use mesh::{DVec3, EdgeId, Mesh, VertexId};

/// A triangle whose height is less than this share of its size has no area: what is computed for it is
/// rounding.
const NO_AREA: f64 = 1e-14;

/// Squares of sizes from and to which products of four lengths neither vanish nor overflow: scene units
/// from 1e-60 to 1e60.
const SIZES: Range<f64> = 1e-120..1e120;

/// Energies that differ by less than this share count as equal, so that four corners on a circle, like
/// those of a square, keep the diagonal that they have.
const TIE: f64 = 1e-12;

/// The energies of two triangles without area.
const NONE: [f64; 2] = [f64::INFINITY; 2];

/// What flips are for.
pub(crate) enum Goal {
    /// The least sum of cotangents.
    Delaunay,
    /// Valences near their targets.
    Valence {
        /// For each vertex its valence minus its target.
        excess: Vec<i32>,
    },
}

impl Goal {
    /// The goal of good valences for this mesh, from where it stands.
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

    /// Whether flipping the edge between these triangles is an improvement.
    ///
    /// For both goals this cannot go on for ever, however numbers are rounded. The sum of the squares is
    /// a whole number. The energy of a triangle is one number for the same three vertices, so with each
    /// flip the number of triangles without area falls, or that stays and the exact sum of the other
    /// energies falls, or both stay and the sum of the squares of the lengths of all edges falls.
    pub(crate) fn is_nearer(&self, mesh: &Mesh, quad: &Quad) -> bool {
        match self {
            Self::Delaunay => {
                let flipped = quad.flipped();
                let (before, after) = (quad.energies(mesh), flipped.energies(mesh));
                if before == NONE && after == NONE {
                    return flipped.length_squared(mesh) < quad.length_squared(mesh) * (1.0 - TIE);
                }
                after[0] + after[1] < (before[0] + before[1]) * (1.0 - TIE)
                    && quad.flips_without_fold(mesh)
            }
            Self::Valence { excess } => {
                let [a, b, c, d] = [quad.a, quad.b, quad.c, quad.d].map(|v| excess[v.index()]);
                // (x + 1)² - x² = 2x + 1 and (x - 1)² - x² = 1 - 2x add up to less than 0.
                a + b - c - d > 2
                    && quad.flipped().energies(mesh).iter().all(|x| x.is_finite())
                    && quad.flips_without_fold(mesh)
            }
        }
    }

    /// Notes that the edge between these triangles was flipped.
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

/// The corners of the triangles a b c and b a d beside the edge from a to b.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quad {
    pub(crate) a: VertexId,
    pub(crate) b: VertexId,
    pub(crate) c: VertexId,
    pub(crate) d: VertexId,
}

impl Quad {
    /// Beside this edge, which must have a triangle on both sides.
    pub(crate) fn beside(mesh: &Mesh, e: EdgeId) -> Self {
        let [ab, ba] = e.half_edges();
        Self {
            a: mesh.origin(ab),
            b: mesh.origin(ba),
            c: mesh.target(mesh.next(ab)),
            d: mesh.target(mesh.next(ba)),
        }
    }

    /// With the edge as it is after a flip: from d to c.
    const fn flipped(&self) -> Self {
        let Self { a, b, c, d } = *self;
        Self {
            a: d,
            b: c,
            c: a,
            d: b,
        }
    }

    /// The energies of both triangles.
    fn energies(&self, mesh: &Mesh) -> [f64; 2] {
        let Self { a, b, c, d } = *self;
        [energy(mesh, [a, b, c]), energy(mesh, [b, a, d])]
    }

    /// The square of the length of the edge.
    fn length_squared(&self, mesh: &Mesh) -> f64 {
        mesh.position(self.a)
            .distance_squared(mesh.position(self.b))
    }

    /// Whether the new triangles both look to the side of the old pair. The area vectors of the pair add
    /// up to the same sum before and after a flip. In the plane this says that the quad is convex.
    fn flips_without_fold(&self, mesh: &Mesh) -> bool {
        let [a, b, c, d] = [self.a, self.b, self.c, self.d].map(|v| mesh.position(v));
        let (left, right) = ((c - d).cross(a - d), (d - c).cross(b - c));
        let both: DVec3 = left + right;
        left.dot(both) > 0.0 && right.dot(both) > 0.0
    }
}

/// The sum of the cotangents of the angles of a triangle; infinite if it has no area, and not a number
/// if it is so small or large that it cannot be computed: no flip there counts as an improvement.
///
/// The corners are taken in the order of their numbers, so that the result is the same to the last bit
/// wherever the three meet as a triangle.
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
