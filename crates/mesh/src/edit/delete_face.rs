//! Taking faces away.

use super::{first_repeated, sorted_unique};
use crate::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Takes a face away and leaves a hole.
    ///
    /// ```text
    ///    +-----+-----+          +-----+
    ///    |  f  |     |    -->         |
    ///    +-----+-----+          +-----+
    /// ```
    ///
    /// The face dies, and so do edges that have no other face. Vertices stay, isolated if they have
    /// no other edge. No id changes and no attribute value.
    ///
    /// # Errors
    ///
    /// [`EditError::Pinch`] if the faces left around a corner would not form one fan: its vertex is on
    /// the boundary, but neither edge of `f` there is. [`EditError::NoSuchFace`]. The mesh is unchanged.
    pub fn delete_face(&mut self, f: FaceId) -> Result<(), EditError> {
        self.delete_faces(&[f])
    }

    /// Takes several faces away at once: all of them, or none.
    ///
    /// ```text
    ///    +---+---+---+                  +---+
    ///    | f | g |   |                  |   |
    ///    +---v---+---+    -->   +---v   +---+       f alone would leave two fans at v, at the corner of
    ///    |   |...|   |          |   |   |   |       a hole; f and g together leave one
    ///    +---+---+---+          +---+   +---+
    /// ```
    ///
    /// Faces that could not go alone may go together: only the result counts. The faces die, and so do
    /// edges that have no other face. Vertices stay, isolated if they have no other edge. No id changes
    /// and no attribute value. No faces are nothing to do. Takes time in proportion to the faces named
    /// and the edges at their corners.
    ///
    /// # Errors
    ///
    /// [`EditError::Pinch`] with the lowest vertex around which the faces left would not form one fan,
    /// [`EditError::FaceListedTwice`], [`EditError::NoSuchFace`]. The mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// use geometry::shapes;
    /// use mesh::FaceId;
    ///
    /// // Of four squares around a vertex two opposite ones would be left.
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
        let doomed = sorted_unique(faces.iter().copied());
        let stays = |h: HalfEdgeId| {
            self.face(h)
                .is_some_and(|f| doomed.binary_search(&f).is_err())
        };
        let sides: Vec<HalfEdgeId> = doomed
            .iter()
            .flat_map(|&f| self.face_half_edges(f))
            .collect();
        let corners = sorted_unique(sides.iter().map(|&h| self.origin(h)));
        let rims = corners
            .iter()
            .map(|&v| self.rim_at(v, stays))
            .collect::<Result<Vec<_>, _>>()?;
        let lone: Vec<HalfEdgeId> = sides.iter().copied().filter(|h| !stays(h.twin())).collect();

        self.drop_columns_by_rule();
        for (&v, rim) in corners.iter().zip(rims) {
            self.set_vertex_half_edge(v, rim.map(|[_, out]| out));
            if let Some([into, out]) = rim {
                self.set_next(into, out);
            }
        }
        for h in sides {
            self.set_face(h, None);
        }
        for h in lone {
            self.kill(h.edge());
        }
        for f in doomed {
            self.kill(f);
        }
        Ok(())
    }

    /// The boundary half-edges into `v` and out of it when only the faces of half-edges that `stay` are
    /// left; `None` if none is. An error if these would form several fans.
    ///
    /// ```text
    ///     out   stays   into       walking clockwise around v, `out` is the side from faces that go to
    ///        \    |    /           those that stay, and `into` the twin of that from those to these
    ///          \  |  /
    ///     goes    v    goes
    /// ```
    fn rim_at(
        &self,
        v: VertexId,
        stays: impl Fn(HalfEdgeId) -> bool,
    ) -> Result<Option<[HalfEdgeId; 2]>, EditError> {
        let (mut into, mut out) = (None, None);
        for h in self.vertex_half_edges(v) {
            match (stays(h), stays(h.twin())) {
                (true, false) => into = Some(h.twin()),
                (false, true) if out.is_some() => return Err(EditError::Pinch(v)),
                (false, true) => out = Some(h),
                _ => {}
            }
        }
        Ok(into.zip(out).map(|(into, out)| [into, out]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edit::testing::{shapes_to_try, undone_and_redone};
    use crate::shapes;

    #[test]
    fn a_face_of_a_closed_mesh_leaves_one_hole() {
        let mut mesh = shapes::cube();
        mesh.delete_face(FaceId::new(2)).unwrap();
        assert_eq!(mesh.defects(), []);
        assert_eq!(
            (mesh.n_faces(), mesh.n_edges(), mesh.n_boundary_loops()),
            (5, 12, 1)
        );
    }

    #[test]
    fn faces_go_one_by_one_until_only_isolated_vertices_are_left() {
        for shape in [shapes::grid(3, 3), shapes::cube(), shapes::octahedron()] {
            let mut mesh = shape.clone();
            let mut left = shape.n_faces();
            // A face that is refused now can go later, when its neighbors are gone.
            while left > 0 {
                let before = left;
                for f in shape.faces() {
                    let unchanged = mesh.clone();
                    match mesh.delete_face(f) {
                        Ok(()) => left -= 1,
                        Err(_) => assert_eq!(mesh, unchanged),
                    }
                    assert_eq!(mesh.defects(), []);
                }
                assert!(left < before, "some face can always go");
            }
            assert_eq!((mesh.n_faces(), mesh.n_edges()), (0, 0));
            assert_eq!(mesh.delete_isolated_vertices(), shape.n_vertices());
        }
    }

    #[test]
    fn a_face_that_would_pinch_a_vertex_is_refused() {
        // The middle of a 3 x 3 grid is a hole that shares a vertex with the face at each corner.
        let mut mesh = shapes::grid(3, 3);
        mesh.delete_face(FaceId::new(4)).unwrap();
        let before = mesh.clone();
        let refused = mesh.delete_face(FaceId::new(0));
        assert!(matches!(refused, Err(EditError::Pinch(_))), "{refused:?}");
        assert_eq!(mesh, before);
    }

    #[test]
    fn faces_that_pinch_alone_go_together() {
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
    fn any_set_of_faces_goes_as_a_mesh_without_them_would_be_built() {
        for shape in shapes_to_try() {
            // Every set of up to eight faces.
            let n = shape.n_faces().min(8);
            for set in 0..1_usize << n {
                let (gone, rest): (Vec<_>, Vec<_>) = shape
                    .faces()
                    .partition(|f| f.index() < n && set >> f.index() & 1 == 1);
                let corner = |v: VertexId| u32::try_from(v.index()).unwrap();
                let rest: Vec<Vec<u32>> = rest
                    .iter()
                    .map(|&f| shape.face_vertices(f).map(corner).collect())
                    .collect();
                let (built, report) =
                    Mesh::from_polygons(shape.positions().to_vec(), &rest).unwrap();
                let mut mesh = shape.clone();
                let done = mesh.delete_faces(&gone);
                assert_eq!(mesh.defects(), []);
                // Building splits a vertex between two fans.
                assert_eq!(done.is_ok(), report.is_clean(), "{done:?}");
                if let Err(refused) = done {
                    assert!(matches!(refused, EditError::Pinch(_)));
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
    fn every_face_of_every_shape_goes_and_comes_back() {
        for shape in shapes_to_try() {
            for f in shape.faces() {
                let refused = undone_and_redone(&shape, |mesh| mesh.delete_face(f)).err();
                // At these corners the face touches the boundary, but has no side there.
                let pinched = shape.face_half_edges(f).filter(|&h| {
                    let sides = [h, shape.prev(h)].map(|h| shape.is_boundary_edge(h.edge()));
                    shape.is_boundary_vertex(shape.origin(h)) && sides == [false; 2]
                });
                let lowest = pinched.map(|h| shape.origin(h)).min();
                assert_eq!(refused, lowest.map(EditError::Pinch));
            }
        }
    }

    #[test]
    fn faces_that_are_not_there_or_there_twice_are_refused() {
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
