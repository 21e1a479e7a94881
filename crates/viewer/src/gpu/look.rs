//! The appearance of a scene.

use render::{Color, Shading};
use view::ColorBy;

/// The lines of surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wireframe {
    /// No lines.
    None,
    /// Lines on top of the shaded surface.
    #[default]
    Shaded,
    /// Lines only. The surface is not visible, but it hides the lines behind it.
    HiddenLine,
    /// Lines only, including the lines behind the surface.
    Lines,
}

/// The appearance of a scene.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "the switches are independent"
)]
pub struct Look {
    /// The lighting.
    pub shading: Shading,
    /// The lines of surfaces.
    pub wireframe: Wireframe,
    /// Whether boundary edges are drawn.
    pub boundary: bool,
    /// Whether creases are drawn.
    pub creases: bool,
    /// Whether the seams of texture coordinates are drawn.
    pub seams: bool,
    /// Whether vertex normals are drawn.
    pub normals: bool,
    /// Whether vertices are drawn.
    pub vertices: bool,
    /// Whether control nets of patches and control polygons of curves are drawn.
    pub control_nets: bool,
    /// Whether a grid is drawn on the ground.
    pub grid: bool,
    /// The numbers that are shown as colors.
    pub color_by: Option<ColorBy>,
    /// Whether the background is dark.
    pub is_dark: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            shading: Shading::Smooth,
            wireframe: Wireframe::default(),
            boundary: true,
            creases: true,
            seams: false,
            normals: false,
            vertices: false,
            control_nets: true,
            grid: true,
            color_by: None,
            is_dark: true,
        }
    }
}

impl Look {
    /// Shows numbers as colors, without the edges, which would cover the colors. With `None`, shows the colors of the
    /// materials and the edges again.
    pub(crate) fn set_color_by(&mut self, color_by: Option<ColorBy>) {
        let (before, after) = if color_by.is_some() {
            (Wireframe::Shaded, Wireframe::None)
        } else {
            (Wireframe::None, Wireframe::Shaded)
        };
        if self.color_by.is_some() != color_by.is_some() && self.wireframe == before {
            self.wireframe = after;
        }
        self.color_by = color_by;
    }

    /// Returns the colors at the bottom and at the top of the background, in sRGB.
    pub fn background(&self) -> [Color; 2] {
        if self.is_dark {
            [Color::rgb(0x1b, 0x1f, 0x27), Color::rgb(0x33, 0x3a, 0x47)]
        } else {
            [Color::rgb(0xe4, 0xe8, 0xee), Color::rgb(0xfb, 0xfc, 0xfd)]
        }
    }

    /// Returns the color of the wireframe.
    pub(super) fn wire(&self) -> [f32; 4] {
        let on_surface = Color([22, 28, 42, 125]);
        let color = match (self.wireframe, self.is_dark) {
            (Wireframe::HiddenLine | Wireframe::Lines, true) => Color([196, 206, 222, 235]),
            (Wireframe::HiddenLine | Wireframe::Lines, false) => Color([30, 38, 54, 235]),
            _ => on_surface,
        };
        color.linear()
    }
}
