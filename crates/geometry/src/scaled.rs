//! Converts meshes to a unit of length in which products of lengths neither overflow nor underflow.

use std::borrow::Cow;

use mesh::{DVec3, Mesh};

use crate::laplacian::{exponent, scaled};

/// A mesh is not scaled if its largest absolute coordinate is at least 2^-n and below 2^n, where n is this number.
const ORDINARY: i32 = 64;

/// A mesh, scaled by a power of two if its coordinates are very small or very large.
///
/// Computations of areas and curvatures, and comparisons of distances, contain products of up to four lengths. If the
/// lengths are about 1e-90 or 1e90 scene units, a product of four lengths is rounded to 0 or to infinity. Scaling by a
/// power of two changes only the exponents of the numbers, so it causes no rounding errors.
#[derive(Clone, Debug)]
pub struct Scaled<'a> {
    mesh: Cow<'a, Mesh>,
    /// One unit of length of the scaled mesh is 2^n scene units, where n is this number.
    exponent: i32,
}

impl<'a> Scaled<'a> {
    /// Scales a mesh if its coordinates are very small or very large. The scaled mesh has no attributes.
    pub fn new(mesh: &'a Mesh) -> Self {
        Self::by(mesh, ordinary(exponent(mesh.positions())))
    }

    /// Scales two meshes by the same power of two if the coordinates of the larger mesh are very small or very large.
    pub fn pair(a: &'a Mesh, b: &'a Mesh) -> [Self; 2] {
        let larger = |mesh: &Mesh| {
            let is_point = mesh.positions().iter().all(|p| *p == DVec3::ZERO);
            (!is_point).then(|| exponent(mesh.positions()))
        };
        let exponent = ordinary(larger(a).max(larger(b)).unwrap_or(0));
        [Self::by(a, exponent), Self::by(b, exponent)]
    }

    fn by(mesh: &'a Mesh, exponent: i32) -> Self {
        if exponent == 0 {
            return Self {
                mesh: Cow::Borrowed(mesh),
                exponent,
            };
        }
        let positions = mesh.positions().iter().map(|&p| scaled(p, -exponent));
        let mesh = Mesh::from_arrays(mesh.connectivity().clone(), positions.collect());
        Self {
            mesh: Cow::Owned(mesh),
            exponent,
        }
    }

    /// Returns the scaled mesh, or the original mesh if no scaling was necessary.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Converts a length from scene units to the unit of the scaled mesh.
    pub fn scaled(&self, length: f64) -> f64 {
        libm::scalbn(length, -self.exponent)
    }

    /// Converts a quantity of the scaled mesh to scene units. The dimension is the exponent of the length in the unit:
    /// 1 for a length, 2 for an area and -1 for a curvature. If the exact result is outside of the range of `f64`, the
    /// result is infinite or not exact.
    pub fn restored(&self, quantity: f64, dimension: i32) -> f64 {
        libm::scalbn(quantity, dimension * self.exponent)
    }

    /// Converts a point of the scaled mesh to scene units.
    pub fn restored_point(&self, p: DVec3) -> DVec3 {
        scaled(p, self.exponent)
    }
}

/// Returns the number n for a mesh with coordinates up to about 2^`exponent`; the coordinates of the mesh are divided
/// by 2^n. The result is `exponent`, or 0 if the mesh needs no scaling.
fn ordinary(exponent: i32) -> i32 {
    if (-ORDINARY..ORDINARY).contains(&exponent) {
        0
    } else {
        exponent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::{Distance, vertex_distances};
    use crate::{shapes, thickness};
    use progress::NoProgress;

    fn times(mesh: &Mesh, exponent: i32) -> Mesh {
        let mut mesh = mesh.clone();
        for p in mesh.positions_mut() {
            *p = scaled(*p, exponent);
        }
        mesh
    }

    #[test]
    fn measures_of_very_small_and_very_large_meshes_scale_exactly() {
        let torus = shapes::torus(12, 8, 2.0, 0.5);
        let near = shapes::torus(10, 6, 2.1, 0.6);
        let each = |mesh: &Mesh, near: &Mesh| -> Vec<(i32, Vec<f64>)> {
            let distance = Distance::between(mesh, near, None).unwrap();
            let principal = crate::principal_curvatures(mesh).into_iter().flatten();
            vec![
                (2, vec![crate::area(mesh)]),
                (-1, crate::mean_curvatures(mesh)),
                (-2, crate::gaussian_curvatures(mesh)),
                (-1, principal.collect()),
                (0, mesh.faces().map(|f| crate::min_angle(mesh, f)).collect()),
                (1, thickness(mesh, &NoProgress).unwrap()),
                (0, crate::occlusion(mesh, 16, 0, &NoProgress).unwrap()),
                (1, vertex_distances(mesh, near).unwrap()),
                (
                    1,
                    vec![distance.largest(), distance.at_most(), distance.mean()],
                ),
                (1, distance.worst().from.position.to_array().to_vec()),
                (1, distance.worst().to.position.to_array().to_vec()),
                (
                    1,
                    crate::samples(mesh, 20, 3, &NoProgress)
                        .unwrap()
                        .iter()
                        .flat_map(|s| s.position.to_array())
                        .collect(),
                ),
            ]
        };
        let expected = each(&torus, &near);
        for k in [-500, -300, 300, 500] {
            let found = each(&times(&torus, k), &times(&near, k));
            for (i, ((dimension, a), (_, b))) in expected.iter().zip(found).enumerate() {
                let a: Vec<f64> = a.iter().map(|x| libm::scalbn(*x, dimension * k)).collect();
                assert_eq!(a, b, "quantity {i}, factor 2^{k}");
            }
        }
        for k in [-300, 300] {
            let expected = libm::scalbn(crate::volume(&torus), 3 * k);
            assert_eq!(crate::volume(&times(&torus, k)), expected);
        }
    }

    #[test]
    fn a_mesh_at_the_origin_does_not_choose_the_scale_of_a_pair() {
        let point = times(&shapes::square(), -2000);
        let large = times(&shapes::square(), 500);
        let [a, b] = Scaled::pair(&point, &large);
        assert_eq!((a.exponent, b.exponent), (500, 500));
    }
}
