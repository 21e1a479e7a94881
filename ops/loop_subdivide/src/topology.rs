//! The connectivity of the next level, read off the old one.
//!
//! New edges and faces are numbered so that each new half-edge can be found without looking for it. An
//! old edge e with halves h = 2e, from a to b, and its twin becomes edges 2e and 2e + 1 around the new
//! vertex V + e:
//!
//! ```text
//!            first(h) = 4e            second(h) = 4e + 2
//!         -------------------->    -------------------->
//!       a                       V+e                      b
//!         <--------------------    <--------------------
//!        second(twin) = 4e + 1      first(twin) = 4e + 3
//!
//!      first(h) = 2h + (h & 1)       second(h) = first(h) ^ 2
//! ```
//!
//! Counted from its first half-edge, face f has the half-edges h0, h1, h2. The triangle at the origin of
//! hk becomes face 4f + k, the middle one face 4f + 3. The edge between the two is 2E + 3f + k; its first
//! half cuts the corner, the second lies in the middle:
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
//! An old vertex keeps the first part of its half-edge, which is on the boundary if that was. A new
//! vertex leaves along the second part of a half, the boundary one if there is one.
//!
//! So one task for each old edge writes four half-edges and a vertex, one for each old face six
//! half-edges and four faces, and none reads what another writes. The idea is that of Vanhoey and
//! Dupuy, "A Halfedge Refinement Rule for Parallel Loop Subdivision", 2022, for edges in pairs.

use mesh::{Connectivity, FaceId, HalfEdgeId, Mesh, VertexId};
use op::OpError;
use rayon::prelude::*;

use crate::meter::{BLOCK, Meter};

/// The connectivity of the next level of a dense mesh of triangles.
pub(crate) fn finer(mesh: &Mesh, meter: &Meter) -> Result<Connectivity, OpError> {
    let old = Old::new(mesh);
    let n_half_edges = 4 * old.n_edges + 6 * old.n_faces;
    let mut new = Connectivity {
        next: bytemuck::zeroed_vec(n_half_edges),
        origin: bytemuck::zeroed_vec(n_half_edges),
        face: bytemuck::zeroed_vec(n_half_edges),
        vertex_half_edge: bytemuck::zeroed_vec(old.n_vertices + old.n_edges),
        face_half_edge: bytemuck::zeroed_vec(4 * old.n_faces),
    };
    {
        let (next_on, next_in) = new.next.split_at_mut(4 * old.n_edges);
        let (origin_on, origin_in) = new.origin.split_at_mut(4 * old.n_edges);
        let (face_on, face_in) = new.face.split_at_mut(4 * old.n_edges);
        let (kept, leaving) = new.vertex_half_edge.split_at_mut(old.n_vertices);
        old.split_edges(next_on, origin_on, face_on, leaving, meter)?;
        old.cut_faces(next_in, origin_in, face_in, &mut new.face_half_edge, meter)?;
        old.keep_vertices(kept);
    }
    Ok(new)
}

/// The part of half-edge `h` that leaves its origin.
#[inline]
pub(crate) fn first(h: HalfEdgeId) -> HalfEdgeId {
    HalfEdgeId::new(2 * h.index() + (h.index() & 1))
}

/// The part of half-edge `h` that goes to its target.
#[inline]
pub(crate) fn second(h: HalfEdgeId) -> HalfEdgeId {
    HalfEdgeId::new(first(h).index() ^ 2)
}

/// The mesh that is refined.
struct Old<'a> {
    mesh: &'a Mesh,
    n_vertices: usize,
    n_edges: usize,
    n_faces: usize,
}

impl<'a> Old<'a> {
    fn new(mesh: &'a Mesh) -> Self {
        Self {
            mesh,
            n_vertices: mesh.n_vertices(),
            n_edges: mesh.n_edges(),
            n_faces: mesh.n_faces(),
        }
    }

    /// The half-edge that cuts corner `k` of face `f`.
    #[inline]
    fn cut(&self, f: FaceId, k: usize) -> HalfEdgeId {
        HalfEdgeId::new(4 * self.n_edges + 6 * f.index() + 2 * k)
    }

    /// The new vertex on the edge of `h`.
    #[inline]
    fn on_edge(&self, h: HalfEdgeId) -> VertexId {
        VertexId::new(self.n_vertices + h.edge().index())
    }

    /// Writes the halves of old edges, four for each, and the half-edges of the vertices on them.
    fn split_edges(
        &self,
        next: &mut [HalfEdgeId],
        origin: &mut [VertexId],
        face: &mut [FaceId],
        leaving: &mut [HalfEdgeId],
        meter: &Meter,
    ) -> Result<(), OpError> {
        (
            next.par_chunks_mut(4 * BLOCK),
            origin.par_chunks_mut(4 * BLOCK),
            face.par_chunks_mut(4 * BLOCK),
            leaving.par_chunks_mut(BLOCK),
        )
            .into_par_iter()
            .enumerate()
            .try_for_each(|(block, (next, origin, face, leaving))| {
                let next = next.as_chunks_mut::<4>().0.iter_mut();
                let origin = origin.as_chunks_mut::<4>().0.iter_mut();
                let face = face.as_chunks_mut::<4>().0.iter_mut();
                let n = leaving.len();
                let arrays = next.zip(origin).zip(face).zip(leaving);
                for (e, (((next, origin), face), leaving)) in (block * BLOCK..).zip(arrays) {
                    let h = HalfEdgeId::new(2 * e);
                    let ([h1, h2], [f1, f2]) = self.parts(h);
                    let ([t1, t2], [g1, g2]) = self.parts(h.twin());
                    let m = self.on_edge(h);
                    *next = [h1, t2, h2, t1];
                    *origin = [self.mesh.origin(h), m, m, self.mesh.origin(h.twin())];
                    *face = [f1, g2, f2, g1];
                    *leaving = second(if g2 == FaceId::NONE { h.twin() } else { h });
                }
                meter.add(n)
            })
    }

    /// What follows the first and the second part of `h`, and their faces.
    #[inline]
    fn parts(&self, h: HalfEdgeId) -> ([HalfEdgeId; 2], [FaceId; 2]) {
        let next = self.mesh.next(h);
        let Some(f) = self.mesh.face(h) else {
            return ([second(h), first(next)], [FaceId::NONE; 2]);
        };
        let start = self.mesh.face_half_edge(f);
        let k = if h == start {
            0
        } else if next == start {
            2
        } else {
            1
        };
        let corner = |k: usize| FaceId::new(4 * f.index() + k);
        let after_k = if k == 2 { 0 } else { k + 1 };
        ([self.cut(f, k), first(next)], [corner(k), corner(after_k)])
    }

    /// Writes the edges inside old faces, six half-edges for each face, and the new faces.
    fn cut_faces(
        &self,
        next: &mut [HalfEdgeId],
        origin: &mut [VertexId],
        face: &mut [FaceId],
        face_half_edge: &mut [HalfEdgeId],
        meter: &Meter,
    ) -> Result<(), OpError> {
        (
            next.par_chunks_mut(6 * BLOCK),
            origin.par_chunks_mut(6 * BLOCK),
            face.par_chunks_mut(6 * BLOCK),
            face_half_edge.par_chunks_mut(4 * BLOCK),
        )
            .into_par_iter()
            .enumerate()
            .try_for_each(|(block, (next, origin, face, starts))| {
                let next = next.as_chunks_mut::<6>().0.iter_mut();
                let origin = origin.as_chunks_mut::<6>().0.iter_mut();
                let face = face.as_chunks_mut::<6>().0.iter_mut();
                let starts = starts.as_chunks_mut::<4>().0;
                let n = starts.len();
                let arrays = next.zip(origin).zip(face).zip(starts);
                for (f, (((next, origin), face), starts)) in (block * BLOCK..).zip(arrays) {
                    let f = FaceId::new(f);
                    let h0 = self.mesh.face_half_edge(f);
                    let h1 = self.mesh.next(h0);
                    let h2 = self.mesh.next(h1);
                    let [x0, x1, x2] = [h0, h1, h2].map(|h| self.on_edge(h));
                    let [c0, c1, c2] = [0, 1, 2].map(|k| self.cut(f, k));
                    let [f0, f1, f2, f3] = [0, 1, 2, 3].map(|k| FaceId::new(4 * f.index() + k));
                    *next = [
                        second(h2),
                        c1.twin(),
                        second(h0),
                        c2.twin(),
                        second(h1),
                        c0.twin(),
                    ];
                    *origin = [x0, x2, x1, x0, x2, x1];
                    *face = [f0, f3, f1, f3, f2, f3];
                    *starts = [first(h0), first(h1), first(h2), c0.twin()];
                }
                meter.add(n)
            })
    }

    /// Writes the half-edges of old vertices.
    fn keep_vertices(&self, kept: &mut [HalfEdgeId]) {
        let old = &self.mesh.connectivity().vertex_half_edge;
        kept.par_iter_mut()
            .with_min_len(BLOCK)
            .zip(old)
            .for_each(|(new, old)| *new = old.some().map_or(HalfEdgeId::NONE, first));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_four_parts_of_an_edge_are_its_four_half_edges() {
        let [h, twin] = mesh::EdgeId::new(5).half_edges();
        let parts = [first(h), second(twin), second(h), first(twin)];
        assert_eq!(parts.map(HalfEdgeId::index), [20, 21, 22, 23]);
        assert_eq!(first(h).twin(), second(twin));
        assert_eq!(second(h).twin(), first(twin));
    }
}
