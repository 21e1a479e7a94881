//! The memory of scenes that are kept.

use std::collections::HashSet;
use std::sync::Arc;

use scene::{Geometry, Scene};

/// Returns the memory of a scene without the meshes in `seen`, in bytes, and adds its meshes to `seen`. Scenes share their
/// unchanged meshes, so the sum over several scenes is the memory of all of them. `seen` has the addresses of meshes.
pub fn new_bytes(scene: &Scene, seen: &mut HashSet<usize>) -> u64 {
    let mut bytes = 1024;
    for object in scene.objects() {
        bytes += match &object.geometry {
            Geometry::Mesh(mesh) if seen.insert(Arc::as_ptr(mesh).addr()) => mesh.bytes() as u64,
            Geometry::Mesh(_) => 0,
            Geometry::Patches(patches) => size_of_val(patches.as_slice()) as u64,
            Geometry::Curve(curve) => size_of_val(curve.points()) as u64,
            Geometry::Polylines(lines) => lines
                .iter()
                .map(|line| size_of_val(line.as_slice()) as u64)
                .sum(),
        };
    }
    bytes
}
