//! Compares distances with known values and with many samples.

use crate::{bounds, shapes};

use super::*;
use crate::surface_index::triangle::nearest_on_triangle;

fn of(positions: &[DVec3], polygons: &[&[u32]]) -> Mesh {
    Mesh::from_polygons(positions.to_vec(), polygons).unwrap().0
}

fn moved(mut mesh: Mesh, by: impl Fn(DVec3) -> DVec3) -> Mesh {
    for p in mesh.positions_mut() {
        *p = by(*p);
    }
    mesh
}

#[track_caller]
fn between(a: &Mesh, b: &Mesh, tolerance: f64) -> Distance {
    let found = Distance::between(a, b, Some(tolerance)).unwrap();
    let (largest, at_most) = (found.largest(), found.at_most());
    let most = (largest + tolerance) * (1.0 + 1e-12);
    assert!(largest <= at_most && at_most <= most, "{found:?}");
    assert!(found.mean() <= largest * (1.0 + 1e-12));
    found
}

/// Returns the largest distance from sample points on `a` to `b`. The sample points form a grid on each triangle of
/// `a`, with `rows` + 1 points along each side.
fn sampled_distance(a: &Mesh, b: &Mesh, rows: u32) -> f64 {
    let mut largest = 0.0_f64;
    let triangles_of = |mesh: &Mesh| {
        let corners = mesh
            .faces()
            .map(|f| mesh.face_vertices(f).map(|v| mesh.position(v)));
        let fan = |c: Vec<DVec3>| (2..c.len()).map(move |i| [c[0], c[i - 1], c[i]]);
        corners.flat_map(|c| fan(c.collect())).collect::<Vec<_>>()
    };
    let triangles = triangles_of(b);
    for t in triangles_of(a) {
        for i in 0..=rows {
            for j in 0..=rows - i {
                let (u, v) = (
                    f64::from(i) / f64::from(rows),
                    f64::from(j) / f64::from(rows),
                );
                let p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
                let distance = |t| p.distance(nearest_on_triangle(p, t));
                let nearest = triangles.iter().map(distance).fold(f64::INFINITY, f64::min);
                largest = largest.max(nearest);
            }
        }
    }
    largest
}

#[test]
fn a_search_near_a_face_with_many_corners_visits_few_nodes() {
    let n = 5000_u32;
    let at = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        // The face is rotated, so that it is not parallel to a side of its bounding box.
        let [x, y] = [libm::cos(angle), libm::sin(angle)];
        DVec3::new(x, 0.8 * y, 0.6 * y)
    };
    let corners: Vec<u32> = (0..n).collect();
    let disk = of(&(0..n).map(at).collect::<Vec<_>>(), &[&corners]);
    let index = SurfaceIndex::new(&disk).unwrap();
    let points = (0..n).flat_map(|i| [1.0, 0.9, 0.3].map(|r| r * at(i) + 0.1 * DVec3::Z));
    let visits = points.map(|p| index.nearest(p, 0).visits).max().unwrap();
    // If the face were triangulated by ear clipping, most searches would visit more than a thousand nodes.
    assert!(visits < 200, "{visits}");
    let lifted = moved(disk.clone(), |p| p + 0.1 * DVec3::new(0.0, -0.6, 0.8));
    let found = between(&disk, &lifted, 1e-9);
    assert!((found.largest() - 0.1).abs() < 1e-9, "{found:?}");
    assert!((found.mean() - 0.1).abs() < 1e-9, "{found:?}");
}

#[test]
fn a_mesh_has_distance_zero_to_itself() {
    for mesh in [
        shapes::icosahedron(),
        shapes::cube(),
        shapes::torus(30, 20, 2.0, 1.0),
    ] {
        let found = between(&mesh, &mesh, 1e-9);
        assert!(found.at_most() < 1e-14 && found.mean() < 1e-14, "{found:?}");
    }
}

#[test]
fn the_distance_of_parallel_sheets_does_not_depend_on_their_faces() {
    let plane = shapes::grid(9, 7);
    let shifted = moved(shapes::grid(9, 7), |p| p + DVec3::new(0.0, 0.0, 0.25));
    let found = between(&plane, &shifted, 1e-9);
    assert_eq!(
        (found.largest(), found.at_most(), found.mean()),
        (0.25, 0.25, 0.25)
    );
    let size = bounds(&plane).unwrap()[1];
    let other = moved(shapes::grid(31, 2), |p| {
        let unit = p / bounds(&shapes::grid(31, 2)).unwrap()[1].max(DVec3::splat(1e-9));
        DVec3::new(unit.x * size.x, unit.y * size.y, 1e-3)
    });
    let found = between(&plane, &other, 1e-9);
    assert!((found.largest() - 1e-3).abs() < 1e-12, "{found:?}");
    assert!((found.mean() - 1e-3).abs() < 1e-12, "{found:?}");
}

#[test]
fn the_distance_of_concentric_spheres_is_the_difference_of_radii() {
    let sphere = |radius: f64, around| moved(shapes::uv_sphere(around, around / 2), |p| p * radius);
    let found = between(&sphere(1.0, 64), &sphere(1.5, 48), 1e-4);
    // The edges of the polyhedra are chords of the spheres, so the polyhedra lie inside the spheres.
    assert!(
        found.largest() > 0.49 && found.at_most() < 0.505,
        "{found:?}"
    );
    assert!(found.mean() > 0.49 && found.mean() < 0.505);
}

#[test]
fn a_spike_over_the_inside_of_a_large_face_is_found() {
    // The tip of a spike is above a point of the square that is neither a vertex nor the center.
    let foot = DVec3::new(0.31, 0.17, 0.0);
    let square = shapes::square();
    let mut positions: Vec<DVec3> = square.vertices().map(|v| square.position(v)).collect();
    positions.push(foot + DVec3::Z);
    let spike = of(
        &positions,
        &[&[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]],
    );
    let found = between(&square, &spike, 1e-6);
    // The tip of the spike is at height 1 above the square.
    assert!((found.back.largest - 1.0).abs() < 1e-6, "{found:?}");
    assert_eq!(found.back.from.on, Element::Vertex(VertexId::new(4)));
    assert!(found.back.to.position.distance(foot) < 1e-12);
    // The point of the square that is furthest from the spike lies inside the square.
    let sampled = sampled_distance(&square, &spike, 400);
    assert!(found.forth.largest >= sampled - 1e-6 && found.forth.at_most >= sampled);
    assert!(found.forth.largest < sampled + 0.01, "{found:?} {sampled}");
    assert!(matches!(found.forth.from.on, Element::Face(_)), "{found:?}");
}

#[test]
fn a_fold_below_no_vertex_or_center_is_found() {
    // The folded surface goes down to z = -3 below a side of the flat triangle, between the vertices of this side.
    let flat = of(
        &[
            DVec3::ZERO,
            DVec3::new(10.0, 0.0, 0.0),
            DVec3::new(0.0, 10.0, 0.0),
        ],
        &[&[0, 1, 2]],
    );
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let folded = of(
        &[
            at(0.0, 0.0, 0.0),
            at(1.7, 0.0, 0.0),
            at(1.9, 0.0, -3.0),
            at(2.1, 0.0, 0.0),
            at(10.0, 0.0, 0.0),
            at(0.0, 10.0, 0.0),
        ],
        &[&[0, 1, 5], &[1, 2, 5], &[2, 3, 5], &[3, 4, 5]],
    );
    let found = between(&flat, &folded, 1e-5);
    assert_eq!(found.back.largest, 3.0);
    let sampled = sampled_distance(&flat, &folded, 500);
    assert!(found.forth.at_most >= sampled, "{found:?} {sampled}");
    assert!(found.forth.largest < sampled + 0.02, "{found:?} {sampled}");
}

#[test]
fn the_bounds_hold_for_randomly_deformed_meshes() {
    // A fixed pseudo-random sequence.
    let mut state = 1_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 24) - 0.5
    };
    for round in 0..12 {
        let (a, b) = match round % 4 {
            0 => (shapes::cube(), shapes::icosahedron()),
            1 => (shapes::tetrahedron(), shapes::octahedron()),
            2 => (shapes::grid(3, 2), shapes::grid(2, 4)),
            _ => (shapes::torus(5, 4, 2.0, 1.0), shapes::cube()),
        };
        let mut push = |mesh: Mesh| {
            let mut mesh = mesh;
            for p in mesh.positions_mut() {
                *p += DVec3::new(next(), next(), next());
            }
            mesh
        };
        let (a, b) = (push(a), push(b));
        let found = between(&a, &b, 1e-4);
        for (side, sampled) in [
            (&found.forth, sampled_distance(&a, &b, 40)),
            (&found.back, sampled_distance(&b, &a, 40)),
        ] {
            assert!(
                side.at_most >= sampled - 1e-12,
                "{round}: {side:?} {sampled}"
            );
            // Neighboring samples are a fortieth of a side apart.
            assert!(
                side.largest <= sampled + 0.12,
                "{round}: {side:?} {sampled}"
            );
            let length = side.from.position.distance(side.to.position);
            assert!((length - side.largest).abs() < 1e-12, "{side:?}");
        }
    }
}

#[test]
fn distances_are_the_same_bits_for_any_number_of_threads() {
    let a = shapes::torus(90, 60, 2.0, 1.0);
    let b = moved(shapes::torus(70, 80, 2.0, 1.0), |p| {
        p + DVec3::new(0.01, 0.02, 0.03)
    });
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| Distance::between(&a, &b, None).unwrap())
    };
    assert_eq!(with(1), with(7));
}

#[test]
fn meshes_without_faces_have_no_distance() {
    let points = of(&[DVec3::ZERO, DVec3::X], &[]);
    assert_eq!(Distance::between(&points, &shapes::cube(), None), None);
    assert_eq!(Distance::between(&shapes::cube(), &points, None), None);
}

#[test]
fn faces_without_area_are_treated_as_segments_and_points() {
    let line = of(&[DVec3::ZERO, DVec3::X, 0.5 * DVec3::X], &[&[0, 1, 2]]);
    let lifted = moved(line.clone(), |p| p + DVec3::Z);
    let found = between(&line, &lifted, 1e-9);
    assert_eq!((found.largest(), found.mean()), (1.0, 1.0));
    let point = moved(line.clone(), |_| DVec3::Y);
    let found = between(&line, &point, 1e-9);
    assert!((found.largest() - 2.0_f64.sqrt()).abs() < 1e-9, "{found:?}");
}

#[test]
fn vertices_without_faces_are_measured_too() {
    let a = of(
        &[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.0, 0.0, 5.0)],
        &[&[0, 1, 2]],
    );
    let b = of(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[&[0, 1, 2]]);
    let found = between(&a, &b, 1e-9);
    assert_eq!(found.forth.largest, 5.0);
    assert_eq!(found.forth.from.on, Element::Vertex(VertexId::new(3)));
    assert!(found.back.largest < 1e-15);
}

#[test]
fn the_search_ends_for_coordinates_too_large_to_square() {
    let huge = moved(shapes::cube(), |p| p * 1e200);
    let found = Distance::between(&huge, &shapes::cube(), None).unwrap();
    assert!(found.largest() > 1e150);
}

#[test]
fn the_bounds_hold_if_all_triangles_are_equally_near() {
    let around = shapes::uv_sphere(160, 80);
    let small = moved(shapes::uv_sphere(24, 12), |p| p * 1e-6);
    let found = Distance::between(&small, &around, None).unwrap();
    for side in [&found.forth, &found.back] {
        assert!(
            side.largest > 0.9 && side.largest <= side.at_most,
            "{side:?}"
        );
        assert!(side.at_most < 1.000_01, "{side:?}");
    }
}

#[test]
fn vertex_distances_are_those_of_each_vertex() {
    let (cube, mut moved) = (shapes::cube(), shapes::cube());
    for p in moved.positions_mut() {
        p.x += 0.25;
    }
    let distances = vertex_distances(&moved, &cube).unwrap();
    let expected = |v: VertexId| if moved.position(v).x > 1.0 { 0.25 } else { 0.0 };
    let is_right = |v: VertexId| (distances[v.index()] - expected(v)).abs() < 1e-12;
    assert!(moved.vertices().all(is_right), "{distances:?}");
    assert_eq!(vertex_distances(&cube, &Mesh::default()), None);
}

/// Returns a star that is a single face. The corners of the face lie alternately on two circles.
fn star(n: u32) -> Mesh {
    let corner = |i: u32| {
        let radius = 1.0 + 0.5 * f64::from(i % 2);
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(n));
        radius * DVec3::new(cos, sin, 0.0)
    };
    let corners: Vec<u32> = (0..n).collect();
    of(&(0..n).map(corner).collect::<Vec<_>>(), &[&corners])
}

#[test]
fn a_face_with_reflex_corners_is_measured_inside_its_sides() {
    // The face has the shape of the letter U. A fan of triangles around its first corner would cover the gap.
    let corners = [
        (0, 0),
        (3, 0),
        (3, 3),
        (2, 3),
        (2, 1),
        (1, 1),
        (1, 3),
        (0, 3),
    ];
    let at = |(x, y): (i32, i32)| DVec3::new(x.into(), y.into(), 0.0);
    let letter = of(&corners.map(at), &[&[0, 1, 2, 3, 4, 5, 6, 7]]);
    let gap = moved(shapes::square(), |p| 1e-6 * p + DVec3::new(1.5, 2.0, 0.0));
    let found = between(&gap, &letter, 1e-9);
    assert!((found.forth.largest - 0.5).abs() < 1e-5, "{found:?}");
}

#[test]
fn the_nearest_point_of_one_large_face_takes_few_visits() {
    let mesh = star(4000);
    let surface = SurfaceIndex::new(&mesh).unwrap();
    let hits = vertex_hits(&mesh, &surface, &|| Ok(())).unwrap();
    let visits: u32 = hits.iter().flatten().map(|hit| hit.visits).sum();
    assert!(visits < 50 * 4000, "{visits}");
}

#[test]
fn a_measurement_can_be_cancelled_at_any_report() {
    /// A listener that cancels the computation after the given number of progress reports.
    struct Stop(std::sync::atomic::AtomicU64);
    impl Progress for Stop {
        fn advance(&self, _: &str, _: u64, _: u64) -> bool {
            let left = &self.0;
            let order = std::sync::atomic::Ordering::Relaxed;
            left.fetch_update(order, order, |n| n.checked_sub(1))
                .is_ok()
        }
    }
    let (a, b) = (star(100), star(120));
    for allowed in [0, 1, 2, 5, 10, 20] {
        let stop = Stop(allowed.into());
        assert_eq!(Distance::between_with(&a, &b, None, &stop), Err(Cancelled));
    }
}

/// Searches for the nearest points of these surfaces are fast only with oriented bounding boxes.
#[test]
fn the_bounds_hold_for_surfaces_of_thin_triangles() {
    let tilted = |mesh: Mesh| {
        moved(mesh, |p| {
            DVec3::new(0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z)
        })
    };
    let long = |n| {
        tilted(moved(shapes::cylinder(n, false), |p| {
            p * DVec3::new(1.0, 1.0, 5.0)
        }))
    };
    let strip = |n| {
        tilted(moved(shapes::grid(n, 1), |p| {
            p * DVec3::new(0.02, 1.0, 1.0)
        }))
    };
    let offset = DVec3::new(0.03, 0.02, 0.05);
    for (a, b) in [
        (long(64), moved(long(64), |p| p + offset)),
        (long(64), long(40)),
        (strip(70), moved(strip(50), |p| p + offset)),
        (
            shapes::fans(&shapes::uv_sphere(60, 3)),
            tilted(shapes::fans(&shapes::uv_sphere(60, 3))),
        ),
    ] {
        let (a, b) = (shapes::fans(&a), shapes::fans(&b));
        let tolerance = 1e-3;
        let found = between(&a, &b, tolerance);
        let rows = 24;
        for (side, mesh, sampled) in [
            (&found.forth, &a, sampled_distance(&a, &b, rows)),
            (&found.back, &b, sampled_distance(&b, &a, rows)),
        ] {
            assert!(side.at_most >= sampled - 1e-12, "{side:?} {sampled}");
            // The distance from any point to the nearest sample is at most the length of the longest side, divided by
            // the number of rows.
            let longest = mesh
                .edges()
                .map(|e| mesh.length(e.half_edge()))
                .fold(0.0, f64::max);
            assert!(
                side.largest <= sampled + longest / f64::from(rows),
                "{side:?} {sampled}"
            );
        }
    }
}
