//! Operations that measure meshes.

mod measure;
mod quantity;

use op::Registry;

pub use measure::Measure;
pub use quantity::{MeasureOf, Principal};

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Measure>()
}
