//! Operations that edit edges.

mod bevel_edges;
mod collapse_edges;
mod crease;
mod dissolve_edges;
mod flip_edges;
mod split_edges;

use op::Registry;

pub use bevel_edges::BevelEdges;
pub use collapse_edges::CollapseEdges;
pub use crease::Crease;
pub use dissolve_edges::DissolveEdges;
pub use flip_edges::{FlipEdges, Until};
pub use split_edges::SplitEdges;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<FlipEdges>()
        .with::<SplitEdges>()
        .with::<CollapseEdges>()
        .with::<DissolveEdges>()
        .with::<BevelEdges>()
        .with::<Crease>()
}
