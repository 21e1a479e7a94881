//! The connectivity of the next subdivision level if only some faces and edges are cut.
//!
//! Elements are in the same order as if all faces were cut (see [`halves`](crate::halves),
//! [`triangles`](crate::triangles) and [`quads`](crate::quads)). The parts of edges come first, in order of the edges.
//! The edges inside faces follow, in order of the faces. The parts of faces are in order of the faces. The index of the
//! first part of an element is a prefix sum: the number of parts of all earlier elements of the same kind.
//!
//! If a triangle has a hanging vertex m (a vertex in the middle of a side), its first half-edge starts at m. A triangle
//! with a hanging vertex m is cut as if m were the new vertex on its side:
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

use super::builder::ConnectivityBuilder;
use super::closure::{Cut, Cuts};
use super::sides;
use crate::parallel::BLOCK;
use crate::topology::{Place, Topology};

/// A mesh without deleted elements, and the parts into which its elements are cut.
pub(super) struct Pieces<'a> {
    pub(super) mesh: &'a Mesh,
    smoothed: SmoothedElements,
    pub(super) cuts: Vec<Cut>,
    /// The new edges that lie on old edges.
    on_edges: PartTable<EdgeId>,
    /// The new vertices that lie on old edges.
    pub(super) middles: PartTable<EdgeId>,
    /// The new vertices inside faces.
    pub(super) centers: PartTable<FaceId>,
    /// The new edges inside faces.
    inside: PartTable<FaceId>,
    /// The new faces.
    faces: PartTable<FaceId>,
}

/// The vertices and edges that are smoothed, because all their faces are chosen.
pub(super) struct SmoothedElements {
    /// For each vertex, whether all its faces are chosen.
    vertices: Vec<bool>,
    /// For each edge, whether all its faces are chosen.
    edges: Vec<bool>,
}

impl SmoothedElements {
    pub(super) fn of(mesh: &Mesh, chosen: &[bool]) -> Self {
        let mut vertices = vec![true; mesh.n_vertices()];
        let mut edges = vec![true; mesh.n_edges()];
        for f in mesh.faces().filter(|f| !chosen[f.index()]) {
            for h in mesh.face_half_edges(f) {
                vertices[mesh.origin(h).index()] = false;
                edges[h.edge().index()] = false;
            }
        }
        Self { vertices, edges }
    }
}

/// The ids of the parts into which elements of one kind are cut, in order of the elements.
pub(super) struct PartTable<I> {
    /// The id of the first part of each element, followed by the total number of parts.
    first: Vec<u32>,
    /// For each part, the element to which it belongs.
    of: Vec<I>,
}

impl<I: Copy> PartTable<I> {
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

    /// Returns the element of a part, or `None` if there is no such part.
    pub(super) fn get(&self, part: usize) -> Option<I> {
        self.of.get(part).copied()
    }

    /// Returns the id of the first part of element `i`.
    fn first(&self, i: usize) -> usize {
        self.first[i] as usize
    }
}

/// A side of a triangle, if the triangle is cut into four: the old half-edges before and after the middle of the side.
/// The two half-edges differ if the side has a hanging vertex; otherwise both are the half-edge of the side.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub(super) to: HalfEdgeId,
    pub(super) from: HalfEdgeId,
}

impl<'a> Pieces<'a> {
    /// Assigns ids to the parts of all elements. The caller must have checked that there are enough ids for the
    /// elements of the next level.
    pub(super) fn new(mesh: &'a Mesh, cuts: Cuts, smoothed: SmoothedElements) -> Self {
        let with_edges = |kept: u32| {
            let edges = mesh.edges().zip(&cuts.edges);
            PartTable::new(edges.map(|(e, &is_cut)| (e, kept + u32::from(is_cut))))
        };
        let of_faces = |k: usize| {
            let faces = mesh.faces().zip(&cuts.faces);
            PartTable::new(faces.map(|(f, cut)| (f, cut.counts()[k])))
        };
        Self {
            mesh,
            smoothed,
            on_edges: with_edges(1),
            middles: with_edges(0),
            centers: of_faces(0),
            inside: of_faces(1),
            faces: of_faces(2),
            cuts: cuts.faces,
        }
    }

    /// Returns how many vertices, edges and faces the next level has.
    pub(super) fn counts(&self) -> [usize; 3] {
        [
            self.mesh.n_vertices() + self.middles.len() + self.centers.len(),
            self.on_edges.len() + self.inside.len(),
            self.faces.len(),
        ]
    }

    /// Returns the flags of the new faces: each part has the flag of its old face.
    pub(super) fn inherited_flags(&self, flags: &[bool]) -> Vec<bool> {
        self.faces.of.iter().map(|f| flags[f.index()]).collect()
    }

    pub(super) fn is_cut(&self, e: EdgeId) -> bool {
        self.middles.first(e.index()) != self.middles.first(e.index() + 1)
    }

    /// Returns the id of the first new edge on an old edge.
    fn first_edge(&self, e: EdgeId) -> usize {
        self.on_edges.first(e.index())
    }

    /// Returns the first part of a half-edge: the part that starts at its origin, or the whole half-edge if the edge is
    /// not cut.
    pub(super) fn first(&self, h: HalfEdgeId) -> HalfEdgeId {
        let e = h.edge();
        let is_second_half = h.index() % 2;
        let is_behind = usize::from(self.is_cut(e)) * is_second_half;
        HalfEdgeId::new(2 * (self.first_edge(e) + is_behind) + is_second_half)
    }

    /// Returns the second part of a half-edge: the part that ends at its target. The edge must be cut.
    pub(super) fn second(&self, h: HalfEdgeId) -> HalfEdgeId {
        let e = h.edge();
        let is_second_half = h.index() % 2;
        HalfEdgeId::new(2 * (self.first_edge(e) + 1 - is_second_half) + is_second_half)
    }

    /// Iterates over the parts of a half-edge, in order.
    pub(super) fn parts_of(&self, h: HalfEdgeId) -> impl Iterator<Item = HalfEdgeId> {
        let second = self.is_cut(h.edge()).then(|| self.second(h));
        [self.first(h)].into_iter().chain(second)
    }

    /// Returns the new vertex on a cut edge.
    pub(super) fn on_edge(&self, e: EdgeId) -> VertexId {
        VertexId::new(self.mesh.n_vertices() + self.middles.first(e.index()))
    }

    pub(super) fn center(&self, f: usize) -> VertexId {
        let first = self.mesh.n_vertices() + self.middles.len();
        VertexId::new(first + self.centers.first(f))
    }

    /// Returns the first half-edge of the `k`-th edge inside face `f`.
    pub(super) fn inner(&self, f: usize, k: usize) -> HalfEdgeId {
        let e = self.on_edges.len() + self.inside.first(f) + k;
        HalfEdgeId::new(2 * e)
    }

    /// Returns the `k`-th part of face `f`.
    pub(super) fn part(&self, f: usize, k: usize) -> FaceId {
        FaceId::new(self.faces.first(f) + k)
    }

    /// Returns the sides of a triangle. If the triangle has a hanging vertex, the side with that vertex comes last.
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

    /// Adds to `ring` the half-edges from the start of a side to its middle.
    pub(super) fn to_middle(&self, side: Side, ring: &mut Vec<HalfEdgeId>) {
        if side.is_whole() {
            ring.push(self.first(side.to));
        } else {
            ring.extend(self.parts_of(side.to));
        }
    }

    /// Adds to `ring` the half-edges from the middle of a side to its end.
    pub(super) fn push_ring_from_middle(&self, side: Side, ring: &mut Vec<HalfEdgeId>) {
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
        let mut builder = ConnectivityBuilder::with_edges(self);
        for f in 0..self.cuts.len() {
            if f % BLOCK == 0 {
                meter.add(BLOCK.min(self.cuts.len() - f))?;
            }
            match self.cuts[f] {
                Cut::Whole | Cut::Hanging => builder.keep(f),
                Cut::Two => builder.cut_in_two(f),
                Cut::Four => builder.cut_into_four(f),
                Cut::Quads(_) => builder.cut_into_quads(f),
            }
        }
        Ok(builder.new)
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
            // Edge k inside the face runs from the middle of side k to the middle of the previous side.
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

    fn smooths_vertex(&self, v: usize) -> bool {
        self.smoothed.vertices[v]
    }

    fn smooths_edge(&self, e: EdgeId) -> bool {
        self.smoothed.edges[e.index()]
    }

    fn half(&self, i: usize) -> Option<HalfEdgeId> {
        let e = self.on_edges.get(i)?;
        Some(e.half_edges()[i - self.first_edge(e)])
    }
}
