//! Splitting vertices along seams: glTF has a vertex for each different normal, texture coordinate and
//! color around a vertex of the mesh.

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, CORNER_NORMAL, Domain, FaceId, Mesh, UV, VERTEX_NORMAL, Values, VertexId};

use super::CORNER_COLOR;
use crate::corners::Numbering;
use crate::loss::Losses;

/// For each half-edge the values of its corner as glTF has them: 32 bits, normals of length 1, v
/// downwards, colors from 0 to 1.
pub(super) struct Corners {
    pub(super) normals: Option<Vec<[f32; 3]>>,
    pub(super) uvs: Option<Vec<[f32; 2]>>,
    pub(super) colors: Option<Vec<[f32; 4]>>,
}

impl Corners {
    pub(super) fn new(mesh: &Mesh, losses: &mut Losses) -> Self {
        let corner_normals = mesh.get(CORNER_NORMAL);
        let vertex_normals = mesh.get(VERTEX_NORMAL).filter(|_| corner_normals.is_none());
        let corner_colors = mesh.get(CORNER_COLOR);
        let vertex_colors = mesh.get(COLOR).filter(|_| corner_colors.is_none());
        let uvs = mesh.get(UV);
        losses.add_columns(mesh, "glTF", |domain, column| {
            match (domain, column.name.as_str()) {
                (Domain::Corner, "uv") => uvs.is_some(),
                (Domain::Corner, "normal") => corner_normals.is_some(),
                (Domain::Vertex, "normal") => vertex_normals.is_some(),
                (Domain::Corner, "color") => corner_colors.is_some(),
                (Domain::Vertex, "color") => vertex_colors.is_some(),
                (Domain::Face, "material") => matches!(column.values, Values::Int(_)),
                _ => false,
            }
        });
        let at_corner = |h: mesh::HalfEdgeId| (h.index(), mesh.origin(h).index());
        let normal = |h: mesh::HalfEdgeId| {
            let (h, v) = at_corner(h);
            corner_normals
                .map(|n| n[h])
                .or(vertex_normals.map(|n| n[v]))
        };
        let color = |h: mesh::HalfEdgeId| {
            let (h, v) = at_corner(h);
            corner_colors.map(|c| c[h]).or(vertex_colors.map(|c| c[v]))
        };
        let mut broken = [0; 3];
        let has_normals = corner_normals.is_some() || vertex_normals.is_some();
        let normals = has_normals.then(|| {
            of_corners(mesh, |f, h| {
                unit_normal(mesh, f, normal(h).unwrap_or_default(), &mut broken[0])
            })
        });
        let uvs = uvs.map(|uvs| of_corners(mesh, |_, h| flipped(uvs[h.index()], &mut broken[1])));
        let has_colors = corner_colors.is_some() || vertex_colors.is_some();
        let colors = has_colors.then(|| {
            of_corners(mesh, |_, h| {
                unit_color(color(h).unwrap_or(DVec4::ONE), &mut broken[2])
            })
        });
        losses.add(
            Domain::Corner,
            "normal",
            broken[0],
            "without a direction: written as that of the face",
        );
        losses.add(
            Domain::Corner,
            "uv",
            broken[1],
            "not finite with 32 bits: written as 0",
        );
        losses.add(
            Domain::Corner,
            "color",
            broken[2],
            "outside of 0 to 1: written as the nearest inside",
        );
        Self {
            normals,
            uvs,
            colors,
        }
    }
}

fn of_corners<T: Copy + Default>(
    mesh: &Mesh,
    mut value: impl FnMut(FaceId, mesh::HalfEdgeId) -> T,
) -> Vec<T> {
    let mut values = vec![T::default(); mesh.n_half_edges()];
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            values[h.index()] = value(f, h);
        }
    }
    values
}

fn unit_normal(mesh: &Mesh, f: FaceId, normal: DVec3, broken: &mut usize) -> [f32; 3] {
    let unit = normal.try_normalize().unwrap_or_else(|| {
        *broken += 1;
        mesh.area_vector(f).try_normalize().unwrap_or(DVec3::Z)
    });
    unit.as_vec3().to_array()
}

fn flipped(uv: DVec2, broken: &mut usize) -> [f32; 2] {
    let flipped = DVec2::new(uv.x, 1.0 - uv.y).as_vec2();
    if flipped.is_finite() {
        return flipped.to_array();
    }
    *broken += 1;
    [0.0; 2]
}

fn unit_color(color: DVec4, broken: &mut usize) -> [f32; 4] {
    let inside = color
        .to_array()
        .map(|x| if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) });
    *broken += usize::from(inside != color.to_array());
    DVec4::from_array(inside).as_vec4().to_array()
}

// ---- Splitting along seams ---------------------------------------------------------------------

/// The vertices of glTF: one for each vertex and different values of its corners.
pub(super) struct Split {
    pub(super) vertices: Vec<SplitVertex>,
    /// For each half-edge with a face the vertex of its corner.
    pub(super) vertex_of: Vec<u32>,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) struct SplitVertex {
    pub(super) v: VertexId,
    /// Normal, texture coordinate and color as bits.
    values: [u32; 9],
}

impl SplitVertex {
    fn new(v: VertexId, normal: [f32; 3], uv: [f32; 2], color: [f32; 4]) -> Self {
        let [x, y, z] = normal.map(f32::to_bits);
        let [s, t] = uv.map(f32::to_bits);
        let [r, g, b, a] = color.map(f32::to_bits);
        Self {
            v,
            values: [x, y, z, s, t, r, g, b, a],
        }
    }

    pub(super) fn normal(&self) -> [f32; 3] {
        let [x, y, z, ..] = self.values.map(f32::from_bits);
        [x, y, z]
    }

    pub(super) fn uv(&self) -> [f32; 2] {
        let [_, _, _, s, t, ..] = self.values.map(f32::from_bits);
        [s, t]
    }

    pub(super) fn color(&self) -> [f32; 4] {
        let [.., r, g, b, a] = self.values.map(f32::from_bits);
        [r, g, b, a]
    }
}

/// Numbers the vertices of glTF by vertex of the mesh, and at each vertex in the order in which the
/// faces come, so that reading finds the vertices in their order.
pub(super) fn split(mesh: &Mesh, corners: &Corners) -> Split {
    let mut numbering = Numbering::new(mesh.n_vertices());
    let mut found = Vec::new();
    let mut vertex_of = vec![0; mesh.n_half_edges()];
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            let (v, i) = (mesh.origin(h), h.index());
            let vertex = SplitVertex::new(
                v,
                corners
                    .normals
                    .as_ref()
                    .map_or([0.0; 3], |normals| normals[i]),
                corners.uvs.as_ref().map_or([0.0; 2], |uvs| uvs[i]),
                corners.colors.as_ref().map_or([0.0; 4], |colors| colors[i]),
            );
            let (number, new) = numbering.number(v.index(), vertex);
            if new {
                found.push(vertex);
            }
            vertex_of[i] = number;
        }
    }
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by_key(|&i| found[i].v);
    let mut place_of = vec![0; found.len()];
    for (place, &i) in order.iter().enumerate() {
        place_of[i] = u32::try_from(place).unwrap_or(u32::MAX);
    }
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        let number = &mut vertex_of[h.index()];
        *number = place_of[*number as usize];
    }
    Split {
        vertices: order.into_iter().map(|i| found[i]).collect(),
        vertex_of,
    }
}
