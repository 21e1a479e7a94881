//! Deformations: closed-form formulas for the new position of a point, and weights and directions for moving vertices.
//!
//! | items | contents |
//! | --- | --- |
//! | [`Bend`], [`Twist`], [`Taper`] | maps of space along an axis: Barr, "Global and Local Deformations of Solid Primitives", 1984 |
//! | [`Lattice`] | a box of control points: Sederberg, Parry, 1986 |
//! | [`falloff`] | weights that decrease with the distance from selected vertices |
//! | [`noise`] | numbers that look random and are identical on every machine |
//! | [`vertex_directions`] | unit normals along which vertices move |

mod barr;
mod falloff;
mod lattice;
pub mod noise;

use mesh::{DVec3, Domain, Mesh, VertexId, parallel};

pub use barr::{Bend, Frame, Taper, Twist};
pub use falloff::falloff;
pub use lattice::Lattice;

/// Returns a unit normal for each vertex index: the direction of the sum of the area vectors of the faces around the
/// vertex. The result is zero for dead (removed) vertices, and for vertices at which the area vectors of the faces add
/// up to zero.
pub fn vertex_directions(mesh: &Mesh) -> Vec<DVec3> {
    let exponent = crate::laplacian::exponent(mesh.positions());
    let area_vectors: Vec<DVec3> = mesh.at_faces(|f| {
        let corners = mesh
            .face_vertices(f)
            .map(|v| crate::laplacian::scaled(mesh.position(v), -exponent));
        let first = corners.clone().next().unwrap_or_default();
        let next = corners.clone().cycle().skip(1);
        let terms = corners.zip(next).map(|(p, q)| (p - first).cross(q - first));
        terms.sum()
    });
    let direction = |v| {
        let v = VertexId::new(v);
        if !mesh.has_vertex(v) {
            return DVec3::ZERO;
        }
        let (mut sum, mut size) = (DVec3::ZERO, 0.0);
        for vector in mesh.vertex_faces(v).map(|f| area_vectors[f.index()]) {
            sum += vector;
            size += vector.length();
        }
        // If the area vectors almost cancel each other, their exact sum is possibly zero, and the computed sum is only
        // a rounding error.
        if sum.length() > 1e-14 * size {
            sum.normalize_or_zero()
        } else {
            DVec3::ZERO
        }
    };
    parallel::collect(mesh.domain_len(Domain::Vertex), direction)
}

#[cfg(test)]
mod tests;
