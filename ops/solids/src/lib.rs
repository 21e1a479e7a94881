//! Operations that cut solids.

mod bisect;

use op::Registry;

pub use bisect::{Bisect, Keep};

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Bisect>()
}
