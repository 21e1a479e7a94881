//! Operations that clean up a mesh.

mod reverse;
mod triangulate;
mod weld;

use op::Registry;

pub use reverse::Reverse;
pub use triangulate::Triangulate;
pub use weld::Weld;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Weld>()
        .with::<Reverse>()
        .with::<Triangulate>()
}
