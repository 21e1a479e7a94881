//! Computes the tangents for normal maps with the `MikkTSpace` algorithm.
//!
//! ```text
//!        v  b = w n x t             t: tangent, along u
//!        ^                          b: bitangent, along v
//!        |                          n: normal, towards the reader
//!        n----> u  t                w: 1, or -1 if the texture is mirrored
//! ```
//!
//! Source: Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008. Most tools that bake or render normal maps use
//! `MikkTSpace`, because a normal map gives correct shading only with the tangents for which the map was made.

use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use mesh::{CORNER_NORMAL, DVec2, DVec3, DVec4, HalfEdgeId, Mesh, VERTEX_NORMAL};

use crate::triangulate::Cutter;

/// The tangents of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangents {
    /// For each half-edge with a face, the unit tangent of its corner and the sign of the bitangent, 1 or -1. For
    /// half-edges without a face, the value is zero.
    pub values: Vec<DVec4>,
    /// The number of corners at which the texture coordinates define no direction, for example because all corners of
    /// the triangle have the same texture coordinates. The tangents of these corners are arbitrary unit vectors
    /// perpendicular to the normals.
    pub n_arbitrary: usize,
}

/// Computes the tangents of a dense mesh from texture coordinates and normals. `uvs` has the texture coordinates of
/// each half-edge. The texture coordinate v points upwards. The normals are the corner normals of the mesh. If the mesh
/// has no corner normals, its vertex normals are used. Returns `None` if the mesh has no normals.
///
/// The computation uses 32-bit floating-point numbers. Polygons are cut into the same triangles as in exported glTF
/// files. Two corners share a tangent under three conditions. They have the same position, normal and texture
/// coordinates; their faces are connected; and the texture is mirrored on both faces or on neither of them.
pub fn tangents(mesh: &Mesh, uvs: &[DVec2]) -> Option<Tangents> {
    let normals = match (mesh.get(CORNER_NORMAL), mesh.get(VERTEX_NORMAL)) {
        (Some(normals), _) => Normals::Corners(normals),
        (_, Some(normals)) => Normals::Vertices(normals),
        (None, None) => return None,
    };
    let mut corners = Corners {
        mesh,
        uvs,
        normals,
        triangles: triangles(mesh),
        found: vec![None; mesh.n_half_edges()],
    };
    // The error type of `generate_tangents` is an empty enum, so this call never fails.
    let Ok(()) = generate_tangents(&mut corners) else {
        return None;
    };
    let mut values = vec![DVec4::ZERO; mesh.n_half_edges()];
    let mut n_arbitrary = 0;
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            let normal = corners.unit_normal(h);
            let found = corners.found[h.index()].map(|t| DVec4::from(t.map(f64::from)));
            let good = found.filter(|t| is_tangent(*t, normal));
            n_arbitrary += usize::from(good.is_none());
            values[h.index()] = good.unwrap_or_else(|| normal.any_orthonormal_vector().extend(1.0));
        }
    }
    Some(Tangents {
        values,
        n_arbitrary,
    })
}

/// Whether a tangent is a unit vector perpendicular to the normal.
fn is_tangent(tangent: DVec4, normal: DVec3) -> bool {
    const ROUNDING: f64 = 1e-3;
    let direction = tangent.truncate();
    (direction.length_squared() - 1.0).abs() < ROUNDING && direction.dot(normal).abs() < ROUNDING
}

/// Returns the corners of the triangles of all faces, in the order of the faces. Polygons are triangulated.
pub(crate) fn triangles(mesh: &Mesh) -> Vec<[HalfEdgeId; 3]> {
    let mut cutter = Cutter::default();
    let mut triangles = Vec::with_capacity(mesh.n_faces());
    let mut corners = Vec::new();
    for f in mesh.faces() {
        corners.clear();
        corners.extend(mesh.face_half_edges(f));
        if let &[a, b, c] = corners.as_slice() {
            triangles.push([a, b, c]);
            continue;
        }
        let cut = cutter.cut(mesh, f);
        let cut = cut.triangles().iter();
        triangles.extend(cut.map(|triangle| triangle.map(|k| corners[k as usize])));
    }
    triangles
}

enum Normals<'a> {
    Corners(&'a [DVec3]),
    Vertices(&'a [DVec3]),
}

/// The input and output of `MikkTSpace`: the corners of a mesh that the algorithm reads, and the tangents that it
/// writes.
struct Corners<'a> {
    mesh: &'a Mesh,
    uvs: &'a [DVec2],
    normals: Normals<'a>,
    triangles: Vec<[HalfEdgeId; 3]>,
    found: Vec<Option<[f32; 4]>>,
}

impl Corners<'_> {
    /// Returns the unit normal of the corner of `h`. If the stored normal is zero, returns the normal of the face.
    fn unit_normal(&self, h: HalfEdgeId) -> DVec3 {
        let normal = match self.normals {
            Normals::Corners(normals) => normals[h.index()],
            Normals::Vertices(normals) => normals[self.mesh.origin(h).index()],
        };
        let of_face = || {
            let face = self.mesh.face(h)?;
            self.mesh.area_vector(face).try_normalize()
        };
        normal.try_normalize().or_else(of_face).unwrap_or(DVec3::Z)
    }
}

impl Geometry<Libm> for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        let v = self.mesh.origin(self.triangles[face][corner]);
        self.mesh.position(v).as_vec3().to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.unit_normal(self.triangles[face][corner])
            .as_vec3()
            .to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uvs[self.triangles[face][corner].index()]
            .as_vec2()
            .to_array()
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        let found = &mut self.found[self.triangles[face][corner].index()];
        // A corner of a polygon can belong to several triangles. The first of these triangles that has a
        // tangent determines the result.
        if found.is_none() {
            *found = tangent.map(|tangent| tangent.tangent_encoded());
        }
    }
}

/// Mathematical functions that give the same results on all platforms.
struct Libm;

impl Ops for Libm {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "the algorithm uses 32-bit numbers"
    )]
    fn acos(x: f32) -> f32 {
        libm::acos(f64::from(x)) as f32
    }
}

#[cfg(test)]
mod tests;
