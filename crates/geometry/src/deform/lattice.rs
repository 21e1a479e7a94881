//! A box of control points.

use mesh::DVec3;

/// A box whose control points are moved. Let (s, t, u) be the coordinates of a point in the box, from 0 to 1. The point
/// moves by the weighted sum of the offsets of all control points. The weight of the control point (i, j, k) is
/// B(i, s) B(j, t) B(k, u), where B are the Bernstein polynomials. Source: Sederberg, Parry, "Free-Form Deformation of
/// Solid Geometric Models", 1986. Points outside the box do not move.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    /// The corner of the box with the smallest coordinates.
    pub min: DVec3,
    /// The corner of the box with the largest coordinates.
    pub max: DVec3,
    /// The number of control points along x, y and z. Each of these numbers is at least 1.
    pub size: [usize; 3],
    /// The vectors by which the control points are moved. The offset of the control point (i, j, k) has the index
    /// `(i * size[1] + j) * size[2] + k`.
    pub offsets: Vec<DVec3>,
}

impl Lattice {
    /// Returns the new position of a point.
    pub fn point(&self, p: DVec3) -> DVec3 {
        if p.cmplt(self.min).any() || p.cmpgt(self.max).any() {
            return p;
        }
        let extent = self.max - self.min;
        // In a direction in which the box has no extent, the coordinate is 0.
        let part = |i: usize| {
            if extent[i] > 0.0 {
                (p[i] - self.min[i]) / extent[i]
            } else {
                0.0
            }
        };
        let [x, y, z] = [0, 1, 2].map(|i| bernstein(self.size[i], part(i)));
        let mut offsets = self.offsets.iter();
        let mut sum = DVec3::ZERO;
        for a in &x {
            for b in &y {
                for c in &z {
                    sum += a * b * c * offsets.next().copied().unwrap_or_default();
                }
            }
        }
        p + sum
    }
}

/// Returns the values of the `n` Bernstein polynomials of degree n - 1 at `t`, by de Casteljau's recursion.
fn bernstein(n: usize, t: f64) -> Vec<f64> {
    let mut values = vec![0.0; n];
    values[0] = 1.0;
    for degree in 1..n {
        for i in (1..=degree).rev() {
            values[i] = (1.0 - t) * values[i] + t * values[i - 1];
        }
        values[0] *= 1.0 - t;
    }
    values
}
