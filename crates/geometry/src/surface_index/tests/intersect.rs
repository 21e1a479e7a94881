//! Compares the intersection test for two triangles with exact arithmetic, and the search for intersecting pairs with a
//! test of every pair.

use std::collections::BTreeSet;

use super::*;

type Int = [i128; 3];

/// A point with rational coordinates: the numerators and the common denominator.
type Point = (Int, i128);

fn sub(a: Int, b: Int) -> Int {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn cross(a: Int, b: Int) -> Int {
    [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn dot(a: Int, b: Int) -> i128 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn normal(t: &[Int; 3]) -> Int {
    cross(sub(t[1], t[0]), sub(t[2], t[0]))
}

/// Returns (1 − t) p + t q for t = n / d.
fn between(p: Int, q: Int, (n, d): (i128, i128)) -> Point {
    let sign = d.signum();
    let at = [0, 1, 2].map(|i| sign * (p[i] * (d - n) + q[i] * n));
    (at, d.abs())
}

fn is_in([a, b, c]: &[Int; 3], (at, d): Point) -> bool {
    let n = normal(&[*a, *b, *c]);
    let from = |p: Int| [0, 1, 2].map(|i| at[i] - d * p[i]);
    let inside = |p: Int, q: Int| dot(n, cross(sub(q, p), from(p))) >= 0;
    dot(n, from(*a)) == 0 && inside(*a, *b) && inside(*b, *c) && inside(*c, *a)
}

/// Tests with rational arithmetic whether two triangles have a common point that is not on a common corner or side. The
/// set of common points is the convex hull of three kinds of points: corners of one triangle that lie in the other,
/// points where a side of one triangle meets the plane of the other, and points where two sides meet.
fn intersect(s: &[Int; 3], t: &[Int; 3]) -> bool {
    if normal(s) == [0; 3] || normal(t) == [0; 3] {
        return false;
    }
    let mut points: Vec<Point> = s.iter().chain(t).map(|p| (*p, 1)).collect();
    for (s, t) in [(s, t), (t, s)] {
        for i in 0..3 {
            let (p, q) = (s[i], s[(i + 1) % 3]);
            let n = normal(t);
            let (at_p, at_q) = (dot(n, sub(p, t[0])), dot(n, sub(q, t[0])));
            if at_p != at_q {
                points.push(between(p, q, (at_p, at_p - at_q)));
            }
            for j in 0..3 {
                let (a, b) = (t[j], t[(j + 1) % 3]);
                let n = cross(sub(q, p), sub(b, a));
                if n != [0; 3] {
                    let along = dot(cross(sub(a, p), sub(b, a)), n);
                    points.push(between(p, q, (along, dot(n, n))));
                }
            }
        }
    }
    let common: Vec<Int> = s.iter().copied().filter(|p| t.contains(p)).collect();
    let is_common = |(at, d): Point| match common[..] {
        [p] => at == p.map(|x| x * d),
        [p, q] => {
            let from = |p: Int| [0, 1, 2].map(|i| at[i] - d * p[i]);
            cross(sub(q, p), from(p)) == [0; 3] && dot(from(p), from(q)) <= 0
        }
        _ => false,
    };
    points
        .into_iter()
        .any(|point| is_in(s, point) && is_in(t, point) && !is_common(point))
}

#[test]
fn triangles_on_a_small_lattice_intersect_as_in_rational_arithmetic() {
    let mut random = Random(3);
    let mut counts = [[0; 2]; 4];
    for round in 0..60_000 {
        let n = 2 + round % 3;
        let mut point = || [0; 3].map(|_| i128::from(random.next(n)));
        let (s, mut t) = ([0; 3].map(|_| point()), [0; 3].map(|_| point()));
        for i in 0..(round / 3 % 4) as usize {
            t[i] = s[(i + 1) % 3];
        }
        let power_of_two = |n: u64| f64::from_bits((1023 + n) << 52);
        let scale =
            [1.0, 1.0 / power_of_two(700), power_of_two(470), 0.1][(round / 12 % 4) as usize];
        let real = |t: [Int; 3]| t.map(|p| DVec3::from(p.map(|x| x as f64)) * scale);
        let (expected, found) = (intersect(&s, &t), triangles_intersect(&real(s), &real(t)));
        // Multiples of 0.1 are rounded. Rounding moves points off the lines on which they should lie, so the two
        // results can differ.
        if scale != 0.1 {
            assert_eq!(expected, found, "{s:?} {t:?} {scale}");
        }
        assert_eq!(found, triangles_intersect(&real(t), &real(s)));
        let [a, b, c] = real(t);
        assert_eq!(found, triangles_intersect(&real(s), &[c, b, a]));
        let n_common = s.iter().filter(|p| t.contains(p)).count();
        counts[n_common][usize::from(expected)] += 1;
    }
    assert!(
        counts.iter().flatten().take(6).all(|n| *n > 500),
        "{counts:?}"
    );
}

#[test]
fn neighbors_intersect_only_if_they_overlap_further() {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let [o, x, y] = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let t = [o, x, y];
    // The triangles have a common edge. The second triangle lies beyond this edge, is folded back just above the first
    // triangle, or overlaps the first triangle in the same plane.
    assert!(!triangles_intersect(&t, &[x, o, at(0.5, -1.0, 0.0)]));
    assert!(!triangles_intersect(&t, &[x, o, at(0.5, 0.1, 1e-300)]));
    assert!(triangles_intersect(&t, &[x, o, at(0.5, 0.1, 0.0)]));
    // The triangles have a common corner. The second triangle meets the first triangle only there, passes through the
    // first triangle, or has an edge that lies on an edge of the first triangle.
    assert!(!triangles_intersect(&t, &[o, -x, -y]));
    assert!(triangles_intersect(
        &t,
        &[o, at(0.2, 0.2, 1.0), at(0.2, 0.2, -1.0)]
    ));
    assert!(triangles_intersect(&t, &[o, at(0.5, 0.0, 0.0), -y]));
    // The triangles have the same three corners.
    assert!(triangles_intersect(&t, &[x, o, y]));
    // The triangles meet at a single point: a corner of the second triangle lies inside the first triangle.
    assert!(triangles_intersect(
        &t,
        &[at(0.25, 0.25, 0.0), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0)]
    ));
    // The second triangle has zero area.
    assert!(!triangles_intersect(
        &t,
        &[at(0.2, 0.2, 1.0), at(0.2, 0.2, -1.0), at(0.2, 0.2, 0.0)]
    ));
}

#[test]
fn the_intersecting_faces_of_random_soups_are_those_of_all_pairs() {
    let mut random = Random(4);
    for round in 0..200 {
        let scale = [1.0, 1e-100, 1e100][round % 3];
        let size = 1.5 / (1.0 + (round % 7) as f64);
        let mesh = if round % 4 == 0 {
            soup(60, || scale * random.lattice_point())
        } else {
            let mut i = 0;
            let mut center = DVec3::ZERO;
            soup(100, || {
                if i % 3 == 0 {
                    center = random.point();
                }
                i += 1;
                scale * (center + size * random.point())
            })
        };
        let triangles: Vec<(FaceId, [DVec3; 3])> = mesh
            .faces()
            .map(|f| {
                let corners: Vec<DVec3> = mesh.face_vertices(f).map(|v| mesh.position(v)).collect();
                (f, [corners[0], corners[1], corners[2]])
            })
            .collect();
        let mut expected = BTreeSet::new();
        for (i, (f, s)) in triangles.iter().enumerate() {
            for (g, t) in &triangles[i + 1..] {
                if triangles_intersect(s, t) {
                    expected.extend([*f, *g]);
                }
            }
        }
        let found = self_intersecting_faces(&mesh, &NoProgress).unwrap();
        assert_eq!(found, expected.into_iter().collect::<Vec<_>>());
    }
}

#[test]
fn pairs_are_those_of_all_boxes_and_the_same_for_any_number_of_threads() {
    let mut random = Random(5);
    let [a, b] = [400, 300].map(|n| {
        let mesh = soup(n, || random.lattice_point() + 0.5 * random.point());
        SurfaceIndex::new(&mesh).unwrap()
    });
    let bounds = |t: &[DVec3; 3]| [t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2])];
    let touch = |s, t| {
        let ([min, max], [low, high]) = (bounds(s), bounds(t));
        (0..3).all(|i| min[i] <= high[i] && low[i] <= max[i])
    };
    let (mut own, mut cross) = (Vec::new(), Vec::new());
    for (i, s) in (0..).zip(&a.positions) {
        own.extend(
            (0..)
                .zip(&a.positions)
                .filter(|(j, t)| i < *j && touch(s, t))
                .map(|(j, _)| [i, j]),
        );
        cross.extend(
            (0..)
                .zip(&b.positions)
                .filter(|(_, t)| touch(s, t))
                .map(|(j, _)| [i, j]),
        );
    }
    for n in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build()
            .unwrap();
        pool.install(|| {
            assert_eq!(a.pairs(|_, _| true, &NoProgress).unwrap(), own);
            assert_eq!(a.pairs_with(&b, |_, _| true, &NoProgress).unwrap(), cross);
            assert!(a.pairs(|_, _| false, &NoProgress).unwrap().is_empty());
        });
    }
}

#[test]
fn a_closed_convex_surface_has_no_intersecting_faces() {
    for mesh in [
        shapes::icosahedron(),
        shapes::uv_sphere(30, 20),
        shapes::cube(),
        shapes::cylinder(9, true),
    ] {
        assert_eq!(self_intersecting_faces(&mesh, &NoProgress).unwrap(), []);
    }
    assert_eq!(
        self_intersecting_faces(&Mesh::default(), &NoProgress).unwrap(),
        []
    );
}
