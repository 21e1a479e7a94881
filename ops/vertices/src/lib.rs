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

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<DissolveVertices>()
        .with::<BevelVertices>()
        .with::<VertexNormals>()
        .with::<Tangents>()
}
