//! Discrete curvature at vertices.

use std::f64::consts::{PI, TAU};

use mesh::blocks::BLOCK;
use mesh::{Domain, EdgeId, Mesh, VertexId, angle_between};
use rayon::prelude::*;

/// Returns the Gaussian curvature at each vertex, by vertex index, in 1 / scene unit²: 1 / r² on a sphere of
/// radius r, 0 on a cylinder. NaN for dead vertices, for isolated vertices, and for vertices whose faces have no
/// area.
///
/// The curvature is the angle defect divided by the [vertex area](vertex_area). The angle defect is 2π (π on
/// the boundary) minus the sum of the corner angles: Meyer, Desbrun, Schröder, Barr, "Discrete
/// Differential-Geometry Operators for Triangulated 2-Manifolds", 2003. On a closed mesh of flat faces, the sum
/// of curvature times vertex area is 2π times the Euler characteristic.
pub fn gaussian_curvatures(mesh: &Mesh) -> Vec<f64> {
    at_vertices(mesh, |v| {
        let angles: f64 = mesh
            .vertex_half_edges(v)
            .filter(|&h| mesh.face(h).is_some())
            .map(|h| mesh.corner_angle(h))
            .sum();
        let full = if mesh.is_boundary_vertex(v) { PI } else { TAU };
        (full - angles) / vertex_area(mesh, v)
    })
}

/// Returns the mean curvature at each vertex, by vertex index, in 1 / scene unit: 1 / r on an outward-facing
/// sphere of radius r, 1 / (2r) on a cylinder, negative where the surface is concave. NaN for dead vertices, for
/// isolated vertices, and for vertices whose faces have no area.
///
/// Each edge contributes half of its signed dihedral angle times its length, shared equally by its two ends.
/// The sum at a vertex is divided by the [vertex area](vertex_area): Cohen-Steiner, Morvan, "Restricted
/// Delaunay Triangulations and Normal Cycle", 2003. Boundary edges contribute 0.
pub fn mean_curvatures(mesh: &Mesh) -> Vec<f64> {
    at_vertices(mesh, |v| {
        let sum: f64 = mesh
            .vertex_half_edges(v)
            .map(|h| signed_dihedral(mesh, h.edge()) * mesh.length(h))
            .sum();
        0.25 * sum / vertex_area(mesh, v)
    })
}

/// Returns the area of the surface that belongs to a vertex, in scene unit². Each face around the vertex
/// contributes its area divided by its number of corners.
pub fn vertex_area(mesh: &Mesh, v: VertexId) -> f64 {
    let faces = mesh.vertex_half_edges(v).filter_map(|h| mesh.face(h));
    #[expect(clippy::cast_precision_loss, reason = "a face has few corners")]
    let share = |f| mesh.face_area(f) / mesh.degree(f) as f64;
    faces.map(share).sum()
}

/// Returns the signed angle between the normals of the two faces at an edge, positive if the edge is convex; 0 on the
/// boundary.
fn signed_dihedral(mesh: &Mesh, e: EdgeId) -> f64 {
    let [Some(f), Some(g)] = mesh.edge_faces(e) else {
        return 0.0;
    };
    let (n, m) = (mesh.face_normal(f), mesh.face_normal(g));
    let [v, w] = mesh.edge_vertices(e).map(|v| mesh.position(v));
    // The first half of the edge runs from v to w with f to its left.
    if n.cross(m).dot(w - v) >= 0.0 {
        angle_between(n, m)
    } else {
        -angle_between(n, m)
    }
}

fn at_vertices(mesh: &Mesh, value: impl Fn(VertexId) -> f64 + Sync) -> Vec<f64> {
    let mut values = vec![f64::NAN; mesh.domain_len(Domain::Vertex)];
    values
        .par_chunks_mut(BLOCK)
        .enumerate()
        .for_each(|(b, block)| {
            for (i, slot) in block.iter_mut().enumerate() {
                let v = VertexId::new(b * BLOCK + i);
                if mesh.has_vertex(v) {
                    let value = value(v);
                    *slot = if value.is_finite() { value } else { f64::NAN };
                }
            }
        });
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    fn mean(values: &[f64]) -> f64 {
        values.iter().sum::<f64>() / f64::from(u32::try_from(values.len()).unwrap())
    }

    #[test]
    fn gauss_bonnet_holds_on_closed_meshes_of_flat_faces() {
        for mesh in [
            shapes::cube(),
            shapes::icosahedron(),
            shapes::torus(12, 8, 2.0, 0.5),
        ] {
            let curvatures = gaussian_curvatures(&mesh);
            let total: f64 = mesh
                .vertices()
                .map(|v| curvatures[v.index()] * vertex_area(&mesh, v))
                .sum();
            #[expect(clippy::cast_precision_loss, reason = "a small number")]
            let expected = TAU * mesh.euler_characteristic() as f64;
            assert!((total - expected).abs() < 1e-9, "{total} {expected}");
        }
    }

    #[test]
    fn a_sphere_has_the_curvatures_of_a_sphere() {
        let radius = 3.0;
        let mut mesh = shapes::uv_sphere(64, 32);
        let points = mesh.positions_mut();
        for p in points {
            *p *= radius;
        }
        let gauss = mean(&gaussian_curvatures(&mesh)) * radius * radius;
        let h = mean(&mean_curvatures(&mesh)) * radius;
        assert!(
            (gauss - 1.0).abs() < 0.02 && (h - 1.0).abs() < 0.02,
            "{gauss} {h}"
        );
        mesh.reverse();
        let h = mean(&mean_curvatures(&mesh)) * radius;
        assert!((h + 1.0).abs() < 0.02, "{h}");
    }

    #[test]
    fn a_torus_has_positive_curvature_outside_and_negative_inside() {
        let mesh = shapes::torus(48, 24, 2.0, 0.5);
        let gauss = gaussian_curvatures(&mesh);
        for v in mesh.vertices() {
            let ring = mesh.position(v).truncate().length();
            if (ring - 2.0).abs() > 0.1 {
                assert_eq!(gauss[v.index()] > 0.0, ring > 2.0, "{v} {ring}");
            }
        }
    }

    #[test]
    fn flat_sheets_have_zero_curvature_and_isolated_vertices_have_nan() {
        let mesh = shapes::grid(3, 3);
        let (gauss, mean) = (gaussian_curvatures(&mesh), mean_curvatures(&mesh));
        for v in mesh.vertices() {
            assert!(mean[v.index()].abs() < 1e-12);
            assert!(mesh.is_boundary_vertex(v) || gauss[v.index()].abs() < 1e-12);
        }
        let mut isolated = shapes::square();
        let face = isolated.faces().next().unwrap();
        isolated.delete_face(face).unwrap();
        assert!(gaussian_curvatures(&isolated).iter().all(|x| x.is_nan()));
    }
}
