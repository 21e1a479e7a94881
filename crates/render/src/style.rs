//! How a picture looks: what a recipe can say about it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::narrow;
use crate::raster::Look;
use crate::{Color, PictureError};

/// How light falls on surfaces.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Shading {
    /// Each face has one shade.
    Flat,
    /// Shades change smoothly over edges that are not sharp; by the normals of corners or vertices, if there
    /// are any.
    #[default]
    Smooth,
    /// Smooth, with highlights.
    Phong,
    /// Like a ball of clay in a studio, wherever the surface has the same normal.
    Matcap,
    /// No light at all: the colors as they are.
    Plain,
}

/// What is behind everything.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Background {
    /// White.
    #[default]
    White,
    /// Nothing: the picture can be laid over others.
    Transparent,
    /// This color.
    Plain(Color),
}

/// Lines on a surface.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lines {
    /// Their width in pixels.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub width: f64,
    /// Their color.
    pub color: Color,
    /// How much of them is seen where a surface is before them, from 0 (nothing) to 1.
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

/// How a picture looks.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Style {
    /// How light falls on surfaces.
    pub shading: Shading,
    /// Where surfaces have no normals of their own, edges with at least this angle between their faces look
    /// sharp, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub sharp: f64,
    /// How dark hollows are, from 0 (no darker) to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub occlusion: f64,
    /// What is behind everything.
    pub background: Background,
    /// The color of all surfaces, in place of those that the scene has.
    pub color: Option<Color>,
    /// The color of the backs of faces, which show where a mesh is open or turned inside out.
    pub back: Option<Color>,
    /// The edges of meshes: thinner where they are only some pixels apart, so that the surface is seen.
    pub wireframe: Option<Lines>,
    /// Edges with a face on one side only.
    pub boundary: Option<Lines>,
    /// Edges with a crease: the sharper the wider, up to twice the width.
    pub creases: Option<Lines>,
    /// Normals of vertices as short lines: their length as a fraction of the size of the scene.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub normals: Option<f64>,
    /// Dots on all vertices of meshes and all points of polylines: their diameter in pixels.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub points: Option<f64>,
    /// The control nets of Bezier patches and the control polygons of curves.
    pub control_nets: Option<Lines>,
    /// Elements that have their numbers written beside them; only on small meshes.
    pub ids: Option<Ids>,
    /// The width of curves and polylines in pixels.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub curve_width: f64,
}

/// Elements that can have their numbers written beside them.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Ids {
    /// Vertices.
    Vertices,
    /// Faces.
    Faces,
}

impl Background {
    /// Red, green, blue and alpha, in sRGB.
    pub fn srgb(self) -> [u8; 4] {
        match self {
            Self::White => [255; 4],
            Self::Transparent => [0; 4],
            Self::Plain(color) => color.0,
        }
    }
}

impl Style {
    /// Whether all numbers are in their ranges.
    ///
    /// # Errors
    ///
    /// [`PictureError::Style`] with the first that is not.
    pub fn check(&self) -> Result<(), PictureError> {
        let mut numbers = vec![
            ("sharp", self.sharp, 180.0),
            ("occlusion", self.occlusion, 1.0),
            ("curve_width", self.curve_width, 100.0),
        ];
        numbers.extend(self.normals.map(|n| ("normals", n, 1.0)));
        numbers.extend(self.points.map(|n| ("points", n, 100.0)));
        let kinds = [
            self.wireframe,
            self.boundary,
            self.creases,
            self.control_nets,
        ];
        for lines in kinds.into_iter().flatten() {
            numbers.extend([("width", lines.width, 100.0), ("hidden", lines.hidden, 1.0)]);
        }
        match numbers
            .into_iter()
            .find(|&(_, n, most)| !(0.0..=most).contains(&n))
        {
            None => Ok(()),
            Some((name, n, most)) => {
                let message = format!("expected `{name}` from 0 to {most}, found {n}");
                Err(PictureError::Style(message))
            }
        }
    }

    /// How a drawing in this style is drawn.
    pub fn look(&self) -> Look {
        Look {
            shading: self.shading,
            occlusion: narrow(self.occlusion),
            background: Color(self.background.srgb()).linear(),
        }
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
