//! What the rasteriser draws: triangles, lines, points and the places of labels. Nothing here knows meshes
//! or styles.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::texture::Texture;

/// Values that belong to all of a [`Part`], or to its faces, points or corners.
#[derive(Clone, Debug)]
pub enum Channel<'a> {
    /// One value for everything.
    All([f32; 3]),
    /// A value for each face.
    Face(Cow<'a, [[f32; 3]]>),
    /// A value for each point, mixed inside triangles.
    Point(Cow<'a, [[f32; 3]]>),
    /// A value for each corner, mixed inside triangles.
    Corner(Cow<'a, [[f32; 3]]>),
}

/// Triangles that share their points.
#[derive(Clone, Debug)]
pub struct Part<'a> {
    /// The points, in scene units. They must be finite.
    pub points: Cow<'a, [DVec3]>,
    /// The points of each triangle, counter-clockwise seen from its front.
    pub triangles: Vec<[u32; 3]>,
    /// The corners of each triangle, if there are values of corners; else empty.
    pub corners: Vec<[u32; 3]>,
    /// The face that each triangle is a part of, rising; empty if each triangle is a face.
    pub faces: Vec<u32>,
    /// How many faces there are.
    pub n_faces: u32,
    /// Normals, of any length. A zero stands for that of the triangle.
    pub normals: Channel<'a>,
    /// Linear red, green and blue of the front, from 0 to 1. Multiplied with that of the material.
    pub colors: Channel<'a>,
    /// Faces with a color of their own: in place of everything else, on both sides. Its alpha says how much
    /// of it there is. Empty, or one for each face.
    pub marks: Vec<[f32; 4]>,
    /// The materials.
    pub materials: Vec<Surface>,
    /// The place in `materials` of each face's; empty if all have the first.
    pub material_of_face: Vec<u32>,
    /// Texture coordinates of corners with v upwards; for the textures of materials.
    pub uvs: Vec<Cow<'a, [DVec2]>>,
    /// What the color of the front is replaced by on the back of faces; `None` for the same.
    pub back: Option<[f32; 3]>,
}

/// How faces look.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Linear red, green, blue and alpha, from 0 to 1. So many of the samples are covered as alpha says.
    pub color: [f32; 4],
    /// Multiplies the color, alpha as well.
    pub texture: Option<Arc<Texture>>,
    /// Which texture coordinates of the part.
    pub uv_set: usize,
    /// Whether the color is shown without light.
    pub unlit: bool,
    /// From 0 (a mirror) to 1 (matt): how wide highlights are.
    pub roughness: f32,
    /// Light that it gives off.
    pub emissive: [f32; 3],
}

impl Default for Surface {
    fn default() -> Self {
        Self {
            color: [1.0; 4],
            texture: None,
            uv_set: 0,
            unlit: false,
            roughness: 1.0,
            emissive: [0.0; 3],
        }
    }
}

impl Surface {
    /// Whether it hides less than half of what is behind it, or has holes.
    pub(crate) fn is_see_through(&self) -> bool {
        self.color[3] < 0.5 || self.texture.as_ref().is_some_and(|t| !t.is_opaque())
    }
}

/// A line with round ends, or a round point if both ends are one.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Its ends, in scene units. They must be finite.
    pub ends: [DVec3; 2],
    /// In pixels.
    pub width: f32,
    /// Linear red, green, blue and alpha.
    pub color: [f32; 4],
    /// The faces beside it, counted over all parts, on which it is always seen; [`NO_FACE`] for none.
    pub faces: [u32; 2],
    /// How much of it is seen where something is before it, from 0 to 1. A point is a ring there.
    pub hidden: f32,
    /// How far apart lines like it are, in scene units; infinite if it is not one of many. It is thinner where many of
    /// them would cover the surface.
    pub room: f64,
}

/// Stands where there is no face.
pub const NO_FACE: u32 = u32::MAX;

/// A text at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Where it belongs, in scene units.
    pub at: DVec3,
    /// What it says.
    pub text: String,
}

/// Everything that is drawn.
#[derive(Clone, Debug, Default)]
pub struct Drawing<'a> {
    /// Triangles. All of them together are numbered in this order, as are the faces.
    pub parts: Vec<Part<'a>>,
    /// Lines and points: what comes later lies on top.
    pub lines: Vec<Line>,
    /// Labels. The rasteriser only says where they are and whether something is before them.
    pub labels: Vec<Label>,
}

impl Part<'_> {
    /// The face of a triangle.
    pub fn face(&self, triangle: usize) -> usize {
        self.faces.get(triangle).map_or(triangle, |&f| f as usize)
    }

    /// The positions of the points of a triangle.
    pub fn corners_at(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|p| self.points[p as usize])
    }
}

impl Drawing<'_> {
    /// How many triangles there are.
    pub fn n_triangles(&self) -> usize {
        self.parts.iter().map(|p| p.triangles.len()).sum()
    }

    /// Calls `each` with all points, and the ends of all lines.
    pub fn each_point(&self, each: &mut dyn FnMut(DVec3)) {
        for part in &self.parts {
            part.points.iter().for_each(|&p| each(p));
        }
        for line in &self.lines {
            line.ends.into_iter().for_each(&mut *each);
        }
    }

    /// Whether there is nothing to draw but labels.
    pub fn is_empty(&self) -> bool {
        self.n_triangles() == 0 && self.lines.is_empty()
    }
}

impl Channel<'_> {
    /// The value at a place in a triangle of `part` with these barycentric coordinates.
    pub(crate) fn at(&self, part: &Part, triangle: usize, [u, v, w]: [f32; 3]) -> [f32; 3] {
        let (values, places) = match self {
            Self::All(value) => return *value,
            Self::Face(values) => return values[part.face(triangle)],
            Self::Point(values) => (values, part.triangles[triangle]),
            Self::Corner(values) => (values, part.corners[triangle]),
        };
        let [a, b, c] = places.map(|p| values[p as usize]);
        std::array::from_fn(|i| a[i] * u + b[i] * v + c[i] * w)
    }
}
