//! Removing an edge and merging its two faces.

use crate::{EdgeId, EditError, FaceId, HalfEdgeId, Mesh, Seams, VertexId};

impl Mesh {
    /// Removes an edge and merges the faces beside it.
    ///
    /// ```text
    ///    +-----b-----+          +-----b-----+
    ///    |  f  e  g  |   -->    |     f     |
    ///    +-----a-----+          +-----a-----+
    /// ```
    ///
    /// The face with the lower id remains and keeps its values; `e` and the other face are removed. Because one edge
    /// and one face are removed, the Euler characteristic V - E + F stays the same. All other ids and values stay the
    /// same. This edit is the inverse of [`split_face`](Self::split_face).
    ///
    /// Returns the remaining face.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Boundary`] if `e` has a face on only one side, and [`EditError::SameFace`] if the same face
    /// is on both sides. Returns [`EditError::FewEdges`] if an end of `e` has only two edges (remove that vertex first,
    /// with [`dissolve_vertex`](Self::dissolve_vertex)). Returns [`EditError::RepeatedVertex`] if the faces have
    /// another vertex in common, and [`EditError::Seam`] if corner attributes differ across `e`. Returns
    /// [`EditError::NoSuchEdge`] if `e` does not exist. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::cube();
    /// let e = mesh.edges().next().unwrap();
    /// let f = mesh.dissolve_edge(e)?;
    /// assert_eq!((mesh.n_faces(), mesh.degree(f)), (5, 6));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn dissolve_edge(&mut self, e: EdgeId) -> Result<FaceId, EditError> {
        self.dissolve_edge_with(e, Seams::Refuse)
    }

    /// Removes an edge like [`dissolve_edge`](Self::dissolve_edge); `seams` decides what happens if corner attributes
    /// differ across the edge (a seam). With [`Seams::Drop`], the edge is removed, and the corners at its ends keep the
    /// values of the remaining face.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`dissolve_edge`](Self::dissolve_edge), but [`EditError::Seam`] only if
    /// `seams` is [`Seams::Refuse`].
    pub fn dissolve_edge_with(&mut self, e: EdgeId, seams: Seams) -> Result<FaceId, EditError> {
        self.check_edge(e)?;
        let sides = e.half_edges();
        let [Some(f), Some(g)] = self.edge_faces(e) else {
            return Err(EditError::Boundary(e));
        };
        if f == g {
            return Err(EditError::SameFace(e));
        }
        // f is the remaining face, and ab is the half-edge of e on f.
        let ([ab, ba], [f, g]) = if f < g {
            (sides, [f, g])
        } else {
            ([sides[1], sides[0]], [g, f])
        };
        let (before_a, before_b) = (self.prev_on_face(ab), self.prev_on_face(ba));
        let (after_a, after_b) = (self.next(ba), self.next(ab));
        for (before, after, v) in [(before_a, after_a, ab), (before_b, after_b, ba)] {
            if before == after.twin() {
                return Err(EditError::FewEdges(self.origin(v)));
            }
        }
        if let Some(v) = self.other_common_corner(ab) {
            return Err(EditError::RepeatedVertex(v));
        }
        if seams == Seams::Refuse && self.is_seam(e) {
            return Err(EditError::Seam(e));
        }

        self.drop_columns_by_rule();
        // At the end b, the half-edge of f remains. At the end a, the half-edge of the removed face g remains instead,
        // so it gets the values of the corner of f at this end.
        self.copy_values(ab, after_a);
        let moved: Vec<HalfEdgeId> = self.face_half_edges(g).collect();
        for h in moved {
            self.set_face(h, Some(f));
        }
        self.set_next(before_a, after_a);
        self.set_next(before_b, after_b);
        self.replace_first_of_vertex(ab, after_a);
        self.replace_first_of_vertex(ba, after_b);
        self.replace_first_of_face(ab, after_b);
        self.kill(e);
        self.kill(g);
        Ok(f)
    }

    /// Returns a common vertex of the two faces beside the edge of `h`, other than the ends of that edge.
    /// Searches around the corners of the smaller face, so that merging many small faces into a large face is
    /// fast.
    fn other_common_corner(&self, h: HalfEdgeId) -> Option<VertexId> {
        let (mut x, mut y) = (self.next(h), self.next(h.twin()));
        while x != h && y != h.twin() {
            (x, y) = (self.next(x), self.next(y));
        }
        let small = if x == h { h } else { h.twin() };
        let large = self.face(small.twin());
        let ends = [self.origin(h), self.target(h)];
        self.loop_half_edges(small)
            .map(|x| self.origin(x))
            .filter(|v| !ends.contains(v))
            .find(|&v| self.vertex_half_edges(v).any(|x| self.face(x) == large))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edit::testing::{
        checked_edit_mesh, polygons, ring, sample_shapes, spur, with_attributes,
    };
    use crate::{COLOR, MATERIAL, UV, shapes};
    use glam::DVec2;

    /// Checks that the edit is refused and that the mesh is unchanged. Returns the reason.
    fn refused(mesh: &Mesh, e: EdgeId) -> EditError {
        checked_edit_mesh(mesh, |mesh| mesh.dissolve_edge(e).map(drop)).unwrap_err()
    }

    /// Returns the edge between two vertices.
    fn between(mesh: &Mesh, v: usize, w: usize) -> EdgeId {
        let h = mesh.find_half_edge(VertexId::new(v), VertexId::new(w));
        h.expect("the vertices share an edge").edge()
    }

    #[test]
    fn two_squares_become_one_face_with_six_corners() {
        let mut mesh = shapes::grid(2, 1);
        let e = between(&mesh, 1, 4);
        assert_eq!(mesh.dissolve_edge(e), Ok(FaceId::new(0)));
        assert_eq!(mesh.defects(), []);
        assert_eq!(polygons(&mesh), [[0, 1, 2, 5, 4, 3]]);
        assert!(!mesh.has_edge(e) && !mesh.has_face(FaceId::new(1)));
    }

    #[test]
    fn the_face_with_the_lower_id_remains_on_either_side() {
        let cube = shapes::cube();
        for e in cube.edges() {
            let mut mesh = cube.clone();
            mesh.set(MATERIAL, (0..6).collect());
            let lower = cube.edge_faces(e).into_iter().flatten().min().unwrap();
            assert_eq!(mesh.dissolve_edge(e), Ok(lower));
            assert_eq!(
                mesh.get(MATERIAL).unwrap()[lower.index()],
                i32::try_from(lower.index()).unwrap()
            );
            assert_eq!(mesh.degree(lower), 6);
        }
    }

    #[test]
    fn it_is_the_inverse_of_split_face() {
        for shape in sample_shapes() {
            for f in shape.faces() {
                let sides: Vec<HalfEdgeId> = shape.face_half_edges(f).collect();
                for (&x, &y) in sides.iter().flat_map(|x| sides.iter().map(move |y| (x, y))) {
                    let mut mesh = shape.clone();
                    let Ok(e) = mesh.split_face(x, y) else {
                        continue;
                    };
                    assert_eq!(mesh.dissolve_edge(e), Ok(f));
                    assert_eq!(mesh.defects(), []);
                    mesh.compact();
                    assert_eq!(polygons(&mesh), polygons(&shape));
                    assert_eq!(mesh.get(UV), shape.get(UV));
                    assert_eq!(mesh.get(COLOR), shape.get(COLOR));
                    assert_eq!(mesh.get(MATERIAL), shape.get(MATERIAL));
                    for h in shape.half_edges() {
                        assert_eq!(
                            (mesh.next(h), mesh.origin(h)),
                            (shape.next(h), shape.origin(h))
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn every_edge_of_every_shape_dissolves_if_it_has_two_faces_and_is_not_a_seam() {
        for shape in sample_shapes() {
            for e in shape.edges() {
                let expected = match shape.edge_faces(e) {
                    [Some(_), Some(_)] if shape.is_seam(e) => Err(EditError::Seam(e)),
                    [Some(_), Some(_)] => Ok(()),
                    _ => Err(EditError::Boundary(e)),
                };
                let result = checked_edit_mesh(&shape, |mesh| mesh.dissolve_edge(e).map(drop));
                if let Ok(mesh) = &result {
                    assert_eq!(mesh.euler_characteristic(), shape.euler_characteristic());
                    assert_eq!(mesh.n_boundary_loops(), shape.n_boundary_loops());
                    assert_eq!(mesh.n_faces() + 1, shape.n_faces());
                }
                assert_eq!(result.map(drop), expected);
            }
        }
    }

    #[test]
    fn a_seam_is_dropped_only_with_seams_drop() {
        let seam = with_attributes(shapes::grid(2, 1));
        let e = between(&seam, 1, 4);
        assert_eq!(refused(&seam, e), EditError::Seam(e));
        let mut mesh = seam.clone();
        let f = mesh.dissolve_edge_with(e, Seams::Drop).unwrap();
        for h in mesh.face_half_edges(f) {
            let v = mesh.origin(h);
            // All corners of face 0 keep their values, including the corners at the ends of the edge.
            let shift = if [2, 5].contains(&v.index()) {
                10.0
            } else {
                0.0
            };
            let expected = mesh.position(v).truncate() + DVec2::splat(shift);
            assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{v}");
        }
    }

    #[test]
    fn an_edge_at_a_vertex_with_two_edges_is_refused() {
        let mut mesh = shapes::cube();
        let e = EdgeId::new(0);
        let m = mesh.split_edge(e, 0.5).unwrap();
        assert_eq!(refused(&mesh, e), EditError::FewEdges(m));
        mesh.dissolve_vertex(m).unwrap();
        mesh.dissolve_edge(e).unwrap();
    }

    #[test]
    fn faces_with_another_common_vertex_are_not_merged() {
        // The tube has three squares. Two of these squares are merged into one face. After this merge, both side edges
        // of the third square are edges of the merged face.
        let mut tube = shapes::cylinder(3, false);
        tube.dissolve_edge(between(&tube, 1, 4)).unwrap();
        let refused = refused(&tube, between(&tube, 2, 5));
        assert!(matches!(refused, EditError::RepeatedVertex(v) if [0, 3].contains(&v.index())));
    }

    #[test]
    fn an_edge_with_one_face_on_both_sides_is_refused() {
        let e = EdgeId::new(3);
        assert_eq!(refused(&ring(), e), EditError::SameFace(e));
        let e = EdgeId::new(4);
        assert_eq!(refused(&spur(), e), EditError::SameFace(e));
    }

    #[test]
    fn a_missing_edge_is_refused() {
        let e = EdgeId::new(12);
        assert_eq!(refused(&shapes::cube(), e), EditError::NoSuchEdge(e));
    }
}
