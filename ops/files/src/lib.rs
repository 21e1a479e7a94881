//! Operations: reading and writing files.

mod load;
mod save;
mod save_plan;

use op::Registry;

pub use load::Load;
pub use save::Save;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Load>()
        .with::<Save>()
}
