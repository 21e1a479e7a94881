//! Tests of the operation.

use super::*;
use geometry::shapes;
use mesh::{
    Attribute, CREASE, DVec2, DVec3, Domain, EdgeId, FaceId, HalfEdgeId, MATERIAL, Rule, UV, Value,
    Values, VertexId,
};
use op::test::{applied, try_applied};
use op::{Files, NoProgress, Progress};

fn weld(distance: f64) -> Weld {
    let distance = Length::literal(distance);
    Weld { distance }
}

/// Returns a mesh with the same faces, but with a separate vertex for each corner of each face.
fn torn(mesh: &Mesh) -> Mesh {
    let mut positions = Vec::new();
    let mut polygons = Vec::new();
    for f in mesh.faces() {
        let first = u32::try_from(positions.len()).unwrap();
        positions.extend(mesh.face_vertices(f).map(|v| mesh.position(v)));
        let end = u32::try_from(positions.len()).unwrap();
        polygons.push((first..end).collect::<Vec<_>>());
    }
    Mesh::from_polygons(positions, &polygons).unwrap().0
}

fn flat(points: &[(f64, f64)], polygons: &[&[u32]]) -> Mesh {
    let points = points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect();
    Mesh::from_polygons(points, polygons).unwrap().0
}

fn values<I: mesh::Id, T: Value>(mesh: &Mesh, attribute: Attribute<I, T>) -> Vec<T> {
    mesh.get(attribute).unwrap().to_vec()
}

#[test]
fn six_separate_squares_become_a_cube() {
    let (cube, report) = try_applied(&weld(0.0), torn(&shapes::cube())).unwrap();
    assert_eq!(
        (cube.n_vertices(), cube.n_edges(), cube.n_faces()),
        (8, 12, 6)
    );
    assert!(cube.is_closed());
    assert_eq!(geometry::genus(&cube), 0);
    assert!((geometry::volume(&cube) - 8.0).abs() < 1e-12);
    assert_eq!(report.changed, 16);
    assert_eq!(report.notes, ["merged 16 vertices"]);
}

#[test]
fn separated_faces_of_any_shape_are_joined() {
    for shape in [
        shapes::torus(7, 5, 2.0, 0.5),
        shapes::icosahedron(),
        shapes::grid(4, 3),
        shapes::cylinder(9, true),
    ] {
        let whole = applied(&weld(1e-9), torn(&shape));
        assert_eq!(whole.n_vertices(), shape.n_vertices());
        assert_eq!(whole.n_edges(), shape.n_edges());
        assert_eq!(whole.euler_characteristic(), shape.euler_characteristic());
        assert_eq!(whole.n_boundary_loops(), shape.n_boundary_loops());
        assert!((geometry::area(&whole) - geometry::area(&shape)).abs() < 1e-12);
    }
}

#[test]
fn a_second_weld_changes_nothing() {
    let mut mesh = torn(&shapes::torus(9, 6, 2.0, 0.5));
    for (p, i) in mesh.positions_mut().iter_mut().zip(0_u32..) {
        *p += DVec3::new(f64::from(i % 3), f64::from(i % 5), f64::from(i % 7)) * 1e-4;
    }
    let once = applied(&weld(1e-2), mesh);
    let (twice, report) = try_applied(&weld(1e-2), once.clone()).unwrap();
    assert_eq!(once.n_vertices(), 54);
    assert_eq!(twice, once);
    assert_eq!(report, Report::default());
}

#[test]
fn a_mesh_without_close_vertices_keeps_every_number() {
    // If no vertices merge, the mesh must not be built again from polygons, because half-edges could then get other
    // ids.
    let mesh = shapes::uv_sphere(6, 5);
    assert_eq!(applied(&weld(1e-6), mesh.clone()), mesh);
    assert_eq!(applied(&weld(1e-6), Mesh::default()), Mesh::default());
}

#[test]
fn the_merged_vertex_is_the_one_with_the_lowest_number() {
    let weights = Attribute::<VertexId, f64>::new("weight", Rule::Interpolate);
    let points = [
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 1.0),
        (1.01, 0.0),
        (2.0, 0.0),
        (1.01, 1.0),
    ];
    let mut mesh = flat(&points, &[&[0, 1, 2], &[3, 4, 5]]);
    mesh.set(weights, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    let welded = applied(&weld(0.1), mesh);
    assert_eq!(welded.n_vertices(), 4);
    assert_eq!(values(&welded, weights), [0.0, 1.0, 2.0, 4.0]);
    let x: Vec<f64> = welded.positions().iter().map(|p| p.x).collect();
    assert_eq!(x, [0.0, 1.0, 1.0, 2.0]);
    assert_eq!(welded.n_edges(), 5);
}

#[test]
fn seams_are_kept() {
    let cube = shapes::cube();
    let mut mesh = torn(&cube);
    // Each face has a separate UV chart.
    let uv = |mesh: &Mesh, h| {
        let f = mesh.face(h).map_or(0.0, |f| f.index() as f64);
        let p = mesh.position(mesh.origin(h));
        DVec2::new(10.0 * f + p.x, p.y + 3.0 * p.z)
    };
    let uvs = mesh.half_edges().map(|h| uv(&mesh, h)).collect();
    mesh.set(UV, uvs);
    let welded = applied(&weld(0.0), mesh);
    let uvs = values(&welded, UV);
    assert!(
        welded
            .half_edges()
            .all(|h| uvs[h.index()] == uv(&welded, h))
    );
    assert!(welded.edges().all(|e| welded.is_seam(e)));
}

#[test]
fn faces_and_edges_keep_their_values() {
    let mut mesh = torn(&shapes::cube());
    mesh.set(MATERIAL, vec![5, 4, 3, 2, 1, 0]);
    mesh.set(CREASE, (0..24).map(f64::from).collect());
    let welded = applied(&weld(0.0), mesh.clone());
    assert_eq!(values(&welded, MATERIAL), [5, 4, 3, 2, 1, 0]);
    // When two edges become one edge, the edge gets the value of the edge with the lower id.
    for e in welded.edges() {
        let place = |mesh: &Mesh, e| {
            let [a, b] = mesh.edge_vertices(e).map(|v| mesh.position(v));
            (a + b).to_array()
        };
        let first = mesh
            .edges()
            .find(|&old| place(&mesh, old) == place(&welded, e));
        let expected = first.unwrap().index() as f64;
        assert_eq!(values(&welded, CREASE)[e.index()], expected);
    }
}

#[test]
fn three_squares_at_one_edge_are_split_and_counted() {
    let mut squares = Vec::new();
    for direction in [DVec3::X, DVec3::Y, DVec3::NEG_X] {
        squares.extend([DVec3::ZERO, direction, direction + DVec3::Z, DVec3::Z]);
    }
    let polygons = [[0, 1, 2, 3], [7, 6, 5, 4], [8, 9, 10, 11]];
    let (mesh, _) = Mesh::from_polygons(squares, &polygons).unwrap();
    let (welded, report) = try_applied(&weld(0.0), mesh).unwrap();
    assert_eq!((welded.n_faces(), geometry::n_components(&welded)), (3, 2));
    // Four vertices are merged, and two of the merged vertices are copied for the third square.
    assert_eq!(welded.n_vertices(), 10);
    assert_eq!(report.notes.len(), 2);
    assert!(
        report.notes[1].contains("1 non-manifold edge split"),
        "{}",
        report.notes[1]
    );
}

#[test]
fn squares_of_opposite_orientation_agree_after_welding() {
    // Two neighboring squares. The second square has its corners in reverse order.
    let squares = [0.0, 1.0].map(|x| {
        [(x, 0.0), (x + 1.0, 0.0), (x + 1.0, 1.0), (x, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0))
    });
    let polygons = [[0, 1, 2, 3], [7, 6, 5, 4]];
    let (mut mesh, _) = Mesh::from_polygons(squares.concat(), &polygons).unwrap();

    mesh.set(VERTEX_NORMAL, vec![DVec3::Z; 8]);
    mesh.set(CREASE, (0..8).map(f64::from).collect());
    let corner_places: Vec<DVec3> = mesh
        .half_edges()
        .map(|h| mesh.position(mesh.origin(h)))
        .collect();
    let place = Attribute::<HalfEdgeId, DVec3>::new("place", Rule::Copy);
    mesh.set(place, corner_places);
    let middle = |mesh: &Mesh, e: EdgeId| {
        let [v, w] = mesh.edge_vertices(e).map(|v| mesh.position(v));
        (v + w) / 2.0
    };

    let (welded, report) = try_applied(&weld(0.0), mesh.clone()).unwrap();
    assert_eq!(welded.defects(), []);
    assert_eq!((welded.n_vertices(), welded.n_edges()), (6, 7));
    assert!(welded.faces().all(|f| welded.face_normal(f) == DVec3::Z));
    assert_eq!(
        report.notes,
        [
            "merged 2 vertices",
            "1 face reversed to agree with its neighbors (face 1)"
        ]
    );
    assert!(welded.get(VERTEX_NORMAL).is_none());
    // Each edge has the value of the first old edge at its position. Each corner keeps its value.
    for e in welded.edges() {
        let first = mesh
            .edges()
            .find(|&old| middle(&mesh, old) == middle(&welded, e));
        assert_eq!(
            values(&welded, CREASE)[e.index()],
            first.unwrap().index() as f64
        );
    }
    for h in welded.half_edges().filter(|&h| welded.face(h).is_some()) {
        assert_eq!(
            values(&welded, place)[h.index()],
            welded.position(welded.origin(h))
        );
    }
}

#[test]
fn small_faces_lose_corners_or_are_removed() {
    // A quad with one short side, and a triangle with one short side.
    let points = [
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 1.0),
        (1.0, 1.001),
        (5.0, 0.0),
        (6.0, 0.0),
        (6.0, 0.001),
    ];
    let (welded, report) =
        try_applied(&weld(0.01), flat(&points, &[&[0, 1, 2, 3], &[4, 5, 6]])).unwrap();
    assert_eq!((welded.n_faces(), welded.n_vertices()), (1, 5));
    assert_eq!(welded.degree(FaceId::new(0)), 3);
    assert_eq!(welded.n_isolated_vertices(), 2);
    assert_eq!(
        report.notes,
        [
            "merged 2 vertices",
            "faces that lost corners: 1",
            "1 face dropped because it has fewer than 3 corners or contains a vertex twice (face 1)"
        ]
    );
}

#[test]
fn a_face_that_visits_a_vertex_twice_is_removed() {
    let points = [
        (0.0, 0.0),
        (1.0, 0.001),
        (2.0, 0.0),
        (1.0, 1.0),
        (1.0, 0.002),
        (0.5, 0.5),
    ];
    let (welded, report) = try_applied(&weld(0.01), flat(&points, &[&[0, 1, 2, 3, 4, 5]])).unwrap();
    assert_eq!((welded.n_faces(), welded.n_vertices()), (0, 5));
    assert!(
        report.notes[1].contains("1 face dropped"),
        "{:?}",
        report.notes
    );
}

#[test]
fn a_distance_larger_than_the_mesh_leaves_one_vertex() {
    for distance in [100.0, f64::MAX] {
        let point = applied(&weld(distance), shapes::cube());
        assert_eq!(
            (point.n_vertices(), point.n_edges(), point.n_faces()),
            (1, 0, 0)
        );
        assert_eq!(
            point.position(VertexId::new(0)),
            shapes::cube().positions()[0]
        );
    }
}

#[test]
fn isolated_vertices_are_merged_but_not_removed() {
    let points = [(9.0, 9.0), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)];
    let welded = applied(&weld(0.0), flat(&points, &[&[1, 2, 3]]));
    assert_eq!((welded.n_vertices(), welded.n_isolated_vertices()), (4, 1));
}

#[test]
fn columns_with_the_rule_drop_are_dropped_and_reported() {
    let mut mesh = torn(&shapes::cube());
    let column = mesh::Column {
        name: "cache".into(),
        rule: Rule::Drop,
        values: Values::Int(vec![1; 6]),
    };
    mesh.insert_column(Domain::Face, column);
    let (welded, report) = try_applied(&weld(0.0), mesh).unwrap();
    assert_eq!(welded.attributes().iter().count(), 0);
    assert_eq!(report.losses.len(), 1);
}

#[test]
fn a_cancelled_weld_leaves_the_mesh_unchanged() {
    struct Stop;
    impl Progress for Stop {
        fn advance(&self, _: &str, _: u64, _: u64) -> bool {
            false
        }
    }
    let files = Files::default();
    let mut mesh = torn(&shapes::cube());
    let mut cx = Context::new(&Stop, &files);
    let stopped = MeshOperation::apply(&weld(0.0), &mut mesh, &mut cx);
    assert!(matches!(stopped, Err(OpError::Cancelled)));
    assert_eq!(mesh, torn(&shapes::cube()));
    let mut cx = Context::new(&NoProgress, &files);
    assert!(MeshOperation::apply(&weld(0.0), &mut mesh, &mut cx).is_ok());
}

#[test]
fn the_distance_is_required() {
    let weld: Weld = op::test::read("(distance: 1e-6)").unwrap();
    assert_eq!(weld.distance.get(), 1e-6);
    assert!(op::test::read::<Weld>("()").is_err());
    assert!(op::test::read::<Weld>("(distance: 1, uvs: true)").is_err());
}
