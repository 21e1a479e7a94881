//! Operations that open and close surfaces.

mod bridge_loops;
mod cut;
mod fill_holes;
mod stitch;

use op::Registry;

pub use bridge_loops::BridgeLoops;
pub use cut::Cut;
pub use fill_holes::{Cover, FillHoles};
pub use stitch::Stitch;

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<FillHoles>()
        .with::<BridgeLoops>()
        .with::<Stitch>()
        .with::<Cut>()
}
