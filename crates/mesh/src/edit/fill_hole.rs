//! Filling a hole with one face, or with triangles.

#[cfg(test)]
mod tests;

use super::{first_repeated, sorted_unique};
use crate::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Puts one face over the hole of `h`, a half-edge without a face.
    ///
    /// ```text
    ///    +-----+-----+          +-----+-----+
    ///    |     |     |          |     |     |
    ///    +-----+--h--+    -->   +-----+-----+       f: as many corners as the hole had edges
    ///    |     |                |     |  f  |
    ///    +-----+-----+          +-----+-----+
    /// ```
    ///
    /// The rim of an open sheet is a hole as well: filled, the sheet is the front of a closed mesh and the
    /// face its back. No vertex and no edge is made, and all ids stay.
    ///
    /// The face takes the values of the one beside `h`. Each corner takes those of the corner at the same
    /// vertex of the face beside its own edge, the one that leaves it, so that no seam lies along an edge
    /// where there is none at its ends.
    ///
    /// Returns the face.
    ///
    /// # Errors
    ///
    /// [`EditError::NotBoundary`] if `h` has a face, [`EditError::ShortLoop`] if the hole has two edges
    /// (glue them), [`EditError::Pinch`] if it visits a vertex twice, [`EditError::NoSuchHalfEdge`]. The
    /// mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::cylinder(6, false);
    /// for h in mesh.boundary_loops() {
    ///     mesh.fill_hole(h)?;
    /// }
    /// assert!(mesh.is_closed());
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn fill_hole(&mut self, h: HalfEdgeId) -> Result<FaceId, EditError> {
        let rim = self.rim(h)?;
        self.drop_columns_by_rule();
        let f = self.push_face(h);
        self.copy_face_beside(h, f);
        for h in rim {
            self.set_face(h, Some(f));
            self.copy_values(self.corner_beside(h), h);
        }
        Ok(f)
    }

    /// Covers the hole of `h`, a half-edge without a face, with triangles: each number in `ears` is the place
    /// on the rim, counted from `h`, of a vertex that is cut off by the edge between the two beside it that
    /// are left.
    ///
    /// ```text
    ///    +-----+-----+          +-----+-----+
    ///    |           |          | \       / |
    ///    |           |    -->   |   \   /   |       n edges around it: n - 2 triangles, n - 3 new edges
    ///    |           |          |     \/    |
    ///    +-----+--h--+          +-----+-----+
    /// ```
    ///
    /// All ids stay; the new faces and edges are numbered in the order of `ears`. Faces take the values of the
    /// one beside `h`, and edges zero values. All corners at a vertex take those of one corner, as in
    /// [`fill_hole`](Self::fill_hole).
    ///
    /// Returns the triangles.
    ///
    /// # Errors
    ///
    /// [`EditError::Full`], and those of [`fill_hole`](Self::fill_hole). The mesh is unchanged.
    ///
    /// # Panics
    ///
    /// If `ears` are not as many different places as the hole has edges, less two.
    pub fn fill_hole_by_ears(
        &mut self,
        h: HalfEdgeId,
        ears: &[usize],
    ) -> Result<Vec<FaceId>, EditError> {
        let rim = self.rim(h)?;
        let n = rim.len();
        self.check_room(2 * n)?;
        let n_different = sorted_unique(ears.iter()).len();
        assert_eq!(
            [n_different, ears.len()],
            [n - 2; 2],
            "n - 2 different ears"
        );
        self.drop_columns_by_rule();
        let corners: Vec<HalfEdgeId> = rim.iter().map(|&h| self.corner_beside(h)).collect();
        let mut next: Vec<usize> = (1..n).chain([0]).collect();
        let mut before: Vec<usize> = [n - 1].into_iter().chain(0..n - 1).collect();
        // For each vertex that is left the half-edge to the next one, on the side of the hole.
        let mut front = rim.clone();
        let mut triangles = Vec::with_capacity(ears.len());
        for &ear in ears {
            let (p, q) = (before[ear], next[ear]);
            let mut sides = [front[p], front[ear], front[q]];
            if next[q] != p {
                let e = self.push_edge(self.origin(rim[q]), self.origin(rim[p]));
                [sides[2], front[p]] = e.half_edges();
                (next[p], before[q]) = (q, p);
            }
            let f = self.push_face(sides[0]);
            self.copy_face_beside(rim[0], f);
            self.link_around(f, &sides);
            for (side, corner) in sides.into_iter().zip([p, ear, q]) {
                self.copy_values(corners[corner], side);
            }
            triangles.push(f);
        }
        Ok(triangles)
    }

    /// The half-edges around the hole of `h`, beginning with it.
    ///
    /// # Errors
    ///
    /// Those of [`fill_hole`](Self::fill_hole).
    pub fn rim(&self, h: HalfEdgeId) -> Result<Vec<HalfEdgeId>, EditError> {
        self.check_hole(h)?;
        let rim: Vec<HalfEdgeId> = self.loop_half_edges(h).collect();
        if rim.len() < 3 {
            return Err(EditError::ShortLoop(h));
        }
        let vertices: Vec<VertexId> = rim.iter().map(|&h| self.origin(h)).collect();
        match first_repeated(&vertices) {
            Some(v) => Err(EditError::Pinch(v)),
            None => Ok(rim),
        }
    }

    /// The corner at the origin of a boundary half-edge, in the face on the other side of its edge.
    pub(super) fn corner_beside(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.next(h.twin())
    }

    /// Gives the new face `f` the values of the face on the other side of a boundary half-edge.
    pub(super) fn copy_face_beside(&mut self, h: HalfEdgeId, f: FaceId) {
        if let Some(beside) = self.face(h.twin()) {
            self.copy_values(beside, f);
        }
    }
}
