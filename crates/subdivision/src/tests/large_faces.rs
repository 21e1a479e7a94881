//! Faces with many corners. The sums over all corners of a face are computed once, not again for each new corner.

use geometry::shapes;
use mesh::{Column, DVec2, DVec3, Domain, FaceId, HalfEdgeId, Mesh, Rule, UV, Values};
use progress::NoProgress;

use super::{distance, level};
use crate::{Rules, Scheme, Split, subdivision_matrix};

/// Returns a closed cylinder between two polygons with 100 corners. The vertices are moved irregularly. The texture
/// coordinates of each corner are the first two coordinates of its position.
fn cylinder() -> Mesh {
    let mut mesh = shapes::cylinder(100, true);
    for (i, p) in mesh.positions_mut().iter_mut().enumerate() {
        *p += DVec3::new(
            (i * i % 17) as f64,
            (i * 7 % 13) as f64,
            (i * 5 % 11) as f64,
        ) * 0.01;
    }
    mesh.set(UV, corner_positions(&mesh));
    let column = Column {
        name: "number".to_owned(),
        rule: Rule::Interpolate,
        values: Values::Int((0..).take(mesh.n_half_edges()).collect()),
    };
    mesh.insert_column(Domain::Corner, column);
    mesh
}

fn corner_positions(mesh: &Mesh) -> Vec<DVec2> {
    let position = |h| mesh.position(mesh.origin(h)).truncate();
    mesh.half_edges().map(position).collect()
}

fn caps(mesh: &Mesh) -> Vec<FaceId> {
    let caps: Vec<FaceId> = mesh.faces().filter(|&f| mesh.degree(f) == 100).collect();
    assert_eq!(caps.len(), 2);
    caps
}

#[test]
fn doo_sabin_points_of_large_faces_are_the_weighted_sums_of_the_matrix() {
    let mesh = cylinder();
    let rules = Rules::of(Scheme::DooSabin);
    let matrix = subdivision_matrix(&mesh, rules, 1, &NoProgress).unwrap();
    let new = level(Scheme::DooSabin, &mesh);
    assert!(distance(&matrix.apply(mesh.positions()), new.positions()) < 1e-14);
}

#[test]
fn corner_values_of_large_faces_stay_equal_to_the_positions_of_their_corners() {
    let mesh = cylinder();
    for scheme in [Scheme::DooSabin, Scheme::Midpoint(Split::Quads)] {
        let new = level(scheme, &mesh);
        let (uv, expected) = (new.get(UV).unwrap(), corner_positions(&new));
        let faces: Vec<FaceId> = if scheme == Scheme::DooSabin {
            caps(&mesh)
        } else {
            new.faces().collect()
        };
        for h in faces.iter().flat_map(|&f| new.face_half_edges(f)) {
            let difference = uv[h.index()] - expected[h.index()];
            assert!(difference.length() < 1e-14, "{scheme:?} {h}");
        }
    }
}

#[test]
fn whole_numbers_at_the_corners_of_a_large_face_are_copied() {
    let old = cylinder();
    let new = level(Scheme::DooSabin, &old);
    let numbers = |mesh: &Mesh| -> Vec<i32> {
        let column = mesh.attributes().column(Domain::Corner, "number").unwrap();
        let Values::Int(numbers) = &column.values else {
            panic!("the values are whole numbers");
        };
        numbers.clone()
    };
    let (before, after) = (numbers(&old), numbers(&new));
    for f in caps(&old) {
        let at = |values: &[i32], h: HalfEdgeId| values[h.index()];
        let expected: Vec<i32> = old.face_half_edges(f).map(|h| at(&before, h)).collect();
        let found: Vec<i32> = new.face_half_edges(f).map(|h| at(&after, h)).collect();
        assert_eq!(found, expected, "{f}");
    }
}
