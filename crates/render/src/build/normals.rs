//! Computes normals for meshes without normals. The normals are weighted by area, and split at sharp edges.

use ::mesh::{Domain, EdgeId, FaceId, HalfEdgeId, Mesh, SMOOTHING, VertexId};
use glam::DVec3;

use crate::color::narrow;
use crate::drawing::Channel;
use crate::work::map_indices;

/// Returns the area vector of each face, by index: a normal whose length is the area of the face. The vectors are
/// divided by the square of `size`, so that their coordinates are in the range of `f32`. Deleted faces have zero
/// vectors.
pub(super) fn of_faces(mesh: &Mesh, size: f64) -> Vec<[f32; 3]> {
    let scale = 1.0 / (size * size);
    map_indices(mesh.domain_len(Domain::Face), |i| {
        let f = FaceId::new(i);
        if mesh.has_face(f) {
            (mesh.area_vector(f) * scale).to_array().map(narrow)
        } else {
            [0.0; 3]
        }
    })
}

/// For each vertex index, returns the sum of the area vectors of the faces around the vertex. The method is from
/// Gouraud, "Continuous Shading of Curved Surfaces", 1971, but weights faces by area.
fn of_vertices(mesh: &Mesh, areas: &[[f32; 3]]) -> Vec<[f32; 3]> {
    map_indices(mesh.positions().len(), |i| {
        let v = VertexId::new(i);
        if !mesh.has_vertex(v) {
            return [0.0; 3];
        }
        let faces = mesh.vertex_faces(v);
        faces.fold([0.0; 3], |sum, f| add(sum, areas[f.index()]))
    })
}

/// Returns smooth normals that are split at sharp edges. If the mesh has smoothing groups, an edge is sharp if its two
/// faces are in different groups, or if neither face is in a group. Otherwise, an edge is sharp if the normals of its
/// faces differ by at least `sharp` degrees. `size` is the radius of the scene.
pub(super) fn smooth<'a>(mesh: &Mesh, size: f64, sharp: f64) -> Channel<'a> {
    let areas = of_faces(mesh, size);
    let is_sharp = sharp_edges(mesh, &areas, sharp);
    if !is_sharp.contains(&true) {
        return Channel::Point(of_vertices(mesh, &areas).into());
    }
    let normals = map_indices(mesh.domain_len(Domain::Corner), |i| {
        let h = HalfEdgeId::new(i);
        if mesh.has_edge(h.edge()) {
            of_corner(mesh, h, &areas, &is_sharp)
        } else {
            [0.0; 3]
        }
    });
    Channel::Corner(normals.into())
}

fn sharp_edges(mesh: &Mesh, areas: &[[f32; 3]], sharp: f64) -> Vec<bool> {
    let groups = mesh.get(SMOOTHING);
    let limit = libm::cos(sharp.to_radians());
    map_indices(mesh.domain_len(Domain::Edge), |i| {
        let e = EdgeId::new(i);
        if !mesh.has_edge(e) {
            return false;
        }
        let [Some(f), Some(g)] = mesh.edge_faces(e) else {
            return false;
        };
        if let Some(groups) = groups {
            let (f, g) = (groups[f.index()], groups[g.index()]);
            return f != g || f == 0;
        }
        let [a, b] = [f, g].map(|f| DVec3::from(areas[f.index()].map(f64::from)));
        if is_clearly_smooth(a, b, limit) {
            return false;
        }
        let (n, m) = (a.normalize_or_zero(), b.normalize_or_zero());
        n != DVec3::ZERO && m != DVec3::ZERO && n.dot(m) <= limit
    })
}

/// Whether the cosine of the angle between two vectors is greater than `limit` by more than the rounding errors. This
/// test is enough for most edges, and needs no square root and no division.
fn is_clearly_smooth(a: DVec3, b: DVec3, limit: f64) -> bool {
    let dot = a.dot(b);
    let lengths = a.length_squared() * b.length_squared();
    limit > 0.0 && dot > 0.0 && dot * dot > (1.0 + 1e-9) * limit * limit * lengths
}

/// Returns the sum of the area vectors of the faces around the vertex at which the half-edge `h` starts. Faces that a
/// sharp edge separates from the face of `h` are left out.
fn of_corner(mesh: &Mesh, h: HalfEdgeId, areas: &[[f32; 3]], is_sharp: &[bool]) -> [f32; 3] {
    let Some(face) = mesh.face(h) else {
        return [0.0; 3];
    };
    let mut sum = areas[face.index()];
    // Walks counter-clockwise around the vertex. In each face, one half-edge ends at the vertex. Its twin is in the
    // next face.
    let mut g = h;
    loop {
        let before = mesh.prev(g);
        if is_sharp[before.edge().index()] {
            break;
        }
        g = before.twin();
        match mesh.face(g) {
            Some(_) if g == h => return sum,
            Some(f) => sum = add(sum, areas[f.index()]),
            None => break,
        }
    }
    // Walks clockwise around the vertex. In each face, one half-edge starts at the vertex. Its twin is in the next
    // face.
    g = h;
    while !is_sharp[g.edge().index()] {
        let Some(f) = mesh.face(g.twin()) else {
            break;
        };
        g = mesh.next(g.twin());
        if g == h {
            break;
        }
        sum = add(sum, areas[f.index()]);
    }
    sum
}

fn add(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Converts vectors to `f32`.
pub(super) fn narrowed(vectors: &[DVec3]) -> Vec<[f32; 3]> {
    map_indices(vectors.len(), |i| vectors[i].to_array().map(narrow))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::geometry::shapes;

    fn unit(n: [f32; 3]) -> DVec3 {
        DVec3::from(n.map(f64::from)).normalize_or_zero()
    }

    #[test]
    fn angles_near_the_limit_are_not_clearly_smooth() {
        let vector = |degrees: f64, length: f64| {
            let angle = degrees.to_radians();
            length * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
        };
        for limit in [10.0_f64, 40.0, 89.0] {
            let cosine = libm::cos(limit.to_radians());
            for length in [1e-38, 1.0, 1e30] {
                let smooth =
                    |degrees| is_clearly_smooth(vector(0.0, 1.0), vector(degrees, length), cosine);
                assert!(smooth(0.0) && smooth(limit - 0.001), "{limit} {length}");
                assert!(!smooth(limit) && !smooth(limit + 0.001) && !smooth(180.0));
            }
        }
        assert!(!is_clearly_smooth(DVec3::ZERO, DVec3::X, 0.5));
        assert!(!is_clearly_smooth(
            DVec3::X,
            DVec3::X,
            libm::cos(120.0_f64.to_radians())
        ));
    }

    #[test]
    fn the_corners_of_a_cube_have_the_normals_of_their_faces() {
        let cube = shapes::cube();
        let Channel::Corner(normals) = smooth(&cube, 1.0, 40.0) else {
            panic!("edges of 90 degrees are sharp");
        };
        for h in cube.half_edges() {
            let f = cube.face(h).unwrap();
            assert!((unit(normals[h.index()]) - cube.face_normal(f)).length() < 1e-6);
        }
    }

    #[test]
    fn a_cube_without_sharp_edges_has_normals_along_its_diagonals() {
        let cube = shapes::cube();
        let Channel::Point(normals) = smooth(&cube, 1.0, 120.0) else {
            panic!("no edge is sharp");
        };
        let middle = 0.5 * geometry::bounds(&cube).unwrap().into_iter().sum::<DVec3>();
        for v in cube.vertices() {
            let outwards = (cube.position(v) - middle).normalize();
            assert!((unit(normals[v.index()]) - outwards).length() < 1e-6);
        }
    }

    #[test]
    fn the_side_of_a_cylinder_is_smooth_up_to_its_rims() {
        let cylinder = shapes::cylinder(24, true);
        let Channel::Corner(normals) = smooth(&cylinder, 1.0, 40.0) else {
            panic!("the rims are sharp");
        };
        for h in cylinder.half_edges() {
            let f = cylinder.face(h).unwrap();
            let n = unit(normals[h.index()]);
            if cylinder.degree(f) == 4 {
                let p = cylinder.position(cylinder.origin(h));
                let outwards = DVec3::new(p.x, p.y, 0.0).normalize();
                assert!((n - outwards).length() < 1e-6, "{n}, {outwards}");
            } else {
                assert!((n - cylinder.face_normal(f)).length() < 1e-6);
            }
        }
    }

    #[test]
    fn smoothing_groups_determine_which_edges_are_sharp() {
        let mut cube = shapes::cube();
        cube.set(SMOOTHING, vec![1; 6]);
        assert!(matches!(smooth(&cube, 1.0, 40.0), Channel::Point(_)));
        cube.set(SMOOTHING, vec![0; 6]);
        assert!(matches!(smooth(&cube, 1.0, 40.0), Channel::Corner(_)));
    }
}
