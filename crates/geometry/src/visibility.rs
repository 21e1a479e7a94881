//! Computes the thickness and the ambient occlusion of meshes by casting rays.

use std::f64::consts::TAU;

use mesh::{DVec3, FaceId, HalfEdgeId, Mesh, VertexId, parallel};
use progress::{Cancelled, Meter, Progress};

use crate::Scaled;
use crate::deform::noise::random;
use crate::deform::vertex_directions;
use crate::surface_index::SurfaceIndex;

/// Rays start at a distance from the surface: this number times the diagonal of the bounding box.
const OFFSET: f64 = 1e-7;
/// A ray that measures the thickness at a vertex starts on a face, near the vertex. Let l be the length of the shorter
/// one of the two edges of the face that meet at the vertex. The distance between the vertex and the start of the ray
/// is at most 2 l times this number.
const INWARD: f64 = 1e-3;
/// The number of vertices in a block. One thread computes the values of all vertices of a block.
const BLOCK: usize = 256;

/// Returns the thickness of the solid at each vertex, in scene units. Entry i belongs to the vertex with the index i.
/// For each face around the vertex, a ray starts on the face, near the vertex. The ray runs inward, at a right angle to
/// the face, until it leaves the solid. The thickness at a vertex is the length of the shortest ray. The thickness is
/// infinite if no ray meets the surface again, for example on a flat sheet. It is also infinite if all faces around the
/// vertex have zero area.
///
/// For a plate, the thickness at every vertex is the distance between the two sides of the plate, even at its edges and
/// corners. Closed parts of the surface can overlap. A ray does not end where it enters another part; it ends where it
/// leaves a part. Walls thinner than 1e-7 times the diagonal of the bounding box are not found. The mesh must be
/// [dense](mesh::Mesh::is_dense).
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub fn thickness(mesh: &Mesh, progress: &dyn Progress) -> Result<Vec<f64>, Cancelled> {
    let scaled = Scaled::new(mesh);
    let mesh = scaled.mesh();
    let Some(index) = SurfaceIndex::with_progress(mesh, progress)? else {
        return Ok(vec![f64::INFINITY; mesh.n_vertices()]);
    };
    let offset = offset(&index);
    at_vertices(mesh, "measure thickness", progress, |v| {
        let corners = mesh.vertex_half_edges(v);
        let corners = corners.filter_map(|h| Some((h, mesh.face(h)?)));
        let rays = corners.map(|(h, f)| behind(mesh, &index, h, f, offset));
        scaled.restored(rays.fold(f64::INFINITY, f64::min), 1)
    })
}

/// Returns the length of the ray that runs inward from the corner of `h` at a right angle to the face `f`.
fn behind(mesh: &Mesh, index: &SurfaceIndex, h: HalfEdgeId, f: FaceId, offset: f64) -> f64 {
    let normal = mesh.face_normal(f);
    if normal == DVec3::ZERO {
        return f64::INFINITY;
    }
    let p = mesh.position(mesh.origin(h));
    let next = mesh.position(mesh.target(h)) - p;
    let last = mesh.position(mesh.origin(mesh.prev(h))) - p;
    let bisector = next.normalize_or_zero() + last.normalize_or_zero();
    // At a reflex corner, the sum of the directions of both edges points out of the face, so the sign of this sum is
    // changed.
    let is_reflex = next.cross(last).dot(normal) < 0.0;
    let into = if is_reflex { -bisector } else { bisector };
    let origin = p + INWARD * next.length().min(last.length()) * into - offset * normal;
    let is_end = |hit: &crate::surface_index::RayHit| {
        !hit.is_front && index.triangle(hit.triangle).face != f
    };
    match index.ray(origin, -normal) {
        None => f64::INFINITY,
        Some(hit) if is_end(&hit) => hit.t + offset,
        Some(_) => {
            let all = index.ray_all(origin, -normal);
            let end = all.iter().find(|hit| is_end(hit));
            end.map_or(f64::INFINITY, |hit| hit.t + offset)
        }
    }
}

/// Returns the ambient occlusion at each vertex: the fraction of the rays from the vertex that meet the mesh, from 0
/// (open) to 1 (enclosed). Entry i belongs to the vertex with the index i. The normal of a vertex is the direction of
/// the sum of the area vectors of its faces. The occlusion is NaN for vertices without a normal.
///
/// The directions of the rays are distributed about the normal, with a density proportional to the cosine of their
/// angle to the normal. The same set of directions is used at each vertex, turned about the normal by a random angle
/// that depends on `seed`. The mesh must be [dense](mesh::Mesh::is_dense).
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub fn occlusion(
    mesh: &Mesh,
    rays: u32,
    seed: u64,
    progress: &dyn Progress,
) -> Result<Vec<f64>, Cancelled> {
    /// The golden ratio minus 1. The multiples of this number are spread evenly modulo 1.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let scaled = Scaled::new(mesh);
    let mesh = scaled.mesh();
    let Some(index) = SurfaceIndex::with_progress(mesh, progress)? else {
        return Ok(vec![f64::NAN; mesh.n_vertices()]);
    };
    let (offset, normals) = (offset(&index), vertex_directions(mesh));
    // The directions of the rays for a normal along the z axis. At each vertex, these directions are turned to the
    // normal of the vertex.
    let lattice: Vec<DVec3> = (0..rays)
        .map(|i| {
            let height = (f64::from(i) + 0.5) / f64::from(rays);
            let (sin, cos) = libm::sincos(TAU * (GOLDEN * f64::from(i)).fract());
            let radius = height.sqrt();
            DVec3::new(radius * cos, radius * sin, (1.0 - height).sqrt())
        })
        .collect();
    at_vertices(mesh, "measure occlusion", progress, |v| {
        let normal = normals[v.index()];
        if normal == DVec3::ZERO {
            return f64::NAN;
        }
        let (a, b) = normal.any_orthonormal_pair();
        let turn = 0.5 * (random(seed, v.index() as u64) + 1.0);
        let (sin, cos) = libm::sincos(TAU * turn);
        let (a, b) = (a * cos + b * sin, b * cos - a * sin);
        let origin = mesh.position(v) + offset * normal;
        let meets = |d: &&DVec3| {
            index
                .ray(origin, d.x * a + d.y * b + d.z * normal)
                .is_some()
        };
        lattice.iter().filter(meets).count() as f64 / f64::from(rays)
    })
}

fn offset(index: &SurfaceIndex) -> f64 {
    let [min, max] = index.bounds();
    OFFSET * min.distance(max)
}

fn at_vertices(
    mesh: &Mesh,
    what: &'static str,
    progress: &dyn Progress,
    value: impl Fn(VertexId) -> f64 + Sync,
) -> Result<Vec<f64>, Cancelled> {
    let meter = Meter::new(progress, what, mesh.n_vertices() as u64);
    let mut values = vec![0.0; mesh.n_vertices()];
    let blocks = parallel::consume(values.chunks_mut(BLOCK), |b, block| {
        for (i, slot) in (b * BLOCK..).zip(block.iter_mut()) {
            *slot = value(VertexId::new(i));
        }
        meter.add(block.len())
    });
    blocks.into_iter().collect::<Result<(), Cancelled>>()?;
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geodesic::tests::together;
    use crate::shapes;
    use progress::NoProgress;

    fn scaled(mut mesh: Mesh, by: DVec3) -> Mesh {
        for p in mesh.positions_mut() {
            *p *= by;
        }
        mesh
    }

    fn thicknesses(mesh: &Mesh) -> Vec<f64> {
        thickness(mesh, &NoProgress).unwrap()
    }

    #[test]
    fn a_plate_is_as_thick_as_its_sides_are_apart_also_at_its_corners() {
        let plate = scaled(shapes::cube(), DVec3::new(10.0, 7.0, 0.25));
        for d in thicknesses(&plate) {
            assert!((d - 0.5).abs() < 1e-6, "{d}");
        }
        for d in thicknesses(&shapes::fans(&plate)) {
            assert!((d - 0.5).abs() < 1e-6, "{d}");
        }
    }

    #[test]
    fn spheres_and_walls_of_hollow_spheres_have_their_thickness() {
        let outer = shapes::uv_sphere(64, 32);
        for d in thicknesses(&outer) {
            assert!((d - 2.0).abs() < 0.02, "{d}");
        }
        let mut inner = scaled(outer.clone(), DVec3::splat(0.8));
        inner.reverse();
        let hollow = together(&outer, &inner);
        for d in thicknesses(&hollow) {
            assert!((d - 0.2).abs() < 0.01, "{d}");
        }
    }

    #[test]
    fn thickness_grows_with_the_size_and_sheets_have_none() {
        let torus = shapes::torus(24, 12, 2.0, 0.5);
        let large = thicknesses(&scaled(torus.clone(), DVec3::splat(1e6)));
        for (a, b) in thicknesses(&torus).iter().zip(large) {
            assert!((1e6 * a - b).abs() < 1e-3 * b, "{a} {b}");
        }
        assert!(
            thicknesses(&shapes::grid(3, 3))
                .iter()
                .all(|d| d.is_infinite())
        );
        assert_eq!(thicknesses(&Mesh::default()), [] as [f64; 0]);
    }

    #[test]
    fn convex_surfaces_are_not_occluded_and_hollows_are() {
        let found = occlusion(&shapes::uv_sphere(24, 12), 64, 0, &NoProgress).unwrap();
        assert_eq!(found, vec![0.0; found.len()]);
        let mut inside = shapes::uv_sphere(24, 12);
        inside.reverse();
        let found = occlusion(&inside, 64, 0, &NoProgress).unwrap();
        assert_eq!(found, vec![1.0; found.len()]);
    }

    #[test]
    fn a_wall_hides_half_of_the_sky_and_seeds_hardly_matter() {
        // A vertex of the floor almost touches a very high wall. By symmetry, the wall hides half of the hemisphere.
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
            [-0.01, -1e4, 0.0],
            [-0.01, 1e4, 0.0],
            [-0.01, 1e4, 1e4],
            [-0.01, -1e4, 1e4],
        ];
        let points = points.map(DVec3::from_array).to_vec();
        let faces: [&[u32]; 2] = [&[0, 1, 2], &[3, 4, 5, 6]];
        let mesh = Mesh::from_polygons(points, &faces).unwrap().0;
        for seed in 0..4 {
            let found = occlusion(&mesh, 1000, seed, &NoProgress).unwrap();
            assert!((found[0] - 0.5).abs() < 0.03, "{}", found[0]);
        }
    }
}
