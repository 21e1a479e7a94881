//! Gluing two boundary edges into one.

use crate::{EdgeId, EditError, HalfEdgeId, Mesh, VertexId};

/// Two half-edges without faces that are to become one edge: the end of each is the origin of the other.
type Pair = [HalfEdgeId; 2];

impl Mesh {
    /// Glues two boundary edges into one.
    ///
    /// ```text
    ///       \   /                   \   /
    ///    -----b b'-----          -----b-----
    ///      f  | |  g      -->      f  |  g         h: from a to b, g: from b' to a', both without a face
    ///    -----a a'-----          -----a-----
    ///       /   \                   /   \
    /// ```
    ///
    /// a and a' become one vertex, and so do b and b'; either pair may be one vertex already. The vertex of
    /// the lower number stays where it is and keeps its values, the other dies; so do the edges: the one of
    /// the lower number keeps its values and gets both faces. Corners keep theirs, so that UVs that differ
    /// become a seam. Where the boundary edges that follow become a hole of two edges, they are glued too:
    /// it could not be told from a closed one in a list of polygons. So a cut is closed from its end, edge
    /// by edge.
    ///
    /// The order of the two makes no difference. Faces are never turned: both half-edges have the surface
    /// on their right, so it always fits.
    ///
    /// Returns the edge.
    ///
    /// # Errors
    ///
    /// [`EditError::NotBoundary`] if one has a face, [`EditError::EdgeListedTwice`] if they are one and the same,
    /// [`EditError::SameFace`] if one face is beside both (or beside both of the next two where these are
    /// glued too), [`EditError::SelfLoop`] if two vertices that are to become one share an edge,
    /// [`EditError::VisitsTwice`] if they share a face, [`EditError::DuplicateEdge`] if both are joined to a
    /// third one by edges that are not glued too, [`EditError::NoSuchHalfEdge`]. The mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::cube();
    /// let path: Vec<_> = mesh.vertex_half_edges(mesh.vertices().next().unwrap()).collect();
    /// let path = [path[0].edge(), path[1].edge()];
    /// let cut = mesh.cut_edges(&path)?;
    /// assert_eq!(mesh.n_boundary_loops(), 1);
    ///
    /// let rim = |e: mesh::EdgeId| e.half_edges().into_iter().find(|&h| mesh.face(h).is_none());
    /// mesh.stitch_edges(rim(path[0]).unwrap(), rim(cut[0]).unwrap())?;
    /// assert!(mesh.is_closed());
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn stitch_edges(&mut self, h: HalfEdgeId, g: HalfEdgeId) -> Result<EdgeId, EditError> {
        self.check_hole(h)?;
        self.check_hole(g)?;
        if h == g {
            return Err(EditError::EdgeListedTwice(h.edge()));
        }
        // At each end two vertices meet: with the half-edge of h's loop there and the one of g's.
        let at_origin = [self.origin(h), self.target(g)];
        let at_target = [self.target(h), self.origin(g)];
        let (before_h, after_h) = (self.prev(h), self.next(h));
        let (before_g, after_g) = (self.prev(g), self.next(g));
        let mut pairs: Vec<Pair> = vec![[h, g]];
        if at_target[0] != at_target[1] && self.next(after_h) == before_g {
            pairs.push([after_h, before_g]);
        }
        if at_origin[0] != at_origin[1] && self.next(after_g) == before_h {
            pairs.push([before_h, after_g]);
        }
        self.check_stitch(&pairs, [at_origin, at_target])?;

        self.drop_columns_by_rule();
        for [v, w] in [at_origin, at_target] {
            if v != w {
                self.move_fan(v.max(w), v.min(w));
            }
        }
        if at_target[0] != at_target[1] {
            self.set_next(before_g, after_h);
            self.set_next(h, g);
        }
        if at_origin[0] != at_origin[1] {
            self.set_next(before_h, after_g);
            self.set_next(g, h);
        }
        let edges: Vec<EdgeId> = pairs.into_iter().map(|pair| self.close(pair)).collect();
        for x in edges.iter().flat_map(|e| e.half_edges()) {
            self.begin_at_boundary(x);
        }
        Ok(edges[0])
    }

    /// Refuses what would not be a clean mesh when the edges of the pairs and the vertices of the ends
    /// become one.
    fn check_stitch(&self, pairs: &[Pair], ends: [[VertexId; 2]; 2]) -> Result<(), EditError> {
        for [x, y] in pairs {
            if self.face(x.twin()) == self.face(y.twin()) {
                return Err(EditError::SameFace(x.edge()));
            }
        }
        let merged = |v: VertexId| ends.iter().find(|end| end[1] == v).map_or(v, |end| end[0]);
        for [v, w] in ends.into_iter().filter(|[v, w]| v != w) {
            if let Some(h) = self.find_half_edge(v, w) {
                return Err(EditError::SelfLoop(h.edge()));
            }
            let mut faces: Vec<_> = self.vertex_faces(v).collect();
            faces.sort_unstable();
            if let Some(f) = self
                .vertex_faces(w)
                .find(|f| faces.binary_search(f).is_ok())
            {
                return Err(EditError::VisitsTwice(f, v.min(w)));
            }
            let mut neighbors: Vec<_> = self.vertex_neighbors(v).map(merged).collect();
            neighbors.sort_unstable();
            let is_glued = |h: HalfEdgeId| pairs.iter().any(|pair| pair[1].edge() == h.edge());
            let mut others = self.vertex_half_edges(w).filter(|&h| !is_glued(h));
            if let Some(h) =
                others.find(|&h| neighbors.binary_search(&merged(self.target(h))).is_ok())
            {
                return Err(EditError::DuplicateEdge(w, self.target(h)));
            }
        }
        Ok(())
    }

    /// Gives all half-edges that leave `from` to `to`, and takes `from` away.
    fn move_fan(&mut self, from: VertexId, to: VertexId) {
        let fan: Vec<HalfEdgeId> = self.vertex_half_edges(from).collect();
        for h in fan {
            self.set_origin(h, to);
        }
        self.kill(from);
    }

    /// Closes a hole of two edges. The one of the lower number stays.
    fn close(&mut self, [h, g]: Pair) -> EdgeId {
        let (kept, gone) = (h.min(g), h.max(g));
        // The half-edge that stays takes the place of the one on the face of the other edge.
        let old = gone.twin();
        let (before, after, face) = (self.prev(old), self.next(old), self.face(old));
        self.set_next(before, kept);
        self.set_next(kept, after);
        self.set_face(kept, face);
        self.copy_values(old, kept);
        self.replace_first_of_face(old, kept);
        self.kill(gone.edge());
        kept.edge()
    }

    /// Makes the boundary half-edge that leaves the origin of `h`, if there is one, the first of that
    /// vertex; otherwise `h`.
    fn begin_at_boundary(&mut self, h: HalfEdgeId) {
        let v = self.origin(h);
        self.set_vertex_half_edge(v, Some(h));
        let boundary = self.vertex_half_edges(v).find(|&h| self.face(h).is_none());
        if boundary.is_some() {
            self.set_vertex_half_edge(v, boundary);
        }
    }
}

#[cfg(test)]
mod tests;
