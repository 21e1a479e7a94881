//! Joining two holes by a band of faces.

use crate::{EdgeId, EditError, FaceId, HalfEdgeId, Mesh};

impl Mesh {
    /// Joins the holes of `h` and `g`, half-edges without faces, by a band of faces.
    ///
    /// ```text
    ///    --d <-g-- c--          --d --- c--         a is joined to d, the target of g, and b to c;
    ///                     -->     |  f  |           f, between h and g, is the first face,
    ///    --a --h-> b--          --a --- b--         the next ones follow at b
    /// ```
    ///
    /// The holes may be of one part of the mesh, which gets a handle, or of two, which become one. With n
    /// edges around the one and m around the other, n at least m, the band has n faces and as many new edges:
    /// m quads, and n - m triangles spread evenly between them, each at an edge of the longer loop. Quads
    /// between loops that are turned against each other are not flat: choose h and g for the pair of edges
    /// that belong together.
    ///
    /// All ids stay. New edges and faces are numbered along the longer loop (that of `h` if they are equal),
    /// beginning with a-d and f. A face takes the values of the one beside its edge of the longer loop;
    /// a corner takes those of the corner at the same vertex in the face beside its edge of the loop, and in
    /// a triangle whose side is but a point of the shorter loop, beside the edge that the face before it
    /// had there. Edges get zero values.
    ///
    /// Returns the faces.
    ///
    /// # Errors
    ///
    /// [`EditError::NotBoundary`] if one has a face, [`EditError::SameLoop`] if they lie on one loop,
    /// [`EditError::DuplicateEdge`] if two vertices that would be joined share an edge already,
    /// [`EditError::NoSuchHalfEdge`], [`EditError::Full`]. The mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// // A tunnel between two faces that lie opposite to each other.
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
        // The loops run against each other, as the sides of a street do.
        short[1..].reverse();
        let (n, m) = (long.len(), short.len());
        // Where on the short loop the rung ends that begins at the origin of the i-th half-edge of the long
        // one: rounded up, so that the first face is a quad.
        let place = |i: usize| (i * m).div_ceil(n);
        let rungs: Vec<_> = (0..n)
            .map(|i| (self.origin(long[i]), self.target(short[place(i) % m])))
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
            let (at, next_at) = (place(i), place(i + 1));
            let [onward, _] = rungs[(i + 1) % n].half_edges();
            let [_, back] = rungs[i].half_edges();
            let side = long[i];
            // Each half-edge with the corner that it takes its values from.
            let mut sides = vec![(side, self.corner_beside(side)), (onward, side.twin())];
            if next_at > at {
                let across = short[at];
                sides.push((across, self.corner_beside(across)));
                sides.push((back, across.twin()));
            } else {
                sides.push((back, self.corner_beside(short[at - 1])));
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
