//! Operations that tag elements: a tag is a named selection.

mod tag_edges;
mod tag_faces;
mod tag_vertices;

use op::Registry;

pub use tag_edges::TagEdges;
pub use tag_faces::TagFaces;
pub use tag_vertices::TagVertices;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<TagVertices>()
        .with::<TagEdges>()
        .with::<TagFaces>()
}
