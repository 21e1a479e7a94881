//! Bevels: replaces vertices and edges by faces.

use crate::{EdgeId, EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Replaces `v` by a face: each edge at v is cut at `fraction` of its length from v, and the cuts are
    /// connected.
    ///
    /// ```text
    ///      \     /              \     /
    ///       \   /                1---2          1, 2, 3: new vertices at (1 - t) v + t w,
    ///         v        -->        \ /           w the other end of the edge, t the fraction
    ///         |                    3
    ///         |                    |
    /// ```
    ///
    /// `v` is removed. The n edges of `v` keep their ids and end at the cuts. The new elements are n vertices, n edges
    /// and one face. Each new edge joins a new vertex to the next. The first corner of the new face is the first new
    /// vertex. The new vertices and edges are in clockwise order around `v`, starting at the first edge of
    /// [`vertex_half_edges`](Self::vertex_half_edges). The numbers of vertices, edges and faces grow by n - 1, n and 1.
    /// A face gains one corner for each of its corners at v.
    ///
    /// At a cut, vertex attributes are interpolated between v and the other end of the edge. The values of a corner are
    /// interpolated within its face, separately on each side of a seam. Attributes that are not interpolated are copied
    /// from v. The new face has the values of the face to the left of the first edge in
    /// [`vertex_half_edges`](Self::vertex_half_edges). Each corner of the new face copies the values of another corner
    /// at the same cut: the corner of the face to the left of the cut edge, as seen from v. The attribute values of new
    /// edges are zero.
    ///
    /// Returns the new face.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::BoundaryVertex`] if `v` is on the boundary, and [`EditError::FewEdges`] if it has fewer
    /// than three edges. Returns [`EditError::OutsideEdge`] if `fraction` is not strictly between 0 and 1. Returns
    /// [`EditError::NoSuchVertex`] if `v` does not exist, and [`EditError::Full`] if there are not enough ids for the
    /// new elements. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::cube();
    /// let v = mesh.vertices().next().unwrap();
    /// let f = mesh.bevel_vertex(v, 0.25)?;
    /// assert!(mesh.is_triangle(f));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn bevel_vertex(&mut self, v: VertexId, fraction: f64) -> Result<FaceId, EditError> {
        self.bevel_vertex_with(v, |_| fraction)
    }

    /// Bevels a vertex like [`bevel_vertex`](Self::bevel_vertex), with a separate fraction for each edge.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`bevel_vertex`](Self::bevel_vertex).
    pub fn bevel_vertex_with(
        &mut self,
        v: VertexId,
        fraction: impl Fn(EdgeId) -> f64,
    ) -> Result<FaceId, EditError> {
        self.check_vertex(v)?;
        let spokes: Vec<HalfEdgeId> = self.vertex_half_edges(v).collect();
        self.check_bevel_end(v, spokes.len())?;
        let cuts = self.check_cuts(&spokes, fraction)?;
        let f = self.face(spokes[0]).expect("v is not on the boundary");
        let new = self.join_cuts(&cuts, f);
        self.kill(v);
        Ok(new)
    }

    /// Replaces `e` by a face. Each other edge at an end of `e` is cut at `fraction` of its length, measured from this
    /// end, and the cuts are connected.
    ///
    /// ```text
    ///     \               /            \               /
    ///      \             /              2 ----------- 3
    ///       a --- e --- b      -->      |             |         (with three edges at each end)
    ///      /             \              1 ----------- 4
    ///     /               \            /               \
    /// ```
    ///
    /// `e` and both of its ends, a and b, are removed. The n other edges at a and b keep their ids and end at the cuts.
    /// The new elements are n vertices, n edges and one face. Each new edge joins a new vertex to the next. The first
    /// corner of the new face is the first new vertex. The new vertices and edges are in clockwise order around e. The
    /// cuts at a (the origin of the first half-edge of e) come first, starting with the edge after e. The cuts at b
    /// follow. The numbers of vertices, edges and faces grow by n - 2, n - 1 and 1. The faces beside e keep their
    /// number of corners. Any other face gains one corner for each of its corners at a and b.
    ///
    /// Attributes are set as in [`bevel_vertex`](Self::bevel_vertex). The new face has the values of the face to the
    /// left of the first half-edge of e.
    ///
    /// Returns the new face.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Boundary`] if `e` is on the boundary, and [`EditError::BoundaryVertex`] if an end of `e` is
    /// on the boundary. Returns [`EditError::FewEdges`] if an end has fewer than three edges, and
    /// [`EditError::DuplicateEdge`] if another edge joins the ends. Returns [`EditError::OutsideEdge`] if `fraction` is
    /// not strictly between 0 and 1. Returns [`EditError::NoSuchEdge`] if `e` does not exist, and [`EditError::Full`]
    /// if there are not enough ids for the new elements. After an error, the mesh is unchanged.
    pub fn bevel_edge(&mut self, e: EdgeId, fraction: f64) -> Result<FaceId, EditError> {
        self.bevel_edge_with(e, |_| fraction)
    }

    /// Bevels an edge like [`bevel_edge`](Self::bevel_edge), with a separate fraction for each edge that is
    /// cut.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`bevel_edge`](Self::bevel_edge).
    pub fn bevel_edge_with(
        &mut self,
        e: EdgeId,
        fraction: impl Fn(EdgeId) -> f64,
    ) -> Result<FaceId, EditError> {
        self.check_edge(e)?;
        let [Some(f), Some(_)] = self.edge_faces(e) else {
            return Err(EditError::Boundary(e));
        };
        let [a, b] = self.edge_vertices(e);
        let mut spokes = Vec::new();
        for half in e.half_edges() {
            let first = spokes.len();
            let mut h = self.next(half.twin());
            while h != half {
                if self.target(h) == self.target(half) {
                    return Err(EditError::DuplicateEdge(a, b));
                }
                spokes.push(h);
                h = self.next(h.twin());
            }
            self.check_bevel_end(self.origin(half), spokes.len() - first + 1)?;
        }
        let cuts = self.check_cuts(&spokes, fraction)?;
        let new = self.join_cuts(&cuts, f);
        self.kill(a);
        self.kill(b);
        self.kill(e);
        Ok(new)
    }

    /// Checks that a bevel can remove `v`, which has `n_edges` edges.
    fn check_bevel_end(&self, v: VertexId, n_edges: usize) -> Result<(), EditError> {
        if self.is_boundary_vertex(v) {
            Err(EditError::BoundaryVertex(v))
        } else if n_edges < 3 {
            Err(EditError::FewEdges(v))
        } else {
            Ok(())
        }
    }

    /// Checks the fractions, and returns each half-edge with its fraction.
    fn check_cuts(
        &self,
        spokes: &[HalfEdgeId],
        fraction: impl Fn(EdgeId) -> f64,
    ) -> Result<Vec<(HalfEdgeId, f64)>, EditError> {
        self.check_room(2 * spokes.len())?;
        let cut = |&h: &HalfEdgeId| {
            let t = fraction(h.edge());
            if t > 0.0 && t < 1.0 {
                Ok((h, t))
            } else {
                Err(EditError::OutsideEdge(t))
            }
        };
        spokes.iter().map(cut).collect()
    }

    /// Cuts the half-edges of `cuts` at their fractions, and connects the cuts by a new face with the values
    /// of `f`.
    ///
    /// The half-edges must be in clockwise order. Let k be the half-edge after h in `cuts`. Around a face, k must
    /// follow the twin of h; only a half-edge of the beveled edge is allowed in between.
    fn join_cuts(&mut self, cuts: &[(HalfEdgeId, f64)], f: FaceId) -> FaceId {
        self.drop_columns_by_rule();
        let n = cuts.len();
        let mut ends = Vec::with_capacity(n);
        for &(h, t) in cuts {
            let (v, w) = (self.origin(h), self.target(h));
            let m = self.push_vertex((1.0 - t) * self.position(v) + t * self.position(w));
            self.copy_values(v, m);
            self.mix_values(v, w, t, m);
            self.set_vertex_half_edge(m, Some(h));
            ends.push(m);
        }
        let mut ring = Vec::with_capacity(n);
        for i in 0..n {
            let e = self.push_edge(ends[i], ends[(i + 1) % n]);
            ring.push(e.half_edges());
        }
        let new = self.push_copy_of_face(f, ring[n - 1][1]);

        // Sets the values of the corners at the cuts. The values of the corners to the right of the cut edges depend on
        // the old values of the corners to the left. Therefore the corners to the right are set first.
        for (&(h, t), [along, _]) in cuts.iter().zip(&ring) {
            let corner = self.next(h.twin());
            self.copy_values(corner, *along);
            self.mix_values(corner, h.twin(), t, *along);
        }
        for &(h, t) in cuts {
            self.mix_values(h, self.next(h), t, h);
        }

        for (i, &[along, back]) in ring.iter().enumerate() {
            let (h, next) = (cuts[i].0, cuts[(i + 1) % n].0);
            let removed = self.next(h.twin());
            if removed != next {
                self.replace_first_of_face(removed, along);
            }
            self.set_face(along, self.face(h.twin()));
            self.set_next(h.twin(), along);
            self.set_next(along, next);
            self.set_face(back, Some(new));
            self.set_next(back, ring[(i + n - 1) % n][1]);
            self.copy_values(next, back);
            self.set_origin(h, ends[i]);
        }
        new
    }
}

#[cfg(test)]
mod tests;
