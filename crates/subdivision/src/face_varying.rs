//! Smooths corner values, such as texture coordinates, piece by piece between seams.
//!
//! A piece is a set of corners around a vertex that have the same value. The edges between pieces are seams. Inside a
//! piece, values are smoothed by the rules for positions. Along a seam, the values of each piece are smoothed or
//! interpolated linearly. Smoothing along a seam uses the rule for boundaries, and reads only values of the same piece:
//!
//! ```text
//!            \   |   /                     The value at v in the upper piece is x. If v is not a corner of this
//!         ---- \ | / ----                  piece, x becomes 3/4 x + 1/8 (y + z), where y and z are the values at b
//!         b ==== v ==== c    seam          and c in the same piece. If v is a corner of the piece, x stays.
//!         ---- / | \ ----
//!            /   |   \
//! ```
//!
//! At some vertices, the value of a piece does not change. These vertices are called the corners of the piece, and
//! [`FaceVarying`] defines the rules that select them. The rules are those of OpenSubdiv's face-varying interpolation.
//! In this crate, the rules are applied to each level separately. So one call that computes two levels gives the same
//! result as two calls that compute one level each. The results can differ from those of OpenSubdiv in one case: two
//! pieces meet at a vertex, and one of them contains a semi-sharp edge (sharp on the first levels only). As long as
//! this edge is sharp, the value of the other piece can stay unchanged. OpenSubdiv decides on the first level whether
//! this value stays unchanged, and keeps the decision on all levels. If the edges inside the pieces, the seam between
//! the pieces and the vertex have different semi-sharp values, the results on later levels can differ from those of
//! OpenSubdiv.

use mesh::{DVec4, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use crate::parallel::computed;
use crate::rules::{FaceVarying, Rules, Scheme};
use crate::sharpness::{INFINITE, Sharpness, VertexRule, decreased, fading_weight};
use crate::topology::{Place, linear_value};

/// A column of corner values to be smoothed.
pub(crate) struct Field<'a> {
    mesh: &'a Mesh,
    sharpness: Sharpness<'a>,
    scheme: Scheme,
    rule: FaceVarying,
    values: &'a [DVec4],
    /// For each edge, whether the values on its two sides differ at one or both of its ends.
    seams: Vec<bool>,
    /// For each face, the mean of its corner values, if the scheme is Catmull-Clark; otherwise empty.
    centers: Vec<DVec4>,
}

/// Indices into a pair: the sharpness on this level, and the sharpness on the next level.
const NOW: usize = 0;
const NEXT: usize = 1;

/// How the value of a piece at a vertex changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// The value does not change on any level.
    Corner,
    /// The value stays unchanged while an edge inside the piece, or the vertex, is sharp.
    SemiSharp,
    /// The vertex has two pieces. The value stays unchanged while an edge inside the other piece is sharp.
    Dependent,
    /// The value is smoothed along the border of the piece.
    Crease,
}

/// A piece: the corners around a vertex that have the same value.
struct Piece {
    /// The half-edges of the first and the last corner, counter-clockwise.
    ends: [HalfEdgeId; 2],
    size: usize,
    /// The outgoing half-edges of the edges inside the piece.
    inside: Vec<HalfEdgeId>,
    /// Whether the corners are not consecutive, or a seam runs between two of them.
    is_torn: bool,
}

/// The pieces around a vertex.
struct VertexPieces {
    vertex: VertexId,
    half_edge: HalfEdgeId,
    is_inner: bool,
    pieces: Vec<Piece>,
}

impl<'a> Field<'a> {
    pub(crate) fn new(
        mesh: &'a Mesh,
        sharpness: Sharpness<'a>,
        rules: Rules,
        values: &'a [DVec4],
        meter: &Meter,
    ) -> Result<Self, Cancelled> {
        let differ = |a: HalfEdgeId, b: HalfEdgeId| values[a.index()] != values[b.index()];
        let is_seam = |e: usize| {
            let [h, twin] = EdgeId::new(e).half_edges();
            !mesh.is_boundary_edge(h.edge())
                && (differ(h, mesh.next(twin)) || differ(twin, mesh.next(h)))
        };
        let center = |f: usize| {
            let f = FaceId::new(f);
            let mut sum = DVec4::ZERO;
            for h in mesh.face_half_edges(f) {
                sum += values[h.index()];
            }
            sum * (1.0 / mesh.degree(f) as f64)
        };
        let has_centers = rules.scheme == Scheme::CatmullClark;
        let n_centers = if has_centers { mesh.n_faces() } else { 0 };
        Ok(Self {
            mesh,
            sharpness,
            scheme: rules.scheme,
            rule: rules.face_varying,
            values,
            seams: computed(mesh.n_edges(), meter, is_seam)?,
            centers: computed(n_centers, meter, center)?,
        })
    }

    /// Returns the value of a corner of the next subdivision level.
    pub(crate) fn value(&self, place: Place) -> DVec4 {
        match place {
            Place::At(h) => self.at(h),
            Place::On(h) => self.on(h),
            Place::In(f) => self.centers[f.index()],
            _ => linear_value(self.mesh, place, self.values),
        }
    }

    /// Returns the sharpness of the edge of `h` on this level, then the sharpness on the next level. The next level
    /// divides the edge into two parts; the second value is the sharpness of the part at the origin of `h`.
    fn edge_sharpness(&self, h: HalfEdgeId) -> [f64; 2] {
        [self.sharpness.edge(h.edge()), self.sharpness.of_half(h)]
    }

    fn of(&self, h: HalfEdgeId) -> DVec4 {
        self.values[h.index()]
    }

    /// Returns the corner value at the target of a half-edge. If the half-edge has a face, uses the corner in this
    /// face; otherwise, uses the corner in the face of its twin.
    fn far(&self, h: HalfEdgeId) -> DVec4 {
        if self.mesh.face(h).is_some() {
            self.of(self.mesh.next(h))
        } else {
            self.of(h.twin())
        }
    }

    /// Returns the value of the new corner that lies in the old face of `h`, in the middle of `h`.
    fn on(&self, h: HalfEdgeId) -> DVec4 {
        let e = h.edge();
        let sharp = if self.seams[e.index()] {
            1.0
        } else {
            self.sharpness.weight_at_edge(e)
        };
        if sharp >= 1.0 {
            return (self.of(h) + self.of(self.mesh.next(h))) * 0.5;
        }
        // The terms are added in the same order for both half-edges of the edge. So the values on the two sides of the
        // edge are identical bit for bit.
        let halves = e.half_edges();
        let ends = self.of(halves[0]) + self.of(self.mesh.next(halves[0]));
        let [smooth_end, sides] = if self.scheme == Scheme::CatmullClark {
            let center = |h| {
                self.mesh
                    .face(h)
                    .map_or(DVec4::ZERO, |f| self.centers[f.index()])
            };
            let [f, g] = halves.map(center);
            [ends * 0.25, (f + g) * 0.25]
        } else {
            let opposite = |h| self.of(self.mesh.next(self.mesh.next(h)));
            let [c, d] = halves.map(opposite);
            [ends * 0.375, (c + d) * 0.125]
        };
        ends * (0.5 * sharp) + (smooth_end + sides) * (1.0 - sharp)
    }

    /// Returns the value of the new corner that lies in the old face of `h`, at the origin of `h`.
    fn at(&self, h: HalfEdgeId) -> DVec4 {
        let v = self.mesh.origin(h);
        let start = self.mesh.vertex_half_edge(v).expect("a vertex of a face");
        let is_boundary = self.mesh.face(start).is_none();
        let mut spokes = self.mesh.vertex_half_edges(v);
        let is_regular = spokes.all(|h| !self.seams[h.edge().index()])
            && !(is_boundary && self.is_irregular_boundary(v, start));
        if is_regular {
            return self.regular(v, start, self.of(h));
        }
        self.pieces(v, start).value(self, h)
    }

    /// At a boundary vertex without seams: whether the rule for corner values differs from the rule for positions.
    fn is_irregular_boundary(&self, v: VertexId, start: HalfEdgeId) -> bool {
        match self.rule {
            FaceVarying::None => false,
            FaceVarying::Boundaries => true,
            _ => self.mesh.valence(v) == 2 && self.sharpness.vertex(v, start) < INFINITE,
        }
    }

    /// Returns the new value at a vertex whose corners all have the same value (they form a single piece). The rules
    /// for positions are used.
    fn regular(&self, v: VertexId, start: HalfEdgeId, own: DVec4) -> DVec4 {
        let blend = self.sharpness.at_vertex(v, start);
        let by_rule = |rule: VertexRule<HalfEdgeId>| match rule {
            VertexRule::Corner => own,
            VertexRule::Crease([a, b]) => own * 0.75 + (self.far(a) + self.far(b)) * 0.125,
            VertexRule::Smooth => self.smooth(v, own),
        };
        match blend.next {
            None => by_rule(blend.now),
            Some((next, weight)) => by_rule(blend.now) * weight + by_rule(next) * (1.0 - weight),
        }
    }

    fn smooth(&self, v: VertexId, own: DVec4) -> DVec4 {
        let valence = self.mesh.valence(v);
        let n = valence as f64;
        let mut sum = DVec4::ZERO;
        if let Scheme::Loop(weights) = self.scheme {
            for h in self.mesh.vertex_half_edges(v) {
                sum += self.far(h);
            }
            let u = weights.of(valence);
            return own * (1.0 - n * u) + sum * u;
        }
        for h in self.mesh.vertex_half_edges(v) {
            sum += self.far(h);
            if let Some(f) = self.mesh.face(h) {
                sum += self.centers[f.index()];
            }
        }
        own * ((n - 2.0) / n) + sum * (1.0 / (n * n))
    }

    /// Collects the pieces around a vertex.
    fn pieces(&self, v: VertexId, start: HalfEdgeId) -> VertexPieces {
        // The corners around the vertex are collected in counter-clockwise order. At a boundary vertex, the corners run
        // from one boundary edge to the other.
        let corners = self.mesh.vertex_half_edges(v);
        let mut ring: Vec<HalfEdgeId> = corners.filter(|&h| self.mesh.face(h).is_some()).collect();
        ring.reverse();
        let is_inner = self.mesh.face(start).is_some();
        // The half-edge of a corner separates the corner from the previous corner.
        let is_seam = |h: &HalfEdgeId| self.seams[h.edge().index()];
        let n_seams = ring.iter().filter(|h| is_seam(h)).count();
        let is_dart =
            is_inner && n_seams == 1 && ring.iter().all(|&h| self.of(h) == self.of(ring[0]));
        if is_dart {
            let seam = ring.iter().position(is_seam).expect("counted above");
            ring.rotate_left(seam);
        }
        let before = |i: usize| match i {
            0 if is_dart || !is_inner => None,
            0 => Some(ring.len() - 1),
            i => Some(i - 1),
        };
        let mut pieces: Vec<Piece> = Vec::new();
        for i in 0..ring.len() {
            let same = |h: HalfEdgeId| self.of(h) == self.of(ring[i]);
            if ring[..i].iter().any(|&h| same(h)) {
                continue;
            }
            let members: Vec<usize> = (0..ring.len()).filter(|&j| same(ring[j])).collect();
            let joined = |&j: &usize| before(j).is_some_and(|b| same(ring[b]));
            let starts: Vec<usize> = members.iter().copied().filter(|j| !joined(j)).collect();
            let inside: Vec<HalfEdgeId> = members
                .iter()
                .filter(|j| joined(j))
                .map(|&j| ring[j])
                .collect();
            let first = starts.first().copied().unwrap_or(0);
            let last = (first + members.len() - 1) % ring.len();
            pieces.push(Piece {
                ends: [ring[first], ring[last]],
                size: members.len(),
                is_torn: starts.len() != 1 || inside.iter().any(is_seam),
                inside,
            });
        }
        VertexPieces {
            vertex: v,
            half_edge: start,
            is_inner,
            pieces,
        }
    }
}

impl VertexPieces {
    /// Returns the new value of the corner of `h`.
    fn value(&self, field: &Field, h: HalfEdgeId) -> DVec4 {
        let own = field.of(h);
        let is_own = |piece: &Piece| field.of(piece.ends[0]) == own;
        let Some(i) = self.pieces.iter().position(is_own) else {
            return own; // The value is NaN, which is not equal to itself, so no piece is found.
        };
        let piece = &self.pieces[i];
        let crease = || {
            let [first, last] = piece.ends;
            let ends = field.of(field.mesh.next(first)) + field.of(field.mesh.prev(last));
            own * 0.75 + ends * 0.125
        };
        let state = self.state(field, i, NOW);
        match state {
            State::Corner => own,
            State::Crease => crease(),
            State::SemiSharp | State::Dependent => {
                if self.state(field, i, NEXT) != State::Crease {
                    return own;
                }
                let from = match state {
                    State::Dependent => &self.pieces[1 - i],
                    _ => piece,
                };
                let weight = self.weight(field, from);
                own * weight + crease() * (1.0 - weight)
            }
        }
    }

    /// Returns how the value of piece `i` changes. `when` is `NOW` to use the sharpness on this level, or `NEXT` to use
    /// the sharpness on the next level.
    fn state(&self, field: &Field, i: usize, when: usize) -> State {
        let (rule, n) = (field.rule, self.pieces.len());
        let own = self.sharpness(field)[when];
        let inside = |piece: &Piece, test: fn(f64) -> bool| {
            let mut edges = piece.inside.iter();
            edges.any(|&h| test(field.edge_sharpness(h)[when]))
        };
        let is_hard = |piece: &Piece| inside(piece, |s| s >= INFINITE);
        let is_semi = |piece: &Piece| inside(piece, |s| s > 0.0 && s < INFINITE);
        let is_plus = matches!(rule, FaceVarying::CornersPlus1 | FaceVarying::CornersPlus2);
        let is_plus_2 = rule == FaceVarying::CornersPlus2;
        let any = |test: &dyn Fn(&Piece) -> bool| self.pieces.iter().any(test);

        let all_are_corners = rule == FaceVarying::Boundaries
            || own >= INFINITE
            || is_plus && n > 2
            || is_plus && n == 2 && any(&|p| p.is_torn || is_hard(p))
            || is_plus_2 && n == 1 && self.is_inner
            || is_plus_2 && n == 2 && any(&|p| p.size == 1);
        let piece = &self.pieces[i];
        if all_are_corners
            || piece.is_torn
            || is_hard(piece)
            || piece.size == 1 && rule != FaceVarying::None
        {
            State::Corner
        } else if own > 0.0 || is_semi(piece) {
            State::SemiSharp
        } else if is_plus && n == 2 && is_semi(&self.pieces[1 - i]) {
            State::Dependent
        } else {
            State::Crease
        }
    }

    /// Returns the sharpness of the vertex on this level and on the next level.
    fn sharpness(&self, field: &Field) -> [f64; 2] {
        let now = field.sharpness.vertex(self.vertex, self.half_edge);
        [now, decreased(now)]
    }

    /// Returns the weight of this level's rule in the blend with the next level's rule. Some elements are sharp on this
    /// level and smooth on the next level. The weight is their mean sharpness, limited to 1.
    fn weight(&self, field: &Field, piece: &Piece) -> f64 {
        let edges = piece.inside.iter().map(|&h| field.edge_sharpness(h));
        fading_weight(edges.chain([self.sharpness(field)]))
    }
}
