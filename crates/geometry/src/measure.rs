//! Measures of whole meshes: area, volume, bounding box, genus and components.

use mesh::{DVec3, Domain, FaceId, Mesh, VertexId, parallel};

/// Returns the sum of the areas of all faces.
pub fn area(mesh: &Mesh) -> f64 {
    sum_over_faces(mesh, |f| mesh.face_area(f))
}

/// Returns the volume inside the mesh. The volume is negative if the normals of the faces point inward. The volume is
/// meaningful only for a closed mesh.
///
/// Each face is divided into a fan of triangles. By the divergence theorem, the volume is the sum of the signed volumes
/// of tetrahedra. Each tetrahedron joins a triangle of the surface to one fixed point, the same for all triangles. The
/// fixed point is the center of the bounding box, so that the volume is accurate even for a mesh far from the origin.
pub fn volume(mesh: &Mesh) -> f64 {
    let middle = bounds(mesh).map_or(DVec3::ZERO, |[min, max]| 0.5 * (min + max));
    sum_over_faces(mesh, |f| {
        let mut corners = mesh.face_vertices(f).map(|v| mesh.position(v) - middle);
        let (Some(first), Some(mut last)) = (corners.next(), corners.next()) else {
            return 0.0;
        };
        let mut sum = 0.0;
        for p in corners {
            sum += first.dot(last.cross(p));
            last = p;
        }
        sum / 6.0
    })
}

fn sum_over_faces(mesh: &Mesh, term: impl Fn(FaceId) -> f64 + Sync) -> f64 {
    parallel::sum(mesh.domain_len(Domain::Face), |i| {
        let f = FaceId::new(i);
        if mesh.has_face(f) { term(f) } else { 0.0 }
    })
}

/// Returns two corners of the bounding box of all vertices: the corner with the smallest coordinates and the corner
/// with the largest coordinates. Returns `None` if the mesh has no vertices.
pub fn bounds(mesh: &Mesh) -> Option<[DVec3; 2]> {
    let bounds = |v: usize| {
        let v = VertexId::new(v);
        mesh.has_vertex(v).then(|| [mesh.position(v); 2])
    };
    parallel::fold(mesh.positions().len(), None, bounds, |a, b| match (a, b) {
        (Some([min, max]), Some([low, high])) => Some([min.min(low), max.max(high)]),
        (a, b) => a.or(b),
    })
}

/// Returns the genus g: the total number of handles of all components. The genus follows from χ = 2c - 2g - b. In this
/// formula, c is the number of components with faces, b is the number of boundary loops, and χ is the Euler
/// characteristic without isolated vertices.
pub fn genus(mesh: &Mesh) -> i64 {
    let count = |n: usize| i64::try_from(n).expect("fewer than 2^32 elements");
    let isolated = count(mesh.n_isolated_vertices());
    let euler = mesh.euler_characteristic() - isolated;
    let components = count(n_components(mesh)) - isolated;
    (2 * components - count(mesh.n_boundary_loops()) - euler) / 2
}

/// Returns, for each vertex, the index of its connected component. Entry i belongs to the vertex with the index i.
/// Components are numbered from 0 in the order of the lowest vertex id of each component. An isolated vertex is a
/// separate component. The index of a dead (removed) vertex is `usize::MAX`.
pub fn components(mesh: &Mesh) -> Vec<usize> {
    let mut component = vec![usize::MAX; mesh.positions().len()];
    let mut n = 0;
    let mut stack = Vec::new();
    for v in mesh.vertices() {
        if component[v.index()] != usize::MAX {
            continue;
        }
        component[v.index()] = n;
        stack.push(v);
        while let Some(v) = stack.pop() {
            for w in mesh.vertex_neighbors(v) {
                if component[w.index()] == usize::MAX {
                    component[w.index()] = n;
                    stack.push(w);
                }
            }
        }
        n += 1;
    }
    component
}

/// Returns the number of connected components. An isolated vertex counts as a component.
pub fn n_components(mesh: &Mesh) -> usize {
    let components = components(mesh);
    components
        .iter()
        .filter(|&&c| c != usize::MAX)
        .max()
        .map_or(0, |&last| last + 1)
}

/// Returns the number of vertices of each valence: entry n counts the vertices with n edges.
pub fn valences(mesh: &Mesh) -> Vec<usize> {
    let mut counts = Vec::new();
    for v in mesh.vertices() {
        let n = mesh.valence(v);
        counts.resize(counts.len().max(n + 1), 0);
        counts[n] += 1;
    }
    counts
}

/// Returns the sine and cosine of an angle in degrees. The result is exact for multiples of 90, and is identical bit
/// for bit on every platform.
pub fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let degrees = degrees % 360.0; // The remainder is exact.
    match degrees.abs() {
        0.0 => (0.0, 1.0),
        90.0 => (degrees.signum(), 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-degrees.signum(), 0.0),
        _ => libm::sincos(degrees.to_radians()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn quarter_turns_have_exact_sines_and_cosines() {
        let quarters = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
        for k in -9..=9 {
            let exact = quarters[usize::try_from(i32::rem_euclid(k, 4)).unwrap()];
            assert_eq!(sin_cos_degrees(90.0 * f64::from(k)), exact, "{k} quarters");
        }
    }

    #[test]
    fn other_angles_lie_on_the_circle() {
        for degrees in [1.0, 30.0, -45.0, 89.999_999, 1e6, -1e300] {
            let (s, c) = sin_cos_degrees(degrees);
            assert!((s * s + c * c - 1.0).abs() < 1e-15);
        }
        assert!((sin_cos_degrees(30.0).0 - 0.5).abs() < 1e-15);
    }

    #[test]
    fn a_unit_cube_has_area_six_and_volume_one() {
        let mut cube = shapes::cube();
        for p in cube.positions_mut() {
            *p = 0.5 * *p + DVec3::splat(1e6);
        }
        assert!((area(&cube) - 6.0).abs() < 1e-8);
        assert!((volume(&cube) - 1.0).abs() < 1e-8);
        assert_eq!(
            bounds(&cube),
            Some([DVec3::splat(1e6 - 0.5), DVec3::splat(1e6 + 0.5)])
        );
    }

    #[test]
    fn reversed_faces_negate_the_volume() {
        let cube = shapes::cube();
        let polygons: Vec<Vec<u32>> = cube
            .faces()
            .map(|f| {
                let mut corners: Vec<u32> = cube
                    .face_vertices(f)
                    .map(|v| u32::try_from(v.index()).unwrap())
                    .collect();
                corners.reverse();
                corners
            })
            .collect();
        let (inside_out, _) = Mesh::from_polygons(cube.positions().to_vec(), &polygons).unwrap();
        assert_eq!(volume(&inside_out), -volume(&cube));
    }

    #[test]
    fn genus_and_boundary_loops_classify_surfaces() {
        let topology = |m: &Mesh| {
            (
                m.euler_characteristic(),
                genus(m),
                m.n_boundary_loops(),
                n_components(m),
            )
        };
        assert_eq!(topology(&shapes::cube()), (2, 0, 0, 1));
        assert_eq!(topology(&shapes::torus(6, 4, 2.0, 0.5)), (0, 1, 0, 1));
        assert_eq!(topology(&shapes::grid(3, 2)), (1, 0, 1, 1));
        assert_eq!(topology(&Mesh::default()), (0, 0, 0, 0));
        let mut tube = shapes::cube();
        tube.delete_face(FaceId::new(0)).unwrap();
        let opposite = tube
            .faces()
            .find(|&f| tube.face_vertices(f).all(|v| !tube.is_boundary_vertex(v)));
        tube.delete_face(opposite.unwrap()).unwrap();
        assert_eq!(topology(&tube), (0, 0, 2, 1));
    }

    #[test]
    fn isolated_vertices_do_not_change_genus_or_boundary_loops() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let (mesh, _) = Mesh::from_polygons(points, &[[0, 1, 2]]).unwrap();
        assert_eq!(
            (genus(&mesh), mesh.n_boundary_loops(), n_components(&mesh)),
            (0, 1, 2)
        );
    }

    #[test]
    fn valences_are_counted() {
        assert_eq!(valences(&shapes::icosahedron()), [0, 0, 0, 0, 0, 12]);
        assert_eq!(valences(&shapes::grid(1, 1)), [0, 0, 4]);
    }
}
