//! Cutting a polygon into triangles.

use glam::DVec3;

/// Cuts a polygon into triangles, given as places in `points`: n - 2 of them, each corner used.
///
/// ```text
///     d ------- c          d ------- c
///     |         |          |       / |
///     |         |   --->   |    /    |
///     |         |          | /       |
///     a ------- b          a ------- b
/// ```
///
/// A fan around the first corner from which all triangles face the way of the polygon; a polygon that
/// has no such corner loses one ear after the other (Meisters, "Polygons have ears", 1975), as seen
/// along its normal. A polygon that crosses itself is cut all the same.
pub(crate) fn triangulate(points: &[DVec3]) -> Vec<[usize; 3]> {
    let n = points.len();
    if n < 3 {
        return Vec::new();
    }
    if n == 3 {
        return vec![[0, 1, 2]];
    }
    let normal = area_vector(points);
    let fan =
        |center: usize| (1..n - 1).map(move |k| [center, (center + k) % n, (center + k + 1) % n]);
    let faces_up = |[a, b, c]: [usize; 3]| area(points, a, b, c).dot(normal) > 0.0;
    // Trying every corner of a large polygon would take quadratic time; ears take as long, but cut
    // every simple polygon.
    let center = (0..n.min(16)).find(|&center| fan(center).all(faces_up));
    match center {
        Some(center) => fan(center).collect(),
        None => ears(points, normal),
    }
}

fn ears(points: &[DVec3], normal: DVec3) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..points.len()).collect();
    let mut triangles = Vec::with_capacity(points.len() - 2);
    let mut at = 0;
    let mut tried = 0;
    while left.len() > 3 {
        let n = left.len();
        let [a, b, c] = [left[(at + n - 1) % n], left[at % n], left[(at + 1) % n]];
        let turns_left = area(points, a, b, c).dot(normal) > 0.0;
        let blocked = || {
            let others = left.iter().filter(|&&p| p != a && p != b && p != c);
            others.clone().any(|&p| {
                let inside = |x, y| area(points, x, y, p).dot(normal) >= 0.0;
                inside(a, b) && inside(b, c) && inside(c, a)
            })
        };
        // Without any ear the polygon crosses itself or has no area: the next corner goes.
        if tried >= n || turns_left && !blocked() {
            triangles.push([a, b, c]);
            left.remove(at % n);
            at = if at % n == 0 {
                left.len() - 1
            } else {
                at % n - 1
            };
            tried = 0;
        } else {
            at = (at + 1) % n;
            tried += 1;
        }
    }
    triangles.push([left[0], left[1], left[2]]);
    triangles
}

/// Twice the area vector of a triangle.
fn area(points: &[DVec3], a: usize, b: usize, c: usize) -> DVec3 {
    (points[b] - points[a]).cross(points[c] - points[a])
}

/// Twice the area vector of a polygon (Newell's method).
pub(crate) fn area_vector(points: &[DVec3]) -> DVec3 {
    let fan = points[1..]
        .windows(2)
        .map(|w| (w[0] - points[0]).cross(w[1] - points[0]));
    fan.fold(DVec3::ZERO, |sum, area| sum + area)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn polygon(points: &[(f64, f64)]) -> Vec<DVec3> {
        points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
    }

    fn check(points: &[DVec3]) {
        let triangles = triangulate(points);
        assert_eq!(triangles.len(), points.len() - 2);
        let up = area_vector(points);
        let mut sum = 0.0;
        for [a, b, c] in triangles {
            let part = area(points, a, b, c).dot(up);
            assert!(part >= 0.0, "{a} {b} {c} is turned");
            sum += part;
        }
        assert!((sum - up.length_squared()).abs() < 1e-9 * sum);
    }

    #[test]
    fn a_square_is_cut_from_its_first_corner() {
        let square = polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        assert_eq!(triangulate(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn polygons_with_dents_are_covered_once() {
        let dart = [(0.0, 0.0), (2.0, -1.0), (1.0, 0.0), (2.0, 1.0)];
        let comb = [
            (0.0, 0.0),
            (5.0, 0.0),
            (5.0, 3.0),
            (4.0, 1.0),
            (3.0, 3.0),
            (2.0, 1.0),
            (1.0, 3.0),
            (0.5, 1.0),
            (0.0, 3.0),
        ];
        for start in 0..4 {
            let mut dart = dart;
            dart.rotate_left(start);
            check(&polygon(&dart));
        }
        check(&polygon(&comb));
    }

    proptest! {
        #[test]
        fn any_points_give_two_triangles_fewer(numbers in prop::collection::vec(-4..4_i32, 9..40)) {
            let points: Vec<_> = numbers
                .chunks_exact(3)
                .map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into()))
                .collect();
            let triangles = triangulate(&points);
            prop_assert_eq!(triangles.len(), points.len() - 2);
            for i in 0..points.len() {
                prop_assert!(triangles.iter().any(|t| t.contains(&i)));
            }
        }
    }
}
