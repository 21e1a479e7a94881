use super::*;
use crate::edit::testing::{half_edge, polygons, tried, with_slit};
use crate::{CREASE, FaceId, UV, shapes};
use glam::{DVec2, DVec3};

/// The half-edge without a face from `v` to `w`.
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

/// Two squares beside each other, a little apart: 0 1 2 3 and 4 5 6 7.
fn two_squares() -> Mesh {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = vec![
        at(0., 0.),
        at(1., 0.),
        at(1., 1.),
        at(0., 1.),
        at(1.25, 0.),
        at(2., 0.),
        at(2., 1.),
        at(1.25, 1.),
    ];
    Mesh::from_polygons(positions, &[[0, 1, 2, 3], [4, 5, 6, 7]])
        .unwrap()
        .0
}

#[test]
fn two_squares_become_a_strip() {
    let mesh = two_squares();
    let (h, g) = (rim(&mesh, 2, 1), rim(&mesh, 4, 7));
    let (strip, e) = tried(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert_eq!(polygons(&strip), [vec![0, 1, 2, 3], vec![1, 5, 6, 2]]);
    assert_eq!(e, h.edge().min(g.edge()));
    assert_eq!(strip.edge_faces(e).iter().flatten().count(), 2);
    assert_eq!((strip.n_edges(), strip.n_boundary_loops()), (7, 1));
    // The lower numbers stay where they are.
    assert_eq!(strip.positions(), mesh.positions());
}

#[test]
fn corners_keep_their_values_and_the_edge_of_the_lower_number_its_own() {
    let mut mesh = two_squares();
    let uv = |h: HalfEdgeId| match mesh.face(h).map(FaceId::index) {
        Some(0) => DVec2::X,
        Some(_) => DVec2::Y,
        None => DVec2::ZERO,
    };
    mesh.set(UV, mesh.half_edges().map(uv).collect());
    mesh.set(CREASE, (0..mesh.n_edges()).map(|e| e as f64).collect());
    let (h, g) = (rim(&mesh, 2, 1), rim(&mesh, 4, 7));
    let (strip, e) = tried(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert!(strip.is_seam(e));
    assert_eq!(strip.get(CREASE).unwrap()[e.index()], e.index() as f64);
    for (f, expected) in [(0, DVec2::X), (1, DVec2::Y)] {
        for h in strip.face_half_edges(FaceId::new(f)) {
            assert_eq!(strip.get(UV).unwrap()[h.index()], expected);
        }
    }
}

#[test]
fn any_two_boundary_edges_are_glued_or_refused_whichever_comes_first() {
    let mut open_cube = shapes::cube();
    open_cube.delete_face(FaceId::new(1)).unwrap();
    let mut holes = shapes::torus(5, 4, 2.0, 1.0);
    for f in [0, 1, 10] {
        holes.delete_face(FaceId::new(f)).unwrap();
    }
    let mut glued = 0;
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
                let result = tried(&mesh, |m| m.stitch_edges(h, g));
                let other = tried(&mesh, |m| m.stitch_edges(g, h));
                let Ok((stitched, e)) = result else {
                    assert!(other.is_err());
                    continue;
                };
                assert_eq!(other.unwrap(), (stitched.clone(), e));
                assert!(!stitched.is_boundary_edge(e));
                assert_eq!(stitched.n_faces(), mesh.n_faces());
                let pairs = mesh.n_edges() - stitched.n_edges();
                assert_eq!(rims(&mesh).len() - rims(&stitched).len(), 2 * pairs);
                glued += 1;
            }
        }
    }
    assert!(glued > 300, "{glued}");
}

#[test]
fn a_strip_becomes_a_tube() {
    let mesh = shapes::grid(5, 1);
    let (h, g) = (rim(&mesh, 0, 6), rim(&mesh, 11, 5));
    let (tube, _) = tried(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert_eq!((tube.n_vertices(), tube.n_boundary_loops()), (10, 2));
    assert_eq!(tube.euler_characteristic(), 0);
}

#[test]
fn a_hole_is_zipped_up_from_its_corner() {
    // Six edges around a hole: three pairs, two after the first one, none after the second.
    let mut mesh = shapes::icosahedron();
    let path: Vec<EdgeId> = [[0, 1], [1, 8], [8, 3]]
        .into_iter()
        .map(|[v, w]| half_edge(&mesh, v, w).edge())
        .collect();
    let closed = polygons(&mesh);
    let new = mesh.cut_edges(&path).unwrap();
    for (i, left) in [(0, 2), (2, 0)] {
        let pair = [path[i].half_edges()[1], new[i].half_edges()[0]];
        mesh = tried(&mesh, |m| m.stitch_edges(pair[0], pair[1]))
            .unwrap()
            .0;
        assert_eq!(rims(&mesh).len(), 2 * left);
    }
    assert_eq!(polygons(&mesh), closed);
}

#[test]
fn two_triangles_become_a_pillow() {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let positions = [positions.clone(), positions].concat();
    let (mesh, _) = Mesh::from_polygons(positions, &[[0, 1, 2], [5, 4, 3]]).unwrap();
    let (h, g) = (rim(&mesh, 1, 0), rim(&mesh, 3, 4));
    let (mesh, _) = tried(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    let (h, g) = (rim(&mesh, 2, 1), rim(&mesh, 1, 5));
    let (pillow, _) = tried(&mesh, |m| m.stitch_edges(h, g)).unwrap();
    assert!(pillow.is_closed());
    assert_eq!(polygons(&pillow), [[0, 1, 2], [0, 2, 1]]);
}

#[test]
fn a_slit_of_the_input_is_closed() {
    for mesh in [shapes::cube(), shapes::tetrahedron()] {
        for e in mesh.edges() {
            let open = with_slit(mesh.clone(), e);
            let [h, g] = rims(&open)[..] else {
                panic!("a slit has two edges")
            };
            let (closed, kept) = tried(&open, |m| m.stitch_edges(h, g)).unwrap();
            assert_eq!(kept, e);
            assert_eq!(polygons(&closed), polygons(&mesh));
            assert!(closed.is_closed());
        }
    }
}

#[test]
fn what_would_not_be_clean_is_refused() {
    let refused = |mesh: &Mesh, h, g| tried(mesh, |m| m.stitch_edges(h, g)).expect_err("a refusal");
    let mesh = two_squares();
    let h = rim(&mesh, 2, 1);
    assert_eq!(refused(&mesh, h, h), EditError::EdgeListedTwice(h.edge()));
    let inner = h.twin();
    let not = EditError::NotBoundary(h.edge());
    assert_eq!(refused(&mesh, h, inner), not);
    assert_eq!(refused(&mesh, inner, h), not);
    let far = HalfEdgeId::new(99);
    assert_eq!(refused(&mesh, h, far), EditError::NoSuchHalfEdge(far));
    // Opposite sides of one square.
    let g = rim(&mesh, 0, 3);
    assert_eq!(refused(&mesh, h, g), EditError::SameFace(h.edge()));

    // Two edges of a hole of three: the third one would begin where it ends.
    let mut mesh = shapes::octahedron();
    mesh.delete_face(FaceId::new(0)).unwrap();
    let hole: Vec<_> = mesh.loop_half_edges(rims(&mesh)[0]).collect();
    let third = EditError::SelfLoop(hole[2].edge());
    assert_eq!(refused(&mesh, hole[0], hole[1]), third);

    // Bottom to top of two rows: the vertices between would be joined twice.
    let mesh = shapes::grid(2, 2);
    let (h, g) = (rim(&mesh, 1, 0), rim(&mesh, 6, 7));
    let reason = refused(&mesh, h, g);
    assert!(matches!(reason, EditError::DuplicateEdge(..)), "{reason}");

    // A face of seven corners with a square at one side, which is glued to another side of it.
    let positions = (0..9).map(|i| DVec3::new(f64::from(i), f64::from(i * i), 0.0));
    let polygons: [&[u32]; 2] = [&[0, 1, 2, 3, 4, 5, 6], &[4, 3, 7, 8]];
    let (mesh, _) = Mesh::from_polygons(positions.collect(), &polygons).unwrap();
    let (h, g) = (rim(&mesh, 0, 6), rim(&mesh, 7, 3));
    let twice = EditError::VisitsTwice(FaceId::new(0), VertexId::new(0));
    assert_eq!(refused(&mesh, h, g), twice);
}
