//! Operations that edit vertices or compute their normals.

mod bevel_vertices;
mod dissolve_vertices;
mod tangents;
mod vertex_normals;

use op::Registry;

pub use bevel_vertices::BevelVertices;
pub use dissolve_vertices::DissolveVertices;
pub use tangents::Tangents;
pub use vertex_normals::{VertexNormals, Weight, normals};

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<DissolveVertices>()
        .with::<BevelVertices>()
        .with::<VertexNormals>()
        .with::<Tangents>()
}
