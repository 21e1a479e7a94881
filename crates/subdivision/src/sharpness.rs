//! Creases and corners: which rule applies to a vertex or an edge, and how sharpness decreases.
//!
//! Each edge and each vertex has a sharpness, which is a number. 0 is smooth, and 10 or more is sharp on every level. A
//! value s between 0 and 10 is semi-sharp: the edge or vertex is sharp for s levels and then smooth. On the last of
//! these levels, the sharp rule and the smooth rule are blended. Source: DeRose, Kass and Truong, "Subdivision Surfaces
//! in Character Animation", 1998, in the form used by OpenSubdiv. The sharp edges at a vertex determine the rule of the
//! vertex:
//!
//! ```text
//!         |                  |                  ‖                  ‖
//!      -- o --            == o --            == o --            == o ==
//!         |                  |                  |                  |
//!
//!    smooth: none       dart: one edge,    crease: two edges    corner: more edges, or the
//!                       still smooth                            vertex itself
//! ```
//!
//! Edges of the boundary are infinitely sharp.

use mesh::{CREASE, EdgeId, HalfEdgeId, Mesh, VERTEX_SHARPNESS, VertexId};

use crate::parallel::any;
use crate::rules::{Boundary, Creasing, Rules};

/// A sharpness of at least this value does not decrease.
pub(crate) const INFINITE: f64 = 10.0;

/// The sharpness of the edges and vertices of a mesh.
#[derive(Clone, Copy)]
pub(crate) struct Sharpness<'a> {
    mesh: &'a Mesh,
    boundary: Boundary,
    creasing: Creasing,
    /// The sharpness of each edge; `None` if all inner edges are smooth.
    edges: Option<&'a [f64]>,
    vertices: Option<&'a [f64]>,
}

/// How a vertex moves. `K` is the type that identifies edges around the vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VertexRule<K> {
    /// The mask of the scheme gives the new position of the vertex.
    Smooth,
    /// The crease mask gives the new position of the vertex. The crease consists of these two edges.
    Crease([K; 2]),
    /// The vertex stays in place.
    Corner,
}

/// The rule of a vertex on this level, and its rule on the next level if the two rules are blended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Blend<K> {
    /// The rule for the sharpness on this level.
    pub(crate) now: VertexRule<K>,
    /// The rule for the sharpness on the next level, and the weight of the rule `now` in the blend. `None` if only the
    /// rule `now` is used.
    pub(crate) next: Option<(VertexRule<K>, f64)>,
}

impl<K: Copy> VertexRule<K> {
    /// Returns the rule of a vertex. `at` is the sharpness of the vertex. `edges` has each edge at the vertex and its
    /// sharpness.
    pub(crate) fn of(at: f64, edges: impl Iterator<Item = (K, f64)>) -> Self {
        if at > 0.0 {
            return Self::Corner;
        }
        let mut sharp = edges.filter(|&(_, s)| s > 0.0).map(|(k, _)| k);
        match (sharp.next(), sharp.next(), sharp.next()) {
            (Some(a), Some(b), None) => Self::Crease([a, b]),
            (_, _, None) => Self::Smooth,
            _ => Self::Corner,
        }
    }
}

impl<K: Copy> Blend<K> {
    /// Returns the rules of a vertex, and how they are blended. `at` is the sharpness of the vertex on this level and
    /// on the next level. `edges` has each edge at the vertex and its sharpness on these two levels.
    pub(crate) fn of(at: [f64; 2], edges: impl Iterator<Item = (K, [f64; 2])> + Clone) -> Self {
        let rule = |i: usize| VertexRule::of(at[i], edges.clone().map(|(k, s)| (k, s[i])));
        let now = rule(0);
        let unchanged = Self { now, next: None };
        if matches!(now, VertexRule::Smooth) {
            return unchanged;
        }
        let next = rule(1);
        if std::mem::discriminant(&now) == std::mem::discriminant(&next) {
            return unchanged;
        }
        let weight = fading_weight(edges.map(|(_, s)| s).chain([at]));
        Self {
            now,
            next: Some((next, weight)),
        }
    }
}

/// The number of semi-sharp edges at a vertex, and the sum of their sharpness values.
#[derive(Clone, Copy, Default)]
pub(crate) struct SemiSharp {
    sum: f64,
    n: usize,
}

impl SemiSharp {
    /// Counts the semi-sharp edges at a vertex. `edges` has the sharpness of every edge at the vertex. Only Chaikin's
    /// rule needs the count; for other rules, the count is 0.
    pub(crate) fn of(creasing: Creasing, edges: impl Iterator<Item = f64>) -> Self {
        let mut semi_sharp = Self::default();
        if creasing == Creasing::Chaikin {
            for s in edges.filter(|&s| s > 0.0 && s < INFINITE) {
                semi_sharp.sum += s;
                semi_sharp.n += 1;
            }
        }
        semi_sharp
    }

    /// An edge with sharpness `s` has two parts on the next level, one at each end. Returns the sharpness of the edge's
    /// part at this vertex.
    pub(crate) fn half_of(self, s: f64) -> f64 {
        if s <= 0.0 || s >= INFINITE || self.n < 2 {
            return decreased(s);
        }
        let mean_of_rest = (self.sum - s) / (self.n - 1) as f64;
        (0.75 * s + 0.25 * mean_of_rest - 1.0).max(0.0)
    }
}

/// Returns the sharpness on the next level by the rule [`Creasing::Uniform`].
pub(crate) fn decreased(s: f64) -> f64 {
    if s >= INFINITE {
        INFINITE
    } else {
        (s - 1.0).max(0.0)
    }
}

/// Returns the weight of this level's rule in the blend with the next level's rule. Some elements are sharp on this
/// level and smooth on the next level. The weight is their mean sharpness, limited to 1. Each pair in `pairs` has the
/// sharpness of an element on this level and on the next level.
pub(crate) fn fading_weight(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (mut sum, mut n) = (0.0, 0_u32);
    for [now, next] in pairs {
        if now > 0.0 && next <= 0.0 {
            sum += now;
            n += 1;
        }
    }
    if n == 0 {
        0.0
    } else {
        (sum / f64::from(n)).min(1.0)
    }
}

impl<'a> Sharpness<'a> {
    pub(crate) fn of(mesh: &'a Mesh, rules: Rules) -> Self {
        fn used(values: &[f64]) -> Option<&[f64]> {
            any(values.len(), |i| values[i] > 0.0).then_some(values)
        }
        Self {
            mesh,
            boundary: rules.boundary,
            creasing: rules.creasing,
            edges: mesh.get(CREASE).and_then(used),
            vertices: mesh.get(VERTEX_SHARPNESS).and_then(used),
        }
    }

    /// Whether only the boundary is sharp.
    #[inline]
    fn is_plain(&self) -> bool {
        self.edges.is_none() && self.vertices.is_none()
    }

    /// Returns the sharpness stored for an edge; 0 if no sharpness is stored or the stored value is negative.
    #[inline]
    fn stored(&self, e: EdgeId) -> f64 {
        self.edges.map_or(0.0, |s| s[e.index()].max(0.0))
    }

    /// Returns the sharpness of an edge, which is infinite on the boundary.
    #[inline]
    pub(crate) fn edge(&self, e: EdgeId) -> f64 {
        if self.mesh.is_boundary_edge(e) {
            INFINITE
        } else {
            self.stored(e)
        }
    }

    /// Returns the sharpness of a vertex. `h` is the outgoing half-edge that the mesh stores for `v`. If `v` is on the
    /// boundary, this is a boundary half-edge.
    #[inline]
    pub(crate) fn vertex(&self, v: VertexId, h: HalfEdgeId) -> f64 {
        if self.mesh.face(h).is_none() {
            let is_corner = match self.boundary {
                Boundary::EdgesOnly => false,
                Boundary::EdgesAndCorners => self.clockwise_last(h) == self.mesh.next(h.twin()),
                Boundary::Fixed => true,
            };
            if is_corner {
                return INFINITE;
            }
        }
        self.vertices.map_or(0.0, |s| s[v.index()].max(0.0))
    }

    /// Two boundary edges meet at the origin of boundary half-edge `h`. One of them contains `h`; returns the outgoing
    /// half-edge of the other edge.
    #[inline]
    fn clockwise_last(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.mesh.prev(h).twin()
    }

    /// Returns the weight of the sharp mask for the new vertex on an edge: 1 gives the middle of the edge, 0 gives
    /// the smooth mask.
    #[inline]
    pub(crate) fn weight_at_edge(&self, e: EdgeId) -> f64 {
        let s = self.edge(e);
        if s <= 0.0 || s >= 1.0 {
            return s.clamp(0.0, 1.0);
        }
        let stays = self.creasing == Creasing::Chaikin
            && e.half_edges().iter().all(|&h| self.of_half(h) > 0.0);
        if stays { 1.0 } else { s }
    }

    /// Returns how vertex `v` moves. `h` is the outgoing half-edge that the mesh stores for `v`. If `v` is on the
    /// boundary, this is a boundary half-edge.
    #[inline]
    pub(crate) fn at_vertex(&self, v: VertexId, h: HalfEdgeId) -> Blend<HalfEdgeId> {
        if !self.is_plain() {
            return self.with_creases(v, h);
        }
        let now = if self.mesh.face(h).is_some() {
            VertexRule::Smooth
        } else if self.vertex(v, h) > 0.0 {
            VertexRule::Corner
        } else {
            VertexRule::Crease([h, self.clockwise_last(h)])
        };
        Blend { now, next: None }
    }

    fn with_creases(&self, v: VertexId, h: HalfEdgeId) -> Blend<HalfEdgeId> {
        let semi_sharp = self.semi_sharp(v);
        let at = self.vertex(v, h);
        let edges = self.mesh.vertex_half_edges(v).map(|h| {
            let s = self.edge(h.edge());
            (h, [s, semi_sharp.half_of(s)])
        });
        Blend::of([at, decreased(at)], edges)
    }

    fn semi_sharp(&self, v: VertexId) -> SemiSharp {
        let edges = self.mesh.vertex_half_edges(v);
        SemiSharp::of(self.creasing, edges.map(|h| self.edge(h.edge())))
    }

    /// The next level divides the edge of `h` into two parts. Returns the sharpness with which the part of the edge at
    /// the origin of `h` shapes the surface. On the boundary, this sharpness is infinite.
    pub(crate) fn of_half(&self, h: HalfEdgeId) -> f64 {
        let semi_sharp = self.semi_sharp(self.mesh.origin(h));
        semi_sharp.half_of(self.edge(h.edge()))
    }

    /// The next level divides the edge of `h` into two parts. Returns the sharpness that is stored for the part of the
    /// edge at the origin of `h`.
    pub(crate) fn next_of_half(&self, h: HalfEdgeId) -> f64 {
        if self.edges.is_none() {
            0.0
        } else if self.mesh.is_boundary_edge(h.edge()) {
            decreased(self.stored(h.edge()))
        } else {
            self.of_half(h)
        }
    }
}
