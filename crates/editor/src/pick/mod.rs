//! Picking: finds the elements of meshes at a point, in a box or in a lasso of the view.

mod area;
mod index;
mod point;
mod projection;

pub use area::{Area, keep_visible, pick_area};
pub use index::Indexes;
pub use point::{Hit, PICK_RADIUS, PickMode, pick};
pub use projection::Projection;
