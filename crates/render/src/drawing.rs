//! The input of the rasterizer: triangles, lines, points and label positions. The input does not depend on meshes and
//! styles.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::texture::Texture;

/// Values of a [`Part`]: one value for the whole part, or one for each face, point or corner.
#[derive(Clone, Debug)]
pub enum Channel<'a> {
    /// One value for the whole part.
    All([f32; 3]),
    /// A value for each face.
    Face(Cow<'a, [[f32; 3]]>),
    /// A value for each point, interpolated inside triangles.
    Point(Cow<'a, [[f32; 3]]>),
    /// A value for each corner, interpolated inside triangles.
    Corner(Cow<'a, [[f32; 3]]>),
}

/// Triangles that share their points.
#[derive(Clone, Debug)]
pub struct Part<'a> {
    /// The points, in scene units. They must be finite.
    pub points: Cow<'a, [DVec3]>,
    /// The indices of the points of each triangle, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle, three indices into lists that have one value for each corner, for example
    /// [`Channel::Corner`]. Empty if the part has no such list.
    pub corners: Vec<[u32; 3]>,
    /// For each triangle, the index of the face that contains it. The indices are in ascending order. The list is empty
    /// if each triangle is a face of its own.
    pub faces: Vec<u32>,
    /// The number of faces.
    pub n_faces: u32,
    /// Normals for lighting, of any length. Where a normal is zero, the normal of the triangle is used instead.
    pub normals: Channel<'a>,
    /// Linear red, green and blue of the front, from 0 to 1. The color of the front is multiplied by the color of the
    /// material.
    pub colors: Channel<'a>,
    /// The highlight color of each face; empty if there are no highlights. Highlight colors are blended over all other
    /// colors, according to the alpha of the highlight color, on both sides of the face.
    pub highlights: Vec<[f32; 4]>,
    /// The materials.
    pub materials: Vec<Surface>,
    /// The index in `materials` for each face. The list is empty if all faces have the first material.
    pub material_of_face: Vec<u32>,
    /// The sets of texture coordinates that the textures of the materials use. Each set has the coordinates (u, v) of
    /// the corners, and v points upwards.
    pub uvs: Vec<Cow<'a, [DVec2]>>,
    /// The color of the back of faces. If `None`, the back of a face has the color of the front.
    pub back: Option<[f32; 3]>,
}

/// The appearance of faces.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Linear red, green, blue and alpha, from 0 to 1. Alpha is the fraction of a pixel's samples that the surface
    /// covers.
    pub color: [f32; 4],
    /// The texture. The color, including alpha, is multiplied by the texture.
    pub texture: Option<Arc<Texture>>,
    /// The index of the set of texture coordinates in [`Part::uvs`].
    pub uv_set: usize,
    /// Whether the color is shown without lighting.
    pub unlit: bool,
    /// The width of specular highlights, from 0 (a mirror) to 1 (matte).
    pub roughness: f32,
    /// Linear red, green and blue of the emitted light.
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
    /// Whether the alpha of the surface is below one half, or the surface has a texture that is not opaque.
    pub(crate) fn is_transparent(&self) -> bool {
        self.color[3] < 0.5 || self.texture.as_ref().is_some_and(|t| !t.is_opaque())
    }
}

/// A line with round ends, or a round point if both ends are equal.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// The two ends, in scene units. They must be finite.
    pub ends: [DVec3; 2],
    /// The width in pixels.
    pub width: f32,
    /// Linear red, green, blue and alpha.
    pub color: [f32; 4],
    /// The indices of the faces beside the line. The faces beside the line never hide it. Face indices continue from
    /// part to part: the first face of a part has the index after the last face of the previous part. [`NO_FACE`] means
    /// no face.
    pub faces: [u32; 2],
    /// The opacity of the line where a surface hides it, from 0 to 1. A hidden point is drawn as a ring.
    pub hidden: f32,
    /// The approximate distance to neighboring lines of the same kind, such as other edges of a mesh, in scene units.
    /// Lines are drawn thinner where they would otherwise cover the surface between them. The distance is infinite for
    /// a line without neighbors.
    pub spacing: f64,
}

/// The face index that means "no face".
pub const NO_FACE: u32 = u32::MAX;

/// A label at a point of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The position, in scene units.
    pub at: DVec3,
    /// The string to draw.
    pub text: String,
}

/// All input of the rasterizer.
#[derive(Clone, Debug, Default)]
pub struct Drawing<'a> {
    /// The parts. Triangles and faces are numbered across all parts: the numbering continues from each part to the
    /// next.
    pub parts: Vec<Part<'a>>,
    /// Lines and points. Later entries are drawn on top of earlier entries.
    pub lines: Vec<Line>,
    /// Labels. The rasterizer does not draw labels: it only returns their positions and whether they are hidden.
    pub labels: Vec<Label>,
}

impl Part<'_> {
    /// Returns the face of a triangle.
    pub fn face(&self, triangle: usize) -> usize {
        self.faces.get(triangle).map_or(triangle, |&f| f as usize)
    }

    /// Returns the index of the surface of a triangle in [`materials`](Self::materials).
    pub(crate) fn surface_index(&self, triangle: usize) -> usize {
        let material = self.material_of_face.get(self.face(triangle));
        material.map_or(0, |&m| m as usize)
    }

    /// Returns the positions of the corners of a triangle.
    pub fn corners_at(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|p| self.points[p as usize])
    }
}

impl Drawing<'_> {
    /// Returns the number of triangles.
    pub fn n_triangles(&self) -> usize {
        self.parts.iter().map(|p| p.triangles.len()).sum()
    }

    /// Calls `each` with every point of every part, and with the two ends of every line.
    pub fn each_point(&self, each: &mut dyn FnMut(DVec3)) {
        for part in &self.parts {
            part.points.iter().for_each(|&p| each(p));
        }
        for line in &self.lines {
            line.ends.into_iter().for_each(&mut *each);
        }
    }

    /// Whether the drawing has no triangles and no lines.
    pub fn is_empty(&self) -> bool {
        self.n_triangles() == 0 && self.lines.is_empty()
    }
}

impl Channel<'_> {
    /// Returns the value at these barycentric coordinates in a triangle of `part`.
    pub(crate) fn at(&self, part: &Part, triangle: usize, [u, v, w]: [f32; 3]) -> [f32; 3] {
        let (values, indices) = match self {
            Self::All(value) => return *value,
            Self::Face(values) => return values[part.face(triangle)],
            Self::Point(values) => (values, part.triangles[triangle]),
            Self::Corner(values) => (values, part.corners[triangle]),
        };
        let [a, b, c] = indices.map(|i| values[i as usize]);
        std::array::from_fn(|i| a[i] * u + b[i] * v + c[i] * w)
    }
}
