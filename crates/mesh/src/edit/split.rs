//! Splitting an edge by a vertex.

use crate::{Domain, EdgeId, EditError, Mesh, VertexId};

impl Mesh {
    /// Splits `e` by a vertex and joins the vertex to the opposite corners of the triangles beside `e`.
    ///
    /// ```text
    ///        c                 c
    ///      / f \             / | \
    ///    a --e-> b   -->   a-e-m-->b       m = (1 - t) a + t b
    ///      \ g /             \ | /
    ///        d                 d
    /// ```
    ///
    /// `e` keeps its id and becomes a-m. The new elements are, in this order, the edges m-b, m-c (on the side of the
    /// first half-edge of `e`) and m-d, and the faces at b: (m, b, c) and (b, m, d). f and g become the triangles at a.
    /// A side without a face gets no new edge. A face with more than three corners is not cut: it gains m as a corner.
    /// Inside a triangle mesh, the numbers of vertices, edges and faces grow by 1, 3 and 2; on its boundary by 1, 2
    /// and 1.
    ///
    /// Vertex attributes at m are interpolated between a and b. The values of a corner at m are interpolated within its
    /// face, separately on each side of a seam. The edge m-b has the values of `e`. Each new face has the values of the
    /// face from which it was cut, f or g.
    ///
    /// If both triangles have the same opposite vertex (c is d), two edges join m and c.
    ///
    /// Returns m.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::OutsideEdge`] if `t` is not strictly between 0 and 1. Returns [`EditError::NoSuchEdge`] if
    /// `e` does not exist, and [`EditError::Full`] if there are not enough ids for the new elements. After an error,
    /// the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::tetrahedron();
    /// let e = mesh.edges().next().unwrap();
    /// let m = mesh.split_edge(e, 0.5)?;
    /// assert_eq!(mesh.valence(m), 4);
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn split_edge(&mut self, e: EdgeId, t: f64) -> Result<VertexId, EditError> {
        self.check_edge(e)?;
        self.check_room(6)?;
        let [am, ma] = e.half_edges();
        let cuts = [am, ma].map(|h| self.face(h).is_some_and(|f| self.is_triangle(f)));

        let [mb, bm] = self.insert_vertex(e, t)?.half_edges();
        // Each triangle beside e is cut from the new vertex m to its opposite corner. The part of the triangle at b
        // becomes a new face.
        if cuts[0] {
            let opposite = self.next(self.next(mb));
            self.insert_edge(mb, opposite, mb);
        }
        if cuts[1] {
            let opposite = self.next(self.next(ma));
            self.insert_edge(ma, opposite, bm);
        }
        Ok(self.origin(mb))
    }

    /// Splits `e`, which runs from a to b, by a vertex m. Unlike [`split_edge`](Self::split_edge), this edit does not
    /// cut the faces beside `e`: m becomes an additional corner of these faces, even of triangles.
    ///
    /// Returns the new edge m-b, whose first half-edge starts at m.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`split_edge`](Self::split_edge).
    pub fn insert_vertex(&mut self, e: EdgeId, t: f64) -> Result<EdgeId, EditError> {
        self.check_edge(e)?;
        if !(t > 0.0 && t < 1.0) {
            return Err(EditError::OutsideEdge(t));
        }
        self.check_room(2)?;
        let [am, ma] = e.half_edges();
        let (a, b) = (self.origin(am), self.origin(ma));
        let (after_b, before_b) = (self.next(am), self.prev(ma));
        self.drop_columns_by_rule();
        let m = self.push_vertex((1.0 - t) * self.position(a) + t * self.position(b));
        self.mix_values(a, b, t, m);

        // Add the new edge m-b, whose half-edges lie on the same faces as the half-edges of e.
        let new = self.push_edge(m, b);
        self.copy_values(e, new);
        let [mb, bm] = new.half_edges();
        self.set_face(mb, self.face(am));
        self.set_face(bm, self.face(ma));
        self.copy_values(ma, bm);
        self.mix_values(am, after_b, t, mb);
        // The half-edge from m to vertex a now stores the corner at m, and the half-edge from b to m stores the corner
        // at b. The values at m are interpolated between the corners at vertex b and at vertex a.
        let at_a = self.next(ma);
        self.mix_values(bm, at_a, 1.0 - t, ma);
        self.set_next(am, mb);
        if after_b == ma {
            // b has no other edge than e.
            self.set_next(mb, bm);
        } else {
            self.set_next(mb, after_b);
            self.set_next(before_b, bm);
        }
        self.set_next(bm, ma);
        self.replace_first_of_vertex(ma, bm);
        self.set_origin(ma, m);
        self.set_vertex_half_edge(m, Some(if self.face(ma).is_none() { ma } else { mb }));
        Ok(new)
    }

    /// Deletes all isolated vertices and returns their number.
    pub fn delete_isolated_vertices(&mut self) -> usize {
        let n = self.n_vertices();
        for v in 0..self.domain_len(Domain::Vertex) {
            if self.vertex_half_edge(VertexId::new(v)).is_none() {
                self.kill(VertexId::new(v));
            }
        }
        n - self.n_vertices()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{COLOR, CREASE, MATERIAL, UV, VERTEX_NORMAL, shapes};
    use glam::{DVec2, DVec3, DVec4};

    fn triangles(polygons: &[[u32; 3]]) -> Mesh {
        let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let positions = vec![p(-1., 0.), p(1., 0.), p(0., 1.), p(0., -1.)];
        Mesh::from_polygons(positions, polygons).unwrap().0
    }

    fn split(mesh: &mut Mesh, e: usize, t: f64) -> VertexId {
        let before = mesh.euler_characteristic();
        let m = mesh.split_edge(EdgeId::new(e), t).unwrap();
        assert_eq!(mesh.defects(), []);
        assert_eq!(mesh.euler_characteristic(), before);
        m
    }

    #[test]
    fn splitting_an_edge_of_one_triangle_gives_ten_half_edges() {
        for e in 0..3 {
            let mut mesh = triangles(&[[0, 1, 2]]);
            split(&mut mesh, e, 0.5);
            assert_eq!(mesh.n_half_edges(), 10);
        }
    }

    #[test]
    fn splitting_the_edge_of_two_triangles_gives_sixteen_half_edges() {
        let mut mesh = triangles(&[[0, 1, 2], [1, 0, 3]]);
        let m = split(&mut mesh, 0, 0.5);
        assert_eq!(mesh.n_half_edges(), 16);
        assert_eq!(mesh.valence(m), 4);
        assert_eq!(mesh.n_faces(), 4);
        assert!(mesh.faces().all(|f| mesh.is_triangle(f)));
    }

    #[test]
    fn ids_are_given_as_documented() {
        let mut mesh = triangles(&[[0, 1, 2], [1, 0, 3]]);
        let m = split(&mut mesh, 0, 0.25);
        assert_eq!(mesh.position(m), DVec3::new(-0.5, 0.0, 0.0));
        let ends = |e| mesh.edge_vertices(EdgeId::new(e)).map(VertexId::index);
        assert_eq!(
            [ends(0), ends(5), ends(6), ends(7)],
            [[0, 4], [4, 1], [4, 2], [4, 3]]
        );
        let corners = |f| -> Vec<usize> {
            let mut c: Vec<_> = mesh
                .face_vertices(crate::FaceId::new(f))
                .map(VertexId::index)
                .collect();
            let low = c.iter().position(|v| v == c.iter().min().unwrap()).unwrap();
            c.rotate_left(low);
            c
        };
        assert_eq!([corners(0), corners(1)], [[0, 4, 2], [0, 3, 4]]);
        assert_eq!([corners(2), corners(3)], [[1, 2, 4], [1, 4, 3]]);
    }

    #[test]
    fn every_edge_of_every_shape_can_be_split() {
        for shape in [
            shapes::grid(2, 2),
            shapes::cube(),
            shapes::torus(4, 3, 2.0, 1.0),
        ] {
            for e in 0..shape.n_edges() {
                let mut mesh = shape.clone();
                let m = split(&mut mesh, e, 0.5);
                assert_eq!(
                    mesh.is_boundary_vertex(m),
                    shape.is_boundary_edge(EdgeId::new(e))
                );
            }
        }
    }

    #[test]
    fn quads_beside_the_edge_become_pentagons() {
        let mut mesh = shapes::cube();
        let m = split(&mut mesh, 3, 0.5);
        assert_eq!(mesh.valence(m), 2);
        assert!(mesh.vertex_faces(m).all(|f| mesh.degree(f) == 5));
    }

    #[test]
    fn an_edge_that_ends_inside_a_face_can_be_split() {
        let mut mesh = crate::edit::testing::spur();
        let m = split(&mut mesh, 4, 0.5);
        let around: Vec<_> = mesh.vertex_neighbors(m).map(VertexId::index).collect();
        assert_eq!((around.len(), mesh.degree(crate::FaceId::new(0))), (2, 8));
    }

    #[test]
    fn attributes_follow_their_rules() {
        let mut mesh = triangles(&[[0, 1, 2], [1, 0, 3]]);
        // The corner values are linear on each face, with a seam along the edge.
        let uvs = mesh
            .half_edges()
            .map(|h| {
                let shift = if mesh.face(h) == Some(crate::FaceId::new(1)) {
                    10.0
                } else {
                    0.0
                };
                mesh.position(mesh.origin(h)).truncate() + DVec2::splat(shift)
            })
            .collect();
        mesh.set(UV, uvs);
        mesh.set(COLOR, (0..4).map(|i| DVec4::splat(f64::from(i))).collect());
        mesh.set(VERTEX_NORMAL, vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::Z]);
        mesh.set(MATERIAL, vec![7, 8]);
        mesh.set(CREASE, vec![2.5, 0.0, 0.0, 0.0, 0.0]);
        let m = split(&mut mesh, 0, 0.25);

        for h in mesh.half_edges() {
            let Some(f) = mesh.face(h) else { continue };
            let second = mesh.get(MATERIAL).unwrap()[f.index()] == 8;
            let expected = mesh.position(mesh.origin(h)).truncate()
                + DVec2::splat(if second { 10.0 } else { 0.0 });
            assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{h}");
        }
        assert_eq!(mesh.get(COLOR).unwrap()[m.index()], DVec4::splat(0.25));
        let normal = mesh.get(VERTEX_NORMAL).unwrap()[m.index()];
        assert!((normal - DVec3::new(0.75, 0.25, 0.0).normalize()).length() < 1e-15);
        assert_eq!(mesh.get(MATERIAL).unwrap(), [7, 8, 7, 8]);
        assert_eq!(
            mesh.get(CREASE).unwrap(),
            [2.5, 0.0, 0.0, 0.0, 0.0, 2.5, 0.0, 0.0]
        );
    }

    #[test]
    fn a_position_outside_the_edge_is_refused() {
        let mesh = triangles(&[[0, 1, 2]]);
        for t in [0.0, 1.0, -0.5, 2.0, f64::NAN, f64::INFINITY] {
            let mut edited = mesh.clone();
            let error = edited.split_edge(EdgeId::new(0), t).unwrap_err();
            assert!(matches!(error, EditError::OutsideEdge(_)), "{t}");
            assert_eq!(edited, mesh);
        }
        let mut edited = mesh.clone();
        let e = EdgeId::new(3);
        assert_eq!(edited.split_edge(e, 0.5), Err(EditError::NoSuchEdge(e)));
        assert_eq!(edited, mesh);
    }
}
