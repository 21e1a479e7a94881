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

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<FillHoles>()
        .with::<BridgeLoops>()
        .with::<Stitch>()
        .with::<Cut>()
}
