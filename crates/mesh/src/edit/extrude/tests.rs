use super::*;
use crate::{CREASE, Column, Domain, EdgeId, MATERIAL, Rule, UV, Values, shapes};
use glam::DVec2;

fn faces(numbers: &[usize]) -> Vec<FaceId> {
    numbers.iter().map(|&i| FaceId::new(i)).collect()
}

fn corners(mesh: &Mesh, f: FaceId) -> Vec<usize> {
    mesh.face_vertices(f).map(VertexId::index).collect()
}

fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

/// Extrudes faces upwards by 1 and checks the properties that hold for any faces.
fn extruded(mesh: &Mesh, numbers: &[usize]) -> (Mesh, Vec<FaceId>) {
    let mut result = mesh.clone();
    let sides = result.extrude_faces(&faces(numbers), DVec3::Z).unwrap();
    assert_eq!(result.defects(), [], "{numbers:?}");
    let n = sides.len();
    let [v, e, f] = counts(mesh);
    assert_eq!(counts(&result), [v + n, e + 2 * n, f + n]);
    let chi = mesh.euler_characteristic();
    assert_eq!(result.euler_characteristic(), chi, "{numbers:?}");
    assert_eq!(result.boundary_loops(), mesh.boundary_loops());
    assert!(sides.iter().all(|&side| result.degree(side) == 4));
    let positions = |mesh: &Mesh, f| -> Vec<_> {
        let corners = mesh.face_vertices(f);
        corners.map(|v| mesh.position(v)).collect()
    };
    for f in mesh.faces() {
        if numbers.contains(&f.index()) {
            let moved: Vec<_> = positions(mesh, f).iter().map(|&p| p + DVec3::Z).collect();
            assert_eq!(positions(&result, f), moved, "{f} of {numbers:?}");
        } else {
            assert_eq!(corners(&result, f), corners(mesh, f), "{f} of {numbers:?}");
            assert_eq!(positions(&result, f), positions(mesh, f));
        }
    }
    (result, sides)
}

#[test]
fn extruding_the_top_of_a_cube_adds_four_sides() {
    let (mesh, sides) = extruded(&shapes::cube(), &[1]);
    assert!(mesh.is_closed());
    assert_eq!(
        (
            crate::geometry::genus(&mesh),
            crate::geometry::n_components(&mesh)
        ),
        (0, 1)
    );
    assert_eq!(crate::geometry::area(&mesh), 32.0);
    assert!((crate::geometry::volume(&mesh) - 12.0).abs() < 1e-13);
    assert_eq!(sides, faces(&[6, 7, 8, 9]));
}

#[test]
fn ids_are_given_as_documented() {
    let (mesh, sides) = extruded(&shapes::cube(), &[1]);
    // Before the extrusion, the corners of the face were 4, 5, 7 and 6.
    assert_eq!(corners(&mesh, FaceId::new(1)), [8, 9, 10, 11]);
    let around: Vec<_> = sides.iter().map(|&side| corners(&mesh, side)).collect();
    assert_eq!(
        around,
        [[4, 5, 9, 8], [5, 7, 10, 9], [7, 6, 11, 10], [6, 4, 8, 11]]
    );
    let ends = |e| mesh.edge_vertices(EdgeId::new(e)).map(VertexId::index);
    assert_eq!(
        (12..20).map(ends).collect::<Vec<_>>(),
        [
            [8, 9],
            [4, 8],
            [9, 10],
            [5, 9],
            [10, 11],
            [7, 10],
            [11, 8],
            [6, 11]
        ]
    );
}

#[test]
fn the_same_face_can_be_extruded_repeatedly() {
    let mut mesh = shapes::cube();
    for level in 1..=5 {
        let sides = mesh.extrude_faces(&faces(&[1]), DVec3::Z).unwrap();
        assert_eq!(sides.len(), 4);
        assert_eq!(mesh.defects(), []);
        assert!((crate::geometry::volume(&mesh) - 8.0 - 4.0 * f64::from(level)).abs() < 1e-12);
        assert_eq!(mesh.face_normal(FaceId::new(1)), DVec3::Z);
    }
}

#[test]
fn faces_that_share_an_edge_move_together() {
    let (mesh, sides) = extruded(&shapes::grid(3, 3), &[4, 5]);
    assert_eq!(sides.len(), 6);
    // The two moved faces still share an edge.
    let pair = [FaceId::new(4), FaceId::new(5)].map(Some);
    assert!(mesh.edges().any(|e| {
        let [f, g] = mesh.edge_faces(e);
        [f, g] == pair || [g, f] == pair
    }));
}

#[test]
fn vertices_inside_the_faces_keep_their_ids() {
    // Extrudes the four squares in the middle of a 4 x 4 grid, around vertex 12.
    let (mesh, sides) = extruded(&shapes::grid(4, 4), &[5, 6, 9, 10]);
    assert_eq!(sides.len(), 8);
    let middle = VertexId::new(12);
    assert_eq!(mesh.position(middle).z, 1.0);
    assert_eq!(mesh.valence(middle), 4);
    assert!(mesh.vertex_faces(middle).all(|f| f.index() < 16));
}

#[test]
fn each_fan_at_a_shared_vertex_gets_a_separate_copy() {
    // Extrudes two opposite squares at the middle vertex, 4.
    let (mesh, sides) = extruded(&shapes::grid(2, 2), &[0, 3]);
    assert_eq!(sides.len(), 8);
    let middle = VertexId::new(4);
    let copies = mesh
        .vertices()
        .filter(|&v| mesh.position(v) == mesh.position(middle) + DVec3::Z);
    assert_eq!(copies.count(), 2);
    assert_eq!(mesh.valence(middle), 6);
}

#[test]
fn a_whole_sheet_becomes_a_box_that_is_open_below() {
    let sheet = shapes::grid(2, 1);
    let (mesh, sides) = extruded(&sheet, &[0, 1]);
    assert_eq!(sides.len(), 6);
    assert_eq!(
        (mesh.n_boundary_loops(), crate::geometry::genus(&mesh)),
        (1, 0)
    );
    // The boundary has not changed.
    for v in sheet.vertices() {
        assert!(mesh.is_boundary_vertex(v));
        assert_eq!(mesh.position(v), sheet.position(v));
    }
}

#[test]
fn a_ring_of_faces_gets_sides_along_both_of_its_boundaries() {
    let mut ring = shapes::grid(3, 3);
    ring.delete_face(FaceId::new(4)).unwrap();
    let (mesh, sides) = extruded(&ring, &[0, 1, 2, 3, 5, 6, 7, 8]);
    assert_eq!(sides.len(), 16);
    assert_eq!(mesh.n_boundary_loops(), 2);
}

/// Returns a ring of one face, which lies on both sides of the edge from 0 to 4.
///
/// ```text
///    3 ----------- 2
///    |   7 --- 6   |
///    |   |     |   |
///    |   4 --- 5   |
///    | /           |
///    0 ----------- 1
/// ```
pub(in crate::edit) fn slit_ring() -> Mesh {
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let outer = [p(0., 0.), p(3., 0.), p(3., 3.), p(0., 3.)];
    let inner = [p(1., 1.), p(2., 1.), p(2., 2.), p(1., 2.)];
    let halves = [[0, 1, 2, 6, 5, 4], [0, 4, 7, 6, 2, 3]];
    let (mut mesh, _) = Mesh::from_polygons([outer, inner].concat(), &halves).unwrap();
    // Merge the two faces by removing the edge from 2 to 6.
    let cut = mesh
        .find_half_edge(VertexId::new(2), VertexId::new(6))
        .unwrap();
    let [f, g] = [cut, cut.twin()].map(|h| mesh.face(h).unwrap());
    for h in mesh.clone().face_half_edges(g) {
        mesh.set_face(h, Some(f));
    }
    let ends = [cut, cut.twin()].map(|h| (mesh.prev(h), mesh.next(h.twin())));
    for (before, after) in ends {
        mesh.set_next(before, after);
        mesh.set_face_half_edge(f, after);
    }
    mesh.kill(g);
    mesh.kill(cut.edge());
    mesh.compact();
    assert_eq!(mesh.defects(), []);
    mesh
}

#[test]
fn a_face_on_both_sides_of_an_edge_is_extruded_along_both_boundaries() {
    let (mesh, sides) = extruded(&slit_ring(), &[0]);
    assert_eq!(sides.len(), 8);
    assert_eq!(mesh.degree(FaceId::new(0)), 10);
    assert_eq!(
        (mesh.n_boundary_loops(), crate::geometry::genus(&mesh)),
        (2, 0)
    );
}

#[test]
fn a_closed_component_only_moves() {
    let (mesh, sides) = extruded(&shapes::cube(), &[0, 1, 2, 3, 4, 5]);
    assert_eq!(sides, []);
    assert!((0..8).all(|v| {
        let v = VertexId::new(v);
        mesh.position(v) == shapes::cube().position(v) + DVec3::Z
    }));
}

#[test]
fn every_subset_of_the_faces_of_small_shapes_can_be_extruded() {
    let pillow = {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        Mesh::from_polygons(positions, &[[0, 1, 2], [0, 2, 1]])
            .unwrap()
            .0
    };
    let mut with_valence_two = shapes::grid(2, 1);
    with_valence_two.split_edge(EdgeId::new(0), 0.5).unwrap();
    for shape in [
        shapes::cube(),
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::grid(3, 2),
        shapes::square(),
        shapes::fans(&shapes::square()),
        pillow,
        with_valence_two,
    ] {
        let n = shape.n_faces();
        for subset in 1..1_usize << n {
            let numbers: Vec<usize> = (0..n).filter(|i| subset >> i & 1 == 1).collect();
            extruded(&shape, &numbers);
        }
    }
}

#[test]
fn every_extrusion_can_be_undone_and_redone() {
    for shape in [
        shapes::cube(),
        shapes::torus(4, 3, 2.0, 1.0),
        shapes::grid(3, 3),
        shapes::cylinder(5, true),
    ] {
        for f in shape.faces() {
            let beside = shape.face_half_edges(f).find_map(|h| shape.face(h.twin()));
            let chosen = [Some(f), beside].into_iter().flatten().collect::<Vec<_>>();
            let mut mesh = shape.clone();
            mesh.begin();
            mesh.extrude_faces(&chosen, DVec3::ONE).unwrap();
            mesh.rollback();
            assert_eq!(mesh, shape);

            mesh.begin();
            mesh.extrude_faces(&chosen, DVec3::ONE).unwrap();
            let change = mesh.commit().unwrap();
            let after = mesh.clone();
            let redo = mesh.revert(change);
            assert_eq!(mesh, shape);
            mesh.revert(redo);
            assert_eq!(mesh, after);
        }
    }
}

/// Returns a cube whose elements have different attribute values.
fn cube_with_attributes() -> Mesh {
    let mut mesh = shapes::cube();
    let uv = |h: HalfEdgeId| DVec2::new(h.index() as f64, 0.5);
    mesh.set(UV, mesh.half_edges().map(uv).collect());
    mesh.set(MATERIAL, (0..6).collect());
    mesh.set(CREASE, (0..12).map(f64::from).collect());
    let tags = Column {
        name: "even".to_owned(),
        rule: Rule::Copy,
        values: Values::Tag((0..8).map(|v| v % 2 == 0).collect()),
    };
    mesh.insert_column(Domain::Vertex, tags);
    mesh
}

#[test]
fn sides_and_copies_have_the_values_of_the_originals() {
    let before = cube_with_attributes();
    let (mesh, sides) = extruded(&before, &[1]);
    let top = FaceId::new(1);
    assert_eq!(mesh.get(MATERIAL).unwrap(), [0, 1, 2, 3, 4, 5, 1, 1, 1, 1]);
    let uv = mesh.get(UV).unwrap();
    let old = before.get(UV).unwrap();
    let creases = mesh.get(CREASE).unwrap();
    let even = mesh.tag(Domain::Vertex, "even").unwrap();
    let old_corners = before.face_half_edges(top);
    for ((h, new), &side) in old_corners.zip(mesh.face_half_edges(top)).zip(&sides) {
        assert_eq!(uv[new.index()], old[h.index()]);
        assert_eq!(creases[new.edge().index()], creases[h.edge().index()]);
        assert_eq!(even[mesh.origin(new).index()], even[mesh.origin(h).index()]);
        let around: Vec<_> = mesh.face_half_edges(side).map(|h| uv[h.index()]).collect();
        let (a, b) = (old[h.index()], old[before.next(h).index()]);
        assert_eq!(around, [a, b, b, a]);
        assert!(!mesh.is_seam(new.edge()));
        // The edge from v to v'.
        let upright = mesh.prev(mesh.face_half_edge(side)).edge();
        assert_eq!(creases[upright.index()], 0.0);
    }
    // Corners of other faces keep their values.
    for h in before.half_edges().filter(|&h| before.face(h) != Some(top)) {
        assert_eq!(uv[h.index()], old[h.index()]);
    }
}

#[test]
fn bad_input_is_refused_and_changes_nothing() {
    let cube = cube_with_attributes();
    let refused = |faces: &[FaceId], offset: DVec3| {
        let mut mesh = cube.clone();
        let reason = mesh.extrude_faces(faces, offset).unwrap_err();
        assert_eq!(mesh, cube);
        reason
    };
    let (f, missing) = (FaceId::new(2), FaceId::new(6));
    assert_eq!(refused(&[], DVec3::Z), EditError::NoElements);
    assert_eq!(refused(&[f, f], DVec3::Z), EditError::FaceListedTwice(f));
    assert_eq!(
        refused(&[f, missing], DVec3::Z),
        EditError::NoSuchFace(missing)
    );
    assert_eq!(
        refused(&[FaceId::NONE], DVec3::Z),
        EditError::NoSuchFace(FaceId::NONE)
    );
    for x in [f64::NAN, f64::INFINITY] {
        let reason = refused(&[f], DVec3::splat(x));
        assert!(matches!(reason, EditError::BadNumber(_)), "{reason:?}");
    }
}
