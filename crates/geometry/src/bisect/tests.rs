//! Tests of `bisect`.

use proptest::prelude::*;

use super::*;
use crate::{area, n_components, shapes};
use mesh::{CREASE, DVec2, MATERIAL, UV};

/// Cuts the mesh, and checks the properties that every cut must have. Also reverts the cut and makes it again.
fn cut(before: &Mesh, point: DVec3, normal: DVec3) -> (Mesh, Bisection) {
    let mut mesh = before.clone();
    mesh.begin();
    let cut = bisect(&mut mesh, point, normal).unwrap();
    assert_eq!(mesh.defects(), []);
    let after = mesh.clone();
    let change = mesh.commit().unwrap();
    let again = mesh.revert(change);
    assert_eq!(&mesh, before);
    mesh.revert(again);
    assert_eq!(mesh, after);

    assert_eq!(mesh.euler_characteristic(), before.euler_characteristic());
    assert_eq!(n_components(&mesh), n_components(before));
    assert_eq!(mesh.n_boundary_loops(), before.n_boundary_loops());
    assert_eq!(cut.front.len() + cut.back.len(), mesh.n_faces());
    assert!(cut.edges.is_sorted());
    let near = 2e-9 * bounds(before).map_or(0.0, |[min, max]| (max - min).max_element());
    let height = |v: VertexId| (mesh.position(v) - point).dot(normal.normalize());
    for (faces, sign) in [(&cut.front, 1.0), (&cut.back, -1.0)] {
        for &f in faces {
            let lowest = mesh.face_vertices(f).map(|v| sign * height(v));
            assert!(lowest.fold(f64::INFINITY, f64::min) > -near, "{f}");
        }
    }
    for e in mesh.edges() {
        let on_plane = mesh.edge_vertices(e).map(|v| height(v).abs() <= near);
        assert_eq!(on_plane == [true; 2], cut.edges.binary_search(&e).is_ok());
        // Every very short edge has an end on the plane.
        assert!(mesh.length(e.half_edges()[0]) > 0.1 * near || on_plane != [false; 2]);
    }
    (mesh, cut)
}

fn counts(mesh: &Mesh) -> (usize, usize, usize) {
    (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces())
}

/// Returns a mesh of one face in the plane z = 0.
fn polygon(points: &[(f64, f64)]) -> Mesh {
    let at = |&(x, y): &(f64, f64)| DVec3::new(x, y, 0.0);
    let corners: Vec<u32> = (0..).take(points.len()).collect();
    Mesh::from_polygons(points.iter().map(at).collect(), &[corners])
        .unwrap()
        .0
}

#[test]
fn a_triangle_becomes_a_triangle_and_a_quadrilateral() {
    let mesh = polygon(&[(0., 0.), (2., 0.), (0., 2.)]);
    let (mesh, found) = cut(&mesh, DVec3::Y, DVec3::Y);
    assert_eq!(counts(&mesh), (5, 6, 2));
    let degrees: Vec<_> = mesh.faces().map(|f| mesh.degree(f)).collect();
    assert_eq!(degrees, [4, 3]);
    assert_eq!((found.front.len(), found.back.len()), (1, 1));
    // A cut through a corner makes two triangles.
    let mesh = polygon(&[(0., 0.), (2., 0.), (0., 2.)]);
    let (mesh, _) = cut(&mesh, DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0));
    assert_eq!(counts(&mesh), (4, 5, 2));
}

#[test]
fn every_shape_can_be_cut_along_any_plane() {
    for shape in [
        shapes::square(),
        shapes::grid(4, 3),
        shapes::cube(),
        shapes::fans(&shapes::cube()),
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::icosahedron(),
        shapes::torus(8, 6, 2.0, 1.0),
        shapes::cylinder(7, true),
        shapes::cylinder(5, false),
        shapes::uv_sphere(8, 5),
        Mesh::default(),
    ] {
        for x in [-1.0, 0.0, 0.3] {
            for y in [-0.5, 0.0, 2.0] {
                for (z, shift) in [(0.0, 0.0), (1.0, 0.25), (1.0, 1.0)] {
                    let normal = DVec3::new(x, y, z);
                    if normal != DVec3::ZERO {
                        cut(&shape, DVec3::splat(shift), normal);
                    }
                }
            }
        }
    }
}

#[test]
fn vertices_on_the_plane_do_not_move_and_edges_on_it_are_returned() {
    // The plane contains the four edges around the middle of an octahedron.
    let (mesh, found) = cut(&shapes::octahedron(), DVec3::ZERO, DVec3::Z);
    assert_eq!(mesh, shapes::octahedron());
    assert_eq!(
        (found.edges.len(), found.front.len(), found.back.len()),
        (4, 4, 4)
    );
    // The plane is 1e-9 above the middle vertices. This distance is below the tolerance, so no edge is cut.
    let (mesh, _) = cut(&shapes::octahedron(), DVec3::Z * 1e-9, DVec3::Z);
    assert_eq!(mesh, shapes::octahedron());
    let (mesh, _) = cut(&shapes::octahedron(), DVec3::Z * 1e-8, DVec3::Z);
    assert_eq!(mesh.n_vertices(), 10);
}

#[test]
fn reversing_the_normal_only_swaps_the_sides() {
    let torus = shapes::torus(9, 7, 2.0, 0.5);
    let (point, normal) = (DVec3::new(0.1, 0.2, 0.05), DVec3::new(1.0, 2.0, 0.5));
    let (mesh, one) = cut(&torus, point, normal);
    let (other_mesh, other) = cut(&torus, point, -normal);
    assert_eq!(mesh.positions(), other_mesh.positions());
    assert_eq!((one.front, one.back), (other.back, other.front));
    assert_eq!(one.edges, other.edges);
}

#[test]
fn a_concave_face_is_cut_several_times() {
    let comb = polygon(&[
        (0., 0.),
        (6., 0.),
        (6., 3.),
        (5., 1.),
        (4., 3.),
        (3., 1.),
        (2., 3.),
        (1., 1.),
        (0., 3.),
    ]);
    let (mesh, found) = cut(&comb, DVec3::Y * 2.0, DVec3::Y);
    assert_eq!(
        (found.front.len(), found.back.len(), found.edges.len()),
        (4, 1, 4)
    );
    assert!((area(&mesh) - area(&comb)).abs() < 1e-12);
    assert!(mesh.faces().all(|f| mesh.area_vector(f).z > 0.0));
    // The plane passes through the lowest corner of each gap between the teeth of the comb.
    let (mesh, found) = cut(&comb, DVec3::Y, DVec3::Y);
    assert_eq!(
        (found.front.len(), found.back.len(), found.edges.len()),
        (4, 1, 4)
    );
    assert!(mesh.faces().all(|f| mesh.area_vector(f).z > 0.0));
    // The plane contains the bottom edge of the comb.
    let (mesh, found) = cut(&comb, DVec3::ZERO, DVec3::Y);
    assert_eq!((mesh, found.edges.len()), (comb, 1));
}

#[test]
fn values_are_interpolated_on_both_sides_of_seams() {
    let mut mesh = shapes::grid(3, 2);
    let chart = |mesh: &Mesh, h: HalfEdgeId| {
        let material = |f: FaceId| f64::from(mesh.get(MATERIAL).unwrap()[f.index()]);
        let p = mesh.position(mesh.origin(h)).truncate();
        mesh.face(h).map_or(DVec2::ZERO, |f| p + 10.0 * material(f))
    };
    mesh.set(MATERIAL, (0..6).collect());
    mesh.set(UV, mesh.half_edges().map(|h| chart(&mesh, h)).collect());
    mesh.set(CREASE, vec![2.0; mesh.n_edges()]);
    let (mesh, found) = cut(&mesh, DVec3::new(0.4, 0.3, 0.0), DVec3::new(1.0, 3.0, 0.5));
    let uvs = mesh.get(UV).unwrap();
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        assert!((uvs[h.index()] - chart(&mesh, h)).length() < 1e-14, "{h}");
    }
    let creases = mesh.get(CREASE).unwrap();
    for e in mesh.edges() {
        let expected = if found.edges.contains(&e) { 0.0 } else { 2.0 };
        assert_eq!(creases[e.index()], expected);
    }
}

#[test]
fn two_faces_that_share_both_crossed_edges_get_separate_edges() {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let (pillow, _) = Mesh::from_polygons(points, &[[0, 1, 2], [0, 2, 1]]).unwrap();
    let (mesh, found) = cut(&pillow, DVec3::Y * 0.5, DVec3::Y);
    assert_eq!(counts(&mesh), (5, 7, 4));
    let ends: Vec<_> = found.edges.iter().map(|&e| mesh.edge_vertices(e)).collect();
    assert_eq!(ends.len(), 2);
}

#[test]
fn a_face_around_a_hole_is_cut_on_both_sides_of_it() {
    // A square with a hole. A slit of two coincident sides connects the first corner of the square with a corner of the
    // hole.
    let ring = |x: f64| [(-x, -x), (x, -x), (x, x), (-x, x)];
    let mut points = ring(4.0).to_vec();
    points.extend(ring(2.0).into_iter().rev());
    let keyhole = [0, 1, 2, 3, 0, 7, 4, 5, 6, 7].map(|i: usize| points[i]);
    let mesh = polygon(&keyhole);
    assert!((area(&mesh) - 48.0).abs() < 1e-12);
    // The first plane crosses the slit. The second plane crosses the hole.
    let (mesh, found) = cut(&mesh, DVec3::Y * -3.0, DVec3::Y);
    assert_eq!((found.edges.len(), mesh.n_faces()), (2, 3));
    let (mesh, found) = cut(&mesh, DVec3::ZERO, DVec3::Y);
    assert_eq!(found.edges.len(), 2);
    assert!((area(&mesh) - 48.0).abs() < 1e-12);
    assert!(mesh.faces().all(|f| mesh.area_vector(f).z > 0.0));
}

#[test]
fn invalid_planes_and_huge_coordinates_return_errors() {
    let mesh = shapes::cube();
    for (point, normal) in [
        (DVec3::ZERO, DVec3::ZERO),
        (DVec3::ZERO, DVec3::new(f64::NAN, 1.0, 0.0)),
        (DVec3::ZERO, DVec3::new(f64::INFINITY, 1.0, 0.0)),
        (DVec3::X * f64::INFINITY, DVec3::Z),
    ] {
        let mut edited = mesh.clone();
        let result = bisect(&mut edited, point, normal);
        assert!(matches!(result, Err(EditError::BadNumber(_))), "{result:?}");
        assert_eq!(edited, mesh);
    }
    let mut huge = mesh.clone();
    huge.positions_mut().iter_mut().for_each(|p| *p *= f64::MAX);
    let before = huge.clone();
    let result = bisect(&mut huge, DVec3::ZERO, DVec3::ONE);
    assert!(matches!(result, Err(EditError::BadNumber(_))), "{result:?}");
    assert_eq!(huge, before);
}

#[test]
fn scaling_the_mesh_and_the_normal_does_not_change_the_cut() {
    let mesh = shapes::icosahedron();
    let (point, normal) = (DVec3::new(0.1, 0.0, 0.25), DVec3::new(0.0, 1.0, 0.5));
    let (expected, _) = cut(&mesh, point, normal);
    for exponent in [-300_i64, -20, 20, 300] {
        let scale = f64::from_bits(u64::try_from(1023 + exponent).unwrap() << 52);
        let mut scaled = mesh.clone();
        scaled.positions_mut().iter_mut().for_each(|p| *p *= scale);
        bisect(&mut scaled, point * scale, normal * scale).unwrap();
        assert_eq!(scaled.connectivity(), expected.connectivity(), "{exponent}");
    }
}

#[test]
fn far_from_the_origin_the_tolerance_covers_rounding_errors() {
    let mut mesh = shapes::icosahedron();
    mesh.positions_mut().iter_mut().for_each(|p| *p += 1e9);
    let (point, normal) = (DVec3::splat(1e9), DVec3::new(1.0, 2.0, 3.0));
    let mut once = mesh.clone();
    let cut = bisect(&mut once, point, normal).unwrap();
    let mut twice = once.clone();
    assert_eq!(bisect(&mut twice, point, normal).unwrap(), cut);
    assert_eq!(once, twice);
}

proptest! {
    #[test]
    fn cutting_star_shaped_faces_keeps_the_total_area(
        radii in prop::collection::vec(0.2..3.0_f64, 3..40),
        offset in -1.5..1.5_f64,
        turn in 0.0..6.3_f64,
    ) {
        let n = radii.len();
        let points: Vec<_> = radii.iter().enumerate().map(|(i, r)| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * i as f64 / n as f64);
            (r * cos, r * sin)
        }).collect();
        let mesh = polygon(&points);
        let (sin, cos) = libm::sincos(turn);
        let normal = DVec3::new(cos, sin, 0.0);
        let (after, _) = cut(&mesh, normal * offset, normal);
        prop_assert!((area(&after) - area(&mesh)).abs() < 1e-9 * area(&mesh));
        prop_assert!(after.faces().all(|f| after.area_vector(f).z > -1e-9));
    }

    #[test]
    fn any_polygon_is_cut_to_one_sided_parts(
        points in prop::collection::vec((-4..5_i8, -4..5_i8, -1..2_i8), 3..20),
        normal in (-2..3_i8, -2..3_i8, -2..3_i8),
    ) {
        prop_assume!(normal != (0, 0, 0));
        let at = |&(x, y, z): &(i8, i8, i8)| DVec3::new(f64::from(x), f64::from(y), f64::from(z));
        let corners: Vec<u32> = (0..).take(points.len()).collect();
        let (mut mesh, _) = Mesh::from_polygons(points.iter().map(at).collect(), &[corners]).unwrap();
        let heights = |mesh: &Mesh, normal: DVec3| -> Vec<f64> {
            mesh.positions().iter().map(|p| p.dot(normal)).collect()
        };
        let normal = at(&normal);
        let found = bisect(&mut mesh, DVec3::ZERO, normal).unwrap();
        prop_assert_eq!(mesh.defects(), []);
        let height = heights(&mesh, normal);
        for (faces, sign) in [(&found.front, 1.0), (&found.back, -1.0)] {
            for &f in faces {
                prop_assert!(mesh.face_vertices(f).all(|v| sign * height[v.index()] > -1e-6));
            }
        }
    }
}
