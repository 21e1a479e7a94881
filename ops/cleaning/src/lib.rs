//! Operations that clean up a mesh.

mod reverse;
mod triangulate;
mod weld;

use op::Registry;

pub use reverse::Reverse;
pub use triangulate::Triangulate;
pub use weld::Weld;

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Weld>()
        .with::<Reverse>()
        .with::<Triangulate>()
}
