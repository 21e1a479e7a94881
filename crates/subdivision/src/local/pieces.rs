//! The connectivity of the next level where only some faces and edges are cut.
//!
//! Numbers are those of the whole levels (see [`halves`](crate::halves), [`triangles`](crate::triangles) and
//! [`quads`](crate::quads)) without what is not cut: the parts of edges in order of the edges, then the edges
//! inside of faces, and the parts of faces, in order of the faces. A list of sums says where the parts of
//! each begin.
//!
//! A triangle with a hanging vertex m begins at it, and is cut as if that were the new vertex on its side:
//!
//! ```text
//!             c                     c                        c
//!           /   \                 /   \                    / | \
//!         /       \      -->    y ----- x        or      /   |   \       first half-edge: m to b
//!       /           \         /   \   /   \            /     |     \
//!      a ---- m ---- b       a ---- m ---- b          a ---- m ---- b
//! ```

use mesh::{Connectivity, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use super::area::Area;
use super::closure::{Cut, Cuts};
use super::drawing::Drawing;
use super::sides;
use crate::parallel::BLOCK;
use crate::topology::{Place, Topology};

/// A dense mesh and what becomes of its elements.
pub(super) struct Pieces<'a> {
    pub(super) mesh: &'a Mesh,
    area: Area,
    pub(super) cuts: Vec<Cut>,
    /// The new edges that lie on old ones.
    on_edges: Parts<EdgeId>,
    /// The new vertices that lie on old edges.
    pub(super) middles: Parts<EdgeId>,
    /// The new vertices inside faces.
    pub(super) centers: Parts<FaceId>,
    /// The new edges inside faces.
    inside: Parts<FaceId>,
    /// The new faces.
    faces: Parts<FaceId>,
}

/// What some elements become, in their order.
pub(super) struct Parts<I> {
    /// How many parts the elements before each have, and at last how many there are.
    first: Vec<u32>,
    /// The element of each part.
    of: Vec<I>,
}

impl<I: Copy> Parts<I> {
    fn new(elements: impl Iterator<Item = (I, u32)>) -> Self {
        let mut parts = Self {
            first: vec![0],
            of: Vec::new(),
        };
        let mut sum = 0;
        for (element, n) in elements {
            sum += n;
            parts.first.push(sum);
            parts.of.extend(std::iter::repeat_n(element, n as usize));
        }
        parts
    }

    pub(super) fn len(&self) -> usize {
        self.of.len()
    }

    /// The element of this part, if there are so many.
    pub(super) fn get(&self, part: usize) -> Option<I> {
        self.of.get(part).copied()
    }

    /// The number of the first part of element `i`.
    fn first(&self, i: usize) -> usize {
        self.first[i] as usize
    }
}

/// A side of a triangle that is cut into four, as the two old half-edges that run to and from its middle:
/// the same one, unless a vertex hangs there.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub(super) to: HalfEdgeId,
    pub(super) from: HalfEdgeId,
}

impl<'a> Pieces<'a> {
    /// The counts of the next level must fit into ids.
    pub(super) fn new(mesh: &'a Mesh, cuts: Cuts, area: Area) -> Self {
        let of_edges = |kept: u32| {
            let edges = mesh.edges().zip(&cuts.edges);
            Parts::new(edges.map(|(e, &is_cut)| (e, kept + u32::from(is_cut))))
        };
        let of_faces = |k: usize| {
            let faces = mesh.faces().zip(&cuts.faces);
            Parts::new(faces.map(|(f, cut)| (f, cut.counts()[k])))
        };
        Self {
            mesh,
            area,
            on_edges: of_edges(1),
            middles: of_edges(0),
            centers: of_faces(0),
            inside: of_faces(1),
            faces: of_faces(2),
            cuts: cuts.faces,
        }
    }

    /// How many vertices, edges and faces the next level has.
    pub(super) fn counts(&self) -> [usize; 3] {
        [
            self.mesh.n_vertices() + self.middles.len() + self.centers.len(),
            self.on_edges.len() + self.inside.len(),
            self.faces.len(),
        ]
    }

    /// The marks of the parts of marked faces.
    pub(super) fn inherited(&self, marks: &[bool]) -> Vec<bool> {
        self.faces.of.iter().map(|f| marks[f.index()]).collect()
    }

    pub(super) fn is_cut(&self, e: EdgeId) -> bool {
        self.middles.first(e.index()) != self.middles.first(e.index() + 1)
    }

    /// The first of the new edges on an old one.
    fn first_edge(&self, e: EdgeId) -> usize {
        self.on_edges.first(e.index())
    }

    /// The part of a half-edge that leaves its origin: all of it if the edge is not cut.
    pub(super) fn first(&self, h: HalfEdgeId) -> HalfEdgeId {
        let e = h.edge();
        let is_second_half = h.index() % 2;
        let is_behind = usize::from(self.is_cut(e)) * is_second_half;
        HalfEdgeId::new(2 * (self.first_edge(e) + is_behind) + is_second_half)
    }

    /// The part of a half-edge of a cut edge that goes to its target.
    pub(super) fn second(&self, h: HalfEdgeId) -> HalfEdgeId {
        let e = h.edge();
        let is_second_half = h.index() % 2;
        HalfEdgeId::new(2 * (self.first_edge(e) + 1 - is_second_half) + is_second_half)
    }

    /// The parts of a half-edge, in order.
    pub(super) fn parts_of(&self, h: HalfEdgeId) -> impl Iterator<Item = HalfEdgeId> {
        let second = self.is_cut(h.edge()).then(|| self.second(h));
        [self.first(h)].into_iter().chain(second)
    }

    /// The new vertex on a cut edge.
    pub(super) fn on_edge(&self, e: EdgeId) -> VertexId {
        VertexId::new(self.mesh.n_vertices() + self.middles.first(e.index()))
    }

    pub(super) fn center(&self, f: usize) -> VertexId {
        let first = self.mesh.n_vertices() + self.middles.len();
        VertexId::new(first + self.centers.first(f))
    }

    /// The first half of the k-th edge inside face `f`.
    pub(super) fn inner(&self, f: usize, k: usize) -> HalfEdgeId {
        let e = self.on_edges.len() + self.inside.first(f) + k;
        HalfEdgeId::new(2 * e)
    }

    /// The k-th part of face `f`.
    pub(super) fn part(&self, f: usize, k: usize) -> FaceId {
        FaceId::new(self.faces.first(f) + k)
    }

    /// The sides of a triangle: from the corner before which a vertex hangs if there is one, otherwise from
    /// the first.
    pub(super) fn three_sides(&self, f: usize) -> [Side; 3] {
        let start = self.mesh.face_half_edge(FaceId::new(f));
        let next = |h| self.mesh.next(h);
        let whole = |h| Side { to: h, from: h };
        let (h1, h2) = (next(start), next(next(start)));
        let h3 = next(h2);
        if h3 == start {
            return [start, h1, h2].map(whole);
        }
        let halved = Side {
            to: h3,
            from: start,
        };
        [whole(h1), whole(h2), halved]
    }

    pub(super) fn middle(&self, side: Side) -> VertexId {
        if side.is_whole() {
            self.on_edge(side.to.edge())
        } else {
            self.mesh.origin(side.from)
        }
    }

    /// Adds what runs from the corner of a side to its middle.
    pub(super) fn to_middle(&self, side: Side, ring: &mut Vec<HalfEdgeId>) {
        if side.is_whole() {
            ring.push(self.first(side.to));
        } else {
            ring.extend(self.parts_of(side.to));
        }
    }

    /// Adds what runs from the middle of a side to the next corner.
    pub(super) fn past_middle(&self, side: Side, ring: &mut Vec<HalfEdgeId>) {
        if side.is_whole() {
            ring.push(self.second(side.to));
        } else {
            ring.extend(self.parts_of(side.from));
        }
    }
}

impl Side {
    fn is_whole(self) -> bool {
        self.to == self.from
    }
}

impl Topology for Pieces<'_> {
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, Cancelled> {
        let mut drawing = Drawing::of_edges(self);
        for f in 0..self.cuts.len() {
            if f % BLOCK == 0 {
                meter.add(BLOCK.min(self.cuts.len() - f))?;
            }
            match self.cuts[f] {
                Cut::Whole | Cut::Hung => drawing.keep(f),
                Cut::Two => drawing.cut_in_two(f),
                Cut::Four => drawing.cut_into_four(f),
                Cut::Quads(_) => drawing.cut_into_quads(f),
            }
        }
        Ok(drawing.new)
    }

    fn corner(&self, _: &Connectivity, i: usize) -> Place {
        let Some(inner) = (i / 2).checked_sub(self.on_edges.len()) else {
            let e = self.on_edges.of[i / 2];
            let h = e.half_edges()[i % 2];
            return if self.mesh.face(h).is_none() {
                Place::Outside
            } else if self.first(h).index() == i {
                Place::At(h)
            } else {
                Place::On(h)
            };
        };
        let face = self.inside.of[inner];
        let f = face.index();
        let k = inner - self.inside.first(f);
        let is_first = i.is_multiple_of(2);
        match self.cuts[f] {
            Cut::Two => {
                let m = self.mesh.face_half_edge(face);
                let c = self.mesh.next(self.mesh.next(m));
                Place::At(if is_first { c } else { m })
            }
            Cut::Quads(_) if !is_first => Place::In(face),
            Cut::Quads(_) => {
                let mut sides = sides(self.mesh, f);
                sides.nth(k).map_or(Place::Outside, Place::On)
            }
            // Edge k runs from the middle of side k to that of the one before.
            _ => match self.three_sides(f)[if is_first { k } else { (k + 2) % 3 }] {
                side if side.is_whole() => Place::On(side.to),
                side => Place::At(side.from),
            },
        }
    }

    fn edge(&self, i: usize) -> Option<usize> {
        self.on_edges.get(i).map(EdgeId::index)
    }

    fn face(&self, i: usize) -> Option<usize> {
        self.faces.get(i).map(FaceId::index)
    }

    fn moves(&self, v: usize) -> bool {
        self.area.vertices[v]
    }

    fn smooths(&self, e: EdgeId) -> bool {
        self.area.edges[e.index()]
    }

    fn half(&self, i: usize) -> Option<HalfEdgeId> {
        let e = self.on_edges.get(i)?;
        Some(e.half_edges()[i - self.first_edge(e)])
    }
}
