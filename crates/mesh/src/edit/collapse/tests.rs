mod attributes;
mod oracle;

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use super::*;
use crate::{
    COLOR, CREASE, Column, Domain, FaceId, MATERIAL, Rule, UV, VERTEX_NORMAL, Values, shapes,
};

fn at(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

fn of(positions: &[DVec3], polygons: &[&[u32]]) -> Mesh {
    let (mesh, report) = Mesh::from_polygons(positions.to_vec(), polygons).unwrap();
    assert!(report.is_clean());
    mesh
}

/// Polygons over vertices whose places do not matter.
fn over(n: usize, polygons: &[&[u32]]) -> Mesh {
    of(&vec![DVec3::ZERO; n], polygons)
}

fn edge(mesh: &Mesh, v: usize, w: usize) -> EdgeId {
    let [v, w] = [v, w].map(VertexId::new);
    mesh.find_half_edge(v, w)
        .expect("they share an edge")
        .edge()
}

/// The faces by id, each beginning at its lowest corner.
fn faces(mesh: &Mesh) -> Vec<(usize, Vec<usize>)> {
    let corners = |f| mesh.face_vertices(f).map(VertexId::index).collect();
    mesh.faces()
        .map(|f| (f.index(), lowest_first(corners(f))))
        .collect()
}

fn lowest_first(mut face: Vec<usize>) -> Vec<usize> {
    let low = (0..face.len()).min_by_key(|&i| face[i]).unwrap_or(0);
    face.rotate_left(low);
    face
}

/// The edit is refused for this reason, and every array stays as it was.
fn refused(mesh: &Mesh, e: EdgeId) -> EditError {
    let mut edited = mesh.clone();
    let reason = edited.collapse_edge(e).unwrap_err();
    assert_eq!(&edited, mesh);
    reason
}

/// Two triangles and what lies around them: a = 1, b = 5, c = 2, d = 3 of the picture, in a strip.
fn strip() -> Mesh {
    let positions = [
        at(-2., 0.),
        at(-1., 0.),
        at(0., 1.),
        at(0., -1.),
        at(2., 0.),
        at(1., 0.),
    ];
    let around: [&[u32]; 6] = [
        &[1, 5, 2],
        &[5, 1, 3],
        &[1, 2, 0],
        &[1, 0, 3],
        &[5, 4, 2],
        &[5, 3, 4],
    ];
    of(&positions, &around)
}

#[test]
fn two_triangles_vanish_and_ids_stay_as_documented() {
    let mut mesh = strip();
    let [e, bc, bd] = [(1, 5), (5, 2), (5, 3)].map(|(v, w)| edge(&mesh, v, w));
    let [ac, ad] = [(1, 2), (1, 3)].map(|(v, w)| edge(&mesh, v, w));
    assert_eq!(mesh.collapse_edge(e), Ok(VertexId::new(1)));
    assert_eq!(mesh.defects(), []);
    assert_eq!(mesh.position(VertexId::new(1)), at(0., 0.));
    assert!(!mesh.has_vertex(VertexId::new(5)));
    assert_eq!([e, bc, bd].map(|e| mesh.has_edge(e)), [false; 3]);
    assert_eq!([ac, ad].map(|e| mesh.has_edge(e)), [true; 2]);
    let left = [
        (2, vec![0, 1, 2]),
        (3, vec![0, 3, 1]),
        (4, vec![1, 4, 2]),
        (5, vec![1, 3, 4]),
    ];
    assert_eq!(faces(&mesh), left);
}

#[test]
fn the_lower_number_survives_whichever_end_it_is() {
    for turned in [false, true] {
        // The edge runs from 0 to 1 on the first face, or from 1 to 0.
        let polygons: [&[u32]; 2] = if turned {
            [&[1, 0, 2, 3], &[0, 1, 4]]
        } else {
            [&[0, 1, 2, 3], &[1, 0, 4]]
        };
        let mut mesh = over(5, &polygons);
        // The edge is inside and both ends are on the boundary: a face behind each makes one inner.
        let e = edge(&mesh, 0, 1);
        assert_eq!(refused(&mesh, e), EditError::JoinsBoundaries(e));
        let e = edge(&mesh, 1, 4);
        assert_eq!(mesh.collapse_edge(e), Ok(VertexId::new(1)));
        assert_eq!(mesh.defects(), []);
        assert_eq!(mesh.n_faces(), 1);
        assert!(mesh.has_edge(edge(&mesh, 0, 1)));
    }
}

#[test]
fn larger_faces_lose_a_corner() {
    let mut mesh = shapes::cube();
    let e = edge(&mesh, 1, 5);
    mesh.collapse_edge(e).unwrap();
    assert_eq!(mesh.defects(), []);
    let mut degrees: Vec<_> = mesh.faces().map(|f| mesh.degree(f)).collect();
    degrees.sort_unstable();
    assert_eq!(degrees, [3, 3, 4, 4, 4, 4]);
    assert_eq!(mesh.euler_characteristic(), 2);
}

#[test]
fn a_boundary_edge_takes_its_triangle_along() {
    // The lowest three of a fan of triangles over a row of points.
    for gone in [0, 1, 2, 3] {
        let points: Vec<DVec3> = (0..5).map(|i| at(f64::from(i), 0.)).collect();
        let positions = [&points[..], &[at(2., 2.)]].concat();
        let mut mesh = of(
            &positions,
            &[&[0, 1, 5], &[1, 2, 5], &[2, 3, 5], &[3, 4, 5]],
        );
        let e = edge(&mesh, gone, gone + 1);
        let v = mesh.collapse_edge(e).unwrap();
        assert_eq!(v, VertexId::new(gone));
        assert_eq!(mesh.defects(), []);
        assert_eq!(
            (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
            (5, 7, 3)
        );
        assert!(mesh.is_boundary_vertex(v));
    }
}

// ---- Refusals ------------------------------------------------------------------------------------

#[test]
fn nothing_is_folded_onto_itself_or_emptied() {
    let pillow = over(3, &[&[0, 1, 2], &[0, 2, 1]]);
    let triangle = over(3, &[&[0, 1, 2]]);
    // Two squares back to back would be left, and two triangles.
    let squares = over(5, &[&[0, 1, 2], &[1, 0, 3], &[0, 2, 4, 3], &[1, 3, 4, 2]]);
    let tent = over(4, &[&[0, 1, 2], &[1, 0, 2, 3], &[1, 3, 2]]);
    for mesh in [pillow, triangle, shapes::tetrahedron()] {
        for e in mesh.edges() {
            assert_eq!(refused(&mesh, e), EditError::Vanishes(e));
        }
    }
    for mesh in [squares, tent] {
        let e = edge(&mesh, 0, 1);
        assert_eq!(refused(&mesh, e), EditError::Vanishes(e));
    }
    // Faces that are back to back already only lose a corner.
    let mut pillow = over(4, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]);
    pillow.collapse_edge(EdgeId::new(0)).unwrap();
    assert_eq!(pillow.defects(), []);
    assert_eq!(pillow.n_faces(), 2);
}

#[test]
fn a_neighbor_in_common_beyond_the_triangles_is_refused() {
    // The waist of two tetrahedra that share a face, which is not there.
    let mesh = over(
        5,
        &[
            &[0, 1, 3],
            &[1, 2, 3],
            &[2, 0, 3],
            &[1, 0, 4],
            &[2, 1, 4],
            &[0, 2, 4],
        ],
    );
    let e = edge(&mesh, 0, 1);
    assert_eq!(refused(&mesh, e), EditError::Link(e, VertexId::new(2)));
}

#[test]
fn a_neighbor_in_common_on_the_same_polygon_is_refused() {
    // 2 is the neighbor of 1 on the square and of 0 beyond it.
    let mesh = over(
        5,
        &[
            &[0, 1, 2, 3],
            &[1, 0, 4],
            &[2, 1, 4],
            &[0, 2, 4],
            &[0, 3, 2],
        ],
    );
    let e = edge(&mesh, 0, 1);
    assert_eq!(refused(&mesh, e), EditError::Link(e, VertexId::new(2)));
}

#[test]
fn a_hole_of_three_does_not_close() {
    let mut mesh = shapes::octahedron();
    mesh.delete_face(FaceId::new(0)).unwrap();
    let rim = mesh.half_edges().find(|&h| mesh.face(h).is_none()).unwrap();
    let opposite = mesh.target(mesh.next(rim));
    let e = rim.edge();
    assert_eq!(refused(&mesh, e), EditError::Link(e, opposite));
}

#[test]
fn a_face_that_touches_both_ends_elsewhere_is_refused() {
    // The square has 0 and 1 as opposite corners, and two triangles at their edge close it.
    let mesh = over(4, &[&[0, 2, 1, 3], &[0, 1, 2], &[1, 0, 3]]);
    let e = edge(&mesh, 0, 1);
    let twice = EditError::VisitsTwice(FaceId::new(0), VertexId::new(0));
    assert_eq!(refused(&mesh, e), twice);
}

#[test]
fn a_second_edge_between_the_ends_is_refused() {
    // A split where both triangles have the same corner opposite joins it twice.
    let mut mesh = over(3, &[&[0, 1, 2], &[0, 2, 1]]);
    let m = mesh.split_edge(edge(&mesh, 0, 1), 0.5).unwrap();
    let half = edge(&mesh, 0, m.index());
    assert_eq!(
        refused(&mesh, half),
        EditError::SameOpposite(half, VertexId::new(2))
    );
    for end in [0, 1] {
        mesh.split_edge(edge(&mesh, end, 2), 0.5).unwrap();
    }
    let twice = edge(&mesh, m.index(), 2);
    let [v, w] = mesh.edge_vertices(twice);
    assert_eq!(refused(&mesh, twice), EditError::DuplicateEdge(v, w));
}

#[test]
fn bad_places_and_edges_are_refused() {
    let mesh = shapes::octahedron();
    let mut edited = mesh.clone();
    let e = EdgeId::new(0);
    for t in [-0.1, 1.1, f64::NAN] {
        let refused = edited.collapse_edge_at(e, t);
        assert!(matches!(refused, Err(EditError::OutsideEdge(_))));
    }
    for x in [f64::NAN, f64::INFINITY] {
        let refused = edited.collapse_edge_to(e, DVec3::new(0.0, x, 0.0));
        assert!(matches!(refused, Err(EditError::BadNumber(_))));
    }
    assert_eq!(edited, mesh);
    for e in [EdgeId::new(99), EdgeId::NONE] {
        assert_eq!(refused(&mesh, e), EditError::NoSuchEdge(e));
    }
}
