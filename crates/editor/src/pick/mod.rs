//! Picking: from a point, a box or a lasso of the view to elements of meshes.

mod area;
mod index;
mod point;
mod projection;

pub use area::{Area, keep_visible, pick_area};
pub use index::Indexes;
pub use point::{Hit, PICK_RADIUS, PickMode, pick};
pub use projection::Projection;
