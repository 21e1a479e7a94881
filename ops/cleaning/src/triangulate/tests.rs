//! Tests of the operation.

use super::*;
use geometry::shapes;
use mesh::{Attribute, CREASE, DVec2, DVec3, EdgeId, FaceId, MATERIAL, UV, VertexId};
use op::Files;
use op::test::{applied, try_applied};
use proptest::prelude::*;

fn all() -> Triangulate {
    Triangulate::default()
}

/// Returns a mesh of one face in the plane z = 0.
fn polygon(points: &[(f64, f64)]) -> Mesh {
    let at = |&(x, y): &(f64, f64)| DVec3::new(x, y, 0.0);
    let corners: Vec<u32> = (0..).take(points.len()).collect();
    Mesh::from_polygons(points.iter().map(at).collect(), &[corners])
        .unwrap()
        .0
}

/// Whether the mesh has an edge between two vertices.
fn joined(mesh: &Mesh, v: usize, w: usize) -> bool {
    mesh.find_half_edge(VertexId::new(v), VertexId::new(w))
        .is_some()
}

fn planned(operation: &Triangulate, mesh: &Mesh) -> MeshPlan {
    let files = Files::default();
    let cx = PlanContext::new(&files);
    let mut plan = MeshPlan::of(mesh);
    assert_eq!(MeshOperation::plan(operation, &mut plan, &cx), []);
    plan
}

/// Cuts the mesh and checks the properties that hold for every triangulation.
fn checked(operation: &Triangulate, before: &Mesh) -> (Mesh, Report) {
    let (after, report) = try_applied(operation, before.clone()).unwrap();
    assert_eq!(after.positions(), before.positions());
    assert_eq!(after.euler_characteristic(), before.euler_characteristic());
    assert_eq!(after.n_boundary_loops(), before.n_boundary_loops());
    for e in before.edges() {
        assert_eq!(after.edge_vertices(e), before.edge_vertices(e));
    }
    let plan = planned(operation, before);
    assert!(plan.vertices.contains(after.n_vertices() as u64));
    assert!(plan.edges.contains(after.n_edges() as u64));
    assert!(plan.faces.contains(after.n_faces() as u64));
    assert!(
        after
            .faces()
            .all(|f| plan.degrees.contains(after.degree(f) as u64))
    );
    (after, report)
}

#[test]
fn shapes_become_triangles_of_the_same_area() {
    for mesh in [
        Mesh::default(),
        shapes::square(),
        shapes::cube(),
        shapes::grid(4, 3),
        shapes::tetrahedron(),
        shapes::torus(7, 5, 2.0, 0.5),
        shapes::cylinder(3, true),
        shapes::cylinder(17, true),
        shapes::cylinder(200, true),
        shapes::uv_sphere(6, 5),
    ] {
        let (cut, report) = checked(&all(), &mesh);
        assert!(cut.faces().all(|f| cut.is_triangle(f)));
        assert!(
            (geometry::area(&cut) - geometry::area(&mesh)).abs() <= 1e-12 * geometry::area(&mesh)
        );
        assert!(
            (geometry::volume(&cut) - geometry::volume(&mesh)).abs()
                <= 1e-12 * geometry::area(&mesh)
        );
        assert_eq!(report.notes, Vec::<String>::new());
    }
}

#[test]
fn a_mesh_of_triangles_does_not_change() {
    let mesh = shapes::icosahedron();
    let (cut, report) = try_applied(&all(), mesh.clone()).unwrap();
    assert_eq!((cut, report), (mesh, Report::default()));
}

#[test]
fn a_quad_is_cut_along_its_shorter_diagonal() {
    assert!(joined(
        &applied(&all(), polygon(&[(0., 0.), (3., 0.), (4., 1.), (0., 1.)])),
        1,
        3
    ));
    assert!(joined(
        &applied(&all(), polygon(&[(0., 0.), (2., 0.), (2., 1.), (-1., 1.)])),
        0,
        2
    ));
}

#[test]
fn equal_diagonals_are_decided_by_the_lowest_vertex() {
    // The diagonals of a rotated square are equal up to rounding.
    for turn in 0..50 {
        let at = |i: u32| {
            let (sin, cos) =
                libm::sincos(0.1 * f64::from(turn) + f64::from(i) * std::f64::consts::FRAC_PI_2);
            DVec3::new(cos, sin, 0.0) + 5.0
        };
        for corners in [[0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2]] {
            let (mesh, _) = Mesh::from_polygons((0..4).map(at).collect(), &[corners]).unwrap();
            assert!(joined(&applied(&all(), mesh), 0, 2), "{turn} {corners:?}");
        }
    }
}

#[test]
fn a_quad_with_a_reflex_corner_is_cut_at_that_corner() {
    // `arrow` is a convex kite, so it is cut along its shorter diagonal. `reflex` is an arrow head, and only its longer
    // diagonal lies inside it.
    let arrow = [(0.0, 0.0), (1.0, -0.2), (8.0, 0.0), (1.0, 0.2)];
    let reflex = [(0.0, 0.0), (9.0, -0.1), (8.9, 0.0), (9.0, 0.1)];
    for (points, kept) in [(arrow, false), (reflex, true)] {
        for first in 0..4 {
            let mut turned = points;
            turned.rotate_left(first);
            let cut = applied(&all(), polygon(&turned));
            // `a` and `b` are the vertices that had the ids 0 and 2 before the rotation.
            let [a, b] = [(4 - first) % 4, (6 - first) % 4];
            assert_eq!(joined(&cut, a, b), kept, "{points:?} {first}");
        }
    }
}

#[test]
fn a_quad_with_a_corner_on_a_side_gets_no_empty_triangle() {
    for first in 0..4 {
        let mut points = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 9.0)];
        points.rotate_left(first);
        let cut = applied(&all(), polygon(&points));
        assert!(cut.faces().all(|f| cut.face_area(f) > 1.0));
    }
}

#[test]
fn two_quads_back_to_back_become_a_tetrahedron() {
    let points = shapes::square().positions().to_vec();
    let (pillow, _) = Mesh::from_polygons(points, &[[0, 1, 2, 3], [3, 2, 1, 0]]).unwrap();
    let (cut, report) = checked(&all(), &pillow);
    assert!(cut.is_closed());
    assert!(joined(&cut, 0, 2) && joined(&cut, 1, 3));
    assert_eq!(report.notes, Vec::<String>::new());
}

#[test]
fn a_diagonal_between_joined_vertices_is_avoided() {
    // An edge behind the square already joins the vertices 0 and 2.
    let points = vec![
        DVec3::ZERO,
        DVec3::X,
        DVec3::new(0.9, 0.9, 0.0),
        DVec3::Y,
        DVec3::new(0.5, 0.5, -1.0),
    ];
    let faces: [&[u32]; 3] = [&[0, 1, 2, 3], &[1, 0, 4, 2], &[0, 2, 4]];
    let (mesh, report) = Mesh::from_polygons(points, &faces).unwrap();
    assert!(report.is_clean());
    let one = Triangulate {
        faces: FaceSelection::Faces(vec![0]),
    };
    let (cut, report) = checked(&one, &mesh);
    assert!(joined(&cut, 1, 3));
    assert_eq!(report.notes, Vec::<String>::new());
}

#[test]
fn unavoidable_duplicate_diagonals_are_counted_and_the_mesh_stays_closed() {
    // Two quads in the shape of arrow heads, back to back. In each quad, only one diagonal lies inside the quad.
    let points = vec![
        DVec3::ZERO,
        DVec3::new(2.0, 1.0, 0.0),
        DVec3::X,
        DVec3::new(2.0, -1.0, 0.0),
    ];
    let (mesh, _) = Mesh::from_polygons(points, &[[0, 1, 2, 3], [3, 2, 1, 0]]).unwrap();
    let (cut, report) = checked(&all(), &mesh);
    assert!(cut.is_closed());
    assert_eq!(
        report.notes,
        ["diagonals between vertices that are also joined by another edge: 1"]
    );
}

#[test]
fn concave_faces_are_covered_once() {
    let comb: Vec<(f64, f64)> = (0..40)
        .flat_map(|i| {
            let x = f64::from(i);
            [(x, 0.0), (x + 0.5, 9.0)]
        })
        .chain([(40.0, 0.0), (40.0, -1.0), (0.0, -1.0)])
        .rev()
        .collect();
    let cross = [
        (1., 0.),
        (2., 0.),
        (2., 1.),
        (3., 1.),
        (3., 2.),
        (2., 2.),
        (2., 3.),
        (1., 3.),
        (1., 2.),
        (0., 2.),
        (0., 1.),
        (1., 1.),
    ];
    // A square with a square hole. A slit connects the hole to the border, and two vertices coincide at each end of the
    // slit.
    let keyhole = [
        (0., 0.),
        (4., 0.),
        (4., 4.),
        (0., 4.),
        (0., 0.),
        (1., 1.),
        (1., 3.),
        (3., 3.),
        (3., 1.),
        (1., 1.),
    ];
    for (points, area) in [(&comb[..], 220.0), (&cross[..], 5.0), (&keyhole[..], 12.0)] {
        let mesh = polygon(points);
        let (cut, report) = checked(&all(), &mesh);
        assert_eq!(report.notes, Vec::<String>::new());
        assert!(
            (geometry::area(&mesh) - area).abs() < 1e-12 * area,
            "{}",
            geometry::area(&mesh)
        );
        assert!(
            (geometry::area(&cut) - area).abs() < 1e-12 * area,
            "{}",
            geometry::area(&cut)
        );
    }
}

#[test]
fn collinear_corners_are_kept_without_empty_triangles() {
    let mut points = Vec::new();
    for (from, to) in [
        ((0., 0.), (6., 0.)),
        ((6., 0.), (0., 6.)),
        ((0., 6.), (0., 0.)),
    ] {
        let (from, to): ((f64, f64), (f64, f64)) = (from, to);
        for i in 0..6 {
            let t = f64::from(i) / 6.0;
            points.push((from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1)));
        }
    }
    let (cut, report) = checked(&all(), &polygon(&points));
    assert_eq!((cut.n_faces(), report.notes.len()), (16, 0));
    assert!((geometry::area(&cut) - 18.0).abs() < 1e-12);
    assert!(cut.faces().all(|f| cut.face_area(f) > 0.1));
}

#[test]
fn faces_that_ear_clipping_cannot_cut_become_fans_and_are_counted() {
    let line: Vec<(f64, f64)> = (0..6).map(|i| (f64::from(i), 0.0)).collect();
    let eight = [(0., 0.), (4., 4.), (4., 0.), (0., 4.), (-1., 2.)];
    for points in [&line[..], &[(1.0, 1.0); 5][..]] {
        let (cut, report) = checked(&all(), &polygon(points));
        assert_eq!(cut.n_faces(), points.len() - 2);
        let note = "faces with zero area or with crossing sides, cut into fans: 1";
        assert_eq!(report.notes, [note]);
        assert_eq!(cut.valence(VertexId::new(0)), points.len() - 1);
    }
    // If the sides of the face cross, ear clipping may fail, but the mesh is valid in any case.
    checked(&all(), &polygon(&eight));
}

#[test]
fn scaling_does_not_change_the_diagonals() {
    let mesh = shapes::cylinder(11, true);
    let expected = applied(&all(), mesh.clone());
    // Multiplying coordinates by a power of two causes no rounding error.
    for exponent in [-900_i64, -300, 1, 300, 1000] {
        let scale = f64::from_bits(u64::try_from(1023 + exponent).unwrap() << 52);
        let mut scaled = mesh.clone();
        scaled.positions_mut().iter_mut().for_each(|p| *p *= scale);
        let cut = applied(&all(), scaled);
        assert_eq!(cut.connectivity(), expected.connectivity(), "{scale}");
    }
    let mut huge = shapes::square();
    huge.positions_mut()
        .iter_mut()
        .for_each(|p| *p = (*p * 2.0 - 1.0) * f64::MAX);
    assert_eq!(applied(&all(), huge).n_faces(), 2);
}

#[test]
fn values_stay_with_their_elements() {
    let mut mesh = shapes::cylinder(7, true);
    let uv = |mesh: &Mesh, h| {
        let p = mesh.position(mesh.origin(h));
        // Each face has a separate UV chart.
        let f = mesh.get(MATERIAL).unwrap()[mesh.face(h).unwrap().index()];
        DVec2::new(p.x + 10.0 * f64::from(f), p.y + p.z)
    };
    mesh.set(MATERIAL, (0..9).collect());
    mesh.set(UV, mesh.half_edges().map(|h| uv(&mesh, h)).collect());
    mesh.set(CREASE, (0..21).map(|e| f64::from(e) + 1.0).collect());
    let tag = Attribute::<VertexId, bool>::new("it", mesh::Rule::Copy);
    mesh.set(tag, (0..14).map(|v| v == 5).collect());
    let (cut, _) = checked(&all(), &mesh);
    // Triangles are in the order of their faces.
    let expected: Vec<i32> = (0..7)
        .flat_map(|f| [f; 2])
        .chain([7; 5])
        .chain([8; 5])
        .collect();
    assert_eq!(cut.get(MATERIAL).unwrap(), expected);
    let uvs = cut.get(UV).unwrap();
    assert!(cut.half_edges().all(|h| uvs[h.index()] == uv(&cut, h)));
    let creases = cut.get(CREASE).unwrap();
    assert_eq!(creases[..21], *mesh.get(CREASE).unwrap());
    assert!(creases[21..].iter().all(|&c| c == 0.0));
    assert_eq!(cut.get(tag).unwrap(), mesh.get(tag).unwrap());
    // No diagonal is a seam.
    assert!((21..cut.n_edges()).all(|e| !cut.is_seam(EdgeId::new(e))));
}

#[test]
fn only_selected_faces_are_cut() {
    let top = Triangulate {
        faces: FaceSelection::Faces(vec![1]),
    };
    let (cut, report) = checked(&top, &shapes::cube());
    let degrees: Vec<usize> = cut.faces().map(|f: FaceId| cut.degree(f)).collect();
    assert_eq!(degrees, [4, 3, 3, 4, 4, 4, 4]);
    assert_eq!(report.changed, 1);
}

#[test]
fn the_plan_of_faces_of_one_degree_is_exact() {
    let plan = planned(&all(), &shapes::torus(6, 5, 2.0, 0.5));
    assert_eq!(
        (plan.faces, plan.edges),
        (Range::exactly(60), Range::exactly(90))
    );
    assert!(plan.is_triangles());
    let mut unknown = MeshPlan::unknown();
    unknown.edges = Range::at_most(100);
    let files = Files::default();
    let cx = PlanContext::new(&files);
    MeshOperation::plan(&all(), &mut unknown, &cx);
    assert_eq!(unknown.edges, Range::at_most(300));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let mesh = shapes::torus(61, 47, 2.0, 0.5);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| applied(&all(), mesh.clone()))
    };
    assert_eq!(with(1), with(2));
    assert_eq!(with(1), with(8));
}

#[test]
fn parameters_are_read() {
    let parse = |text| op::test::read::<Triangulate>(text);
    assert_eq!(parse("()").unwrap().faces, FaceSelection::All);
    assert_eq!(
        parse("(faces: Degree(5))").unwrap().faces,
        FaceSelection::Degree(5)
    );
    assert!(parse("(method: Fan)").is_err());
}

proptest! {
    #[test]
    fn star_shaped_faces_are_covered_once_in_any_plane(
        radii in prop::collection::vec(0.1..3.0_f64, 4..40),
        normal in prop::array::uniform3(-1.0..1.0_f64),
        offset in prop::sample::select(vec![0.0, 1e3]),
    ) {
        let normal = DVec3::from_array(normal);
        prop_assume!(normal.length() > 0.1);
        let (x, y) = normal.normalize().any_orthonormal_pair();
        let n = radii.len();
        let points = radii.iter().enumerate().map(|(i, r)| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * i as f64 / n as f64);
            r * cos * x + r * sin * y + offset
        });
        let corners: Vec<u32> = (0..).take(n).collect();
        let (mesh, _) = Mesh::from_polygons(points.collect(), &[corners]).unwrap();
        let (cut, report) = checked(&all(), &mesh);
        prop_assert_eq!(report.notes, Vec::<String>::new());
        prop_assert_eq!(cut.n_faces(), n - 2);
        // `area` adds the absolute areas of the faces, so overlapping or turned-over triangles would increase the
        // total.
        prop_assert!((geometry::area(&cut) - geometry::area(&mesh)).abs() < 1e-9 * geometry::area(&mesh));
    }

    #[test]
    fn any_polygon_leaves_a_valid_mesh(
        points in prop::collection::vec((-4..5_i8, -4..5_i8, -1..2_i8), 3..20),
    ) {
        let at = |&(x, y, z): &(i8, i8, i8)| DVec3::new(f64::from(x), f64::from(y), f64::from(z));
        let corners: Vec<u32> = (0..).take(points.len()).collect();
        let (mesh, _) = Mesh::from_polygons(points.iter().map(at).collect(), &[corners]).unwrap();
        let (cut, _) = checked(&all(), &mesh);
        prop_assert_eq!(cut.n_faces(), points.len() - 2);
    }
}
