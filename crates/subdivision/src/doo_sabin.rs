//! The connectivity of Doo-Sabin subdivision: every corner becomes a vertex, and every face, edge and vertex
//! becomes a face.
//!
//! The old mesh has V vertices, E edges and F faces. Half-edge h runs from a to b and has face f; its twin t has face
//! g. The corner at the origin of h becomes vertex h. If h has no face, two points on the edge replace the missing
//! corners: vertex h near a, and a second vertex near b. The second vertex has the index 2E + r, where r is the number
//! of half-edges without a face that come before h. Two new vertices lie beside h: p(h) near a, and q(h) near b:
//!
//! ```text
//!                  |         f         |             along(h)  = 2h, from p(h) to q(h), in face f
//!                  |                   |             its twin  lies in face F + e
//!      - - - - - p(h) --along(h)---> q(h) - - -      across(h) = 4E + 2h, from p(h) to q(t),
//!                  |                   |                         in face F + e
//!          face    |        ↑          |   face      its twin  lies in the face of a
//!          of a  across(h)  h   across(t)  of b
//!                  |        |          |             next(along(h))        = along(next(h))
//!                  |   face F + e      |             next(along(h) twin)   = across(h)
//!                  |                   |             next(across(h))       = twin of along(t)
//!      - - - - - q(t) <--along(t)--- p(t) - - -      next(across(h) twin)  = twin of across of the twin
//!                  |         g         |                                     of prev(h)
//! ```
//!
//! (h itself runs from left to right, from a to b, in the middle of face F + e.)
//!
//! Let h be the outgoing boundary half-edge of a boundary vertex. The half-edge join(h), from p(h) to q(prev(h)),
//! closes the face that replaces the vertex. The twin of join(h) is on the boundary, between along(prev(h)) and
//! along(h). The edges of the half-edges join(h) come after all other edges, in order of h.
//!
//! Face f keeps its id, and edge e becomes face F + e (F is the number of old faces). The faces that replace vertices
//! have the highest ids, in the order of the old vertices. Isolated vertices do not become faces. They are kept, and
//! their ids come after the ids of all other vertices. An inner vertex of valence 2 also does not become a face,
//! because the face would have only two corners. The two outgoing half-edges h and k of an inner vertex of valence 2
//! share one new edge. If h has a lower id than k, the first half-edge of the shared edge is across(h), and across(k)
//! is the twin of across(h). So each inner vertex of valence 2 lowers the ids of all later edges by one.

use mesh::{Connectivity, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use crate::large_faces::LargeFaces;
use crate::links::{self, Link, Links};
use crate::subset::Subset;
use crate::topology::{Place, Topology, place_near_origin};

/// A mesh without deleted elements. Each field of the type [`Subset`] collects elements that need special treatment.
pub(crate) struct DooSabin<'a> {
    pub(crate) mesh: &'a Mesh,
    n_edges: usize,
    n_faces: usize,
    /// The half-edges without a face.
    outer: Subset,
    /// The isolated vertices.
    isolated: Subset,
    /// The vertices that do not become faces: isolated vertices and inner vertices of valence 2.
    faceless: Subset,
    /// For each inner vertex of valence 2, the outgoing half-edge with the higher id.
    doubled: Subset,
    pub(crate) large_faces: LargeFaces,
}

/// The old element to which a new vertex belongs.
pub(crate) enum Source {
    /// The corner at the origin of this half-edge.
    Corner(HalfEdgeId),
    /// A point near the origin of this half-edge, on a boundary edge.
    Near(HalfEdgeId),
    /// An isolated vertex.
    Isolated(VertexId),
}

impl<'a> DooSabin<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let isolated = |i| mesh.vertex_half_edge(VertexId::new(i)).is_none();
        let doubled = |i| {
            let h = HalfEdgeId::new(i);
            mesh.next(h.twin()) < h && is_inner_of_valence_2(mesh, mesh.origin(h))
        };
        Self {
            mesh,
            n_edges: mesh.n_edges(),
            n_faces: mesh.n_faces(),
            outer: Subset::of(mesh.n_half_edges(), |i| {
                mesh.face(HalfEdgeId::new(i)).is_none()
            }),
            isolated: Subset::of(mesh.n_vertices(), isolated),
            faceless: Subset::of(mesh.n_vertices(), |i| {
                isolated(i) || is_inner_of_valence_2(mesh, VertexId::new(i))
            }),
            doubled: Subset::of(mesh.n_half_edges(), doubled),
            large_faces: LargeFaces::of(mesh),
        }
    }

    /// Returns the old element to which new vertex `i` belongs.
    #[inline]
    pub(crate) fn source(&self, i: usize) -> Source {
        let (corners, ends) = (2 * self.n_edges, self.outer.len());
        if i < corners {
            let h = HalfEdgeId::new(i);
            if self.mesh.face(h).is_some() {
                Source::Corner(h)
            } else {
                Source::Near(h)
            }
        } else if i < corners + ends {
            // A boundary edge has one new point near each end. So for a boundary half-edge, the point near its target
            // is the point near the origin of its twin.
            Source::Near(HalfEdgeId::new(self.outer.nth(i - corners)).twin())
        } else {
            Source::Isolated(VertexId::new(self.isolated.nth(i - corners - ends)))
        }
    }

    /// Returns q(h): the new vertex beside `h`, near its target.
    #[inline]
    fn q(&self, h: HalfEdgeId) -> VertexId {
        if self.mesh.face(h).is_some() {
            p(self.mesh.next(h))
        } else {
            VertexId::new(2 * self.n_edges + self.outer.below(h.index()))
        }
    }

    #[inline]
    fn across(&self, h: HalfEdgeId) -> HalfEdgeId {
        if self.doubled.contains(h.index()) {
            return self.across(self.mesh.next(h.twin())).twin();
        }
        HalfEdgeId::new(4 * self.n_edges + 2 * self.doubled.rank_outside(h.index()))
    }

    #[inline]
    fn join(&self, h: HalfEdgeId) -> HalfEdgeId {
        HalfEdgeId::new(2 * (self.first_join() + self.outer.below(h.index())))
    }

    /// The new edges that close the faces at boundary vertices (the edges of the half-edges join(h)) have the highest
    /// ids. Returns the lowest of these ids.
    fn first_join(&self) -> usize {
        4 * self.n_edges - self.doubled.len()
    }

    #[inline]
    fn edge_face(&self, h: HalfEdgeId) -> FaceId {
        FaceId::new(self.n_faces + h.edge().index())
    }

    #[inline]
    fn vertex_face(&self, v: VertexId) -> FaceId {
        FaceId::new(self.n_faces + self.n_edges + self.faceless.rank_outside(v.index()))
    }

    /// Returns the twin of across(k), where k is the half-edge after `h` counter-clockwise around the origin of `h`.
    #[inline]
    fn after(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.across(self.mesh.prev(h).twin()).twin()
    }

    #[inline]
    fn edge_along(&self, h: HalfEdgeId) -> [Link; 2] {
        let next = self.mesh.next(h);
        let (next, face) = match self.mesh.face(h) {
            Some(f) => (along(next), f),
            None => (self.join(next).twin(), FaceId::NONE),
        };
        let twin = Link(self.q(h), self.across(h), self.edge_face(h));
        [Link(p(h), next, face), twin]
    }

    #[inline]
    fn edge_across(&self, h: HalfEdgeId) -> [Link; 2] {
        let mesh = self.mesh;
        let half = Link(p(h), along(h.twin()).twin(), self.edge_face(h));
        let k = mesh.next(h.twin());
        let (next, face) = if self.doubled.contains(k.index()) {
            (along(k.twin()).twin(), self.edge_face(k))
        } else if mesh.face(h).is_some() {
            (self.after(h), self.vertex_face(mesh.origin(h)))
        } else {
            (self.join(h), self.vertex_face(mesh.origin(h)))
        };
        [half, Link(self.q(h.twin()), next, face)]
    }

    #[inline]
    fn edge_join(&self, h: HalfEdgeId) -> [Link; 2] {
        let face = self.vertex_face(self.mesh.origin(h));
        [
            Link(p(h), self.after(h), face),
            Link(self.q(self.mesh.prev(h)), along(h), FaceId::NONE),
        ]
    }
}

/// Returns p(h): the new vertex beside `h`, near its origin.
#[inline]
fn p(h: HalfEdgeId) -> VertexId {
    VertexId::new(h.index())
}

#[inline]
fn along(h: HalfEdgeId) -> HalfEdgeId {
    HalfEdgeId::new(2 * h.index())
}

impl Links for DooSabin<'_> {
    fn counts(&self) -> [usize; 3] {
        [
            2 * self.n_edges + self.outer.len() + self.isolated.len(),
            self.first_join() + self.outer.len(),
            self.n_faces + self.n_edges + self.mesh.n_vertices() - self.faceless.len(),
        ]
    }

    #[inline]
    fn edge(&self, i: usize) -> [Link; 2] {
        if i < 2 * self.n_edges {
            self.edge_along(HalfEdgeId::new(i))
        } else if i < self.first_join() {
            self.edge_across(HalfEdgeId::new(
                self.doubled.nth_outside(i - 2 * self.n_edges),
            ))
        } else {
            self.edge_join(HalfEdgeId::new(self.outer.nth(i - self.first_join())))
        }
    }

    #[inline]
    fn vertex(&self, i: usize) -> HalfEdgeId {
        let corners = 2 * self.n_edges;
        if i < corners {
            along(HalfEdgeId::new(i))
        } else if i < corners + self.outer.len() {
            let h = HalfEdgeId::new(self.outer.nth(i - corners));
            self.join(self.mesh.next(h)).twin()
        } else {
            HalfEdgeId::NONE
        }
    }

    fn face(&self, i: usize) -> HalfEdgeId {
        let Some(i) = i.checked_sub(self.n_faces) else {
            return along(self.mesh.face_half_edge(FaceId::new(i)));
        };
        let Some(i) = i.checked_sub(self.n_edges) else {
            return along(EdgeId::new(i).half_edge()).twin();
        };
        let v = VertexId::new(self.faceless.nth_outside(i));
        let h = self.mesh.vertex_half_edge(v);
        self.across(h.expect("a vertex with a face has an edge"))
            .twin()
    }
}

impl Topology for DooSabin<'_> {
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, Cancelled> {
        links::connectivity(self, meter)
    }

    fn corner(&self, finer: &Connectivity, i: usize) -> Place {
        match self.source(finer.origin[i].index()) {
            _ if finer.face[i] == FaceId::NONE => Place::Outside,
            Source::Corner(h) => Place::DooSabin(h),
            Source::Near(h) => place_near_origin(self.mesh, h, 4),
            Source::Isolated(_) => Place::Outside,
        }
    }

    fn vertex(&self, i: usize) -> Option<usize> {
        match self.source(i) {
            Source::Isolated(v) => Some(v.index()),
            _ => None,
        }
    }

    fn edge(&self, i: usize) -> Option<usize> {
        (i < 2 * self.n_edges).then_some(i / 2)
    }

    fn face(&self, i: usize) -> Option<usize> {
        let Some(i) = i.checked_sub(self.n_faces) else {
            return Some(i);
        };
        let face = match i.checked_sub(self.n_edges) {
            None => {
                let [left, right] = self.mesh.edge_faces(EdgeId::new(i));
                left.or(right)
            }
            Some(i) => {
                let v = VertexId::new(self.faceless.nth_outside(i));
                self.mesh.vertex_faces(v).next()
            }
        };
        face.map(FaceId::index)
    }
}

/// Whether `v` is an inner vertex of valence 2.
pub(crate) fn is_inner_of_valence_2(mesh: &Mesh, v: VertexId) -> bool {
    mesh.vertex_half_edge(v).is_some_and(|h| {
        let k = mesh.next(h.twin());
        mesh.face(h).is_some() && mesh.next(k.twin()) == h
    })
}
