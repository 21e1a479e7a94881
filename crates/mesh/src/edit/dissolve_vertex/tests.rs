use super::*;
use crate::edit::testing::{
    checked_edit_mesh, polygons, ring, sample_shapes, spur, with_attributes,
};
use crate::{CREASE, EdgeId, MATERIAL, UV, shapes};
use glam::DVec3;

fn vertex(v: usize) -> VertexId {
    VertexId::new(v)
}

/// Checks that the edit is refused and that the mesh is unchanged. Returns the reason.
fn refused(mesh: &Mesh, v: usize) -> EditError {
    checked_edit_mesh(mesh, |mesh| mesh.dissolve_vertex(vertex(v)).map(drop)).unwrap_err()
}

fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

#[test]
fn four_squares_around_a_vertex_become_one_face() {
    let mut mesh = shapes::grid(2, 2);
    assert_eq!(mesh.dissolve_vertex(vertex(4)), Ok(FaceId::new(0)));
    assert_eq!(mesh.defects(), []);
    assert_eq!(polygons(&mesh), [[0, 1, 2, 5, 8, 7, 6, 3]]);
    assert_eq!(counts(&mesh), [8, 8, 1]);
}

#[test]
fn at_a_boundary_vertex_the_faces_become_one_and_the_two_boundary_edges_too() {
    let mut mesh = shapes::grid(2, 1);
    let f = mesh.dissolve_vertex(vertex(1)).unwrap();
    assert_eq!(mesh.defects(), []);
    assert_eq!(polygons(&mesh), [[0, 2, 5, 4, 3]]);
    assert_eq!((f, counts(&mesh)), (FaceId::new(0), [5, 5, 1]));
}

#[test]
fn a_corner_of_a_single_face_is_cut_off() {
    let mut mesh = shapes::square();
    mesh.dissolve_vertex(vertex(2)).unwrap();
    assert_eq!(mesh.defects(), []);
    assert_eq!(polygons(&mesh), [[0, 1, 3]]);
}

#[test]
fn it_is_the_inverse_of_poke_face() {
    for shape in sample_shapes() {
        for f in shape.faces() {
            let mut mesh = shape.clone();
            let m = mesh.poke_face(f).unwrap();
            assert_eq!(mesh.dissolve_vertex(m), Ok(f));
            assert_eq!(mesh.defects(), []);
            assert_same_after_compact(mesh, &shape);
        }
    }
}

#[test]
fn it_is_the_inverse_of_split_edge_if_no_triangle_is_cut() {
    for shape in [
        with_attributes(shapes::grid(3, 2)),
        shapes::square(),
        shapes::cube(),
        shapes::torus(4, 3, 2.0, 1.0),
    ] {
        for e in shape.edges() {
            let mut mesh = shape.clone();
            let m = mesh.split_edge(e, 0.25).unwrap();
            mesh.dissolve_vertex(m).unwrap();
            assert_eq!(mesh.defects(), []);
            assert_eq!(mesh.edge_vertices(e), shape.edge_vertices(e));
            assert_same_after_compact(mesh, &shape);
        }
    }
}

/// Compacts `mesh`, and checks that both meshes have the same polygons, half-edges, positions, UVs and materials. The
/// half-edges stored at vertices and faces are allowed to differ.
fn assert_same_after_compact(mut mesh: Mesh, shape: &Mesh) {
    mesh.compact();
    assert_eq!(polygons(&mesh), polygons(shape));
    assert_eq!(mesh.positions(), shape.positions());
    assert_eq!(mesh.get(UV), shape.get(UV));
    assert_eq!(mesh.get(MATERIAL), shape.get(MATERIAL));
    for h in shape.half_edges() {
        let around = |mesh: &Mesh| (mesh.next(h), mesh.origin(h), mesh.face(h));
        assert_eq!(around(&mesh), around(shape));
    }
}

#[test]
fn every_vertex_of_every_shape_is_dissolved_or_refused() {
    let mut reasons = Vec::new();
    let mut n_dissolved = 0;
    for shape in sample_shapes() {
        for v in shape.vertices() {
            match checked_edit_mesh(&shape, |mesh| mesh.dissolve_vertex(v).map(drop)) {
                Ok(mesh) => {
                    n_dissolved += 1;
                    assert_eq!(mesh.n_vertices() + 1, shape.n_vertices());
                    assert_eq!(mesh.euler_characteristic(), shape.euler_characteristic());
                    assert_eq!(mesh.n_boundary_loops(), shape.n_boundary_loops());
                    assert_eq!(
                        crate::geometry::n_components(&mesh),
                        crate::geometry::n_components(&shape)
                    );
                }
                Err(reason) => reasons.push(reason),
            }
        }
    }
    assert!(n_dissolved > 60, "{n_dissolved}");
    let is_expected = |reason: &EditError| {
        matches!(
            reason,
            EditError::FewCorners(_)
                | EditError::RepeatedVertex(_)
                | EditError::DuplicateEdge(..)
                | EditError::Seam(_)
        )
    };
    assert!(reasons.iter().all(is_expected), "{reasons:?}");
}

#[test]
fn the_edge_with_the_lower_id_remains_with_its_values() {
    let mut mesh = shapes::grid(2, 1);
    let boundary_edges = [[0, 1], [1, 2]].map(|[v, w]| {
        mesh.find_half_edge(vertex(v), vertex(w))
            .expect("the vertices share an edge")
            .edge()
    });
    mesh.set(CREASE, (0..7).map(f64::from).collect());
    mesh.dissolve_vertex(vertex(1)).unwrap();
    let lower = boundary_edges.into_iter().min().unwrap();
    let merged = mesh.find_half_edge(vertex(0), vertex(2)).unwrap().edge();
    assert_eq!(merged, lower);
    let crease = mesh.get(CREASE).unwrap()[lower.index()];
    assert_eq!(crease, lower.index() as f64);
}

#[test]
fn corners_keep_their_values_on_both_sides_of_a_merged_edge() {
    let mut mesh = with_attributes(shapes::grid(2, 1));
    let seam = mesh.find_half_edge(vertex(1), vertex(4)).unwrap().edge();
    let m = mesh.split_edge(seam, 0.5).unwrap();
    mesh.dissolve_vertex(m).unwrap();
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        let shift = if mesh.face(h) == Some(FaceId::new(0)) {
            0.0
        } else {
            10.0
        };
        let expected = mesh.position(mesh.origin(h)).truncate() + glam::DVec2::splat(shift);
        assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{h}");
    }
}

#[test]
fn a_seam_is_dropped_only_with_seams_drop() {
    let mesh = with_attributes(shapes::grid(2, 2));
    assert!(matches!(refused(&mesh, 4), EditError::Seam(_)));
    let drop = |mesh: &mut Mesh| {
        mesh.dissolve_vertex_with(vertex(4), Seams::Drop)
            .map(|_| ())
    };
    let mesh = checked_edit_mesh(&mesh, drop).unwrap();
    // Vertices 1 and 3 are corners of two of the faces. The corner takes the value of the face that is
    // counter-clockwise of the removed edge. At vertex 3, this is face 0. At vertex 1, this is face 1, whose values are
    // shifted by 10.
    for h in mesh.face_half_edges(FaceId::new(0)) {
        let v = mesh.origin(h);
        let shift = if [0, 3].contains(&v.index()) {
            0.0
        } else {
            10.0
        };
        let expected = mesh.position(v).truncate() + glam::DVec2::splat(shift);
        assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{v}");
    }
}

#[test]
fn a_seam_that_ends_at_the_vertex_is_allowed() {
    // At the tip, the corners have different values, as at the pole of a sphere. At each vertex of the rim, the corners
    // have equal values.
    let mut mesh = shapes::square();
    let m = mesh.poke_face(FaceId::new(0)).unwrap();
    let n = mesh.n_half_edges();
    let uvs = (0..n).map(|h| {
        let at_tip = mesh.origin(HalfEdgeId::new(h)) == m;
        glam::DVec2::splat(if at_tip { h as f64 } else { 0.0 })
    });
    let uvs = uvs.collect();
    mesh.set(UV, uvs);
    mesh.dissolve_vertex(m).unwrap();
}

#[test]
fn a_tetrahedron_becomes_two_triangles_back_to_back() {
    let mut mesh = shapes::tetrahedron();
    mesh.dissolve_vertex(vertex(0)).unwrap();
    assert_eq!(mesh.defects(), []);
    assert_eq!(polygons(&mesh), [[1, 3, 2], [1, 2, 3]]);
    // No more vertices can be removed: triangles cannot lose a corner.
    assert!(matches!(refused(&mesh, 1), EditError::FewCorners(_)));
}

#[test]
fn vertices_with_few_edges_are_refused() {
    let mut mesh = shapes::square();
    mesh.push_vertex(DVec3::ZERO);
    assert_eq!(refused(&mesh, 4), EditError::FewEdges(vertex(4)));
    assert_eq!(refused(&spur(), 4), EditError::FewEdges(vertex(4)));
    // If vertex 4, in the middle, were removed, m would be left with one edge.
    let mut mesh = shapes::grid(2, 2);
    let spoke = mesh.find_half_edge(vertex(4), vertex(5)).unwrap().edge();
    let m = mesh.split_edge(spoke, 0.5).unwrap();
    assert_eq!(refused(&mesh, 4), EditError::FewEdges(m));
    // The vertex to remove is on an edge that ends inside a face.
    let mut mesh = spur();
    let m = mesh.split_edge(EdgeId::new(4), 0.5).unwrap();
    assert_eq!(refused(&mesh, m.index()), EditError::FewEdges(vertex(4)));
}

#[test]
fn faces_that_visit_a_vertex_twice_are_refused() {
    assert_eq!(refused(&spur(), 0), EditError::RepeatedVertex(vertex(0)));
    assert_eq!(refused(&ring(), 3), EditError::RepeatedVertex(vertex(3)));
    // The two faces of a tube meet on both sides.
    let mut tube = shapes::cylinder(4, false);
    for [v, w] in [[1, 5], [3, 7]] {
        let h = tube.find_half_edge(vertex(v), vertex(w)).unwrap();
        tube.dissolve_edge(h.edge()).unwrap();
    }
    assert_eq!(refused(&tube, 0), EditError::RepeatedVertex(vertex(2)));
}

#[test]
fn a_second_edge_between_two_vertices_is_refused() {
    // In a boundary loop of three edges, the two neighbors of a vertex share an edge.
    let tube = shapes::cylinder(3, false);
    assert_eq!(refused(&tube, 0), {
        let mesh = &tube;
        let spokes: Vec<_> = mesh.vertex_half_edges(vertex(0)).collect();
        EditError::DuplicateEdge(mesh.target(spokes[0]), mesh.target(spokes[2]))
    });
    // The outer boundary of the ring has three edges.
    assert!(matches!(refused(&ring(), 1), EditError::DuplicateEdge(..)));
}

#[test]
fn a_vertex_that_does_not_exist_is_refused() {
    assert_eq!(
        refused(&shapes::cube(), 8),
        EditError::NoSuchVertex(vertex(8))
    );
}

#[test]
fn large_faces_stay_valid_in_any_order() {
    let grid = shapes::grid(7, 7);
    let orders: [fn(usize) -> usize; 3] = [|i| i, |i| 63 - i, |i| i * 37 % 64];
    for order in orders {
        let mut mesh = grid.clone();
        let mut dissolved = 0;
        for v in (0..64).map(order).map(vertex) {
            let lowest = mesh.vertex_faces(v).min();
            match mesh.dissolve_vertex(v) {
                Ok(f) => {
                    dissolved += 1;
                    assert_eq!(Some(f), lowest);
                }
                Err(EditError::NoSuchVertex(_)) => panic!("{v} is visited once"),
                Err(_) => {}
            }
            assert_eq!(mesh.defects(), []);
            for f in mesh.faces() {
                let mut corners: Vec<VertexId> = mesh.face_vertices(f).collect();
                assert!(mesh.face_half_edges(f).all(|h| mesh.face(h) == Some(f)));
                corners.sort_unstable();
                corners.dedup();
                assert_eq!(corners.len(), mesh.degree(f));
            }
        }
        assert!(dissolved > 40, "{dissolved}");
    }
}
