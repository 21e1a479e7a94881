mod oracle;
mod orientation;

use super::*;
use crate::VertexId;

fn points(n: usize) -> Vec<DVec3> {
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    (0..n)
        .map(|i| DVec3::new(i as f64, (i * i) as f64, 0.0))
        .collect()
}

fn mesh(n: usize, polygons: &[&[u32]]) -> (Mesh, BuildReport) {
    let (mesh, report) = Mesh::from_polygons(points(n), polygons).unwrap();
    assert_eq!(mesh.defects(), []);
    (mesh, report)
}

#[test]
fn no_polygons_become_an_empty_mesh() {
    let (mesh, report) = mesh(0, &[]);
    assert_eq!(
        (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
        (0, 0, 0)
    );
    assert!(report.is_clean());
}

#[test]
fn unused_vertices_become_isolated_vertices() {
    let (mesh, report) = mesh(5, &[&[0, 2, 4]]);
    assert_eq!(mesh.n_vertices(), 5);
    assert_eq!(mesh.vertex_half_edge(VertexId::new(1)), None);
    assert!(report.is_clean());
}

#[test]
fn edges_are_numbered_in_the_order_of_their_first_use() {
    let (mesh, _) = mesh(4, &[&[0, 1, 2], &[0, 2, 3]]);
    let ends: Vec<_> = mesh
        .edges()
        .map(|e| mesh.edge_vertices(e).map(VertexId::index))
        .collect();
    assert_eq!(ends, [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]);
}

#[test]
fn three_faces_at_an_edge_are_split_and_listed() {
    let (mesh, report) = mesh(5, &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]]);
    assert_eq!(report.split_edges, [[VertexId::new(0), VertexId::new(1)]]);
    assert_eq!(report.split_vertices.len(), 2);
    assert_eq!((mesh.n_faces(), mesh.n_vertices()), (3, 7));
}

#[test]
fn two_faces_with_the_same_direction_along_an_edge_are_split_with_split_as_given() {
    let corners = [0, 1, 2, 0, 1, 3];
    let built = build(points(4), &[0, 3, 6], &corners, NonManifold::SplitAsGiven).unwrap();
    assert_eq!(built.mesh.defects(), []);
    assert_eq!(built.report.split_edges.len(), 1);
    assert_eq!(built.mesh.n_faces(), 2);
    assert_eq!(crate::geometry::n_components(&built.mesh), 2);
}

#[test]
fn a_bow_tie_vertex_is_copied_for_its_second_fan() {
    let (mesh, report) = mesh(5, &[&[0, 1, 2], &[0, 3, 4]]);
    assert_eq!(
        report.split_vertices,
        [(VertexId::new(0), VertexId::new(5))]
    );
    assert_eq!(
        mesh.position(VertexId::new(0)),
        mesh.position(VertexId::new(5))
    );
}

#[test]
fn two_cubes_that_share_an_edge_are_split_into_two_closed_cubes() {
    let cube = |o: u32, shared: [u32; 2]| -> Vec<Vec<u32>> {
        let id = |i: u32| if i < 2 { shared[i as usize] } else { o + i };
        [
            [0, 1, 3, 2],
            [0, 4, 5, 1],
            [1, 5, 7, 3],
            [3, 7, 6, 2],
            [2, 6, 4, 0],
            [4, 6, 7, 5],
        ]
        .iter()
        .map(|f| f.iter().map(|&i| id(i)).collect())
        .collect()
    };
    let polygons = [cube(0, [0, 1]), cube(6, [0, 1])].concat();
    let (mesh, report) = Mesh::from_polygons(points(14), &polygons).unwrap();
    assert_eq!(mesh.defects(), []);
    assert_eq!(report.split_edges.len(), 1);
    assert_eq!(report.split_vertices.len(), 2);
    assert!(mesh.edges().all(|e| !mesh.is_boundary_edge(e)));
    assert_eq!(crate::geometry::n_components(&mesh), 2);
}

#[test]
fn degenerate_polygons_are_dropped_and_map_to_none() {
    let corners = [0, 1, 1, 0, 1, 2, 0, 1];
    let built = build(points(3), &[0, 3, 6, 8], &corners, NonManifold::Split).unwrap();
    assert_eq!(built.report.dropped_faces, [0, 2]);
    assert_eq!(
        built.face_of_polygon,
        [FaceId::NONE, FaceId::new(0), FaceId::NONE]
    );
    assert_eq!(built.half_edge_of_corner[2], HalfEdgeId::NONE);
    assert_eq!(
        built.mesh.origin(built.half_edge_of_corner[5]),
        VertexId::new(2)
    );
}

#[test]
fn errors_for_bad_input_name_the_element() {
    let message = |r: Result<(Mesh, BuildReport), BuildError>| r.unwrap_err().to_string();
    assert_eq!(
        message(Mesh::from_polygons(points(3), &[[0, 1, 2], [0, 1, 3]])),
        "face 1 refers to vertex 3, but there are 3 vertices, numbered from 0"
    );
    let mut bad = points(3);
    bad[1].y = f64::NAN;
    assert_eq!(
        message(Mesh::from_polygons(bad, &[[0, 1, 2]])),
        "the position of vertex 1 is not finite"
    );
    assert!(build(points(3), &[0, 5], &[0, 1, 2], NonManifold::Split).is_err());
}

#[test]
fn refuse_returns_an_error_for_a_non_manifold_vertex() {
    let built = build(
        points(5),
        &[0, 3, 6],
        &[0, 1, 2, 0, 3, 4],
        NonManifold::Refuse,
    );
    assert_eq!(
        built.unwrap_err().to_string(),
        "the faces are not a manifold: edges do not connect all faces around the vertex v0"
    );
}

#[test]
fn refuse_reverses_inconsistent_polygons_but_refuse_as_given_does_not() {
    let corners = [0, 1, 2, 0, 1, 3];
    let reversed = build(points(4), &[0, 3, 6], &corners, NonManifold::Refuse).unwrap();
    assert_eq!(reversed.report.reversed_faces, [1]);
    let built = build(points(4), &[0, 3, 6], &corners, NonManifold::RefuseAsGiven);
    assert_eq!(
        built.unwrap_err().to_string(),
        "the faces are not a manifold: the edge v0-v1 has more than two faces, or two faces \
         that run along it in the same direction"
    );
}

/// Returns the polygons of a mesh as offsets and corners.
fn polygons_of(mesh: &Mesh) -> (Vec<u32>, Vec<u32>) {
    let number = |v: VertexId| u32::try_from(v.index()).unwrap();
    let faces: Vec<Vec<u32>> = mesh
        .faces()
        .map(|f| mesh.face_vertices(f).map(number).collect())
        .collect();
    flatten(&faces).unwrap()
}

#[test]
fn a_vertex_with_many_faces_does_not_take_quadratic_time() {
    // One vertex has a closed fan, an open fan, or triangles without common edges.
    let n = 200_000;
    let wheel = |i: u32| [0, 1 + i, 1 + (i + 1) % n];
    let closed: Vec<[u32; 3]> = (0..n).map(wheel).collect();
    let open: Vec<[u32; 3]> = (0..n - 1).map(wheel).collect();
    let separate: Vec<[u32; 3]> = (0..n / 2).map(|i| wheel(2 * i)).collect();
    let build = |triangles: &[[u32; 3]]| {
        let positions = vec![DVec3::ZERO; n as usize + 1];
        let (mesh, report) = Mesh::from_polygons(positions, triangles).unwrap();
        assert_eq!(mesh.defects(), []);
        (mesh.n_edges(), report.split_vertices.len())
    };
    assert_eq!(build(&closed), (2 * n as usize, 0));
    assert_eq!(build(&open), (2 * n as usize - 1, 0));
    assert_eq!(build(&separate), (3 * n as usize / 2, n as usize / 2 - 1));
}

#[test]
fn long_lists_of_polygons_are_flattened() {
    let lists: Vec<Vec<u32>> = (0..20_000_u32).map(|i| vec![i; (i % 7) as usize]).collect();
    let (offsets, corners) = flatten(&lists).unwrap();
    assert_eq!(corners, lists.concat());
    assert_eq!(offsets.len(), lists.len() + 1);
    let polygons = Polygons::new(&offsets, &corners);
    for (c, &i) in (0..).zip(&corners) {
        assert_eq!(polygons.face(c), i);
    }
}
