//! Stitching two boundary edges together.

use crate::{EdgeId, EditError, HalfEdgeId, Mesh, VertexId};

/// Two half-edges without faces, whose edges will be merged into one edge. The origin of each half-edge is merged with
/// the target of the other.
type Pair = [HalfEdgeId; 2];

/// Returns the half-edge that is replaced when the edges of a pair are merged. On the edge with the higher id, this is
/// the half-edge that has a face.
fn replaced([h, g]: Pair) -> HalfEdgeId {
    h.max(g).twin()
}

impl Mesh {
    /// Stitches two boundary edges, which become one edge.
    ///
    /// ```text
    ///       \   /                   \   /
    ///    -----b b'-----          -----b-----
    ///      f  | |  g      -->      f  |  g         h: from a to b, g: from b' to a', both without a face
    ///    -----a a'-----          -----a-----
    ///       /   \                   /   \
    /// ```
    ///
    /// The ends a and a' in the picture become one vertex, and b and b' become one vertex. At one end, the two vertices
    /// can already be the same vertex before the stitch. Of the two vertices at each end, the vertex with the lower id
    /// remains and keeps its position and values; the other vertex is removed. The edge with the lower id remains,
    /// keeps its values and gets both faces; the other edge is removed. Corners keep their values, so different UVs
    /// form a seam. If the stitch would leave a hole with only two edges, these two edges are stitched too. A list of
    /// polygons cannot represent a hole with two edges. To close a whole cut, stitch its pairs of edges one after the
    /// other, starting at an end of the cut.
    ///
    /// The order of `h` and `g` does not matter. The orientation of the faces always matches, because both
    /// half-edges have the surface on their right.
    ///
    /// Returns the remaining edge.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::NotBoundary`] if `h` or `g` has a face, and [`EditError::EdgeListedTwice`] if `h` is `g`.
    /// Returns [`EditError::NoSuchHalfEdge`] if `h` or `g` does not exist. Returns [`EditError::SameFace`] if the same
    /// face is beside both edges of a pair that would be stitched. For two vertices that would be merged, returns
    /// [`EditError::SelfLoop`] if they share an edge, and [`EditError::VisitsTwice`] if they share a face. Returns
    /// [`EditError::DuplicateEdge`] if both of these vertices are joined to a third vertex by edges that would not be
    /// stitched. After an error, the mesh is unchanged.
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
        // The two vertices to merge at each end: first the vertex of h, then the vertex of g.
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
        // For each replaced half-edge, find the half-edge before it. While the mesh is still valid, `prev` is fast,
        // even in a face with many corners.
        let before: Vec<HalfEdgeId> = pairs
            .iter()
            .map(|&pair| self.prev(replaced(pair)))
            .collect();

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
        let merged = pairs.into_iter().zip(before);
        let edges: Vec<EdgeId> = merged.map(|(pair, h)| self.merge_edges(pair, h)).collect();
        for x in edges.iter().flat_map(|e| e.half_edges()) {
            self.reset_vertex_half_edge(x);
        }
        Ok(edges[0])
    }

    /// Checks that merging the edges of `pairs` and the vertices of `ends` would leave a valid mesh. Each entry of
    /// `pairs` contains two half-edges whose edges would be merged. Each entry of `ends` contains two vertices that
    /// would be merged.
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
            let is_stitched = |h: HalfEdgeId| pairs.iter().any(|pair| pair[1].edge() == h.edge());
            let is_shared = |h: HalfEdgeId| {
                let neighbor = merged(self.target(h));
                neighbors.binary_search(&neighbor).is_ok()
            };
            let mut remaining = self.vertex_half_edges(w).filter(|&h| !is_stitched(h));
            if let Some(h) = remaining.find(|&h| is_shared(h)) {
                return Err(EditError::DuplicateEdge(w, self.target(h)));
            }
        }
        Ok(())
    }

    /// Moves all outgoing half-edges of `from` to `to`, and removes `from`.
    fn move_fan(&mut self, from: VertexId, to: VertexId) {
        let fan: Vec<HalfEdgeId> = self.vertex_half_edges(from).collect();
        for h in fan {
            self.set_origin(h, to);
        }
        self.kill(from);
    }

    /// Merges the edges of two half-edges without faces. The edge with the lower id remains. Before any edges were
    /// merged, the half-edge `before` preceded the replaced half-edge.
    fn merge_edges(&mut self, pair: Pair, before: HalfEdgeId) -> EdgeId {
        let (kept, old) = (pair[0].min(pair[1]), replaced(pair));
        // If another half-edge has already replaced `before` in the face, `next` leads from `before` to that half-edge.
        let before = if self.has_edge(before.edge()) {
            before
        } else {
            self.next(before)
        };
        let (after, face) = (self.next(old), self.face(old));
        self.set_next(before, kept);
        self.set_next(kept, after);
        self.set_face(kept, face);
        self.copy_values(old, kept);
        self.replace_first_of_face(old, kept);
        self.set_next(old, kept);
        self.kill(old.edge());
        kept.edge()
    }

    /// Sets the stored half-edge of the origin of `h`. If the vertex has an outgoing boundary half-edge, that half-edge
    /// is stored; otherwise, `h` is stored.
    fn reset_vertex_half_edge(&mut self, h: HalfEdgeId) {
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
