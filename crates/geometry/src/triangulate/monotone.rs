//! Triangulates a large polygon in O(n log n), because the time of ear clipping can grow with the square of the number
//! of corners.
//!
//! ```text
//!    a       b              a       b
//!   / \     / \            / \     / \      A horizontal line moves down over the polygon. Where two parts of the
//!  /   \   /   \          /   \   /   \     polygon join (m) or a part divides (s), a diagonal cuts the polygon. A
//! |     \ /     |        |     \ /     |    horizontal line meets each resulting piece in one segment, so the pieces
//! |      m      |   -->  |      m      |    are called monotone. The triangles of a piece are found from its top to
//! |      s      |        |      s      |    its bottom.
//! |     / \     |        |     / \     |
//!  \___/   \___/          \___/   \___/     Here, the diagonal from m to s cuts the polygon into two pieces.
//! ```
//!
//! Source: de Berg and others, "Computational Geometry: Algorithms and Applications", 2008, chapter 3.

use std::cmp::Ordering::{self, Greater, Less};
use std::collections::BTreeSet;

use mesh::DVec2;

use super::sort::sort_unless;
use super::{Triangle, is_triangulation_unless, with_sorted_corners};
use crate::predicates::orient2d;

/// The number of corners that are processed between two checks for cancellation.
const CHECK: u32 = 1024;

/// Triangulates a counter-clockwise polygon. The triangles are sorted.
///
/// Returns `None` if `is_cancelled` returns `true`. Also returns `None` if a triangle would be turned over, because
/// some sides of the polygon cross or overlap.
pub(super) fn triangulate(
    points: &[[f64; 2]],
    is_cancelled: &dyn Fn() -> bool,
) -> Option<Vec<Triangle>> {
    let polygon = Polygon::new(points, is_cancelled)?;
    let mut diagonals = polygon.diagonals(is_cancelled)?.into_iter().peekable();
    let mut triangles = Vec::with_capacity(points.len());
    // Diagonals do not cross, so they are nested like brackets. `open` lists the corners before corner `j` that no
    // diagonal has cut off so far.
    let mut open: Vec<u32> = Vec::new();
    for j in (0..).take(points.len()) {
        while let Some([i, _]) = diagonals.next_if(|[_, end]| *end == j) {
            let first = open.binary_search(&i).ok()?;
            let piece = [&open[first..], &[j]].concat();
            polygon.triangulate_piece(&piece, &mut triangles)?;
            open.truncate(first + 1);
        }
        open.push(j);
    }
    polygon.triangulate_piece(&open, &mut triangles)?;
    sort_unless(is_cancelled, &mut triangles, Ord::cmp)?;
    is_triangulation_unless(is_cancelled, points.len(), &triangles)?.then_some(triangles)
}

struct Polygon<'a> {
    points: &'a [[f64; 2]],
    /// The corners from top to bottom, which is the order in which the horizontal sweep line reaches them. Of corners
    /// at the same height, the left one comes first.
    order: Vec<u32>,
    /// For each corner, its index in `order`.
    rank: Vec<u32>,
}

impl<'a> Polygon<'a> {
    /// Sorts the corners of a polygon from top to bottom. Returns `None` if `is_cancelled` returns `true`.
    fn new(points: &'a [[f64; 2]], is_cancelled: &dyn Fn() -> bool) -> Option<Self> {
        let mut order: Vec<u32> = (0..).zip(points).map(|(i, _)| i).collect();
        sort_unless(is_cancelled, &mut order, |&i, &j| {
            let [[ax, ay], [bx, by]] = [i, j].map(|i| points[i as usize]);
            by.total_cmp(&ay).then(ax.total_cmp(&bx)).then(i.cmp(&j))
        })?;
        let mut rank = vec![0; points.len()];
        for (place, &i) in (0..).zip(&order) {
            rank[i as usize] = place;
        }
        Some(Self {
            points,
            order,
            rank,
        })
    }

    fn at(&self, corner: u32) -> DVec2 {
        self.points[corner as usize].into()
    }

    /// Returns the diagonals that cut the polygon into monotone pieces. A horizontal line never meets a monotone piece
    /// in more than one segment. Each diagonal is a pair of corners, the lower index first. The diagonals are nested
    /// like brackets. They are sorted by their second corner, and an inner diagonal comes before an outer one.
    fn diagonals(&self, is_cancelled: &dyn Fn() -> bool) -> Option<Vec<[u32; 2]>> {
        let n = u32::try_from(self.points.len()).expect("corners fit 32 bits");
        // The sides of the polygon that the horizontal sweep line meets now. Only sides with the inside of the polygon
        // to their right are listed.
        let mut sides: BTreeSet<Side> = BTreeSet::new();
        // Each side in `sides` has a helper: the last processed corner whose nearest side to the left is this side. At
        // first, the helper is the first corner of the side. `helpers` is indexed by the first corner of the side.
        let mut helpers = vec![0; self.points.len()];
        let mut is_join = vec![false; self.points.len()];
        let mut diagonals = Vec::new();
        for (place, &v) in (0..).zip(&self.order) {
            if place % CHECK == 0 && is_cancelled() {
                return None;
            }
            let [before, after] = [(v + n - 1) % n, (v + 1) % n];
            let [a, b, c] = [before, v, after].map(|i| self.at(i));
            let [goes_down, continues_down] = [
                self.rank[before as usize] < place,
                self.rank[after as usize] > place,
            ];
            let turn = orient2d(a, b, c);
            let is_reflex = goes_down != continues_down && turn == Less;
            let mut connect = |helper: u32| diagonals.push([helper.min(v), helper.max(v)]);
            if goes_down {
                let side = Side::new(a, b, before);
                let helper = helpers[before as usize];
                if !sides.remove(&side) {
                    return None;
                }
                if is_join[helper as usize] {
                    connect(helper);
                }
            }
            if is_reflex || !goes_down && !continues_down {
                let left = sides.range(..Side::new(b, a, v)).next_back()?.corner as usize;
                let helper = helpers[left];
                if is_reflex && continues_down || is_join[helper as usize] {
                    connect(helper);
                }
                helpers[left] = v;
                is_join[v as usize] = is_reflex && goes_down;
            }
            if continues_down {
                sides.insert(Side::new(b, c, v));
                helpers[v as usize] = v;
            }
        }
        sort_unless(is_cancelled, &mut diagonals, |&[i, j], &[k, l]| {
            j.cmp(&l).then(k.cmp(&i))
        })?;
        Some(diagonals)
    }

    /// Adds the triangles of a monotone piece to `triangles`. The corners in `piece` are in ascending order. Returns
    /// `None` if a triangle would be turned over.
    fn triangulate_piece(&self, piece: &[u32], triangles: &mut Vec<Triangle>) -> Option<()> {
        let rank = |k: usize| self.rank[piece[k % piece.len()] as usize];
        let top = (0..piece.len()).min_by_key(|&k| rank(k))?;
        let bottom = (0..piece.len()).max_by_key(|&k| rank(k))?;
        // The list `corners` has, for each corner: its rank from the top, its index, and whether it is on the left
        // boundary of the piece.
        let n_left = (bottom + piece.len() - top) % piece.len();
        let corner = |k: usize| (rank(top + k), piece[(top + k) % piece.len()], k < n_left);
        let mut corners: Vec<(u32, u32, bool)> = (0..piece.len()).map(corner).collect();
        corners.sort_unstable();
        let mut add = |a: u32, b: u32, c: u32| {
            let triangle = with_sorted_corners([a, b, c]);
            let [a, b, c] = triangle.map(|i| self.at(i));
            triangles.push(triangle);
            (orient2d(a, b, c) != Less).then_some(())
        };
        // The corners above `c` that no triangle has cut off so far. All corners on the stack, except the first one,
        // are on the same boundary of the piece, left or right.
        let mut stack: Vec<u32> = Vec::new();
        let mut stack_is_left = false;
        let &(_, last, _) = corners.last()?;
        for &(_, c, is_left) in &corners {
            if c == last || stack.len() > 1 && is_left != stack_is_left {
                for pair in stack.windows(2) {
                    add(pair[0], pair[1], c)?;
                }
                stack.drain(..stack.len().saturating_sub(1));
            } else {
                while let &[.., a, b] = &stack[..] {
                    let turn = orient2d(self.at(a), self.at(b), self.at(c));
                    if turn != if is_left { Greater } else { Less } {
                        break;
                    }
                    add(a, b, c)?;
                    stack.pop();
                }
            }
            stack.push(c);
            stack_is_left = is_left;
        }
        Some(())
    }
}

/// A side of the polygon that the horizontal sweep line meets. To search for the side to the left of a corner, a `Side`
/// is made from the corner itself: `upper` is the corner, and `lower` is one of the two corners next to it.
#[derive(Clone, Copy)]
struct Side {
    upper: DVec2,
    lower: DVec2,
    /// The index of the corner at which the side begins. This index distinguishes sides whose ends have the same
    /// positions.
    corner: u32,
}

impl Side {
    fn new(upper: DVec2, lower: DVec2, corner: u32) -> Self {
        Self {
            upper,
            lower,
            corner,
        }
    }

    /// Returns `Less` if this side is to the left of the other side. The other side must not begin above this side.
    fn compare(&self, other: &Self) -> Ordering {
        let turn = |p: DVec2| orient2d(self.lower, self.upper, p);
        turn(other.upper).then_with(|| turn(other.lower))
    }
}

impl Ord for Side {
    fn cmp(&self, other: &Self) -> Ordering {
        let begins_below = self.upper.y < other.upper.y
            || self.upper.y == other.upper.y && self.upper.x > other.upper.x;
        let order = if begins_below {
            other.compare(self).reverse()
        } else {
            self.compare(other)
        };
        order.then(self.corner.cmp(&other.corner))
    }
}

impl PartialOrd for Side {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Side {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Side {}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::triangulate::is_triangulation;

    fn circle(angle: f64, radius: f64) -> [f64; 2] {
        [radius * libm::cos(angle), radius * libm::sin(angle)]
    }

    /// Returns the next number of a pseudo-random sequence. All numbers are from 0 to 1.
    fn next(state: &mut u64) -> f64 {
        *state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (*state >> 32) as f64 / f64::from(u32::MAX)
    }

    /// A zigzag band with `n` corners and long sides: the worst case for ear clipping.
    fn comb(n: u32) -> Vec<[f64; 2]> {
        let upper = |i: u32| if i.is_multiple_of(2) { 0.0 } else { 100.0 };
        let there = (0..n / 2).map(|i| [f64::from(i), upper(i)]);
        let back = (0..n / 2).rev().map(|i| [f64::from(i), upper(i) + 5.0]);
        there.chain(back).collect()
    }

    /// A corridor that winds around the origin ten times.
    fn spiral(n: u32) -> Vec<[f64; 2]> {
        let at = |i: u32, radius: f64| {
            let t = 20.0 * f64::from(i) / f64::from(n);
            circle(TAU * t, radius + t)
        };
        let outside = (0..n / 2).map(|i| at(i, 1.5));
        outside
            .chain((0..n / 2).rev().map(|i| at(i, 1.0)))
            .collect()
    }

    /// A star whose points have random lengths.
    fn star(n: u32) -> Vec<[f64; 2]> {
        let mut state = 1;
        let angle = |i: u32| TAU * f64::from(i) / f64::from(n);
        (0..n)
            .map(|i| circle(angle(i), 0.01 + next(&mut state)))
            .collect()
    }

    /// A rectangle with square holes. Each hole is connected with the lower side by a segment. The polygon goes along
    /// this segment twice, once in each direction.
    fn holes(n: u32) -> Vec<[f64; 2]> {
        let corners = [
            (0, 0),
            (2, 0),
            (2, 1),
            (1, 2),
            (2, 3),
            (3, 2),
            (2, 1),
            (2, 0),
        ];
        let hole = |i: u32| corners.map(|(x, y)| [f64::from(4 * i + x), f64::from(y)]);
        let end = f64::from(n / 2);
        let upper = [[end, 0.0], [end, 4.0], [0.0, 4.0]];
        (0..n / 8).flat_map(hole).chain(upper).collect()
    }

    fn doubled_area(polygon: &[[f64; 2]]) -> f64 {
        let cross = |[a, b]: [[f64; 2]; 2]| a[0] * b[1] - a[1] * b[0];
        let sides = (0..polygon.len()).map(|i| [polygon[i], polygon[(i + 1) % polygon.len()]]);
        sides.map(cross).sum()
    }

    /// Asserts that the triangles are not turned over and have the area of the polygon.
    fn assert_triangulates(polygon: &[[f64; 2]]) {
        let triangles = triangulate(polygon, &|| false).unwrap_or_else(|| panic!("{polygon:?}"));
        assert!(is_triangulation(polygon.len(), &triangles));
        let areas = triangles
            .iter()
            .map(|t| doubled_area(&t.map(|i| polygon[i as usize])));
        let (mut sum, area) = (0.0, doubled_area(polygon));
        for a in areas {
            assert!(a >= -1e-12 * area, "{polygon:?}");
            sum += a;
        }
        assert!((sum - area).abs() <= 1e-9 * area, "{sum} {area}");
    }

    #[test]
    fn large_polygons_are_triangulated() {
        for polygon in [comb, spiral, star, holes] {
            for n in [400, 20_000] {
                assert_triangulates(&polygon(n));
            }
        }
    }

    /// With small whole coordinates, many corners are at the same height or on the same line.
    #[test]
    fn polygons_with_small_whole_coordinates_are_triangulated() {
        let (mut state, mut n_tested) = (1, 0);
        for _ in 0..20_000 {
            let size = 2.0 + 8.0 * next(&mut state);
            let mut coordinate = || (size * next(&mut state)).round() - (0.5 * size).floor();
            let mut points: Vec<[f64; 2]> = (0..30).map(|_| [coordinate(), coordinate()]).collect();
            // The corners go once around the origin. No two of them are in the same direction.
            points.retain(|p| *p != [0.0; 2]);
            points.sort_by(|[ax, ay], [bx, by]| {
                libm::atan2(*ay, *ax).total_cmp(&libm::atan2(*by, *bx))
            });
            points.dedup_by(|a, b| {
                orient2d([0.0; 2].into(), (*a).into(), (*b).into()).is_eq()
                    && a[0] * b[0] + a[1] * b[1] > 0.0
            });
            let is_around = (0..points.len()).all(|i| {
                let [a, b] = [points[i], points[(i + 1) % points.len()]];
                orient2d([0.0; 2].into(), a.into(), b.into()) == Greater
            });
            if is_around {
                assert_triangulates(&points);
                n_tested += 1;
            }
        }
        assert!(n_tested > 10_000, "{n_tested}");
    }

    #[test]
    fn a_polygon_with_crossing_sides_is_refused() {
        // The polygon is a figure eight: one half runs counterclockwise, and the other half runs clockwise.
        let eight = |i: u32| {
            let angle = TAU * f64::from(i) / 9999.0;
            [libm::sin(angle) + 0.1, libm::sin(2.0 * angle)]
        };
        let crossing: Vec<[f64; 2]> = (0..9999).map(eight).collect();
        assert!(triangulate(&crossing, &|| false).is_none());
        let mut state = 1;
        for n in 5..200 {
            let random: Vec<_> = (0..n)
                .map(|_| [next(&mut state), next(&mut state)])
                .collect();
            // A few of these random polygons have no crossing sides, so they are triangulated.
            if triangulate(&random, &|| false).is_some() {
                assert_triangulates(&random);
            }
        }
    }

    #[test]
    fn a_cancelled_triangulation_returns_nothing() {
        assert!(triangulate(&star(10), &|| true).is_none());
    }
}
