//! Operations on Bezier curves and patches.

mod curve_levels;
mod move_control_point;
mod move_patch_point;
mod sample_curve;
mod tessellate;

use op::Registry;

pub use curve_levels::CurveLevels;
pub use move_control_point::{MoveControlPoint, PlanePoint};
pub use move_patch_point::MovePatchPoint;
pub use sample_curve::SampleCurve;
pub use tessellate::{Faces, Tessellate};

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Tessellate>()
        .with::<SampleCurve>()
        .with::<CurveLevels>()
        .with::<MoveControlPoint>()
        .with::<MovePatchPoint>()
}
