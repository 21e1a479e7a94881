//! Measures of the shape of faces.

use std::f64::consts::PI;

use mesh::{FaceId, Mesh};

/// Returns the smallest corner angle of a face, in radians: π / 3 for an equilateral triangle, nearly 0 for a very thin
/// triangle.
pub fn min_angle(mesh: &Mesh, f: FaceId) -> f64 {
    let angles = mesh.face_half_edges(f).map(|h| mesh.corner_angle(h));
    angles.fold(f64::INFINITY, f64::min)
}

/// Returns the aspect ratio of a face: 1 for regular polygons, and greater than 1 for all other faces. The ratio is
/// infinite if the area of the face is zero.
///
/// The ratio is l p / (4 a tan(π / n)) for a face with n corners, the longest edge l, the perimeter p and the area a.
/// For triangles and quads, the result is the aspect ratio of Stimpson, Ernst, Knupp, Pébay, Thompson, "The Verdict
/// Geometric Quality Library", 2007.
pub fn aspect_ratio(mesh: &Mesh, f: FaceId) -> f64 {
    let (mut longest, mut perimeter, mut n): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for h in mesh.face_half_edges(f) {
        let length = mesh.length(h);
        longest = longest.max(length);
        perimeter += length;
        n += 1.0;
    }
    let area = mesh.face_area(f);
    let ratio = longest * (perimeter / area) / (4.0 * libm::tan(PI / n));
    if ratio.is_nan() { f64::INFINITY } else { ratio }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use mesh::DVec3;

    fn polygon(points: &[[f64; 2]]) -> Mesh {
        let points: Vec<DVec3> = points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
        let corners: Vec<u32> = (0..).take(points.len()).collect();
        Mesh::from_polygons(points, &[corners]).unwrap().0
    }

    #[test]
    fn regular_polygons_have_an_aspect_ratio_of_one() {
        for mesh in [shapes::icosahedron(), shapes::cube(), shapes::octahedron()] {
            for f in mesh.faces() {
                assert!((aspect_ratio(&mesh, f) - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn stretched_faces_have_a_large_aspect_ratio_and_faces_without_area_an_infinite_one() {
        // The longest edge is 4, the perimeter is 10, and the area is 4. tan(pi / 4) is 1. So the ratio is 4 * 10 /
        // (4 * 4) = 2.5.
        let long = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0]]);
        assert!((aspect_ratio(&long, FaceId::new(0)) - 2.5).abs() < 1e-12);
        assert!((min_angle(&long, FaceId::new(0)) - 0.5 * PI).abs() < 1e-12);
        let thin = polygon(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1e-3]]);
        assert!(aspect_ratio(&thin, FaceId::new(0)) > 500.0);
        assert!(min_angle(&thin, FaceId::new(0)) < 0.003);
        for flat in [[2.0, 0.0], [0.0, 0.0]] {
            let flat = polygon(&[[0.0, 0.0], [1.0, 0.0], flat]);
            assert_eq!(aspect_ratio(&flat, FaceId::new(0)), f64::INFINITY);
            assert_eq!(min_angle(&flat, FaceId::new(0)), 0.0);
        }
    }
}
