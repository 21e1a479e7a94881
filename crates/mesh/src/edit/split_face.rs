//! Splitting a face in two.

use crate::{EdgeId, EditError, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Splits a face in two by an edge between two of its corners.
    ///
    /// ```text
    ///    +-----b           +-----b
    ///    |  f  |           | g / |         a, b: the origins of x and y
    ///    |     |    -->    |  /  |         f has y and the half-edge a-b,
    ///    a-----+           a/--f-+         g is new and has x and the half-edge b-a
    /// ```
    ///
    /// `x` and `y` are half-edges of the face. Each of them stands for the corner at which it starts. The new edge runs
    /// from the origin of `x` to the origin of `y`. The old face keeps `y` and gets the first half-edge of the new
    /// edge. The new face gets `x` and the second half-edge of the new edge. Each corner at an end of the new edge has
    /// the values of the old corner at this end. The new face has the values of the old face. The attribute values of
    /// the new edge are zero.
    ///
    /// Returns the new edge.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::WrongCorner`] if `x` has no face or `y` is not on the same face, and
    /// [`EditError::Adjacent`] if the corners are the same, adjacent, or at the same vertex. Returns
    /// [`EditError::DuplicateEdge`] if the vertices share an edge outside the face. Returns
    /// [`EditError::NoSuchHalfEdge`] if `x` or `y` does not exist, and [`EditError::Full`] if there are not enough ids
    /// for the new elements. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::square();
    /// let x = mesh.face_half_edge(mesh.faces().next().unwrap());
    /// let e = mesh.split_face(x, mesh.next(mesh.next(x)))?;
    /// assert_eq!(mesh.n_faces(), 2);
    /// assert!(!mesh.is_boundary_edge(e));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn split_face(&mut self, x: HalfEdgeId, y: HalfEdgeId) -> Result<EdgeId, EditError> {
        self.check_half_edge(x)?;
        self.check_half_edge(y)?;
        if self.face(x).is_none() {
            return Err(EditError::WrongCorner(x));
        }
        if self.face(y) != self.face(x) {
            return Err(EditError::WrongCorner(y));
        }
        let (v, w) = (self.origin(x), self.origin(y));
        if v == w || self.next(x) == y || self.next(y) == x {
            return Err(EditError::Adjacent(x, y));
        }
        if self.share_an_edge(x, y) {
            return Err(EditError::DuplicateEdge(v, w));
        }
        self.check_room(2)?;
        self.drop_columns_by_rule();
        Ok(self.insert_edge(x, y, x))
    }

    /// Splits the face that has both vertices as corners, by an edge between them. This function is like
    /// [`split_face`], but takes vertices instead of half-edges.
    ///
    /// The new edge runs from `v` to `w`. The sides counter-clockwise from `v` to `w` belong to the new face; the
    /// sides from `w` to `v` belong to the old face. Takes time proportional to the number of corners of the
    /// faces around `v`.
    ///
    /// Returns the new edge.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::DuplicateEdge`] if the vertices share an edge. Returns [`EditError::NoCut`] if no face has
    /// both vertices as corners, or if `v` is `w`. Returns [`EditError::SeveralCuts`] if several faces have both
    /// vertices as corners, or if one face contains one of the vertices twice. Returns [`EditError::NoSuchVertex`] if a
    /// vertex does not exist, and [`EditError::Full`] if there are not enough ids for the new elements. After an error,
    /// the mesh is unchanged.
    ///
    /// [`split_face`]: Self::split_face
    pub fn connect_vertices(&mut self, v: VertexId, w: VertexId) -> Result<EdgeId, EditError> {
        self.check_vertex(v)?;
        self.check_vertex(w)?;
        if self.find_half_edge(v, w).is_some() {
            return Err(EditError::DuplicateEdge(v, w));
        }
        if v == w {
            return Err(EditError::NoCut(v, w));
        }
        let corners = self
            .vertex_half_edges(v)
            .filter(|&x| self.face(x).is_some());
        let mut cuts = corners.flat_map(|x| {
            let opposite = self.loop_half_edges(x).filter(|&y| self.origin(y) == w);
            opposite.map(move |y| (x, y))
        });
        let (first, second) = (cuts.next(), cuts.next());
        let (x, y) = first.ok_or(EditError::NoCut(v, w))?;
        if second.is_some() {
            return Err(EditError::SeveralCuts(v, w));
        }
        self.split_face(x, y)
    }

    /// Adds an edge between the origins of `x` and `y`, which are half-edges of one face. The part with the half-edge
    /// `moved` becomes a new face; the other part keeps the id of the old face.
    pub(super) fn insert_edge(
        &mut self,
        x: HalfEdgeId,
        y: HalfEdgeId,
        moved: HalfEdgeId,
    ) -> EdgeId {
        let (before_x, before_y) = (self.prev(x), self.prev(y));
        let [xy, yx] = self.push_diagonal(x, y);
        self.set_next(before_x, xy);
        self.set_next(xy, y);
        self.set_next(before_y, yx);
        self.set_next(yx, x);

        let new = self.push_face(moved);
        if let Some(old) = self.face(x) {
            self.copy_values(old, new);
            for h in [xy, yx] {
                self.set_face(h, Some(old));
                self.set_face_half_edge(old, h);
            }
        }
        let mut h = moved;
        while self.face(h) != Some(new) {
            self.set_face(h, Some(new));
            h = self.next(h);
        }
        let kept = if self.face(xy) == Some(new) { yx } else { xy };
        if let Some(old) = self.face(kept) {
            self.set_face_half_edge(old, kept);
        }
        xy.edge()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edit::testing::{checked_edit_mesh, polygons, ring, sample_shapes};
    use crate::{FaceId, shapes};

    fn connect(mesh: &Mesh, v: usize, w: usize) -> Result<Mesh, EditError> {
        let [v, w] = [v, w].map(VertexId::new);
        checked_edit_mesh(mesh, |mesh| mesh.connect_vertices(v, w).map(drop))
    }

    #[test]
    fn the_edge_runs_from_the_first_vertex_and_the_part_after_the_second_keeps_the_face() {
        let mut mesh = shapes::grid(2, 1);
        let [v, w] = [5, 1].map(VertexId::new);
        let e = mesh.connect_vertices(v, w).unwrap();
        assert_eq!(mesh.edge_vertices(e), [v, w]);
        assert_eq!(
            polygons(&mesh),
            [vec![0, 1, 4, 3], vec![1, 2, 5], vec![1, 5, 4]]
        );
    }

    #[test]
    fn any_two_corners_of_any_face_are_joined_unless_they_share_an_edge() {
        for shape in sample_shapes() {
            for f in shape.faces() {
                let corners: Vec<VertexId> = shape.face_vertices(f).collect();
                for (&v, &w) in corners
                    .iter()
                    .flat_map(|v| corners.iter().map(move |w| (v, w)))
                {
                    let result = connect(&shape, v.index(), w.index());
                    if v == w {
                        assert_eq!(result, Err(EditError::NoCut(v, w)));
                    } else if shape.find_half_edge(v, w).is_some() {
                        assert_eq!(result, Err(EditError::DuplicateEdge(v, w)));
                    } else {
                        assert_eq!(result.unwrap().n_faces(), shape.n_faces() + 1);
                    }
                }
            }
        }
    }

    #[test]
    fn vertices_without_a_common_face_or_with_several_are_refused() {
        let v = VertexId::new;
        assert_eq!(
            connect(&shapes::cube(), 0, 7),
            Err(EditError::NoCut(v(0), v(7)))
        );
        let missing = connect(&shapes::cube(), 0, 8);
        assert_eq!(missing, Err(EditError::NoSuchVertex(v(8))));
        // A tube of two faces.
        let mut tube = shapes::cylinder(4, false);
        for e in [
            tube.find_half_edge(v(1), v(5)),
            tube.find_half_edge(v(3), v(7)),
        ] {
            tube.dissolve_edge(e.unwrap().edge()).unwrap();
        }
        assert_eq!(
            connect(&tube, 0, 6),
            Err(EditError::SeveralCuts(v(0), v(6)))
        );
        // The face has two corners at vertex 3.
        assert_eq!(
            connect(&ring(), 1, 3),
            Err(EditError::SeveralCuts(v(1), v(3)))
        );
        assert_eq!(ring().degree(FaceId::new(0)), 8);
    }
}
