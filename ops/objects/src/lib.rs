//! Operations on whole objects, such as copying, joining and moving.

mod copy;
mod delete;
mod join;
mod rename;
#[cfg(test)]
mod rig_tests;
mod scatter;
mod separate;
mod transform;

use op::Registry;

pub use copy::Copy;
pub use delete::Delete;
pub use join::Join;
pub use rename::Rename;
pub use scatter::Scatter;
pub use separate::{Separate, SeparateBy};
pub use transform::{About, Transform};

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Copy>()
        .with::<Delete>()
        .with::<Rename>()
        .with::<Join>()
        .with::<Separate>()
        .with::<Transform>()
        .with::<Scatter>()
}
