use super::*;
use crate::{Laplacian, shapes};
use mesh::{FaceId, angle_between};
use progress::NoProgress;

const METHODS: [Method; 6] = [
    Method::Laplacian {
        weights: Weights::Uniform,
        factor: 0.5,
    },
    Method::Laplacian {
        weights: Weights::Cotangent,
        factor: 0.7,
    },
    Method::Taubin {
        weights: Weights::Uniform,
        factor: 0.33,
        pass_band: 0.05,
    },
    Method::Taubin {
        weights: Weights::Cotangent,
        factor: 0.33,
        pass_band: 0.05,
    },
    Method::Implicit { time: 0.01 },
    Method::Denoise {
        angle: 30.0,
        vertex_passes: 10,
    },
];

fn smoothing(method: Method, passes: u32, is_free: &[bool]) -> Smoothing<'_> {
    Smoothing {
        method,
        passes,
        is_free,
        boundary: Boundary::Fixed,
        keep_volume: false,
    }
}

fn smoothed(mut mesh: Mesh, method: Method, passes: u32) -> Mesh {
    let is_free = vec![true; mesh.positions().len()];
    smooth(&mut mesh, &smoothing(method, passes, &is_free), &NoProgress).unwrap();
    mesh
}

/// Returns a vector with pseudo-random coordinates from -1 to 1.
fn noise(i: usize) -> DVec3 {
    let number = |k: u64| {
        let mixed = (3 * i as u64 + k + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    DVec3::new(number(0), number(1), number(2))
}

fn noisy(mut mesh: Mesh, size: f64) -> Mesh {
    for (i, p) in mesh.positions_mut().iter_mut().enumerate() {
        *p += size * noise(i);
    }
    mesh
}

/// Returns a cube with edges of length 2. Each side is a grid of `n` times `n` squares, and each square is cut
/// into two triangles.
fn fine_cube(n: u32) -> Mesh {
    let (mut points, mut polygons) = (Vec::new(), Vec::new());
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let first = u32::try_from(points.len()).unwrap();
            for i in 0..=n {
                for j in 0..=n {
                    let at = |k| 2.0 * f64::from(k) / f64::from(n) - 1.0;
                    let mut p = [0.0; 3];
                    p[axis] = side;
                    (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (at(i), at(j));
                    points.push(DVec3::from_array(p));
                }
            }
            for i in 0..n {
                for j in 0..n {
                    let a = first + i * (n + 1) + j;
                    let quad = [a, a + n + 1, a + n + 2, a + 1];
                    let quad = if side > 0.0 {
                        quad
                    } else {
                        [quad[0], quad[3], quad[2], quad[1]]
                    };
                    polygons.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
                }
            }
        }
    }
    let mut mesh = Mesh::from_polygons(points, &polygons).unwrap().0;
    crate::merge_vertices(&mut mesh, 1e-9, &NoProgress).unwrap();
    mesh.compact();
    assert!(mesh.is_closed());
    mesh
}

fn largest_difference(a: &Mesh, b: &Mesh) -> f64 {
    let pairs = a.positions().iter().zip(b.positions());
    pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

#[test]
fn a_flat_grid_stays_flat_and_its_boundary_stays() {
    let mut grid = shapes::grid(9, 9);
    for (i, p) in grid.positions_mut().iter_mut().enumerate() {
        *p += 0.02 * noise(i).with_z(0.0);
    }
    for method in METHODS {
        let after = smoothed(grid.clone(), method, 5);
        for v in grid.vertices() {
            assert_eq!(after.position(v).z, 0.0, "{method:?}");
            if grid.is_boundary_vertex(v) {
                assert_eq!(after.position(v), grid.position(v), "{method:?}");
            }
        }
    }
}

#[test]
fn cotangent_weights_do_not_move_the_vertices_of_a_flat_delaunay_mesh() {
    let grid = shapes::grid(9, 7);
    for method in [METHODS[1], METHODS[3], METHODS[4]] {
        let after = smoothed(grid.clone(), method, 3);
        assert!(largest_difference(&after, &grid) < 1e-13, "{method:?}");
    }
}

#[test]
fn moving_and_rotating_the_mesh_moves_and_rotates_the_result() {
    let mesh = noisy(shapes::torus(16, 12, 2.0, 0.7), 0.03);
    let (s, c) = crate::sin_cos_degrees(31.0);
    let turn = |p: DVec3| {
        let p = DVec3::new(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
        DVec3::new(p.x, c * p.y - s * p.z, s * p.y + c * p.z) + DVec3::new(3.0, -2.0, 5.0)
    };
    let turned = |mut mesh: Mesh| {
        mesh.positions_mut().iter_mut().for_each(|p| *p = turn(*p));
        mesh
    };
    for method in METHODS {
        let a = turned(smoothed(mesh.clone(), method, 4));
        let b = smoothed(turned(mesh.clone()), method, 4);
        assert!(
            largest_difference(&a, &b) < 1e-12,
            "{method:?} {}",
            largest_difference(&a, &b)
        );
    }
}

#[test]
fn scaling_by_a_power_of_two_scales_the_result_to_the_bit() {
    let mesh = noisy(shapes::torus(16, 12, 2.0, 0.7), 0.03);
    for method in METHODS {
        for e in [-900, -10, 1, 900] {
            let mut scaled_mesh = mesh.clone();
            scaled_mesh
                .positions_mut()
                .iter_mut()
                .for_each(|p| *p = scaled(*p, e));
            let method_there = match method {
                Method::Implicit { .. } if e.abs() > 500 => continue,
                Method::Implicit { time } => Method::Implicit {
                    time: libm::scalbn(time, 2 * e),
                },
                other => other,
            };
            let found = smoothed(scaled_mesh, method_there, 2);
            let mut expected = smoothed(mesh.clone(), method, 2);
            expected
                .positions_mut()
                .iter_mut()
                .for_each(|p| *p = scaled(*p, e));
            assert_eq!(found.positions(), expected.positions(), "{method:?} {e}");
        }
    }
}

#[test]
fn several_passes_are_the_same_as_several_calls() {
    let mesh = noisy(shapes::torus(16, 12, 2.0, 0.7), 0.03);
    for method in &METHODS[..5] {
        let at_once = smoothed(mesh.clone(), *method, 3);
        let one_by_one = (0..3).fold(mesh.clone(), |mesh, _| smoothed(mesh, *method, 1));
        assert_eq!(at_once.positions(), one_by_one.positions(), "{method:?}");
    }
}

#[test]
fn pinned_vertices_keep_their_bits_and_the_others_move() {
    let mesh = noisy(shapes::torus(16, 12, 2.0, 0.7), 0.03);
    let is_free: Vec<bool> = (0..mesh.positions().len()).map(|i| i % 3 > 0).collect();
    for method in METHODS {
        let mut after = mesh.clone();
        let moved = smooth(&mut after, &smoothing(method, 2, &is_free), &NoProgress).unwrap();
        assert_eq!(
            moved,
            is_free.iter().filter(|&&free| free).count(),
            "{method:?}"
        );
        for (i, is_free) in is_free.iter().enumerate() {
            let is_same = after.positions()[i] == mesh.positions()[i];
            assert_eq!(is_same, !is_free, "{method:?} {i}");
        }
    }
}

#[test]
fn explicit_steps_stay_within_the_bounds_of_the_mesh() {
    let mesh = noisy(shapes::uv_sphere(16, 12), 0.1);
    let [min, max] = crate::bounds(&mesh).unwrap();
    for method in &METHODS[..2] {
        let after = smoothed(mesh.clone(), *method, 20);
        let within = |p: &DVec3| p.cmpge(min - 1e-12).all() && p.cmple(max + 1e-12).all();
        assert!(after.positions().iter().all(within), "{method:?}");
    }
}

#[test]
fn one_implicit_step_shrinks_a_sphere_by_the_exact_factor() {
    // The coordinates x, y and z on the unit sphere are eigenfunctions of the Laplacian with the eigenvalue 2. A step
    // therefore multiplies the radius by 1 / (1 + 2 time).
    let sphere = shapes::uv_sphere(96, 48);
    for time in [1e-3, 0.1, 1.0, 10.0] {
        let after = smoothed(sphere.clone(), Method::Implicit { time }, 1);
        let expected = 1.0 / (1.0 + 2.0 * time);
        for p in after.positions() {
            assert!(
                (p.length() / expected - 1.0).abs() < 0.01,
                "{time} {}",
                p.length()
            );
        }
    }
}

#[test]
fn an_implicit_step_solves_its_equations() {
    let mesh = noisy(shapes::torus(9, 7, 2.0, 0.7), 0.05);
    let time = 0.3;
    let after = smoothed(mesh.clone(), Method::Implicit { time }, 1);
    let Laplacian { stiffness, areas } = Laplacian::new(&mesh, &NoProgress).unwrap();
    let flow = stiffness.times(after.positions());
    for (i, area) in areas.iter().enumerate() {
        let left = after.positions()[i] * *area + flow[i] * time;
        assert!(left.distance(mesh.positions()[i] * *area) < 1e-13);
    }
}

#[test]
fn implicit_steps_of_any_length_are_finite_and_keep_the_center_of_mass() {
    let mesh = noisy(shapes::torus(16, 12, 2.0, 0.7), 0.05);
    let areas = Laplacian::new(&mesh, &NoProgress).unwrap().areas;
    let center = |mesh: &Mesh| {
        let weighted = mesh.positions().iter().zip(&areas).map(|(p, a)| *p * *a);
        weighted.sum::<DVec3>() / areas.iter().sum::<f64>()
    };
    for time in [0.0, 1e-300, 1.0, 1e6, 1e300, f64::MAX] {
        let after = smoothed(mesh.clone(), Method::Implicit { time }, 1);
        assert!(center(&after).distance(center(&mesh)) < 1e-9, "{time}");
        let [min, max] = crate::bounds(&after).unwrap();
        assert!(min.distance(max) <= 8.0 && (time < 1e6 || min.distance(max) < 0.01));
    }
}

#[test]
fn taubin_passes_keep_the_volume_and_remove_noise() {
    let clean = shapes::torus(64, 40, 2.0, 0.7);
    let mesh = noisy(clean.clone(), 0.02);
    let after = smoothed(mesh.clone(), METHODS[2], 50);
    let drift = volume(&after) / volume(&mesh) - 1.0;
    assert!(drift.abs() < 0.005, "{drift}");
    let roughness = |mesh: &Mesh| {
        let angles = mesh.edges().filter_map(|e| mesh.dihedral_angle(e));
        angles.map(|a| a * a).sum::<f64>()
    };
    let [clean, noisy, after] = [&clean, &mesh, &after].map(roughness);
    assert!(
        after - clean < 0.1 * (noisy - clean),
        "{clean} {noisy} {after}"
    );
}

#[test]
fn unstable_factors_are_refused() {
    let is_stable = |factor, pass_band| {
        Method::Taubin {
            weights: Weights::Uniform,
            factor,
            pass_band,
        }
        .is_stable()
    };
    assert!(is_stable(0.5, 0.1) && is_stable(0.6307, 0.1) && is_stable(0.6, 0.2));
    assert!(!is_stable(0.9, 0.1) && !is_stable(1.0, 1.0));
    let mut mesh = shapes::cube();
    let method = Method::Taubin {
        weights: Weights::Uniform,
        factor: 0.9,
        pass_band: 0.1,
    };
    let refused = smooth(&mut mesh, &smoothing(method, 1, &[true; 8]), &NoProgress);
    assert_eq!(refused, Err(SmoothError::Unstable));
    assert_eq!(mesh.positions(), shapes::cube().positions());
}

#[test]
fn the_volume_is_kept_with_and_without_pins() {
    let mesh = noisy(shapes::torus(24, 16, 2.0, 0.7), 0.03);
    for method in METHODS {
        for step in [1, 5] {
            let is_free: Vec<bool> = (0..mesh.positions().len())
                .map(|i| step == 1 || i % step > 0)
                .collect();
            let mut after = mesh.clone();
            let smoothing = Smoothing {
                keep_volume: true,
                ..smoothing(method, 4, &is_free)
            };
            smooth(&mut after, &smoothing, &NoProgress).unwrap();
            let drift = volume(&after) / volume(&mesh) - 1.0;
            assert!(drift.abs() < 1e-12, "{method:?} {drift}");
        }
    }
    let mut open = shapes::grid(3, 3);
    let is_free = vec![true; open.positions().len()];
    let smoothing = Smoothing {
        keep_volume: true,
        ..smoothing(METHODS[0], 1, &is_free)
    };
    assert_eq!(
        smooth(&mut open, &smoothing, &NoProgress),
        Err(SmoothError::NotClosed)
    );
}

#[test]
fn volumes_that_cannot_be_restored_are_reported_in_scene_units() {
    // Smoothing moves all vertices to one point. The mesh then has no normals, so its volume cannot be restored.
    let mut mesh = shapes::tetrahedron();
    for p in mesh.positions_mut() {
        *p *= 100.0;
    }
    let method = Method::Laplacian {
        weights: Weights::Uniform,
        factor: 0.75,
    };
    let smoothing = Smoothing {
        keep_volume: true,
        ..smoothing(method, 50, &[true; 4])
    };
    let refused = smooth(&mut mesh.clone(), &smoothing, &NoProgress);
    let before = volume(&mesh);
    assert_eq!(refused, Err(SmoothError::Volume { before, after: 0.0 }));
}

#[test]
fn a_free_boundary_is_smoothed_as_a_curve() {
    // The inner vertices have pseudorandom heights, and the boundary is flat. Smoothing keeps the boundary flat, but
    // rounds its corners.
    let mut mesh = shapes::grid(8, 8);
    let inner: Vec<VertexId> = mesh
        .vertices()
        .filter(|&v| !mesh.is_boundary_vertex(v))
        .collect();
    for v in inner {
        let p = mesh.position(v).with_z(noise(v.index()).z);
        mesh.set_position(v, p);
    }
    let is_free = vec![true; mesh.positions().len()];
    for method in &METHODS[..5] {
        let mut after = mesh.clone();
        let smoothing = Smoothing {
            boundary: Boundary::Free,
            ..smoothing(*method, 4, &is_free)
        };
        smooth(&mut after, &smoothing, &NoProgress).unwrap();
        let mut moved = 0;
        for v in mesh.vertices().filter(|&v| mesh.is_boundary_vertex(v)) {
            assert_eq!(after.position(v).z, 0.0, "{method:?}");
            moved += usize::from(after.position(v) != mesh.position(v));
        }
        assert!(moved >= 4, "{method:?}");
    }
}

/// Returns the root mean square of the angles between the normals of two meshes with the same faces, in degrees.
fn rms_of_normals(a: &Mesh, b: &Mesh) -> f64 {
    let angles = a
        .faces()
        .map(|f| angle_between(a.face_normal(f), b.face_normal(f)));
    let squares: f64 = angles.map(|a| a * a).sum();
    (squares / a.n_faces() as f64).sqrt().to_degrees()
}

#[test]
fn denoising_a_cube_keeps_its_edges_sharp() {
    let n = 16;
    let clean = fine_cube(n);
    let edge = 2.0 / f64::from(n);
    for (size, angle) in [(0.1, 30.0), (0.2, 30.0), (0.3, 40.0)] {
        let mesh = noisy(clean.clone(), size * edge);
        let rms = |method| rms_of_normals(&clean, &smoothed(mesh.clone(), method, 20));
        let others = [rms(METHODS[0]), rms(METHODS[2])];
        let method = Method::Denoise {
            angle,
            vertex_passes: 10,
        };
        let after = smoothed(mesh.clone(), method, 20);
        let rms = rms_of_normals(&clean, &after);
        assert!(
            rms <= 5.0 && others.iter().all(|other| rms < 0.5 * other),
            "{size}: {rms} {others:?}"
        );
        // The angles at the edges of the cube stay near 90 degrees.
        let sharp = clean
            .edges()
            .filter(|&e| clean.dihedral_angle(e).is_some_and(|a| a > 1.0));
        let angles: Vec<f64> = sharp
            .filter_map(|e| after.dihedral_angle(e))
            .map(f64::to_degrees)
            .collect();
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        assert!((mean - 90.0).abs() < 3.0, "{size}: {mean}");
    }
}

#[test]
fn degenerate_isolated_and_extreme_meshes_stay_finite() {
    let mut meshes = vec![
        Mesh::default(),
        shapes::cylinder(300, true),
        shapes::tetrahedron(),
    ];
    // The meshes have a needle-shaped triangle, a duplicate triangle, an isolated vertex, or all vertices at one
    // point.
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::X * 0.5, DVec3::Y, DVec3::Z];
    meshes.push(
        Mesh::from_polygons(points, &[[0, 1, 2], [2, 1, 3], [3, 1, 2]])
            .unwrap()
            .0,
    );
    let mut point = shapes::cube();
    point.positions_mut().fill(DVec3::new(1e300, -1e300, 1.0));
    meshes.push(point);
    for factor in [1e-320, 1e-200, 1e200, 1.7e308] {
        let mut mesh = shapes::icosahedron();
        mesh.positions_mut().iter_mut().for_each(|p| *p *= factor);
        meshes.push(mesh);
    }
    let mut holes = shapes::torus(8, 6, 2.0, 0.7);
    holes.delete_face(FaceId::new(3)).unwrap();
    holes.delete_vertex(VertexId::new(20)).unwrap();
    meshes.push(holes);
    for mesh in meshes {
        for method in METHODS {
            for boundary in [Boundary::Fixed, Boundary::Free] {
                let is_free = vec![true; mesh.positions().len()];
                let mut after = mesh.clone();
                let smoothing = Smoothing {
                    boundary,
                    ..smoothing(method, 3, &is_free)
                };
                smooth(&mut after, &smoothing, &NoProgress).unwrap();
                assert!(
                    after.positions().iter().all(|p| p.is_finite()),
                    "{method:?}"
                );
            }
        }
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let mesh = noisy(shapes::torus(97, 61, 2.0, 0.7), 0.01);
    for method in METHODS {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| smoothed(mesh.clone(), method, 2).positions().to_vec())
        };
        let one = with(1);
        assert!(one == with(2) && one == with(8), "{method:?}");
    }
}

#[test]
fn a_canceled_run_leaves_the_mesh_unchanged() {
    struct Never;
    impl Progress for Never {
        fn advance(&self, _: &str, _: u64, _: u64) -> bool {
            false
        }
    }
    let mesh = shapes::icosahedron();
    for method in METHODS {
        let mut after = mesh.clone();
        let canceled = smooth(&mut after, &smoothing(method, 2, &[true; 12]), &Never);
        assert!(matches!(
            canceled,
            Err(SmoothError::Cancelled(_) | SmoothError::Solve(SolveError::Cancelled(_)))
        ));
        assert_eq!(after.positions(), mesh.positions());
    }
}
