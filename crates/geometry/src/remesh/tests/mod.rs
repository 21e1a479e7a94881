use super::*;
use crate::distance::{Distance, diagonal};
use crate::shapes;
use crate::simplify::tests::{square, torus, triangles, waves};
use crate::surface_index::SurfaceIndex;
use mesh::{CREASE, Column, DVec2, DVec3, Domain, HalfEdgeId, Rule, Values};
use mesh::{MATERIAL, UV, VERTEX_NORMAL, VERTEX_SHARPNESS};
use progress::NoProgress;
use proptest::prelude::*;

mod values;

use values::with_uv;

fn to(length: f64) -> Options<'static> {
    Options {
        length: Length::Uniform(length),
        ..Options::default()
    }
}

/// Remeshes a mesh, and checks the properties that every result must have.
fn remeshed(mesh: &Mesh, options: &Options) -> Remeshed {
    let result = remesh(mesh, options, &NoProgress).unwrap();
    let after = &result.mesh;
    assert_eq!(after.defects(), []);
    assert!(after.is_dense());
    assert_eq!(after.euler_characteristic(), mesh.euler_characteristic());
    assert_eq!(after.n_boundary_loops(), mesh.n_boundary_loops());
    assert!(after.positions().iter().all(|p| p.is_finite()));
    assert!(result.counts.passes <= options.passes.into());
    result
}

fn ball() -> Mesh {
    triangles(&shapes::uv_sphere(48, 24))
}

/// Returns a cube with corners at ±1, whose sides have triangles of different sizes.
fn fine_cube() -> Mesh {
    let mut cube = triangles(&shapes::cube());
    for _ in 0..3 {
        cube = shapes::fans(&cube);
    }
    triangles(&cube)
}

fn sharp(mesh: &Mesh, degrees: f64) -> Vec<EdgeId> {
    let angle = |e| mesh.dihedral_angle(e).unwrap_or(0.0).to_degrees();
    mesh.edges().filter(|&e| angle(e) > degrees).collect()
}

fn smallest_angles(mesh: &Mesh) -> Vec<f64> {
    let smallest = |f| {
        let angles = mesh.face_half_edges(f).map(|h| mesh.corner_angle(h));
        angles.fold(f64::INFINITY, f64::min).to_degrees()
    };
    let mut angles: Vec<f64> = mesh.faces().map(smallest).collect();
    angles.sort_by(f64::total_cmp);
    angles
}

fn share<T>(all: impl Iterator<Item = T> + Clone, is_counted: impl Fn(T) -> bool) -> f64 {
    let n = all.clone().count();
    all.filter(|_| true).map(is_counted).filter(|&x| x).count() as f64 / n as f64
}

/// Checks that no face of `after` points away from the nearest face of `before`.
fn assert_no_face_is_turned_over(before: &Mesh, after: &Mesh) {
    let index = SurfaceIndex::new(before).unwrap();
    for f in after.faces() {
        let nearest = index.nearest(after.face_center(f), 0);
        let normal = before.face_normal(index.triangle(nearest.triangle).face);
        assert!(after.face_normal(f).dot(normal) > 0.0, "{f}");
    }
}

#[test]
fn triangles_are_even_and_near_the_original() {
    for (mesh, length) in [
        (ball(), 0.1),
        (torus(), 0.06),
        (ball(), 0.2),
        (torus(), 0.12),
    ] {
        let after = remeshed(&mesh, &to(length)).mesh;
        assert_no_face_is_turned_over(&mesh, &after);
        let angles = smallest_angles(&after);
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        assert!(mean > 50.0 && angles[0] > 30.0, "{mean} {}", angles[0]);
        assert!(share(after.vertices(), |v| after.valence(v) == 6) > 0.7);
        let in_range = share(after.edges(), |e| {
            let relative = after.length(e.half_edges()[0]) / length;
            (0.8..=4.0 / 3.0).contains(&relative)
        });
        assert!(in_range > 0.95, "{in_range}");
        // The vertices lie on the original surface. The distance of the triangles from the original surface is limited
        // by their size and the curvature.
        let distance = Distance::between(&mesh, &after, None).unwrap();
        let curvature = if mesh.euler_characteristic() == 2 {
            1.0
        } else {
            2.5
        };
        assert!(
            distance.at_most() < curvature * length * length,
            "{distance:?}"
        );
        let index = SurfaceIndex::new(&mesh).unwrap();
        for &p in after.positions() {
            assert!(index.nearest(p, 0).distance < 1e-12);
        }
    }
}

#[test]
fn no_edge_of_the_result_is_much_too_long() {
    for mesh in [ball(), torus(), waves(), fine_cube()] {
        for length in [0.3, 0.2, 0.12, 0.1] {
            let after = remeshed(&mesh, &to(length)).mesh;
            let lengths = after.edges().map(|e| after.length(e.half_edges()[0]));
            let longest = lengths.fold(0.0, f64::max) / length;
            assert!(longest < 1.4, "{longest}");
        }
    }
}

#[test]
fn a_cube_keeps_its_corners_its_edges_and_its_volume() {
    let cube = fine_cube();
    let features = sharp(&cube, 30.0);
    let options = Options {
        features: &features,
        ..to(0.17)
    };
    let after = remeshed(&cube, &options).mesh;
    for corner in shapes::cube().positions() {
        assert!(after.positions().contains(corner));
    }
    assert_eq!(crate::bounds(&after), crate::bounds(&cube));
    assert!((crate::volume(&after) - crate::volume(&cube)).abs() < 1e-12);
    // The sharp edges of the result cover the 12 edges of the cube, which have length 2.
    let sides: f64 = sharp(&after, 80.0)
        .into_iter()
        .map(|e| after.length(e.half_edges()[0]))
        .sum();
    assert!((sides - 24.0).abs() < 1e-12, "{sides}");
    let angles = smallest_angles(&after);
    let mean = angles.iter().sum::<f64>() / angles.len() as f64;
    assert!(mean > 49.5 && angles[0] > 25.0, "{mean} {}", angles[0]);
    assert_no_face_is_turned_over(&cube, &after);
}

#[test]
fn vertices_on_features_slide_along_their_curve() {
    let cylinder = triangles(&shapes::cylinder(128, true));
    let features = sharp(&cylinder, 30.0);
    assert_eq!(features.len(), 256);
    let options = Options {
        features: &features,
        ..to(0.1)
    };
    let after = remeshed(&cylinder, &options).mesh;
    let rim = sharp(&after, 80.0);
    assert!(rim.len() > 100 && rim.len() < 170, "{}", rim.len());
    // The rim of the original cylinder is a regular polygon with 128 corners. Each vertex of the new rim lies on a side
    // of this polygon.
    let inner = libm::cos(std::f64::consts::PI / 128.0);
    for v in rim.into_iter().flat_map(|e| after.edge_vertices(e)) {
        let p = after.position(v);
        let radius = libm::hypot(p.x, p.y);
        assert!((p.z.abs() - 1.0).abs() < 1e-15);
        assert!(radius > inner - 1e-12 && radius < 1.0 + 1e-12, "{radius}");
    }
    assert_eq!(
        crate::bounds(&after).map(|b| b.map(|p| p.z)),
        Some([-1.0, 1.0])
    );
}

#[test]
fn an_open_surface_keeps_its_boundary_and_its_area() {
    for length in [0.03, 0.1, 0.4] {
        let after = remeshed(&square(20), &to(length)).mesh;
        assert!((crate::area(&after) - 1.0).abs() < 1e-12);
        assert_eq!(
            crate::bounds(&after),
            Some([DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0)])
        );
        let ideal = 4.0 / 3.0_f64.sqrt() / (length * length);
        let n = after.n_faces() as f64;
        assert!(n > 0.6 * ideal && n < 1.5 * ideal, "{n} {ideal}");
    }
    let after = remeshed(&waves(), &to(0.05)).mesh;
    assert_no_face_is_turned_over(&waves(), &after);
}

#[test]
fn pinned_vertices_keep_their_bits() {
    let mesh = torus();
    let pinned: Vec<VertexId> = mesh.vertices().step_by(7).collect();
    let options = Options {
        pinned: &pinned,
        ..to(0.3)
    };
    let after = remeshed(&mesh, &options).mesh;
    for v in pinned {
        assert!(after.positions().contains(&mesh.position(v)));
    }
    let all: Vec<VertexId> = mesh.vertices().collect();
    let fixed = remeshed(
        &mesh,
        &Options {
            pinned: &all,
            ..to(0.3)
        },
    );
    assert_eq!(fixed.mesh.n_vertices(), mesh.n_vertices());
    assert_eq!(
        fixed.counts.refused().next(),
        Some((Refused::Lines, fixed.mesh.n_edges()))
    );
}

#[test]
fn curved_places_get_short_edges() {
    let mesh = triangles(&shapes::torus(120, 60, 1.0, 0.25));
    let length = Length::Curvature {
        error: 0.002,
        min: 0.01,
        max: 0.2,
    };
    // The largest normal curvature is 4 everywhere, so the target length is sqrt(6 * 0.002 / 4 - 3 * 0.002^2).
    let options = Options {
        length,
        ..Options::default()
    };
    let after = remeshed(&mesh, &options).mesh;
    let lengths: f64 = after.edges().map(|e| after.length(e.half_edges()[0])).sum();
    let mean = lengths / after.n_edges() as f64;
    assert!((mean / 0.0547 - 1.0).abs() < 0.1, "{mean}");
    let distance = Distance::between(&mesh, &after, None).unwrap();
    assert!(distance.at_most() < 0.004, "{distance:?}");
    // This mesh is a flat square with a bump.
    let mut bump = square(80);
    for p in bump.positions_mut() {
        let r = (p.x - 0.5) * (p.x - 0.5) + (p.y - 0.5) * (p.y - 0.5);
        p.z = 0.1 * libm::exp(-80.0 * r);
    }
    let length = Length::Curvature {
        error: 0.001,
        min: 0.01,
        max: 0.15,
    };
    let after = remeshed(&bump, &Options { length, ..options }).mesh;
    let mean = |is_counted: fn(DVec3) -> bool| {
        let chosen = after.edges().filter(|&e| {
            after
                .edge_vertices(e)
                .iter()
                .all(|&v| is_counted(after.position(v)))
        });
        let lengths: Vec<f64> = chosen.map(|e| after.length(e.half_edges()[0])).collect();
        lengths.iter().sum::<f64>() / lengths.len() as f64
    };
    let [steep, flat] = [mean(|p| p.z > 0.05), mean(|p| p.x < 0.2 && p.y < 0.2)];
    assert!(flat > 3.0 * steep, "{flat} {steep}");
}

#[test]
fn an_error_is_never_exceeded() {
    for (mesh, length, error) in [
        (torus(), 0.2, 0.01),
        (waves(), 0.2, 0.005),
        (ball(), 0.5, 0.01),
    ] {
        let free = remeshed(&mesh, &to(length)).mesh;
        assert!(Distance::between(&mesh, &free, None).unwrap().largest() > error);
        let options = Options {
            error: Some(error),
            ..to(length)
        };
        let after = remeshed(&mesh, &options).mesh;
        let distance = Distance::between(&mesh, &after, None).unwrap();
        assert!(
            distance.at_most() <= 1.01 * error && distance.largest() <= error,
            "{distance:?}"
        );
        assert!(after.n_faces() < 16 * free.n_faces(), "{}", after.n_faces());
    }
    // If the number of passes is 0, the mesh does not change.
    let none = Options {
        passes: 0,
        error: Some(0.02),
        ..to(0.1)
    };
    assert!(remeshed(&torus(), &none).mesh == torus());
}

#[test]
fn it_stops_when_a_pass_changes_nothing() {
    let many = Options {
        passes: 1000,
        ..to(0.12)
    };
    let result = remeshed(&torus(), &many);
    assert!(result.counts.passes < 100, "{:?}", result.counts);
    let again = remeshed(&result.mesh, &many);
    assert_eq!(
        (again.counts.split, again.counts.collapsed),
        (0, 0),
        "{:?}",
        again.counts
    );
}

#[test]
fn the_result_is_the_same_for_any_number_of_threads() {
    let mesh = with_uv(ball(), |p| if p.z > 0.2 { 1.0 } else { 0.0 });
    let features = sharp(&mesh, 9.0);
    let length = Length::Curvature {
        error: 0.004,
        min: 0.03,
        max: 0.2,
    };
    for options in [
        to(0.08),
        Options {
            length,
            features: &features,
            error: Some(0.05),
            ..to(0.1)
        },
    ] {
        let results = [1, 2, 8].map(|n| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(n)
                .build()
                .unwrap();
            pool.install(|| remeshed(&mesh, &options))
        });
        assert_eq!(results[0].mesh, results[1].mesh);
        assert_eq!(results[0].mesh, results[2].mesh);
        assert_eq!(results[0].counts, results[2].counts);
    }
}

#[test]
fn very_small_and_very_large_meshes_give_the_same_result() {
    let before = torus();
    let expected = remeshed(&before, &to(0.2)).mesh;
    for factor in [-300, -50, 50, 300].map(|exponent| libm::ldexp(1.0, exponent)) {
        let mut scaled = before.clone();
        scaled.positions_mut().iter_mut().for_each(|p| *p *= factor);
        let after = remeshed(&scaled, &to(0.2 * factor)).mesh;
        assert_eq!(after.connectivity(), expected.connectivity());
        let mut pairs = after.positions().iter().zip(expected.positions());
        assert!(pairs.all(|(p, q)| *p == *q * factor));
    }
}

#[test]
fn small_and_degenerate_meshes_are_remeshed() {
    let triangle = |points: [(f64, f64); 3]| {
        let positions = points.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        Mesh::from_polygons(positions, &[[0, 1, 2]]).unwrap().0
    };
    let one = triangle([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
    assert_eq!(remeshed(&one, &to(5.0)).mesh.n_faces(), 1);
    let many = remeshed(&one, &to(0.1)).mesh;
    assert!((crate::area(&many) - 0.5).abs() < 1e-12 && many.n_faces() > 80);
    // A needle, a triangle with collinear corners, and a triangle with three equal corners.
    for (points, length) in [
        ([(0.0, 0.0), (1.0, 0.0), (0.5, 1e-9)], 0.1),
        ([(0.0, 0.0), (1.0, 0.0), (0.5, 0.0)], 0.1),
        ([(0.0, 0.0); 3], 0.1),
    ] {
        let result = remeshed(&triangle(points), &to(length));
        assert!(result.mesh.n_faces() < 200);
    }
    let empty = Mesh::default();
    assert_eq!(remeshed(&empty, &to(1.0)).mesh, empty);
    // The mesh has two components, one of them smaller than the target length.
    let mut two = ball();
    for p in two.positions_mut() {
        *p = *p * 1e-3 + DVec3::X;
    }
    let parts = [ball(), two];
    let mut positions = Vec::new();
    let mut polygons: Vec<[u32; 3]> = Vec::new();
    for part in &parts {
        let first = u32::try_from(positions.len()).unwrap();
        positions.extend_from_slice(part.positions());
        polygons.extend(part.faces().map(|f| {
            let v: Vec<u32> = part
                .face_vertices(f)
                .map(|v| u32::try_from(v.index()).unwrap())
                .collect();
            [v[0], v[1], v[2]].map(|v| v + first)
        }));
    }
    let both = Mesh::from_polygons(positions, &polygons).unwrap().0;
    let after = remeshed(&both, &to(0.2)).mesh;
    assert_eq!(crate::n_components(&after), 2);
}

#[test]
fn a_boundary_with_a_zero_length_edge_is_remeshed() {
    for first in 0..3 {
        let mut points = [[0.1, 0.2, 0.3], [1.3, 2.7, 3.1], [0.1, 0.2, 0.3]];
        points.rotate_left(first);
        let points = points.map(DVec3::from_array).to_vec();
        let slit = Mesh::from_polygons(points, &[[0, 1, 2]]).unwrap().0;
        for passes in [1, 10] {
            let options = Options { passes, ..to(0.3) };
            assert!(remeshed(&slit, &options).mesh.n_faces() < 200);
        }
    }
}

#[test]
fn an_edge_with_one_vertex_opposite_on_both_sides_is_not_split() {
    // Two triangles with the same three vertices lie back to back. A split would add two edges between the new vertex
    // and the opposite vertex.
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y].to_vec();
    let mesh = Mesh::from_polygons(points, &[[0, 1, 2], [0, 2, 1]]);
    let mesh = mesh.unwrap().0;
    let after = remeshed(&mesh, &to(0.2));
    assert_eq!(after.mesh.n_edges(), 3);
}

#[test]
fn an_error_holds_for_very_small_and_very_large_meshes() {
    for factor in [1e-150, 1e150] {
        let mesh = scaled(&triangles(&shapes::uv_sphere(12, 8)), factor);
        let options = Options {
            error: Some(0.05 * factor),
            ..to(0.5 * factor)
        };
        let after = remeshed(&mesh, &options).mesh;
        let distance = Distance::between(&mesh, &after, None).unwrap();
        assert!(distance.at_most() <= 0.051 * factor);
    }
}

#[test]
fn what_cannot_work_is_refused() {
    let refused = |mesh: &Mesh, options: &Options| remesh(mesh, options, &NoProgress).unwrap_err();
    assert_eq!(
        refused(&shapes::cube(), &to(1.0)),
        RemeshError::NotTriangle(FaceId::new(0))
    );
    for length in [1e-9, 1e-300] {
        assert!(matches!(
            refused(&ball(), &to(length)),
            RemeshError::TooManyFaces { .. }
        ));
    }
    let few = Options {
        max_faces: 1000,
        ..to(0.05)
    };
    assert!(matches!(
        refused(&ball(), &few),
        RemeshError::TooManyFaces { max: 1000, .. }
    ));
    let huge = remesh(&scaled(&ball(), 1e308), &to(1.0), &NoProgress);
    assert!(matches!(huge, Err(RemeshError::TooManyFaces { .. })));
}

fn scaled(mesh: &Mesh, factor: f64) -> Mesh {
    let mut mesh = mesh.clone();
    mesh.positions_mut().iter_mut().for_each(|p| *p *= factor);
    mesh
}

#[test]
fn it_can_be_cancelled_at_any_report() {
    struct After(std::sync::atomic::AtomicU64);
    impl Progress for After {
        fn advance(&self, _: &str, _: u64, _: u64) -> bool {
            let relaxed = std::sync::atomic::Ordering::Relaxed;
            self.0
                .fetch_update(relaxed, relaxed, |n| n.checked_sub(1))
                .is_ok()
        }
    }
    let options = Options {
        error: Some(0.1),
        passes: 2,
        ..to(0.3)
    };
    for n in 0..20 {
        let cancelled = remesh(&torus(), &options, &After(n.into()));
        assert_eq!(
            cancelled.err(),
            Some(RemeshError::Cancelled(Cancelled)),
            "{n}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The input is any list of triangles between points of a small grid, including triangles without area, at any
    /// scale.
    #[test]
    fn soups_of_triangles_keep_the_invariants(
        points in proptest::collection::vec((0..4_u8, 0..4_u8, 0..4_u8), 4..24),
        triangles in proptest::collection::vec([0..24_usize, 0..24_usize, 0..24_usize], 1..60),
        exponent in -300..300_i32, length in 0.4..4.0, has_features: bool, error in proptest::option::of(0.1..1.0),
    ) {
        let scale = libm::ldexp(1.0, exponent);
        let positions: Vec<DVec3> = points.iter()
            .map(|&(x, y, z)| scale * DVec3::new(f64::from(x), f64::from(y), f64::from(z)))
            .collect();
        let polygons: Vec<[u32; 3]> = triangles.iter()
            .map(|t| t.map(|v| u32::try_from(v % positions.len()).unwrap()))
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        let Ok((mesh, _)) = Mesh::from_polygons(positions, &polygons) else {
            return Ok(());
        };
        let features = if has_features { sharp(&mesh, 30.0) } else { Vec::new() };
        let options = Options {
            features: &features,
            error: None,
            passes: 4,
            ..to(scale * length)
        };
        let after = remeshed(&mesh, &options).mesh;
        prop_assert!(after.n_faces() < 100_000);
        // The result lies inside the bounding box of the original mesh.
        if let (Some([min, max]), Some([low, high])) = (crate::bounds(&mesh), crate::bounds(&after)) {
            let slack = DVec3::splat(1e-12 * scale);
            prop_assert!((low + slack).cmpge(min).all() && (high - slack).cmple(max).all());
        }
        if let Some(error) = error {
            let limited = Options { error: Some(scale * error), max_faces: 1_000, ..options };
            match remesh(&mesh, &limited, &NoProgress) {
                Ok(result) => {
                    let distance = Distance::between(&mesh, &result.mesh, Some(0.01 * scale * error));
                    prop_assert!(distance.is_none_or(|d| d.at_most() <= 1.02 * scale * error));
                }
                Err(error) => {
                    let is_expected = matches!(error, RemeshError::TooFar { .. } | RemeshError::TooManyFaces { .. });
                    prop_assert!(is_expected, "{error}");
                }
            }
        }
    }
}

#[test]
fn the_diagonal_is_that_of_both_boxes() {
    // The benchmarks divide distances by this diagonal.
    assert!((diagonal(&fine_cube(), &fine_cube()) - 12.0_f64.sqrt()).abs() < 1e-12);
}
