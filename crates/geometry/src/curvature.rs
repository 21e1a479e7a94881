//! Discrete curvature at vertices.

use std::f64::consts::{PI, TAU};

use mesh::parallel;
use mesh::{DVec3, Domain, EdgeId, Mesh, VertexId, angle_between};

use crate::Scaled;

/// Returns the Gaussian curvature at each vertex. Entry i belongs to the vertex with the index i; the unit is 1 / scene
/// unit². The curvature is 1 / r² on a sphere of radius r, and 0 on a cylinder. The value is NaN for dead (removed)
/// vertices, for isolated vertices, and for vertices whose faces all have zero area.
///
/// The curvature is the angle defect divided by the [vertex area](vertex_areas). The angle defect of a vertex is 2π
/// minus the sum of the angles of the faces at the vertex; for a boundary vertex, it is π minus this sum. Source:
/// Meyer, Desbrun, Schröder, Barr, "Discrete Differential-Geometry Operators for Triangulated 2-Manifolds", 2003. On a
/// closed mesh of flat faces, the angle defects of all vertices add up to 2π times the Euler characteristic.
pub fn gaussian_curvatures(mesh: &Mesh) -> Vec<f64> {
    let scaled = Scaled::new(mesh);
    let mesh = scaled.mesh();
    let areas = vertex_areas(mesh);
    at_vertices(&scaled, -2, |v| {
        let angles: f64 = mesh
            .vertex_half_edges(v)
            .filter(|&h| mesh.face(h).is_some())
            .map(|h| mesh.corner_angle(h))
            .sum();
        let full = if mesh.is_boundary_vertex(v) { PI } else { TAU };
        (full - angles) / areas[v.index()]
    })
}

/// Returns the mean curvature at each vertex. Entry i belongs to the vertex with the index i; the unit is 1 / scene
/// unit. If the faces point outward, the curvature is 1 / r on a sphere of radius r and 1 / (2r) on a cylinder. The
/// curvature is negative where the surface is concave. The value is NaN for dead (removed) vertices, for isolated
/// vertices, and for vertices whose faces all have zero area.
///
/// The signed dihedral angle of an edge is the angle between the normals of its two faces, positive if the edge is
/// convex. The contribution of an edge is half the product of its signed dihedral angle and its length. Each of the two
/// ends of the edge gets half of this contribution. The sum of the contributions at a vertex is divided by the [vertex
/// area](vertex_areas). Source: Cohen-Steiner, Morvan, "Restricted Delaunay Triangulations and Normal Cycle", 2003.
/// Boundary edges contribute 0.
pub fn mean_curvatures(mesh: &Mesh) -> Vec<f64> {
    let scaled = Scaled::new(mesh);
    let mesh = scaled.mesh();
    let (areas, normals) = (vertex_areas(mesh), mesh.face_normals());
    at_vertices(&scaled, -1, |v| {
        let sum: f64 = mesh
            .vertex_half_edges(v)
            .map(|h| signed_dihedral(mesh, &normals, h.edge()) * mesh.length(h))
            .sum();
        0.25 * sum / areas[v.index()]
    })
}

/// Returns the two principal curvatures at each vertex, the smaller one first. Entry i belongs to the vertex with the
/// index i; the unit is 1 / scene unit. On an outward-facing sphere of radius r, both principal curvatures are 1 / r.
/// On an outward-facing cylinder of radius r, the principal curvatures are 0 and 1 / r. The values are NaN where the
/// [mean curvature](mean_curvatures) is NaN.
///
/// The principal curvatures are the eigenvalues of a 2 x 2 curvature tensor in the tangent plane of the vertex. This
/// plane is perpendicular to the sum of the area vectors of the faces around the vertex. Each edge at the vertex adds ½
/// θ l u uᵀ to the tensor. Here θ is the signed dihedral angle of the edge, l is the length of the edge, and u is the
/// unit vector along the edge. The sum over all edges at the vertex is divided by the [vertex area](vertex_areas).
/// Source: Cohen-Steiner, Morvan, "Restricted Delaunay Triangulations and Normal Cycle", 2003. Where the surface is
/// nearly flat around the vertex, the mean of the principal curvatures is close to the mean curvature.
pub fn principal_curvatures(mesh: &Mesh) -> Vec<[f64; 2]> {
    let none = [f64::NAN; 2];
    let scaled = Scaled::new(mesh);
    let mesh = scaled.mesh();
    let (areas, normals) = (vertex_areas(mesh), mesh.face_normals());
    let area_vectors = mesh.area_vectors();
    fill_vertices(mesh, none, |v| {
        let faces = mesh.vertex_half_edges(v).filter_map(|h| mesh.face(h));
        let normal: DVec3 = faces.map(|f| area_vectors[f.index()]).sum();
        let normal = normal.normalize_or(DVec3::Z);
        let (a, b) = normal.any_orthonormal_pair();
        // The entries of the tensor in the basis a, b. The rows of the tensor are (aa, ab) and (ab, bb).
        let [mut aa, mut ab, mut bb] = [0.0; 3];
        for h in mesh.vertex_half_edges(v) {
            let along = mesh.position(mesh.target(h)) - mesh.position(v);
            let u = along.normalize_or_zero();
            let weight = 0.5 * signed_dihedral(mesh, &normals, h.edge()) * mesh.length(h);
            let (x, y) = (u.dot(a), u.dot(b));
            aa += weight * x * x;
            ab += weight * x * y;
            bb += weight * y * y;
        }
        let area = areas[v.index()];
        let (middle, half) = (0.5 * (aa + bb), 0.5 * (aa - bb));
        let radius = (half * half + ab * ab).sqrt();
        let pair = [(middle - radius) / area, (middle + radius) / area];
        if pair.iter().all(|k| k.is_finite()) {
            pair.map(|k| scaled.restored(k, -1))
        } else {
            none
        }
    })
}

/// Returns the area of the surface that belongs to each vertex, in scene unit². Entry i belongs to the vertex with the
/// index i, and is 0 if the mesh does not contain this vertex. Each face around a vertex contributes its area divided
/// by its number of corners.
pub fn vertex_areas(mesh: &Mesh) -> Vec<f64> {
    #[expect(
        clippy::cast_precision_loss,
        reason = "a face has fewer than 2^32 corners"
    )]
    let shares = mesh.at_faces(|f| mesh.face_area(f) / mesh.degree(f) as f64);
    fill_vertices(mesh, 0.0, |v| {
        let faces = mesh.vertex_half_edges(v).filter_map(|h| mesh.face(h));
        faces.map(|f| shares[f.index()]).sum()
    })
}

/// Returns the signed angle between the normals of the two faces at an edge, positive if the edge is convex. Returns 0
/// for boundary edges.
fn signed_dihedral(mesh: &Mesh, normals: &[DVec3], e: EdgeId) -> f64 {
    let [Some(f), Some(g)] = mesh.edge_faces(e) else {
        return 0.0;
    };
    let (n, m) = (normals[f.index()], normals[g.index()]);
    let [v, w] = mesh.edge_vertices(e).map(|v| mesh.position(v));
    // The first half-edge of the edge runs from v to w, and the face f is to the left of this half-edge.
    if n.cross(m).dot(w - v) >= 0.0 {
        angle_between(n, m)
    } else {
        -angle_between(n, m)
    }
}

/// Computes a value for each vertex, and converts the value to scene units. Entry i of the result belongs to the vertex
/// with the index i. Values that are not finite become NaN.
fn at_vertices(
    scaled: &Scaled,
    dimension: i32,
    value: impl Fn(VertexId) -> f64 + Sync,
) -> Vec<f64> {
    fill_vertices(scaled.mesh(), f64::NAN, |v| {
        let value = value(v);
        if value.is_finite() {
            scaled.restored(value, dimension)
        } else {
            f64::NAN
        }
    })
}

/// Computes a value for each vertex. Entry i of the result belongs to the vertex with the index i. Dead (removed)
/// vertices get the value `none`.
fn fill_vertices<T: Copy + Send + Sync>(
    mesh: &Mesh,
    none: T,
    value: impl Fn(VertexId) -> T + Sync,
) -> Vec<T> {
    parallel::collect(mesh.domain_len(Domain::Vertex), |v| {
        let v = VertexId::new(v);
        if mesh.has_vertex(v) { value(v) } else { none }
    })
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
            let (curvatures, areas) = (gaussian_curvatures(&mesh), vertex_areas(&mesh));
            let total: f64 = mesh
                .vertices()
                .map(|v| curvatures[v.index()] * areas[v.index()])
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
    fn principal_curvatures_are_those_of_spheres_cylinders_and_tori() {
        let sphere = shapes::uv_sphere(64, 32);
        let tube = shapes::cylinder(64, true);
        let torus = shapes::torus(96, 48, 2.0, 0.5);
        let expected_on_torus = |v: VertexId| {
            let p = torus.position(v);
            let ring = p.truncate().length();
            [(ring - 2.0) / (0.5 * ring), 2.0]
        };
        for mesh in [&sphere, &torus] {
            let found = principal_curvatures(mesh);
            let mut sum = 0.0;
            for v in mesh.vertices() {
                let [low, high] = if mesh.n_faces() == torus.n_faces() {
                    expected_on_torus(v)
                } else {
                    [1.0; 2]
                };
                let [k, l] = found[v.index()];
                assert!(k <= l);
                sum += (k - low).abs() + (l - high).abs();
            }
            let error = sum / found.len() as f64;
            assert!(error < 0.03, "{error}");
        }
        let found = principal_curvatures(&tube);
        let radius = tube.position(VertexId::new(0)).truncate().length();
        let inner = |v: &VertexId| {
            tube.vertex_faces(*v)
                .all(|f| tube.face_normal(f).z.abs() < 0.1)
        };
        for v in tube.vertices().filter(inner) {
            let [low, high] = found[v.index()];
            assert!(
                low.abs() < 1e-9 && (high * radius - 1.0).abs() < 0.01,
                "{low} {high}"
            );
        }
        let mut reversed = sphere;
        reversed.reverse();
        let [low, high] = principal_curvatures(&reversed)[1024];
        assert!(low <= high && (high + 1.0).abs() < 0.02, "{low} {high}");
    }

    #[test]
    fn curvatures_scale_with_the_inverse_of_the_size() {
        let mesh = shapes::torus(12, 8, 2.0, 0.5);
        let mut large = mesh.clone();
        for p in large.positions_mut() {
            *p *= 4.0;
        }
        for (k, l) in principal_curvatures(&mesh)
            .iter()
            .zip(principal_curvatures(&large))
        {
            assert!((k[0] - 4.0 * l[0]).abs() < 1e-12 && (k[1] - 4.0 * l[1]).abs() < 1e-12);
        }
        let gauss = gaussian_curvatures(&mesh);
        for (k, l) in gauss.iter().zip(gaussian_curvatures(&large)) {
            assert!((k - 16.0 * l).abs() < 1e-12);
        }
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
