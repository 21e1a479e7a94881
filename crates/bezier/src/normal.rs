//! Normals at points where the derivatives of a patch are zero or parallel.
//!
//! ```text
//!      v = 1                The pole of a surface of revolution is a whole edge of the patch,
//!        *                  collapsed to one point. Along this edge du = 0, so du x dv = 0. Still,
//!       /|\   lines of      the surface has a normal there: the limit of the direction of du x dv
//!      / | \  equal u       as v approaches the edge.
//!     /  |  \
//!    *---+---*  v = 0
//! ```
//!
//! Let du and dv be the derivatives of the patch with respect to u and v. Then N = du x dv is a polynomial in u and v.
//! Consider a straight line from the point (u, v) into the patch: (u + e a, v + e b) for small e > 0, where (a, b) is
//! the direction of the line. Along this line, N is a polynomial in e:
//!
//! ```text
//! N(e) = N0 + e N1 + e² N2 + ...      N(e) / |N(e)|  ->  Nk / |Nk|  as e goes to 0,
//! ```
//!
//! where Nk is the first nonzero coefficient of the polynomial. At a regular point, this coefficient is N0 = du x dv.
//! Along a collapsed edge v = 0, du is zero, and the first nonzero coefficient is N1 = duv x dv, where duv is the mixed
//! derivative. Along a collapsed edge v = 1, the line into the patch has b = -1, and N1 = -duv x dv. At a collapsed
//! corner, and on an edge along which N0 and N1 are zero, the first nonzero coefficient is N2 or a later one. N has
//! degree 5 in u and in v, so N10 is the last coefficient.
//!
//! From a point on an edge, the line runs straight across the patch. From a corner or from a point inside the patch,
//! the line runs diagonally. If the normals have the same limit along all lines from the point, this limit is the
//! result. If the limits differ, for example at a cusp or at the tip of a cone, the result is the limit along the
//! chosen line. If N is zero along the whole line, two more lines from the same point are tried, one on each side of
//! the first line. If N is zero along all three lines, the point has no normal.
//!
//! Before the coefficients are compared with zero, the derivatives are scaled. The derivatives along u are divided by
//! the largest difference of control points that are neighbors along u. The derivatives along v are divided by the
//! largest difference of neighbors along v. A coefficient of the scaled normal is treated as zero if the magnitude of
//! each of its coordinates is at most [`VANISHING`]. Because the derivatives are scaled, even thin and tiny patches get
//! normals.

use glam::{DVec2, DVec3};

/// A coefficient of the scaled normal is treated as zero if the magnitude of each coordinate is at most this value.
///
/// This threshold is well above the rounding errors of the coefficients (1e-14). The threshold is also above the
/// coefficients at a nearly collapsed edge: an edge that [`tessellate`](crate::tessellate()) treats as collapsed
/// although its points differ slightly. Very close to a pole (within 1e-10 times the size of the patch), the first
/// nonzero coefficient can be inaccurate and below this threshold. In this case, the next coefficient gives a more
/// accurate normal.
pub const VANISHING: f64 = 1e-10;

/// Returns the limit of the normals along a line from `uv` into the patch. Up to three lines are tried. Returns `None`
/// if the normals are zero along all three lines.
///
/// `c` contains the Taylor coefficients of the patch at `uv`: c\[i\]\[j\] is the coefficient of x^i y^j. `max_steps` is
/// the result of [`Patch::max_steps`](crate::Patch), which must not be zero.
pub(crate) fn limit(c: &[[DVec3; 4]; 4], max_steps: DVec2, uv: DVec2) -> Option<DVec3> {
    inward_directions(uv)
        .into_iter()
        .find_map(|direction| limit_along(c, max_steps, direction))
}

/// Returns `n` scaled to length 1, or `None` if `n` is not finite or is treated as zero.
pub(crate) fn unit(n: DVec3) -> Option<DVec3> {
    let size = size(n);
    (size > VANISHING && n.is_finite()).then(|| (n / size).normalize())
}

/// Returns three directions in (u, v) that lead from `uv` into the patch, with the preferred direction first.
fn inward_directions(uv: DVec2) -> [DVec2; 3] {
    let on_edge = |t: f64| t <= 0.0 || t >= 1.0;
    let inward = |t: f64| if t > 0.5 { -1.0 } else { 1.0 };
    let direction = match (on_edge(uv.x), on_edge(uv.y)) {
        (true, false) => DVec2::new(inward(uv.x), 0.0),
        (false, true) => DVec2::new(0.0, inward(uv.y)),
        _ => DVec2::new(inward(uv.x), inward(uv.y)),
    };
    let offset = direction.perp() * 0.5;
    [direction, direction + offset, direction - offset]
}

/// Returns the first nonzero coefficient of N along `direction`, scaled to length 1. Returns `None` if all coefficients
/// are zero.
fn limit_along(c: &[[DVec3; 4]; 4], max_steps: DVec2, direction: DVec2) -> Option<DVec3> {
    // Along the line in this direction, the derivatives of the patch are polynomials in the distance e. The arrays `du`
    // and `dv` hold the coefficients of these polynomials, starting with the power 0.
    let mut du = [DVec3::ZERO; 6];
    let mut dv = [DVec3::ZERO; 6];
    let (a, b) = (powers(direction.x), powers(direction.y));
    for i in 0..4 {
        for j in 0..4 {
            if i > 0 {
                du[i - 1 + j] += c[i][j] * (i as f64 * a[i - 1] * b[j] / max_steps.x);
            }
            if j > 0 {
                dv[i + j - 1] += c[i][j] * (j as f64 * a[i] * b[j - 1] / max_steps.y);
            }
        }
    }
    (0..=10_usize).find_map(|k| {
        let pairs = k.saturating_sub(5)..=k.min(5);
        unit(pairs.map(|i| du[i].cross(dv[k - i])).sum())
    })
}

/// Returns 1, x, x², x³.
fn powers(x: f64) -> [f64; 4] {
    [1.0, x, x * x, x * x * x]
}

/// Returns the largest magnitude of a coordinate of `p`.
pub(crate) fn size(p: DVec3) -> f64 {
    p.abs().max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Patch;
    use crate::fixtures::{Lcg, assert_close, octant, quarter_turn, squared};

    /// Checks that every normal on the boundary is close to the normals at nearby points inside the patch, along three
    /// lines.
    fn assert_normals_are_limits(patch: &Patch) {
        for i in 0..=8 {
            let t = f64::from(i) / 8.0;
            for (u, v) in [(t, 0.0), (t, 1.0), (0.0, t), (1.0, t)] {
                let normal = patch.normal(u, v);
                assert!(normal.is_normalized(), "no normal at ({u}, {v})");
                for target in [(0.5, 0.5), (0.4, 0.7), (0.3, 0.2)] {
                    let e = 1e-5;
                    let near = patch.normal(u + e * (target.0 - u), v + e * (target.1 - v));
                    assert!(
                        normal.distance(near) < 1e-3,
                        "({u}, {v}): {normal} but {near} near"
                    );
                }
            }
        }
    }

    /// Returns the patch in all eight orientations: all combinations of reversing u, reversing v, and
    /// transposing.
    fn all_orientations(patch: &Patch) -> Vec<Patch> {
        let mut orientations = vec![*patch];
        let reversed_u = |p: &Patch| {
            let mut points = *p.points();
            for row in &mut points {
                row.reverse();
            }
            Patch::new(points).unwrap()
        };
        orientations.push(reversed_u(patch));
        orientations.extend(orientations.clone().iter().map(Patch::transposed));
        orientations.extend(orientations.clone().iter().map(reversed_u));
        orientations
    }

    #[test]
    fn the_normal_at_the_pole_of_a_sphere_is_its_axis() {
        for u in [0.0, 0.3, 0.5, 1.0] {
            assert_close(octant().normal(u, 1.0), DVec3::Z, 1e-12);
            assert_close(octant().transposed().normal(1.0, u), -DVec3::Z, 1e-12);
        }
    }

    #[test]
    fn normals_of_a_collapsed_edge_are_limits() {
        // In the first row of `lid`, all control points coincide, as in the lid of the teapot. The same holds for the
        // third row of `lid`. In the first row of `bottom`, all control points coincide, as in the bottom of the
        // teapot.
        let lid = quarter_turn([[0.0, 3.15], [0.8, 3.15], [0.0, 2.85], [0.2, 2.7]]);
        let bottom = quarter_turn([[0.0, 0.0], [1.4, 0.0], [1.5, 0.1], [1.5, 0.2]]);
        for patch in [octant(), lid, bottom] {
            all_orientations(&patch)
                .iter()
                .for_each(assert_normals_are_limits);
        }
    }

    #[test]
    fn a_pole_with_two_collapsed_rows_has_a_normal() {
        // All control points of the first two rows coincide, so du and dv are both zero along the first row.
        let patch = quarter_turn([[0.0, 1.0], [0.0, 1.0], [1.0, 1.0], [2.0, 0.5]]);
        for patch in all_orientations(&patch) {
            assert_normals_are_limits(&patch);
        }
        assert_close(patch.normal(0.4, 0.0), -DVec3::Z, 1e-12);
    }

    #[test]
    fn normals_of_a_collapsed_corner_are_exact() {
        let patch = squared();
        for (u, v) in [
            (0.0, 0.0),
            (0.0, 0.6),
            (0.7, 0.0),
            (1.0, 0.0),
            (0.3, 0.4),
            (1.0, 1.0),
        ] {
            let exact = DVec3::new(-v * v, -u * u, 1.0).normalize();
            assert_close(patch.normal(u, v), exact, 1e-12);
        }
        all_orientations(&patch)
            .iter()
            .for_each(assert_normals_are_limits);
    }

    #[test]
    fn a_corner_with_parallel_derivatives_has_a_normal() {
        // The patch is planar, and the angle at its corner (0, 0) is 180 degrees.
        let mut points = *Lcg::new(21).patch().points();
        for (r, row) in points.iter_mut().enumerate() {
            for (c, p) in row.iter_mut().enumerate() {
                *p = DVec3::new(c as f64, r as f64, 0.0);
            }
        }
        points[1][0] = DVec3::new(-1.0, 0.0, 0.0);
        let patch = Patch::new(points).unwrap();

        let (du, dv) = patch.derivatives(0.0, 0.0);
        assert_eq!(du.cross(dv), DVec3::ZERO);
        assert_close(patch.normal(0.0, 0.0), DVec3::Z, 1e-12);
    }

    #[test]
    fn thin_tiny_and_huge_patches_have_normals() {
        let scales = [
            DVec3::new(1.0, 1e-9, 1.0),
            DVec3::splat(1e-90),
            DVec3::splat(1e90),
        ];
        for scale in scales {
            let flat = [0.0, 1.0, 2.0, 3.0]
                .map(|y| [0.0, 1.0, 2.0, 3.0].map(|x| DVec3::new(x, y, 0.0) * scale));
            assert_close(Patch::new(flat).unwrap().normal(0.5, 0.0), DVec3::Z, 1e-12);
        }
        let tiny = Patch::new(octant().points().map(|row| row.map(|p| p * 1e-90))).unwrap();
        assert_close(tiny.normal(0.3, 1.0), DVec3::Z, 1e-12);
    }

    #[test]
    fn an_edge_collapsed_up_to_rounding_has_the_normal_of_the_pole() {
        let mut points = *octant().points();
        let mut random = Lcg::new(22);
        points[3]
            .iter_mut()
            .for_each(|p| *p += random.point() * 1e-13);
        let patch = Patch::new(points).unwrap();

        assert_close(patch.normal(0.3, 1.0), DVec3::Z, 1e-9);
    }

    #[test]
    fn patches_that_are_a_curve_or_a_line_or_a_point_have_no_normal() {
        let mut random = Lcg::new(23);
        let (p, d) = (random.point(), random.point());
        let point = [[p; 4]; 4];
        let line = point.map(|row| row.map(|p| p + d * random.unit()));
        let curve = [(); 4].map(|()| [random.point(); 4]);
        for points in [point, line, curve] {
            let patch = Patch::new(points).unwrap();
            for (u, v) in [(0.0, 0.0), (0.5, 1.0), (0.3, 0.6)] {
                assert_eq!(patch.normal(u, v), DVec3::ZERO);
            }
        }
    }
}
