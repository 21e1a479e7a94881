//! Filling a hole with one face, or with triangles.

mod ears;
#[cfg(test)]
mod tests;

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
    /// let mut mesh = mesh::shapes::cylinder(6, false);
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

    /// Puts triangles over the hole of `h`, a half-edge without a face.
    ///
    /// ```text
    ///    +-----+-----+          +-----+-----+
    ///    |           |          | \       / |
    ///    |           |    -->   |   \   /   |       n edges around it: n - 2 triangles, n - 3 new edges
    ///    |           |          |     \/    |
    ///    +-----+--h--+          +-----+-----+
    /// ```
    ///
    /// Up to 500 edges the triangles have the smallest total area of all that use the vertices
    /// around the hole and no others: Barequet and Sharir, "Filling gaps in the boundary of a polyhedron",
    /// 1995, in time n³. Where several choices have the same area, as in a flat hole, the triangles are as
    /// near to equilateral as they can be together: a measure of shape is added to each area, at most a
    /// millionth of the mean square of the edges around the hole.
    ///
    /// Around larger holes the corner whose neighbours are nearest to each other is cut off again and again,
    /// in time n log n; corners that are straight or turn outwards, as seen along the mean normal, come
    /// last. In a hole that is far from convex these triangles may overlap.
    ///
    /// No two vertices are joined that share an edge already.
    ///
    /// All ids stay; the new faces and edges are numbered in the order of the triangles returned, which
    /// depends on `h` and on the shape of the hole. Faces take the values of the one beside `h`, and edges
    /// zero values. All corners at a vertex take those of one corner, as in [`fill_hole`](Self::fill_hole).
    ///
    /// Returns the triangles.
    ///
    /// # Errors
    ///
    /// [`EditError::DuplicateEdge`] if there are no triangles without an edge that is there already (for
    /// large holes: if none are found), [`EditError::Full`], and those of [`fill_hole`](Self::fill_hole). The
    /// mesh is unchanged.
    pub fn fill_hole_triangles(&mut self, h: HalfEdgeId) -> Result<Vec<FaceId>, EditError> {
        let rim = self.rim(h)?;
        let ears = ears::ears(self, &rim)?;
        self.check_room(2 * rim.len())?;
        self.drop_columns_by_rule();
        Ok(self.cut_ears(&rim, &ears))
    }

    /// The half-edges around a hole, beginning with `h`.
    fn rim(&self, h: HalfEdgeId) -> Result<Vec<HalfEdgeId>, EditError> {
        self.check_half_edge(h)?;
        if self.face(h).is_some() {
            return Err(EditError::NotBoundary(h.edge()));
        }
        let rim: Vec<HalfEdgeId> = self.loop_half_edges(h).collect();
        if rim.len() < 3 {
            return Err(EditError::ShortLoop(h));
        }
        let mut vertices: Vec<VertexId> = rim.iter().map(|&h| self.origin(h)).collect();
        vertices.sort_unstable();
        match vertices.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(EditError::Pinch(pair[0])),
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

    /// Covers a hole with triangles: each number in `ears` is the place on the rim of a vertex that is cut
    /// off by the edge between the two beside it that are left.
    fn cut_ears(&mut self, rim: &[HalfEdgeId], ears: &[usize]) -> Vec<FaceId> {
        let n = rim.len();
        let corners: Vec<HalfEdgeId> = rim.iter().map(|&h| self.corner_beside(h)).collect();
        let mut next: Vec<usize> = (1..n).chain([0]).collect();
        let mut before: Vec<usize> = [n - 1].into_iter().chain(0..n - 1).collect();
        // For each vertex that is left the half-edge to the next one, on the side of the hole.
        let mut front = rim.to_vec();
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
            for (i, corner) in [p, ear, q].into_iter().enumerate() {
                self.set_next(sides[i], sides[(i + 1) % 3]);
                self.set_face(sides[i], Some(f));
                self.copy_values(corners[corner], sides[i]);
            }
            triangles.push(f);
        }
        triangles
    }
}
