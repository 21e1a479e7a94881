use super::*;
use geometry::shapes;
use mesh::{DVec2, DVec3, EdgeId, UV};
use op::test::{applied, try_applied};

fn parse(text: &str) -> Stitch {
    op::test::read(text).unwrap()
}

/// Cuts the mesh along all inner edges and returns the result.
fn cut_apart(mut mesh: Mesh) -> Mesh {
    let inner: Vec<EdgeId> = mesh
        .edges()
        .filter(|&e| !mesh.is_boundary_edge(e))
        .collect();
    mesh.cut_edges(&inner).unwrap();
    mesh
}

fn counts(mesh: &Mesh) -> [usize; 4] {
    [
        mesh.n_vertices(),
        mesh.n_edges(),
        mesh.n_faces(),
        mesh.n_boundary_loops(),
    ]
}

#[test]
fn stitching_restores_a_mesh_that_was_cut_apart() {
    for mesh in [
        shapes::grid(4, 3),
        shapes::fans(&shapes::grid(3, 3)),
        shapes::cube(),
        shapes::icosahedron(),
        shapes::torus(5, 4, 2.0, 1.0),
        shapes::cylinder(6, true),
        shapes::uv_sphere(8, 5),
    ] {
        let cut = cut_apart(mesh.clone());
        assert_eq!(geometry::n_components(&cut), mesh.n_faces());
        let stitched = applied(&parse("(distance: 0)"), cut);
        assert_eq!(counts(&stitched), counts(&mesh));
        assert_eq!(stitched.positions(), mesh.positions());
        for f in mesh.faces() {
            let corners = |m: &Mesh| m.face_vertices(f).min();
            assert_eq!(corners(&stitched), corners(&mesh));
            assert_eq!(stitched.degree(f), mesh.degree(f));
        }
    }
}

#[test]
fn only_edges_within_the_distance_are_joined() {
    let mut mesh = cut_apart(shapes::grid(3, 3));
    // Each face is moved by a different offset, whose coordinates are at most 0.001.
    let faces: Vec<_> = mesh.faces().collect();
    for (i, f) in faces.into_iter().enumerate() {
        let shift = DVec3::new((i % 3) as f64, (i / 3) as f64, (i % 2) as f64) * 0.0005;
        let corners: Vec<_> = mesh.face_vertices(f).collect();
        for v in corners {
            mesh.set_position(v, mesh.position(v) + shift);
        }
    }
    let whole = applied(&parse("(distance: 0.01)"), mesh.clone());
    assert_eq!(counts(&whole), counts(&shapes::grid(3, 3)));
    let (same, report) = try_applied(&parse("(distance: 1e-6)"), mesh.clone()).unwrap();
    assert_eq!(same, mesh);
    assert_eq!(report.changed, 0);
    assert_eq!(report.notes.len(), 1);
}

#[test]
fn vertices_without_coinciding_edges_are_not_merged() {
    // Two squares touch at a corner, where each square has its own vertex. `Weld` would merge these two vertices.
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = [0.0, 1.0]
        .iter()
        .flat_map(|&d| [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| at(x + d, y + d)));
    let (mesh, _) =
        Mesh::from_polygons(positions.collect(), &[[0, 1, 2, 3], [4, 5, 6, 7]]).unwrap();
    assert_eq!(applied(&parse("(distance: 0.1)"), mesh.clone()), mesh);
}

#[test]
fn an_edge_that_coincides_with_several_edges_is_refused_or_counted() {
    // Three rectangles that meet along a line but have no common vertices.
    let page = |x: f64, y: f64| {
        [
            DVec3::ZERO,
            DVec3::new(x, y, 0.0),
            DVec3::new(x, y, 1.0),
            DVec3::Z,
        ]
    };
    let positions = [page(1., 0.), page(0., 1.), page(-1., 0.)].concat();
    // The second rectangle has the opposite orientation. On the common line, the edge of this rectangle therefore
    // coincides with the edges of both other rectangles.
    let polygons = [[0, 1, 2, 3], [7, 6, 5, 4], [8, 9, 10, 11]];
    let (mesh, _) = Mesh::from_polygons(positions, &polygons).unwrap();
    let refused = try_applied(&parse("(distance: 0)"), mesh.clone());
    let Err(OpError::Refused { reason, .. }) = refused else {
        panic!("expected a refusal, got {refused:?}");
    };
    assert_eq!(reason, Refusal::NonManifold);
    let skip = parse("(distance: 0, on_refusal: Skip)");
    let (same, report) = try_applied(&skip, mesh.clone()).unwrap();
    assert_eq!(same, mesh);
    assert_eq!((report.changed, report.refused[0].count), (0, 1));
}

#[test]
fn different_uvs_become_a_seam() {
    let mut mesh = cut_apart(shapes::grid(2, 1));
    let uv = |h| DVec2::splat(mesh.face(h).map_or(0.0, |f| f.index() as f64));
    mesh.set(UV, mesh.half_edges().map(uv).collect());
    let stitched = applied(&parse("(distance: 0)"), mesh);
    assert_eq!(stitched.edges().filter(|&e| stitched.is_seam(e)).count(), 1);
}

#[test]
fn the_two_long_edges_of_a_thin_face_are_not_joined() {
    let mut mesh = shapes::square();
    for p in mesh.positions_mut() {
        p.y *= 0.001;
    }
    let skip = parse("(distance: 0.01, on_refusal: Skip)");
    let (same, report) = try_applied(&skip, mesh.clone()).unwrap();
    assert_eq!(same, mesh);
    assert_eq!(report.refused[0].reason, Refusal::SameFace);
}

#[test]
fn extreme_coordinates_give_a_valid_mesh() {
    for (scale, distance) in [(0.0, "0"), (1e300, "1e290"), (1e-300, "0"), (1.0, "1e300")] {
        let mut mesh = cut_apart(shapes::cube());
        for p in mesh.positions_mut() {
            *p *= scale;
        }
        let skip = parse(&format!("(distance: {distance}, on_refusal: Skip)"));
        let (after, _) = try_applied(&skip, mesh).unwrap();
        assert_eq!(after.n_faces(), 6);
        assert_eq!(after.is_closed(), scale > 0.0 && distance != "1e300");
    }
}

#[test]
fn the_distance_is_required() {
    assert!(op::test::read::<Stitch>("()").is_err());
    assert!(op::test::read::<Stitch>("(distance: 0, weld: true)").is_err());
    assert_eq!(parse("(distance: 1e-6)").on_refusal, OnRefusal::Error);
}

#[test]
fn stitching_undoes_the_cut_of_all_edges() {
    let mesh = shapes::grid(30, 20);
    let cut: crate::Cut = op::test::read("(edges: All, on_refusal: Skip)").unwrap();
    let apart = applied(&cut, mesh.clone());
    assert_eq!(apart.n_vertices(), 4 * mesh.n_faces());
    let whole = applied(&parse("(distance: 0)"), apart);
    assert_eq!(counts(&whole), counts(&mesh));
}
