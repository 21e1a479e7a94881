//! Finds pairs of polygon sides: two sides form a pair if they run along the same edge in opposite directions.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::buckets::Buckets;
use super::polygons::{NONE, Polygons, to_id};
use super::star::{Outgoing, Star};
use crate::VertexId;
use crate::parallel::BLOCK;

/// The pairs of sides, and the vertices and edges at which the polygons are not a manifold.
pub(super) struct PairedSides {
    /// For each side, the other side of its edge, or `NONE` on the boundary.
    pub(super) twin: Vec<u32>,
    /// For each vertex, the outgoing half-edge that the mesh will store for the vertex.
    pub(super) outgoing: Vec<Outgoing>,
    /// The vertices whose faces form more than one fan, in ascending order. For a vertex with several fans, the entry
    /// of `outgoing` can belong to any of these fans.
    pub(super) pinched: Vec<u32>,
    /// The edges of more than two polygons, and the edges along which two polygons run in the same direction, ordered
    /// by the vertices of the edges.
    pub(super) non_manifold_edges: Vec<[VertexId; 2]>,
    /// Whether any edge belongs to exactly two polygons, whose sides run along it in the same direction.
    pub(super) has_inconsistent_edge: bool,
}

/// The non-manifold vertices and edges of a block of vertices.
#[derive(Default)]
struct Irregularities {
    pinched: Vec<u32>,
    edges: Vec<[VertexId; 2]>,
    has_inconsistent_edge: bool,
}

/// Pairs outgoing and incoming sides around each vertex. Each side is visited at both of its ends. The twin of a
/// side is stored when the origin of the side is visited.
pub(super) fn pair(polygons: &Polygons, buckets: &Buckets) -> PairedSides {
    let twin: Vec<AtomicU32> = crate::zeroed(polygons.corners.len());
    let mut outgoing: Vec<Outgoing> = crate::zeroed(buckets.n_vertices());
    let blocks = outgoing.par_chunks_mut(BLOCK).enumerate();
    let irregularities: Vec<Irregularities> = blocks
        .map_init(Star::default, |star, (block, outgoing)| {
            let mut irregularities = Irregularities::default();
            for (outgoing, v) in outgoing.iter_mut().zip(block * BLOCK..) {
                let corners = buckets.of(v);
                if corners.is_empty() {
                    *outgoing = Outgoing::NONE;
                    continue;
                }
                star.set(polygons, corners);
                for (&c, &after) in corners.iter().zip(&star.after) {
                    let other = star.before.get(after as usize).copied().unwrap_or(NONE);
                    twin[c as usize].store(other, Relaxed);
                }
                *outgoing = star.outgoing(corners);
                if star.has_non_manifold_edge {
                    irregularities.add_edges(to_id(v), &star.non_manifold_edges());
                }
                if !star.is_one_fan() {
                    irregularities.pinched.push(to_id(v));
                }
            }
            irregularities
        })
        .collect();
    let blocks = irregularities.iter();
    let mut non_manifold_edges: Vec<[VertexId; 2]> = blocks
        .clone()
        .flat_map(|block| block.edges.clone())
        .collect();
    // An edge can be listed twice, once by each of its ends, so duplicates are removed.
    non_manifold_edges.sort_unstable();
    non_manifold_edges.dedup();
    PairedSides {
        twin: twin.into_iter().map(AtomicU32::into_inner).collect(),
        outgoing,
        pinched: blocks
            .clone()
            .flat_map(|block| block.pinched.clone())
            .collect(),
        non_manifold_edges,
        has_inconsistent_edge: blocks.clone().any(|block| block.has_inconsistent_edge),
    }
}

impl Irregularities {
    /// Adds the non-manifold edges at `v`. `neighbors` is the result of [`Star::non_manifold_edges`].
    fn add_edges(&mut self, v: u32, neighbors: &[(u32, usize, usize)]) {
        for &(w, n_to, n_from) in neighbors {
            let edge = [v.min(w), v.max(w)];
            self.edges.push(edge.map(|v| VertexId::new(v as usize)));
            self.has_inconsistent_edge |= n_to.max(n_from) == 2 && n_to.min(n_from) == 0;
        }
    }
}
