//! Operations that make and pack texture coordinates.

mod attribute;
mod pack_uvs;
mod unwrap;

use op::Registry;

pub use pack_uvs::PackUvs;
pub use unwrap::Unwrap;

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Unwrap>()
        .with::<PackUvs>()
}
