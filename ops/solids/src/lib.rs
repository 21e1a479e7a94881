//! Operations that cut and mirror solids.

mod bisect;
mod symmetrize;

use op::Registry;

pub use bisect::{Bisect, Keep};
pub use symmetrize::{Side, Symmetrize};

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Bisect>()
        .with::<Symmetrize>()
}
