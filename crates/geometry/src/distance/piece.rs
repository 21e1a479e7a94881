//! Pieces of triangles, and how far from the other surface they can be.

use mesh::{DVec3, Element, FaceId};
use rayon::prelude::*;

use super::SurfacePoint;
use super::surface::{Hit, Surface};
use super::triangle::between_segments;

/// A point of the surface that is measured, and the nearest one of the other surface.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) at: DVec3,
    pub(super) hit: Hit,
}

/// A triangle, or a part of one.
#[derive(Clone)]
pub(super) struct Piece {
    corners: [Sample; 3],
    face: FaceId,
    /// No point of it is further away than this.
    pub(super) upper: f64,
}

/// The sample that is furthest away so far.
#[derive(Clone, Copy)]
pub(super) struct Farthest {
    pub(super) on: Element,
    pub(super) sample: Sample,
}

/// The pieces that are cut by one task.
const BLOCK: usize = 256;

/// Most pieces that wait at once; of more the furthest are taken.
const MOST_AT_ONCE: usize = 1 << 18;

/// Most nodes of the other surface that are looked at: a few seconds.
const MOST: u64 = 1 << 28;

impl Farthest {
    /// How far away it is for certain.
    pub(super) fn certain(&self) -> f64 {
        self.sample.hit.lower
    }

    /// The further one; this one of equals.
    pub(super) fn or(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if other.certain() > self.certain() => other,
            _ => self,
        }
    }

    pub(super) fn places(&self, to: &Surface) -> (SurfacePoint, SurfacePoint) {
        let Sample { at, hit } = self.sample;
        let place = |position, on| SurfacePoint { position, on };
        let face = to.triangle(hit.triangle).face;
        (place(at, self.on), place(hit.point, Element::Face(face)))
    }
}

impl Piece {
    /// The piece with these corners and a bound of its distance.
    pub(super) fn new(corners: [Sample; 3], face: FaceId, to: &Surface) -> Self {
        let mut piece = Self {
            corners,
            face,
            upper: f64::INFINITY,
        };
        piece.upper = piece.bound(to);
        piece
    }

    /// What no point of the piece is further away than: the least of several bounds.
    ///
    /// 1. The distance to one triangle of the other surface, which is convex: its largest value over the
    ///    piece is at a corner.
    /// 2. Where the nearest points of the corners lie on two triangles with a common edge, the triangle
    ///    between these points lies close to the two: a chord across the edge is no further from them than
    ///    from the edge. A point of the piece is no further from a point of that triangle than the corners are.
    /// 3. A point of the piece lies within 1/√3 of the longest side from a corner.
    fn bound(&self, to: &Surface) -> f64 {
        let [a, b, c] = self.corners;
        let far = self.corners.iter().fold(0.0, |d, s| s.hit.distance.max(d));
        let mut bound = far + self.longest().1 / 3.0_f64.sqrt();
        for (i, s) in [a, b, c].iter().enumerate() {
            let is_new = self.corners[..i]
                .iter()
                .all(|other| other.hit.triangle != s.hit.triangle);
            if is_new {
                bound = bound.min(self.to_triangle(to, s.hit.triangle));
            }
        }
        let alone = match [a, b, c].map(|s| s.hit.triangle) {
            [i, j, k] if i == j && j != k => Some([c, a, b]),
            [i, j, k] if i == k && j != k => Some([b, a, c]),
            [i, j, k] if j == k && i != j => Some([a, b, c]),
            _ => None,
        };
        if let Some([one, other, another]) = alone
            && let Some(edge) = to.shared_edge(one.hit.triangle, other.hit.triangle)
        {
            let off = |s: Sample| between_segments([one.hit.point, s.hit.point], edge);
            bound = bound.min(far + off(other).max(off(another)));
        }
        bound
    }

    /// The largest distance from the piece to one triangle.
    fn to_triangle(&self, to: &Surface, triangle: u32) -> f64 {
        let distance = |s: &Sample| {
            if s.hit.triangle == triangle {
                s.hit.distance
            } else {
                to.to_triangle(s.at, triangle)
            }
        };
        self.corners.iter().map(distance).fold(0.0, f64::max)
    }

    /// Whether smaller pieces would tell more: not where the distances of the corners, which are known only
    /// nearly, are the bound already.
    fn can_be_told(&self, tolerance: f64) -> bool {
        let hits = self.corners.map(|s| s.hit);
        let far = hits.iter().fold(0.0, |d, hit| hit.distance.max(d));
        let is_known = hits.iter().all(|hit| hit.lower == hit.distance);
        is_known || self.upper > far + tolerance
    }

    /// The corner before the longest side, and the length of that.
    fn longest(&self) -> (usize, f64) {
        let length = |i: usize| self.corners[i].at.distance(self.corners[(i + 1) % 3].at);
        let sides = [0, 1, 2].map(|i| (i, length(i)));
        sides.into_iter().fold(
            sides[0],
            |best, side| if side.1 > best.1 { side } else { best },
        )
    }

    /// The middle of the piece and what is nearest to it.
    pub(super) fn middle(&self, to: &Surface) -> Sample {
        let [a, b, c] = self.corners;
        let at = (a.at + b.at + c.at) / 3.0;
        let hit = to.nearest(at, a.hit.triangle);
        Sample { at, hit }
    }

    /// Lowers the bound by the triangle that is nearest to the middle.
    pub(super) fn lower(&mut self, middle: &Sample, to: &Surface) {
        self.upper = self.upper.min(self.to_triangle(to, middle.hit.triangle));
    }

    /// A sample inside of the piece as the farthest.
    pub(super) fn at(&self, sample: Sample) -> Farthest {
        Farthest {
            on: Element::Face(self.face),
            sample,
        }
    }

    /// Cuts the longest side in its middle. Returns the halves and that middle.
    fn cut(&self, to: &Surface) -> ([Self; 2], Sample) {
        let (i, _) = self.longest();
        let [a, b, c] = [0, 1, 2].map(|k| self.corners[(i + k) % 3]);
        let at = 0.5 * (a.at + b.at);
        let middle = Sample {
            at,
            hit: to.nearest(at, a.hit.triangle),
        };
        let halves = [[a, middle, c], [middle, b, c]].map(|corners| {
            let half = Self::new(corners, self.face, to);
            Self {
                upper: half.upper.min(self.upper),
                ..half
            }
        });
        (halves, middle)
    }
}

/// Cuts the pieces until none can be further away than the farthest sample by more than `tolerance`, or
/// until that has taken too long. Returns the farthest sample and what no point is further away than;
/// `ceiling` is that for the rest of the surface.
pub(super) fn refine(
    mut wave: Vec<Piece>,
    mut found: Farthest,
    mut ceiling: f64,
    to: &Surface,
    tolerance: f64,
) -> (Farthest, f64) {
    let mut left = MOST;
    loop {
        let enough = found.certain() + tolerance;
        wave.retain(|piece| {
            let stays = piece.upper > enough && piece.can_be_told(tolerance);
            if !stays {
                ceiling = ceiling.max(piece.upper);
            }
            stays
        });
        if wave.len() > MOST_AT_ONCE {
            wave.sort_by(|a, b| b.upper.total_cmp(&a.upper));
            ceiling = ceiling.max(wave[MOST_AT_ONCE].upper);
            wave.truncate(MOST_AT_ONCE);
        }
        if wave.is_empty() || left == 0 {
            let waiting = wave.iter().fold(ceiling, |c, piece| c.max(piece.upper));
            return (found, waiting.max(found.certain()));
        }
        let cut: Vec<_> = wave
            .par_chunks(BLOCK)
            .map(|pieces| cut_all(pieces, found, enough, to))
            .collect();
        wave = Vec::with_capacity(2 * wave.len());
        for (pieces, farthest, visits) in cut {
            wave.extend(pieces);
            found = found.or(Some(farthest));
            left = left.saturating_sub(visits);
        }
    }
}

/// Cuts pieces in halves. Returns the halves, the farthest of `found` and the new samples, and how many nodes
/// were looked at.
fn cut_all(
    pieces: &[Piece],
    mut found: Farthest,
    enough: f64,
    to: &Surface,
) -> (Vec<Piece>, Farthest, u64) {
    let mut visits = 0;
    let mut halves = Vec::with_capacity(2 * pieces.len());
    for piece in pieces {
        let (parts, middle) = piece.cut(to);
        found = found.or(Some(piece.at(middle)));
        visits += u64::from(middle.hit.visits) + 1;
        for mut half in parts {
            if half.upper > enough {
                let middle = half.middle(to);
                found = found.or(Some(half.at(middle)));
                visits += u64::from(middle.hit.visits) + 1;
                half.lower(&middle, to);
            }
            halves.push(half);
        }
    }
    (halves, found, visits)
}
