//! Taking a face away.

use crate::{EditError, FaceId, HalfEdgeId, Mesh};

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
        if !self.has_face(f) {
            return Err(EditError::NoSuchFace(f));
        }
        let sides: Vec<HalfEdgeId> = self.face_half_edges(f).collect();
        let is_rim = |mesh: &Self, h: HalfEdgeId| mesh.face(h.twin()).is_none();
        let rims: Vec<bool> = sides.iter().map(|&h| is_rim(self, h)).collect();
        for (i, &h) in sides.iter().enumerate() {
            let before = (i + sides.len() - 1) % sides.len();
            let v = self.origin(h);
            if self.is_boundary_vertex(v) && !rims[i] && !rims[before] {
                return Err(EditError::Pinch(v));
            }
        }

        self.drop_columns_by_rule();
        self.kill_face(f);
        for &h in &sides {
            self.set_face(h, None);
        }
        // At each corner the loops around holes are joined past the edges that die.
        for (i, &h) in sides.iter().enumerate() {
            let before = (i + sides.len() - 1) % sides.len();
            let v = self.origin(h);
            match (rims[before], rims[i]) {
                (false, false) => self.set_vertex_half_edge(v, Some(h)),
                (false, true) => {
                    let onward = self.next(h.twin());
                    self.set_next(sides[before], onward);
                    self.set_vertex_half_edge(v, Some(onward));
                }
                (true, false) => {
                    let incoming = self.prev(sides[before].twin());
                    self.set_next(incoming, h);
                    self.set_vertex_half_edge(v, Some(h));
                }
                (true, true) => {
                    let onward = self.next(h.twin());
                    if onward == sides[before].twin() {
                        self.set_vertex_half_edge(v, None);
                    } else {
                        let incoming = self.prev(sides[before].twin());
                        self.set_next(incoming, onward);
                        self.set_vertex_half_edge(v, Some(onward));
                    }
                }
            }
        }
        for (&h, &rim) in sides.iter().zip(&rims) {
            if rim {
                self.kill_edge(h.edge());
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
            // A face that is refused now can go later, when its neighbours are gone.
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
        // The middle of a 3 x 3 grid shares its corners with the holes left at opposite corners.
        let mut mesh = shapes::grid(3, 3);
        mesh.delete_face(FaceId::new(4)).unwrap();
        let before = mesh.clone();
        let refused = mesh.delete_face(FaceId::new(0));
        assert!(matches!(refused, Err(EditError::Pinch(_))), "{refused:?}");
        assert_eq!(mesh, before);
    }
}
