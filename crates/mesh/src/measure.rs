//! Measures of elements, and counts that describe the topology of a mesh.

use glam::DVec3;

use crate::parallel;
use crate::{Domain, EdgeId, Element, FaceId, HalfEdgeId, Mesh, VertexId};

/// Returns the angle between two directions, in radians from 0 to π; 0 if one of the vectors is zero.
///
/// The angle is computed as the arc tangent of sine and cosine. The arc tangent is accurate for angles near 0
/// and π, unlike the arc cosine. Source: Kahan, "How Futile are Mindless Assessments of Roundoff", 2006, §12.
pub fn angle_between(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (ordinary(a).0, ordinary(b).0);
    // Adding 0 turns -0 into 0. Without this addition, the arc tangent of (0, -0) would be π.
    libm::atan2(a.cross(b).length(), a.dot(b) + 0.0)
}

/// Returns the length of a vector. A vector with very small or very large components is scaled first, so that the
/// squares of the components do not overflow and the length does not underflow.
fn length(v: DVec3) -> f64 {
    match ordinary(v) {
        (v, 0) => v.length(),
        (v, exponent) => libm::scalbn(v.length(), exponent),
    }
}

/// Scales a vector by a power of two, so that squares of the scaled components cannot overflow and the scaled length
/// does not underflow. Returns the scaled vector and an exponent k: the original vector is the scaled vector times 2ᵏ.
/// Let m be the largest absolute value of a component. If m is zero or not finite, or is between 1e-70 and 1e70, the
/// vector is returned unchanged, with the exponent 0.
fn ordinary(v: DVec3) -> (DVec3, i32) {
    let largest = v.abs().max_element();
    if (1e-70..1e70).contains(&largest) || largest == 0.0 || !largest.is_finite() {
        return (v, 0);
    }
    let exponent = libm::ilogb(largest);
    let scaled = v.to_array().map(|x| libm::scalbn(x, -exponent));
    (DVec3::from_array(scaled), exponent)
}

/// Returns the area vector of a polygon with these corners, as [`Mesh::area_vector`] does for a face.
///
/// The area vector is half the sum of the cross products of consecutive corner positions (Newell's method). All
/// positions are taken relative to the first corner.
#[inline]
pub fn area_vector(mut corners: impl Iterator<Item = DVec3>) -> DVec3 {
    let Some(first) = corners.next() else {
        return DVec3::ZERO;
    };
    let mut sum = DVec3::ZERO;
    let mut last = DVec3::ZERO;
    for p in corners.map(|p| p - first) {
        sum += last.cross(p);
        last = p;
    }
    0.5 * sum
}

impl Mesh {
    /// Returns the area vector of a face: its length is the area, its direction is the normal.
    ///
    /// The result is exact for planar polygons. If a polygon is not planar, the length is the area of its projection
    /// along the normal.
    pub fn area_vector(&self, f: FaceId) -> DVec3 {
        area_vector(self.face_vertices(f).map(|v| self.position(v)))
    }

    /// Returns the area of a face: the length of its [area vector](Self::area_vector).
    pub fn face_area(&self, f: FaceId) -> f64 {
        length(self.area_vector(f))
    }

    /// Returns the unit normal of a face; zero if the area of the face is zero.
    pub fn face_normal(&self, f: FaceId) -> DVec3 {
        ordinary(self.area_vector(f)).0.normalize_or_zero()
    }

    /// Returns the unit normals of all faces, as [`face_normal`](Self::face_normal) computes them. Entry i belongs to the
    /// face with the index i, and is zero if the mesh does not contain this face.
    pub fn face_normals(&self) -> Vec<DVec3> {
        self.at_faces(|f| self.face_normal(f))
    }

    /// Returns the area vectors of all faces, as [`area_vector`](Self::area_vector) computes them. Entry i belongs to
    /// the face with the index i, and is zero if the mesh does not contain this face.
    pub fn area_vectors(&self) -> Vec<DVec3> {
        self.at_faces(|f| self.area_vector(f))
    }

    /// Computes a value for each face. Entry i of the result belongs to the face with the index i, and is the default
    /// value if the mesh does not contain this face. `value` is called from several threads.
    pub fn at_faces<T: Default + Send>(&self, value: impl Fn(FaceId) -> T + Sync) -> Vec<T> {
        parallel::collect(self.domain_len(Domain::Face), |i| {
            let f = FaceId::new(i);
            if self.has_face(f) {
                value(f)
            } else {
                T::default()
            }
        })
    }

    /// Returns the mean of the corner positions of a face.
    pub fn face_center(&self, f: FaceId) -> DVec3 {
        let (n, sum) = self
            .face_vertices(f)
            .fold((0.0, DVec3::ZERO), |(n, sum), v| {
                (n + 1.0, sum + self.position(v))
            });
        sum / n
    }

    /// Returns the length of the edge of `h`.
    pub fn length(&self, h: HalfEdgeId) -> f64 {
        length(self.position(self.origin(h)) - self.position(self.target(h)))
    }

    /// Returns the angle of a face at the corner of `h`, in radians. The half-edge `h` leaves the vertex of this corner
    /// and lies on the face.
    pub fn corner_angle(&self, h: HalfEdgeId) -> f64 {
        let p = self.position(self.origin(h));
        let next = self.position(self.target(h));
        let prev = self.position(self.origin(self.prev(h)));
        angle_between(next - p, prev - p)
    }

    /// Returns the angle between the normals of the two faces at an edge, in radians from 0 (flat) to π. Returns `None`
    /// on the boundary, or if the area of a face is zero.
    pub fn dihedral_angle(&self, e: EdgeId) -> Option<f64> {
        self.angle_of_faces(e, |f| self.face_normal(f))
    }

    /// Returns a function that computes the same angle as [`dihedral_angle`](Self::dihedral_angle). The normal of each
    /// face is computed only once. Use this function if the angles of many edges are needed: the time to compute a
    /// normal is proportional to the number of corners of the face.
    pub fn dihedral_angles(&self) -> impl Fn(EdgeId) -> Option<f64> {
        let normals = self.face_normals();
        move |e| self.angle_of_faces(e, |f| normals[f.index()])
    }

    fn angle_of_faces(&self, e: EdgeId, normal: impl Fn(FaceId) -> DVec3) -> Option<f64> {
        let [f, g] = self.edge_faces(e);
        let (n, m) = (normal(f?), normal(g?));
        (n != DVec3::ZERO && m != DVec3::ZERO).then(|| angle_between(n, m))
    }

    /// Returns V - E + F, where V, E and F are the numbers of vertices, edges and faces. V includes isolated vertices.
    pub fn euler_characteristic(&self) -> i64 {
        let count = |n: usize| i64::try_from(n).expect("fewer than 2^32 elements");
        count(self.n_vertices()) - count(self.n_edges()) + count(self.n_faces())
    }

    /// Returns the number of vertices without edges.
    pub fn n_isolated_vertices(&self) -> usize {
        parallel::count(self.positions.len(), |v| {
            let v = VertexId::new(v);
            self.has_vertex(v) && self.vertex_half_edge(v).is_none()
        })
    }

    /// Returns the face with the lowest id that is not a triangle, or `None` if all faces are triangles.
    pub fn first_non_triangle(&self) -> Option<FaceId> {
        let is_other = |f| self.has_face(f) && !self.is_triangle(f);
        let n = self.domain_len(Domain::Face);
        // Usually, all faces are triangles. Then all threads share the work.
        if parallel::all(n, |f| !is_other(FaceId::new(f))) {
            return None;
        }
        (0..n).map(FaceId::new).find(|&f| is_other(f))
    }

    /// Whether the mesh has no boundary edges.
    pub fn is_closed(&self) -> bool {
        self.edges().all(|e| !self.is_boundary_edge(e))
    }

    /// Returns, for each boundary loop, the half-edge with the lowest id. These half-edges are in order of ids.
    pub fn boundary_loops(&self) -> Vec<HalfEdgeId> {
        let mut is_visited = vec![false; self.connectivity.next.len()];
        let mut loops = Vec::new();
        for h in self.half_edges().filter(|&h| self.face(h).is_none()) {
            if !is_visited[h.index()] {
                loops.push(h);
                for h in self.loop_half_edges(h) {
                    is_visited[h.index()] = true;
                }
            }
        }
        loops
    }

    /// Returns the number of boundary loops.
    pub fn n_boundary_loops(&self) -> usize {
        self.boundary_loops().len()
    }

    /// Returns the positions of an element: the position of a vertex, of both ends of an edge or half-edge, or of
    /// all corners of a face in order. Returns an empty list if the element does not exist.
    pub fn element_points(&self, element: Element) -> Vec<DVec3> {
        match element {
            Element::Vertex(v) if self.has_vertex(v) => vec![self.position(v)],
            Element::HalfEdge(h) if self.has_edge(h.edge()) => [self.origin(h), self.target(h)]
                .map(|v| self.position(v))
                .to_vec(),
            Element::Edge(e) => self.element_points(e.half_edge().into()),
            Element::Face(f) if self.has_face(f) => {
                self.face_vertices(f).map(|v| self.position(v)).collect()
            }
            Element::Vertex(_) | Element::HalfEdge(_) | Element::Face(_) => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EdgeId, VertexId, shapes};

    #[test]
    fn the_first_face_that_is_not_a_triangle_is_found() {
        let mut mesh = shapes::cylinder(5, true);
        let polygons: Vec<FaceId> = mesh.faces().filter(|&f| !mesh.is_triangle(f)).collect();
        assert_eq!(mesh.first_non_triangle(), Some(polygons[0]));
        for f in polygons {
            mesh.delete_face(f).unwrap();
        }
        assert_eq!(mesh.first_non_triangle(), None);
        assert_eq!(shapes::icosahedron().first_non_triangle(), None);
    }

    #[test]
    fn angle_defects_of_a_closed_mesh_sum_to_two_pi_times_the_euler_characteristic() {
        for mesh in [shapes::icosahedron(), shapes::torus(5, 4, 3.0, 1.0)] {
            let angles: f64 = mesh.half_edges().map(|h| mesh.corner_angle(h)).sum();
            let n = mesh.n_vertices() as f64;
            // Each quad of the torus is planar, so its four angles sum to 2 pi, like the angles of two triangles.
            let defect = 2.0 * std::f64::consts::PI * n - angles;
            let expected = 2.0 * std::f64::consts::PI * mesh.euler_characteristic() as f64;
            assert!((defect - expected).abs() < 1e-9, "{defect} {expected}");
        }
    }

    #[test]
    fn the_angle_to_the_zero_vector_is_zero() {
        for x in [1.0, -1.0, 0.0, -0.0] {
            assert_eq!(angle_between(DVec3::ZERO, DVec3::splat(x)), 0.0);
            assert_eq!(angle_between(DVec3::splat(x), DVec3::ZERO), 0.0);
        }
    }

    #[test]
    fn measures_of_very_small_and_very_large_elements_are_right() {
        for exponent in [-500, -300, 300, 500] {
            let mut cube = shapes::cube();
            for p in cube.positions_mut() {
                *p *= libm::scalbn(1.0, exponent);
            }
            let right = std::f64::consts::FRAC_PI_2;
            let close = |a: f64, b: f64| (a - b).abs() < 1e-15;
            for h in cube.half_edges() {
                assert!(close(cube.corner_angle(h), right));
                assert!(close(cube.dihedral_angle(h.edge()).unwrap(), right));
                assert_eq!(libm::scalbn(cube.length(h), -exponent), 2.0);
            }
            for f in cube.faces() {
                assert_eq!(libm::scalbn(cube.face_area(f), -2 * exponent), 4.0);
            }
        }
    }

    #[test]
    fn the_dihedral_angles_of_a_cube_are_right_angles() {
        let cube = shapes::cube();
        let right = std::f64::consts::FRAC_PI_2;
        assert!(
            cube.edges()
                .all(|e| (cube.dihedral_angle(e).unwrap() - right).abs() < 1e-15)
        );
    }

    #[test]
    fn the_points_of_an_element_are_those_of_its_vertices() {
        let mesh = shapes::square();
        let f = mesh.faces().next().expect("a face");
        let corners: Vec<DVec3> = mesh.face_vertices(f).map(|v| mesh.position(v)).collect();

        assert_eq!(mesh.element_points(f.into()), corners);
        for h in mesh.face_half_edges(f) {
            let ends = [mesh.origin(h), mesh.target(h)].map(|v| mesh.position(v));
            assert_eq!(mesh.element_points(h.into()), ends);
            assert_eq!(mesh.element_points(h.edge().into()).len(), 2);
            assert_eq!(mesh.element_points(mesh.origin(h).into()), ends[..1]);
        }
    }

    #[test]
    fn a_missing_element_has_no_points() {
        let mesh = shapes::square();

        for element in [
            VertexId::new(99).into(),
            EdgeId::new(99).into(),
            HalfEdgeId::new(99).into(),
            FaceId::new(99).into(),
        ] {
            assert!(mesh.element_points(element).is_empty(), "{element}");
        }
    }
}
