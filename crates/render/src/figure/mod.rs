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

pub use pixels::{bytes_needed, draw, pixel_size, pixels};
pub use svg::{Anchor, Color, Command, Font, Paint, Run, Svg, Text};

/// Texts that break programs, for tests: every one must be written and drawn without harm.
#[doc(hidden)]
pub const ODD_TEXTS: &[&str] = &[
    "",
    " ",
    "plain",
    "a < b & \"c\" > 'd'",
    "]]> <!-- --> &amp; &#0;",
    "tab\tline\nreturn\r",
    "\0\x01\x08\x1b[31m\x7f\u{85}\u{9f}",
    "\u{fffe}\u{ffff}\u{feff}",
    "\u{5e9}\u{5dc}\u{5d5}\u{5dd} abc \u{645}\u{631}\u{62d}\u{628}\u{627}",
    "\u{202e}override\u{202c} \u{2066}isolate",
    "\u{1f980}\u{1f469}\u{200d}\u{1f52c}\u{1f1e9}\u{1f1ea}",
    "e\u{301}\u{301}\u{301}\u{301}\u{301} \u{300}",
    "\u{10ffff}\u{e000}\u{200b}",
    "\u{4e16}\u{754c}",
];
