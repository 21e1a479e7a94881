//! Pieces of the triangles of the measured surface. Each piece has an upper bound on the distances from its points to
//! the other surface.

use mesh::{DVec3, Element, FaceId, parallel};
use progress::Cancelled;

use super::{Ask, SurfacePoint};
use crate::surface_index::triangle::between_segments;
use crate::surface_index::{Nearest, SurfaceIndex};

/// A point of the measured surface and the nearest point of the other surface.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) at: DVec3,
    pub(super) hit: Nearest,
}

/// A triangle of the measured surface, or a part of such a triangle.
#[derive(Clone)]
pub(super) struct Piece {
    corners: [Sample; 3],
    face: FaceId,
    /// An upper bound of the distances from all points of the piece to the other surface.
    pub(super) upper: f64,
}

/// Of all samples so far, the one that is furthest from the other surface.
#[derive(Clone, Copy)]
pub(super) struct Farthest {
    pub(super) on: Element,
    pub(super) sample: Sample,
}

/// The number of pieces in a block. One thread cuts all pieces of a block.
const BLOCK: usize = 64;

/// The maximum number of pieces that are cut in one round. If there are more pieces, only the pieces with the largest
/// upper bounds are cut.
const MAX_PIECES: usize = 1 << 18;

/// The search stops after it has visited this number of nodes in the tree of the other surface. This number of visits
/// takes a few seconds.
const MAX_VISITS: u64 = 1 << 28;

impl Farthest {
    /// Returns a lower bound of the distance from the sample to the other surface.
    pub(super) fn lower_bound(&self) -> f64 {
        self.sample.hit.lower
    }

    /// Returns the sample that is further from the other surface, or `self` if both are equally far.
    pub(super) fn or(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if other.lower_bound() > self.lower_bound() => other,
            _ => self,
        }
    }

    pub(super) fn points(&self, to: &SurfaceIndex) -> (SurfacePoint, SurfacePoint) {
        let Sample { at, hit } = self.sample;
        let place = |position, on| SurfacePoint { position, on };
        let face = to.triangle(hit.triangle).face;
        (place(at, self.on), place(hit.point, Element::Face(face)))
    }
}

impl Piece {
    /// Creates the piece with the given corners. Computes the upper bound of the distances from the piece to the other
    /// surface.
    pub(super) fn new(corners: [Sample; 3], face: FaceId, to: &SurfaceIndex) -> Self {
        let mut piece = Self {
            corners,
            face,
            upper: f64::INFINITY,
        };
        piece.upper = piece.bound(to);
        piece
    }

    /// Returns an upper bound of the distances from all points of the piece to the other surface. The result is the
    /// minimum of these bounds:
    ///
    /// 1. The largest distance from a corner of the piece to a certain triangle of the other surface. All corners are
    ///    compared with the same triangle. The distance to a triangle is a convex function of the point, so its maximum
    ///    over the piece is at a corner.
    /// 2. d + e, if the nearest points of the three corners lie on two triangles S and T with a common edge. The length
    ///    d is the largest distance from a corner of the piece to the other surface. Let N be the triangle that the
    ///    three nearest points span. Then no point of the piece is further than d from N. Two sides of N join a point
    ///    of S to a point of T. The length e is the larger of the distances of these two sides from the common edge.
    ///    Each point of N is therefore within the distance e of S or of T.
    /// 3. The same length d plus 1/√3 times the longest side of the piece. This is a bound because the distance from a
    ///    point of the piece to the nearest corner is at most 1/√3 times the longest side.
    fn bound(&self, to: &SurfaceIndex) -> f64 {
        let [a, b, c] = self.corners;
        let far = self.corners.iter().fold(0.0, |d, s| s.hit.distance.max(d));
        let mut bound = far + self.longest_side().1 / 3.0_f64.sqrt();
        for (i, s) in [a, b, c].iter().enumerate() {
            let is_new = self.corners[..i]
                .iter()
                .all(|other| other.hit.triangle != s.hit.triangle);
            if is_new {
                bound = bound.min(self.to_triangle(to, s.hit.triangle));
            }
        }
        let one_and_two = match [a, b, c].map(|s| s.hit.triangle) {
            [i, j, k] if i == j && j != k => Some([c, a, b]),
            [i, j, k] if i == k && j != k => Some([b, a, c]),
            [i, j, k] if j == k && i != j => Some([a, b, c]),
            _ => None,
        };
        if let Some([single, second, third]) = one_and_two
            && let Some(edge) = to.shared_edge(single.hit.triangle, second.hit.triangle)
        {
            let gap = |s: Sample| between_segments([single.hit.point, s.hit.point], edge);
            bound = bound.min(far + gap(second).max(gap(third)));
        }
        bound
    }

    /// Returns the largest distance from a point of the piece to the given triangle of the other surface.
    fn to_triangle(&self, to: &SurfaceIndex, triangle: u32) -> f64 {
        let distance = |s: &Sample| {
            if s.hit.triangle == triangle {
                s.hit.distance
            } else {
                to.to_triangle(s.at, triangle)
            }
        };
        self.corners.iter().map(distance).fold(0.0, f64::max)
    }

    /// Whether cutting the piece can lower its upper bound. The distance at a corner can be inexact, because the search
    /// stopped early. In this case, returns false if the upper bound is at most `tolerance` above the largest distance
    /// at a corner.
    fn can_improve(&self, tolerance: f64) -> bool {
        let hits = self.corners.map(|s| s.hit);
        let far = hits.iter().fold(0.0, |d, hit| hit.distance.max(d));
        let is_exact = hits.iter().all(|hit| hit.lower == hit.distance);
        is_exact || self.upper > far + tolerance
    }

    /// Returns the index of the corner at which the longest side starts, and the length of that side.
    fn longest_side(&self) -> (usize, f64) {
        let length = |i: usize| self.corners[i].at.distance(self.corners[(i + 1) % 3].at);
        let sides = [0, 1, 2].map(|i| (i, length(i)));
        sides.into_iter().fold(
            sides[0],
            |best, side| if side.1 > best.1 { side } else { best },
        )
    }

    /// Returns the center of the piece, with the point of the other surface that is nearest to the center.
    pub(super) fn middle(&self, to: &SurfaceIndex) -> Sample {
        let [a, b, c] = self.corners;
        let at = (a.at + b.at + c.at) / 3.0;
        let hit = to.nearest(at, a.hit.triangle);
        Sample { at, hit }
    }

    /// Computes another upper bound from one triangle of the other surface: the triangle that is nearest to the center
    /// of the piece. If this bound is smaller, it replaces the upper bound of the piece. `middle` is the sample at the
    /// center.
    pub(super) fn lower(&mut self, middle: &Sample, to: &SurfaceIndex) {
        self.upper = self.upper.min(self.to_triangle(to, middle.hit.triangle));
    }

    /// Returns `sample`, which must lie in the piece, as a candidate for the sample that is furthest from the other
    /// surface.
    pub(super) fn at(&self, sample: Sample) -> Farthest {
        Farthest {
            on: Element::Face(self.face),
            sample,
        }
    }

    /// Cuts the piece in two at the midpoint of its longest side. Returns the two halves and the sample at the
    /// midpoint.
    fn cut(&self, to: &SurfaceIndex) -> ([Self; 2], Sample) {
        let (i, _) = self.longest_side();
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

/// Cuts pieces in two until the upper bound of every piece is at most `tolerance` above the distance of the furthest
/// sample. Stops earlier if [`MAX_VISITS`] nodes were visited. A piece is not cut if the cut cannot lower its upper
/// bound. If a round has too many pieces, the pieces with the smallest bounds are left uncut. Returns the furthest
/// sample, and an upper bound of the distances of all points of the surface. The bound is also valid for the points of
/// pieces that were not cut. `ceiling` is an upper bound of the distances of the points that are in none of the
/// `pieces`.
pub(super) fn refine(
    mut pieces: Vec<Piece>,
    mut farthest: Farthest,
    mut ceiling: f64,
    to: &SurfaceIndex,
    tolerance: f64,
    ask: &Ask,
) -> Result<(Farthest, f64), Cancelled> {
    let mut visits_left = MAX_VISITS;
    // Limits the number of pieces in a round, so that all rounds together visit at most about `MAX_VISITS` nodes. The
    // number of nodes that a search visits is estimated from earlier searches.
    let visits = pieces.iter().map(|p| u64::from(p.corners[0].hit.visits));
    // Cutting a piece takes at most three searches for nearest points. The factor 5 instead of 3 leaves a margin.
    let per_piece = 5 * (visits.sum::<u64>() / (pieces.len() as u64).max(1)).max(1);
    let affordable = |visits: u64, per_piece: u64| {
        usize::try_from(visits / per_piece).map_or(MAX_PIECES, |n| n.clamp(1, MAX_PIECES))
    };
    let mut max_pieces = affordable(MAX_VISITS, per_piece);
    loop {
        let threshold = farthest.lower_bound() + tolerance;
        pieces.retain(|piece| {
            let stays = piece.upper > threshold && piece.can_improve(tolerance);
            if !stays {
                ceiling = ceiling.max(piece.upper);
            }
            stays
        });
        if pieces.len() > max_pieces {
            pieces.sort_by(|a, b| b.upper.total_cmp(&a.upper));
            ceiling = ceiling.max(pieces[max_pieces].upper);
            pieces.truncate(max_pieces);
        }
        if pieces.is_empty() || visits_left == 0 {
            let waiting = pieces.iter().fold(ceiling, |c, piece| c.max(piece.upper));
            return Ok((farthest, waiting.max(farthest.lower_bound())));
        }
        let cut: Result<Vec<_>, Cancelled> =
            parallel::consume(pieces.chunks(BLOCK), |_, pieces| {
                ask()?;
                Ok(cut_all(pieces, farthest, threshold, to))
            })
            .into_iter()
            .collect();
        let cut = cut?;
        let (n_cut, left_before) = (pieces.len() as u64, visits_left);
        pieces = Vec::with_capacity(2 * pieces.len());
        for (halves, candidate, visits) in cut {
            pieces.extend(halves);
            farthest = farthest.or(Some(candidate));
            visits_left = visits_left.saturating_sub(visits);
        }
        let per_piece = (left_before - visits_left).div_ceil(n_cut).max(1);
        max_pieces = affordable(visits_left, per_piece);
    }
}

/// Cuts pieces in two. Returns three results: the halves; the furthest sample, chosen from `farthest` and the new
/// samples; and the number of visited nodes.
fn cut_all(
    pieces: &[Piece],
    mut farthest: Farthest,
    threshold: f64,
    to: &SurfaceIndex,
) -> (Vec<Piece>, Farthest, u64) {
    let mut visits = 0;
    let mut halves = Vec::with_capacity(2 * pieces.len());
    for piece in pieces {
        let (parts, middle) = piece.cut(to);
        farthest = farthest.or(Some(piece.at(middle)));
        visits += u64::from(middle.hit.visits) + 1;
        for mut half in parts {
            if half.upper > threshold {
                let middle = half.middle(to);
                farthest = farthest.or(Some(half.at(middle)));
                visits += u64::from(middle.hit.visits) + 1;
                half.lower(&middle, to);
            }
            halves.push(half);
        }
    }
    (halves, farthest, visits)
}
