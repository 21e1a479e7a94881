//! Operations that simplify, remesh and smooth surfaces.

mod lods;
mod remesh;
mod simplify;
mod smooth;
mod transfer;

use op::Registry;

pub use lods::Lods;
pub use remesh::{Remesh, RemeshCurvature};
pub use simplify::{Intersections, Simplify};
pub use smooth::{Smooth, SmoothBoundary, SmoothBy, SmoothWeights};
pub use transfer::Transfer;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Simplify>()
        .with::<Lods>()
        .with::<Remesh>()
        .with::<Smooth>()
        .with::<Transfer>()
}
