//! Pairing the sides of polygons: each with the one that runs the other way along the same edge.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::buckets::Buckets;
use super::polygons::{NONE, Polygons, to_id};
use super::star::Star;
use crate::blocks::BLOCK;
use crate::{HalfEdgeId, VertexId};

/// How the polygons hang together.
pub(super) struct Paired {
    /// For each side the other side of its edge, or `NONE` on the boundary.
    pub(super) twin: Vec<u32>,
    /// For each vertex where to leave it.
    pub(super) leaving: Vec<Leaving>,
    /// The vertices that have more than one fan, in order. Their `leaving` is that of any fan.
    pub(super) pinched: Vec<u32>,
    /// The edges with more than two sides, or with two that run the same way, in order of vertices.
    pub(super) crowded: Vec<[VertexId; 2]>,
    /// Whether some edge has exactly two sides and they run the same way.
    pub(super) has_turned: bool,
}

/// How to leave a vertex: along the side of a corner, along the boundary on the other side of such a
/// side, or not at all. Two numbers in one: twice the corner, and one more for the boundary.
#[derive(Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub(super) struct Leaving(u32);

impl Leaving {
    const NOWHERE: Self = Self(NONE);

    /// Along the side of corner `c`.
    pub(super) fn along(c: u32) -> Self {
        Self(2 * c)
    }

    /// Along the boundary that is the other side of corner `c`.
    pub(super) fn across(c: u32) -> Self {
        Self(2 * c + 1)
    }

    /// The half-edge, given that of each corner.
    #[inline]
    pub(super) fn half_edge(self, half_edge_of_corner: &[HalfEdgeId]) -> HalfEdgeId {
        if self == Self::NOWHERE {
            return HalfEdgeId::NONE;
        }
        let along = half_edge_of_corner[(self.0 / 2) as usize];
        if self.0.is_multiple_of(2) {
            along
        } else {
            along.twin()
        }
    }
}

/// What is not as in a manifold, in a block of vertices.
#[derive(Default)]
struct Odd {
    pinched: Vec<u32>,
    crowded: Vec<[VertexId; 2]>,
    has_turned: bool,
}

/// Pairs the sides: around each vertex those that leave with those that come. So each side is looked
/// at twice, at both of its ends, and its twin is written where it leaves.
pub(super) fn pair(polygons: &Polygons, buckets: &Buckets) -> Paired {
    let twin: Vec<AtomicU32> = crate::zeroed(polygons.corners.len());
    let mut leaving: Vec<Leaving> = crate::zeroed(buckets.n_vertices());
    let blocks = leaving.par_chunks_mut(BLOCK).enumerate();
    let odd: Vec<Odd> = blocks
        .map_init(Star::default, |star, (block, leaving)| {
            let mut odd = Odd::default();
            for (leaving, v) in leaving.iter_mut().zip(block * BLOCK..) {
                let corners = buckets.of(v);
                if corners.is_empty() {
                    *leaving = Leaving::NOWHERE;
                    continue;
                }
                star.look(polygons, corners);
                for (&c, &after) in corners.iter().zip(&star.after) {
                    let other = star.before.get(after as usize).copied().unwrap_or(NONE);
                    twin[c as usize].store(other, Relaxed);
                }
                *leaving = star.leaving(corners);
                if star.is_crowded {
                    odd.add_crowded(to_id(v), &star.crowded());
                }
                if !star.is_one_fan() {
                    odd.pinched.push(to_id(v));
                }
            }
            odd
        })
        .collect();
    let mut crowded: Vec<[VertexId; 2]> = odd.iter().flat_map(|odd| odd.crowded.clone()).collect();
    // Most are seen from both ends.
    crowded.sort_unstable();
    crowded.dedup();
    Paired {
        twin: twin.into_iter().map(AtomicU32::into_inner).collect(),
        leaving,
        pinched: odd.iter().flat_map(|odd| odd.pinched.clone()).collect(),
        crowded,
        has_turned: odd.iter().any(|odd| odd.has_turned),
    }
}

impl Odd {
    fn add_crowded(&mut self, v: u32, neighbors: &[(u32, usize, usize)]) {
        for &(w, leaving, coming) in neighbors {
            let edge = [v.min(w), v.max(w)];
            self.crowded.push(edge.map(|v| VertexId::new(v as usize)));
            self.has_turned |= leaving.max(coming) == 2 && leaving.min(coming) == 0;
        }
    }
}
