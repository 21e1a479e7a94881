//! Creases and corners: which rule holds at a vertex and an edge, and how sharpness decreases.
//!
//! Sharpness is a number: 0 is smooth, 10 and more is sharp on every level, and between them an element
//! is sharp for so many levels and then smooth. Where it ends within a level the two are blended (DeRose,
//! Kass and Truong, "Subdivision Surfaces in Character Animation", 1998, in the form that OpenSubdiv
//! gives them). The rule of a vertex depends on what is sharp there:
//!
//! ```text
//!         |                  |                  ‖                  ‖
//!      -- o --            == o --            == o --            == o ==
//!         |                  |                  |                  |
//!
//!    smooth: nothing    dart: one edge,    crease: two edges    corner: more, or the vertex
//!                       still smooth                            itself
//! ```
//!
//! Edges of the boundary are infinitely sharp.

use mesh::{CREASE, EdgeId, HalfEdgeId, Mesh, VERTEX_SHARPNESS, VertexId};

use crate::parallel::any;
use crate::rules::{Boundary, Creasing, Rules};

/// From here on sharpness does not decrease.
pub(crate) const INFINITE: f64 = 10.0;

/// What is sharp in a mesh.
#[derive(Clone, Copy)]
pub(crate) struct Sharpness<'a> {
    mesh: &'a Mesh,
    boundary: Boundary,
    creasing: Creasing,
    /// `None` if nothing inside is sharp.
    edges: Option<&'a [f64]>,
    vertices: Option<&'a [f64]>,
}

/// How a vertex moves. Edges around it are named by `K`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VertexRule<K> {
    /// By the mask of the scheme.
    Smooth,
    /// Along the crease over these two edges.
    Crease([K; 2]),
    /// Not at all.
    Corner,
}

/// The rule of a vertex, and what it changes to within the level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Blend<K> {
    /// The rule by the sharpness of this level.
    pub(crate) now: VertexRule<K>,
    /// The rule by that of the next, and the weight of the one of this level.
    pub(crate) next: Option<(VertexRule<K>, f64)>,
}

impl<K: Copy> VertexRule<K> {
    /// The rule by the sharpness of the vertex and of the edges around it.
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
    /// The rule by the sharpness of the vertex and of the edges around it, on this level and the next.
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
        let weight = fading(edges.map(|(_, s)| s).chain([at]));
        Self {
            now,
            next: Some((next, weight)),
        }
    }
}

/// The semi-sharp edges at a vertex: the sum of their sharpness and how many there are.
#[derive(Clone, Copy, Default)]
pub(crate) struct SemiSharp {
    sum: f64,
    n: usize,
}

impl SemiSharp {
    /// Of edges of such sharpness. Without Chaikin's rule nothing is asked of them.
    pub(crate) fn of(creasing: Creasing, edges: impl Iterator<Item = f64>) -> Self {
        let mut found = Self::default();
        if creasing == Creasing::Chaikin {
            for s in edges.filter(|&s| s > 0.0 && s < INFINITE) {
                found.sum += s;
                found.n += 1;
            }
        }
        found
    }

    /// What the half of an edge of sharpness `s` at this vertex has on the next level.
    pub(crate) fn half_of(self, s: f64) -> f64 {
        if s <= 0.0 || s >= INFINITE || self.n < 2 {
            return decreased(s);
        }
        let others = (self.sum - s) / (self.n - 1) as f64;
        (0.75 * s + 0.25 * others - 1.0).max(0.0)
    }
}

/// What is left of sharpness on the next level.
pub(crate) fn decreased(s: f64) -> f64 {
    if s >= INFINITE {
        INFINITE
    } else {
        (s - 1.0).max(0.0)
    }
}

/// How much of this level's rule is left where elements become smooth within the level: the mean of the
/// sharpness that ends, out of pairs of this level's and the next.
pub(crate) fn fading(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
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

    /// Whether nothing but the boundary is sharp.
    #[inline]
    fn is_plain(&self) -> bool {
        self.edges.is_none() && self.vertices.is_none()
    }

    /// The number that is stored for an edge.
    #[inline]
    fn stored(&self, e: EdgeId) -> f64 {
        self.edges.map_or(0.0, |s| s[e.index()].max(0.0))
    }

    /// The sharpness of an edge.
    #[inline]
    pub(crate) fn edge(&self, e: EdgeId) -> f64 {
        if self.mesh.is_boundary_edge(e) {
            INFINITE
        } else {
            self.stored(e)
        }
    }

    /// The sharpness of a vertex that half-edge `h` leaves, the boundary one if there is one.
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

    /// The half-edge that leaves the vertex of boundary half-edge `h` along the other boundary edge.
    #[inline]
    fn clockwise_last(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.mesh.prev(h).twin()
    }

    /// How much of the sharp mask the new vertex on an edge has: 1 lies in the middle, 0 is smooth.
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

    /// How vertex `v` moves, which half-edge `h` leaves: the boundary one if there is one.
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

    /// The sharpness of the half of an edge at the origin of `h`, on the next level.
    pub(crate) fn of_half(&self, h: HalfEdgeId) -> f64 {
        let around = self.semi_sharp(self.mesh.origin(h));
        around.half_of(self.edge(h.edge()))
    }

    /// The stored sharpness of the half of an edge at the origin of `h`, on the next level.
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
