//! Tests in the plane: compares flips with the exact circumcircle test in integers.

use mesh::{DVec3, EdgeId, FaceId, Mesh, VertexId};
use op::test::try_applied;
use proptest::prelude::*;

use super::parse;
use crate::flip_edges::goal::{Goal, Quad};

/// The side length of the square that contains the points.
const SIDE: i64 = 12;

type Point = [i64; 2];

/// Returns twice the signed area of a triangle. The result is positive if the triangle is counter-clockwise.
fn turn([a, b, c]: [Point; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Returns a positive number if `p` is inside the circle through the corners of a counter-clockwise triangle. Points
/// are lifted to a paraboloid (Guibas and Stolfi, "Primitives for the Manipulation of General Subdivisions and the
/// Computation of Voronoi Diagrams", 1985).
fn in_circle(triangle: [Point; 3], p: Point) -> i64 {
    let lifted = triangle.map(|[x, y]| {
        let (x, y) = (x - p[0], y - p[1]);
        [x, y, x * x + y * y]
    });
    let [a, b, c] = lifted;
    a[2] * (b[0] * c[1] - b[1] * c[0]) - b[2] * (a[0] * c[1] - a[1] * c[0])
        + c[2] * (a[0] * b[1] - a[1] * b[0])
}

fn mesh_of(points: &[Point], triangles: &[[u32; 3]]) -> Mesh {
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let place = |&[x, y]: &Point| DVec3::new(x as f64, y as f64, 0.0);
    let (mesh, report) =
        Mesh::from_polygons(points.iter().map(place).collect(), triangles).unwrap();
    assert!(report.is_clean());
    mesh
}

fn corners(mesh: &Mesh, points: &[Point], f: FaceId) -> [Point; 3] {
    let corners: Vec<_> = mesh.face_vertices(f).map(|v| points[v.index()]).collect();
    corners.try_into().expect("a triangle")
}

/// Triangulates the square by inserting the points one after the other. Returns the mesh and the points of its
/// vertices: the corners of the square, and then the inserted points without duplicates. Each point cuts the triangle
/// that contains the point into three triangles. A point on an edge therefore gives a zero-area triangle.
fn cut_square(inside: &[Point]) -> (Vec<Point>, Mesh) {
    let mut points = vec![[0, 0], [SIDE, 0], [SIDE, SIDE], [0, SIDE]];
    let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
    for &p in inside {
        if points.contains(&p) {
            continue;
        }
        let containing = triangles.iter().position(|triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|v| points[v as usize]);
            let turns = [[a, b, p], [b, c, p], [c, a, p]].map(turn);
            turn([a, b, c]) > 0 && turns.iter().all(|&turn| turn >= 0)
        });
        let m = u32::try_from(points.len()).unwrap();
        points.push(p);
        let [a, b, c] = triangles.remove(containing.expect("the triangles cover the square"));
        triangles.extend([[a, b, m], [b, c, m], [c, a, m]]);
    }
    let mesh = mesh_of(&points, &triangles);
    (points, mesh)
}

fn inside() -> impl Strategy<Value = Vec<Point>> {
    let coordinate = || 1..SIDE;
    let point = (coordinate(), coordinate()).prop_map(|(x, y)| [x, y]);
    prop::collection::vec(point, 0..40)
}

proptest! {
    #[test]
    fn no_vertex_is_inside_the_circumcircle_of_a_triangle(inside in inside()) {
        let (points, mesh) = cut_square(&inside);
        let (mesh, report) = try_applied(&parse("(edges: All, until: Delaunay)"), mesh).unwrap();
        prop_assert_eq!(report.refused, []);
        let mut covered = 0;
        for f in mesh.faces() {
            let triangle = corners(&mesh, &points, f);
            prop_assert!(turn(triangle) > 0, "{:?} is not counter-clockwise", triangle);
            covered += turn(triangle);
            for &p in &points {
                prop_assert!(in_circle(triangle, p) <= 0, "{:?} is inside the circumcircle of {:?}", p, triangle);
            }
        }
        prop_assert_eq!(covered, 2 * SIDE * SIDE);
    }

    #[test]
    fn valence_flips_do_not_fold_the_surface(inside in inside()) {
        let (points, mesh) = cut_square(&inside);
        let flat = |mesh: &Mesh| mesh.faces().filter(|&f| turn(corners(mesh, &points, f)) == 0).count();
        let before = flat(&mesh);
        let (mesh, _) = try_applied(&parse("(edges: All, until: Valence)"), mesh).unwrap();
        let turns = mesh.faces().map(|f| turn(corners(&mesh, &points, f)));
        prop_assert!(turns.clone().all(|turn| turn >= 0));
        prop_assert_eq!(turns.sum::<i64>(), 2 * SIDE * SIDE);
        prop_assert!(flat(&mesh) <= before);
    }

    #[test]
    fn a_flip_is_an_improvement_exactly_if_the_opposite_corner_is_in_the_circumcircle(
        (a, b) in (0..20_i64, 1..20_i64), above in prop::array::uniform2(-20..20_i64),
        below in prop::array::uniform2(-20..20_i64),
    ) {
        let [a, b] = [[-a, 0], [b, 0]];
        let (c, d) = ([above[0], above[1].abs() + 1], [below[0], -below[1].abs() - 1]);
        let mesh = mesh_of(&[a, b, c, d], &[[0, 1, 2], [1, 0, 3]]);
        let e = mesh.find_half_edge(VertexId::new(0), VertexId::new(1)).unwrap().edge();
        let is_convex = turn([d, c, a]) > 0 && turn([c, d, b]) > 0;
        prop_assert_eq!(
            Goal::Delaunay.is_improvement(&mesh, &Quad::beside(&mesh, e)),
            is_convex && in_circle([a, b, c], d) > 0
        );
    }
}

#[test]
fn the_diagonals_of_squares_are_not_flipped() {
    // The four corners of a square lie on a circle, so both diagonals of the square are equally good.
    let grid = geometry::shapes::fans(&geometry::shapes::grid(9, 7));
    let (flipped, report) =
        try_applied(&parse("(edges: All, until: Delaunay)"), grid.clone()).unwrap();
    assert_eq!((flipped, report.changed), (grid, 0));
}

#[test]
fn the_diagonals_of_rotated_squares_are_not_flipped() {
    let mut grid = geometry::shapes::fans(&geometry::shapes::grid(9, 7));
    for p in grid.positions_mut() {
        *p = DVec3::new(0.1 * p.x - 0.3 * p.y, 0.3 * p.x + 0.1 * p.y, 0.7);
    }
    let (flipped, report) =
        try_applied(&parse("(edges: All, until: Delaunay)"), grid.clone()).unwrap();
    assert_eq!((flipped, report.changed), (grid, 0));
}

#[test]
fn an_edge_through_a_vertex_is_flipped_to_end_at_the_vertex() {
    // Vertex 2 is on the edge from vertex 0 to vertex 1, so the triangle with these three vertices has no area.
    let points = [[0, 0], [4, 0], [2, 0], [2, 3], [2, -3]];
    let mesh = mesh_of(&points, &[[0, 1, 2], [1, 3, 2], [3, 0, 2], [1, 0, 4]]);
    let e = EdgeId::new(0);
    assert_eq!(mesh.edge_vertices(e).map(VertexId::index), [0, 1]);
    let (mesh, report) = try_applied(&parse("(edges: All, until: Delaunay)"), mesh).unwrap();
    assert_eq!(report.changed, 1);
    assert_eq!(mesh.edge_vertices(e).map(VertexId::index), [4, 2]);
    assert!(mesh.faces().all(|f| mesh.face_area(f) == 3.0));
}

#[test]
fn triangles_without_area_on_both_sides_of_an_edge_are_removed() {
    // Vertices 4 and 5 are on the diagonal of the square, so the mesh has two zero-area triangles.
    let (points, mesh) = cut_square(&[[1, 1], [4, 4]]);
    let is_flat = |mesh: &Mesh, f| turn(corners(mesh, &points, f)) == 0;
    assert_eq!(mesh.faces().filter(|&f| is_flat(&mesh, f)).count(), 2);
    let (mesh, _) = try_applied(&parse("(edges: All, until: Delaunay)"), mesh).unwrap();
    assert!(mesh.faces().all(|f| !is_flat(&mesh, f)));
}

#[test]
fn flips_do_not_create_triangles_whose_area_is_rounding_error() {
    // Up to rounding, vertex 0 is on the line from vertex 2 to vertex 3, so the flipped edge would go through vertex 0.
    for k in 2..60 {
        let on_line = |k: i32| DVec3::new(0.1 * f64::from(k), 0.3 * f64::from(k), 0.7);
        let far = on_line(k) + DVec3::new(1.0, -1.0, 0.0);
        let positions = vec![on_line(k), far, on_line(3 * k), on_line(1)];
        let (mesh, _) = Mesh::from_polygons(positions, &[[0, 1, 2], [1, 0, 3]]).unwrap();
        let quad = Quad::beside(&mesh, EdgeId::new(0));
        let excess = vec![9, 9, 0, 0];
        assert!(
            !Goal::Valence { excess }.is_improvement(&mesh, &quad),
            "{k}"
        );
        assert!(!Goal::Delaunay.is_improvement(&mesh, &quad), "{k}");
    }
}
