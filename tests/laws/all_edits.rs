//! Tests long random sequences of edits of all kinds, on every small test mesh of the module `fixtures`.

use glam::DVec3;
use mesh::Mesh;
use proptest::prelude::*;

use crate::any_edit::{EditCode, LAST_LOCAL, edit_and_check};
use crate::fixtures;

/// The number of edits in a sequence.
const EDITS: usize = 1000;

/// Edits that add elements are applied only to meshes with at most this number of edges. Larger meshes get only edits
/// that do not add elements. The limit counts edges instead of faces, because even a few faces can have many corners.
const MAX_EDGES: usize = 250;

/// Returns the small test meshes, with and without attributes.
fn meshes() -> Vec<Mesh> {
    let small = fixtures::meshes().into_iter().map(|(_, mesh)| mesh);
    let small: Vec<Mesh> = small.filter(|mesh| mesh.n_faces() < 100).collect();
    let with_attributes = small.iter().map(|mesh| {
        let object = fixtures::with_attributes(mesh.clone());
        object.as_mesh().expect("a mesh").as_ref().clone()
    });
    with_attributes.chain(small.iter().cloned()).collect()
}

fn code() -> impl Strategy<Value = EditCode> {
    any::<[u8; 6]>().prop_map(EditCode::from_bytes)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1, max_shrink_iters: 2000, ..<_>::default() })]

    #[test]
    fn a_thousand_edits_keep_every_guarantee_and_can_be_reverted(
        coordinates in prop::collection::vec(-2..=2_i8, 64),
        codes in prop::collection::vec(code(), EDITS),
    ) {
        for start in meshes() {
            let mut mesh = start;
            // Coordinates are small integers, so that some vertices coincide and some faces have zero area.
            let mut numbers = coordinates.iter().cycle().map(|&x| f64::from(x));
            for p in mesh.positions_mut() {
                *p = DVec3::from_array([(); 3].map(|()| numbers.next().expect("the numbers are cyclic")));
            }
            let start = mesh.clone();
            mesh.begin();
            for (i, &code) in codes.iter().enumerate() {
                let kind = if mesh.n_edges() > MAX_EDGES {
                    // These kinds of edits do not add elements: they delete faces, compact the mesh, or remove edges.
                    [2, 7, 8, 9, 12, 25, 26, 27][usize::from(code.kind % 8)]
                } else {
                    code.kind
                };
                // Algorithms that change the whole surface are slow, so at most every twentieth edit is one of them.
                let is_slow = kind > LAST_LOCAL && i % 20 != 0;
                let kind = if is_slow { kind % LAST_LOCAL } else { kind };
                let code = EditCode { kind, ..code };
                // Every tenth edit is made in a nested level of the journal (the record for undoing edits), and this
                // level is then rolled back.
                if i % 10 == 9 {
                    let before = mesh.clone();
                    mesh.begin();
                    edit_and_check(&mut mesh, code);
                    mesh.rollback();
                    prop_assert!(mesh == before, "{:?} was not rolled back", code);
                }
                edit_and_check(&mut mesh, code);
            }
            let end = mesh.clone();
            let change = mesh.commit().expect("the outermost level");
            let redo = mesh.revert(change);
            prop_assert!(mesh == start, "reverting does not restore the initial mesh");
            mesh.revert(redo);
            prop_assert!(mesh == end, "redoing does not restore the final mesh");
        }
    }
}
