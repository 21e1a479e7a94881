//! Drawings in the plane: figures, labels and legends.
//!
//! A figure is an SVG document ([`Svg`]), which is written as text or rendered to [`pixels`](fn@pixels). Labels and
//! legends are also SVG documents, which are drawn over an image.
//!
//! - [`construction`](mod@construction): de Casteljau's construction of a point of a Bezier curve.
//! - [`half_edges`](mod@half_edges): the half-edges of a part of a mesh.
//! - [`legend`](mod@legend): the legend that explains the colors of a picture.
//! - [`uv_layout`](mod@uv_layout): the charts of texture coordinates.
//! - [`label`](mod@label): labels at points of an image.

pub mod construction;
pub mod half_edges;
pub mod label;
pub mod legend;
mod letters;
mod pixels;
mod svg;
#[doc(hidden)]
pub mod testing;
pub mod uv_layout;

pub use pixels::{bytes_needed, draw, pixel_size, pixels};
pub use svg::{Anchor, Color, Command, Font, Paint, Run, Svg, Text};
