//! Deleting faces.

use super::{first_repeated, sorted_unique};
use crate::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Deletes a face, which leaves a hole.
    ///
    /// ```text
    ///    +-----+-----+          +-----+
    ///    |  f  |     |    -->         |
    ///    +-----+-----+          +-----+
    /// ```
    ///
    /// Edges that have no other face are deleted too. Vertices are not deleted; a vertex that loses all of its edges
    /// becomes isolated. The ids and attribute values of the remaining elements do not change.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Pinch`] if the remaining faces around a vertex would not form one fan. This error occurs if
    /// the vertex is on the boundary of the mesh, but both edges of `f` at the vertex have another face. Returns
    /// [`EditError::NoSuchFace`] if `f` does not exist. After an error, the mesh is unchanged.
    pub fn delete_face(&mut self, f: FaceId) -> Result<(), EditError> {
        self.delete_faces(&[f])
    }

    /// Deletes several faces at once. If the deletion is refused, none of the faces is deleted.
    ///
    /// ```text
    ///    +---+---+---+                  +---+
    ///    | f | g |   |                  |   |
    ///    +---v---+---+    -->   +---v   +---+       the dotted face is a hole. Deleting f alone would
    ///    |   |...|   |          |   |   |   |       leave two fans at v; deleting f and g leaves one
    ///    +---+---+---+          +---+   +---+
    /// ```
    ///
    /// The mesh is checked only once, as it would be after the deletion of all listed faces. Therefore, a list of faces
    /// can be accepted even if the deletion of one of its faces alone would be refused. Edges that have no other face
    /// are deleted too. Vertices are not deleted; a vertex that loses all of its edges becomes isolated. The ids and
    /// attribute values of the remaining elements do not change. An empty list changes nothing. This function takes
    /// time proportional to the number of listed faces plus the number of edges at their corners.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Pinch`] if the remaining faces around a vertex would not form one fan; the error names the
    /// lowest vertex for which this is the case. Returns [`EditError::FaceListedTwice`] or [`EditError::NoSuchFace`] if
    /// a face is listed twice or does not exist. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// use geometry::shapes;
    /// use mesh::FaceId;
    ///
    /// // Two opposite squares at the middle vertex would be left: two fans.
    /// let mut mesh = shapes::grid(2, 2);
    /// assert!(mesh.delete_faces(&[0, 3].map(FaceId::new)).is_err());
    /// mesh.delete_faces(&[0, 1, 3].map(FaceId::new))?;
    /// assert_eq!((mesh.n_faces(), mesh.n_edges()), (1, 4));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn delete_faces(&mut self, faces: &[FaceId]) -> Result<(), EditError> {
        for &f in faces {
            self.check_face(f)?;
        }
        if let Some(f) = first_repeated(faces) {
            return Err(EditError::FaceListedTwice(f));
        }
        if faces.is_empty() {
            return Ok(());
        }
        let deleted = sorted_unique(faces.iter().copied());
        let is_kept = |h: HalfEdgeId| {
            self.face(h)
                .is_some_and(|f| deleted.binary_search(&f).is_err())
        };
        let sides: Vec<HalfEdgeId> = deleted
            .iter()
            .flat_map(|&f| self.face_half_edges(f))
            .collect();
        let corners = sorted_unique(sides.iter().map(|&h| self.origin(h)));
        let rims = corners
            .iter()
            .map(|&v| self.rim_at(v, is_kept))
            .collect::<Result<Vec<_>, _>>()?;
        let without_face = sides.iter().copied().filter(|h| !is_kept(h.twin()));
        let without_face: Vec<HalfEdgeId> = without_face.collect();

        self.drop_columns_by_rule();
        for (&v, rim) in corners.iter().zip(rims) {
            self.set_vertex_half_edge(v, rim.map(|[_, outgoing]| outgoing));
            if let Some([incoming, outgoing]) = rim {
                self.set_next(incoming, outgoing);
            }
        }
        for h in sides {
            self.set_face(h, None);
        }
        for h in without_face {
            self.kill(h.edge());
        }
        for f in deleted {
            self.kill(f);
        }
        Ok(())
    }

    /// Returns the incoming and the outgoing boundary half-edge of `v` after the deletion; `None` if no face
    /// is left at `v`. `is_kept` tells whether the face of a half-edge is kept.
    ///
    /// ```text
    ///     outgoing    incoming     clockwise around v, `outgoing` is the edge between the last deleted and
    ///         \  kept  /           the first kept face; `incoming` is the edge between the last kept and the
    ///           \    /             first deleted face
    ///   deleted   v   deleted
    /// ```
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Pinch`] if the kept faces would form several fans.
    fn rim_at(
        &self,
        v: VertexId,
        is_kept: impl Fn(HalfEdgeId) -> bool,
    ) -> Result<Option<[HalfEdgeId; 2]>, EditError> {
        let (mut incoming, mut outgoing) = (None, None);
        for h in self.vertex_half_edges(v) {
            match (is_kept(h), is_kept(h.twin())) {
                (true, false) => incoming = Some(h.twin()),
                (false, true) if outgoing.is_some() => return Err(EditError::Pinch(v)),
                (false, true) => outgoing = Some(h),
                _ => {}
            }
        }
        Ok(incoming
            .zip(outgoing)
            .map(|(incoming, outgoing)| [incoming, outgoing]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edit::testing::{checked_edit_mesh, sample_shapes};
    use crate::shapes;

    #[test]
    fn deleting_a_face_of_a_closed_mesh_leaves_one_hole() {
        let mut mesh = shapes::cube();
        mesh.delete_face(FaceId::new(2)).unwrap();
        assert_eq!(mesh.defects(), []);
        assert_eq!(
            (mesh.n_faces(), mesh.n_edges(), mesh.n_boundary_loops()),
            (5, 12, 1)
        );
    }

    #[test]
    fn faces_are_deleted_one_by_one_until_only_isolated_vertices_are_left() {
        for shape in [shapes::grid(3, 3), shapes::cube(), shapes::octahedron()] {
            let mut mesh = shape.clone();
            let mut n_left = shape.n_faces();
            // If the deletion of a face is refused, the face can be deleted later, after its neighbors.
            while n_left > 0 {
                let before = n_left;
                for f in shape.faces() {
                    let unchanged = mesh.clone();
                    match mesh.delete_face(f) {
                        Ok(()) => n_left -= 1,
                        Err(_) => assert_eq!(mesh, unchanged),
                    }
                    assert_eq!(mesh.defects(), []);
                }
                assert!(n_left < before, "it must be possible to delete a face");
            }
            assert_eq!((mesh.n_faces(), mesh.n_edges()), (0, 0));
            assert_eq!(mesh.delete_isolated_vertices(), shape.n_vertices());
        }
    }

    #[test]
    fn a_face_that_would_pinch_a_vertex_is_refused() {
        // The middle face of a 3 x 3 grid is a hole. Each corner face of the grid shares only a vertex with the
        // hole.
        let mut mesh = shapes::grid(3, 3);
        mesh.delete_face(FaceId::new(4)).unwrap();
        let before = mesh.clone();
        let result = mesh.delete_face(FaceId::new(0));
        assert!(matches!(result, Err(EditError::Pinch(_))), "{result:?}");
        assert_eq!(mesh, before);
    }

    #[test]
    fn faces_that_pinch_a_vertex_alone_can_be_deleted_together() {
        let mut mesh = shapes::grid(3, 3);
        mesh.delete_face(FaceId::new(4)).unwrap();
        let [corner, beside] = [0, 1].map(FaceId::new);
        assert!(mesh.clone().delete_face(corner).is_err());
        mesh.delete_faces(&[corner, beside]).unwrap();
        assert_eq!(mesh.defects(), []);
        assert_eq!((mesh.n_faces(), mesh.n_boundary_loops()), (6, 1));
    }

    #[test]
    fn the_order_of_the_faces_does_not_matter() {
        let faces = [5, 0, 3, 8, 7].map(FaceId::new);
        let mut sorted = faces;
        sorted.sort_unstable();
        let [mut a, mut b] = [(); 2].map(|()| shapes::torus(5, 4, 2.0, 1.0));
        assert_eq!(a.delete_faces(&faces), b.delete_faces(&sorted));
        assert_eq!(a, b);
    }

    #[test]
    fn deleting_faces_gives_the_mesh_that_is_built_without_them() {
        for shape in sample_shapes() {
            // Tries to delete every subset of the first eight faces.
            let n = shape.n_faces().min(8);
            for set in 0..1_usize << n {
                let (deleted, kept): (Vec<_>, Vec<_>) = shape
                    .faces()
                    .partition(|f| f.index() < n && set >> f.index() & 1 == 1);
                let corner = |v: VertexId| u32::try_from(v.index()).unwrap();
                let kept: Vec<Vec<u32>> = kept
                    .iter()
                    .map(|&f| shape.face_vertices(f).map(corner).collect())
                    .collect();
                let (built, report) =
                    Mesh::from_polygons(shape.positions().to_vec(), &kept).unwrap();
                let mut mesh = shape.clone();
                let result = mesh.delete_faces(&deleted);
                assert_eq!(mesh.defects(), []);
                // If two fans would be left at a vertex, the builder splits the vertex and reports this repair, but the
                // deletion is refused.
                assert_eq!(result.is_ok(), report.is_clean(), "{result:?}");
                if let Err(error) = result {
                    assert!(matches!(error, EditError::Pinch(_)));
                    assert_eq!(mesh, shape);
                } else {
                    let counts = |m: &Mesh| {
                        [
                            m.n_vertices(),
                            m.n_edges(),
                            m.n_faces(),
                            m.n_boundary_loops(),
                        ]
                    };
                    assert_eq!(counts(&mesh), counts(&built));
                }
            }
        }
    }

    #[test]
    fn deleting_any_face_can_be_undone_and_redone() {
        for shape in sample_shapes() {
            for f in shape.faces() {
                let error = checked_edit_mesh(&shape, |mesh| mesh.delete_face(f)).err();
                // Finds the corners of the face at boundary vertices where neither side of the face is a boundary edge.
                let pinched = shape.face_half_edges(f).filter(|&h| {
                    let sides = [h, shape.prev(h)].map(|h| shape.is_boundary_edge(h.edge()));
                    shape.is_boundary_vertex(shape.origin(h)) && sides == [false; 2]
                });
                let lowest = pinched.map(|h| shape.origin(h)).min();
                assert_eq!(error, lowest.map(EditError::Pinch));
            }
        }
    }

    #[test]
    fn missing_faces_and_faces_listed_twice_are_refused() {
        let mut mesh = shapes::cube();
        let [f, g, missing] = [0, 1, 6].map(FaceId::new);
        let twice = Err(EditError::FaceListedTwice(f));
        assert_eq!(mesh.delete_faces(&[f, g, f]), twice);
        assert_eq!(
            mesh.delete_faces(&[f, missing]),
            Err(EditError::NoSuchFace(missing))
        );
        assert_eq!(mesh.delete_faces(&[]), Ok(()));
        assert_eq!(mesh, shapes::cube());
    }
}
