use super::*;
use crate::shapes;
use crate::sparse::Factor;
use mesh::VertexId;
use progress::NoProgress;

fn laplacian(mesh: &Mesh) -> Laplacian {
    Laplacian::new(mesh, &NoProgress).unwrap()
}

/// Returns a pseudo-random number from -1 to 1, which depends only on the index.
fn noise(i: usize) -> f64 {
    let mixed = (i as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Returns a flat grid of quadrilaterals or triangles, whose inner vertices are displaced.
fn uneven_grid(n: u32, triangles: bool) -> Mesh {
    let mut mesh = shapes::grid(n, n);
    if triangles {
        let mut polygons = Vec::new();
        for f in mesh.faces() {
            let c: Vec<u32> = mesh
                .face_vertices(f)
                .map(|v| u32::try_from(v.index()).unwrap())
                .collect();
            polygons.extend([[c[0], c[1], c[2]], [c[0], c[2], c[3]]]);
        }
        mesh = Mesh::from_polygons(mesh.positions().to_vec(), &polygons)
            .unwrap()
            .0;
    }
    let size = mesh.length(mesh.half_edges().next().unwrap());
    let inner: Vec<VertexId> = mesh
        .vertices()
        .filter(|&v| !mesh.is_boundary_vertex(v))
        .collect();
    for v in inner {
        let by = DVec3::new(noise(2 * v.index()), noise(2 * v.index() + 1), 0.0);
        let p = mesh.position(v) + 0.2 * size * by;
        mesh.set_position(v, p);
    }
    mesh
}

fn meshes() -> Vec<Mesh> {
    vec![
        uneven_grid(7, true),
        uneven_grid(7, false),
        shapes::torus(12, 9, 2.0, 0.7),
        shapes::cylinder(12, true),
        shapes::cylinder(40, true),
        shapes::uv_sphere(9, 6),
        shapes::cube(),
    ]
}

#[test]
fn the_weights_of_an_icosahedron_are_cotangents_of_60_degrees() {
    let mesh = shapes::icosahedron();
    let Laplacian { stiffness, areas } = laplacian(&mesh);
    let cot = 1.0 / 3.0_f64.sqrt();
    for e in mesh.edges() {
        let [v, w] = mesh.edge_vertices(e).map(VertexId::index);
        assert!((stiffness.get(v, w) + cot).abs() < 1e-14);
        assert!((stiffness.get(v, v) - 5.0 * cot).abs() < 1e-14);
        assert!((areas[v] - geometry_area(&mesh) / 12.0).abs() < 1e-14);
    }
}

fn geometry_area(mesh: &Mesh) -> f64 {
    crate::area(mesh)
}

#[test]
fn rows_are_symmetric_to_the_bit_and_add_up_to_zero() {
    for mesh in meshes() {
        let Laplacian { stiffness, .. } = laplacian(&mesh);
        for i in 0..stiffness.len() {
            let sum: f64 = stiffness.row(i).map(|(_, a)| a).sum();
            assert!(sum.abs() < 1e-12, "{sum}");
            for (j, a) in stiffness.row(i) {
                assert_eq!(a.to_bits(), stiffness.get(j as usize, i).to_bits());
            }
        }
    }
}

#[test]
fn areas_add_up_to_the_area_of_flat_faces() {
    for mesh in [
        uneven_grid(7, true),
        shapes::cylinder(40, true),
        shapes::cube(),
        shapes::icosahedron(),
    ] {
        let sum: f64 = laplacian(&mesh).areas.iter().sum();
        assert!((sum - crate::area(&mesh)).abs() < 1e-12 * sum);
    }
}

#[test]
fn linear_functions_are_harmonic_on_flat_meshes_and_have_the_energy_of_their_gradient() {
    for mesh in [uneven_grid(9, true), uneven_grid(9, false)] {
        let Laplacian { stiffness, .. } = laplacian(&mesh);
        let x: Vec<f64> = mesh
            .positions()
            .iter()
            .map(|p| 3.0 * p.x - p.y + 5.0)
            .collect();
        let forces = stiffness.times(&x);
        for v in mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)) {
            assert!(forces[v.index()].abs() < 1e-12, "{}", forces[v.index()]);
        }
        let energy: f64 = forces.iter().zip(&x).map(|(f, x)| f * x).sum();
        let expected = 10.0 * crate::area(&mesh);
        assert!((energy - expected).abs() < 1e-12 * expected);
    }
}

#[test]
fn moving_and_rotating_changes_nothing() {
    for mesh in meshes() {
        let expected = laplacian(&mesh);
        let mut moved = mesh.clone();
        let (s, c) = crate::sin_cos_degrees(31.0);
        for p in moved.positions_mut() {
            let turned = DVec3::new(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
            *p = DVec3::new(
                turned.x,
                c * turned.y - s * turned.z,
                s * turned.y + c * turned.z,
            ) + DVec3::new(3.0, -2.0, 5.0);
        }
        let found = laplacian(&moved);
        for i in 0..expected.areas.len() {
            assert!((expected.areas[i] - found.areas[i]).abs() < 1e-12);
            for (j, a) in expected.stiffness.row(i) {
                assert!((a - found.stiffness.get(i, j as usize)).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn degenerate_and_extreme_meshes_have_finite_entries_and_positive_areas() {
    let needle = |p: DVec3| {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, p];
        Mesh::from_polygons(points, &[[0, 1, 2], [2, 1, 3]])
            .unwrap()
            .0
    };
    let mut all = vec![
        needle(DVec3::new(0.5, 0.5, 0.0)),
        needle(DVec3::X),
        needle(DVec3::new(0.5, 0.5, 1e-200)),
        needle(DVec3::new(2.0, -1.0, 0.0)),
    ];
    for factor in [0.0, 1e-320, 1e-300, 1e-160, 1e160, 1.7e308] {
        for mut mesh in meshes() {
            for p in mesh.positions_mut() {
                *p = (0.25 * *p) * factor;
            }
            all.push(mesh);
        }
    }
    for mesh in all {
        let Laplacian { stiffness, areas } = laplacian(&mesh);
        for (i, area) in areas.iter().enumerate() {
            assert!(area.is_finite() && *area >= 0.0);
            assert!(
                stiffness
                    .row(i)
                    .all(|(_, a)| a.is_finite() && a.abs() < 1e9)
            );
        }
    }
}

#[test]
fn harmonic_functions_are_within_the_bounds_of_their_boundary_values() {
    // The triangles of the regular grid are a Delaunay triangulation, so no cotangent weight is negative.
    let mut mesh = uneven_grid(12, true);
    mesh.positions_mut()
        .copy_from_slice(shapes::grid(12, 12).positions());
    let Laplacian { stiffness, .. } = laplacian(&mesh);
    for i in 0..stiffness.len() {
        assert!(stiffness.row(i).all(|(j, a)| j as usize == i || a <= 1e-15));
    }
    let is_boundary: Vec<bool> = mesh
        .vertices()
        .map(|v| mesh.is_boundary_vertex(v))
        .collect();
    let mut x: Vec<f64> = (0..is_boundary.len()).map(noise).collect();
    let rim = x.iter().zip(&is_boundary).filter(|p| *p.1).map(|p| *p.0);
    let (min, max) = rim.fold((1.0, -1.0), |(a, b), x| (f64::min(a, x), f64::max(b, x)));
    let factor = Factor::with_pins(&stiffness, &is_boundary, &NoProgress).unwrap();
    factor.solve(&vec![0.0; x.len()], &mut x).unwrap();
    assert!(x.iter().all(|&x| min <= x && x <= max));
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let mesh = shapes::torus(97, 61, 2.0, 0.7);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| laplacian(&mesh))
    };
    assert!(with(1) == with(2) && with(1) == with(8));
}
