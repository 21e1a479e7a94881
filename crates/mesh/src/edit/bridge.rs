//! Connects two holes by a band of faces.

use crate::{EdgeId, EditError, FaceId, HalfEdgeId, Mesh};

impl Mesh {
    /// Connects two holes by a band of faces. `h` is a half-edge of one hole, and `g` is a half-edge of the other.
    /// Neither of them has a face.
    ///
    /// ```text
    ///    --d <-g-- c--          --d --- c--         a is joined to d, the target of g, and b to c.
    ///                     -->     |  f  |           f, between h and g, is the first face
    ///    --a --h-> b--          --a --- b--
    /// ```
    ///
    /// If both holes belong to one component of the mesh, this component gets a handle. If the holes belong to two
    /// components, the two components become one. Let n be the number of edges of the longer loop, and m the number of
    /// edges of the shorter loop. The band has n new edges and n faces: m quads, and n - m triangles that are spread
    /// evenly between the quads. One side of each triangle is an edge of the longer loop. Choose `h` and `g` so that
    /// they face each other; otherwise the band is twisted.
    ///
    /// All existing ids stay the same. New edges and faces are numbered along the longer loop (the loop of `h` if both
    /// loops have the same length). The first face lies between `h` and `g`. The first new edge joins the origin of `h`
    /// to the target of `g`. If the loop of `g` is longer, the edge joins the origin of `g` to the target of `h`
    /// instead. Each new face has one edge of the longer loop, and gets the values of the old face on the other side of
    /// this edge. Each new corner lies on one of the two loops. If the new face has an edge of this loop, the corner
    /// copies the corner at the same vertex on the other side of this edge. A triangle has no edge of the shorter loop.
    /// A corner of a triangle at the shorter loop uses the edge of the last quad before the triangle instead. The
    /// attribute values of new edges are zero.
    ///
    /// Returns the new faces.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::NotBoundary`] if `h` or `g` has a face, and [`EditError::SameLoop`] if they lie on the same
    /// loop. Returns [`EditError::DuplicateEdge`] if a new edge would join two vertices that already share an edge, or
    /// a vertex to itself. Returns [`EditError::NoSuchHalfEdge`] if `h` or `g` does not exist, and [`EditError::Full`]
    /// if there are not enough ids for the new elements. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// // A tunnel between two opposite faces.
    /// let mut mesh = geometry::shapes::icosahedron();
    /// let faces = [mesh::FaceId::new(0), mesh::FaceId::new(13)];
    /// let [h, g] = faces.map(|f| mesh.face_half_edge(f));
    /// for f in faces {
    ///     mesh.delete_face(f)?;
    /// }
    /// let tunnel = mesh.bridge_loops(h, g)?;
    /// assert_eq!((tunnel.len(), geometry::genus(&mesh)), (3, 1));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn bridge_loops(&mut self, h: HalfEdgeId, g: HalfEdgeId) -> Result<Vec<FaceId>, EditError> {
        self.check_hole(h)?;
        self.check_hole(g)?;
        let mut long: Vec<HalfEdgeId> = self.loop_half_edges(h).collect();
        if long.contains(&g) {
            return Err(EditError::SameLoop(h, g));
        }
        let mut short: Vec<HalfEdgeId> = self.loop_half_edges(g).collect();
        if long.len() < short.len() {
            std::mem::swap(&mut long, &mut short);
        }
        // The first half-edge of the short loop stays first; the others are put in reverse order, because the two loops
        // run in opposite directions.
        short[1..].reverse();
        let (n, m) = (long.len(), short.len());
        // Rung i is a new edge between the loops. It joins the origin of half-edge i of the long loop to the target of
        // half-edge `short_index(i)` of the short loop. `short_index` rounds up, so that the first face is a quad.
        let short_index = |i: usize| (i * m).div_ceil(n);
        let rungs: Vec<_> = (0..n)
            .map(|i| (self.origin(long[i]), self.target(short[short_index(i) % m])))
            .collect();
        if let Some(&(v, w)) = rungs
            .iter()
            .find(|&&(v, w)| v == w || self.find_half_edge(v, w).is_some())
        {
            return Err(EditError::DuplicateEdge(v, w));
        }
        self.check_room(2 * n)?;

        self.drop_columns_by_rule();
        let rungs: Vec<EdgeId> = rungs
            .into_iter()
            .map(|(v, w)| self.push_edge(v, w))
            .collect();
        let mut band = Vec::with_capacity(n);
        for i in 0..n {
            let (k, next_k) = (short_index(i), short_index(i + 1));
            let [next_rung, _] = rungs[(i + 1) % n].half_edges();
            let [_, rung_back] = rungs[i].half_edges();
            let side = long[i];
            // Each pair consists of a half-edge of the new face and the corner whose values this half-edge gets.
            let mut sides = vec![(side, self.corner_beside(side)), (next_rung, side.twin())];
            if next_k > k {
                let opposite = short[k];
                sides.push((opposite, self.corner_beside(opposite)));
                sides.push((rung_back, opposite.twin()));
            } else {
                sides.push((rung_back, self.corner_beside(short[k - 1])));
            }
            let f = self.push_face(side);
            self.copy_face_beside(side, f);
            let around: Vec<HalfEdgeId> = sides.iter().map(|&(x, _)| x).collect();
            self.link_around(f, &around);
            for (x, corner) in sides {
                self.copy_values(corner, x);
            }
            band.push(f);
        }
        Ok(band)
    }
}

#[cfg(test)]
mod tests;
