//! The connectivity of the next subdivision level if every face with n corners is split into n quads.
//!
//! The old mesh has V vertices, E edges and F faces. Corner indices increase face by face, and c(h) is the index of the
//! corner at the origin of half-edge h. Edges are split in two as in [`halves`](crate::halves). Each part of a face is
//! the quad at one corner. Between two of these quads, an edge called a spoke runs from the middle of an old edge to
//! the center:
//!
//! ```text
//!     . <------------ .
//!     |               |             quad at corner c(h)      = face c(h)
//!     |       |       |             spoke of h               = edge 2E + c(h)
//!     |       |       |               its first half out(h)  runs from x to the center m, in face c(h)
//!     | - - - m - - - |
//!     |       ↑       |             next(first(h))    = out(h); on the boundary second(h)
//!     |  c(h) | out(h)|             next(second(h))   = first(next(h)), everywhere
//!     |       |       |             next(out(h))      = twin of out(prev(h))
//!     a ----> x ----> b             next(out(h) twin) = second(h)
//!     first(h)  second(h)
//! ```
//!
//! The vertex on edge e is V + e, and the center of face f is V + E + f. Each vertex stores one outgoing half-edge. Old
//! vertices and vertices on edges store the same half-edges as in `halves`. The center of a face stores the twin of
//! out(h), where h is the first half-edge of the face.
//!
//! In a mesh of quads, the corners of face f are 4f to 4f + 3. The corner of a half-edge then follows from its position
//! in the face. In other meshes, the corner indices are computed in advance. Only the first level can need these
//! indices computed in advance, because afterwards all faces are quads. The idea is from Dupuy and Vanhoey, "A Halfedge
//! Refinement Rule for Parallel Catmull-Clark Subdivision", 2021, adapted to half-edges stored in pairs.

use mesh::{Connectivity, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use crate::halves::{AddedArrays, PartLinks, first, on_edge, place, second, split_edges};
use crate::links::{self, Entries};
use crate::parallel::{any, fill_uncounted};
use crate::topology::{Place, Topology};

/// A mesh without deleted elements. Its faces will be split into quads.
pub(crate) struct Quads<'a> {
    mesh: &'a Mesh,
    n_vertices: usize,
    n_edges: usize,
    n_faces: usize,
    n_corners: usize,
    /// The corner indices, if not all faces are quads.
    table: Option<CornerTable>,
}

/// The correspondence between corners and half-edges.
struct CornerTable {
    /// The corner of each half-edge; 0 for half-edges without a face.
    corner: Vec<u32>,
    /// The half-edge of each corner.
    half_edge: Vec<HalfEdgeId>,
}

impl<'a> Quads<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let n_faces = mesh.n_faces();
        let is_not_quad = |f: usize| {
            let h = mesh.face_half_edge(FaceId::new(f));
            let opposite = mesh.next(mesh.next(h));
            opposite == h || mesh.next(mesh.next(opposite)) != h
        };
        let table = any(n_faces, is_not_quad).then(|| CornerTable::of(mesh));
        Self {
            mesh,
            n_vertices: mesh.n_vertices(),
            n_edges: mesh.n_edges(),
            n_faces,
            n_corners: table.as_ref().map_or(4 * n_faces, |l| l.half_edge.len()),
            table,
        }
    }

    /// Returns the indices of the corners before, at and after the origin of half-edge `h` of face `f`.
    #[inline]
    fn corners(&self, h: HalfEdgeId, f: FaceId) -> [usize; 3] {
        if let Some(table) = &self.table {
            let corner = |h: HalfEdgeId| table.corner[h.index()] as usize;
            return [
                corner(self.mesh.prev(h)),
                corner(h),
                corner(self.mesh.next(h)),
            ];
        }
        let start = self.mesh.face_half_edge(f);
        let k = if h == start {
            0
        } else if self.mesh.next(start) == h {
            1
        } else if self.mesh.next(h) == start {
            3
        } else {
            2
        };
        [k + 3, k, k + 1].map(|k| 4 * f.index() + k % 4)
    }

    /// Returns the half-edge and the face of corner `c`.
    #[inline]
    fn half_edge_of_corner(&self, c: usize) -> (HalfEdgeId, FaceId) {
        if let Some(table) = &self.table {
            let h = table.half_edge[c];
            return (h, self.mesh.connectivity().face[h.index()]);
        }
        let f = FaceId::new(c / 4);
        let start = self.mesh.face_half_edge(f);
        ((0..c % 4).fold(start, |h, _| self.mesh.next(h)), f)
    }

    /// Of the two half-edges of the spoke of corner `c`, returns the one that ends at the center.
    #[inline]
    fn out(&self, c: usize) -> HalfEdgeId {
        HalfEdgeId::new(4 * self.n_edges + 2 * c)
    }

    #[inline]
    fn parts(&self, h: HalfEdgeId) -> PartLinks {
        let after = first(self.mesh.next(h));
        let Some(f) = self.mesh.face(h) else {
            return ([second(h), after], [FaceId::NONE; 2]);
        };
        let [_, c, next] = self.corners(h, f);
        ([self.out(c), after], [FaceId::new(c), FaceId::new(next)])
    }

    /// Returns the array entries that corner `c` adds to the new mesh: the two half-edges of its spoke, and the
    /// half-edge of its face.
    #[inline]
    fn spoke(&self, c: usize) -> Entries<2, 1> {
        let (h, f) = self.half_edge_of_corner(c);
        let [before, _, after] = self.corners(h, f);
        let center = VertexId::new(self.n_vertices + self.n_edges + f.index());
        Entries {
            next: [self.out(before).twin(), second(h)],
            origin: [on_edge(self.mesh, h), center],
            face: [FaceId::new(c), FaceId::new(after)],
            first: [first(h)],
        }
    }

    /// Returns the half-edge that the vertex at the center of face `f` stores.
    #[inline]
    fn leaving_center(&self, f: FaceId) -> HalfEdgeId {
        let [_, c, _] = self.corners(self.mesh.face_half_edge(f), f);
        self.out(c).twin()
    }
}

impl CornerTable {
    fn of(mesh: &Mesh) -> Self {
        let mut corner = vec![0; mesh.n_half_edges()];
        let mut half_edge = Vec::with_capacity(mesh.n_half_edges());
        for f in mesh.faces() {
            for h in mesh.face_half_edges(f) {
                corner[h.index()] = u32::try_from(half_edge.len())
                    .expect("there are at most as many corners as half-edges");
                half_edge.push(h);
            }
        }
        Self { corner, half_edge }
    }
}

impl Topology for Quads<'_> {
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, Cancelled> {
        let added = [self.n_faces, self.n_corners, self.n_corners];
        let fill_added = |arrays: AddedArrays| {
            let spoke = |c| self.spoke(c);
            links::write(arrays.halves, arrays.face_half_edge, meter, spoke)?;
            let leaving = |f| self.leaving_center(FaceId::new(f));
            fill_uncounted(arrays.vertex_half_edge, meter, leaving)
        };
        split_edges(self.mesh, added, |h| self.parts(h), fill_added, meter)
    }

    fn corner(&self, _: &Connectivity, i: usize) -> Place {
        let n_halves = 4 * self.n_edges;
        if i < n_halves {
            return place(self.mesh, i);
        }
        let (h, f) = self.half_edge_of_corner((i - n_halves) / 2);
        if i.is_multiple_of(2) {
            Place::On(h)
        } else {
            Place::In(f)
        }
    }

    fn edge(&self, i: usize) -> Option<usize> {
        (i < 2 * self.n_edges).then_some(i / 2)
    }

    fn face(&self, i: usize) -> Option<usize> {
        Some(self.half_edge_of_corner(i).1.index())
    }
}
