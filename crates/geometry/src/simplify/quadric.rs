//! Quadrics: quadratic functions of a point, for example the sum of the squared distances from the point to some
//! planes.

use std::ops::Add;

use mesh::DVec3;

/// A weighted sum of squared distances from a point p to planes: pᵀ A p + 2 b·p + c, with a symmetric matrix A.
/// Source: Garland, Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Quadric {
    /// The diagonal of A.
    diagonal: DVec3,
    /// The entries yz, xz and xy of A.
    mixed: DVec3,
    b: DVec3,
    c: f64,
}

impl Quadric {
    /// Returns the squared distance to the plane through `point` with the unit normal `n`, times `weight`.
    pub(super) fn plane(n: DVec3, point: DVec3, weight: f64) -> Self {
        Self::linear(n, -n.dot(point), weight)
    }

    /// Returns the square of the linear function g·p + `offset` of a point p, times `weight`.
    pub(super) fn linear(g: DVec3, offset: f64, weight: f64) -> Self {
        Self {
            diagonal: weight * g * g,
            mixed: weight * DVec3::new(g.y * g.z, g.x * g.z, g.x * g.y),
            b: (weight * offset) * g,
            c: weight * offset * offset,
        }
    }

    /// Returns the value of the quadric at `p`. The result is at least 0.
    pub(super) fn at(&self, p: DVec3) -> f64 {
        // Because of rounding, the computed value can be negative.
        at_least_zero((self.times(p) + 2.0 * self.b).dot(p) + self.c)
    }

    /// Returns the product of the matrix A and the vector `p`.
    fn times(&self, p: DVec3) -> DVec3 {
        let m = self.mixed;
        let mixed = DVec3::new(
            m.z * p.y + m.y * p.z,
            m.z * p.x + m.x * p.z,
            m.y * p.x + m.x * p.y,
        );
        self.diagonal * p + mixed
    }

    /// Returns the point with the lowest value. If the value is nearly as low at many other points, `weak` decides
    /// between these points: the result is a point at which `weak` is low too. `weak` is a quadric with small
    /// coefficients. Returns `None` if the sum of this quadric and `weak` has its lowest value at many points.
    pub(super) fn lowest(&self, weak: &Self) -> Option<DVec3> {
        let sum = *self + *weak;
        let inverse = sum.inverse()?;
        let solve = |p: DVec3| p.x * inverse[0] + p.y * inverse[1] + p.z * inverse[2];
        let lowest = -solve(sum.b);
        // The added quadric `weak` moves the lowest point of the sum a little away from the lowest point of this
        // quadric. One Newton step moves the point back. The step uses the gradient of this quadric and the matrix of
        // the sum. After this step, the point differs from the lowest point only in directions in which this quadric
        // hardly changes.
        Some(lowest - solve(self.times(lowest) + self.b))
    }

    /// Returns the columns of the inverse of A, or `None` if A is nearly singular.
    fn inverse(&self) -> Option<[DVec3; 3]> {
        let (d, m) = (self.diagonal, self.mixed);
        // The columns of the adjugate of A, which is a symmetric matrix like A.
        let x = DVec3::new(
            d.y * d.z - m.x * m.x,
            m.y * m.x - m.z * d.z,
            m.z * m.x - m.y * d.y,
        );
        let y = DVec3::new(x.y, d.x * d.z - m.y * m.y, m.z * m.y - d.x * m.x);
        let z = DVec3::new(x.z, y.z, d.x * d.y - m.z * m.z);
        let determinant = d.x * x.x + m.z * x.y + m.y * x.z;
        let trace = d.element_sum();
        (determinant > 1e-15 * trace * trace * trace)
            .then(|| [x, y, z].map(|column| column / determinant))
    }
}

impl Add for Quadric {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            diagonal: self.diagonal + other.diagonal,
            mixed: self.mixed + other.mixed,
            b: self.b + other.b,
            c: self.c + other.c,
        }
    }
}

/// The size of the part of the original surface that a vertex represents, and two integrals over this part. With these
/// numbers, the squared distance from any given point can be integrated over the part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spread {
    pub(super) area: f64,
    /// The integral of the position over the part of the surface.
    first: DVec3,
    /// The integral of the squared length of the position vector over the part of the surface.
    second: f64,
}

impl Spread {
    /// Returns the [`Spread`] of an area that is concentrated at one point.
    pub(super) fn at_point(point: DVec3, area: f64) -> Self {
        Self {
            area,
            first: area * point,
            second: area * point.length_squared(),
        }
    }

    /// Returns the integral of the squared distance from `p` over the area. The result is at least 0.
    pub(super) fn at(&self, p: DVec3) -> f64 {
        at_least_zero((self.area * p - 2.0 * self.first).dot(p) + self.second)
    }

    /// Returns the integral of the squared distance, times `weight`, as a quadric.
    pub(super) fn quadric(&self, weight: f64) -> Quadric {
        Quadric {
            diagonal: DVec3::splat(weight * self.area),
            mixed: DVec3::ZERO,
            b: -weight * self.first,
            c: weight * self.second,
        }
    }
}

impl Add for Spread {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
}

fn at_least_zero(value: f64) -> f64 {
    if value > 0.0 { value } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn a_quadric_is_the_sum_of_squared_distances(
            planes in proptest::collection::vec((point(), point(), 0.1..2.0), 1..6), p in point(),
        ) {
            let (mut sum, mut quadric) = (0.0, Quadric::default());
            for (n, q, weight) in planes {
                let n = n.normalize_or(DVec3::X);
                sum += weight * n.dot(p - q) * n.dot(p - q);
                quadric = quadric + Quadric::plane(n, q, weight);
            }
            prop_assert!((quadric.at(p) - sum).abs() < 1e-12);
        }

        #[test]
        fn no_point_is_below_the_lowest(
            planes in proptest::collection::vec((point(), point()), 3..6), p in point(),
        ) {
            let quadric = planes.into_iter().fold(Quadric::default(), |sum, (n, q)| {
                sum + Quadric::plane(n.normalize_or(DVec3::X), q, 1.0)
            });
            if let Some(lowest) = quadric.lowest(&Quadric::default()) && lowest.length() < 10.0 {
                prop_assert!(quadric.at(lowest) <= quadric.at(p) + 1e-9);
            }
        }

        #[test]
        fn a_spread_is_the_integral_of_squared_distances(a in point(), b in point(), p in point()) {
            let spread = Spread::at_point(a, 2.0) + Spread::at_point(b, 0.5);
            let expected = 2.0 * p.distance_squared(a) + 0.5 * p.distance_squared(b);
            prop_assert!((spread.at(p) - expected).abs() < 1e-12);
            prop_assert!((spread.quadric(3.0).at(p) - 3.0 * expected).abs() < 1e-12);
        }
    }

    #[test]
    fn parallel_planes_have_no_lowest_point() {
        let planes =
            Quadric::plane(DVec3::Z, DVec3::ZERO, 1.0) + Quadric::plane(DVec3::Z, DVec3::Z, 1.0);
        let none = Quadric::default();
        assert_eq!(planes.lowest(&none), None);
        assert_eq!(none.lowest(&none), None);
    }

    #[test]
    fn a_weak_quadric_decides_only_between_equal_points() {
        let near = DVec3::new(3.0, 4.0, 5.0);
        let weak = Spread::at_point(near, 1.0).quadric(1e-6);
        // The planes x = 1 and y = 2 meet in a line, which is parallel to the z axis.
        let planes =
            Quadric::plane(DVec3::X, DVec3::X, 1.0) + Quadric::plane(DVec3::Y, 2.0 * DVec3::Y, 1.0);
        let lowest = planes.lowest(&weak).unwrap();
        assert!(
            lowest.distance(DVec3::new(1.0, 2.0, 5.0)) < 1e-10,
            "{lowest}"
        );
    }
}
