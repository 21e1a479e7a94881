//! Operations: reading and writing files.

mod load;
mod save;
mod save_plan;

use op::Registry;

pub use load::Load;
pub use save::Save;

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Load>()
        .with::<Save>()
}
