use super::*;
use crate::{COLOR, CREASE, MATERIAL, UV, shapes};
use glam::{DVec2, DVec3, DVec4};

fn shapes() -> Vec<Mesh> {
    vec![
        shapes::cube(),
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::icosahedron(),
        shapes::torus(5, 4, 2.0, 1.0),
        shapes::cylinder(5, true),
        shapes::grid(3, 3),
        shapes::fans(&shapes::grid(3, 3)),
    ]
}

fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

fn corners(mesh: &Mesh, f: FaceId) -> Vec<usize> {
    mesh.face_vertices(f).map(VertexId::index).collect()
}

/// Checks the result of a bevel. `n_removed` has the numbers of removed vertices and edges.
fn check(before: &Mesh, after: &Mesh, new: FaceId, n_removed: [usize; 2]) {
    let [vertices, edges] = n_removed;
    assert_eq!(after.defects(), []);
    let n = after.degree(new);
    let [v, e, f] = counts(before);
    assert_eq!(counts(after), [v + n - vertices, e + n - edges, f + 1]);
    assert_eq!(
        crate::geometry::genus(after),
        crate::geometry::genus(before)
    );
    assert_eq!(
        crate::geometry::n_components(after),
        crate::geometry::n_components(before)
    );
    assert_eq!(after.boundary_loops(), before.boundary_loops());
}

/// Checks rollback, undo and redo of an edit.
fn check_undo_redo(mesh: &Mesh, edit: impl Fn(&mut Mesh) -> Result<FaceId, EditError>) {
    let mut edited = mesh.clone();
    edited.begin();
    let result = edit(&mut edited);
    let after = edited.clone();
    edited.rollback();
    assert_eq!(&edited, mesh);
    if result.is_err() {
        return;
    }
    edited.begin();
    edit(&mut edited).unwrap();
    let change = edited.commit().unwrap();
    let redo = edited.revert(change);
    assert_eq!(&edited, mesh);
    edited.revert(redo);
    assert_eq!(edited, after);
}

#[test]
fn a_vertex_of_a_cube_becomes_a_triangle() {
    let cube = shapes::cube();
    let mut mesh = cube.clone();
    let around: Vec<_> = cube.vertex_neighbors(VertexId::new(7)).collect();
    let new = mesh.bevel_vertex(VertexId::new(7), 0.25).unwrap();
    check(&cube, &mesh, new, [1, 0]);
    assert_eq!(corners(&mesh, new), [8, 10, 9]);
    for (w, m) in around.iter().zip(8..) {
        let expected = 0.75 * DVec3::ONE + 0.25 * cube.position(*w);
        assert_eq!(mesh.position(VertexId::new(m)), expected);
    }
    let ends = |e| mesh.edge_vertices(EdgeId::new(e)).map(VertexId::index);
    assert_eq!([12, 13, 14].map(ends), [[8, 9], [9, 10], [10, 8]]);
    // The normal points outwards.
    assert!(mesh.face_normal(new).dot(DVec3::ONE) > 1.7);
    // The bevel removes a tetrahedron with three orthogonal edges of length 1/2.
    assert!(
        (crate::geometry::volume(&cube) - crate::geometry::volume(&mesh) - 1.0 / 48.0).abs()
            < 1e-13
    );
}

#[test]
fn every_inner_vertex_of_every_shape_can_be_beveled() {
    for shape in shapes() {
        for v in shape.vertices() {
            let mut mesh = shape.clone();
            match mesh.bevel_vertex(v, 0.25) {
                Ok(new) => {
                    check(&shape, &mesh, new, [1, 0]);
                    assert_eq!(mesh.degree(new), shape.valence(v));
                    assert!(!mesh.has_vertex(v));
                }
                Err(error) => {
                    assert_eq!(error, EditError::BoundaryVertex(v));
                    assert!(shape.is_boundary_vertex(v));
                    assert_eq!(mesh, shape);
                }
            }
            check_undo_redo(&shape, |mesh| mesh.bevel_vertex(v, 0.25));
        }
    }
}

#[test]
fn an_edge_of_a_cube_becomes_a_quad() {
    let cube = shapes::cube();
    let h = cube
        .find_half_edge(VertexId::new(5), VertexId::new(7))
        .unwrap();
    let mut mesh = cube.clone();
    let new = mesh.bevel_edge(h.edge(), 0.25).unwrap();
    check(&cube, &mesh, new, [2, 1]);
    assert_eq!(mesh.degree(new), 4);
    assert!(mesh.faces().filter(|&f| mesh.degree(f) == 5).count() == 2);
    assert!(mesh.face_normal(new).dot(DVec3::new(1.0, 0.0, 1.0)) > 1.4);
    // The bevel removes a prism of length 2. Its cross-section is a right triangle with two sides of length 1/2.
    assert!((crate::geometry::volume(&cube) - crate::geometry::volume(&mesh) - 0.25).abs() < 1e-13);
    // The face starts at the first new vertex and runs counter-clockwise; the vertices are numbered clockwise.
    assert_eq!(corners(&mesh, new), [8, 11, 10, 9]);
    let a = cube.origin(h.edge().half_edges()[0]);
    let first = mesh.position(VertexId::new(8));
    assert!((first - cube.position(a)).length() < 0.51);
}

#[test]
fn every_inner_edge_of_every_shape_can_be_beveled() {
    for shape in shapes() {
        for e in shape.edges() {
            let mut mesh = shape.clone();
            let ends = shape.edge_vertices(e);
            let at_boundary = ends.iter().any(|&v| shape.is_boundary_vertex(v));
            match mesh.bevel_edge(e, 0.25) {
                Ok(new) => {
                    check(&shape, &mesh, new, [2, 1]);
                    let valences: usize = ends.iter().map(|&v| shape.valence(v)).sum();
                    assert_eq!(mesh.degree(new), valences - 2);
                    for f in shape.edge_faces(e).into_iter().flatten() {
                        assert_eq!(mesh.degree(f), shape.degree(f));
                    }
                }
                Err(error) => {
                    assert!(at_boundary, "{error}");
                    assert_eq!(mesh, shape);
                }
            }
            check_undo_redo(&shape, |mesh| mesh.bevel_edge(e, 0.25));
        }
    }
}

#[test]
fn all_edges_and_vertices_can_be_beveled_one_after_the_other() {
    for shape in shapes() {
        let mut mesh = shape.clone();
        for e in shape.edges() {
            let unchanged = mesh.clone();
            if mesh.bevel_edge(e, 0.25).is_err() {
                assert_eq!(mesh, unchanged);
            }
            assert_eq!(mesh.defects(), []);
        }
        for v in shape.vertices().chain(new_vertices(&mesh, &shape)) {
            let unchanged = mesh.clone();
            if mesh.bevel_vertex(v, 0.25).is_err() {
                assert_eq!(mesh, unchanged);
            }
        }
        assert_eq!(mesh.defects(), []);
        assert_eq!(mesh.euler_characteristic(), shape.euler_characteristic());
    }
}

/// Returns the vertices of `mesh` that are not in `before`.
fn new_vertices(mesh: &Mesh, before: &Mesh) -> Vec<VertexId> {
    let n = before.n_vertices();
    mesh.vertices().filter(|v| v.index() >= n).collect()
}

#[test]
fn linear_values_stay_linear_and_other_values_are_copied() {
    let uv = |p: DVec3| DVec2::new(0.5 * p.x - p.y + 3.0, 2.0 * p.y + 0.25 * p.x);
    let mut flat = shapes::fans(&shapes::grid(4, 4));
    let (n_vertices, n_edges, n_faces) = (flat.n_vertices(), flat.n_edges(), flat.n_faces());
    let uvs = flat
        .half_edges()
        .map(|h| uv(flat.position(flat.origin(h))))
        .collect();
    flat.set(UV, uvs);
    flat.set(
        COLOR,
        flat.positions().iter().map(|p| p.extend(1.0)).collect(),
    );
    flat.set(MATERIAL, vec![3; n_faces]);
    flat.set(CREASE, vec![2.0; n_edges]);
    let ends_inside = |e: EdgeId| {
        flat.edge_vertices(e)
            .iter()
            .all(|&v| !flat.is_boundary_vertex(v))
    };
    let e = flat.edges().find(|&e| ends_inside(e)).unwrap();
    let v = flat
        .vertices()
        .filter(|&v| !flat.is_boundary_vertex(v) && !flat.edge_vertices(e).contains(&v))
        .last()
        .unwrap();
    let mut mesh = flat.clone();
    mesh.bevel_edge(e, 0.375).unwrap();
    mesh.bevel_vertex(v, 0.25).unwrap();
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        let actual = mesh.get(UV).unwrap()[h.index()];
        let expected = uv(mesh.position(mesh.origin(h)));
        assert!((actual - expected).length() < 1e-14, "{h}");
    }
    for v in mesh.vertices() {
        let color: DVec4 = mesh.get(COLOR).unwrap()[v.index()];
        assert!((color - mesh.position(v).extend(1.0)).length() < 1e-14);
    }
    assert!(mesh.get(MATERIAL).unwrap().iter().all(|&m| m == 3));
    let creases = mesh.get(CREASE).unwrap();
    assert!(creases[..n_edges].iter().all(|&c| c == 2.0));
    assert!(creases[n_edges..].iter().all(|&c| c == 0.0));
    assert!(mesh.vertices().any(|v| v.index() >= n_vertices));
}

#[test]
fn both_sides_of_a_seam_keep_their_values() {
    // Each face of the cube has a separate square of the texture.
    let mut cube = shapes::cube();
    let uv = |mesh: &Mesh, h: HalfEdgeId| {
        let f = mesh.face(h).unwrap();
        let p = mesh.position(mesh.origin(h));
        let [x, y] = [[p.x, p.y], [p.y, p.z], [p.z, p.x]][[0, 0, 2, 1, 2, 1][f.index()]];
        DVec2::new(x + 10.0 * f.index() as f64, y)
    };
    let uvs = cube.half_edges().map(|h| uv(&cube, h)).collect();
    cube.set(UV, uvs);
    for e in cube.edges() {
        let mut mesh = cube.clone();
        let new = mesh.bevel_edge(e, 0.25).unwrap();
        for h in mesh.half_edges().filter(|&h| mesh.face(h) != Some(new)) {
            // Cuts are on edges of the face, so the face stays planar.
            let actual = mesh.get(UV).unwrap()[h.index()];
            assert!((actual - uv(&mesh, h)).length() < 1e-14, "{e}: {h}");
        }
    }
}

#[test]
fn each_edge_can_have_a_different_fraction() {
    let mut mesh = shapes::cube();
    let v = VertexId::new(0);
    let edges: Vec<EdgeId> = mesh.vertex_half_edges(v).map(HalfEdgeId::edge).collect();
    let fraction = |e: EdgeId| if e == edges[0] { 0.5 } else { 0.25 };
    mesh.bevel_vertex_with(v, fraction).unwrap();
    let lengths = edges.iter().map(|e| mesh.length(e.half_edges()[0]));
    assert_eq!(lengths.collect::<Vec<_>>(), [1.0, 1.5, 1.5]);
}

#[test]
fn an_edge_with_one_face_on_both_sides_can_be_beveled() {
    let mut ring = crate::edit::extrude::tests::slit_ring();
    ring.extrude_faces(&[FaceId::new(0)], DVec3::Z).unwrap();
    let same_face = |e: &EdgeId| ring.edge_faces(*e) == [Some(FaceId::new(0)); 2];
    let e = ring.edges().find(same_face).unwrap();
    let mut mesh = ring.clone();
    let new = mesh.bevel_edge(e, 0.25).unwrap();
    check(&ring, &mesh, new, [2, 1]);
    let v = ring.edge_vertices(e)[0];
    let mut mesh = ring.clone();
    let new = mesh.bevel_vertex(v, 0.25).unwrap();
    check(&ring, &mesh, new, [1, 0]);
    check_undo_redo(&ring, |mesh| mesh.bevel_edge(e, 0.25));
}

#[test]
fn bad_input_is_refused_and_changes_nothing() {
    let mut cube = shapes::cube();
    let m = cube.split_edge(EdgeId::new(0), 0.5).unwrap();
    let vertex = |v: VertexId, t: f64| {
        let mut mesh = cube.clone();
        let reason = mesh.bevel_vertex(v, t).unwrap_err();
        assert_eq!(mesh, cube);
        reason
    };
    let edge = |mesh: &Mesh, e: EdgeId, t: f64| {
        let mut edited = mesh.clone();
        let reason = edited.bevel_edge(e, t).unwrap_err();
        assert_eq!(&edited, mesh);
        reason
    };
    assert_eq!(vertex(m, 0.5), EditError::FewEdges(m));
    assert_eq!(edge(&cube, EdgeId::new(0), 0.5), EditError::FewEdges(m));
    let missing = VertexId::new(99);
    assert_eq!(vertex(missing, 0.5), EditError::NoSuchVertex(missing));
    let missing = EdgeId::new(99);
    assert_eq!(edge(&cube, missing, 0.5), EditError::NoSuchEdge(missing));
    for t in [0.0, 1.0, -0.5, f64::NAN] {
        let reason = vertex(VertexId::new(3), t);
        assert!(matches!(reason, EditError::OutsideEdge(_)), "{t}");
        let reason = edge(&cube, EdgeId::new(5), t);
        assert!(matches!(reason, EditError::OutsideEdge(_)), "{t}");
    }

    let grid = shapes::grid(2, 1);
    for e in grid.edges() {
        let reason = edge(&grid, e, 0.5);
        if grid.is_boundary_edge(e) {
            assert_eq!(reason, EditError::Boundary(e));
        } else {
            assert!(matches!(reason, EditError::BoundaryVertex(_)));
        }
    }
}

#[test]
fn an_edge_with_a_parallel_edge_is_refused_but_its_ends_can_be_beveled() {
    // A tetrahedron in which the edge from 0 to 1 is flipped, so that two edges join 2 and 3.
    let positions = shapes::tetrahedron().positions().to_vec();
    let faces: [&[u32]; 3] = [&[0, 3, 1, 2], &[0, 2, 3], &[1, 3, 2]];
    let (mut with_parallel_edge, _) = Mesh::from_polygons(positions, &faces).unwrap();
    let quad = with_parallel_edge.face_half_edge(FaceId::new(0));
    let corner = |v| {
        with_parallel_edge
            .loop_half_edges(quad)
            .find(|&h| with_parallel_edge.origin(h) == v)
    };
    let [c, d] = [2, 3].map(VertexId::new);
    let (x, y) = (corner(c).unwrap(), corner(d).unwrap());
    let e = with_parallel_edge.insert_edge(x, y, x);

    let mut mesh = with_parallel_edge.clone();
    let error = mesh.bevel_edge(e, 0.25).unwrap_err();
    assert!(matches!(error, EditError::DuplicateEdge(..)), "{error}");
    assert_eq!(mesh, with_parallel_edge);
    let new = mesh.bevel_vertex(c, 0.25).unwrap();
    check(&with_parallel_edge, &mesh, new, [1, 0]);
    assert_eq!(mesh.degree(new), 4);
}
