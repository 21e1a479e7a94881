use super::*;
use crate::{area, genus, shapes, volume};
use mesh::{CREASE, DVec2, MATERIAL, UV};
use proptest::prelude::*;

fn all(mesh: &Mesh) -> Vec<EdgeId> {
    mesh.edges().collect()
}

fn between(mesh: &Mesh, v: usize, w: usize) -> EdgeId {
    let h = mesh.find_half_edge(VertexId::new(v), VertexId::new(w));
    h.expect("the vertices share an edge").edge()
}

fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

/// Returns a prism of height 1 over an L: a square of side 2 without its upper right quarter.
fn profile() -> Mesh {
    let outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    let at = |z: i32| outline.map(|(x, y)| DVec3::new(x.into(), y.into(), z.into()));
    let mut faces = vec![vec![5, 4, 3, 2, 1, 0], vec![6, 7, 8, 9, 10, 11]];
    faces.extend((0..6).map(|i| vec![i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6]));
    Mesh::from_polygons([at(0), at(1)].concat(), &faces)
        .unwrap()
        .0
}

#[test]
fn a_cube_keeps_all_rotations() {
    let cube = shapes::cube();
    let Beveled { mesh, refused } = bevel_edges(&cube, &all(&cube), 0.5);
    assert_eq!(refused, []);
    assert_eq!(counts(&mesh), [24, 48, 26]);
    assert!(mesh.is_closed());
    // The vertices are all permutations of (±1/2, ±1/2, ±1).
    for p in mesh.positions() {
        let mut sorted = p.abs().to_array();
        sorted.sort_by(f64::total_cmp);
        for (x, expected) in sorted.into_iter().zip([0.5, 0.5, 1.0]) {
            assert!((x - expected).abs() < 1e-15, "{p}");
        }
    }
    let degrees = [3, 4].map(|n| mesh.faces().filter(|&f| mesh.degree(f) == n).count());
    assert_eq!(degrees, [8, 18]);
}

#[test]
fn the_inner_corner_of_a_profile_does_not_cross_itself() {
    let before = profile();
    let Beveled { mesh, refused } = bevel_edges(&before, &all(&before), 0.1);
    assert_eq!(refused, []);
    assert!(mesh.is_closed());
    assert_eq!(genus(&mesh), 0);
    assert_eq!(mesh.n_faces(), 8 + 18 + 12);
    // Each side of the bottom face and of the top face moves inward by the width.
    for f in [0, 1].map(FaceId::new) {
        assert!((mesh.area_vector(f).length() - (3.0 - 8.0 * 0.1 + 4.0 * 0.01)).abs() < 1e-12);
    }
    let inner: Vec<DVec3> = mesh
        .positions()
        .iter()
        .copied()
        .filter(|p| p.z == 1.0)
        .collect();
    assert!(
        inner
            .iter()
            .any(|p| p.distance(DVec3::new(0.9, 0.9, 1.0)) < 1e-15)
    );
    // The bevel adds material only along the inner edge, which is concave. It removes material along all other edges.
    assert!(volume(&mesh) < volume(&before));
}

#[test]
fn one_edge_becomes_one_face() {
    let cube = shapes::cube();
    let Beveled { mesh, refused } = bevel_edges(&cube, &[between(&cube, 4, 5)], 1.0);
    assert_eq!(refused, []);
    assert_eq!(counts(&mesh), [10, 15, 7]);
    assert!((volume(&mesh) - 7.0).abs() < 1e-13);
}

#[test]
fn the_width_is_the_distance_to_the_edge_at_any_angle() {
    // The edge from vertex 0 to vertex 1 is beveled. At both vertices, the other edges meet this edge at different
    // angles.
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = vec![
        p(0., 0.),
        p(2., 0.),
        p(3., 1.),
        p(0.5, 1.5),
        p(2., -1.),
        p(-0.5, -1.),
    ];
    let faces = [[0_u32, 1, 2, 3], [1, 0, 5, 4]];
    let (mesh, _) = Mesh::from_polygons(positions, &faces).unwrap();
    let Beveled { mesh, refused } = bevel_edges(&mesh, &[between(&mesh, 0, 1)], 0.125);
    assert_eq!(refused, []);
    let strip = FaceId::new(2);
    assert_eq!(mesh.degree(strip), 4);
    for v in mesh.face_vertices(strip) {
        assert!((mesh.position(v).y.abs() - 0.125).abs() < 1e-15);
    }
}

#[test]
fn values_are_those_of_their_places_in_the_old_faces() {
    let mut grid = shapes::grid(4, 4);
    let uv = |p: DVec3| DVec2::new(2.0 * p.x - p.y, 3.0 * p.y + 1.0);
    grid.set(
        UV,
        grid.half_edges()
            .map(|h| uv(grid.position(grid.origin(h))))
            .collect(),
    );
    grid.set(MATERIAL, (0..16).collect());
    grid.set(CREASE, (0..grid.n_edges()).map(|e| e as f64).collect());
    let inside: Vec<EdgeId> = grid
        .edges()
        .filter(|&e| !grid.is_boundary_edge(e))
        .collect();
    let Beveled { mesh, refused } = bevel_edges(&grid, &inside, 0.1);
    assert_eq!(refused, []);
    assert!((area(&mesh) - area(&grid)).abs() < 1e-12);
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        let expected = uv(mesh.position(mesh.origin(h)));
        assert!(mesh.get(UV).unwrap()[h.index()].distance(expected) < 1e-12);
    }
    assert_eq!(
        mesh.get(MATERIAL).unwrap()[..16],
        grid.get(MATERIAL).unwrap()[..]
    );
    // The edges of the boundary keep their values, and no other edges have values.
    let sum = |mesh: &Mesh, edges: &mut dyn Iterator<Item = EdgeId>| -> f64 {
        edges.map(|e| mesh.get(CREASE).unwrap()[e.index()]).sum()
    };
    let boundary = sum(
        &grid,
        &mut grid.edges().filter(|&e| grid.is_boundary_edge(e)),
    );
    assert_eq!(sum(&mesh, &mut mesh.edges()), boundary);
}

#[test]
fn bevels_that_overlap_are_refused() {
    let cube = shapes::cube();
    let e = between(&cube, 4, 5);
    for (edges, width) in [(all(&cube), 1.0), (vec![e], 2.0), (vec![e], f64::MAX)] {
        let Beveled { mesh, refused } = bevel_edges(&cube, &edges, width);
        assert_eq!(counts(&mesh), counts(&cube));
        assert_eq!(refused.len(), edges.len());
        assert!(refused.iter().all(|(_, why)| *why == BevelRefusal::TooWide));
    }
    let grid = shapes::grid(2, 2);
    let Beveled { refused, .. } = bevel_edges(&grid, &all(&grid), 0.1);
    assert_eq!(refused.len(), 8);
    assert!(
        refused
            .iter()
            .all(|(_, why)| *why == BevelRefusal::Boundary)
    );
}

#[test]
fn an_end_with_two_edges_needs_both_of_them() {
    let mut cube = shapes::cube();
    let e = between(&cube, 4, 5);
    let m = cube.split_edge(e, 0.5).unwrap();
    let Beveled { refused, .. } = bevel_edges(&cube, &[e], 0.1);
    assert_eq!(refused, [(e, BevelRefusal::FewEdges(m))]);
    let both: Vec<EdgeId> = cube.vertex_half_edges(m).map(HalfEdgeId::edge).collect();
    let Beveled { mesh, refused } = bevel_edges(&cube, &both, 0.1);
    assert_eq!(refused, []);
    assert_eq!(mesh.n_faces(), 8);
    assert!((volume(&mesh) - (8.0 - 2.0 * 0.005)).abs() < 1e-12);
}

proptest! {
    #[test]
    fn any_set_of_edges_leaves_a_valid_mesh(
        which in 0_usize..5,
        chosen in proptest::collection::vec(any::<bool>(), 64),
        width in prop::sample::select(vec![1e-9, 0.01, 0.1, 0.3, 1.0, 1e300]),
    ) {
        let mesh = match which {
            0 => shapes::cube(),
            1 => shapes::icosahedron(),
            2 => shapes::grid(4, 3),
            3 => shapes::torus(5, 4, 2.0, 1.0),
            _ => profile(),
        };
        let edges: Vec<EdgeId> = mesh.edges().filter(|e| chosen[e.index() % 64]).collect();
        let Beveled { mesh: new, refused } = bevel_edges(&mesh, &edges, width);
        prop_assert_eq!(new.defects(), []);
        prop_assert_eq!(new.euler_characteristic(), mesh.euler_characteristic());
        prop_assert_eq!(new.n_boundary_loops(), mesh.n_boundary_loops());
        prop_assert!(new.n_faces() >= mesh.n_faces() + edges.len() - refused.len());
        // The result does not depend on the order of the edges.
        let reversed: Vec<EdgeId> = edges.into_iter().rev().collect();
        prop_assert!(bevel_edges(&mesh, &reversed, width).mesh == new);
    }
}
