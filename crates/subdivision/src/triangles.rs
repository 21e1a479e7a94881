//! The connectivity of the next subdivision level if every triangle is split into four.
//!
//! Edges are split in two as in [`halves`](crate::halves). The old mesh has V vertices and E edges. Face f has the
//! half-edges h0, h1, h2, counted from its first one. Face 4f + k is the triangle at the origin of hk, and face 4f + 3
//! is the middle triangle. The edge between the corner triangle at hk and the middle triangle is 2E + 3f + k. The first
//! half-edge of this edge, called cut k, belongs to the corner triangle, and the second half-edge to the middle
//! triangle:
//!
//! ```text
//!                  v2
//!                 /  \
//!      first(h2) /    \ second(h1)       h0 runs from v0 to v1, x0 = V + (edge of h0) lies on it
//!               / cut 2\
//!             x2 ------ x1               next(first(hk))    = cut k; on the boundary second(hk)
//!            /  \  3  /  \               next(second(hk))   = first(next(hk)), everywhere
//!           /    \   /    \              next(cut k)        = second(h(k-1))
//!          / cut 0\ / cut 1\             next(cut k's twin) = cut (k+1)'s twin
//!        v0 ------ x0 ------ v1
//!         first(h0)  second(h0)
//! ```
//!
//! For each old face, six new half-edges and four new faces are computed, from the old mesh only. So all old faces can
//! be processed in parallel.

use mesh::{Connectivity, FaceId, HalfEdgeId, Mesh};
use progress::{Cancelled, Meter};

use crate::halves::{AddedArrays, PartLinks, first, on_edge, place, second, split_edges};
use crate::links::{self, Entries};
use crate::topology::{Place, Topology};

/// A mesh of triangles without deleted elements. Each triangle is split into four.
pub(crate) struct Triangles<'a>(pub(crate) &'a Mesh);

impl Triangles<'_> {
    /// Returns cut k: the half-edge, on a new edge inside face `f`, that belongs to the triangle at corner `k`.
    #[inline]
    fn cut(&self, f: FaceId, k: usize) -> HalfEdgeId {
        HalfEdgeId::new(4 * self.0.n_edges() + 6 * f.index() + 2 * k)
    }

    #[inline]
    fn parts(&self, h: HalfEdgeId) -> PartLinks {
        let next = self.0.next(h);
        let Some(f) = self.0.face(h) else {
            return ([second(h), first(next)], [FaceId::NONE; 2]);
        };
        let k = rank(self.0, h, f);
        let corner = |k: usize| FaceId::new(4 * f.index() + k);
        let after_k = if k == 2 { 0 } else { k + 1 };
        ([self.cut(f, k), first(next)], [corner(k), corner(after_k)])
    }

    /// Returns the array entries that replace an old face: the six half-edges inside it, and the first half-edges of
    /// its four new faces.
    #[inline]
    fn cut_face(&self, f: FaceId) -> Entries<6, 4> {
        let h0 = self.0.face_half_edge(f);
        let h1 = self.0.next(h0);
        let h2 = self.0.next(h1);
        let [x0, x1, x2] = [h0, h1, h2].map(|h| on_edge(self.0, h));
        let [c0, c1, c2] = [0, 1, 2].map(|k| self.cut(f, k));
        let [f0, f1, f2, f3] = [0, 1, 2, 3].map(|k| FaceId::new(4 * f.index() + k));
        Entries {
            next: [
                second(h2),
                c1.twin(),
                second(h0),
                c2.twin(),
                second(h1),
                c0.twin(),
            ],
            origin: [x0, x2, x1, x0, x2, x1],
            face: [f0, f3, f1, f3, f2, f3],
            first: [first(h0), first(h1), first(h2), c0.twin()],
        }
    }
}

/// Returns the rank of `h` among the half-edges of triangle `f`: 0, 1 or 2.
#[inline]
pub(crate) fn rank(mesh: &Mesh, h: HalfEdgeId, f: FaceId) -> usize {
    let start = mesh.face_half_edge(f);
    if h == start {
        0
    } else if mesh.next(h) == start {
        2
    } else {
        1
    }
}

impl Topology for Triangles<'_> {
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, Cancelled> {
        let n_faces = self.0.n_faces();
        let added = [0, 3 * n_faces, 4 * n_faces];
        let fill_added = |arrays: AddedArrays| {
            let entries = |f| self.cut_face(FaceId::new(f));
            links::write(arrays.halves, arrays.face_half_edge, meter, entries)
        };
        split_edges(self.0, added, |h| self.parts(h), fill_added, meter)
    }

    fn corner(&self, _: &Connectivity, i: usize) -> Place {
        let n_halves = 4 * self.0.n_edges();
        if i < n_halves {
            return place(self.0, i);
        }
        // Cut k, a new edge inside the triangle, runs from the middle of half-edge k to the middle of half-edge k - 1.
        let (f, i) = ((i - n_halves) / 6, (i - n_halves) % 6);
        let start = self.0.face_half_edge(FaceId::new(f));
        let k = (i / 2 + if i % 2 == 0 { 0 } else { 2 }) % 3;
        Place::On((0..k).fold(start, |h, _| self.0.next(h)))
    }

    fn edge(&self, i: usize) -> Option<usize> {
        (i < 2 * self.0.n_edges()).then_some(i / 2)
    }

    fn face(&self, i: usize) -> Option<usize> {
        Some(i / 4)
    }
}
