//! Draws scenes with the graphics card.
//!
//! ```text
//!   scene --render::build--> drawing --geometry--> buffers --shader.wgsl--> texture --egui--> window
//! ```
//!
//! [`Painter`] keeps the buffers of each object. An object is converted and uploaded again only if its geometry or the
//! [`Look`] changes. Meshes are compared by address. The picture depends only on the scene, the look, the overlay and
//! the camera, not on earlier pictures.

mod device;
mod geometry;
mod grid;
mod look;
mod objects;
mod painter;
mod patch;
mod pipelines;
mod target;
mod textures;

use glam::DVec3;

pub use device::can_draw;
pub use geometry::LineInstance;
pub use grid::axis_color;
pub use look::{Look, Wireframe};
pub use painter::Painter;

/// Elements that are drawn on top of the scene, in scene coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// Lines and dots. Later lines are drawn on top.
    pub lines: Vec<OverlayLine>,
    /// Triangles with an sRGB color and opacity.
    pub triangles: Vec<([DVec3; 3], [u8; 4])>,
}

/// A line, or a dot if both ends are equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverlayLine {
    /// The ends.
    pub ends: [DVec3; 2],
    /// The width of the line or the diameter of the dot, in logical pixels.
    pub width: f32,
    /// The opacity where a surface hides the line.
    pub hidden: f32,
    /// sRGB color and opacity.
    pub color: [u8; 4],
}
