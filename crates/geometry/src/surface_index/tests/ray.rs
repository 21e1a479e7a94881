//! Tests of rays through unconnected triangles and closed surfaces, and through edges and vertices.

use super::*;

/// Returns where the ray meets a triangle, computed in floating-point arithmetic: Möller, Trumbore, "Fast, Minimum
/// Storage Ray/Triangle Intersection", 1997.
fn plain(origin: DVec3, d: DVec3, t: &[DVec3; 3]) -> Option<f64> {
    let (ab, ac, at) = (t[1] - t[0], t[2] - t[0], origin - t[0]);
    let normal = d.cross(ac);
    let volume = ab.dot(normal);
    let (u, v) = (at.dot(normal) / volume, d.dot(at.cross(ab)) / volume);
    let along = ac.dot(at.cross(ab)) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along >= 0.0).then_some(along)
}

#[test]
fn rays_meet_the_triangles_that_brute_force_finds() {
    let mut random = Random(6);
    for round in 0..40 {
        let scale = [1.0, 1e-100, 1e100][round % 3];
        let mesh = soup(1 + 3 * round, || scale * random.point());
        let index = SurfaceIndex::new(&mesh).unwrap();
        for _ in 0..50 {
            let (origin, direction) = (scale * 2.0 * random.point(), scale * random.point());
            let mut expected: Vec<(f64, u32)> = (0..)
                .zip(&index.positions)
                .filter_map(|(i, t)| {
                    Some((
                        plain(origin / scale, direction / scale, &t.map(|p| p / scale))?,
                        i,
                    ))
                })
                .collect();
            expected.sort_by(|a, b| a.0.total_cmp(&b.0));
            let found = index.ray_all(origin, direction);
            assert_eq!(found.len(), expected.len());
            for (hit, (t, i)) in found.iter().zip(expected) {
                assert!(
                    hit.triangle == i && (hit.t - t).abs() < 1e-9 * (1.0 + t),
                    "{hit:?} {t}"
                );
                let triangle = index.triangle(i);
                let [a, b, c] = triangle.positions.map(|p| p / scale);
                assert_eq!(
                    hit.is_front,
                    (b - a).cross(c - a).dot(direction / scale) < 0.0
                );
                assert!(hit.point.distance(origin + t * direction) < 1e-9 * scale * (1.0 + t));
                assert_eq!(hit.point, triangle.point(hit.weights));
            }
            assert_eq!(index.ray(origin, direction), found.first().copied());
            let batch = index
                .first_hits(&[[origin, direction]; 2], &NoProgress)
                .unwrap();
            assert_eq!(batch, [found.first().copied(); 2]);
        }
    }
}

/// Returns how often the ray enters the solid, minus how often the ray leaves the solid. Also returns the number of all
/// hits.
fn passages(index: &SurfaceIndex, origin: DVec3, direction: DVec3) -> (i64, usize) {
    let hits = index.ray_all(origin, direction);
    let inward = hits
        .iter()
        .map(|hit| if hit.is_front { 1 } else { -1 })
        .sum();
    (inward, hits.len())
}

#[test]
fn rays_at_vertices_and_edges_of_closed_surfaces_pass_as_often_inward_as_outward() {
    let torus = shapes::torus(24, 12, 2.0, 0.7);
    for mesh in [
        shapes::cube(),
        shapes::octahedron(),
        shapes::icosahedron(),
        shapes::uv_sphere(16, 8),
        torus,
    ] {
        let index = SurfaceIndex::new(&mesh).unwrap();
        let vertices: Vec<DVec3> = mesh.vertices().map(|v| mesh.position(v)).collect();
        let mut targets = vertices.clone();
        targets.extend(mesh.edges().map(|e| {
            let [v, w] = mesh.edge_vertices(e);
            mesh.position(v).midpoint(mesh.position(w))
        }));
        let mut n = 0;
        for origin in [
            DVec3::new(4.0, 0.0, 0.0),
            DVec3::new(5.0, 5.0, 5.0),
            DVec3::new(0.0, -6.0, 1.0),
            DVec3::new(3.0, 4.0, 0.1),
        ] {
            for target in &targets {
                let (inward, all) = passages(&index, origin, *target - origin);
                assert_eq!((inward, all % 2), (0, 0), "{origin} {target}");
                n += all;
            }
            // These rays are parallel to the axes. They lie in the planes of faces, and pass through edges and
            // vertices.
            for axis in DVec3::AXES {
                for v in &vertices {
                    for direction in [axis, -axis] {
                        assert_eq!(passages(&index, *v - 10.0 * direction, direction).0, 0);
                    }
                }
            }
        }
        assert!(n > targets.len());
    }
}

#[test]
fn rays_from_inside_a_closed_surface_always_leave_it() {
    let mut random = Random(8);
    let mesh = shapes::uv_sphere(60, 40);
    let index = SurfaceIndex::new(&mesh).unwrap();
    for v in mesh.vertices() {
        let origin = 0.5 * random.point();
        let direction = mesh.position(v) - origin;
        let hits = index.ray_all(origin, direction);
        assert_eq!(hits.len(), 1, "{origin}");
        assert!(!hits[0].is_front && (hits[0].t - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_ray_without_direction_meets_nothing() {
    let index = SurfaceIndex::new(&shapes::cube()).unwrap();
    for direction in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
        assert_eq!(index.ray(DVec3::ZERO, direction), None);
    }
    assert_eq!(index.ray(DVec3::NAN, DVec3::X), None);
    // The first ray starts in front of the surface and points away from it. The second ray starts on the surface.
    assert_eq!(index.ray(DVec3::new(2.0, 0.0, 0.0), DVec3::X), None);
    assert_eq!(
        index.ray(DVec3::new(1.0, 0.3, 0.2), DVec3::X).unwrap().t,
        0.0
    );
}
