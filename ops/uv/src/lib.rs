//! Operations that make and pack texture coordinates.

mod attribute;
mod pack_uvs;
mod unwrap;

use op::Registry;

pub use pack_uvs::PackUvs;
pub use unwrap::Unwrap;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Unwrap>()
        .with::<PackUvs>()
}
