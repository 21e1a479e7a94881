//! Long random sequences of edits of all kinds, on every fixture.

use glam::DVec3;
use mesh::Mesh;
use proptest::prelude::*;

use crate::any_edit::{Code, edit_and_check};
use crate::fixtures;

/// How long a sequence is.
const EDITS: usize = 1000;

/// Meshes larger than this get no further edits that add faces.
const MAX_FACES: usize = 150;

/// The small fixtures, each bare and with attributes.
fn meshes() -> Vec<Mesh> {
    let small = fixtures::meshes().into_iter().map(|(_, mesh)| mesh);
    let small: Vec<Mesh> = small.filter(|mesh| mesh.n_faces() < 100).collect();
    let dressed = small.iter().map(|mesh| {
        let object = fixtures::dressed(mesh.clone());
        object.as_mesh().expect("a mesh").as_ref().clone()
    });
    dressed.chain(small.iter().cloned()).collect()
}

fn code() -> impl Strategy<Value = Code> {
    any::<[u8; 6]>().prop_map(Code::from_bytes)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1, max_shrink_iters: 2000, ..<_>::default() })]

    #[test]
    fn a_thousand_edits_keep_every_promise_and_can_be_taken_back(
        coordinates in prop::collection::vec(-2..=2_i8, 64),
        codes in prop::collection::vec(code(), EDITS),
    ) {
        for start in meshes() {
            let mut mesh = start;
            // Small whole numbers: vertices coincide and faces have no area.
            let mut numbers = coordinates.iter().cycle().map(|&x| f64::from(x));
            for p in mesh.positions_mut() {
                *p = DVec3::from_array([(); 3].map(|()| numbers.next().expect("they repeat")));
            }
            let start = mesh.clone();
            mesh.begin();
            for (i, &code) in codes.iter().enumerate() {
                let code = if mesh.n_faces() > MAX_FACES {
                    // Deletes faces, compacts, or takes edges away.
                    Code { kind: [2, 7, 8, 9, 12, 25, 26][usize::from(code.kind % 7)], ..code }
                } else {
                    code
                };
                // Now and then an inner level that is taken back.
                if i % 10 == 9 {
                    let before = mesh.clone();
                    mesh.begin();
                    edit_and_check(&mut mesh, code);
                    mesh.rollback();
                    prop_assert!(mesh == before, "{:?} was not taken back", code);
                }
                edit_and_check(&mut mesh, code);
            }
            let end = mesh.clone();
            let change = mesh.commit().expect("the outermost level");
            let again = mesh.revert(change);
            prop_assert!(mesh == start, "the start does not come back");
            mesh.revert(again);
            prop_assert!(mesh == end, "the end does not come again");
        }
    }
}
