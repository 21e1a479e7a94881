//! Cutting a polygon without certain diagonals.
//!
//! ```text
//!    i ---- . . .        for every side or diagonal i-j the best triangle behind it: the one with the
//!    |  \                corner k for which the diagonals of the two parts that are left are shortest
//!    |    k
//!    |  /
//!    j ---- . . .
//! ```
//!
//! By dynamic programming from short chains of corners to long ones: Klincsek, "Minimal Triangulations of
//! Polygonal Domains", 1980. If all triangles of a simple polygon face its way, none overlap.

use super::{TOLERANCE, Triangle, doubled_area};
use mesh::DVec3;

/// Larger polygons would take too long.
const MOST_CORNERS: usize = 256;

/// The triangles whose diagonals are allowed and have the smallest sum of squared lengths, in order. They
/// face the way of the polygon, unless those of `first`, how it would be cut otherwise, do not either.
pub(super) fn shortest(
    points: &[DVec3],
    first: &[Triangle],
    allowed: impl Fn([u32; 2]) -> bool,
) -> Option<Vec<Triangle>> {
    let n = points.len();
    if n > MOST_CORNERS {
        return None;
    }
    let normal = doubled_area(points);
    let smallest = TOLERANCE * normal.length_squared();
    let faces_up = |[a, b, c]: [usize; 3]| {
        let area = (points[b] - points[a]).cross(points[c] - points[a]);
        area.dot(normal) > smallest
    };
    let all_face_up = first.iter().all(|t| faces_up(t.map(|i| i as usize)));
    let fits = |triangle| !all_face_up || faces_up(triangle);

    // For corners i < j the cost of what lies between them, and the third corner of the triangle there.
    let mut best: Vec<Option<(f64, usize)>> = vec![None; n * n];
    for i in 0..n - 1 {
        best[i * n + i + 1] = Some((0.0, i));
    }
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            let is_side = length == n - 1;
            if !is_side && !allowed([i, j].map(to_u32)) {
                continue;
            }
            let own = if is_side {
                0.0
            } else {
                points[i].distance_squared(points[j])
            };
            let mut found: Option<(f64, usize)> = None;
            for k in i + 1..j {
                let (Some((low, _)), Some((high, _))) = (best[i * n + k], best[k * n + j]) else {
                    continue;
                };
                let cost = own + low + high;
                if found.is_none_or(|(lowest, _)| cost < lowest) && fits([i, k, j]) {
                    found = Some((cost, k));
                }
            }
            best[i * n + j] = found;
        }
    }

    let mut triangles = Vec::with_capacity(n - 2);
    let mut chains = vec![(0, n - 1)];
    while let Some((i, j)) = chains.pop() {
        if j > i + 1 {
            let (_, k) = best[i * n + j]?;
            triangles.push([i, k, j].map(to_u32));
            chains.extend([(i, k), (k, j)]);
        }
    }
    triangles.sort_unstable();
    Some(triangles)
}

fn to_u32(i: usize) -> u32 {
    u32::try_from(i).expect("few corners")
}

#[cfg(test)]
mod tests {
    use super::super::{fan, is_cut_of};
    use super::*;

    /// A flat polygon without its point at the middle: corners on a circle.
    fn circle(n: u32) -> Vec<DVec3> {
        let at = |i: u32| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(n));
            DVec3::new(cos, sin, 0.0)
        };
        (0..n).map(at).collect()
    }

    #[test]
    fn forbidden_diagonals_are_not_used() {
        let points = circle(9);
        for forbidden in 0..9 {
            // Corner `forbidden` keeps its angle: every diagonal at it is forbidden.
            let allowed = |pair: [u32; 2]| !pair.contains(&forbidden);
            let triangles = shortest(&points, &fan(9, 0), allowed).unwrap();
            assert!(is_cut_of(9, &triangles));
            let at = triangles.iter().filter(|t| t.contains(&forbidden));
            assert_eq!(at.count(), 1);
        }
    }

    #[test]
    fn there_may_be_no_way() {
        let points = circle(6);
        assert_eq!(shortest(&points, &fan(6, 0), |_| false), None);
        // Of the two ways to cut an arrow head one would turn a triangle over.
        let arrow = [(0.0, 0.0), (2.0, 1.0), (1.0, 0.0), (2.0, -1.0)];
        let arrow = arrow.map(|(x, y)| DVec3::new(x, y, 0.0));
        let outside = |pair| pair == [1, 3];
        assert_eq!(shortest(&arrow, &fan(4, 0), outside), None);
        assert!(shortest(&arrow, &fan(4, 1), outside).is_some());
    }

    #[test]
    fn large_polygons_are_left() {
        let points = circle(257);
        assert_eq!(shortest(&points, &fan(257, 0), |_| true), None);
        let triangles = shortest(&points[..256], &fan(256, 0), |_| true).unwrap();
        assert!(is_cut_of(256, &triangles));
    }
}
