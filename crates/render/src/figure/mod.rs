//! Drawings in the plane: figures, captions, legends.
//!
//! One drawing code for two outputs. A figure is an SVG document ([`Svg`]), and its pixels are those of the
//! document ([`pixels`]). The same documents, drawn over an image, are its labels and legends.
//!
//! - [`construction`](mod@construction): de Casteljau's construction of a point of a Bezier curve.
//! - [`legend`](mod@legend): what the colors of a picture stand for.
//! - [`label`](mod@label): texts at places of an image.

pub mod construction;
pub mod label;
pub mod legend;
mod letters;
mod pixels;
mod svg;
#[doc(hidden)]
pub mod testing;

pub use pixels::{bytes_needed, draw, pixel_size, pixels};
pub use svg::{Anchor, Color, Command, Font, Paint, Run, Svg, Text};
