//! Exact geometric predicates.
//!
//! The results are the same as with exact arithmetic on the given coordinates. Source: Shewchuk, "Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, as implemented by the crate `robust`. The
//! results are exact if the products of the differences of coordinates neither overflow nor underflow. No product
//! overflows or underflows if the absolute value of every coordinate is 0 or between 1e-90 and 1e90.

use std::cmp::Ordering;

use mesh::{DVec2, DVec3};

/// Returns on which side of the line from `a` to `b` the point `c` lies: `Greater` on the left, `Less` on the right,
/// `Equal` on the line. The result is the sign of the signed area of the triangle `a`, `b`, `c`.
pub fn orient2d(a: DVec2, b: DVec2, c: DVec2) -> Ordering {
    let coord = |p: DVec2| robust::Coord { x: p.x, y: p.y };
    sign(robust::orient2d(coord(a), coord(b), coord(c)))
}

/// Returns on which side of the plane through `a`, `b` and `c` the point `d` lies: `Greater` on the side of the normal
/// (b − a) × (c − a), `Less` on the other side, `Equal` on the plane. The result is the sign of the signed volume of
/// the tetrahedron with these four corners.
pub fn orient3d(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> Ordering {
    let coord = |p: DVec3| robust::Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    // The sign is reversed, because `robust::orient3d` returns the opposite sign.
    sign(-robust::orient3d(coord(a), coord(b), coord(c), coord(d)))
}

/// Returns the sign of a number, or `Equal` for NaN. NaN occurs only if coordinates are not finite or products
/// overflow.
fn sign(x: f64) -> Ordering {
    x.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_are_those_of_counter_clockwise_triangles() {
        let [o, x, y] = [DVec2::ZERO, DVec2::X, DVec2::Y];
        assert_eq!(orient2d(o, x, y), Ordering::Greater);
        assert_eq!(orient2d(o, y, x), Ordering::Less);
        let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        assert_eq!(orient3d(o, x, y, z), Ordering::Greater);
        assert_eq!(orient3d(o, y, x, z), Ordering::Less);
        assert_eq!(orient3d(o, x, y, x + y), Ordering::Equal);
    }

    /// Ordinary floating-point arithmetic would put many points that are very near a line or plane on the wrong side.
    #[test]
    fn points_next_to_a_line_and_a_plane_are_on_their_sides() {
        let ulp = f64::EPSILON / 2.0;
        for i in 0..64_u32 {
            for j in 0..64_u32 {
                let (x, y) = (0.5 + f64::from(i) * ulp, 0.5 + f64::from(j) * ulp);
                let expected = j.cmp(&i);
                let line = [DVec2::splat(12.0), DVec2::splat(24.0)];
                assert_eq!(orient2d(line[0], line[1], DVec2::new(x, y)), expected);
                let plane = [12.0, 24.0].map(DVec3::splat);
                let up = DVec3::new(12.0, 12.0, 24.0);
                let d = DVec3::new(x, y, 0.125);
                assert_eq!(orient3d(plane[0], plane[1], up, d), expected.reverse());
            }
        }
    }
}
