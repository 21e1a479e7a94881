//! Composes pictures of scenes, for the operation `Picture` and the command line.
//!
//! ```text
//!   scene + numbers (ColorBy) + selected elements (highlight) --> Subject --Shot--> images --sheet--> one image
//! ```
//!
//! [`render`] draws one scene from one camera. A [`Shot`] draws several scenes from several cameras at the same scale,
//! with labels and a legend. [`draw_error_locations`] shows where errors are in a scene.

#![forbid(unsafe_code)]

mod changes;
mod error_locations;
mod highlight;
mod numbers;
mod position_bits;
pub mod sheet;
mod shot;
mod viewpoint;

pub use changes::changed_faces;
pub use error_locations::draw_error_locations;
pub use highlight::{HIGHLIGHT_COLOR, highlight};
pub use numbers::{ColorBy, Numbers, Quantity, existing_attributes, missing_attribute};
pub use shot::{Extent, Shot, Subject};
