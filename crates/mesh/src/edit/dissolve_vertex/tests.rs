use super::*;
use crate::edit::testing::{dressed, polygons, ring, shapes_to_try, spur, undone_and_redone};
use crate::{CREASE, EdgeId, MATERIAL, UV, shapes};
use glam::DVec3;

fn vertex(v: usize) -> VertexId {
    VertexId::new(v)
}

/// The edit is refused, and every array stays bit-identical.
fn refused(mesh: &Mesh, v: usize) -> EditError {
    undone_and_redone(mesh, |mesh| mesh.dissolve_vertex(vertex(v)).map(drop)).unwrap_err()
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
fn faces_at_a_boundary_vertex_become_one_and_its_two_rims_one_edge() {
    let mut mesh = shapes::grid(2, 1);
    let f = mesh.dissolve_vertex(vertex(1)).unwrap();
    assert_eq!(mesh.defects(), []);
    assert_eq!(polygons(&mesh), [[0, 2, 5, 4, 3]]);
    assert_eq!((f, counts(&mesh)), (FaceId::new(0), [5, 5, 1]));
}

#[test]
fn a_corner_of_one_face_is_cut_off() {
    let mut mesh = shapes::square();
    mesh.dissolve_vertex(vertex(2)).unwrap();
    assert_eq!(mesh.defects(), []);
    assert_eq!(polygons(&mesh), [[0, 1, 3]]);
}

#[test]
fn it_is_the_inverse_of_poke_face() {
    for shape in shapes_to_try() {
        for f in shape.faces() {
            let mut mesh = shape.clone();
            let m = mesh.poke_face(f).unwrap();
            assert_eq!(mesh.dissolve_vertex(m), Ok(f));
            assert_eq!(mesh.defects(), []);
            same_after_compact(mesh, &shape);
        }
    }
}

#[test]
fn it_is_the_inverse_of_split_edge_where_no_triangle_is_cut() {
    for shape in [
        dressed(shapes::grid(3, 2)),
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
            same_after_compact(mesh, &shape);
        }
    }
}

/// The same mesh but for columns that edits drop, and for which half-edge stands for a face or vertex.
fn same_after_compact(mut mesh: Mesh, shape: &Mesh) {
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
fn every_vertex_of_every_shape_dissolves_or_is_refused_and_leaves_no_trace() {
    let mut reasons = Vec::new();
    let mut n_done = 0;
    for shape in shapes_to_try() {
        for v in shape.vertices() {
            match undone_and_redone(&shape, |mesh| mesh.dissolve_vertex(v).map(drop)) {
                Ok(mesh) => {
                    n_done += 1;
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
    assert!(n_done > 60, "{n_done}");
    let is_known = |reason: &EditError| {
        matches!(
            reason,
            EditError::FewCorners(_)
                | EditError::RepeatedVertex(_)
                | EditError::DuplicateEdge(..)
                | EditError::Seam(_)
        )
    };
    assert!(reasons.iter().all(is_known), "{reasons:?}");
}

#[test]
fn the_lower_edge_survives_with_its_values() {
    let mut mesh = shapes::grid(2, 1);
    let rims = [[0, 1], [1, 2]].map(|[v, w]| {
        mesh.find_half_edge(vertex(v), vertex(w))
            .expect("a rim")
            .edge()
    });
    mesh.set(CREASE, (0..7).map(f64::from).collect());
    mesh.dissolve_vertex(vertex(1)).unwrap();
    let left = rims.into_iter().min().unwrap();
    let joined = mesh.find_half_edge(vertex(0), vertex(2)).unwrap().edge();
    assert_eq!(joined, left);
    assert_eq!(mesh.get(CREASE).unwrap()[left.index()], left.index() as f64);
}

#[test]
fn corners_keep_their_values_on_both_sides_of_a_joint() {
    let mut mesh = dressed(shapes::grid(2, 1));
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
fn a_seam_is_dropped_only_when_told_to() {
    let mesh = dressed(shapes::grid(2, 2));
    assert!(matches!(refused(&mesh, 4), EditError::Seam(_)));
    let drop = |mesh: &mut Mesh| {
        mesh.dissolve_vertex_with(vertex(4), Seams::Drop)
            .map(|_| ())
    };
    let mesh = undone_and_redone(&mesh, drop).unwrap();
    // Seen from the middle, face 0 is counter-clockwise of the edge to 3, and face 1 of that to 1.
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
fn a_seam_that_ends_at_the_vertex_is_lost_with_it() {
    // The corners at the tip differ, as at the pole of a sphere; those on the rim do not.
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
    // Nothing is left to take out: triangles have no fewer corners.
    assert!(matches!(refused(&mesh, 1), EditError::FewCorners(_)));
}

#[test]
fn vertices_with_few_edges_are_refused() {
    let mut mesh = shapes::square();
    mesh.push_vertex(DVec3::ZERO);
    assert_eq!(refused(&mesh, 4), EditError::FewEdges(vertex(4)));
    assert_eq!(refused(&spur(), 4), EditError::FewEdges(vertex(4)));
    // A vertex on the edge to the middle would be left hanging.
    let mut mesh = shapes::grid(2, 2);
    let spoke = mesh.find_half_edge(vertex(4), vertex(5)).unwrap().edge();
    let m = mesh.split_edge(spoke, 0.5).unwrap();
    assert_eq!(refused(&mesh, 4), EditError::FewEdges(m));
    // A vertex on an edge that ends inside a face.
    let mut mesh = spur();
    let m = mesh.split_edge(EdgeId::new(4), 0.5).unwrap();
    assert_eq!(refused(&mesh, m.index()), EditError::FewEdges(vertex(4)));
}

#[test]
fn a_face_does_not_pass_a_vertex_twice() {
    assert_eq!(refused(&spur(), 0), EditError::RepeatedVertex(vertex(0)));
    assert_eq!(refused(&ring(), 3), EditError::RepeatedVertex(vertex(3)));
    // Two faces around a tube meet on both sides.
    let mut tube = shapes::cylinder(4, false);
    for [v, w] in [[1, 5], [3, 7]] {
        let h = tube.find_half_edge(vertex(v), vertex(w)).unwrap();
        tube.dissolve_edge(h.edge()).unwrap();
    }
    assert_eq!(refused(&tube, 0), EditError::RepeatedVertex(vertex(2)));
}

#[test]
fn no_second_edge_joins_two_vertices() {
    // Around a triangular rim the other two corners share an edge.
    let tube = shapes::cylinder(3, false);
    assert_eq!(refused(&tube, 0), {
        let mesh = &tube;
        let spokes: Vec<_> = mesh.vertex_half_edges(vertex(0)).collect();
        EditError::DuplicateEdge(mesh.target(spokes[0]), mesh.target(spokes[2]))
    });
    // Two corners of a face of a hole of three sides.
    assert!(matches!(refused(&ring(), 1), EditError::DuplicateEdge(..)));
}

#[test]
fn a_vertex_that_is_not_there_is_refused() {
    assert_eq!(
        refused(&shapes::cube(), 8),
        EditError::NoSuchVertex(vertex(8))
    );
}
