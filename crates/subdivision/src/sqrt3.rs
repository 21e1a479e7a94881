//! The connectivity of Sqrt3 subdivision: every triangle is split into three, then the old edges are flipped.
//!
//! The old mesh has V vertices, E edges and F faces. Half-edge h runs from a to b and has face f, whose third corner is
//! c. The twin t of h has face g. Every face gets the vertex V + f at its center and three spokes, the edges from its
//! corners to the center. Every inner edge is flipped, so that it connects two centers. Edges keep their ids. The spoke
//! of the k-th corner of face f is edge E + 3f + k. If the corner is at the origin of h, spoke(h) is the half-edge that
//! runs along this spoke from the corner to the center. T(h), the k-th triangle of face f, is 3f + k:
//!
//! ```text
//!              c                           c
//!            /   \                       / | \           h keeps its id and lies in T(h); it runs
//!          /   f   \                   /   m   \         from the center of g to m, the center of f
//!        /           \               /   / | \   \
//!      a ----- h ----> b    --->    a -----|----- b      next(h)              = twin of spoke(h)
//!        \           /               \ T(h)h T(t)/       next(spoke(h) twin)  = spoke(next(t))
//!          \   g   /                   \ \ | / /         next(spoke(h))       = twin of prev(h)
//!            \   /                       \ | /
//! ```
//!
//! At a boundary, even and odd levels differ; levels are counted from 0. On even levels, boundary edges do not change.
//! On odd levels, the mesh is the result of an even level, so each triangle at the boundary has exactly one boundary
//! edge. The triangle gets two vertices on its boundary edge instead of a center: x is V + f, and y is V + F + r. Here
//! r is the number of boundary half-edges that come before the boundary half-edge of that edge:
//!
//! ```text
//!          c                  c                 T(h) is (a, b, m), next(h) = spoke(next(h)),
//!        / | \              / | | \             next(spoke(next(h))) = twin of spoke(h),
//!      /   m   \          /   |  |  \           next(spoke(h) twin)  = h
//!    /   /   \   \       /   |    |   \
//!   a ----- h ----> b   a -- x -h-> y -- b      T(h) is (x, y, c); a x and y b are the spokes of a and b,
//!                                               c x is the spoke of c, and c y is edge E + 3F + rank
//!      even level          odd level
//! ```
//!
//! The two edges of the triangle that are not on the boundary are flipped. Because the triangle has no center, each
//! flipped edge ends at x or at y, whichever is nearer. After two levels, every old edge, including every boundary
//! edge, has become three edges. Source: Kobbelt, "√3-Subdivision", 2000.

use mesh::{Connectivity, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use crate::links::{self, Link, Links};
use crate::subset::Subset;
use crate::topology::{Place, Topology, place_near_origin};
use crate::triangles::rank;

/// A mesh of triangles without deleted elements. Each triangle becomes three.
pub(crate) struct Sqrt3<'a> {
    pub(crate) mesh: &'a Mesh,
    n_vertices: usize,
    n_edges: usize,
    n_faces: usize,
    /// On odd levels, the half-edges without a face, whose edges are cut in three; `None` on even levels.
    cut: Option<Subset>,
}

/// The old element to which a new vertex belongs.
pub(crate) enum Source {
    /// An old vertex.
    Old(VertexId),
    /// The center of a face.
    Center(FaceId),
    /// A point on this half-edge of a boundary edge, at a third of the way from its origin.
    Near(HalfEdgeId),
}

/// How this level changes an old edge.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    /// The edge is flipped.
    Flipped,
    /// The edge is on the boundary and stays unchanged.
    Kept,
    /// The edge is on the boundary and is cut in three.
    Cut,
}

impl<'a> Sqrt3<'a> {
    /// Prepares level `level`, counted from 0. For an odd level, the mesh must be the result of an even
    /// level.
    pub(crate) fn new(mesh: &'a Mesh, level: u32) -> Self {
        let is_outer = |i| mesh.face(HalfEdgeId::new(i)).is_none();
        let is_even = level.is_multiple_of(2);
        Self {
            mesh,
            n_vertices: mesh.n_vertices(),
            n_edges: mesh.n_edges(),
            n_faces: mesh.n_faces(),
            cut: (!is_even).then(|| Subset::of(mesh.n_half_edges(), is_outer)),
        }
    }

    /// Whether this level cuts boundary edges.
    pub(crate) fn cuts_boundary(&self) -> bool {
        self.cut.is_some()
    }

    /// Returns the old element to which new vertex `i` belongs.
    #[inline]
    pub(crate) fn source(&self, i: usize) -> Source {
        let Some(f) = i.checked_sub(self.n_vertices) else {
            return Source::Old(VertexId::new(i));
        };
        match &self.cut {
            Some(cut) if f >= self.n_faces => {
                Source::Near(HalfEdgeId::new(cut.nth(f - self.n_faces)))
            }
            Some(_) => {
                let mut halves = self.mesh.face_half_edges(FaceId::new(f));
                match halves.find(|&h| self.side(h) == Side::Cut) {
                    Some(h) => Source::Near(h),
                    None => Source::Center(FaceId::new(f)),
                }
            }
            None => Source::Center(FaceId::new(f)),
        }
    }

    /// Returns how this level changes the edge of `h`. `h` must have a face.
    #[inline]
    fn side(&self, h: HalfEdgeId) -> Side {
        if self.mesh.face(h.twin()).is_some() {
            Side::Flipped
        } else if self.cuts_boundary() {
            Side::Cut
        } else {
            Side::Kept
        }
    }

    /// Returns the half-edge before `h` in its triangle.
    #[inline]
    fn prev(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.mesh.next(self.mesh.next(h))
    }

    #[inline]
    fn face_of(&self, h: HalfEdgeId) -> FaceId {
        self.mesh.connectivity().face[h.index()]
    }

    /// Returns 3f + k, where `h` is the k-th half-edge of face f.
    #[inline]
    fn corner_number(&self, h: HalfEdgeId) -> usize {
        let f = self.face_of(h);
        3 * f.index() + rank(self.mesh, h, f)
    }

    /// Returns the half-edge with the given [`corner_number`](Self::corner_number).
    #[inline]
    fn of_corner(&self, i: usize) -> HalfEdgeId {
        let start = self.mesh.face_half_edge(FaceId::new(i / 3));
        (0..i % 3).fold(start, |h, _| self.mesh.next(h))
    }

    /// Returns the new face T(h).
    #[inline]
    fn triangle(&self, h: HalfEdgeId) -> FaceId {
        FaceId::new(self.corner_number(h))
    }

    #[inline]
    fn spoke(&self, h: HalfEdgeId) -> HalfEdgeId {
        HalfEdgeId::new(2 * (self.n_edges + self.corner_number(h)))
    }

    /// Returns how many of the cut edges have a lower id than the edge of `h`. `h` must have a face.
    #[inline]
    fn rank(&self, h: HalfEdgeId) -> usize {
        let cut = self.cut.as_ref();
        cut.map_or(0, |cut| cut.below(h.twin().index()))
    }

    /// Returns the half-edge from c to y. The level must cut the edge of `h`.
    #[inline]
    fn second_spoke(&self, h: HalfEdgeId) -> HalfEdgeId {
        HalfEdgeId::new(2 * (self.n_edges + 3 * self.n_faces + self.rank(h)))
    }

    /// Returns the new vertex at the end of the spoke of `h`: the center of the face of `h`, or the vertex that
    /// replaces the center.
    #[inline]
    fn end(&self, h: HalfEdgeId) -> VertexId {
        let before = self.prev(h);
        let i = match self.side(before) {
            Side::Cut => self.n_faces + self.rank(before),
            _ => self.face_of(h).index(),
        };
        VertexId::new(self.n_vertices + i)
    }

    /// Returns the half-edge from the target of `h` to `end(h)`. The level must flip the edge of `h`.
    #[inline]
    fn spoke_at_target(&self, h: HalfEdgeId) -> HalfEdgeId {
        let before = self.prev(h);
        match self.side(before) {
            Side::Cut => self.second_spoke(before),
            _ => self.spoke(self.mesh.next(h)),
        }
    }

    /// A new half-edge gets the id of old half-edge `h`. Returns the origin, the next half-edge and the face of this
    /// new half-edge.
    #[inline]
    fn kept_half_edge(&self, h: HalfEdgeId) -> Link {
        let mesh = self.mesh;
        if mesh.face(h).is_none() {
            let inner = h.twin();
            let (origin, next) = match self.side(inner) {
                // In the figure for odd levels, this half-edge runs from y to x, and the next one runs from x to a.
                Side::Cut => (self.end(mesh.next(inner)), self.spoke(inner).twin()),
                _ => (mesh.origin(h), mesh.next(h)),
            };
            return Link(origin, next, FaceId::NONE);
        }
        let (origin, next) = match self.side(h) {
            Side::Flipped => (self.end(h.twin()), self.spoke(h).twin()),
            Side::Kept => (mesh.origin(h), self.spoke(mesh.next(h))),
            Side::Cut => (self.end(h), self.second_spoke(h).twin()),
        };
        Link(origin, next, self.triangle(h))
    }

    /// Returns the origin, the next half-edge and the face of both half-edges of the spoke of `h`.
    #[inline]
    fn edge_spoke(&self, h: HalfEdgeId) -> [Link; 2] {
        let mesh = self.mesh;
        let (before, after) = (self.prev(h), mesh.next(h));
        let (next, face) = match (self.side(before), self.side(after)) {
            // In the figure for odd levels, this half-edge runs from b to y, along the boundary.
            (Side::Cut, _) => (before.twin(), FaceId::NONE),
            (Side::Kept, _) => (self.spoke(before).twin(), self.triangle(before)),
            // In the figure for odd levels, this half-edge runs from c to x.
            (Side::Flipped, Side::Cut) => (after, self.triangle(after)),
            (Side::Flipped, _) => (before.twin(), self.triangle(before.twin())),
        };
        let half = Link(mesh.origin(h), next, face);
        let (next, face) = match self.side(h) {
            Side::Flipped => (self.spoke_at_target(h.twin()), self.triangle(h)),
            Side::Kept => (h, self.triangle(h)),
            // In the figure for odd levels, this half-edge runs from x to a. The next half-edge continues along the
            // boundary.
            Side::Cut => {
                let following = mesh.next(h.twin()).twin();
                (self.spoke(mesh.next(following)), FaceId::NONE)
            }
        };
        [half, Link(self.end(h), next, face)]
    }

    /// Returns the origin, the next half-edge and the face of both half-edges of the edge from c to y. The level must
    /// cut the edge of `h`.
    #[inline]
    fn edge_second_spoke(&self, h: HalfEdgeId) -> [Link; 2] {
        let after = self.mesh.next(h);
        let last = self.mesh.next(after);
        let outside = after.twin();
        [
            Link(self.mesh.origin(last), outside, self.triangle(outside)),
            Link(self.end(after), self.spoke(last), self.triangle(h)),
        ]
    }

    /// Of the two half-edges of the `r`-th cut edge, returns the one that has a face.
    fn of_rank(&self, r: usize) -> HalfEdgeId {
        let cut = self.cut.as_ref().expect("only odd levels have ranks");
        HalfEdgeId::new(cut.nth(r)).twin()
    }
}

impl Links for Sqrt3<'_> {
    fn counts(&self) -> [usize; 3] {
        let cut = self.cut.as_ref().map_or(0, Subset::len);
        [
            self.n_vertices + self.n_faces + cut,
            self.n_edges + 3 * self.n_faces + cut,
            3 * self.n_faces,
        ]
    }

    #[inline]
    fn edge(&self, i: usize) -> [Link; 2] {
        let Some(i) = i.checked_sub(self.n_edges) else {
            return [2 * i, 2 * i + 1].map(|h| self.kept_half_edge(HalfEdgeId::new(h)));
        };
        match i.checked_sub(3 * self.n_faces) {
            None => self.edge_spoke(self.of_corner(i)),
            Some(r) => self.edge_second_spoke(self.of_rank(r)),
        }
    }

    #[inline]
    fn vertex(&self, i: usize) -> HalfEdgeId {
        let mesh = self.mesh;
        match self.source(i) {
            Source::Old(v) => match mesh.vertex_half_edge(v) {
                None => HalfEdgeId::NONE,
                Some(h) if mesh.face(h).is_some() => self.spoke(h),
                // The new boundary half-edge is a part of the old half-edge, or the old half-edge itself.
                Some(h) => match self.side(h.twin()) {
                    Side::Cut => self.spoke(mesh.next(h.twin())),
                    _ => h,
                },
            },
            Source::Center(f) => self.spoke(mesh.face_half_edge(f)).twin(),
            // In the figure for odd levels, the half-edge runs from x to a, or from y to x.
            Source::Near(h) if mesh.face(h).is_some() => self.spoke(h).twin(),
            Source::Near(h) => h,
        }
    }

    #[inline]
    fn face(&self, i: usize) -> HalfEdgeId {
        let h = self.of_corner(i);
        match self.side(h) {
            Side::Cut => h,
            _ => self.spoke(h).twin(),
        }
    }
}

impl Topology for Sqrt3<'_> {
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, Cancelled> {
        links::connectivity(self, meter)
    }

    /// Returns the place in the old mesh from which a corner takes its value. A triangle next to a flipped edge covers
    /// parts of two old faces. The corner of triangle 3f + k at an old vertex takes the value of the corner of face f
    /// at this vertex. At the center of an old face, a new triangle takes the value from this face.
    fn corner(&self, finer: &Connectivity, i: usize) -> Place {
        let mesh = self.mesh;
        let Some(face) = finer.face[i].some() else {
            return Place::Outside;
        };
        match self.source(finer.origin[i].index()) {
            Source::Old(v) => {
                let mut sides = mesh.face_half_edges(FaceId::new(face.index() / 3));
                let h = sides.find(|&h| mesh.origin(h) == v);
                Place::At(h.expect("triangle 3f + k has a corner of face f"))
            }
            Source::Center(f) => Place::In(f),
            Source::Near(h) => place_near_origin(mesh, h, 3),
        }
    }

    fn edge(&self, i: usize) -> Option<usize> {
        let mesh = self.mesh;
        let Some(spoke) = i.checked_sub(self.n_edges) else {
            return mesh.is_boundary_edge(mesh::EdgeId::new(i)).then_some(i);
        };
        if spoke >= 3 * self.n_faces {
            return None;
        }
        // If an edge is cut, the spokes of the corners at both of its ends are parts of the edge.
        let h = self.of_corner(spoke);
        let mut parents = [h, self.prev(h)].into_iter();
        let cut = parents.find(|&h| self.side(h) == Side::Cut);
        cut.map(|h| h.edge().index())
    }

    fn face(&self, i: usize) -> Option<usize> {
        Some(i / 3)
    }
}
