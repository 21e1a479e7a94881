//! From a scene to a drawing.

mod edges;
mod mesh_part;
mod normals;
mod others;
mod surface;

use ::mesh::{EdgeId, FaceId, VertexId};
use glam::DVec3;
use scene::{Geometry, Scene};

use crate::PictureError;
use crate::color::Color;
use crate::colormap::ColorMap;
use crate::drawing::{Drawing, Label};
use crate::style::Style;

/// What is shown beside the surfaces themselves.
#[derive(Clone, Debug, Default)]
pub struct Overlays {
    /// Elements in colors of their own. What comes later lies on top.
    pub highlights: Vec<Highlight>,
    /// Numbers as colors, at most one for each object.
    pub colorings: Vec<Coloring>,
    /// Lines and dots that belong to no element. They lie on top of everything.
    pub strokes: Vec<Stroke>,
    /// Texts at places.
    pub labels: Vec<Label>,
}

/// A line through points, or a dot.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The points, in scene units. One makes a dot. They must be finite.
    pub points: Vec<DVec3>,
    /// Its color.
    pub color: Color,
    /// Its width, or the diameter of the dot, in pixels.
    pub width: f64,
    /// How much of it is seen where a surface is before it, from 0 to 1.
    pub hidden: f64,
}

impl Overlays {
    /// Whether all objects that are named are meshes of the scene, and have as many elements as there are numbers.
    fn check(&self, scene: &Scene) -> Result<(), PictureError> {
        let mesh = |name: &str| match scene.object(name).map(|o| &o.geometry) {
            Some(Geometry::Mesh(mesh)) => Ok(mesh),
            other => {
                let found = other.map_or("nothing of this name", Geometry::kind);
                Err(PictureError::Style(format!(
                    "expected a mesh \"{name}\" to show elements of, found {found}"
                )))
            }
        };
        for highlight in &self.highlights {
            mesh(&highlight.object)?;
        }
        for c in &self.colorings {
            let (expected, found) = (mesh(&c.object)?.domain_len(c.domain), c.values.len());
            if expected != found {
                return Err(PictureError::Style(format!(
                    "expected {expected} numbers, one for each {} of \"{}\", found {found}",
                    c.domain, c.object
                )));
            }
        }
        Ok(())
    }
}

/// Elements of an object in a color of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Highlight {
    /// The name of the object, which is a mesh.
    pub object: String,
    /// The elements. What the mesh does not have is left out.
    pub elements: Elements,
    /// Their color.
    pub color: Color,
    /// The diameter of vertices and the width of edges, in pixels.
    pub size: f64,
    /// How much of edges is seen where a surface is before them, and of the rings that vertices are there, from 0
    /// to 1.
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

/// Numbers on an object, shown as colors.
#[derive(Clone, Debug, PartialEq)]
pub struct Coloring {
    /// The name of the object, which is a mesh.
    pub object: String,
    /// What the numbers belong to. Those of edges become colored lines.
    pub domain: ::mesh::Domain,
    /// One for each element, by index; not a number where there is none.
    pub values: Vec<f64>,
    /// How they become colors.
    pub map: ColorMap,
    /// The numbers at the two ends of the map.
    pub range: [f64; 2],
}

/// The colors of objects that have none, one after another.
pub const PALETTE: [Color; 6] = [
    Color::rgb(0xa9, 0xc1, 0xe2),
    Color::rgb(0xe8, 0xc3, 0x8a),
    Color::rgb(0xa9, 0xcf, 0xa5),
    Color::rgb(0xd8, 0xa7, 0xc6),
    Color::rgb(0xa0, 0xd0, 0xd0),
    Color::rgb(0xd6, 0xd0, 0xb0),
];

/// Makes a drawing of a scene. `images` gives the bytes of a picture file for its path in a material; where it
/// gives none, or they are no PNG or JPEG, the surface is drawn without, and the path is in the list that is
/// returned, with the reason. Of a material its base color with its texture, roughness, emission and alpha are
/// drawn; the alpha of textures is not.
///
/// # Errors
///
/// [`PictureError::Style`] if a number of the style is out of its range, or an overlay does not fit its object.
pub fn build<'s>(
    scene: &'s Scene,
    style: &Style,
    overlays: &Overlays,
    images: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(Drawing<'s>, Vec<String>), PictureError> {
    style.check()?;
    overlays.check(scene)?;
    let mut builder = Builder {
        style,
        overlays,
        images,
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

struct Builder<'s, 'a> {
    style: &'a Style,
    overlays: &'a Overlays,
    images: &'a mut dyn FnMut(&str) -> Option<Vec<u8>>,
    missing: Vec<String>,
    drawing: Drawing<'s>,
    /// How many faces the parts before have.
    n_faces: u32,
    /// Of the sphere around the meshes of the scene.
    radius: f64,
}

/// The middle and the radius of a sphere around everything in a scene, in scene units; the radius is not 0, also of
/// one point. `None` if there is nothing.
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
