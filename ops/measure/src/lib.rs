//! Operations that measure meshes.

mod measure;
mod quantity;

use op::Registry;

pub use measure::Measure;
pub use quantity::{MeasureOf, Principal};

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Measure>()
}
