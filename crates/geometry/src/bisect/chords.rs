//! Computes the chords along which a line cuts a polygon.
//!
//! ```text
//!                 +     +              Corners on the line are sorted along the line. The sides of the
//!               /   \ /   \            polygon at a corner show where the line is inside the polygon:
//!    ... ------a     b-----c---- line  ahead of a, behind and ahead of b, behind c.
//!            /    inside     \         Each inside interval becomes a chord.
//!           +-----------------+
//! ```

use mesh::{DVec3, polygon_parts};

/// A corner of a polygon, in coordinates relative to the line that cuts the polygon. The line lies near the plane of
/// the polygon.
pub(super) struct Corner {
    /// The signed distance from the line: positive to the left of the line, 0 on the line.
    height: f64,
    /// The coordinate along the line.
    place: f64,
    position: DVec3,
}

impl Corner {
    pub(super) fn new(height: f64, place: f64, position: DVec3) -> Self {
        Self {
            height,
            place,
            position,
        }
    }
}

/// Returns chords that cut the polygon into parts, so that no part has corners on both sides of the line. A chord is a
/// pair of corner indices. The polygon must have corners on both sides of the line. `normal` is the normal of the
/// polygon.
///
/// Sometimes, the chords inside the polygon cannot be determined, or do not separate the two sides of the line. Each
/// chain of corners to the left of the line is then cut off separately.
pub(super) fn chords_along_line(corners: &[Corner], normal: DVec3) -> Vec<[u32; 2]> {
    let n = corners.len();
    let is_good = |chords: &[[u32; 2]]| {
        let is_one_sided = |part: &Vec<usize>| {
            // The number of corners is n. A half-edge index h below n stands for the side of the polygon that starts at
            // corner h.
            let sides = part.iter().filter(|&&h| h < n);
            let heights = sides.flat_map(|&i| [corners[i].height, corners[(i + 1) % n].height]);
            let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), h| {
                (low.min(h), high.max(h))
            });
            low == 0.0 || high == 0.0
        };
        polygon_parts(n, chords).is_some_and(|parts| parts.iter().all(is_one_sided))
    };
    if let Some(chords) = inside_chords(corners, normal)
        && is_good(&chords)
    {
        return chords;
    }
    left_chords(corners)
}

/// Returns the chords inside the polygon, as pairs of corner indices. Returns `None` if the corners on the line
/// contradict each other. For example, the line can be inside the polygon just after one corner on the line, but
/// outside just before the next corner on the line.
fn inside_chords(corners: &[Corner], normal: DVec3) -> Option<Vec<[u32; 2]>> {
    let n = corners.len();
    let mut on_line: Vec<usize> = (0..n).filter(|&i| corners[i].height == 0.0).collect();
    if let [a, b] = on_line[..] {
        return Some(vec![[to_u32(a), to_u32(b)]]);
    }
    let sees_inside: Vec<[bool; 2]> = (0..n)
        .map(|i| {
            if corners[i].height == 0.0 {
                sees_inside(
                    &corners[(i + n - 1) % n],
                    &corners[i],
                    &corners[(i + 1) % n],
                    normal,
                )
            } else {
                [false; 2]
            }
        })
        .collect();
    // The corners divide the line into intervals. If several corners are at the same place on the line, a corner that
    // ends an interval inside the polygon comes before a corner that begins one.
    let rank = |i: usize| match sees_inside[i] {
        [true, false] => 0,
        [false, true] => 2,
        _ => 1,
    };
    on_line.sort_by(|&i, &j| {
        let by_place = corners[i].place.total_cmp(&corners[j].place);
        by_place.then(rank(i).cmp(&rank(j))).then(i.cmp(&j))
    });
    let mut chords = Vec::new();
    let mut is_inside = false;
    for (k, &i) in on_line.iter().enumerate() {
        let [left, right] = sees_inside[i];
        if left != is_inside {
            return None;
        }
        if left {
            let before = on_line[k - 1];
            chords.push([to_u32(before.min(i)), to_u32(before.max(i))]);
        }
        is_inside = right;
    }
    (!is_inside).then_some(chords)
}

/// Returns two flags for a corner on the line. They tell whether the line, followed in its direction, is inside the
/// polygon just before the corner, and just after the corner.
///
/// The directions to the next and to the previous corner are measured in quarter turns from the line: 0 is
/// ahead, 1 left, 2 behind, 3 right. Going counter-clockwise around the corner, the inside starts at the
/// direction to the next corner and ends at the direction to the previous corner.
fn sees_inside(before: &Corner, corner: &Corner, after: &Corner, normal: DVec3) -> [bool; 2] {
    let quarter = |other: &Corner| {
        if other.height > 0.0 {
            1
        } else if other.height < 0.0 {
            3
        } else if other.place > corner.place {
            0
        } else {
            2
        }
    };
    let (begin, mut end) = (quarter(after), quarter(before));
    let is_reflex = || {
        let [to_after, to_before] = [after, before].map(|c| c.position - corner.position);
        to_after.cross(to_before).dot(normal) < 0.0
    };
    if end < begin || (end == begin && begin % 2 == 1 && is_reflex()) {
        end += 4;
    }
    let contains = |quarter: i32| begin < quarter && quarter < end;
    [contains(2) || contains(6), contains(4)]
}

/// Returns one chord for each chain of consecutive corners to the left of the line: the chord that cuts off this chain.
fn left_chords(corners: &[Corner]) -> Vec<[u32; 2]> {
    let n = corners.len();
    let is_left = |i: usize| corners[i % n].height > 0.0;
    let mut chords: Vec<[u32; 2]> = (0..n)
        .filter(|&i| !is_left(i) && is_left(i + 1))
        .map(|i| {
            // The chain consists of corners to the left of the line. The search finds its end, because the polygon also
            // has corners that are not to the left.
            let end = (i + 1..=i + n)
                .find(|&j| !is_left(j))
                .expect("a chain ends")
                % n;
            [to_u32(i.min(end)), to_u32(i.max(end))]
        })
        .collect();
    chords.sort_unstable();
    chords
}

fn to_u32(i: usize) -> u32 {
    u32::try_from(i).expect("corners fit 32 bits")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the chords of the line y = 0 in a polygon of the plane z = 0.
    fn cut(points: &[(f64, f64)]) -> Vec<[u32; 2]> {
        let corner = |&(x, y): &(f64, f64)| Corner::new(y, x, DVec3::new(x, y, 0.0));
        let corners: Vec<Corner> = points.iter().map(corner).collect();
        let mut chords = chords_along_line(&corners, DVec3::Z);
        assert!(polygon_parts(corners.len(), &chords).is_some());
        chords.sort_unstable();
        chords
    }

    #[test]
    fn a_convex_polygon_has_one_chord() {
        assert_eq!(cut(&[(0., 0.), (1., -1.), (2., 0.), (1., 1.)]), [[0, 2]]);
    }

    #[test]
    fn teeth_below_the_line_have_a_chord_each() {
        let comb = [
            (0., 1.),
            (0., 0.),
            (1., -1.),
            (2., 0.),
            (2.5, 0.5),
            (3., 0.),
            (4., -1.),
            (5., 0.),
            (5., 1.),
        ];
        assert_eq!(cut(&comb), [[1, 3], [5, 7]]);
    }

    #[test]
    fn a_reflex_corner_on_the_line_ends_two_chords() {
        let heart = [(0., 0.), (2., -3.), (4., 0.), (3., 1.), (2., 0.), (1., 1.)];
        assert_eq!(cut(&heart), [[0, 4], [2, 4]]);
        let upside_down: Vec<_> = heart.iter().rev().map(|&(x, y)| (x, -y)).collect();
        assert_eq!(cut(&upside_down), [[1, 3], [1, 5]]);
    }

    #[test]
    fn a_corner_that_only_touches_the_line_and_sides_on_the_line_have_no_chord() {
        // The corner at (2, 0) is convex and only touches the line.
        let zigzag = [
            (0., 0.),
            (1., 2.),
            (2., 0.),
            (3., 2.),
            (4., 0.),
            (4., 3.),
            (-2., 3.),
            (-2., -1.),
            (-1., -1.),
            (-1., 0.),
        ];
        // An edge crosses the line at (-2, 0). The caller of `chords_along_line` inserts a corner where an edge crosses
        // the line, so the test does so too.
        let mut crossed = zigzag.to_vec();
        crossed.insert(7, (-2., 0.));
        assert_eq!(cut(&crossed), [[7, 10]]);
    }

    #[test]
    fn coincident_corners_of_a_slit_are_ordered_correctly() {
        // A square with a square hole. A slit connects the hole to the outer boundary, and the line crosses this slit.
        let keyhole = [
            (-4., -4.),
            (4., -4.),
            (4., 0.),
            (4., 4.),
            (3., 4.),
            (3., 0.),
            (3., -2.),
            (-2., -2.),
            (-2., 0.),
            (-2., 2.),
            (2., 2.),
            (2., 0.),
            (2., -2.),
            (3., -2.),
            (3., 0.),
            (3., 4.),
            (-4., 4.),
            (-4., 0.),
        ];
        // The hole is between x = -2 and x = 2. The slit has two sides, so the line crosses the slit twice at x = 3.
        let chords = cut(&keyhole);
        assert_eq!(chords, [[2, 5], [8, 17], [11, 14]]);
    }

    #[test]
    fn self_intersecting_polygons_are_cut_too() {
        // A bow tie intersects itself. A face can have this shape.
        let bow = [
            (0., 0.),
            (2., -2.),
            (3., 0.),
            (1., 3.),
            (2., 0.),
            (3., -3.),
            (4., 0.),
            (2., 1.),
        ];
        assert!(!cut(&bow).is_empty());
    }
}
