//! Operations that subdivide whole meshes or some of their faces.

mod butterfly;
mod catmull_clark;
mod doo_sabin;
mod loop_subdivide;
mod midpoint;
mod sqrt3;
mod step;

use op::Registry;

pub use butterfly::Butterfly;
pub use catmull_clark::CatmullClark;
pub use doo_sabin::DooSabin;
pub use loop_subdivide::LoopSubdivide;
pub use midpoint::Midpoint;
pub use sqrt3::Sqrt3;
pub use step::Until;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<LoopSubdivide>()
        .with::<CatmullClark>()
        .with::<Midpoint>()
        .with::<Butterfly>()
        .with::<Sqrt3>()
        .with::<DooSabin>()
}

#[cfg(test)]
mod rig_tests;
#[cfg(test)]
mod tests;
