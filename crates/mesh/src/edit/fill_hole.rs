//! Filling a hole with a single face, or with triangles.

#[cfg(test)]
mod tests;

use super::{first_repeated, sorted_unique};
use crate::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Fills a hole with a single face. `h` is a half-edge of the hole: it has no face.
    ///
    /// ```text
    ///    +-----+-----+          +-----+-----+
    ///    |     |     |          |     |     |
    ///    +-----+--h--+    -->   +-----+-----+       f has as many corners as the hole had edges
    ///    |     |                |     |  f  |
    ///    +-----+-----+          +-----+-----+
    /// ```
    ///
    /// The outer boundary of an open sheet is a hole too: filling it gives a closed mesh, with the sheet as
    /// its front and the new face as its back. No vertices or edges are added, and all ids stay the same.
    ///
    /// The new face has the values of the face beside `h`. Each new corner lies at the origin of a half-edge of the
    /// hole. The corner copies the values of an existing corner: the corner at the same vertex, in the face on the
    /// other side of this half-edge. Therefore, an edge of the hole becomes a seam only if the existing corners at one
    /// of its ends already had different values.
    ///
    /// Returns the new face.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::NotBoundary`] if `h` has a face, and [`EditError::Pinch`] if the hole contains a vertex
    /// twice. Returns [`EditError::ShortLoop`] if the hole has two edges (use [`stitch_edges`](Self::stitch_edges)
    /// instead). Returns [`EditError::NoSuchHalfEdge`] if `h` does not exist. After an error, the mesh is unchanged.
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

    /// Fills a hole with triangles, by cutting off ears. `h` is a half-edge of the hole: it has no face. Each number in
    /// `ears` is the index of a vertex on the rim; the origin of `h` has the index 0. A triangle (an ear) cuts off this
    /// vertex: it joins the vertex to its two neighbors among the remaining vertices of the rim.
    ///
    /// ```text
    ///    +-----+-----+          +-----+-----+
    ///    |           |          | \       / |
    ///    |           |    -->   |   \   /   |       a hole with n edges gets n - 2 triangles
    ///    |           |          |     \/    |       and n - 3 new edges
    ///    +-----+--h--+          +-----+-----+
    /// ```
    ///
    /// All ids stay the same; the new faces and edges are numbered in the order of `ears`. New faces have the values of
    /// the face beside `h`. The attribute values of new edges are zero. All new corners at a vertex have the values
    /// that the corner at this vertex gets in [`fill_hole`](Self::fill_hole).
    ///
    /// Returns the triangles.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`fill_hole`](Self::fill_hole), and [`EditError::Full`] if there are not
    /// enough ids for the new elements. After an error, the mesh is unchanged.
    ///
    /// # Panics
    ///
    /// Let n be the number of edges of the hole. Panics unless `ears` consists of exactly n - 2 different numbers below
    /// n.
    pub fn fill_hole_by_ears(
        &mut self,
        h: HalfEdgeId,
        ears: &[usize],
    ) -> Result<Vec<FaceId>, EditError> {
        let rim = self.rim(h)?;
        let n = rim.len();
        self.check_room(2 * n)?;
        let n_unique = sorted_unique(ears.iter()).len();
        assert_eq!(
            [n_unique, ears.len()],
            [n - 2; 2],
            "a hole with n edges needs n - 2 different ears"
        );
        self.drop_columns_by_rule();
        let corners: Vec<HalfEdgeId> = rim.iter().map(|&h| self.corner_beside(h)).collect();
        let mut next: Vec<usize> = (1..n).chain([0]).collect();
        let mut before: Vec<usize> = [n - 1].into_iter().chain(0..n - 1).collect();
        // For each remaining vertex of the rim: the half-edge to the next remaining vertex, on the side of the hole.
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

    /// Checks that the hole of `h` can be filled, and returns the half-edges around the hole, starting with `h`.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`fill_hole`](Self::fill_hole).
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

    /// Returns the corner at the origin of the boundary half-edge `h`, in the face on the other side of the edge.
    pub(super) fn corner_beside(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.next(h.twin())
    }

    /// Copies the values of the face on the other side of the boundary half-edge `h` to the new face `f`.
    pub(super) fn copy_face_beside(&mut self, h: HalfEdgeId, f: FaceId) {
        if let Some(beside) = self.face(h.twin()) {
            self.copy_values(beside, f);
        }
    }
}
