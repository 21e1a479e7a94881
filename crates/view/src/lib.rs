//! What to show of a scene, and how: for the operation `Picture`, the program and the editor.
//!
//! ```text
//!   scene --numbers (ColorBy), selected elements (marked)--> Subject --cameras (Shot)--> images --sheet--> one image
//! ```
//!
//! [`render`] draws one scene from one camera. A [`Shot`] draws several scenes from several cameras in one scale, with
//! labels and a legend. [`draw_places`] shows what an error is about.

#![forbid(unsafe_code)]

mod marks;
mod numbers;
mod places;
pub mod sheet;
mod shot;
mod sight;

pub use marks::{MARK, marked};
pub use numbers::{ColorBy, Numbers, Quantity, no_attribute, there_are};
pub use places::draw_places;
pub use shot::{Extent, Shot, Subject};
