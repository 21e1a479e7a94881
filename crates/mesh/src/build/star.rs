//! The corners around one vertex, and their cyclic order.
//!
//! ```text
//!         from           Corner i is the corner of polygon f at v. Its side runs from v to `to[i]`, and
//!        /               the side of the corner before it runs from `from[i]` to v. Clockwise around v,
//!      /    f            corner i is followed by the corner j with `from[j] == to[i]`: the side
//!    v ------- to        before j is the other side of the edge.
//! ```

use super::polygons::{NONE, Polygons, to_id};
use crate::HalfEdgeId;

/// To find the cyclic order of the corners at a vertex, neighboring corners are matched. If a vertex has at most this
/// number of corners, all pairs are compared; otherwise, the corners are sorted.
const MAX_COMPARED: usize = 32;

/// The corners at one vertex. Each list has one entry for each corner, in the order of the corners passed to
/// [`set`](Self::set).
#[derive(Default)]
pub(super) struct Star {
    /// For each corner, the previous corner of its polygon, as an index into the corners of all polygons.
    pub(super) before: Vec<u32>,
    /// For each corner, the vertex of the previous corner of its polygon.
    from: Vec<u32>,
    /// For each corner, the vertex of the next corner of its polygon.
    to: Vec<u32>,
    /// For each corner, the next corner clockwise around the vertex, as an index into these lists; `NONE` on the
    /// boundary.
    pub(super) after: Vec<u32>,
    /// The index, in these lists, of the first corner that has no predecessor and therefore starts an open fan. 0 if
    /// all fans are closed.
    start: usize,
    is_closed: bool,
    /// Whether any edge at the vertex is known to be non-manifold. The flag is false if all sides along the
    /// non-manifold edges end at this vertex. In this case, the flag is true in the star of the vertex at the other end
    /// of such an edge.
    pub(super) has_non_manifold_edge: bool,
}

/// An outgoing half-edge of a vertex, or none. The number 2c stands for the side that starts at corner c, and 2c + 1
/// for the boundary half-edge that is the twin of this side.
#[derive(Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub(super) struct Outgoing(u32);

impl Outgoing {
    pub(super) const NONE: Self = Self(NONE);

    /// Returns the side that starts at corner `c`.
    pub(super) fn along_side(c: u32) -> Self {
        Self(2 * c)
    }

    /// Returns the boundary half-edge that is the twin of the side that starts at corner `c`.
    pub(super) fn along_boundary(c: u32) -> Self {
        Self(2 * c + 1)
    }

    /// Returns the id of the outgoing half-edge. `half_edge_of_corner` has the half-edge of each corner.
    #[inline]
    pub(super) fn half_edge(self, half_edge_of_corner: &[HalfEdgeId]) -> HalfEdgeId {
        if self == Self::NONE {
            return HalfEdgeId::NONE;
        }
        let side = half_edge_of_corner[(self.0 / 2) as usize];
        if self.0.is_multiple_of(2) {
            side
        } else {
            side.twin()
        }
    }
}

/// A fan: corners at one vertex that are connected through shared edges.
pub(super) struct Fan {
    /// An outgoing half-edge of the vertex: the boundary half-edge of an open fan, or any half-edge of a closed fan.
    pub(super) outgoing: Outgoing,
    pub(super) corners: Vec<u32>,
}

impl Star {
    /// Sets the corners, which must be all corners at one vertex, in ascending order.
    pub(super) fn set(&mut self, polygons: &Polygons, corners: &[u32]) {
        self.before.clear();
        self.from.clear();
        self.to.clear();
        for &c in corners {
            let (before, after) = polygons.prev_and_next(c);
            self.before.push(before);
            self.from.push(polygons.origin(before));
            self.to.push(polygons.origin(after));
        }
        self.after.clear();
        if corners.len() <= MAX_COMPARED {
            self.match_by_comparing();
        } else {
            self.match_by_sorting();
        }
    }

    /// Finds, for each corner, the next corner clockwise around the vertex. For each neighbor w, the k-th side from the
    /// vertex to w is paired with the k-th side from w to the vertex. Clockwise, the corner at the start of the first
    /// side is followed by the corner at the end of the second side.
    fn match_by_comparing(&mut self) {
        let n = self.to.len();
        let mut free = if n == MAX_COMPARED {
            u32::MAX
        } else {
            (1 << n) - 1
        };
        self.has_non_manifold_edge = false;
        for &to in &self.to {
            let hits = (0..).zip(&self.from);
            let hits = hits.fold(0_u32, |hits, (j, &from)| hits | u32::from(from == to) << j);
            self.has_non_manifold_edge |= hits & hits.wrapping_sub(1) != 0;
            let hit = (hits & free).trailing_zeros();
            if hit < u32::BITS {
                free &= !(1 << hit);
                self.after.push(hit);
            } else {
                // No corner is left that could follow the current corner. If another corner has a side to the
                // same neighbor, the edge is non-manifold.
                let n_sides = self.to.iter().filter(|&&other| other == to).count();
                self.has_non_manifold_edge |= n_sides > 1;
                self.after.push(NONE);
            }
        }
        self.is_closed = free == 0;
        self.start = if free == 0 {
            0
        } else {
            free.trailing_zeros() as usize
        };
    }

    /// Finds the same corners as [`match_by_comparing`](Self::match_by_comparing), and is faster if there are many
    /// corners.
    fn match_by_sorting(&mut self) {
        let sorted = |neighbors: &[u32]| {
            let mut sorted: Vec<(u32, u32)> = neighbors.iter().copied().zip(0..).collect();
            sorted.sort_unstable();
            sorted
        };
        let (to, from) = (sorted(&self.to), sorted(&self.from));
        self.has_non_manifold_edge = [&to, &from]
            .iter()
            .any(|sorted| sorted.windows(2).any(|w| w[0].0 == w[1].0));
        self.after.resize(to.len(), NONE);
        let mut is_free = vec![true; from.len()];
        let (mut i, mut j) = (0, 0);
        while i < to.len() && j < from.len() {
            let order = to[i].0.cmp(&from[j].0);
            if order.is_eq() {
                self.after[to[i].1 as usize] = from[j].1;
                is_free[from[j].1 as usize] = false;
            }
            i += usize::from(order.is_le());
            j += usize::from(order.is_ge());
        }
        let start = is_free.iter().position(|&is| is);
        self.is_closed = start.is_none();
        self.start = start.unwrap_or(0);
    }

    /// Returns an outgoing half-edge of the vertex. If any fan is open, this is the boundary half-edge of the fan that
    /// starts at the first corner without a predecessor. If all fans are closed, the half-edge starts at the first
    /// corner. `corners` must be the corners that were passed to [`set`](Self::set).
    pub(super) fn outgoing(&self, corners: &[u32]) -> Outgoing {
        if self.is_closed {
            Outgoing::along_side(corners[self.start])
        } else {
            Outgoing::along_boundary(self.before[self.start])
        }
    }

    /// Whether the corners form one fan: a walk around the vertex from the corner `start` reaches all corners.
    pub(super) fn is_one_fan(&self) -> bool {
        let mut n_reached = 1;
        let mut i = self.after[self.start];
        while i != NONE && i as usize != self.start {
            i = self.after[i as usize];
            n_reached += 1;
        }
        n_reached == self.after.len()
    }

    /// Returns the fans, in the order of their lowest corners. `corners` must be the corners that were passed to
    /// [`set`](Self::set).
    pub(super) fn fans(&self, corners: &[u32]) -> Vec<Fan> {
        let mut predecessor = vec![NONE; corners.len()];
        for (i, &after) in (0..).zip(&self.after) {
            if let Some(predecessor) = predecessor.get_mut(after as usize) {
                *predecessor = i;
            }
        }
        let mut is_visited = vec![false; corners.len()];
        let mut fans = Vec::new();
        for lowest in 0..to_id(corners.len()) {
            if is_visited[lowest as usize] {
                continue;
            }
            // Walk back to the corner that has no predecessor. If every corner has a predecessor, walk once
            // around the vertex.
            let mut start = lowest;
            while predecessor[start as usize] != NONE {
                start = predecessor[start as usize];
                if start == lowest {
                    break;
                }
            }
            let outgoing = match predecessor[start as usize] {
                NONE => Outgoing::along_boundary(self.before[start as usize]),
                _ => Outgoing::along_side(corners[start as usize]),
            };
            let mut fan = Fan {
                outgoing,
                corners: Vec::new(),
            };
            let mut i = start;
            while i != NONE && !is_visited[i as usize] {
                is_visited[i as usize] = true;
                fan.corners.push(corners[i as usize]);
                i = self.after[i as usize];
            }
            fans.push(fan);
        }
        fans
    }

    /// Returns the neighbors that share a non-manifold edge with the vertex. Along a non-manifold edge, several sides
    /// run in the same direction. Each entry is `(neighbor, number of sides to the neighbor, number of sides from the
    /// neighbor)`.
    pub(super) fn non_manifold_edges(&self) -> Vec<(u32, usize, usize)> {
        let sides = self
            .to
            .iter()
            .map(|&w| (w, true))
            .chain(self.from.iter().map(|&w| (w, false)));
        let mut sides: Vec<(u32, bool)> = sides.collect();
        sides.sort_unstable();
        let counts = sides.chunk_by(|a, b| a.0 == b.0).map(|sides| {
            let n_to = sides.iter().filter(|(_, is_outgoing)| *is_outgoing).count();
            (sides[0].0, n_to, sides.len() - n_to)
        });
        counts
            .filter(|&(_, n_to, n_from)| n_to.max(n_from) > 1)
            .collect()
    }
}
