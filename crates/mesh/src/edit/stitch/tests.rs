use super::*;
use crate::edit::testing::{checked_edit, half_edge, polygons, with_slit};
use crate::{CREASE, FaceId, UV, shapes};
use glam::{DVec2, DVec3};

/// Returns the half-edge from `v` to `w`, which must have no face.
fn rim(mesh: &Mesh, v: usize, w: usize) -> HalfEdgeId {
    let h = half_edge(mesh, v, w);
    assert_eq!(mesh.face(h), None, "{v} to {w} has a face");
    h
}

fn rims(mesh: &Mesh) -> Vec<HalfEdgeId> {
    mesh.half_edges()
        .filter(|&h| mesh.face(h).is_none())
        .collect()
}

/// Returns two squares side by side with a small gap. Their vertices are 0 1 2 3 and 4 5 6 7.
fn two_squares() -> Mesh {
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = vec![
        p(0., 0.),
        p(1., 0.),
        p(1., 1.),
        p(0., 1.),
        p(1.25, 0.),
        p(2., 0.),
        p(2., 1.),
        p(1.25, 1.),
    ];
    Mesh::from_polygons(positions, &[[0, 1, 2, 3], [4, 5, 6, 7]])
        .unwrap()
        .0
}

#[test]
fn two_squares_become_a_strip() {
    let mesh = two_squares();
    let (h, g) = (rim(&mesh, 2, 1), rim(&mesh, 4, 7));
    let (strip, e) = checked_edit(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert_eq!(polygons(&strip), [vec![0, 1, 2, 3], vec![1, 5, 6, 2]]);
    assert_eq!(e, h.edge().min(g.edge()));
    assert_eq!(strip.edge_faces(e).iter().flatten().count(), 2);
    assert_eq!((strip.n_edges(), strip.n_boundary_loops()), (7, 1));
    // The vertices with the lower ids do not move.
    assert_eq!(strip.positions(), mesh.positions());
}

#[test]
fn corners_and_the_edge_with_the_lower_id_keep_their_values() {
    let mut mesh = two_squares();
    let uv = |h: HalfEdgeId| match mesh.face(h).map(FaceId::index) {
        Some(0) => DVec2::X,
        Some(_) => DVec2::Y,
        None => DVec2::ZERO,
    };
    mesh.set(UV, mesh.half_edges().map(uv).collect());
    mesh.set(CREASE, (0..mesh.n_edges()).map(|e| e as f64).collect());
    let (h, g) = (rim(&mesh, 2, 1), rim(&mesh, 4, 7));
    let (strip, e) = checked_edit(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert!(strip.is_seam(e));
    assert_eq!(strip.get(CREASE).unwrap()[e.index()], e.index() as f64);
    for (f, expected) in [(0, DVec2::X), (1, DVec2::Y)] {
        for h in strip.face_half_edges(FaceId::new(f)) {
            assert_eq!(strip.get(UV).unwrap()[h.index()], expected);
        }
    }
}

#[test]
fn any_two_boundary_edges_are_stitched_or_refused_in_either_order() {
    let mut open_cube = shapes::cube();
    open_cube.delete_face(FaceId::new(1)).unwrap();
    let mut holes = shapes::torus(5, 4, 2.0, 1.0);
    for f in [0, 1, 10] {
        holes.delete_face(FaceId::new(f)).unwrap();
    }
    let mut n_stitched = 0;
    for mesh in [
        two_squares(),
        shapes::square(),
        shapes::grid(1, 4),
        shapes::grid(2, 3),
        shapes::fans(&shapes::grid(3, 3)),
        shapes::cylinder(4, false),
        shapes::cylinder(7, false),
        open_cube,
        holes,
    ] {
        for &h in &rims(&mesh) {
            for &g in &rims(&mesh) {
                let result = checked_edit(&mesh, |m| m.stitch_edges(h, g));
                let swapped = checked_edit(&mesh, |m| m.stitch_edges(g, h));
                let Ok((stitched, e)) = result else {
                    assert!(swapped.is_err());
                    continue;
                };
                assert_eq!(swapped.unwrap(), (stitched.clone(), e));
                assert!(!stitched.is_boundary_edge(e));
                assert_eq!(stitched.n_faces(), mesh.n_faces());
                let pairs = mesh.n_edges() - stitched.n_edges();
                assert_eq!(rims(&mesh).len() - rims(&stitched).len(), 2 * pairs);
                n_stitched += 1;
            }
        }
    }
    assert!(n_stitched > 300, "{n_stitched}");
}

#[test]
fn a_strip_becomes_a_tube() {
    let mesh = shapes::grid(5, 1);
    let (h, g) = (rim(&mesh, 0, 6), rim(&mesh, 11, 5));
    let (tube, _) = checked_edit(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert_eq!((tube.n_vertices(), tube.n_boundary_loops()), (10, 2));
    assert_eq!(tube.euler_characteristic(), 0);
}

#[test]
fn a_cut_is_closed_from_its_ends() {
    // The hole has six edges. The first stitch leaves two pairs of edges to stitch, and the second leaves none.
    let mut mesh = shapes::icosahedron();
    let path: Vec<EdgeId> = [[0, 1], [1, 8], [8, 3]]
        .into_iter()
        .map(|[v, w]| half_edge(&mesh, v, w).edge())
        .collect();
    let closed = polygons(&mesh);
    let new = mesh.cut_edges(&path).unwrap();
    for (i, n_pairs_left) in [(0, 2), (2, 0)] {
        let pair = [path[i].half_edges()[1], new[i].half_edges()[0]];
        mesh = checked_edit(&mesh, |m| m.stitch_edges(pair[0], pair[1]))
            .unwrap()
            .0;
        assert_eq!(rims(&mesh).len(), 2 * n_pairs_left);
    }
    assert_eq!(polygons(&mesh), closed);
}

#[test]
fn two_triangles_become_a_pillow() {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let positions = [positions.clone(), positions].concat();
    let (mesh, _) = Mesh::from_polygons(positions, &[[0, 1, 2], [5, 4, 3]]).unwrap();
    let (h, g) = (rim(&mesh, 1, 0), rim(&mesh, 3, 4));
    let (mesh, _) = checked_edit(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    let (h, g) = (rim(&mesh, 2, 1), rim(&mesh, 1, 5));
    let (pillow, _) = checked_edit(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert!(pillow.is_closed());
    assert_eq!(polygons(&pillow), [[0, 1, 2], [0, 2, 1]]);
}

#[test]
fn a_slit_can_be_closed() {
    for mesh in [shapes::cube(), shapes::tetrahedron()] {
        for e in mesh.edges() {
            let open = with_slit(mesh.clone(), e);
            let [h, g] = rims(&open)[..] else {
                panic!("a slit has two edges")
            };
            let (closed, kept) = checked_edit(&open, |m| m.stitch_edges(h, g)).unwrap();
            assert_eq!(kept, e);
            assert_eq!(polygons(&closed), polygons(&mesh));
            assert!(closed.is_closed());
        }
    }
}

#[test]
fn edges_that_would_give_an_invalid_mesh_are_refused() {
    let refused =
        |mesh: &Mesh, h, g| checked_edit(mesh, |m| m.stitch_edges(h, g)).expect_err("a refusal");
    let mesh = two_squares();
    let h = rim(&mesh, 2, 1);
    assert_eq!(refused(&mesh, h, h), EditError::EdgeListedTwice(h.edge()));
    let inner = h.twin();
    let not_boundary = EditError::NotBoundary(inner);
    assert_eq!(refused(&mesh, h, inner), not_boundary);
    assert_eq!(refused(&mesh, inner, h), not_boundary);
    let missing = HalfEdgeId::new(99);
    let no_such = EditError::NoSuchHalfEdge(missing);
    assert_eq!(refused(&mesh, h, missing), no_such);
    // Stitches two opposite sides of one square.
    let g = rim(&mesh, 0, 3);
    assert_eq!(refused(&mesh, h, g), EditError::SameFace(h.edge()));

    // Stitches two edges of a hole with three edges. The third edge would start and end at the same vertex.
    let mut mesh = shapes::octahedron();
    mesh.delete_face(FaceId::new(0)).unwrap();
    let hole: Vec<_> = mesh.loop_half_edges(rims(&mesh)[0]).collect();
    let third = EditError::SelfLoop(hole[2].edge());
    assert_eq!(refused(&mesh, hole[0], hole[1]), third);

    // Stitches the bottom of a sheet of two rows to its top. The merged vertex would be joined to a middle
    // vertex twice.
    let mesh = shapes::grid(2, 2);
    let (h, g) = (rim(&mesh, 1, 0), rim(&mesh, 6, 7));
    let reason = refused(&mesh, h, g);
    assert!(matches!(reason, EditError::DuplicateEdge(..)), "{reason}");

    // A face with seven corners and a square at one side. The square is stitched to another side of the face.
    let positions = (0..9).map(|i| DVec3::new(f64::from(i), f64::from(i * i), 0.0));
    let polygons: [&[u32]; 2] = [&[0, 1, 2, 3, 4, 5, 6], &[4, 3, 7, 8]];
    let (mesh, _) = Mesh::from_polygons(positions.collect(), &polygons).unwrap();
    let (h, g) = (rim(&mesh, 0, 6), rim(&mesh, 7, 3));
    let twice = EditError::VisitsTwice(FaceId::new(0), VertexId::new(0));
    assert_eq!(refused(&mesh, h, g), twice);
}
