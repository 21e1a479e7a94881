//! Tests how flipped diagonals change the symmetry of a subdivided cube, for all 64 patterns of diagonals.

use engine::FileReader;
use geometry::shapes;
use mesh::EdgeId;
use op::Files;
use ops_subdivide::LoopSubdivide;
use recipe::Expectation;
use recipe::expect::{Group, Subject};
use scene::{Object, Scene};

/// Flips the diagonals in `pattern` of a cube of triangles. Returns the cube after one level of subdivision.
fn subdivided(pattern: usize) -> Scene {
    let mut cube = shapes::fans(&shapes::cube());
    let flat = |e: &EdgeId| cube.dihedral_angle(*e).is_some_and(|angle| angle < 0.1);
    let diagonals: Vec<EdgeId> = cube.edges().filter(flat).collect();
    assert_eq!(diagonals.len(), 6);
    for (i, e) in diagonals.into_iter().enumerate() {
        if pattern >> i & 1 == 1 {
            cube.flip_edge(e)
                .expect("a diagonal of a cube can be flipped");
        }
    }
    let smooth = op::test::applied(&LoopSubdivide::default(), cube);
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("cube", smooth))
        .expect("the first object");
    scene
}

fn is_symmetric(scene: &Scene, eq: Option<u64>, max: Option<u64>) -> bool {
    let symmetric = Expectation::SymmetricUnder {
        group: Group::CubeRotations,
        eq,
        min: None,
        max,
        tolerance: 1e-9,
        connectivity: true,
    };
    let files = Files::default();
    symmetric
        .check(Subject {
            scene,
            on: None,
            files: &files,
            reader: &FileReader,
            progress: &op::NoProgress,
        })
        .is_ok()
}

#[test]
fn no_pattern_of_flipped_diagonals_keeps_more_than_twelve_rotations_of_a_cube() {
    let scenes: Vec<Scene> = (0..64).map(subdivided).collect();
    assert!(
        scenes
            .iter()
            .all(|scene| is_symmetric(scene, None, Some(12)))
    );
    // Two patterns of diagonals keep twelve of the rotations of the cube. In one pattern, the diagonals are the edges
    // of a tetrahedron. The other pattern is its mirror image.
    assert_eq!(
        scenes
            .iter()
            .filter(|scene| is_symmetric(scene, Some(12), None))
            .count(),
        2
    );
}
