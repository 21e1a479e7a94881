mod attributes;
mod oracle;

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use super::*;
use crate::{
    COLOR, CREASE, Column, Domain, FaceId, MATERIAL, Rule, UV, VERTEX_NORMAL, Values, shapes,
};

fn point(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

fn mesh_of(positions: &[DVec3], polygons: &[&[u32]]) -> Mesh {
    let (mesh, report) = Mesh::from_polygons(positions.to_vec(), polygons).unwrap();
    assert!(report.is_clean());
    mesh
}

/// Returns a mesh of polygons with `n` vertices, all at the origin.
fn topology(n: usize, polygons: &[&[u32]]) -> Mesh {
    mesh_of(&vec![DVec3::ZERO; n], polygons)
}

fn edge(mesh: &Mesh, v: usize, w: usize) -> EdgeId {
    let [v, w] = [v, w].map(VertexId::new);
    mesh.find_half_edge(v, w)
        .expect("the vertices share an edge")
        .edge()
}

/// Returns the faces by id, each starting at its lowest corner.
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

/// Checks that the edit is refused and that the mesh is unchanged. Returns the reason.
fn refused(mesh: &Mesh, e: EdgeId) -> EditError {
    let mut edited = mesh.clone();
    let reason = edited.collapse_edge(e).unwrap_err();
    assert_eq!(&edited, mesh);
    reason
}

/// Returns the two triangles of the picture and their neighbors: a = 1, b = 5, c = 2, d = 3.
fn strip() -> Mesh {
    let positions = [
        point(-2., 0.),
        point(-1., 0.),
        point(0., 1.),
        point(0., -1.),
        point(2., 0.),
        point(1., 0.),
    ];
    let polygons: [&[u32]; 6] = [
        &[1, 5, 2],
        &[5, 1, 3],
        &[1, 2, 0],
        &[1, 0, 3],
        &[5, 4, 2],
        &[5, 3, 4],
    ];
    mesh_of(&positions, &polygons)
}

#[test]
fn two_triangles_vanish_and_the_documented_ids_remain() {
    let mut mesh = strip();
    let [e, bc, bd] = [(1, 5), (5, 2), (5, 3)].map(|(v, w)| edge(&mesh, v, w));
    let [ac, ad] = [(1, 2), (1, 3)].map(|(v, w)| edge(&mesh, v, w));
    assert_eq!(mesh.collapse_edge(e), Ok(VertexId::new(1)));
    assert_eq!(mesh.defects(), []);
    assert_eq!(mesh.position(VertexId::new(1)), point(0., 0.));
    assert!(!mesh.has_vertex(VertexId::new(5)));
    assert_eq!([e, bc, bd].map(|e| mesh.has_edge(e)), [false; 3]);
    assert_eq!([ac, ad].map(|e| mesh.has_edge(e)), [true; 2]);
    let remaining = [
        (2, vec![0, 1, 2]),
        (3, vec![0, 3, 1]),
        (4, vec![1, 4, 2]),
        (5, vec![1, 3, 4]),
    ];
    assert_eq!(faces(&mesh), remaining);
}

#[test]
fn the_end_with_the_lower_id_remains() {
    for is_reversed in [false, true] {
        // On the first face, the edge runs from 0 to 1 in the first round, and from 1 to 0 in the second round.
        let polygons: [&[u32]; 2] = if is_reversed {
            [&[1, 0, 2, 3], &[0, 1, 4]]
        } else {
            [&[0, 1, 2, 3], &[1, 0, 4]]
        };
        let mut mesh = topology(5, &polygons);
        // The edge is inside the mesh, but both of its ends are on the boundary.
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
fn collapsing_a_boundary_edge_removes_its_triangle() {
    // The fan has four triangles, which join a row of points to a common corner. In each round, one of its outer edges
    // is collapsed.
    for first in [0, 1, 2, 3] {
        let points: Vec<DVec3> = (0..5).map(|i| point(f64::from(i), 0.)).collect();
        let positions = [&points[..], &[point(2., 2.)]].concat();
        let mut mesh = mesh_of(
            &positions,
            &[&[0, 1, 5], &[1, 2, 5], &[2, 3, 5], &[3, 4, 5]],
        );
        let e = edge(&mesh, first, first + 1);
        let v = mesh.collapse_edge(e).unwrap();
        assert_eq!(v, VertexId::new(first));
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
fn collapses_that_leave_no_faces_or_faces_back_to_back_are_refused() {
    let pillow = topology(3, &[&[0, 1, 2], &[0, 2, 1]]);
    let triangle = topology(3, &[&[0, 1, 2]]);
    // The collapse would leave two squares back to back, or two triangles back to back.
    let squares = topology(5, &[&[0, 1, 2], &[1, 0, 3], &[0, 2, 4, 3], &[1, 3, 4, 2]]);
    let tent = topology(4, &[&[0, 1, 2], &[1, 0, 2, 3], &[1, 3, 2]]);
    for mesh in [pillow, triangle, shapes::tetrahedron()] {
        for e in mesh.edges() {
            assert_eq!(refused(&mesh, e), EditError::Vanishes(e));
        }
    }
    for mesh in [squares, tent] {
        let e = edge(&mesh, 0, 1);
        assert_eq!(refused(&mesh, e), EditError::Vanishes(e));
    }
    // Faces that are already back to back only lose a corner.
    let mut pillow = topology(4, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]);
    pillow.collapse_edge(EdgeId::new(0)).unwrap();
    assert_eq!(pillow.defects(), []);
    assert_eq!(pillow.n_faces(), 2);
}

#[test]
fn a_common_neighbor_outside_the_triangles_is_refused() {
    // Two tetrahedra are glued together at a face, and this face is not in the mesh. The edge is a side of this
    // face.
    let mesh = topology(
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
fn a_common_neighbor_on_the_same_polygon_is_refused() {
    // A side of the square joins 2 and 1. An edge outside of the square joins 2 and 0.
    let mesh = topology(
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
fn an_edge_of_a_hole_with_three_edges_is_refused() {
    let mut mesh = shapes::octahedron();
    mesh.delete_face(FaceId::new(0)).unwrap();
    let rim = mesh.half_edges().find(|&h| mesh.face(h).is_none()).unwrap();
    let opposite = mesh.target(mesh.next(rim));
    let e = rim.edge();
    assert_eq!(refused(&mesh, e), EditError::Link(e, opposite));
}

#[test]
fn a_common_face_that_is_not_beside_the_edge_is_refused() {
    // 0 and 1 are opposite corners of the square. Two triangles at the edge 0-1 close the mesh.
    let mesh = topology(4, &[&[0, 2, 1, 3], &[0, 1, 2], &[1, 0, 3]]);
    let e = edge(&mesh, 0, 1);
    let twice = EditError::VisitsTwice(FaceId::new(0), VertexId::new(0));
    assert_eq!(refused(&mesh, e), twice);
}

#[test]
fn a_second_edge_between_the_ends_is_refused() {
    // If both triangles have the same opposite corner, a split joins this corner to the new vertex by two
    // edges.
    let mut mesh = topology(3, &[&[0, 1, 2], &[0, 2, 1]]);
    let m = mesh.split_edge(edge(&mesh, 0, 1), 0.5).unwrap();
    let half = edge(&mesh, 0, m.index());
    assert_eq!(
        refused(&mesh, half),
        EditError::SameOpposite(half, VertexId::new(2))
    );
    for end in [0, 1] {
        mesh.split_edge(edge(&mesh, end, 2), 0.5).unwrap();
    }
    let parallel = edge(&mesh, m.index(), 2);
    let [v, w] = mesh.edge_vertices(parallel);
    assert_eq!(refused(&mesh, parallel), EditError::DuplicateEdge(v, w));
}

#[test]
fn bad_positions_and_missing_edges_are_refused() {
    let mesh = shapes::octahedron();
    let mut edited = mesh.clone();
    let e = EdgeId::new(0);
    for t in [-0.1, 1.1, f64::NAN] {
        let result = edited.collapse_edge_at(e, t);
        assert!(matches!(result, Err(EditError::OutsideEdge(_))));
    }
    for x in [f64::NAN, f64::INFINITY] {
        let result = edited.collapse_edge_to(e, DVec3::new(0.0, x, 0.0));
        assert!(matches!(result, Err(EditError::BadNumber(_))));
    }
    assert_eq!(edited, mesh);
    for e in [EdgeId::new(99), EdgeId::NONE] {
        assert_eq!(refused(&mesh, e), EditError::NoSuchEdge(e));
    }
}
