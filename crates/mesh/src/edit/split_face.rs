//! Cutting a face in two.

use crate::{EdgeId, EditError, HalfEdgeId, Mesh};

impl Mesh {
    /// Cuts a face in two by an edge between two of its corners.
    ///
    /// ```text
    ///    +-----b           +-----b
    ///    |  f  |           | g / |         a, b: the origins of x and y
    ///    |     |    -->    |  /  |         f keeps its id on the side of y, a to b,
    ///    a-----+           a/--f-+         g is the new face with x after b to a
    /// ```
    ///
    /// `x` and `y` are half-edges of the face, and stand for the corners at their origins. The new edge
    /// runs from the origin of `x` to that of `y`; its first half and `y` stay on the old face, its
    /// second half and `x` are on the new one. The corners of the new edge have the values of the corners that
    /// they come from, the new face those of the old one, the edge zero values.
    ///
    /// Two faces with more than three corners may then share more than one edge, and two vertices may be
    /// joined twice if they were joined outside the face.
    ///
    /// Returns the new edge.
    ///
    /// # Errors
    ///
    /// [`EditError::Elsewhere`] if `x` has no face or `y` is not on it, [`EditError::Adjacent`] if the
    /// corners are the same or neighbours, [`EditError::NoSuchHalfEdge`], [`EditError::Full`]. The mesh
    /// is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = mesh::shapes::square();
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
            return Err(EditError::Elsewhere(x));
        }
        if self.face(y) != self.face(x) {
            return Err(EditError::Elsewhere(y));
        }
        if x == y || self.next(x) == y || self.next(y) == x {
            return Err(EditError::Adjacent(x, y));
        }
        self.check_room(2)?;
        self.drop_columns_by_rule();
        Ok(self.insert_edge(x, y, x))
    }

    /// Joins the origins of `x` and `y`, half-edges of one face. The part of the face with `moved`
    /// becomes a new face; the other part keeps the old one.
    pub(super) fn insert_edge(
        &mut self,
        x: HalfEdgeId,
        y: HalfEdgeId,
        moved: HalfEdgeId,
    ) -> EdgeId {
        let (before_x, before_y) = (self.prev(x), self.prev(y));
        let e = self.push_edge(self.origin(x), self.origin(y));
        let [xy, yx] = e.half_edges();
        self.copy_values(x, xy);
        self.copy_values(y, yx);
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
        e
    }
}
