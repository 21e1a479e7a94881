//! Removing a vertex and merging the faces around it.

use super::first_repeated;
use crate::{EditError, FaceId, HalfEdgeId, Mesh, Seams, VertexId};

impl Mesh {
    /// Removes a vertex and merges the faces around it.
    ///
    /// ```text
    ///    +-----+-----+        +-----+-----+        inside: all faces around v become one
    ///    |     |     |        |           |
    ///    +-----v-----+  -->   +     f     +
    ///    |  f  |     |        |           |
    ///    +-----+-----+        +-----+-----+
    ///
    ///    +-----+-----+        +-----+-----+        on the boundary: the same, and the two boundary
    ///    |  f  |     |  -->   |     f     |        edges become one
    ///    a-----v-----b        a-----------b
    ///
    ///    +-----------+        +-----------+        v has two edges: they become one, and the
    ///    |           |  -->   |           |        faces beside them lose a corner
    ///    a-----v-----b        a-----------b
    ///    |           |        |           |
    /// ```
    ///
    /// Of the merged faces, the face with the lowest id remains and keeps its values; the other merged faces are
    /// removed. If two edges become one, the edge with the lower id remains and keeps its values. `v` and its other
    /// edges are removed. The Euler characteristic V - E + F stays the same. All other ids and values stay the same.
    /// This edit is the inverse of [`poke_face`](Self::poke_face). It is also the inverse of
    /// [`split_edge`](Self::split_edge), unless that split has cut a triangle.
    ///
    /// Returns the merged face. If `v` has two edges, returns the face beside these edges. If `v` has two edges and two
    /// faces, returns the face with the lower id.
    ///
    /// # Errors
    ///
    /// - [`EditError::FewEdges`] with `v` if `v` is isolated or has a single edge. This error is also returned, with
    ///   a neighbor of `v`, if that neighbor would be left with a single edge inside the merged face (remove the
    ///   neighbor first).
    /// - [`EditError::RepeatedVertex`] if a face contains `v` twice, if the merged face would contain another vertex
    ///   twice, or if `v` has two edges and both lead to the same vertex.
    /// - [`EditError::DuplicateEdge`] if two edges would become one edge, but its ends already share an edge.
    /// - [`EditError::FewCorners`] if a face would be left with fewer than three corners.
    /// - [`EditError::Seam`] with an edge at `v` if, at the other end of this edge, corner attributes differ between
    ///   the two sides of the edge.
    /// - [`EditError::NoSuchVertex`].
    ///
    /// After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::icosahedron();
    /// let v = mesh.vertices().next().unwrap();
    /// let f = mesh.dissolve_vertex(v)?;
    /// assert_eq!((mesh.n_faces(), mesh.degree(f)), (16, 5));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn dissolve_vertex(&mut self, v: VertexId) -> Result<FaceId, EditError> {
        self.dissolve_vertex_with(v, Seams::Refuse)
    }

    /// Removes a vertex like [`dissolve_vertex`](Self::dissolve_vertex); `seams` decides what happens if corner
    /// attributes differ across an edge at `v` (a seam). With [`Seams::Drop`], the vertex is removed. At the other end
    /// of a seam edge, two corners with different values become one corner. This corner keeps the value of the face
    /// that follows the seam edge counter-clockwise around `v`.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`dissolve_vertex`](Self::dissolve_vertex), but [`EditError::Seam`] only
    /// if `seams` is [`Seams::Refuse`].
    pub fn dissolve_vertex_with(&mut self, v: VertexId, seams: Seams) -> Result<FaceId, EditError> {
        self.check_vertex(v)?;
        let spokes: Vec<HalfEdgeId> = self.vertex_half_edges(v).collect();
        let mut faces: Vec<FaceId> = self.vertex_faces(v).collect();
        faces.sort_unstable();
        match spokes[..] {
            [] | [_] => return Err(EditError::FewEdges(v)),
            [x, y] => {
                self.check_joint(x, y)?;
                self.drop_columns_by_rule();
                self.join_edges(x, y);
                return Ok(faces[0]);
            }
            _ => {}
        }
        if first_repeated(&faces).is_some() {
            return Err(EditError::RepeatedVertex(v));
        }
        // If `v` is on the boundary, its first and its last spoke (outgoing half-edge) become one edge.
        let on_boundary = self.is_boundary_vertex(v);
        let last = spokes.len() - 1;
        let inner = if on_boundary {
            &spokes[1..last]
        } else {
            &spokes[..]
        };
        for &h in inner {
            if self.next(h) == self.prev_on_face(h.twin()).twin() {
                return Err(EditError::FewEdges(self.target(h)));
            }
        }
        // To save time, the edit does not walk around the largest face at `v`, which can have many more corners than
        // the other faces.
        let large = self.spoke_of_largest_face(&spokes);
        let rim = self.rim_around(spokes.iter().copied().filter(|&h| h != large));
        if let Some(v) = self.repeated_after_merge(&spokes, large, &rim) {
            return Err(EditError::RepeatedVertex(v));
        }
        if on_boundary && self.share_an_edge(spokes[0].twin(), spokes[last].twin()) {
            let [first, last] = [spokes[0], spokes[last]].map(|h| self.target(h));
            return Err(EditError::DuplicateEdge(first, last));
        }
        if seams == Seams::Refuse {
            let differ = |h: HalfEdgeId| self.attributes.corners_differ(self.next(h), h.twin());
            if let Some(h) = inner.iter().copied().find(|&h| differ(h)) {
                return Err(EditError::Seam(h.edge()));
            }
        }

        self.drop_columns_by_rule();
        let merged = faces[0];
        let rim_of_large = match self.face(large) {
            Some(f) if f != merged => self.rim_around([large].into_iter()),
            _ => Vec::new(),
        };
        let first_spoke = spokes[usize::from(on_boundary)];
        self.set_face_half_edge(merged, self.next(first_spoke));
        for &h in inner {
            let after = self.next(h);
            self.set_next(self.prev_on_face(h.twin()), after);
            self.replace_first_of_vertex(h.twin(), after);
            self.kill(h.edge());
        }
        for &h in rim.iter().chain(&rim_of_large) {
            self.set_face(h, Some(merged));
        }
        for &f in &faces[1..] {
            self.kill(f);
        }
        if on_boundary {
            let (incoming, outgoing) = (spokes[0].twin(), spokes[last]);
            self.set_face(incoming, Some(merged));
            self.set_face(outgoing, Some(merged));
            self.set_next(incoming, outgoing);
            self.join_edges(spokes[0], spokes[last]);
        } else {
            self.kill(v);
        }
        Ok(merged)
    }

    /// The spokes are outgoing half-edges of one vertex. Returns the half-edges of all faces that have a spoke, except
    /// half-edges that start or end at the vertex.
    fn rim_around(&self, spokes: impl Iterator<Item = HalfEdgeId>) -> Vec<HalfEdgeId> {
        let mut rim = Vec::new();
        for spoke in spokes.filter(|&h| self.face(h).is_some()) {
            let mut h = self.next(spoke);
            while self.target(h) != self.origin(spoke) {
                rim.push(h);
                h = self.next(h);
            }
        }
        rim
    }

    /// Returns the spoke (one of several outgoing half-edges of a vertex) whose face has the most corners. Walks around
    /// the faces of all spokes at the same time, and stops as soon as at most one walk is incomplete.
    fn spoke_of_largest_face(&self, spokes: &[HalfEdgeId]) -> HalfEdgeId {
        let with_face = spokes.iter().filter(|&&h| self.face(h).is_some());
        let mut walks: Vec<(HalfEdgeId, HalfEdgeId)> = with_face.map(|&h| (h, h)).collect();
        let mut largest = spokes[0];
        while let Some(&(spoke, _)) = walks.first() {
            largest = spoke;
            if walks.len() == 1 {
                break;
            }
            walks.retain_mut(|(spoke, h)| {
                *h = self.next(*h);
                *h != *spoke
            });
        }
        largest
    }

    /// Returns a vertex that the merged face would contain twice. `large` is one of the spokes (the outgoing half-edges
    /// of the vertex that will be removed). `rim` has the half-edges around all merged faces except the face of
    /// `large`. To save time, this function does not walk around the face of `large`, because this face has the most
    /// corners.
    fn repeated_after_merge(
        &self,
        spokes: &[HalfEdgeId],
        large: HalfEdgeId,
        rim: &[HalfEdgeId],
    ) -> Option<VertexId> {
        let mut corners: Vec<VertexId> = rim.iter().map(|&h| self.origin(h)).collect();
        if self.face(spokes[0]).is_none() {
            // On the boundary, the rim is open: it ends at the target of the first spoke.
            corners.push(self.target(spokes[0]));
        }
        let before_large = spokes.iter().position(|&h| h == large)? + spokes.len() - 1;
        let ends = [large, spokes[before_large % spokes.len()]].map(|h| self.target(h));
        let on_large =
            |v: &VertexId| (self.vertex_half_edges(*v)).any(|h| self.face(h) == self.face(large));
        let common = corners
            .iter()
            .copied()
            .filter(|v| !ends.contains(v))
            .find(on_large);
        corners.push(ends[0]);
        common.or_else(|| first_repeated(&corners))
    }

    /// Checks that the edges of `x` and `y`, the only outgoing half-edges of a vertex, can become one edge.
    fn check_joint(&self, x: HalfEdgeId, y: HalfEdgeId) -> Result<(), EditError> {
        let n_lost = if self.face(x) == self.face(y) { 2 } else { 1 };
        for f in [x, y].into_iter().filter_map(|h| self.face(h)) {
            if self.face_half_edges(f).nth(n_lost + 2).is_none() {
                return Err(EditError::FewCorners(f));
            }
        }
        if let Some(h) = [x, y].into_iter().find(|&h| self.next(h) == h.twin()) {
            return Err(EditError::FewEdges(self.target(h)));
        }
        let (a, b) = (self.target(x), self.target(y));
        if a == b {
            return Err(EditError::RepeatedVertex(a));
        }
        if self.share_an_edge(x.twin(), y.twin()) {
            return Err(EditError::DuplicateEdge(a, b));
        }
        Ok(())
    }

    /// Merges the edges of `x` and `y`, the only outgoing half-edges of a vertex, and removes the vertex. The
    /// edge with the lower id remains.
    ///
    /// ```text
    ///    a <--x-- v --y--> b     -->     a <---x--- b
    ///      -----> <------                  -------->
    /// ```
    fn join_edges(&mut self, x: HalfEdgeId, y: HalfEdgeId) {
        let (x, y) = if x.edge() < y.edge() { (x, y) } else { (y, x) };
        let (before, after) = (self.prev_on_face(y.twin()), self.next(y));
        let (v, b) = (self.origin(x), self.target(y));
        // Half-edge x now leaves b. Therefore, x now stores the corner that the twin of y stored before.
        self.copy_values(y.twin(), x);
        self.set_next(x.twin(), after);
        self.set_next(before, x);
        self.set_origin(x, b);
        self.replace_first_of_vertex(y.twin(), x);
        self.replace_first_of_face(y, x.twin());
        self.replace_first_of_face(y.twin(), x);
        self.kill(y.edge());
        self.kill(v);
    }
}

#[cfg(test)]
mod tests;
