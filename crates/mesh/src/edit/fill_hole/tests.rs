use super::*;
use crate::edit::testing::{checked_edit, half_edge, polygons, with_slit};
use crate::{EdgeId, MATERIAL, UV, shapes};
use glam::{DVec2, DVec3};

/// Returns meshes with holes: shapes with one or more faces removed, open sheets, and tubes.
fn open_shapes() -> Vec<Mesh> {
    let mut shapes = vec![
        shapes::square(),
        shapes::grid(3, 2),
        shapes::fans(&shapes::grid(3, 3)),
        shapes::cylinder(5, false),
    ];
    for (mut mesh, faces) in [
        (shapes::cube(), &[1][..]),
        (shapes::torus(6, 5, 2.0, 1.0), &[0, 1, 5, 22]),
        (shapes::icosahedron(), &[0, 1, 2]),
        (shapes::grid(5, 5), &[6, 7, 16]),
    ] {
        for &f in faces {
            mesh.delete_face(FaceId::new(f)).unwrap();
        }
        shapes.push(mesh);
    }
    shapes
}

fn with_values(mut mesh: Mesh) -> Mesh {
    let uv = |h| mesh.position(mesh.origin(HalfEdgeId::new(h))).truncate() * 2.0 + DVec2::X;
    let n = mesh.domain_len(crate::Domain::Corner);
    mesh.set(UV, (0..n).map(uv).collect());
    let n = i32::try_from(mesh.domain_len(crate::Domain::Face)).unwrap();
    mesh.set(MATERIAL, (0..n).collect());
    mesh
}

#[test]
fn filling_the_hole_of_a_deleted_face_restores_the_face() {
    for mesh in [shapes::cube(), shapes::octahedron(), shapes::grid(3, 3)] {
        let all = polygons(&mesh);
        for f in mesh.faces() {
            let mut mesh = mesh.clone();
            let h = mesh.face_half_edge(f);
            if mesh.face_vertices(f).any(|v| mesh.is_boundary_vertex(v)) {
                continue;
            }
            mesh.delete_face(f).unwrap();
            let (filled, _) = checked_edit(&mesh, |m| m.fill_hole(h)).unwrap();
            let mut expected = all.clone();
            let deleted = expected.remove(f.index());
            expected.push(deleted);
            assert_eq!(polygons(&filled), expected);
        }
    }
}

#[test]
fn every_hole_can_be_filled_from_each_of_its_edges() {
    for mesh in open_shapes().into_iter().map(with_values) {
        let euler = mesh.euler_characteristic();
        for h in mesh.half_edges() {
            let one = checked_edit(&mesh, |m| m.fill_hole(h));
            let many = checked_edit(&mesh, |m| crate::geometry::fill_hole_triangles(m, h));
            if mesh.face(h).is_some() {
                let refused = EditError::NotBoundary(h);
                assert_eq!(one.unwrap_err(), refused);
                assert_eq!(many.unwrap_err(), refused);
                continue;
            }
            let n = mesh.loop_half_edges(h).count();
            let (one, f) = one.unwrap();
            assert_eq!(one.degree(f), n);
            let (many, triangles) = many.unwrap();
            assert_eq!(triangles.len(), n - 2);
            assert!(triangles.iter().all(|&f| many.is_triangle(f)));
            assert_eq!(many.n_edges(), mesh.n_edges() + n - 3);
            for filled in [&one, &many] {
                assert_eq!(filled.euler_characteristic(), euler + 1);
                assert_eq!(filled.n_boundary_loops(), mesh.n_boundary_loops() - 1);
            }
        }
    }
}

#[test]
fn linear_uvs_stay_linear_and_the_material_is_that_of_the_face_beside() {
    let mut mesh = with_values(shapes::grid(4, 4));
    for f in [5, 6, 9, 10] {
        mesh.delete_face(FaceId::new(f)).unwrap();
    }
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_none()) {
        let beside = mesh.face(h.twin()).unwrap().index();
        for triangles in [false, true] {
            let (filled, faces) = checked_edit(&mesh, |m| {
                if triangles {
                    crate::geometry::fill_hole_triangles(m, h)
                } else {
                    m.fill_hole(h).map(|f| vec![f])
                }
            })
            .unwrap();
            for f in faces {
                assert_eq!(
                    filled.get(MATERIAL).unwrap()[f.index()],
                    mesh.get(MATERIAL).unwrap()[beside]
                );
                for h in filled.face_half_edges(f) {
                    let p = filled.position(filled.origin(h)).truncate();
                    assert_eq!(filled.get(UV).unwrap()[h.index()], p * 2.0 + DVec2::X);
                }
            }
        }
    }
}

#[test]
fn a_planar_square_hole_gets_no_triangle_without_area() {
    let mut mesh = shapes::grid(6, 6);
    for f in [14, 15, 20, 21] {
        mesh.delete_face(FaceId::new(f)).unwrap();
    }
    let inner = half_edge(&mesh, 16, 17);
    let hole = [inner, inner.twin()]
        .into_iter()
        .find(|&h| mesh.face(h).is_none())
        .unwrap();
    let (filled, triangles) =
        checked_edit(&mesh, |m| crate::geometry::fill_hole_triangles(m, hole)).unwrap();
    assert_eq!(triangles.len(), 6);
    assert!(triangles.iter().all(|&f| filled.face_area(f) > 0.1));
    assert!((crate::geometry::area(&filled) - 36.0).abs() < 1e-12);
}

#[test]
fn triangles_never_repeat_an_edge() {
    // A tetrahedron without two faces: one diagonal of the open square is already an edge.
    let mut mesh = shapes::tetrahedron();
    mesh.delete_face(FaceId::new(0)).unwrap();
    mesh.delete_face(FaceId::new(1)).unwrap();
    let h = mesh.boundary_loops()[0];
    let rim: Vec<VertexId> = mesh.loop_half_edges(h).map(|h| mesh.origin(h)).collect();
    assert_eq!(rim.len(), 4);
    let kept = mesh.edges().find(|&e| !mesh.is_boundary_edge(e)).unwrap();
    let (filled, _) = checked_edit(&mesh, |m| crate::geometry::fill_hole_triangles(m, h)).unwrap();
    assert!(filled.is_closed());
    assert_eq!(filled.n_edges(), 6);
    let [a, b] = mesh.edge_vertices(kept);
    let new = EdgeId::new(filled.domain_len(crate::Domain::Edge) - 1);
    assert!(!filled.edge_vertices(new).contains(&a));
    assert!(!filled.edge_vertices(new).contains(&b));
}

#[test]
fn a_hole_whose_diagonals_are_all_edges_is_refused() {
    // Any two of the seven vertices of this torus share an edge. One of the vertices is removed.
    let positions = shapes::icosahedron().positions()[..7].to_vec();
    let polygons: Vec<[u32; 3]> = (0..7)
        .flat_map(|i| [[i, i + 1, i + 3], [i, i + 3, i + 2]])
        .map(|corners| corners.map(|v| v % 7))
        .filter(|corners| !corners.contains(&6))
        .collect();
    let (mesh, report) = Mesh::from_polygons(positions, &polygons).unwrap();
    assert!(report.is_clean());
    let h = mesh.boundary_loops()[0];
    assert_eq!(mesh.loop_half_edges(h).count(), 6);
    let error = checked_edit(&mesh, |m| crate::geometry::fill_hole_triangles(m, h)).unwrap_err();
    let EditError::DuplicateEdge(v, w) = error else {
        panic!("{error}");
    };
    assert!(mesh.find_half_edge(v, w).is_some());
    assert!(checked_edit(&mesh, |m| m.fill_hole(h)).is_ok());
}

#[test]
fn a_hole_with_many_edges_is_filled_quickly() {
    let n = 2000;
    let mesh = shapes::cylinder(n, false);
    let mut filled = mesh.clone();
    for h in mesh.boundary_loops() {
        crate::geometry::fill_hole_triangles(&mut filled, h).unwrap();
    }
    assert_eq!(filled.defects(), []);
    assert!(filled.is_closed());
    let expected = shapes::cylinder(n, true);
    assert!((crate::geometry::area(&filled) - crate::geometry::area(&expected)).abs() < 1e-9);
    assert!((crate::geometry::volume(&filled) - crate::geometry::volume(&expected)).abs() < 1e-9);
    // The triangles do not form a fan, so no vertex gets many edges.
    assert!(filled.vertices().all(|v| filled.valence(v) < 30));
}

#[test]
fn a_loop_of_two_edges_and_a_pinched_loop_are_refused() {
    let mesh = with_slit(shapes::tetrahedron(), EdgeId::new(2));
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_none()) {
        let refused = EditError::ShortLoop(h);
        assert_eq!(
            checked_edit(&mesh, |m| m.fill_hole(h)).unwrap_err(),
            refused
        );
        let many = checked_edit(&mesh, |m| crate::geometry::fill_hole_triangles(m, h));
        assert_eq!(many.unwrap_err(), refused);
    }

    // Two triangles share a vertex, and their boundaries are linked into one loop.
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = vec![p(0., 0.), p(1., 0.), p(0., 1.), p(-1., 0.), p(0., -1.)];
    let (mut mesh, _) = Mesh::from_polygons(positions, &[[0, 1, 2], [0, 3, 4]]).unwrap();
    let v = VertexId::new(0);
    let copy = VertexId::new(5);
    let [a, b] = [v, copy].map(|v| mesh.vertex_half_edge(v).unwrap());
    let [before_a, before_b] = [a, b].map(|h| mesh.prev(h));
    mesh.set_next(before_a, b);
    mesh.set_next(before_b, a);
    let outgoing: Vec<_> = mesh
        .half_edges()
        .filter(|&h| mesh.origin(h) == copy)
        .collect();
    for h in outgoing {
        mesh.set_origin(h, v);
    }
    assert_eq!(mesh.fill_hole(a), Err(EditError::Pinch(v)));
    assert_eq!(
        crate::geometry::fill_hole_triangles(&mut mesh, a),
        Err(EditError::Pinch(v))
    );
}

#[test]
fn a_half_edge_that_does_not_exist_is_refused() {
    for h in [HalfEdgeId::NONE, HalfEdgeId::new(8)] {
        let refused = EditError::NoSuchHalfEdge(h);
        let mesh = shapes::square();
        assert_eq!(
            checked_edit(&mesh, |m| m.fill_hole(h)).unwrap_err(),
            refused
        );
        let many = checked_edit(&mesh, |m| crate::geometry::fill_hole_triangles(m, h));
        assert_eq!(many.unwrap_err(), refused);
    }
}
