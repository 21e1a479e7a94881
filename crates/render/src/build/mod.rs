//! Converts a scene to a drawing.

mod curves;
mod edges;
mod mesh_part;
mod normals;
mod surface;

use ::mesh::{EdgeId, FaceId, VertexId};
use glam::DVec3;
use scene::{Geometry, Scene};

use crate::PictureError;
use crate::color::Color;
use crate::colormap::ColorMap;
use crate::drawing::{Drawing, Label, Line};
use crate::style::Style;
use crate::texture::TextureCache;

/// Elements and texts that a picture shows in addition to the objects of a scene.
#[derive(Clone, Debug, Default)]
pub struct Overlays {
    /// Highlighted elements. Later highlights are drawn on top.
    pub highlights: Vec<Highlight>,
    /// Colorings: numbers of mesh elements, shown as colors. Each object can have at most one coloring.
    pub colorings: Vec<Coloring>,
    /// Lines and dots that do not belong to an element of a mesh. Strokes are drawn on top of all other lines and dots.
    pub strokes: Vec<Stroke>,
    /// Labels at points of the scene.
    pub labels: Vec<Label>,
}

/// A line through points, or a dot.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The points, in scene units. A single point is drawn as a dot. All points must be finite.
    pub points: Vec<DVec3>,
    /// The color.
    pub color: Color,
    /// The width of the line, or the diameter of the dot, in pixels.
    pub width: f64,
    /// The opacity where a surface hides the line or dot, from 0 to 1.
    pub hidden: f64,
}

impl Overlays {
    /// Checks that the objects of highlights and colorings are meshes of the scene, and that each coloring has one
    /// number for each element.
    fn check(&self, scene: &Scene) -> Result<(), PictureError> {
        let mesh = |name: &str| match scene.object(name).map(|o| &o.geometry) {
            Some(Geometry::Mesh(mesh)) => Ok(mesh),
            Some(geometry) => Err(PictureError::Style(format!(
                "expected object \"{name}\" to be a mesh, found {}",
                geometry.kind()
            ))),
            None => Err(PictureError::Style(format!(
                "expected a mesh named \"{name}\", found no object of this name"
            ))),
        };
        for highlight in &self.highlights {
            mesh(&highlight.object)?;
        }
        for c in &self.colorings {
            let (expected, found) = (mesh(&c.object)?.domain_len(c.domain), c.values.len());
            if expected != found {
                return Err(PictureError::Style(format!(
                    "expected {expected} numbers, one for each {domain} of \"{object}\", found {found} numbers",
                    domain = c.domain,
                    object = c.object
                )));
            }
        }
        Ok(())
    }
}

/// Elements of a mesh that are drawn in a highlight color.
#[derive(Clone, Debug, PartialEq)]
pub struct Highlight {
    /// The name of the object. The object must be a mesh.
    pub object: String,
    /// The elements. Ids of elements that the mesh does not have are ignored.
    pub elements: Elements,
    /// The color.
    pub color: Color,
    /// The diameter of vertices and the width of edges, in pixels.
    pub size: f64,
    /// The opacity of edges and vertices where a surface hides them, from 0 to 1. Hidden vertices are drawn as rings.
    pub hidden: f64,
}

/// Elements of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Elements {
    /// Vertices.
    Vertices(Vec<VertexId>),
    /// Edges.
    Edges(Vec<EdgeId>),
    /// Faces.
    Faces(Vec<FaceId>),
}

/// One number for each element of a mesh, shown as a color: for example, the curvature at each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Coloring {
    /// The name of the object. The object must be a mesh.
    pub object: String,
    /// The elements that have values. Values of edges are shown as colored lines.
    pub domain: ::mesh::Domain,
    /// One number for each element, by index. The number is NaN if the element has no value.
    pub values: Vec<f64>,
    /// The color map.
    pub map: ColorMap,
    /// The numbers that the first and the last color of the color map represent.
    pub range: [f64; 2],
}

/// The default colors of objects, in the order of the objects in the scene. The colors repeat after the last one.
pub const PALETTE: [Color; 6] = [
    Color::rgb(0xa9, 0xc1, 0xe2),
    Color::rgb(0xe8, 0xc3, 0x8a),
    Color::rgb(0xa9, 0xcf, 0xa5),
    Color::rgb(0xd8, 0xa7, 0xc6),
    Color::rgb(0xa0, 0xd0, 0xd0),
    Color::rgb(0xd6, 0xd0, 0xb0),
];

/// Converts a scene to a drawing. Returns the drawing, and a message for each texture that cannot be drawn.
///
/// `images` is called with the path of an image file, as written in a material, and returns the bytes of this file. A
/// texture cannot be drawn if `images` returns `None` or the bytes are not a PNG or JPEG file. Then the surface is
/// drawn without this texture, and a message gives the path and the reason.
///
/// The drawing uses these parts of each material: the base color and alpha with their texture, the roughness, the
/// emission, `unlit`, and `double_sided`.
///
/// # Errors
///
/// Returns [`PictureError::Style`] if a number of the style is out of its range or an overlay does not match its
/// object. Returns the same error if a mesh has too many elements for labels, or Bezier patches cannot be tessellated.
pub fn build<'s>(
    scene: &'s Scene,
    style: &Style,
    overlays: &Overlays,
    images: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(Drawing<'s>, Vec<String>), PictureError> {
    let textures = &mut TextureCache::default();
    build_within(scene, style, overlays, u64::MAX, textures, images)
}

/// Like [`build()`], but with a memory budget in bytes. Textures that are already in `textures` are not decoded again.
/// All other textures are decoded and added to `textures`.
///
/// # Errors
///
/// Returns [`PictureError::Budget`] if the triangles and lines, or the textures, certainly exceed the budget. The size
/// of the triangles and lines is checked before anything is allocated, and the size of each texture before the texture
/// is decoded. Also returns the errors of [`build()`].
pub fn build_within<'s>(
    scene: &'s Scene,
    style: &Style,
    overlays: &Overlays,
    budget: u64,
    textures: &mut TextureCache,
    images: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(Drawing<'s>, Vec<String>), PictureError> {
    style.check()?;
    overlays.check(scene)?;
    PictureError::check_budget(min_bytes(scene, style), budget)?;
    let mut builder = Builder {
        style,
        overlays,
        textures,
        images,
        budget,
        texture_bytes: 0,
        missing: Vec::new(),
        drawing: Drawing::default(),
        n_faces: 0,
        radius: extent(scene).map_or(1.0, |(_, radius)| radius),
    };
    for (i, object) in scene.objects().iter().enumerate() {
        let color = style.color.unwrap_or(PALETTE[i % PALETTE.len()]);
        match &object.geometry {
            Geometry::Mesh(mesh) => builder.mesh(object, mesh, color)?,
            Geometry::Patches(patches) => builder.patches(patches, color)?,
            Geometry::Curve(curve) => builder.curve(curve, color),
            Geometry::Polylines(lines) => builder.polylines(lines, color),
        }
    }
    for stroke in &overlays.strokes {
        builder.stroke(stroke);
    }
    builder
        .drawing
        .labels
        .extend(overlays.labels.iter().cloned());
    Ok((builder.drawing, builder.missing))
}

/// Returns the minimum number of bytes that the drawing of a scene takes. Only meshes are counted.
fn min_bytes(scene: &Scene, style: &Style) -> u64 {
    let meshes = scene.objects().iter().filter_map(|object| object.as_mesh());
    let bytes = meshes.map(|mesh| {
        let n_lines = style.wireframe.as_ref().map_or(0, |_| mesh.n_edges());
        size_of::<[u32; 3]>() * mesh.n_faces() + size_of::<Line>() * n_lines
    });
    bytes.sum::<usize>() as u64
}

struct Builder<'s, 'a> {
    style: &'a Style,
    overlays: &'a Overlays,
    textures: &'a mut TextureCache,
    images: &'a mut dyn FnMut(&str) -> Option<Vec<u8>>,
    /// The memory budget in bytes.
    budget: u64,
    /// The number of bytes of all textures that have been decoded so far.
    texture_bytes: u64,
    missing: Vec<String>,
    drawing: Drawing<'s>,
    /// The number of faces in all parts that have been added so far.
    n_faces: u32,
    /// The radius of the sphere around the scene.
    radius: f64,
}

/// Returns the center and the radius of a sphere around the scene, in scene units. The radius is never 0, even for a
/// single point. Returns `None` if the scene has no points.
pub fn extent(scene: &Scene) -> Option<(DVec3, f64)> {
    let mut corners: Vec<DVec3> = Vec::new();
    for object in scene.objects() {
        match &object.geometry {
            Geometry::Mesh(mesh) => corners.extend(geometry::bounds(mesh).into_iter().flatten()),
            Geometry::Patches(patches) => {
                corners.extend(patches.iter().flat_map(|p| p.points().as_flattened()));
            }
            Geometry::Curve(curve) => corners.extend(curve.points().iter().map(|p| p.extend(0.0))),
            Geometry::Polylines(lines) => corners.extend(lines.iter().flatten()),
        }
    }
    let each = |f: &mut dyn FnMut(DVec3)| corners.iter().for_each(|&p| f(p));
    (!corners.is_empty()).then(|| crate::camera::sphere(&each))
}
