//! Computes vertex normals: first a vector for each face, then a weighted sum around each vertex.

use mesh::{DVec3, FaceId, Mesh, VertexId, angle_between, area_vector, parallel};

use crate::vertex_normals::Weight;

/// A [`Sum`] of face vectors counts as zero if the largest coordinate of `sum` is at most this fraction of the largest
/// coordinate of `magnitude`. A sum below this limit is only rounding error.
const CANCELLED: f64 = 1e-14;

/// Returns the unit normal of every vertex, and the number of vertices without a normal. The mesh must be dense, that
/// is, have no gaps left by removed elements. Vertices without a normal get the zero vector.
///
/// The faces are added in their order around the vertex, so the result is the same for any number of threads. Positions
/// are scaled by a power of two, so the result does not depend on the size of the mesh.
pub fn normals(mesh: &Mesh, weight: Weight) -> (Vec<DVec3>, usize) {
    let scale = scale(mesh);
    let face_vectors: Vec<DVec3> = parallel::collect(mesh.n_faces(), |f| {
        let corners = mesh.face_vertices(FaceId::new(f));
        let area = area_vector(corners.map(|v| scale * mesh.position(v)));
        match weight {
            Weight::Area => area,
            Weight::Angle | Weight::Uniform => area.normalize_or_zero(),
        }
    });
    let normals: Vec<DVec3> = parallel::collect(mesh.n_vertices(), |v| {
        let v = VertexId::new(v);
        match weight {
            Weight::Area | Weight::Uniform => summed(mesh, v, &face_vectors),
            Weight::Angle => summed_by_angle(mesh, v, &face_vectors, scale),
        }
    });
    let without = parallel::count(normals.len(), |v| normals[v] == DVec3::ZERO);
    (normals, without)
}

/// A sum of vectors, and the sum of the magnitudes of their coordinates. The sum of the magnitudes gives a bound for
/// the rounding error of the sum of the vectors.
#[derive(Clone, Copy, Default)]
struct Sum {
    sum: DVec3,
    magnitude: DVec3,
}

impl Sum {
    fn add(self, part: DVec3) -> Self {
        Self {
            sum: self.sum + part,
            magnitude: self.magnitude + part.abs(),
        }
    }

    fn direction(self) -> DVec3 {
        if self.sum.abs().max_element() <= CANCELLED * self.magnitude.max_element() {
            DVec3::ZERO
        } else {
            self.sum.normalize_or_zero()
        }
    }
}

fn summed(mesh: &Mesh, v: VertexId, face_vectors: &[DVec3]) -> DVec3 {
    mesh.vertex_faces(v)
        .fold(Sum::default(), |sum, f| sum.add(face_vectors[f.index()]))
        .direction()
}

fn summed_by_angle(mesh: &Mesh, v: VertexId, face_vectors: &[DVec3], scale: f64) -> DVec3 {
    let p = scale * mesh.position(v);
    let side = |w| scale * mesh.position(w) - p;
    // The half-edges that start at the vertex are in clockwise order. The face of a half-edge therefore lies between
    // this half-edge and the previous one.
    let last = mesh.vertex_neighbors(v).last().map_or(DVec3::ZERO, side);
    let (sum, _) = mesh
        .vertex_half_edges(v)
        .fold((Sum::default(), last), |(sum, before), h| {
            let along = side(mesh.target(h));
            let sum = match mesh.face(h) {
                Some(f) => sum.add(angle_between(along, before) * face_vectors[f.index()]),
                None => sum,
            };
            (sum, along)
        });
    sum.direction()
}

/// Returns a power of two that scales the extent of the mesh to about 1. Multiplying by a power of two causes no
/// rounding error, so the normals do not change. In the scaled mesh, products of lengths neither overflow nor
/// underflow.
fn scale(mesh: &Mesh) -> f64 {
    let [min, max] = geometry::bounds(mesh).unwrap_or_default();
    // The coordinates are halved before the subtraction, because the difference of two finite numbers can be infinite.
    let extent = (0.5 * max - 0.5 * min).max_element();
    if extent == 0.0 {
        return 1.0;
    }
    let exponent = extent.to_bits() >> 52;
    f64::from_bits(2046_u64.saturating_sub(exponent).max(1) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_a_power_of_two_that_brings_the_extent_near_one() {
        for size in [f64::MIN_POSITIVE / 8.0, 1e-300, 0.3, 1.0, 1e10, f64::MAX] {
            let mut mesh = geometry::shapes::square();
            mesh.positions_mut().iter_mut().for_each(|p| *p *= size);
            let scale = scale(&mesh);
            assert_eq!(scale.to_bits() << 12, 0, "a power of two");
            let extent = scale * size;
            assert!(
                (0.1..=16.0).contains(&extent) || size < 1e-307,
                "{size} {extent}"
            );
        }
    }
}
