//! Measures the memory that several scenes take together.

use std::collections::HashSet;
use std::sync::Arc;

use scene::{Geometry, Scene};

/// Adds up the memory of scenes. A mesh that several scenes share is counted once. `SceneMemory` recognizes a mesh by
/// its address, so the caller must keep all added scenes until the last call of [`add`](Self::add).
#[derive(Debug, Default)]
pub struct SceneMemory {
    bytes: u64,
    /// The addresses of the meshes that `bytes` counts.
    seen: HashSet<usize>,
}

impl SceneMemory {
    /// Adds the memory of a scene, and returns the sum for all scenes that were added, in bytes.
    pub fn add(&mut self, scene: &Scene) -> u64 {
        let mut bytes = 1024_u64;
        for object in scene.objects() {
            bytes += match &object.geometry {
                Geometry::Mesh(mesh) if self.seen.insert(Arc::as_ptr(mesh).addr()) => {
                    mesh.bytes() as u64
                }
                Geometry::Mesh(_) => 0,
                Geometry::Patches(patches) => size_of_val(patches.as_slice()) as u64,
                Geometry::Curve(curve) => size_of_val(curve.points()) as u64,
                Geometry::Polylines(lines) => lines
                    .iter()
                    .map(|line| size_of_val(line.as_slice()) as u64)
                    .sum(),
            };
        }
        self.bytes = self.bytes.saturating_add(bytes);
        self.bytes
    }
}
