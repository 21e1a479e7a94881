//! The corners around one vertex, and which follows which.
//!
//! ```text
//!         from           Corner i is that of polygon f at v. Its side leaves v for `to[i]`, and the
//!        /               side of the corner before it comes from `from[i]`. Clockwise around v,
//!      /    f            corner i is followed by the corner j with `from[j] == to[i]`: the side
//!    v ------- to        before j is the other side of the edge.
//! ```

use super::pair::Leaving;
use super::polygons::{NONE, Polygons, to_id};

/// Up to so many corners are compared one with each other, more are sorted.
const FEW: usize = 32;

/// The corners at one vertex. Corners are numbered from 0 here, in the order of the input.
#[derive(Default)]
pub(super) struct Star {
    /// For each corner the one before it in its polygon.
    pub(super) before: Vec<u32>,
    from: Vec<u32>,
    to: Vec<u32>,
    /// For each corner the number of the one that follows clockwise, or `NONE` on the boundary.
    pub(super) after: Vec<u32>,
    /// A corner that follows none, at the start of a fan; 0 if all fans are closed.
    start: usize,
    is_closed: bool,
    /// Whether several sides leave for one neighbor, or come from one.
    pub(super) is_crowded: bool,
}

/// Corners at a vertex that hang together through shared edges.
pub(super) struct Fan {
    /// How to leave the vertex: along the boundary if there is one.
    pub(super) leaving: Leaving,
    pub(super) corners: Vec<u32>,
}

impl Star {
    /// Looks at the given corners, all those at a vertex, in order.
    pub(super) fn look(&mut self, polygons: &Polygons, corners: &[u32]) {
        self.before.clear();
        self.from.clear();
        self.to.clear();
        for &c in corners {
            let (before, after) = polygons.around(c);
            self.before.push(before);
            self.from.push(polygons.origin(before));
            self.to.push(polygons.origin(after));
        }
        self.after.clear();
        if corners.len() <= FEW {
            self.compare();
        } else {
            self.sort();
        }
    }

    /// The k-th corner that leaves for a neighbor is followed by the k-th that comes from it.
    fn compare(&mut self) {
        let n = self.to.len();
        let mut free = if n == FEW { u32::MAX } else { (1 << n) - 1 };
        self.is_crowded = false;
        for &to in &self.to {
            let hits = (0..).zip(&self.from);
            let hits = hits.fold(0_u32, |hits, (j, &from)| hits | u32::from(from == to) << j);
            self.is_crowded |= hits & hits.wrapping_sub(1) != 0;
            let hit = (hits & free).trailing_zeros();
            if hit < u32::BITS {
                free &= !(1 << hit);
                self.after.push(hit);
            } else {
                // Another one may have left for the same neighbor before.
                self.is_crowded |= self.to.iter().filter(|&&other| other == to).count() > 1;
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

    /// The same for many corners.
    fn sort(&mut self) {
        let sorted = |neighbors: &[u32]| {
            let mut sorted: Vec<(u32, u32)> = neighbors.iter().copied().zip(0..).collect();
            sorted.sort_unstable();
            sorted
        };
        let (to, from) = (sorted(&self.to), sorted(&self.from));
        self.is_crowded = [&to, &from]
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

    /// How to leave the vertex from the fan of the first corner that follows none, or of the lowest
    /// corner; `corners` are those that were looked at.
    pub(super) fn leaving(&self, corners: &[u32]) -> Leaving {
        if self.is_closed {
            Leaving::along(corners[self.start])
        } else {
            Leaving::across(self.before[self.start])
        }
    }

    /// Whether the corners form one fan: all are reached from the start.
    pub(super) fn is_one_fan(&self) -> bool {
        let mut reached = 1;
        let mut at = self.after[self.start];
        while at != NONE && at as usize != self.start {
            at = self.after[at as usize];
            reached += 1;
        }
        reached == self.after.len()
    }

    /// The fans, in the order of their lowest corners; `corners` are those that were looked at.
    pub(super) fn fans(&self, corners: &[u32]) -> Vec<Fan> {
        let mut ahead = vec![NONE; corners.len()];
        for (i, &after) in (0..).zip(&self.after) {
            if let Some(ahead) = ahead.get_mut(after as usize) {
                *ahead = i;
            }
        }
        let mut seen = vec![false; corners.len()];
        let mut fans = Vec::new();
        for lowest in 0..to_id(corners.len()) {
            if seen[lowest as usize] {
                continue;
            }
            // Back to the corner that follows none, or once around.
            let mut start = lowest;
            while ahead[start as usize] != NONE {
                start = ahead[start as usize];
                if start == lowest {
                    break;
                }
            }
            let leaving = match ahead[start as usize] {
                NONE => Leaving::across(self.before[start as usize]),
                _ => Leaving::along(corners[start as usize]),
            };
            let mut fan = Fan {
                leaving,
                corners: Vec::new(),
            };
            let mut at = start;
            while at != NONE && !seen[at as usize] {
                seen[at as usize] = true;
                fan.corners.push(corners[at as usize]);
                at = self.after[at as usize];
            }
            fans.push(fan);
        }
        fans
    }

    /// The neighbors with several sides that run the same way, as `(neighbor, sides that leave for
    /// it, sides that come from it)`.
    pub(super) fn crowded(&self) -> Vec<(u32, usize, usize)> {
        let sides = self
            .to
            .iter()
            .map(|&w| (w, true))
            .chain(self.from.iter().map(|&w| (w, false)));
        let mut sides: Vec<(u32, bool)> = sides.collect();
        sides.sort_unstable();
        let counts = sides.chunk_by(|a, b| a.0 == b.0).map(|sides| {
            let leaving = sides.iter().filter(|(_, leaves)| *leaves).count();
            (sides[0].0, leaving, sides.len() - leaving)
        });
        counts
            .filter(|&(_, leaving, coming)| leaving.max(coming) > 1)
            .collect()
    }
}
