//! The same mesh comes out of two other ways to compute it.

use super::{distance, once};
use crate::fixtures::{self, triangles};
use crate::oracle;

#[test]
fn it_is_what_splitting_all_edges_and_flipping_the_new_ones_gives() {
    // The halves of a pillow share all vertices, so flips are refused on the way.
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
fn it_is_what_a_list_of_triangles_gives() {
    for (name, mesh) in fixtures::all() {
        // From its first level on, a pillow has two edges between the same vertices.
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

/// As [`triangles`] orders them.
fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    for t in &mut triangles {
        while t[0] != *t.iter().min().unwrap() {
            t.rotate_left(1);
        }
    }
    triangles.sort_unstable();
    triangles
}
