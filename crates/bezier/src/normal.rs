//! Normals where the derivatives of a patch vanish or are parallel.
//!
//! ```text
//!      v = 1                The pole of a surface of revolution is a whole edge of the patch
//!        *                  that is one point. Along it du = 0, so du x dv = 0, and yet the
//!       /|\   lines of      surface has a normal there: the one that du x dv points along as
//!      / | \  equal u       v comes near the edge.
//!     /  |  \
//!    *---+---*  v = 0
//! ```
//!
//! Let N = du x dv, a polynomial in u and v. Walk from the point in a straight line into the
//! patch, (u + e a, v + e b) for small e > 0. On the way N is a polynomial in e:
//!
//! ```text
//! N(e) = N0 + e N1 + e² N2 + ...      N(e) / |N(e)|  ->  Nk / |Nk|  as e goes to 0,
//! ```
//!
//! where Nk is the first coefficient that is not zero. At a regular point that is N0 = du x dv
//! itself. On a collapsed edge v = 0, where du = 0 all along, it is N1 = duv x dv with the mixed
//! derivative duv, the direction in which du leaves zero; on the edge v = 1 the way in is b = -1,
//! and N1 = -duv x dv. Collapsed corners and edges that collapse to a higher order need N2 and
//! beyond. N has degree 5 in u and in v, so N10 is the last.
//!
//! The way in is straight across the edge, or along the diagonal from a corner. If the limit
//! exists, every way gives it. If it does not (the tip of a cone seen from a corner patch, a
//! cusp), the answer is the limit along this way. If N is zero all along this way, two more ways
//! beside it are tried; if N is zero there too, there is no normal.
//!
//! "Zero" means below [`VANISHING`] when derivatives are measured by the largest difference of
//! neighboring control points, along u and along v each by its own, so that long thin
//! patches and tiny ones have their normals.

use glam::{DVec2, DVec3};

use crate::patch::size;

/// Below this, a coefficient of the scaled normal counts as zero.
///
/// Well above the rounding of the coefficients (1e-14), and above what an edge that is collapsed
/// only within the tolerance of [`tessellate`](crate::tessellate()) leaves. So close to a pole
/// (1e-10 of the patch), the next coefficient is the better answer anyway.
pub const VANISHING: f64 = 1e-10;

/// The limit of the normals on the way into the patch from `at`, if there is one.
///
/// `c` holds the Taylor coefficients of the patch there, c\[i\]\[j\] that of x^i y^j; `reach` is
/// the size of differences along u and v, neither of them zero.
pub(crate) fn limit(c: &[[DVec3; 4]; 4], reach: DVec2, at: DVec2) -> Option<DVec3> {
    ways_in(at)
        .into_iter()
        .find_map(|way| limit_along(c, reach, way))
}

/// `n` scaled to length 1, unless it counts as zero or is not finite.
pub(crate) fn unit(n: DVec3) -> Option<DVec3> {
    let size = size(n);
    (size > VANISHING && n.is_finite()).then(|| (n / size).normalize())
}

/// Three directions in (u, v) that lead from `at` into the patch, the best one first.
fn ways_in(at: DVec2) -> [DVec2; 3] {
    let on_edge = |t: f64| t <= 0.0 || t >= 1.0;
    let inward = |t: f64| if t > 0.5 { -1.0 } else { 1.0 };
    let way = match (on_edge(at.x), on_edge(at.y)) {
        (true, false) => DVec2::new(inward(at.x), 0.0),
        (false, true) => DVec2::new(0.0, inward(at.y)),
        _ => DVec2::new(inward(at.x), inward(at.y)),
    };
    let beside = way.perp() * 0.5;
    [way, way + beside, way - beside]
}

/// The first coefficient of N along `way` that is not zero, scaled to length 1.
fn limit_along(c: &[[DVec3; 4]; 4], reach: DVec2, way: DVec2) -> Option<DVec3> {
    // The coefficients of du and dv on the way, by powers of e.
    let mut du = [DVec3::ZERO; 6];
    let mut dv = [DVec3::ZERO; 6];
    let (a, b) = (powers(way.x), powers(way.y));
    for i in 0..4 {
        for j in 0..4 {
            if i > 0 {
                du[i - 1 + j] += c[i][j] * (i as f64 * a[i - 1] * b[j] / reach.x);
            }
            if j > 0 {
                dv[i + j - 1] += c[i][j] * (j as f64 * a[i] * b[j - 1] / reach.y);
            }
        }
    }
    (0..=10_usize).find_map(|k| {
        let pairs = k.saturating_sub(5)..=k.min(5);
        unit(pairs.map(|i| du[i].cross(dv[k - i])).sum())
    })
}

/// 1, x, x², x³.
fn powers(x: f64) -> [f64; 4] {
    [1.0, x, x * x, x * x * x]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Patch;
    use crate::fixtures::{Lcg, assert_close, octant, quarter_turn, squared};

    /// Every normal of the boundary is the limit of normals inside, along the way across the edge
    /// and along a slanted one.
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

    /// The patch walked in all eight ways: reversed in u, in v, and transposed.
    fn all_ways(patch: &Patch) -> Vec<Patch> {
        let mut ways = vec![*patch];
        let reversed_u = |p: &Patch| {
            let mut points = *p.points();
            for row in &mut points {
                row.reverse();
            }
            Patch::new(points).unwrap()
        };
        ways.push(reversed_u(patch));
        ways.extend(ways.clone().iter().map(Patch::transposed));
        ways.extend(ways.clone().iter().map(reversed_u));
        ways
    }

    #[test]
    fn the_pole_of_a_sphere_has_its_axis_as_normal() {
        for u in [0.0, 0.3, 0.5, 1.0] {
            assert_close(octant().normal(u, 1.0), DVec3::Z, 1e-12);
            assert_close(octant().transposed().normal(1.0, u), -DVec3::Z, 1e-12);
        }
    }

    #[test]
    fn normals_of_a_collapsed_edge_are_limits() {
        // A lid whose first and third rows are points, as that of the teapot, and a bottom.
        let lid = quarter_turn([[0.0, 3.15], [0.8, 3.15], [0.0, 2.85], [0.2, 2.7]]);
        let bottom = quarter_turn([[0.0, 0.0], [1.4, 0.0], [1.5, 0.1], [1.5, 0.2]]);
        for patch in [octant(), lid, bottom] {
            all_ways(&patch).iter().for_each(assert_normals_are_limits);
        }
    }

    #[test]
    fn a_pole_that_collapses_twice_has_a_normal() {
        // Two rows are one point: du and dv both vanish on the edge.
        let patch = quarter_turn([[0.0, 1.0], [0.0, 1.0], [1.0, 1.0], [2.0, 0.5]]);
        for way in all_ways(&patch) {
            assert_normals_are_limits(&way);
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
        all_ways(&patch).iter().for_each(assert_normals_are_limits);
    }

    #[test]
    fn a_corner_with_parallel_derivatives_has_a_normal() {
        // A plane patch whose corner (0, 0) is a straight angle.
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
    fn thin_tiny_and_huge_patches_have_their_normals() {
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
    fn an_edge_collapsed_within_rounding_has_the_normal_of_the_pole() {
        let mut points = *octant().points();
        let mut random = Lcg::new(22);
        points[3]
            .iter_mut()
            .for_each(|p| *p += random.point() * 1e-13);
        let patch = Patch::new(points).unwrap();

        assert_close(patch.normal(0.3, 1.0), DVec3::Z, 1e-9);
    }

    #[test]
    fn a_curve_and_a_line_and_a_point_have_no_normal() {
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
