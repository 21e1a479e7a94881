//! Operations that cut and mirror solids.

mod bisect;
mod symmetrize;

use op::Registry;

pub use bisect::{Bisect, Keep};
pub use symmetrize::{Side, Symmetrize};

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Bisect>()
        .with::<Symmetrize>()
}
