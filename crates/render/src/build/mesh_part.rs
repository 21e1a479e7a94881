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

use super::{Builder, Coloring, Elements, fits, normals};
use crate::PictureError;
use crate::color::{Color, narrow};
use crate::drawing::{Channel, Normals, Part, Surface};
use crate::style::Shading;

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
        if let Some(coloring) = coloring {
            fits(object, mesh, coloring)?;
        }
        let normals = self.normals(mesh);
        let (colors, materials, material_of_face) = self.colors(object, mesh, color, coloring);
        let uvs = uvs(mesh, &materials);
        if uvs.is_empty() && materials.iter().any(|s| s.texture.is_some()) {
            let why = format!("{}: no texture coordinates for its textures", object.name);
            self.missing.push(why);
        }
        let is_by_corner =
            |normals: &Normals| matches!(normals, Normals::Given(Channel::Corner(_)));
        let needs_corners =
            !uvs.is_empty() || matches!(colors, Channel::Corner(_)) || is_by_corner(&normals);
        let Cut {
            triangles,
            corners,
            faces,
        } = cut(mesh, needs_corners);
        let n_faces = u32::try_from(mesh.domain_len(Domain::Face)).unwrap_or(u32::MAX);
        // A closed surface has no back to be seen, but for slivers at its outline.
        let has_no_back = object.materials.iter().any(|m| m.double_sided)
            || coloring.is_some()
            || (mesh.is_closed() && geometry::volume(mesh) > 0.0);
        let back = self.style.back.filter(|_| !has_no_back);
        let part = Part {
            points: points(mesh),
            triangles,
            corners,
            faces,
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

    fn normals(&self, mesh: &'s Mesh) -> Normals<'s> {
        let is_flat = matches!(self.style.shading, Shading::Flat | Shading::Plain);
        if is_flat {
            let is_triangles = mesh.faces().all(|f| mesh.is_triangle(f));
            return if is_triangles {
                Normals::Triangle
            } else {
                let areas = normals::of_faces(mesh, self.radius);
                Normals::Given(Channel::Face(areas.into()))
            };
        }
        if let Some(given) = mesh.get(CORNER_NORMAL) {
            Normals::Given(Channel::Corner(normals::narrowed(given).into()))
        } else if let Some(given) = mesh.get(VERTEX_NORMAL) {
            Normals::Given(Channel::Point(normals::narrowed(given).into()))
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
    ) -> (Channel<'s, [f32; 3]>, Vec<Surface>, Vec<u32>) {
        let plain = vec![Surface::default()];
        let usual = rgb(color.linear());
        if let Some(c) = coloring {
            let mapped: Vec<[f32; 3]> = c
                .values
                .par_iter()
                .with_min_len(4096)
                .map(|&value| c.map.linear(value, c.range))
                .collect();
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
            return (
                of_vertices.unwrap_or(Channel::All(usual)),
                plain,
                Vec::new(),
            );
        }
        let mut surfaces: Vec<Surface> = Vec::new();
        for material in &object.materials {
            let surface = self.surface(material);
            surfaces.push(surface);
        }
        // For faces without a material.
        let none = surfaces.len();
        let [r, g, b] = usual;
        surfaces.push(Surface {
            color: if of_vertices.is_some() {
                [1.0; 4]
            } else {
                [r, g, b, 1.0]
            },
            ..Surface::default()
        });
        let place = |m: &i32| usize::try_from(*m).map_or(none, |m| m.min(none));
        let of_face = mesh.get(MATERIAL).map_or_else(
            || vec![none; mesh.domain_len(Domain::Face)],
            |materials| materials.iter().map(place).collect(),
        );
        let of_face = of_face.into_iter().map(|m| u32::try_from(m).unwrap_or(0));
        let colors = of_vertices.unwrap_or(Channel::All([1.0; 3]));
        (colors, surfaces, of_face.collect())
    }

    /// Highlighted faces.
    fn marks(&self, object: &Object, mesh: &Mesh) -> Vec<[f32; 4]> {
        let mut marks = Vec::new();
        for highlight in &self.overlays.highlights {
            let Elements::Faces(faces) = &highlight.elements else {
                continue;
            };
            if highlight.object != object.name {
                continue;
            }
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
    let set = |name| mesh.get(Attribute::<HalfEdgeId, DVec2>::new(name, Rule::Interpolate));
    let sets = names.into_iter().take(last + 1).map(set);
    sets.collect::<Option<Vec<_>>>()
        .map_or_else(Vec::new, |sets| {
            sets.into_iter().map(Cow::Borrowed).collect()
        })
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
