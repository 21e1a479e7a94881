//! Compares Loop subdivision with two other implementations.

use super::{distance, once};
use crate::fixtures::{self, triangles};
use crate::oracle;

#[test]
fn a_level_equals_splitting_all_edges_and_flipping_new_ones() {
    // The two faces of a pillow share all vertices, so some flips are refused.
    for (name, mesh) in fixtures::all().into_iter().filter(|(n, _)| *n != "pillow") {
        let mut old = mesh;
        for level in 1..=2 {
            let new = once(&old);
            let expected = oracle::by_splits_and_flips(&old);
            assert_eq!(expected.defects(), [], "{name} {level}");
            assert_eq!(triangles(&new), triangles(&expected), "{name} {level}");
            let far = distance(new.positions(), expected.positions());
            assert!(far < 1e-14, "{name} {level}: {far:e}");
            old = new;
        }
    }
}

#[test]
fn a_level_equals_subdividing_a_list_of_triangles() {
    for (name, mesh) in fixtures::all() {
        // After the first level, a pillow (two triangles with the same vertices) has two edges between the same
        // vertices.
        let levels = if name == "pillow" { 1 } else { 2 };
        let mut old = mesh;
        for level in 1..=levels {
            let new = once(&old);
            let (positions, expected) = oracle::over_polygons_of(&old);
            assert_eq!(triangles(&new), sorted(expected), "{name} {level}");
            let far = distance(new.positions(), &positions);
            assert!(far < 1e-14, "{name} {level}: {far:e}");
            old = new;
        }
    }
}

/// Sorts triangles as [`triangles`] does.
fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    for t in &mut triangles {
        while t[0] != *t.iter().min().unwrap() {
            t.rotate_left(1);
        }
    }
    triangles.sort_unstable();
    triangles
}
