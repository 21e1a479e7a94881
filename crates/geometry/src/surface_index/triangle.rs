//! Nearest points on segments and triangles, and distances between them.

use mesh::DVec3;

use super::triangles_intersect;

/// Returns the point of the segment from `a` to `b` that is nearest to `p`. Returns `a` if the segment has length 0.
pub(crate) fn nearest_on_segment(p: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let along = b - a;
    let length_squared = along.length_squared();
    if length_squared == 0.0 {
        return a;
    }
    a + along * ((p - a).dot(along) / length_squared).clamp(0.0, 1.0)
}

/// Returns the distance between the segment from `a` to `b` and the segment from `c` to `d`.
///
/// Computes the nearest points of the two lines through the segments, then clamps one point after the other to its
/// segment: Ericson, "Real-Time Collision Detection", 2005, §5.1.9.
pub(crate) fn between_segments([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, vv, uv) = (u.length_squared(), v.length_squared(), u.dot(v));
    let cross = uu * vv - uv * uv;
    let s = if cross > 0.0 {
        ((uv * v.dot(w) - vv * u.dot(w)) / cross).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let on_second = nearest_on_segment(a + s * u, c, d);
    let on_first = nearest_on_segment(on_second, a, b);
    on_first.distance(on_second)
}

/// Returns the point of a triangle that is nearest to `p`. A triangle has Voronoi regions: of its corners, of its
/// sides, and of its interior. The formula for the nearest point depends on the region in which `p` lies. For a
/// zero-area triangle, the result is the nearest point of its three sides.
///
/// Source: Ericson, "Real-Time Collision Detection", 2005, §5.1.5.
pub fn nearest_on_triangle(p: DVec3, &[a, b, c]: &[DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    if ab.cross(ac) == DVec3::ZERO {
        let sides = [[a, b], [b, c], [c, a]].map(|[a, b]| nearest_on_segment(p, a, b));
        let nearer = |q: DVec3, r: DVec3| {
            if p.distance_squared(r) < p.distance_squared(q) {
                r
            } else {
                q
            }
        };
        return nearer(nearer(sides[0], sides[1]), sides[2]);
    }
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return nearest_on_segment(p, a, b);
    }
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return nearest_on_segment(p, a, c);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return nearest_on_segment(p, b, c);
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}

/// Returns the distance between two triangles, which is 0 if they have a common point. If the triangles have no common
/// point, the result is the smallest of several distances. These are the distances from each corner to the other
/// triangle, and the distances between sides of the two triangles. If a zero-area triangle passes through the other
/// triangle, the result can be above 0, although the triangles have common points.
pub fn triangle_distance(s: &[DVec3; 3], t: &[DVec3; 3]) -> f64 {
    if triangles_intersect(s, t) {
        return 0.0;
    }
    let corner = |p: &DVec3, t| p.distance(nearest_on_triangle(*p, t));
    let corners = s
        .iter()
        .map(|p| corner(p, t))
        .chain(t.iter().map(|p| corner(p, s)));
    let sides = |&[a, b, c]: &[DVec3; 3]| [[a, b], [b, c], [c, a]];
    let pairs = sides(s)
        .into_iter()
        .flat_map(|e| sides(t).map(|f| between_segments(e, f)));
    corners.chain(pairs).fold(f64::INFINITY, f64::min)
}

/// Returns the barycentric coordinates of the point nearest to `p` on a triangle. The point is found with the same
/// Voronoi regions as in [`nearest_on_triangle`]. If the point lies at a corner, the weights of the two other corners
/// are exactly 0. If the point lies on a side, the weight of the corner opposite this side is exactly 0.
pub(super) fn nearest_weights(p: DVec3, &[a, b, c]: &[DVec3; 3]) -> [f64; 3] {
    let (ab, ac) = (b - a, c - a);
    if ab.cross(ac) == DVec3::ZERO {
        let points = [a, b, c];
        let mut best = (f64::INFINITY, [1.0, 0.0, 0.0]);
        for k in 0..3 {
            let (q, r) = (points[k], points[(k + 1) % 3]);
            let t = along(p, q, r);
            let squared = p.distance_squared(q + (r - q) * t);
            if squared < best.0 {
                let mut weights = [0.0; 3];
                weights[k] = 1.0 - t;
                weights[(k + 1) % 3] = t;
                best = (squared, weights);
            }
        }
        return best.1;
    }
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = along(p, a, b);
        return [1.0 - t, t, 0.0];
    }
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = along(p, a, c);
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = along(p, b, c);
        return [0.0, 1.0 - t, t];
    }
    let sum = va + vb + vc;
    let (v, w) = (vb / sum, vc / sum);
    [(1.0 - v - w).max(0.0), v, w]
}

/// Finds the point of a segment that is nearest to `p`. Returns the position of this point along the segment: from 0 at
/// `a` to 1 at `b`. Returns 0 if the segment has length 0.
fn along(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let length_squared = along.length_squared();
    if length_squared == 0.0 {
        return 0.0;
    }
    ((p - a).dot(along) / length_squared).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns points on a lattice around the origin.
    fn lattice() -> impl Iterator<Item = DVec3> {
        (0..200).map(|i| {
            DVec3::new(
                f64::from(i % 7) - 2.0,
                f64::from(i % 5) - 1.0,
                f64::from(i % 3) - 1.0,
            )
        })
    }

    /// Returns the smallest distance from `p` to samples of the triangle.
    fn sampled(p: DVec3, t: &[DVec3; 3]) -> f64 {
        (0..=60)
            .flat_map(|a| (0..=60 - a).map(move |b| (f64::from(a) / 60.0, f64::from(b) / 60.0)))
            .map(|(u, v)| p.distance(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_nearest_point_agrees_with_many_samples_of_the_triangle() {
        let at = DVec3::new;
        for t in [
            [DVec3::ZERO, at(3.0, 0.5, 0.0), at(1.0, 2.0, 1.0)],
            // Three degenerate triangles: a segment, a segment with a duplicate end, and a point.
            [DVec3::ZERO, at(2.0, 2.0, 0.0), at(1.0, 1.0, 0.0)],
            [DVec3::ZERO, DVec3::ZERO, at(2.0, 1.0, 1.0)],
            [at(1.0, 0.0, 1.0); 3],
        ] {
            for p in lattice() {
                let found = p.distance(nearest_on_triangle(p, &t));
                let sampled = sampled(p, &t);
                assert!(
                    found <= sampled + 1e-12 && sampled < found + 0.06,
                    "{t:?} {p}: {found} {sampled}"
                );
                let [u, v, w] = nearest_weights(p, &t);
                assert!(u >= 0.0 && v >= 0.0 && w >= 0.0 && (u + v + w - 1.0).abs() < 1e-15);
                let point = u * t[0] + v * t[1] + w * t[2];
                assert!(
                    (p.distance(point) - found).abs() < 1e-12,
                    "{t:?} {p}: {point}"
                );
            }
        }
    }

    #[test]
    fn the_distance_of_segments_agrees_with_many_samples() {
        let at = DVec3::new;
        let points: Vec<DVec3> = lattice().collect();
        let mut segments: Vec<[DVec3; 2]> = points.windows(2).map(|w| [w[0], w[1]]).collect();
        segments.push([DVec3::ZERO; 2]);
        let fixed = [at(0.5, -1.0, 0.25), at(1.0, 1.5, 0.25)];
        for segment in segments {
            let found = between_segments(fixed, segment);
            let sampled = (0..=200)
                .map(|i| fixed[0].lerp(fixed[1], f64::from(i) / 200.0))
                .map(|p| p.distance(nearest_on_segment(p, segment[0], segment[1])))
                .fold(f64::INFINITY, f64::min);
            assert!(
                found <= sampled + 1e-12 && sampled < found + 0.02,
                "{segment:?}: {found} {sampled}"
            );
        }
    }

    #[test]
    fn the_distance_of_triangles_agrees_with_many_samples() {
        let at = DVec3::new;
        let fixed = [at(0.5, -1.0, 0.25), at(1.0, 1.5, 0.25), at(-0.5, 0.5, 0.75)];
        let points: Vec<DVec3> = lattice().collect();
        let mut n_apart = 0;
        let triangles = points.windows(3).map(|w| [w[0], w[1], w[2]]);
        let has_area = |[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a) != DVec3::ZERO;
        for t in triangles.filter(has_area) {
            let found = triangle_distance(&fixed, &t);
            let mut sampled = f64::INFINITY;
            for i in 0..=60 {
                for j in 0..=60 - i {
                    let weights = [i, j, 60 - i - j].map(|k| f64::from(k) / 60.0);
                    let p: DVec3 = (0..3).map(|k| weights[k] * fixed[k]).sum();
                    sampled = sampled.min(p.distance(nearest_on_triangle(p, &t)));
                }
            }
            n_apart += usize::from(found > 0.0);
            assert!(
                found <= sampled + 1e-12 && sampled < found + 0.03,
                "{t:?}: {found} {sampled}"
            );
        }
        assert!(n_apart > 0);
    }
}
