//! Adds the triangles, normals, colors and materials of meshes to a drawing.

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
use crate::work::map_indices;

/// The number of faces that one task triangulates.
const CHUNK: usize = 1 << 14;

impl<'s> Builder<'s, '_> {
    /// Adds a mesh with its lines, points and labels.
    pub(super) fn mesh(
        &mut self,
        object: &'s Object,
        mesh: &'s Mesh,
        color: Color,
    ) -> Result<(), PictureError> {
        let colorings = &self.overlays.colorings;
        let coloring = colorings.iter().find(|c| c.object == object.name);
        let normals = self.normals(mesh);
        let (colors, materials, material_of_face) = self.colors(object, mesh, color, coloring)?;
        let uvs = uvs(mesh, &materials);
        if uvs.is_empty() && materials.iter().any(|s| s.texture.is_some()) {
            let name = &object.name;
            let message = format!("\"{name}\" has textures but no texture coordinates for them");
            self.missing.push(message);
        }
        let is_per_corner = |channel: &Channel| matches!(channel, Channel::Corner(_));
        let needs_corners = !uvs.is_empty() || is_per_corner(&colors) || is_per_corner(&normals);
        let triangulation = triangulate(mesh, needs_corners);
        let n_faces = u32::try_from(mesh.domain_len(Domain::Face)).unwrap_or(u32::MAX);
        // The back of a closed surface is hidden, except for thin slivers at the outline of the surface. The slivers
        // get the color of the front.
        let has_no_back = object.materials.iter().any(|m| m.double_sided)
            || coloring.is_some()
            || (mesh.is_closed() && geometry::volume(mesh) > 0.0);
        let back = self.style.back.filter(|_| !has_no_back);
        let part = Part {
            points: points(mesh),
            triangles: triangulation.triangles,
            corners: triangulation.corners,
            faces: triangulation.faces,
            n_faces,
            normals,
            colors,
            highlights: self.face_highlights(object, mesh),
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

    /// Returns normals for the shading that the style sets.
    fn normals(&self, mesh: &'s Mesh) -> Channel<'s> {
        let is_flat = matches!(self.style.shading, Shading::Flat | Shading::Plain);
        if is_flat {
            let is_triangles = mesh.first_non_triangle().is_none();
            if is_triangles {
                return Channel::All([0.0; 3]);
            }
            Channel::Face(normals::of_faces(mesh, self.radius).into())
        } else if let Some(normals) = mesh.get(CORNER_NORMAL) {
            Channel::Corner(normals::narrowed(normals).into())
        } else if let Some(normals) = mesh.get(VERTEX_NORMAL) {
            Channel::Point(normals::narrowed(normals).into())
        } else {
            normals::smooth(mesh, self.radius, self.style.sharp)
        }
    }

    /// Returns the colors of a mesh, the surfaces for its materials, and the index of the surface of each face.
    fn colors(
        &mut self,
        object: &Object,
        mesh: &Mesh,
        color: Color,
        coloring: Option<&Coloring>,
    ) -> Result<(Channel<'s>, Vec<Surface>, Vec<u32>), PictureError> {
        let plain = vec![Surface::default()];
        let default = rgb(color.linear());
        if let Some(c) = coloring {
            let mapped = map_indices(c.values.len(), |i| c.map.linear(c.values[i], c.range));
            let channel = match c.domain {
                Domain::Vertex => Channel::Point(mapped.into()),
                Domain::Corner => Channel::Corner(mapped.into()),
                Domain::Face => Channel::Face(mapped.into()),
                Domain::Edge => Channel::All([0.75; 3]),
            };
            return Ok((channel, plain, Vec::new()));
        }
        if self.style.color.is_some() {
            return Ok((Channel::All(default), plain, Vec::new()));
        }
        let vertex_colors = mesh.get(COLOR).map(|colors| {
            let narrowed = colors.iter().map(|c| c.truncate().to_array().map(narrow));
            Channel::Point(narrowed.collect::<Vec<_>>().into())
        });
        if object.materials.is_empty() {
            let colors = vertex_colors.unwrap_or(Channel::All(default));
            return Ok((colors, plain, Vec::new()));
        }
        let materials = object.materials.iter();
        let surfaces = materials.map(|m| self.surface(m));
        let mut surfaces = surfaces.collect::<Result<Vec<_>, _>>()?;
        // The last entry of `surfaces` is for faces without a material.
        let none = u32::try_from(surfaces.len()).unwrap_or(u32::MAX);
        let [r, g, b] = if vertex_colors.is_some() {
            [1.0; 3]
        } else {
            default
        };
        surfaces.push(Surface {
            color: [r, g, b, 1.0],
            ..Surface::default()
        });
        let index = |m: &i32| u32::try_from(*m).map_or(none, |m| m.min(none));
        let surface_of_face = mesh.get(MATERIAL).map_or_else(
            || vec![none; mesh.domain_len(Domain::Face)],
            |materials| materials.iter().map(index).collect(),
        );
        let colors = vertex_colors.unwrap_or(Channel::All([1.0; 3]));
        Ok((colors, surfaces, surface_of_face))
    }

    /// Returns the highlight color of each face; empty if no faces are highlighted.
    fn face_highlights(&self, object: &Object, mesh: &Mesh) -> Vec<[f32; 4]> {
        let mut colors = Vec::new();
        let highlights = self.overlays.highlights.iter();
        for highlight in highlights.filter(|h| h.object == object.name) {
            let Elements::Faces(faces) = &highlight.elements else {
                continue;
            };
            colors.resize(mesh.domain_len(Domain::Face), [0.0; 4]);
            for f in faces.iter().filter(|&&f| mesh.has_face(f)) {
                colors[f.index()] = highlight.color.linear();
            }
        }
        colors
    }
}

/// Returns a linear color without its alpha.
pub(super) fn rgb([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b]
}

/// Returns the positions of vertices by index. Deleted vertices get the position of an existing vertex.
fn points(mesh: &Mesh) -> Cow<'_, [DVec3]> {
    let Some(first) = mesh.vertices().next() else {
        return Cow::Borrowed(&[]);
    };
    if mesh.is_dense() {
        return Cow::Borrowed(mesh.positions());
    }
    let position = |i| {
        let v = VertexId::new(i);
        mesh.position(if mesh.has_vertex(v) { v } else { first })
    };
    Cow::Owned((0..mesh.positions().len()).map(position).collect())
}

/// Returns the sets of texture coordinates, up to the last set that a surface needs. The result is empty if a needed
/// set is missing.
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

/// The triangles of a mesh. The fields have the same meaning as in [`Part`].
#[derive(Default)]
struct Triangulation {
    triangles: Vec<[u32; 3]>,
    corners: Vec<[u32; 3]>,
    faces: Vec<u32>,
}

/// Triangulates the faces of a mesh. The faces can be concave.
fn triangulate(mesh: &Mesh, with_corners: bool) -> Triangulation {
    let n = mesh.domain_len(Domain::Face);
    // If the mesh has no deleted elements and all faces are triangles, each triangle has the index of its face.
    let is_simple = mesh.is_dense() && 3 * mesh.n_faces() == n_corners(mesh);
    if is_simple {
        return triangles_of(mesh, with_corners);
    }
    let chunks: Vec<Triangulation> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut triangulation = Triangulation::default();
            triangulation.triangles.reserve(CHUNK);
            let mut cutter = Cutter::default();
            let mut half_edges = Vec::new();
            for i in chunk * CHUNK..n.min((chunk + 1) * CHUNK) {
                let f = FaceId::new(i);
                if !mesh.has_face(f) {
                    continue;
                }
                half_edges.clear();
                half_edges.extend(mesh.face_half_edges(f));
                let index = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
                let mut add = |corners: [usize; 3]| {
                    let corners = corners.map(|c| half_edges[c]);
                    let points = corners.map(|h: HalfEdgeId| index(mesh.origin(h).index()));
                    triangulation.triangles.push(points);
                    if with_corners {
                        triangulation
                            .corners
                            .push(corners.map(|h| index(h.index())));
                    }
                    triangulation.faces.push(index(i));
                };
                if half_edges.len() == 3 {
                    add([0, 1, 2]);
                } else {
                    let cut = cutter.cut(mesh, f);
                    for triangle in cut.triangles() {
                        add(triangle.map(|c| c as usize));
                    }
                }
            }
            triangulation
        })
        .collect();
    let mut all = Triangulation::default();
    all.triangles
        .reserve(chunks.iter().map(|c| c.triangles.len()).sum());
    for chunk in chunks {
        all.triangles.extend(chunk.triangles);
        all.corners.extend(chunk.corners);
        all.faces.extend(chunk.faces);
    }
    all
}

/// Returns the triangles of a mesh without deleted elements, in which all faces are triangles.
fn triangles_of(mesh: &Mesh, with_corners: bool) -> Triangulation {
    let half_edges = |i: usize| {
        let h = mesh.face_half_edge(FaceId::new(i));
        [h, mesh.next(h), mesh.next(mesh.next(h))]
    };
    let index = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
    let n_corners = if with_corners { mesh.n_faces() } else { 0 };
    Triangulation {
        triangles: map_indices(mesh.n_faces(), |i| {
            half_edges(i).map(|h| index(mesh.origin(h).index()))
        }),
        corners: map_indices(n_corners, |i| half_edges(i).map(|h| index(h.index()))),
        faces: Vec::new(),
    }
}

/// Returns the number of corners of all faces of a mesh without deleted elements.
fn n_corners(mesh: &Mesh) -> usize {
    let faces = &mesh.connectivity().face;
    faces.par_iter().filter(|f| f.some().is_some()).count()
}
