//! Meshes: triangles, normals, colors, materials.

use std::borrow::Cow;

use ::geometry::triangulate::Cutter;
use ::mesh::{
    Attribute, COLOR, CORNER_NORMAL, DVec2, Domain, FaceId, HalfEdgeId, MATERIAL, Mesh, Rule,
    VERTEX_NORMAL, VertexId,
};
use glam::DVec3;
use rayon::prelude::*;
use scene::Object;

use super::{Builder, Coloring, Elements, normals};
use crate::PictureError;
use crate::color::{Color, narrow};
use crate::drawing::{Channel, Part, Surface};
use crate::style::Shading;
use crate::work::each;

/// Faces that one task cuts into triangles.
const CHUNK: usize = 1 << 14;

impl<'s> Builder<'s, '_> {
    /// Adds a mesh with its lines and points.
    pub(super) fn mesh(
        &mut self,
        object: &'s Object,
        mesh: &'s Mesh,
        color: Color,
    ) -> Result<(), PictureError> {
        let colorings = &self.overlays.colorings;
        let coloring = colorings.iter().find(|c| c.object == object.name);
        let normals = self.normals(mesh);
        let (colors, materials, material_of_face) = self.colors(object, mesh, color, coloring);
        let uvs = uvs(mesh, &materials);
        if uvs.is_empty() && materials.iter().any(|s| s.texture.is_some()) {
            let why = format!("{}: no texture coordinates for its textures", object.name);
            self.missing.push(why);
        }
        let is_by_corner = |channel: &Channel| matches!(channel, Channel::Corner(_));
        let needs_corners = !uvs.is_empty() || is_by_corner(&colors) || is_by_corner(&normals);
        let cut = cut(mesh, needs_corners);
        let n_faces = u32::try_from(mesh.domain_len(Domain::Face)).unwrap_or(u32::MAX);
        // A closed surface has no back to be seen, but for slivers at its outline.
        let has_no_back = object.materials.iter().any(|m| m.double_sided)
            || coloring.is_some()
            || (mesh.is_closed() && geometry::volume(mesh) > 0.0);
        let back = self.style.back.filter(|_| !has_no_back);
        let part = Part {
            points: points(mesh),
            triangles: cut.triangles,
            corners: cut.corners,
            faces: cut.faces,
            n_faces,
            normals,
            colors,
            marks: self.marks(object, mesh),
            materials,
            material_of_face,
            uvs,
            back: back.map(|c| rgb(c.linear())),
        };
        self.drawing.parts.push(part);
        self.edges(object, mesh, coloring)?;
        self.n_faces = self.n_faces.saturating_add(n_faces);
        Ok(())
    }

    fn normals(&self, mesh: &'s Mesh) -> Channel<'s> {
        let is_flat = matches!(self.style.shading, Shading::Flat | Shading::Plain);
        if is_flat {
            let is_triangles = mesh.faces().all(|f| mesh.is_triangle(f));
            if is_triangles {
                return Channel::All([0.0; 3]);
            }
            Channel::Face(normals::of_faces(mesh, self.radius).into())
        } else if let Some(given) = mesh.get(CORNER_NORMAL) {
            Channel::Corner(normals::narrowed(given).into())
        } else if let Some(given) = mesh.get(VERTEX_NORMAL) {
            Channel::Point(normals::narrowed(given).into())
        } else {
            normals::smooth(mesh, self.radius, self.style.sharp)
        }
    }

    /// Colors, surfaces, and the surface of each face.
    fn colors(
        &mut self,
        object: &Object,
        mesh: &Mesh,
        color: Color,
        coloring: Option<&Coloring>,
    ) -> (Channel<'s>, Vec<Surface>, Vec<u32>) {
        let plain = vec![Surface::default()];
        let usual = rgb(color.linear());
        if let Some(c) = coloring {
            let mapped = each(c.values.len(), |i| c.map.linear(c.values[i], c.range));
            let channel = match c.domain {
                Domain::Vertex => Channel::Point(mapped.into()),
                Domain::Corner => Channel::Corner(mapped.into()),
                Domain::Face => Channel::Face(mapped.into()),
                Domain::Edge => Channel::All([0.75; 3]),
            };
            return (channel, plain, Vec::new());
        }
        if self.style.color.is_some() {
            return (Channel::All(usual), plain, Vec::new());
        }
        let of_vertices = mesh.get(COLOR).map(|colors| {
            let narrowed = colors.iter().map(|c| c.truncate().to_array().map(narrow));
            Channel::Point(narrowed.collect::<Vec<_>>().into())
        });
        if object.materials.is_empty() {
            let colors = of_vertices.unwrap_or(Channel::All(usual));
            return (colors, plain, Vec::new());
        }
        let materials = object.materials.iter();
        let mut surfaces: Vec<Surface> = materials.map(|m| self.surface(m)).collect();
        // For faces without a material.
        let none = u32::try_from(surfaces.len()).unwrap_or(u32::MAX);
        let [r, g, b] = if of_vertices.is_some() {
            [1.0; 3]
        } else {
            usual
        };
        surfaces.push(Surface {
            color: [r, g, b, 1.0],
            ..Surface::default()
        });
        let place = |m: &i32| u32::try_from(*m).map_or(none, |m| m.min(none));
        let of_face = mesh.get(MATERIAL).map_or_else(
            || vec![none; mesh.domain_len(Domain::Face)],
            |materials| materials.iter().map(place).collect(),
        );
        let colors = of_vertices.unwrap_or(Channel::All([1.0; 3]));
        (colors, surfaces, of_face)
    }

    /// Highlighted faces.
    fn marks(&self, object: &Object, mesh: &Mesh) -> Vec<[f32; 4]> {
        let mut marks = Vec::new();
        let highlights = self.overlays.highlights.iter();
        for highlight in highlights.filter(|h| h.object == object.name) {
            let Elements::Faces(faces) = &highlight.elements else {
                continue;
            };
            marks.resize(mesh.domain_len(Domain::Face), [0.0; 4]);
            for f in faces.iter().filter(|&&f| mesh.has_face(f)) {
                marks[f.index()] = highlight.color.linear();
            }
        }
        marks
    }
}

/// A linear color without its alpha.
pub(super) fn rgb([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b]
}

/// The points of a mesh. Vertices that are not there lie where another one is.
fn points(mesh: &Mesh) -> Cow<'_, [DVec3]> {
    let Some(first) = mesh.vertices().next() else {
        return Cow::Borrowed(&[]);
    };
    if mesh.is_dense() {
        return Cow::Borrowed(mesh.positions());
    }
    let place = |i| {
        let v = VertexId::new(i);
        mesh.position(if mesh.has_vertex(v) { v } else { first })
    };
    Cow::Owned((0..mesh.positions().len()).map(place).collect())
}

/// The sets of texture coordinates up to the last that a surface needs; none if one is missing.
fn uvs<'s>(mesh: &'s Mesh, surfaces: &[Surface]) -> Vec<Cow<'s, [DVec2]>> {
    let textured = surfaces.iter().filter(|s| s.texture.is_some());
    let Some(last) = textured.map(|s| s.uv_set).max() else {
        return Vec::new();
    };
    let names = ["uv", "uv1", "uv2", "uv3"];
    let set = |name| {
        let uvs = Attribute::<HalfEdgeId, DVec2>::new(name, Rule::Interpolate);
        mesh.get(uvs).map(Cow::Borrowed)
    };
    let sets: Option<_> = names.into_iter().take(last + 1).map(set).collect();
    sets.unwrap_or_default()
}

/// The triangles of a mesh.
#[derive(Default)]
struct Cut {
    triangles: Vec<[u32; 3]>,
    corners: Vec<[u32; 3]>,
    faces: Vec<u32>,
}

/// Cuts the faces of a mesh into triangles, which also concave ones can be cut into.
fn cut(mesh: &Mesh, with_corners: bool) -> Cut {
    let n = mesh.domain_len(Domain::Face);
    let is_simple = mesh.is_dense() && 3 * mesh.n_faces() == n_corners(mesh);
    let chunks: Vec<Cut> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut cut = Cut::default();
            cut.triangles.reserve(CHUNK);
            let mut cutter = Cutter::default();
            let mut around = Vec::new();
            for i in chunk * CHUNK..n.min((chunk + 1) * CHUNK) {
                let f = FaceId::new(i);
                if !mesh.has_face(f) {
                    continue;
                }
                around.clear();
                around.extend(mesh.face_half_edges(f));
                let place = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
                let mut add = |[a, b, c]: [usize; 3]| {
                    let three = [around[a], around[b], around[c]];
                    let points = three.map(|h: HalfEdgeId| place(mesh.origin(h).index()));
                    cut.triangles.push(points);
                    if with_corners {
                        cut.corners.push(three.map(|h| place(h.index())));
                    }
                    if !is_simple {
                        cut.faces.push(place(i));
                    }
                };
                if around.len() == 3 {
                    add([0, 1, 2]);
                } else {
                    let how = cutter.cut(mesh, f);
                    for triangle in how.triangles() {
                        add(triangle.map(|c| c as usize));
                    }
                }
            }
            cut
        })
        .collect();
    let mut all = Cut::default();
    all.triangles
        .reserve(chunks.iter().map(|c| c.triangles.len()).sum());
    for chunk in chunks {
        all.triangles.extend(chunk.triangles);
        all.corners.extend(chunk.corners);
        all.faces.extend(chunk.faces);
    }
    all
}

/// How many corners all faces have, in a dense mesh.
fn n_corners(mesh: &Mesh) -> usize {
    let faces = &mesh.connectivity().face;
    faces.par_iter().filter(|f| f.some().is_some()).count()
}
