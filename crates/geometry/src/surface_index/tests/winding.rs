//! Compares winding numbers with known values and with sums over all triangles.

use std::f64::consts::PI;

use super::*;

/// Returns the sum of the solid angles of all triangles, divided by 4π.
fn exact(index: &SurfaceIndex, p: DVec3) -> f64 {
    let angle = |t: &[DVec3; 3]| {
        let [a, b, c] = t.map(|q| q - p);
        let [u, v, w] = [a, b, c].map(DVec3::length);
        let volume = a.dot(b.cross(c));
        2.0 * libm::atan2(
            volume,
            u * v * w + a.dot(b) * w + b.dot(c) * u + c.dot(a) * v,
        )
    };
    index.positions.iter().map(angle).sum::<f64>() / (4.0 * PI)
}

#[test]
fn a_winding_number_is_near_the_sum_of_all_solid_angles() {
    let mut random = Random(9);
    let mut meshes = vec![
        shapes::torus(80, 40, 1.0, 0.4),
        shapes::uv_sphere(60, 40),
        shapes::grid(40, 40),
    ];
    meshes.extend((0..10).map(|i| soup(40 * i + 1, || random.point())));
    meshes.extend((0..10).map(|i| {
        let (mut k, mut center) = (0, DVec3::ZERO);
        soup(200 * i + 1, || {
            if k % 3 == 0 {
                center = random.point();
            }
            k += 1;
            center + 0.1 * random.point()
        })
    }));
    let mut largest = 0.0_f64;
    for mesh in meshes {
        let index = SurfaceIndex::new(&mesh).unwrap();
        let winding = Winding::new(&index, &NoProgress).unwrap();
        for _ in 0..400 {
            let p = 1.5 * random.point();
            largest = largest.max((winding.at(p) - exact(&index, p)).abs());
        }
    }
    assert!(largest < 0.01, "{largest}");
}

#[test]
fn the_sign_is_right_for_closed_surfaces_and_any_scale() {
    let mut random = Random(10);
    for scale in [1.0, 1e-150, 1e150] {
        let mut mesh = shapes::torus(120, 60, 1.0, 0.4);
        for p in mesh.positions_mut() {
            *p *= scale;
        }
        let index = SurfaceIndex::new(&mesh).unwrap();
        let winding = Winding::new(&index, &NoProgress).unwrap();
        let points: Vec<DVec3> = (0..2000).map(|_| 1.5 * random.point()).collect();
        let scaled: Vec<DVec3> = points.iter().map(|p| scale * *p).collect();
        let numbers = winding.at_points(&scaled, &NoProgress).unwrap();
        for (p, w) in points.iter().zip(numbers) {
            let from_circle = libm::hypot(p.truncate().length() - 1.0, p.z);
            if (from_circle - 0.4).abs() > 2e-3 {
                let expected = if from_circle < 0.4 { 1.0 } else { 0.0 };
                assert!((w - expected).abs() < 0.01, "{p} {w}");
                assert_eq!(winding.contains(scale * *p), from_circle < 0.4);
            }
        }
    }
}

#[test]
fn a_point_on_a_face_has_the_mean_of_both_sides() {
    let index = SurfaceIndex::new(&shapes::cube()).unwrap();
    let winding = Winding::new(&index, &NoProgress).unwrap();
    assert!((winding.at(DVec3::new(1.0, 0.3, 0.2)) - 0.5).abs() < 1e-12);
    assert!((winding.at(DVec3::new(0.9, 0.3, 0.2)) - 1.0).abs() < 1e-12);
    for far in [
        DVec3::NAN,
        DVec3::INFINITY,
        DVec3::splat(1e300),
        DVec3::splat(1e10),
    ] {
        assert!(winding.at(far).abs() < 1e-12);
    }
}
