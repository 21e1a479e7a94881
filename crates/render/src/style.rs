//! The style of a picture, as recipes write it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::narrow;
use crate::{Color, PictureError};

/// The lighting of surfaces.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Shading {
    /// Each face has one shade.
    Flat,
    /// Shades change smoothly across edges that are not sharp. If the mesh stores normals at its corners or vertices,
    /// these normals determine the shades.
    #[default]
    Smooth,
    /// Like `Smooth`, with specular highlights.
    Phong,
    /// Like clay in a studio: the shade depends only on the direction of the normal as seen from the camera.
    Matcap,
    /// No lighting: the colors are unchanged.
    Plain,
}

/// The background.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Background {
    /// White.
    #[default]
    White,
    /// Transparent, so that the picture can be placed over other images.
    Transparent,
    /// One color for the whole background.
    Plain(Color),
}

/// How lines on a surface are drawn.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lines {
    /// The width in pixels.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub width: f64,
    /// The color.
    pub color: Color,
    /// The opacity of the parts of lines that lie behind a surface, from 0 (invisible) to 1 (opaque).
    #[schemars(range(min = 0.0, max = 1.0))]
    pub hidden: f64,
}

impl Default for Lines {
    fn default() -> Self {
        Self {
            width: 1.0,
            color: Color([28, 34, 48, 200]),
            hidden: 0.0,
        }
    }
}

/// The style of a picture.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Style {
    /// The lighting of surfaces.
    pub shading: Shading,
    /// An edge is shaded as sharp if the normals of its two faces differ by at least this angle, in degrees. This angle
    /// has no effect if the mesh stores normals or smoothing groups.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub sharp: f64,
    /// The strength of ambient occlusion, which darkens hollows, from 0 (none) to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub occlusion: f64,
    /// The background.
    pub background: Background,
    /// The color of all surfaces. If omitted, surfaces have the colors of the scene.
    pub color: Option<Color>,
    /// The color of the back of faces. The back is visible where a mesh is open or inside out.
    pub back: Option<Color>,
    /// Draws the edges of meshes, and grid lines on Bezier patches. Lines that are only a few pixels apart are drawn
    /// thinner, so that they do not cover the surface.
    pub wireframe: Option<Lines>,
    /// Draws the boundary edges of meshes.
    pub boundary: Option<Lines>,
    /// Draws crease edges. The width of a crease grows with its sharpness, up to twice `width`.
    pub creases: Option<Lines>,
    /// Draws vertex normals as short lines. The value is the length of the lines, as a fraction of the radius of the
    /// bounding sphere of the scene.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub normals: Option<f64>,
    /// Draws dots at all vertices of meshes and all points of polylines. The value is the diameter of the dots in
    /// pixels.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub points: Option<f64>,
    /// Draws the control nets of Bezier patches and the control polygons of curves.
    pub control_nets: Option<Lines>,
    /// Labels vertices or faces with their ids. Fails if a mesh has more than 2000 of these elements.
    pub ids: Option<Ids>,
    /// The width of curves and polylines in pixels.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub curve_width: f64,
}

/// The elements that are labeled with their ids.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Ids {
    /// Vertices.
    Vertices,
    /// Faces.
    Faces,
}

impl Background {
    /// Returns red, green, blue and alpha, in sRGB.
    pub fn srgb(self) -> [u8; 4] {
        match self {
            Self::White => [255; 4],
            Self::Transparent => [0; 4],
            Self::Plain(color) => color.0,
        }
    }
}

impl Style {
    /// Checks that all numbers are in their ranges.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Style`] if a number is out of its range. The error contains the name of the first such
    /// number.
    pub fn check(&self) -> Result<(), PictureError> {
        let mut numbers = vec![
            ("sharp", self.sharp, 180.0),
            ("occlusion", self.occlusion, 1.0),
            ("curve_width", self.curve_width, 100.0),
        ];
        numbers.extend(self.normals.map(|n| ("normals", n, 1.0)));
        numbers.extend(self.points.map(|n| ("points", n, 100.0)));
        let all_lines = [
            self.wireframe,
            self.boundary,
            self.creases,
            self.control_nets,
        ];
        for lines in all_lines.into_iter().flatten() {
            numbers.extend([("width", lines.width, 100.0), ("hidden", lines.hidden, 1.0)]);
        }
        match numbers
            .into_iter()
            .find(|&(_, n, max)| !(0.0..=max).contains(&n))
        {
            None => Ok(()),
            Some((name, n, max)) => {
                let message = format!("expected `{name}` from 0 to {max}, found {n}");
                Err(PictureError::Style(message))
            }
        }
    }

    /// Returns the settings of this style that the rasterizer uses.
    pub fn look(&self) -> Look {
        Look {
            shading: self.shading,
            occlusion: narrow(self.occlusion),
            background: Color(self.background.srgb()).linear(),
        }
    }
}

/// The settings of a style that the rasterizer uses.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// The lighting of surfaces.
    pub shading: Shading,
    /// The strength of ambient occlusion, from 0 (none) to 1.
    pub occlusion: f32,
    /// Linear red, green, blue and alpha of the background.
    pub background: [f32; 4],
}

impl Look {
    /// Whether ambient occlusion is computed.
    pub(crate) fn has_occlusion(&self) -> bool {
        self.occlusion > 0.0 && self.shading != Shading::Plain
    }
}

impl Default for Style {
    fn default() -> Self {
        Self {
            shading: Shading::default(),
            sharp: 40.0,
            occlusion: 0.8,
            background: Background::default(),
            color: None,
            back: Some(Color::rgb(0xd9, 0xa0, 0x82)),
            wireframe: None,
            boundary: None,
            creases: None,
            normals: None,
            points: None,
            control_nets: None,
            ids: None,
            curve_width: 2.5,
        }
    }
}
