//! Applies arbitrary edits in any order to a mesh. The mesh must stay valid, and a rollback must restore the mesh.
//!
//! The first byte determines the mesh. Each of the following groups of six bytes is an edit.

#![no_main]

#[path = "../laws/any_edit.rs"]
mod any_edit;

use libfuzzer_sys::fuzz_target;
use mesh::{COLOR, CREASE, DVec2, DVec4, MATERIAL, Mesh, UV};
use geometry::shapes;

use any_edit::{EditCode, edit_and_check};

/// The maximum number of faces. If the mesh has more faces, the run stops, so that no run takes long.
const MAX_FACES: usize = 100;

fuzz_target!(|bytes: &[u8]| {
    let Some((&shape, edits)) = bytes.split_first() else {
        return;
    };
    let start = with_attributes(start(shape));
    let mut mesh = start.clone();
    mesh.begin();
    let (codes, _) = edits.as_chunks::<6>();
    for &code in codes {
        edit_and_check(&mut mesh, EditCode::from_bytes(code));
        if mesh.n_faces() > MAX_FACES {
            break;
        }
    }
    mesh.rollback();
    assert!(mesh == start, "the rollback does not restore the initial mesh");
});

fn start(shape: u8) -> Mesh {
    match shape % 12 {
        0 => shapes::square(),
        1 => shapes::grid(3, 2),
        2 => shapes::fans(&shapes::grid(3, 2)),
        3 => shapes::cube(),
        4 => shapes::fans(&shapes::cube()),
        5 => shapes::tetrahedron(),
        6 => shapes::octahedron(),
        7 => shapes::torus(4, 3, 2.0, 1.0),
        8 => shapes::cylinder(5, true),
        9 => shapes::cylinder(3, false),
        10 => shapes::fans(&shapes::torus(4, 3, 2.0, 1.0)),
        _ => shapes::icosahedron(),
    }
}

/// Adds attributes of every domain to a mesh. The first face has separate UVs.
fn with_attributes(mut mesh: Mesh) -> Mesh {
    let uv = |h| {
        let chart = if mesh.face(h).is_some_and(|f| f.index() == 0) {
            10.0
        } else {
            0.0
        };
        mesh.position(mesh.origin(h)).truncate() + DVec2::splat(chart)
    };
    let uvs = mesh.half_edges().map(uv).collect();
    mesh.set(UV, uvs);
    mesh.set(COLOR, vec![DVec4::ONE; mesh.n_vertices()]);
    mesh.set(MATERIAL, vec![1; mesh.n_faces()]);
    mesh.set(CREASE, vec![0.5; mesh.n_edges()]);
    mesh
}
