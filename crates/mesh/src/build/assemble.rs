//! Computes the arrays of a mesh from the sides of polygons, after the two sides of each edge were paired.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::polygons::{NONE, Polygons, pieces, sums_before, to_id};
use crate::parallel::BLOCK;
use crate::{Connectivity, FaceId, HalfEdgeId, VertexId};

/// The edges, numbered in the order of their first sides.
pub(super) struct Edges {
    /// For each block of corners, the number of edges whose first side starts at a corner of the block.
    counts: Vec<usize>,
    pub(super) half_edge_of_corner: Vec<HalfEdgeId>,
}

/// Whether the side that starts at corner `c` is the first side of its edge.
#[inline]
fn is_first(c: usize, twin: &[u32]) -> bool {
    // The value `NONE` of a missing twin is greater than all corner indices.
    c < twin[c] as usize
}

/// Returns the corners of a block.
fn corners(block: usize, twin: &[u32]) -> std::ops::Range<usize> {
    block * BLOCK..twin.len().min((block + 1) * BLOCK)
}

impl Edges {
    pub(super) fn number(twin: &[u32]) -> Self {
        let blocks = (0..twin.len().div_ceil(BLOCK)).into_par_iter();
        let count = |block| corners(block, twin).filter(|&c| is_first(c, twin)).count();
        let counts: Vec<usize> = blocks.map(count).collect();
        // The loop visits the first side of each edge, and writes the entries of both sides of the edge.
        let half_edges: Vec<AtomicU32> = crate::zeroed(twin.len());
        let firsts = sums_before(&counts).into_par_iter().enumerate();
        firsts.for_each(|(block, first)| {
            let firsts = corners(block, twin).filter(|&c| is_first(c, twin));
            for (c, h) in firsts.zip((2 * to_id(first)..).step_by(2)) {
                half_edges[c].store(h, Relaxed);
                if twin[c] != NONE {
                    half_edges[twin[c] as usize].store(h + 1, Relaxed);
                }
            }
        });
        let half_edges = half_edges.into_iter();
        Self {
            counts,
            half_edge_of_corner: half_edges
                .map(|h| HalfEdgeId::new(h.into_inner() as usize))
                .collect(),
        }
    }

    /// Computes all arrays. `origins` contains the vertex of each corner.
    pub(super) fn arrays(
        &self,
        polygons: &Polygons,
        twin: &[u32],
        origins: &[u32],
        vertex_half_edge: Vec<HalfEdgeId>,
    ) -> Connectivity {
        let n = 2 * self.counts.iter().sum::<usize>();
        let mut next = crate::zeroed::<HalfEdgeId>(n);
        let mut origin = crate::zeroed::<VertexId>(n);
        let mut face = crate::zeroed::<FaceId>(n);
        let of = |c: u32| self.half_edge_of_corner[c as usize];
        let vertex = |c: u32| VertexId::new(origins[c as usize] as usize);
        let face_of = |c: u32| FaceId::new(polygons.face(c) as usize);
        let lengths = || self.counts.iter().map(|n| 2 * n);
        pieces(&mut next, lengths())
            .into_par_iter()
            .zip(pieces(&mut origin, lengths()))
            .zip(pieces(&mut face, lengths()))
            .enumerate()
            .for_each(|(block, ((next, origin), face))| {
                let edges = next
                    .chunks_mut(2)
                    .zip(origin.chunks_mut(2))
                    .zip(face.chunks_mut(2));
                let firsts = corners(block, twin).filter(|&c| is_first(c, twin));
                for (((next, origin), face), c) in edges.zip(firsts) {
                    let t = twin[c];
                    let c = to_id(c);
                    (next[0], origin[0], face[0]) = (of(polygons.next(c)), vertex(c), face_of(c));
                    (next[1], origin[1], face[1]) = if t == NONE {
                        // The boundary half-edge on the other side of the edge ends at v, the vertex of corner c. The
                        // boundary then continues along the boundary half-edge that starts at v.
                        let v = vertex(c).index();
                        (vertex_half_edge[v], vertex(polygons.next(c)), FaceId::NONE)
                    } else {
                        (of(polygons.next(t)), vertex(t), face_of(t))
                    };
                }
            });
        let offsets = polygons.offsets.par_iter().take(polygons.n());
        Connectivity {
            next,
            origin,
            face,
            face_half_edge: offsets.map(|&c| of(c)).collect(),
            vertex_half_edge,
        }
    }
}
