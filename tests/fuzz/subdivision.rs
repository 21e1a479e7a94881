//! Subdivides arbitrary meshes with any scheme. Either the result is valid and finite, or the mesh is refused.

#![no_main]

mod any_mesh;

use libfuzzer_sys::fuzz_target;
use progress::NoProgress;
use subdivision::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split, subdivide};

use any_mesh::take;

fuzz_target!(|bytes: &[u8]| {
    let mut bytes = bytes;
    let choice = take(&mut bytes);
    let scheme = match choice % 8 {
        0 => Scheme::Loop(LoopWeights::Warren),
        1 => Scheme::Loop(LoopWeights::Loop),
        2 => Scheme::CatmullClark,
        3 => Scheme::Midpoint(Split::Quads),
        4 => Scheme::Midpoint(Split::Triangles),
        5 => Scheme::Butterfly,
        6 => Scheme::Sqrt3,
        _ => Scheme::DooSabin,
    };
    let mut rules = Rules::of(scheme);
    if choice & 8 != 0 {
        rules.boundary = Boundary::EdgesAndCorners;
    }
    if choice & 16 != 0 {
        rules.creasing = Creasing::Chaikin;
    }
    if choice & 32 != 0 {
        rules.face_varying = FaceVarying::Boundaries;
    }
    let levels = 1 + u32::from(choice >> 6 & 1);
    let Some(mesh) = any_mesh::mesh(&mut bytes) else {
        return;
    };
    if let Ok(fine) = subdivide(&mesh, rules, levels, &NoProgress) {
        assert_eq!(fine.defects(), []);
        assert!(fine.positions().iter().all(|p| p.is_finite()));
    }
});
