use super::*;
use crate::edit::testing::{checked_edit, half_edge, polygons};
use crate::{CREASE, Domain, FaceId, MATERIAL, UV, VERTEX_NORMAL, shapes};
use glam::{DVec2, DVec3};

fn edge(mesh: &Mesh, v: usize, w: usize) -> EdgeId {
    half_edge(mesh, v, w).edge()
}

fn meshes() -> Vec<Mesh> {
    vec![
        shapes::grid(3, 3),
        shapes::fans(&shapes::grid(3, 2)),
        shapes::cube(),
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::icosahedron(),
        shapes::torus(4, 3, 2.0, 1.0),
        shapes::cylinder(5, true),
    ]
}

/// Checks that both meshes have the same faces and the same numbers of elements.
fn assert_same_topology(mesh: &Mesh, original: &Mesh) {
    assert_eq!(polygons(mesh), polygons(original));
    let counts = |m: &Mesh| (m.n_vertices(), m.n_edges(), m.n_faces());
    assert_eq!(counts(mesh), counts(original));
}

/// Stitches the two sides of each cut edge. Skips an edge if the stitch of a previous edge has already stitched both
/// sides.
fn stitch_all(mesh: &mut Mesh, edges: &[EdgeId], new: &[EdgeId]) {
    for (e, new) in edges.iter().zip(new) {
        let ([_, h], [g, _]) = (e.half_edges(), new.half_edges());
        if mesh.has_edge(*e) && mesh.has_edge(*new) {
            assert_eq!(mesh.stitch_edges(h, g), Ok(*e));
            assert_eq!(mesh.defects(), []);
        }
    }
}

#[test]
fn a_path_from_the_boundary_splits_its_vertices() {
    // 12 13 14 15
    //  8  9 10 11      cut: 13 - 9 - 5
    //  4  5  6  7
    //  0  1  2  3
    let mesh = shapes::grid(3, 3);
    let path = [edge(&mesh, 13, 9), edge(&mesh, 9, 5)];
    let (cut, new) = checked_edit(&mesh, |m| m.cut_edges(&path)).unwrap();
    assert_eq!((cut.n_vertices(), cut.n_edges()), (18, 26));
    assert_eq!((cut.n_faces(), cut.n_boundary_loops()), (9, 1));
    assert_eq!(cut.euler_characteristic(), 1);
    // The faces to the left of the path have lower ids than the faces to the right. Therefore, the left faces keep the
    // vertices 9 and 13.
    let v = VertexId::new;
    assert_eq!(polygons(&cut)[3], [4, 5, 9, 8]);
    assert_eq!(polygons(&cut)[4], [5, 6, 10, 16]);
    assert_eq!(polygons(&cut)[7], [10, 14, 17, 16]);
    assert_eq!(cut.position(v(16)), mesh.position(v(9)));
    assert_eq!(cut.position(v(17)), mesh.position(v(13)));
    for (e, n) in path.into_iter().zip(new) {
        let ends = |e| cut.edge_vertices(e).map(|v| cut.position(v));
        assert_eq!(ends(e), ends(n));
        assert!(cut.is_boundary_edge(e) && cut.is_boundary_edge(n));
    }
}

#[test]
fn a_loop_separates_a_component_and_a_star_opens_one_hole() {
    let mesh = shapes::grid(3, 3);
    let middle = mesh.face_half_edges(FaceId::new(4));
    let ring: Vec<EdgeId> = middle.map(HalfEdgeId::edge).collect();
    let (cut, _) = checked_edit(&mesh, |m| m.cut_edges(&ring)).unwrap();
    assert_eq!(
        (crate::geometry::n_components(&cut), cut.n_boundary_loops()),
        (2, 3)
    );
    assert_eq!(cut.n_vertices(), 20);

    let mesh = shapes::icosahedron();
    let star: Vec<EdgeId> = mesh
        .vertex_half_edges(VertexId::new(4))
        .map(HalfEdgeId::edge)
        .collect();
    for k in 2..=5 {
        let (cut, _) = checked_edit(&mesh, |m| m.cut_edges(&star[..k])).unwrap();
        assert_eq!((cut.n_vertices(), cut.n_boundary_loops()), (12 + k - 1, 1));
        let rim = cut.loop_half_edges(cut.boundary_loops()[0]);
        assert_eq!(rim.count(), 2 * k);
    }
}

#[test]
fn cutting_all_edges_separates_all_faces() {
    for mesh in meshes() {
        let inner: Vec<EdgeId> = mesh
            .edges()
            .filter(|&e| !mesh.is_boundary_edge(e))
            .collect();
        let (cut, new) = checked_edit(&mesh, |m| m.cut_edges(&inner)).unwrap();
        assert_eq!(crate::geometry::n_components(&cut), mesh.n_faces());
        let mut stitched = cut;
        stitch_all(&mut stitched, &inner, &new);
        assert_same_topology(&stitched, &mesh);
    }
}

#[test]
fn stitching_undoes_any_cut() {
    let mut state = 1_u32;
    let mut chance = |n: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) % n
    };
    for mesh in meshes() {
        for round in 0..60 {
            let mut edges: Vec<EdgeId> = mesh
                .edges()
                .filter(|&e| !mesh.is_boundary_edge(e) && chance(6) < round % 5 + 1)
                .collect();
            let slits = mesh.slits(&edges);
            let result = checked_edit(&mesh, |m| m.cut_edges(&edges));
            if let Some(&e) = slits.first() {
                let [v, w] = mesh.edge_vertices(e);
                assert_eq!(result.unwrap_err(), EditError::DuplicateEdge(v, w));
            }
            edges.retain(|e| !slits.contains(e));
            // The order of the edges must not matter.
            let shift = chance(u32::try_from(edges.len()).unwrap() + 1);
            edges.rotate_left(shift as usize);
            let Ok((cut, new)) = checked_edit(&mesh, |m| m.cut_edges(&edges)) else {
                assert!(edges.is_empty());
                continue;
            };
            assert_eq!(cut.n_edges(), mesh.n_edges() + edges.len());
            assert_eq!(crate::geometry::area(&cut), crate::geometry::area(&mesh));
            let mut stitched = cut;
            stitch_all(&mut stitched, &edges, &new);
            assert_same_topology(&stitched, &mesh);
        }
    }
}

#[test]
fn copies_have_the_values_of_the_originals_and_corners_keep_their_values() {
    let mut mesh = shapes::fans(&shapes::grid(3, 3));
    let corner = |h: HalfEdgeId| DVec2::splat(f64::from(u32::try_from(h.index()).unwrap()));
    mesh.set(UV, mesh.half_edges().map(corner).collect());
    let normal = |v: VertexId| mesh.position(v) + DVec3::Z;
    mesh.set(VERTEX_NORMAL, mesh.vertices().map(normal).collect());
    mesh.set(CREASE, (0..mesh.n_edges()).map(|e| e as f64).collect());
    let n = i32::try_from(mesh.n_faces()).unwrap();
    mesh.set(MATERIAL, (0..n).collect());
    let path = [edge(&mesh, 13, 9), edge(&mesh, 9, 5), edge(&mesh, 5, 10)];
    let (cut, new) = checked_edit(&mesh, |m| m.cut_edges(&path)).unwrap();
    assert_eq!(cut.get(MATERIAL), mesh.get(MATERIAL));
    for (e, n) in path.into_iter().zip(new) {
        let crease = cut.get(CREASE).unwrap();
        assert_eq!(crease[e.index()], crease[n.index()]);
    }
    for v in cut.vertices() {
        let expected = cut.position(v) + DVec3::Z;
        assert_eq!(cut.get(VERTEX_NORMAL).unwrap()[v.index()], expected);
    }
    for f in mesh.faces() {
        let corners = |m: &Mesh| -> Vec<(DVec3, DVec2)> {
            let first = m
                .face_half_edges(f)
                .min_by_key(|&h| m.position(m.origin(h)).to_array().map(f64::to_bits));
            m.loop_half_edges(first.unwrap())
                .map(|h| (m.position(m.origin(h)), m.get(UV).unwrap()[h.index()]))
                .collect()
        };
        assert_eq!(corners(&cut), corners(&mesh));
    }
}

#[test]
fn a_slit_is_refused_unless_it_reaches_the_boundary() {
    for mesh in meshes() {
        for e in mesh.edges() {
            let [v, w] = mesh.edge_vertices(e);
            let result = checked_edit(&mesh, |m| m.cut_edges(&[e]));
            if mesh.is_boundary_edge(e) {
                assert_eq!(result.unwrap_err(), EditError::Boundary(e));
            } else if mesh.is_boundary_vertex(v) || mesh.is_boundary_vertex(w) {
                assert_eq!(mesh.slits(&[e]), []);
                result.unwrap();
            } else {
                assert_eq!(mesh.slits(&[e]), [e]);
                assert_eq!(result.unwrap_err(), EditError::DuplicateEdge(v, w));
            }
        }
    }
}

#[test]
fn empty_lists_and_repeated_or_missing_edges_are_refused() {
    let mesh = shapes::cube();
    let [e, missing] = [EdgeId::new(3), EdgeId::new(99)];
    let refused = |edges: &[EdgeId]| checked_edit(&mesh, |m| m.cut_edges(edges)).unwrap_err();
    assert_eq!(refused(&[]), EditError::NoElements);
    assert_eq!(refused(&[e, e]), EditError::EdgeListedTwice(e));
    assert_eq!(refused(&[e, missing]), EditError::NoSuchEdge(missing));
}

#[test]
fn a_mesh_with_dead_elements_can_be_cut() {
    let mut mesh = shapes::grid(4, 4);
    for f in [5, 6] {
        mesh.delete_face(FaceId::new(f)).unwrap();
    }
    assert!(!mesh.is_dense());
    // One end of this edge is on the outer boundary.
    let e = edge(&mesh, 16, 21);
    let (cut, _) = checked_edit(&mesh, |m| m.cut_edges(&[e])).unwrap();
    assert_eq!((mesh.n_boundary_loops(), cut.n_boundary_loops()), (2, 2));
    // A path from the hole to the outer boundary merges both loops.
    let path = [edge(&mesh, 16, 11), e];
    let (cut, _) = checked_edit(&mesh, |m| m.cut_edges(&path)).unwrap();
    assert_eq!(cut.n_boundary_loops(), 1);
    assert_eq!(cut.domain_len(Domain::Face), 16);
}
