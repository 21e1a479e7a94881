//! Tests with polygons of inconsistent orientation.

use super::oracle::Random;
use super::*;
use crate::{VertexId, shapes};

/// Reverses each listed polygon; its first corner stays the first.
fn reversed(offsets: &[u32], corners: &[u32], faces: &[usize]) -> Vec<u32> {
    let mut corners = corners.to_vec();
    for &f in faces {
        corners[offsets[f] as usize + 1..offsets[f + 1] as usize].reverse();
    }
    corners
}

/// Checks the two maps of the result: from each corner to its half-edge, and from each side to its edge.
fn check_maps(offsets: &[u32], corners: &[u32], built: &BuildOutput) {
    let edges = built.edges_of_sides(offsets);
    for (f, w) in offsets.windows(2).enumerate() {
        let polygon = w[0] as usize..w[1] as usize;
        for c in polygon.clone() {
            let next = if c + 1 == polygon.end {
                polygon.start
            } else {
                c + 1
            };
            let h = built.half_edge_of_corner[c];
            assert_eq!(built.mesh.face(h), Some(built.face_of_polygon[f]));
            let origin = built.mesh.position(built.mesh.origin(h));
            let expected = built.mesh.position(VertexId::new(corners[c] as usize));
            assert_eq!(origin, expected);
            let mut ends = built
                .mesh
                .edge_vertices(edges[c])
                .map(|v| built.mesh.position(v));
            if ends[0] != origin {
                ends.reverse();
            }
            let target = built.mesh.position(VertexId::new(corners[next] as usize));
            assert_eq!(ends, [origin, target]);
        }
    }
}

#[test]
fn the_second_of_two_inconsistent_triangles_is_reversed() {
    let (mesh, report) = mesh(4, &[&[0, 1, 2], &[0, 1, 3]]);
    assert_eq!(report.reversed_faces, [1]);
    assert_eq!(
        report.summary(),
        "1 face reversed to agree with its neighbors (face 1)"
    );
    let corners = mesh.face_vertices(FaceId::new(1)).map(VertexId::index);
    assert_eq!(corners.collect::<Vec<_>>(), [0, 3, 1]);
    assert_eq!((mesh.n_vertices(), mesh.n_edges()), (4, 5));
}

#[test]
fn reversed_faces_of_any_shape_are_restored() {
    let mut random = Random(7);
    let shapes = [
        shapes::cube(),
        shapes::icosahedron(),
        shapes::torus(7, 5, 2.0, 1.0),
        shapes::fans(&shapes::torus(40, 30, 2.0, 1.0)),
        shapes::uv_sphere(40, 9),
        shapes::cylinder(9, true),
        shapes::cylinder(9, false),
        shapes::grid(6, 5),
    ];
    for shape in shapes {
        let (offsets, corners) = polygons_of(&shape);
        let n = shape.n_faces();
        let positions = || shape.positions().to_vec();
        let build =
            |corners: &[u32]| build(positions(), &offsets, corners, NonManifold::Split).unwrap();
        let original = build(&corners);
        assert!(original.report.is_clean());
        for share in [20, 3, 2, 1] {
            let flipped: Vec<usize> = (0..n)
                .filter(|_| random.below(share.max(2)) == 0 || share == 1)
                .collect();
            let input = reversed(&offsets, &corners, &flipped);
            let built = build(&input);
            assert_eq!(built.mesh.defects(), []);
            check_maps(&offsets, &input, &built);

            // All faces are in one part. The orientation of the majority of the faces is kept. In a tie, the
            // orientation of face 0 is kept.
            let unflipped: Vec<usize> = (0..n).filter(|f| !flipped.contains(f)).collect();
            let flipped_are_minority = flipped.len() < unflipped.len()
                || flipped.len() == unflipped.len() && unflipped[0] == 0;
            let (expected, expected_corners) = if flipped_are_minority {
                (flipped, corners.clone())
            } else {
                (
                    unflipped,
                    reversed(&offsets, &corners, &(0..n).collect::<Vec<_>>()),
                )
            };
            assert_eq!(built.report.reversed_faces, expected);
            assert_eq!(built.mesh, build(&expected_corners).mesh);
            assert_eq!(built.report.is_clean(), expected.is_empty());
            assert!(built.report.split_edges.is_empty() && built.report.split_vertices.is_empty());
        }
    }
}

#[test]
fn in_a_tie_the_orientation_of_the_first_face_is_kept() {
    // The polygons are a strip of four triangles. The first two triangles and the last two have opposite orientations.
    let strip: [&[u32]; 4] = [&[0, 2, 1], &[1, 2, 3], &[2, 3, 4], &[3, 5, 4]];
    let (_, report) = mesh(6, &strip);
    assert_eq!(report.reversed_faces, [2, 3]);
}

#[test]
fn a_moebius_strip_is_not_reversed_but_split() {
    // Quadrilaterals around a ring, with a half turn at the end.
    let n = 8;
    let strip: Vec<Vec<u32>> = (0..n)
        .map(|i| {
            let end = if i + 1 == n {
                [1, 0]
            } else {
                [2 * i + 2, 2 * i + 3]
            };
            vec![2 * i, end[0], end[1], 2 * i + 1]
        })
        .collect();
    let (offsets, corners) = flatten(&strip).unwrap();
    let built =
        |non_manifold| build(points(2 * n as usize), &offsets, &corners, non_manifold).unwrap();
    let strip = built(NonManifold::Split);
    assert_eq!(strip.mesh.defects(), []);
    assert_eq!(strip.report.unorientable, [0]);
    assert!(strip.report.reversed_faces.is_empty() && !strip.report.is_clean());
    assert_eq!(
        strip.report.split_edges,
        [[VertexId::new(0), VertexId::new(1)]]
    );
    assert_eq!(strip.mesh, built(NonManifold::SplitAsGiven).mesh);
    assert_eq!(
        strip.report.summary(),
        "1 part has no consistent orientation (face 0), 1 non-manifold edge split (v0-v1), \
         2 non-manifold vertices split (v0, v1)"
    );
}

#[test]
fn the_majority_of_each_part_decides() {
    // One face of the first tetrahedron and three faces of the second are reversed.
    let (offsets, corners) = polygons_of(&shapes::tetrahedron());
    let one = reversed(&offsets, &corners, &[2]);
    let three = reversed(&offsets, &corners, &[0, 1, 3]);
    let corners: Vec<u32> = one
        .iter()
        .copied()
        .chain(three.iter().map(|v| v + 4))
        .collect();
    let offsets: Vec<u32> = (0..=24).step_by(3).collect();
    let built = build(points(8), &offsets, &corners, NonManifold::Split).unwrap();
    assert_eq!(built.report.reversed_faces, [2, 6]);
    assert!(built.mesh.is_closed());
    check_maps(&offsets, &corners, &built);
}

#[test]
fn an_edge_with_three_faces_does_not_connect_parts() {
    // Three wings meet at the edge 0-1. Each wing has two triangles; the outer triangle of the second wing is
    // reversed.
    let wings: [&[u32]; 6] = [
        &[0, 1, 2],
        &[2, 1, 3], // first
        &[1, 0, 4],
        &[4, 1, 5], // second
        &[0, 1, 6],
        &[6, 1, 7], // third
    ];
    let (mesh, report) = mesh(8, &wings);
    assert_eq!(report.reversed_faces, [3]);
    assert_eq!(report.split_edges, [[VertexId::new(0), VertexId::new(1)]]);
    assert_eq!(report.unorientable, [0_usize; 0]);
    assert_eq!(
        (crate::geometry::n_components(&mesh), mesh.n_faces()),
        (2, 6)
    );
}

#[test]
fn reports_use_the_face_numbers_of_the_input_even_if_faces_were_dropped() {
    let corners = [0, 0, 1, 0, 1, 2, 0, 1, 3, 1, 2];
    let offsets = [0, 3, 6, 9, 11];
    let built = build(points(4), &offsets, &corners, NonManifold::Split).unwrap();
    assert_eq!(built.report.dropped_faces, [0, 3]);
    assert_eq!(built.report.reversed_faces, [2]);
    let edges = built.edges_of_sides(&offsets);
    assert_eq!(edges[0], EdgeId::NONE);
    // Both polygons have a side from 0 to 1.
    assert_eq!(edges[3], edges[6]);
    assert_ne!(
        built.half_edge_of_corner[3].edge(),
        built.half_edge_of_corner[6].edge()
    );
}
