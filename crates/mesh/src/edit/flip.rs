//! Flipping the edge between two faces.

use crate::{EdgeId, EditError, HalfEdgeId, Mesh};

/// How an edit handles an edge whose corner attributes differ between its two sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Seams {
    /// Refuse the edit with [`EditError::Seam`].
    #[default]
    Refuse,
    /// Do the edit, although some values are lost. Each edit documents which values remain.
    Drop,
}

impl Mesh {
    /// Flips the edge between two faces. Together, the two faces form a polygon. The edge rotates counter-clockwise
    /// inside this polygon: each end moves to the next corner.
    ///
    /// ```text
    ///        c                   c                 +-----c           +-----c
    ///      / f \               / ^ \               |  f  |           |  f  |\
    ///    a --e-> b    -->    a f e g b            a--e->b    -->    a     | b
    ///      \ g /               \ | /               |  g  |            \ g  | |
    ///        d                   d                 d-----+             d----+     (e from d to c)
    /// ```
    ///
    /// Between two triangles, the edge becomes the other diagonal of the quadrilateral that the triangles form. After
    /// four flips of an edge between two triangles, the mesh is as before, except that vertices and faces possibly
    /// store different half-edges. All ids stay the same. Before the flip, `e` runs from a to b; afterwards, it runs
    /// from d to c. Before the flip, c follows b on face f, and d follows a on face g. The first half-edge of `e` stays
    /// on f. Attributes of vertices, edges and faces stay with their ids. The new corners at c and d get the values of
    /// the corner at the same vertex in the other face.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Boundary`] if `e` has a face on only one side, and [`EditError::SameFace`] if the same face
    /// is on both sides. Returns [`EditError::FewEdges`] if an end of `e` has only two edges. Let c and d be the
    /// vertices to which the ends of `e` would move. Returns [`EditError::SameOpposite`] if c is d, and
    /// [`EditError::DuplicateEdge`] if c and d already share an edge. Returns [`EditError::Seam`] if corner attributes
    /// differ across `e`, and [`EditError::NoSuchEdge`] if `e` does not exist. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// use geometry::shapes;
    /// use mesh::EditError;
    ///
    /// let mut mesh = shapes::octahedron();
    /// let e = mesh.edges().next().unwrap();
    /// mesh.flip_edge(e)?;
    /// assert!(mesh.defects().is_empty());
    /// # Ok::<(), EditError>(())
    /// ```
    pub fn flip_edge(&mut self, e: EdgeId) -> Result<(), EditError> {
        self.flip_edge_with(e, Seams::Refuse)
    }

    /// Flips an edge like [`flip_edge`](Self::flip_edge). `seams` decides what happens if corner attributes differ
    /// across the edge (a seam): the flip is refused, or the values of one side are dropped.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`flip_edge`](Self::flip_edge), but [`EditError::Seam`] only if `seams` is
    /// [`Seams::Refuse`].
    pub fn flip_edge_with(&mut self, e: EdgeId, seams: Seams) -> Result<(), EditError> {
        self.check_edge(e)?;
        let [ab, ba] = e.half_edges();
        let (Some(f), Some(g)) = (self.face(ab), self.face(ba)) else {
            return Err(EditError::Boundary(e));
        };
        let (bc, ad) = (self.next(ab), self.next(ba));
        let (after_c, after_d) = (self.next(bc), self.next(ad));
        let (before_a, before_b) = (self.prev_on_face(ab), self.prev_on_face(ba));
        let (a, b) = (self.origin(ab), self.origin(ba));
        let (c, d) = (self.origin(after_c), self.origin(after_d));
        if f == g {
            return Err(EditError::SameFace(e));
        }
        if c == d {
            return Err(EditError::SameOpposite(e, c));
        }
        for (before, after, v) in [(before_a, ad, a), (before_b, bc, b)] {
            if before == after.twin() {
                return Err(EditError::FewEdges(v));
            }
        }
        if self.share_an_edge(after_c, after_d) {
            return Err(EditError::DuplicateEdge(c, d));
        }
        if seams == Seams::Refuse && self.is_seam(e) {
            return Err(EditError::Seam(e));
        }

        // After the flip, face f has the half-edges d -> c and a -> d, and face g has c -> d and b -> c.
        self.drop_columns_by_rule();
        self.copy_values(ab, ad);
        self.copy_values(ba, bc);
        self.copy_values(after_d, ab);
        self.copy_values(after_c, ba);
        for [x, after_x, before_x, moved] in
            [[ab, after_c, before_a, ad], [ba, after_d, before_b, bc]]
        {
            self.set_next(x, after_x);
            self.set_next(before_x, moved);
            self.set_next(moved, x);
        }
        self.replace_first_of_vertex(ab, ad);
        self.replace_first_of_vertex(ba, bc);
        self.set_origin(ab, d);
        self.set_origin(ba, c);
        self.set_face(ad, Some(f));
        self.set_face(bc, Some(g));
        self.set_face_half_edge(f, ab);
        self.set_face_half_edge(g, ba);
        Ok(())
    }

    /// Returns the half-edge before `h` around its face, or around its hole. Walks around the face (or the hole) and
    /// around the origin of `h` at the same time. The time is proportional to the smaller of two numbers: the number of
    /// edges of the face or hole, and the valence of the origin.
    #[inline]
    pub(super) fn prev_on_face(&self, h: HalfEdgeId) -> HalfEdgeId {
        let (mut before, mut around) = (self.next(h), h.twin());
        while self.next(before) != h && self.next(around) != h {
            before = self.next(before);
            around = self.next(around).twin();
        }
        if self.next(before) == h {
            before
        } else {
            around
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FaceId, UV, VertexId, shapes};
    use glam::{DVec2, DVec3};

    /// Returns the mesh of the picture: a = 0, b = 1, c = 2, d = 3; the edge is e0.
    fn rhombus() -> Mesh {
        let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let positions = vec![p(-1., 0.), p(1., 0.), p(0., 1.), p(0., -1.)];
        Mesh::from_polygons(positions, &[[0, 1, 2], [1, 0, 3]])
            .unwrap()
            .0
    }

    fn corners(mesh: &Mesh, f: usize) -> Vec<usize> {
        mesh.face_vertices(FaceId::new(f))
            .map(VertexId::index)
            .collect()
    }

    #[test]
    fn a_flip_replaces_the_edge_by_the_other_diagonal() {
        let mut mesh = rhombus();
        mesh.flip_edge(EdgeId::new(0)).unwrap();
        assert_eq!(mesh.defects(), []);
        assert_eq!(
            mesh.edge_vertices(EdgeId::new(0)).map(VertexId::index),
            [3, 2]
        );
        assert_eq!(
            (corners(&mesh, 0), corners(&mesh, 1)),
            (vec![3, 2, 0], vec![2, 3, 1])
        );
    }

    #[test]
    fn four_flips_restore_the_mesh() {
        let mut mesh = shapes::icosahedron();
        let uvs = mesh
            .half_edges()
            .map(|h| mesh.position(mesh.origin(h)).truncate())
            .collect();
        mesh.set(UV, uvs);
        let before = mesh.clone();
        for e in before.edges() {
            // On an icosahedron, the two vertices opposite an edge never share an edge, so every edge can be flipped.
            for _ in 0..4 {
                mesh.flip_edge(e).unwrap();
                assert_eq!(mesh.defects(), []);
            }
            assert_eq!(mesh.connectivity.next, before.connectivity.next);
            assert_eq!(mesh.connectivity.origin, before.connectivity.origin);
            assert_eq!(mesh.connectivity.face, before.connectivity.face);
            assert_eq!(mesh.attributes, before.attributes);
        }
    }

    #[test]
    fn corner_values_stay_with_their_vertices() {
        let mut mesh = rhombus();
        let uvs: Vec<DVec2> = mesh
            .half_edges()
            .map(|h| mesh.position(mesh.origin(h)).truncate() * 3.0)
            .collect();
        mesh.set(UV, uvs);
        mesh.flip_edge(EdgeId::new(0)).unwrap();
        for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
            let expected = mesh.position(mesh.origin(h)).truncate() * 3.0;
            assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{h}");
        }
    }

    /// Checks that the edit is refused and that the mesh is unchanged. Returns the reason.
    fn refused(mesh: &Mesh, e: EdgeId) -> EditError {
        let mut edited = mesh.clone();
        let reason = edited.flip_edge(e).unwrap_err();
        assert_eq!(&edited, mesh);
        reason
    }

    #[test]
    fn a_boundary_edge_does_not_flip() {
        assert_eq!(
            refused(&rhombus(), EdgeId::new(1)),
            EditError::Boundary(EdgeId::new(1))
        );
    }

    #[test]
    fn an_edge_between_quads_moves_by_one_corner_and_six_flips_restore_the_mesh() {
        let cube = shapes::cube();
        for e in cube.edges() {
            let mut mesh = cube.clone();
            let [h, twin] = e.half_edges();
            let ends = [mesh.target(mesh.next(twin)), mesh.target(mesh.next(h))];
            for n_flips in 1..=6 {
                mesh.flip_edge(e).unwrap();
                assert_eq!(mesh.defects(), []);
                assert!(mesh.faces().all(|f| mesh.degree(f) == 4));
                if n_flips == 1 {
                    assert_eq!(mesh.edge_vertices(e), ends);
                }
            }
            assert_eq!(mesh.connectivity.next, cube.connectivity.next);
            assert_eq!(mesh.connectivity.origin, cube.connectivity.origin);
        }
    }

    #[test]
    fn an_edge_at_a_vertex_with_two_edges_does_not_flip() {
        // The new vertex on the edge of a cube has two edges. A flip of one of these edges would leave the vertex with
        // one edge.
        let mut mesh = shapes::cube();
        let m = mesh.split_edge(EdgeId::new(0), 0.5).unwrap();
        assert_eq!(refused(&mesh, EdgeId::new(0)), EditError::FewEdges(m));
    }

    #[test]
    fn an_edge_whose_opposite_vertices_share_an_edge_does_not_flip() {
        let mesh = shapes::tetrahedron();
        assert!(
            mesh.edges()
                .all(|e| matches!(refused(&mesh, e), EditError::DuplicateEdge(..)))
        );
    }

    #[test]
    fn an_edge_with_one_vertex_opposite_on_both_sides_does_not_flip() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let (mesh, _) = Mesh::from_polygons(positions, &[[0, 1, 2], [0, 2, 1]]).unwrap();
        let e = EdgeId::new(0);
        assert_eq!(
            refused(&mesh, e),
            EditError::SameOpposite(e, VertexId::new(2))
        );
    }

    #[test]
    fn a_seam_flips_only_with_seams_drop() {
        let mut mesh = rhombus();
        let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
        uvs[0] = DVec2::X;
        mesh.set(UV, uvs);
        let e = EdgeId::new(0);
        assert_eq!(refused(&mesh, e), EditError::Seam(e));
        mesh.flip_edge_with(e, Seams::Drop).unwrap();
        assert_eq!(mesh.defects(), []);
    }

    #[test]
    fn a_missing_edge_is_refused() {
        let e = EdgeId::new(99);
        assert_eq!(refused(&rhombus(), e), EditError::NoSuchEdge(e));
        assert_eq!(
            refused(&rhombus(), EdgeId::NONE),
            EditError::NoSuchEdge(EdgeId::NONE)
        );
    }
}
