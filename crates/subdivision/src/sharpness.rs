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

use mesh::{CORNER, CREASE, EdgeId, HalfEdgeId, Mesh, VertexId};
use rayon::prelude::*;

use crate::meter::BLOCK;
use crate::{Boundary, Creasing, Rules};

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

/// How a vertex moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VertexRule {
    /// By the mask of the scheme.
    Smooth,
    /// Along the crease between the targets of these half-edges, which leave the vertex.
    Crease([HalfEdgeId; 2]),
    /// Not at all.
    Corner,
}

/// The rule of a vertex, and what it changes to within the level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Blend {
    /// The rule by the sharpness of this level.
    pub(crate) now: VertexRule,
    /// The rule by that of the next, and the weight of the one of this level.
    pub(crate) next: Option<(VertexRule, f64)>,
}

/// The semi-sharp edges at a vertex.
#[derive(Clone, Copy, Default)]
struct SemiSharp {
    sum: f64,
    n: usize,
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
            values.par_iter().any(|&s| s > 0.0).then_some(values)
        }
        Self {
            mesh,
            boundary: rules.boundary,
            creasing: rules.creasing,
            edges: mesh.get(CREASE).and_then(used),
            vertices: mesh.get(CORNER).and_then(used),
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
                Boundary::EdgesAndCorners => self.clockwise_last(h) == self.clockwise_next(h),
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

    #[inline]
    fn clockwise_next(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.mesh.next(h.twin())
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
    pub(crate) fn at_vertex(&self, v: VertexId, h: HalfEdgeId) -> Blend {
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

    fn with_creases(&self, v: VertexId, h: HalfEdgeId) -> Blend {
        let now = self.rule(v, self.vertex(v, h), |h| self.edge(h.edge()));
        if now == VertexRule::Smooth {
            return Blend { now, next: None };
        }
        let semi_sharp = self.semi_sharp(v);
        let next_at = self.decreased(self.vertex(v, h));
        let next_on = |h: HalfEdgeId| self.of_half_with(h, semi_sharp);
        let next = self.rule(v, next_at, next_on);
        if std::mem::discriminant(&now) == std::mem::discriminant(&next) {
            return Blend { now, next: None };
        }
        let edges = self.mesh.vertex_half_edges(v);
        let edges = edges.map(|h| [self.edge(h.edge()), next_on(h)]);
        let weight = fading(edges.chain([[self.vertex(v, h), next_at]]));
        Blend {
            now,
            next: Some((next, weight)),
        }
    }

    /// The rule of a vertex by its sharpness and that of the edges around it.
    fn rule(&self, v: VertexId, at: f64, on: impl Fn(HalfEdgeId) -> f64) -> VertexRule {
        if at > 0.0 {
            return VertexRule::Corner;
        }
        let mut sharp = self.mesh.vertex_half_edges(v).filter(|&h| on(h) > 0.0);
        match (sharp.next(), sharp.next(), sharp.next()) {
            (Some(a), Some(b), None) => VertexRule::Crease([a, b]),
            (_, _, None) => VertexRule::Smooth,
            _ => VertexRule::Corner,
        }
    }

    fn semi_sharp(&self, v: VertexId) -> SemiSharp {
        let mut found = SemiSharp::default();
        if self.creasing == Creasing::Chaikin {
            for h in self.mesh.vertex_half_edges(v) {
                let s = self.edge(h.edge());
                if s > 0.0 && s < INFINITE {
                    found.sum += s;
                    found.n += 1;
                }
            }
        }
        found
    }

    /// What is left of the sharpness of a vertex on the next level.
    #[expect(clippy::unused_self, reason = "reads like its neighbors")]
    pub(crate) fn decreased(&self, s: f64) -> f64 {
        if s >= INFINITE {
            INFINITE
        } else {
            (s - 1.0).max(0.0)
        }
    }

    /// The sharpness of the half of an edge at the origin of `h`, on the next level.
    pub(crate) fn of_half(&self, h: HalfEdgeId) -> f64 {
        self.of_half_with(h, self.semi_sharp(self.mesh.origin(h)))
    }

    fn of_half_with(&self, h: HalfEdgeId, around: SemiSharp) -> f64 {
        let s = self.edge(h.edge());
        if s <= 0.0 || s >= INFINITE || around.n < 2 {
            return self.decreased(s);
        }
        let others = (around.sum - s) / (around.n - 1) as f64;
        (0.75 * s + 0.25 * others - 1.0).max(0.0)
    }

    /// The stored sharpness of the `n` edges of the next level: both halves of each edge, then those
    /// inside old faces, which are smooth.
    pub(crate) fn next_edges(&self, old: &[f64], n: usize) -> Vec<f64> {
        let mut new = mesh::zeroed(n);
        if self.edges.is_some() {
            new[..2 * old.len()]
                .par_iter_mut()
                .with_min_len(BLOCK)
                .enumerate()
                .for_each(|(i, s)| {
                    // Half 2e of edge e lies at the origin of half-edge 2e, and so on.
                    let h = HalfEdgeId::new(i);
                    *s = if self.mesh.is_boundary_edge(h.edge()) {
                        self.decreased(self.stored(h.edge()))
                    } else {
                        self.of_half(h)
                    };
                });
        }
        new
    }

    /// The stored sharpness of the `n` vertices of the next level: the old ones, then new ones, which
    /// are smooth.
    pub(crate) fn next_vertices(&self, old: &[f64], n: usize) -> Vec<f64> {
        let mut new = mesh::zeroed(n);
        for (new, old) in new.iter_mut().zip(old) {
            *new = self.decreased(old.max(0.0));
        }
        new
    }
}
