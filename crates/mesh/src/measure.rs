//! Measures: how large a mesh is, and of what kind.

use glam::DVec3;

use crate::{FaceId, HalfEdgeId, Mesh, VertexId, blocks};

/// The angle between two directions, from 0 to π; 0 if one of them is zero.
///
/// By the arc tangent of sine and cosine, which is exact for small and for flat angles, where the
/// arc cosine is not: Kahan, "How Futile are Mindless Assessments of Roundoff", 2006, §12.
pub fn angle_between(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b))
}

/// Sine and cosine of an angle in degrees, exact for multiples of 90, and the same bits on every platform.
pub fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let degrees = degrees % 360.0; // the remainder is exact
    match degrees.abs() {
        0.0 => (0.0, 1.0),
        90.0 => (degrees.signum(), 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-degrees.signum(), 0.0),
        _ => libm::sincos(degrees.to_radians()),
    }
}

impl Mesh {
    /// The area vector of a face: its length is the area, its direction the normal.
    ///
    /// Half the sum of the cross products of consecutive corners, taken from the first corner: Newell's
    /// method, exact for flat polygons; for others it is the area of the projection along the normal.
    pub fn area_vector(&self, f: FaceId) -> DVec3 {
        let mut corners = self.face_vertices(f).map(|v| self.position(v));
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

    /// The area of a face: the length of its [area vector](Self::area_vector).
    pub fn face_area(&self, f: FaceId) -> f64 {
        self.area_vector(f).length()
    }

    /// The unit normal of a face, zero if it has no area.
    pub fn face_normal(&self, f: FaceId) -> DVec3 {
        self.area_vector(f).normalize_or_zero()
    }

    /// The mean of the corners of a face.
    pub fn face_center(&self, f: FaceId) -> DVec3 {
        let (n, sum) = self
            .face_vertices(f)
            .fold((0.0, DVec3::ZERO), |(n, sum), v| {
                (n + 1.0, sum + self.position(v))
            });
        sum / n
    }

    /// The length of the edge of `h`.
    pub fn length(&self, h: HalfEdgeId) -> f64 {
        self.position(self.origin(h))
            .distance(self.position(self.target(h)))
    }

    /// The angle of face `f` at the corner of `h`, its half-edge that leaves the corner; in radians.
    pub fn corner_angle(&self, h: HalfEdgeId) -> f64 {
        let p = self.position(self.origin(h));
        let next = self.position(self.target(h));
        let before = self.position(self.origin(self.prev(h)));
        angle_between(next - p, before - p)
    }

    /// The angle between the normals of the faces beside an edge, in radians from 0 (flat) to π;
    /// `None` on the boundary or if a face has no area.
    pub fn dihedral_angle(&self, e: crate::EdgeId) -> Option<f64> {
        let [f, g] = self.edge_faces(e);
        let (n, m) = (self.face_normal(f?), self.face_normal(g?));
        (n != DVec3::ZERO && m != DVec3::ZERO).then(|| angle_between(n, m))
    }

    /// The sum of the areas of all faces.
    pub fn area(&self) -> f64 {
        self.sum_over_faces(|f| self.face_area(f))
    }

    /// The volume inside the mesh; negative if the faces are seen from the inside. Only meaningful for
    /// a closed mesh.
    ///
    /// The sum of the signed volumes of tetrahedra from a fixed point to the triangles of a fan of
    /// each face, by the divergence theorem. The point is the middle of the bounds, so that meshes far
    /// from the origin lose no digits.
    pub fn volume(&self) -> f64 {
        let middle = self
            .bounds()
            .map_or(DVec3::ZERO, |[min, max]| 0.5 * (min + max));
        self.sum_over_faces(|f| {
            let mut corners = self.face_vertices(f).map(|v| self.position(v) - middle);
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

    fn sum_over_faces(&self, term: impl Fn(FaceId) -> f64 + Sync) -> f64 {
        blocks::sum(self.connectivity.face_half_edge.len(), |i| {
            let f = FaceId::new(i);
            if self.has_face(f) { term(f) } else { 0.0 }
        })
    }

    /// The smallest and the largest coordinates of all vertices; `None` for a mesh without vertices.
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        let bounds = |v: usize| {
            let v = VertexId::new(v);
            self.has_vertex(v).then(|| [self.position(v); 2])
        };
        blocks::fold(self.positions.len(), None, bounds, |a, b| match (a, b) {
            (Some([min, max]), Some([low, high])) => Some([min.min(low), max.max(high)]),
            (a, b) => a.or(b),
        })
    }

    /// V - E + F, with isolated vertices counted.
    pub fn euler_characteristic(&self) -> i64 {
        let count = |n: usize| i64::try_from(n).expect("fewer than 2^32 elements");
        count(self.n_vertices()) - count(self.n_edges()) + count(self.n_faces())
    }

    /// The number of handles of all components together, by χ = 2c - 2g - b: c the components with
    /// faces, b the boundary loops, χ without isolated vertices.
    pub fn genus(&self) -> i64 {
        let count = |n: usize| i64::try_from(n).expect("fewer than 2^32 elements");
        let isolated = count(self.n_isolated_vertices());
        let euler = self.euler_characteristic() - isolated;
        let components = count(self.n_components()) - isolated;
        (2 * components - count(self.n_boundary_loops()) - euler) / 2
    }

    /// The number of vertices without edges.
    pub fn n_isolated_vertices(&self) -> usize {
        self.vertices()
            .filter(|&v| self.vertex_half_edge(v).is_none())
            .count()
    }

    /// Whether no edge is on the boundary.
    pub fn is_closed(&self) -> bool {
        self.edges().all(|e| !self.is_boundary_edge(e))
    }

    /// One half-edge of each loop around a hole, in order of ids.
    pub fn boundary_loops(&self) -> Vec<HalfEdgeId> {
        let mut seen = vec![false; self.connectivity.next.len()];
        let mut loops = Vec::new();
        for h in self.half_edges().filter(|&h| self.face(h).is_none()) {
            if !seen[h.index()] {
                loops.push(h);
                for h in self.loop_half_edges(h) {
                    seen[h.index()] = true;
                }
            }
        }
        loops
    }

    /// The number of holes.
    pub fn n_boundary_loops(&self) -> usize {
        self.boundary_loops().len()
    }

    /// For each vertex (by index, dead ones too) the number of its component, from 0 in order of the
    /// lowest vertex; an isolated vertex is a component of its own.
    pub fn components(&self) -> Vec<usize> {
        let mut component = vec![usize::MAX; self.positions.len()];
        let mut n = 0;
        let mut stack = Vec::new();
        for v in self.vertices() {
            if component[v.index()] != usize::MAX {
                continue;
            }
            component[v.index()] = n;
            stack.push(v);
            while let Some(v) = stack.pop() {
                for w in self.vertex_neighbors(v) {
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

    /// The number of connected parts, isolated vertices counted.
    pub fn n_components(&self) -> usize {
        let components = self.components();
        components
            .iter()
            .filter(|&&c| c != usize::MAX)
            .max()
            .map_or(0, |&last| last + 1)
    }

    /// How many vertices have each valence: entry n counts those with n edges.
    pub fn valences(&self) -> Vec<usize> {
        let mut counts = Vec::new();
        for v in self.vertices() {
            let n = self.valence(v);
            counts.resize(counts.len().max(n + 1), 0);
            counts[n] += 1;
        }
        counts
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
        assert!((cube.area() - 6.0).abs() < 1e-8);
        assert!((cube.volume() - 1.0).abs() < 1e-8);
        assert_eq!(
            cube.bounds(),
            Some([DVec3::splat(1e6 - 0.5), DVec3::splat(1e6 + 0.5)])
        );
    }

    #[test]
    fn the_volume_of_a_mesh_turned_inside_out_is_negative() {
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
        assert_eq!(inside_out.volume(), -cube.volume());
    }

    #[test]
    fn genus_and_loops_tell_the_kinds_of_surfaces_apart() {
        let kind = |m: &Mesh| {
            (
                m.euler_characteristic(),
                m.genus(),
                m.n_boundary_loops(),
                m.n_components(),
            )
        };
        assert_eq!(kind(&shapes::cube()), (2, 0, 0, 1));
        assert_eq!(kind(&shapes::torus(6, 4, 2.0, 0.5)), (0, 1, 0, 1));
        assert_eq!(kind(&shapes::grid(3, 2)), (1, 0, 1, 1));
        assert_eq!(kind(&Mesh::default()), (0, 0, 0, 0));
        let mut tube = shapes::cube();
        tube.delete_face(FaceId::new(0)).unwrap();
        let opposite = tube
            .faces()
            .find(|&f| tube.face_vertices(f).all(|v| !tube.is_boundary_vertex(v)));
        tube.delete_face(opposite.unwrap()).unwrap();
        assert_eq!(kind(&tube), (0, 0, 2, 1));
    }

    #[test]
    fn isolated_vertices_change_neither_genus_nor_loops() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let (mesh, _) = Mesh::from_polygons(points, &[[0, 1, 2]]).unwrap();
        assert_eq!(
            (mesh.genus(), mesh.n_boundary_loops(), mesh.n_components()),
            (0, 1, 2)
        );
    }

    #[test]
    fn angle_defects_of_a_closed_mesh_sum_to_two_pi_times_the_euler_characteristic() {
        for mesh in [shapes::icosahedron(), shapes::torus(5, 4, 3.0, 1.0)] {
            let angles: f64 = mesh.half_edges().map(|h| mesh.corner_angle(h)).sum();
            let n = mesh.n_vertices() as f64;
            // Quads of the torus are flat, so their angles sum to 2 pi, like those of two triangles.
            let defect = 2.0 * std::f64::consts::PI * n - angles;
            let expected = 2.0 * std::f64::consts::PI * mesh.euler_characteristic() as f64;
            assert!((defect - expected).abs() < 1e-9, "{defect} {expected}");
        }
    }

    #[test]
    fn valences_are_counted() {
        assert_eq!(shapes::icosahedron().valences(), [0, 0, 0, 0, 0, 12]);
        assert_eq!(shapes::grid(1, 1).valences(), [0, 0, 4]);
    }

    #[test]
    fn the_edges_of_a_cube_turn_by_a_right_angle() {
        let cube = shapes::cube();
        let right = std::f64::consts::FRAC_PI_2;
        assert!(
            cube.edges()
                .all(|e| (cube.dihedral_angle(e).unwrap() - right).abs() < 1e-15)
        );
    }
}
