use mesh::{DVec3, VertexId};
use progress::NoProgress;

use super::*;
use crate::shapes;

fn distances(mesh: &Mesh, sources: &[usize]) -> Vec<f64> {
    let mut is_source = vec![false; mesh.n_vertices()];
    for &v in sources {
        is_source[v] = true;
    }
    geodesic_distances(mesh, &is_source, &NoProgress).unwrap()
}

/// Returns one mesh with the elements of two meshes.
pub(crate) fn together(a: &Mesh, b: &Mesh) -> Mesh {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for mesh in [a, b] {
        let first = points.len();
        points.extend_from_slice(mesh.positions());
        for f in mesh.faces() {
            let corners = mesh
                .face_vertices(f)
                .map(|v| u32::try_from(first + v.index()).unwrap());
            faces.push(corners.collect::<Vec<u32>>());
        }
    }
    Mesh::from_polygons(points, &faces).unwrap().0
}

/// Returns the mean and the largest error, relative to the largest distance.
fn errors(found: &[f64], exact: impl Fn(usize) -> f64) -> [f64; 2] {
    let largest = (0..found.len()).map(&exact).fold(0.0, f64::max);
    let (mut sum, mut max) = (0.0, 0.0);
    for (v, d) in found.iter().enumerate() {
        let error = (d - exact(v)).abs() / largest;
        sum += error;
        max = f64::max(max, error);
    }
    [sum / found.len() as f64, max]
}

/// Returns a sphere of triangles: an icosahedron whose triangles are repeatedly divided into four.
fn sphere(levels: u32) -> Mesh {
    let mut mesh = shapes::icosahedron();
    for _ in 0..levels {
        let mut points = mesh.positions().to_vec();
        for e in mesh.edges() {
            let [a, b] = mesh.edge_vertices(e).map(|v| mesh.position(v));
            points.push((a + b).normalize());
        }
        let mut faces = Vec::new();
        for f in mesh.faces() {
            let small = |i: usize| u32::try_from(i).unwrap();
            let corner = |h: mesh::HalfEdgeId| small(mesh.origin(h).index());
            let middle = |h: mesh::HalfEdgeId| small(mesh.n_vertices() + h.edge().index());
            let sides: Vec<_> = mesh.face_half_edges(f).collect();
            faces.push([middle(sides[0]), middle(sides[1]), middle(sides[2])]);
            for k in 0..3 {
                faces.push([
                    corner(sides[k]),
                    middle(sides[k]),
                    middle(sides[(k + 2) % 3]),
                ]);
            }
        }
        mesh = Mesh::from_polygons(points, &faces).unwrap().0;
    }
    mesh
}

#[test]
fn distances_on_a_sphere_are_angles() {
    for mesh in [shapes::uv_sphere(96, 48), sphere(4)] {
        for source in [0, mesh.n_vertices() / 2 + 5] {
            let pole = mesh.positions()[source];
            let found = distances(&mesh, &[source]);
            let exact = |v: usize| mesh::angle_between(mesh.positions()[v], pole);
            let [mean, max] = errors(&found, exact);
            assert!(mean < 0.01 && max < 0.03, "{mean} {max}");
        }
    }
}

#[test]
fn distances_on_a_plane_are_straight() {
    let mesh = shapes::grid(40, 40);
    let found = distances(&mesh, &[20 * 41 + 20]);
    let exact = |v: usize| mesh.positions()[v].distance(mesh.positions()[20 * 41 + 20]);
    let [mean, max] = errors(&found, exact);
    assert!(mean < 0.015 && max < 0.06, "{mean} {max}");
    assert_eq!(found[20 * 41 + 20], 0.0);
}

#[test]
fn a_line_of_sources_gives_the_distance_from_the_line() {
    let mesh = shapes::grid(20, 20);
    let line: Vec<usize> = (0..21).collect();
    let y = |v: usize| mesh.positions()[v].y - mesh.positions()[0].y;
    let [_, max] = errors(&distances(&mesh, &line), y);
    assert!(max < 0.01, "{max}");
}

#[test]
fn needles_and_large_coordinates_do_no_harm() {
    let fine = sphere(3);
    for scale in [1e-150, 1e150] {
        let mut needles = shapes::uv_sphere(400, 6);
        for mesh in [&mut needles, &mut fine.clone()] {
            for p in mesh.positions_mut() {
                *p *= scale;
            }
            let found = distances(mesh, &[0]);
            assert!(found.iter().all(|d| d.is_finite() && *d < 3.5 * scale));
            assert!(found.iter().any(|d| *d > 2.8 * scale));
        }
    }
    let mut flat = fine.clone();
    for p in flat.positions_mut() {
        *p = DVec3::X * p.x;
    }
    assert!(distances(&flat, &[0]).iter().all(|d| d.is_finite()));
    flat.positions_mut().fill(DVec3::ONE);
    assert!(distances(&flat, &[0]).iter().all(|d| d.is_finite()));
}

#[test]
fn vertices_that_cannot_be_reached_are_infinitely_far() {
    let two = together(&shapes::cube(), &shapes::octahedron());
    let found = distances(&two, &[0]);
    assert!(found[..8].iter().all(|d| d.is_finite()));
    assert!(found[8..].iter().all(|d| *d == f64::INFINITY));
    assert!(distances(&two, &[]).iter().all(|d| *d == f64::INFINITY));
    let mut alone = shapes::square();
    alone.delete_face(mesh::FaceId::new(0)).unwrap();
    let found = distances(&alone, &[1]);
    assert_eq!(found[1], 0.0);
    assert_eq!(found[0], f64::INFINITY);
}

#[test]
fn long_surfaces_are_measured_to_their_end() {
    // The strip is 3000 edges long. Heat that flows only for a short time does not reach the end of the strip.
    let mut strip = shapes::grid(3000, 1);
    for p in strip.positions_mut() {
        p.x *= 1500.0;
    }
    let found = distances(&strip, &[0, 3001]);
    let end = strip.position(VertexId::new(3000)).x - strip.position(VertexId::new(0)).x;
    assert!(
        (found[3000] / end - 1.0).abs() < 0.01,
        "{} {end}",
        found[3000]
    );
}
