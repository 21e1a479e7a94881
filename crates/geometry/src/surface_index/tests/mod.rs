//! Compares the results of the index with the results of testing every triangle.

mod intersect;
mod oriented;
mod ray;
mod slab;
mod winding;

use mesh::{DVec3, Mesh, VertexId};
use progress::NoProgress;

use super::triangle::nearest_on_triangle;
use super::*;
use crate::shapes;

/// A linear congruential generator of pseudorandom numbers (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn next(&mut self, n: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }

    /// Returns a pseudo-random number from -1 to 1.
    fn number(&mut self) -> f64 {
        self.next(1 << 30) as f64 / f64::from(1 << 29) - 1.0
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    /// Returns a point of a small lattice, so that points often coincide or lie on common lines and planes.
    fn lattice_point(&mut self) -> DVec3 {
        DVec3::from([0; 3].map(|_| self.next(4) as f64))
    }
}

/// Returns triangles with no common vertices.
fn soup(n: usize, mut point: impl FnMut() -> DVec3) -> Mesh {
    let positions: Vec<DVec3> = (0..3 * n).map(|_| point()).collect();
    let polygons: Vec<[u32; 3]> = (0..u32::try_from(n).unwrap())
        .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
        .collect();
    Mesh::from_polygons(positions, &polygons)
        .expect("triangles")
        .0
}

#[test]
fn nearest_points_are_those_of_brute_force() {
    let mut random = Random(1);
    for round in 0..60 {
        let scale = [1.0, 1e-100, 1e100][round % 3];
        let is_lattice = round % 2 == 0;
        let mesh = soup(1 + round * 2, || {
            scale
                * if is_lattice {
                    random.lattice_point()
                } else {
                    random.point()
                }
        });
        let index = SurfaceIndex::new(&mesh).unwrap();
        assert_eq!(index.n_triangles(), 1 + round * 2);
        for _ in 0..50 {
            let p = scale * 3.0 * random.point();
            let hint = u32::try_from(random.next(100)).unwrap();
            let found = index.nearest(p, hint);
            let brute = index
                .positions
                .iter()
                .map(|t| p.distance(nearest_on_triangle(p, t)));
            assert_eq!(found.distance, brute.fold(f64::INFINITY, f64::min));
            assert_eq!(found.lower, found.distance);
            let triangle = index.triangle(found.triangle);
            let point = triangle.point(triangle.barycentric(p));
            assert!(
                point.distance(found.point) <= 1e-13 * scale,
                "{point} {}",
                found.point
            );
            for k in 0..3 {
                assert_eq!(mesh.origin(triangle.corners[k]), triangle.vertices[k]);
                assert_eq!(mesh.face(triangle.corners[k]), Some(triangle.face));
                assert_eq!(mesh.position(triangle.vertices[k]), triangle.positions[k]);
            }
        }
    }
}

/// The tested radii include one just below and one just above the distance to the nearest point.
#[test]
fn a_point_is_within_a_radius_if_the_nearest_point_is() {
    let mut random = Random(5);
    for round in 0..40 {
        let mesh = soup(1 + round * 4, || random.point());
        let index = SurfaceIndex::new(&mesh).unwrap();
        let mut hint = 7;
        for _ in 0..50 {
            let p = 1.5 * random.point();
            let n = u32::try_from(index.n_triangles()).unwrap();
            let distances = (0..n).map(|i| index.to_triangle(p, i));
            let distance = distances.fold(f64::INFINITY, f64::min);
            for (radius, is_within) in [
                (0.0, distance == 0.0),
                (0.999 * distance, false),
                (1.001 * distance, true),
                (9.0, true),
                (f64::INFINITY, true),
            ] {
                assert_eq!(index.is_within(p, radius, &mut hint), is_within, "{radius}");
                assert!(!is_within || index.to_triangle(p, hint) <= radius);
            }
        }
    }
}

#[test]
fn each_triangle_of_each_face_is_in_the_index_once() {
    let mesh = shapes::cylinder(7, true);
    let index = SurfaceIndex::new(&mesh).unwrap();
    assert_eq!(index.n_triangles(), 7 * 2 + 2 * 5);
    let mut leaves: Vec<(u32, u32)> = Vec::new();
    for node in &index.nodes {
        if node.right == 0 {
            leaves.push((node.first, node.last));
        }
        for t in &index.positions[node.first as usize..node.last as usize] {
            assert!(
                t.iter()
                    .all(|p| p.cmpge(node.min).all() && p.cmple(node.max).all())
            );
        }
    }
    assert_eq!(
        leaves.iter().map(|(first, last)| last - first).sum::<u32>(),
        24
    );
    let one = SurfaceIndex::of_faces(&mesh, mesh.faces().take(1), &NoProgress);
    let one = one.unwrap().unwrap();
    assert!(one.n_triangles() < 24);
    assert!(
        SurfaceIndex::of_faces(&mesh, [], &NoProgress)
            .unwrap()
            .is_none()
    );
    assert!(SurfaceIndex::new(&Mesh::default()).is_none());
}

#[test]
fn the_index_has_the_same_bits_for_any_number_of_threads() {
    let mesh = shapes::torus(200, 100, 1.0, 0.3);
    let points: Vec<DVec3> = {
        let mut random = Random(2);
        (0..5000).map(|_| random.point()).collect()
    };
    let results = [1, 2, 8].map(|n| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build()
            .unwrap();
        pool.install(|| {
            let index = SurfaceIndex::new(&mesh).unwrap();
            let vertices = index.nearest_to_vertices(&mesh, &NoProgress).unwrap();
            assert!(vertices.iter().flatten().all(|hit| hit.distance == 0.0));
            let found = index.nearest_to_points(&points, &NoProgress).unwrap();
            (index.positions, found)
        })
    });
    assert_eq!(results[0], results[1]);
    assert_eq!(results[0], results[2]);
}

#[test]
fn a_dead_vertex_has_no_nearest_point() {
    let mut mesh = shapes::grid(2, 2);
    let index = SurfaceIndex::new(&mesh).unwrap();
    let v = VertexId::new(0);
    mesh.delete_vertex(v).unwrap();
    let found = index.nearest_to_vertices(&mesh, &NoProgress).unwrap();
    assert!(found[0].is_none() && found[1].is_some());
}

/// A listener that counts its calls, and cancels after the allowed number of calls.
struct Stop {
    allowed: usize,
    calls: std::sync::atomic::AtomicUsize,
}

impl Progress for Stop {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        let calls = &self.calls;
        calls.fetch_add(1, std::sync::atomic::Ordering::Relaxed) < self.allowed
    }
}

/// The corners of the first face lie on one circle, so the face is convex and is repeatedly cut in half. The corners of
/// the second face lie on two circles, so the face is cut into monotone polygons.
#[test]
fn the_index_of_a_face_with_many_corners_can_be_cancelled_at_any_call() {
    let n = 100_000_u32;
    for radius in [[1.0, 1.0], [1.0, 0.9]] {
        let at = |i: u32| {
            let (y, x) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(n));
            let radius = radius[(i / (n / 10) % 2) as usize];
            DVec3::new(radius * x, radius * y, 0.0)
        };
        let corners: Vec<u32> = (0..n).collect();
        let points = (0..n).map(at).collect();
        let (mesh, _) = Mesh::from_polygons(points, &[corners]).unwrap();
        let run = |allowed| {
            let calls = 0.into();
            let stop = Stop { allowed, calls };
            let index = SurfaceIndex::with_progress(&mesh, &stop);
            (index.is_ok(), stop.calls.into_inner())
        };
        let (is_done, calls) = run(usize::MAX);
        assert!(is_done && calls >= 20, "{calls}");
        for allowed in (0..calls).step_by(calls.div_ceil(8)) {
            assert!(!run(allowed).0, "{allowed}");
        }
    }
}
