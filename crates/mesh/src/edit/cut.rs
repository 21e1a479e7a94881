//! Cutting a mesh open along edges.

use super::sorted_unique;
use crate::{EdgeId, EditError, HalfEdgeId, Mesh, VertexId};

/// A part of the faces around a vertex, between two cuts, or between a cut and the boundary.
struct Part {
    /// The outgoing half-edges of the vertex, clockwise. The first half-edge has no face.
    outgoing: Vec<HalfEdgeId>,
    /// The boundary half-edge that ends at the vertex.
    incoming: HalfEdgeId,
}

impl Mesh {
    /// Cuts the mesh open along edges, which can form any set of paths, loops and trees.
    ///
    /// ```text
    ///    +-----+-----+          +-----+ +-----+
    ///    |     e     |          |     e n     |         e keeps the face of its first half
    ///    +-----v-----+    -->   +-----v w-----+         n is new and gets the other face
    ///    |     e2    |          |     e2 n2   |
    ///    +-----u-----+          +-----u-----+           u: the end of a cut inside the mesh is not split
    ///    |     |     |          |     |     |
    /// ```
    ///
    /// The cuts can divide the faces around a vertex into several parts. The part with the lowest face id then keeps
    /// the vertex, and each other part gets a copy of the vertex. The copies of a vertex are ordered by the lowest face
    /// id of their parts. New vertices are numbered in the order of the old vertices, and new edges in the order of
    /// `edges`. Faces keep their ids. The copies of vertices and edges have the values of the originals, and corners
    /// keep their values. Positions do not change: both sides of a cut coincide. [`stitch_edges`](Self::stitch_edges)
    /// is the inverse.
    ///
    /// An edge can be cut only if the cut splits at least one of its ends. Otherwise, the cut would be a hole with two
    /// edges (a slit). A slit cannot be opened, and a list of polygons cannot represent it. The function
    /// [`slits`](Self::slits) lists the edges that cannot be cut for this reason.
    ///
    /// Returns the new edges. After the cut, new edge i lies on the other side of the cut along `edges[i]`.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Boundary`] if an edge is on the boundary. Returns [`EditError::DuplicateEdge`], with the
    /// ends of the edge, if an edge would become a slit. Returns [`EditError::EdgeListedTwice`] or
    /// [`EditError::NoSuchEdge`] if an edge is listed twice or does not exist. Returns [`EditError::NoElements`] if the
    /// list is empty, and [`EditError::Full`] if there are not enough ids for the new elements. After an error, the
    /// mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// // Cutting the ring around the middle of an octahedron gives two pyramids.
    /// let mut mesh = geometry::shapes::octahedron();
    /// let ring: Vec<_> = mesh
    ///     .edges()
    ///     .filter(|&e| mesh.edge_vertices(e).iter().all(|&v| mesh.position(v).z == 0.0))
    ///     .collect();
    /// mesh.cut_edges(&ring)?;
    /// assert_eq!((geometry::n_components(&mesh), mesh.n_vertices()), (2, 10));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn cut_edges(&mut self, edges: &[EdgeId]) -> Result<Vec<EdgeId>, EditError> {
        if edges.is_empty() {
            return Err(EditError::NoElements);
        }
        let mut sorted = edges.to_vec();
        sorted.sort_unstable();
        for (i, &e) in sorted.iter().enumerate() {
            self.check_edge(e)?;
            if self.is_boundary_edge(e) {
                return Err(EditError::Boundary(e));
            }
            if i > 0 && sorted[i - 1] == e {
                return Err(EditError::EdgeListedTwice(e));
            }
        }
        if let Some(&e) = self.slits(&sorted).first() {
            let [v, w] = self.edge_vertices(e);
            return Err(EditError::DuplicateEdge(v, w));
        }
        self.check_room(2 * edges.len())?;

        self.drop_columns_by_rule();
        // The half-edges around each vertex are listed before the edges are duplicated, because `duplicate_edges`
        // changes the links between half-edges.
        let vertices = sorted_unique(sorted.iter().flat_map(|&e| self.edge_vertices(e)));
        let is_cut = |h: HalfEdgeId| sorted.binary_search(&h.edge()).is_ok();
        let fans: Vec<Vec<HalfEdgeId>> = vertices
            .iter()
            .map(|&v| self.fan_from_gap(v, is_cut))
            .collect();

        let new = self.duplicate_edges(edges);
        let mut copies: Vec<(EdgeId, EdgeId)> =
            edges.iter().copied().zip(new.iter().copied()).collect();
        copies.sort_unstable();
        let copy_of = |h: HalfEdgeId| {
            let index = copies.binary_search_by_key(&h.edge(), |&(old, _)| old);
            index.ok().map(|i| copies[i].1)
        };
        for (v, fan) in vertices.into_iter().zip(fans) {
            let mut parts = parts(&fan, copy_of);
            parts.sort_by_key(|part| part.outgoing.iter().filter_map(|&h| self.face(h)).min());
            for (i, part) in parts.into_iter().enumerate() {
                let owner = if i == 0 {
                    v
                } else {
                    self.push_copy_of_vertex(v)
                };
                self.set_next(part.incoming, part.outgoing[0]);
                self.set_vertex_half_edge(owner, Some(part.outgoing[0]));
                for h in part.outgoing {
                    self.set_origin(h, owner);
                }
            }
        }
        Ok(new)
    }

    /// If all of `edges` were cut, some of them would become slits. Returns these edges in order of ids. An edge
    /// becomes a slit if both of its ends are inside the mesh, and no other edge in the list `edges` meets it at one of
    /// its ends.
    ///
    /// # Panics
    ///
    /// Panics if an edge does not exist.
    pub fn slits(&self, edges: &[EdgeId]) -> Vec<EdgeId> {
        let mut edges = sorted_unique(edges.iter().copied());
        let mut ends: Vec<VertexId> = edges.iter().flat_map(|&e| self.edge_vertices(e)).collect();
        ends.sort_unstable();
        let is_end = |v: VertexId| {
            let first = ends.partition_point(|&w| w < v);
            !self.is_boundary_vertex(v) && ends.get(first + 1) != Some(&v)
        };
        edges.retain(|&e| self.edge_vertices(e).into_iter().all(is_end));
        edges
    }

    /// Returns the outgoing half-edges of `v`, clockwise from the boundary. If `v` is inside the mesh, the list starts
    /// at an edge that will be cut.
    fn fan_from_gap(&self, v: VertexId, is_cut: impl Fn(HalfEdgeId) -> bool) -> Vec<HalfEdgeId> {
        let mut fan: Vec<HalfEdgeId> = self.vertex_half_edges(v).collect();
        if !self.is_boundary_vertex(v) {
            let first = fan.iter().position(|&h| is_cut(h)).unwrap_or_default();
            fan.rotate_left(first);
        }
        fan
    }

    /// Adds a copy of each edge. The copy gets the face of the second half-edge of the edge. The caller must set the
    /// `next` of the half-edges without a face.
    fn duplicate_edges(&mut self, edges: &[EdgeId]) -> Vec<EdgeId> {
        // For each edge, find the half-edge before its second half-edge. While the mesh is still valid, `prev` is fast,
        // even in a face with many corners.
        let second_halves = edges.iter().map(|e| e.half_edges()[1]);
        let before: Vec<HalfEdgeId> = second_halves.map(|h| self.prev(h)).collect();
        let pairs = edges.iter().zip(before);
        pairs.map(|(&e, h)| self.duplicate_edge(e, h)).collect()
    }

    /// Adds a copy of `e` that gets the face of the second half-edge of `e`. Before any edge was duplicated, the
    /// half-edge `before` preceded the second half-edge of `e`.
    fn duplicate_edge(&mut self, e: EdgeId, before: HalfEdgeId) -> EdgeId {
        let [_, old] = e.half_edges();
        let (after, face) = (self.next(old), self.face(old));
        // If a copy has already replaced `before` in the face, `next` leads from `before` to the copy.
        let before = if self.face(before).is_none() {
            self.next(before)
        } else {
            before
        };
        let new = self.push_edge(self.target(old), self.origin(old));
        let [_, kept] = new.half_edges();
        self.copy_values(e, new);
        self.copy_values(old, kept);
        self.set_next(before, kept);
        self.set_next(kept, after);
        self.set_face(kept, face);
        self.replace_first_of_face(old, kept);
        self.set_face(old, None);
        self.set_next(old, kept);
        new
    }
}

/// Returns the parts of a fan after its cut edges were duplicated. The fan must start at the boundary or at a cut.
fn parts(fan: &[HalfEdgeId], copy_of: impl Fn(HalfEdgeId) -> Option<EdgeId>) -> Vec<Part> {
    // Returns the two outgoing half-edges at the cut along the edge of h, in clockwise order: the last half-edge of the
    // part before the cut, and the first half-edge of the part after the cut. The latter is on the boundary.
    let sides = |h: HalfEdgeId| {
        let [first, second] = copy_of(h)?.half_edges();
        let is_first = h == h.edge().half_edge();
        Some(if is_first { (h, first) } else { (second, h) })
    };
    let mut parts = Vec::new();
    let mut outgoing = Vec::new();
    for (i, &h) in fan.iter().enumerate() {
        let Some((before, after)) = sides(h) else {
            outgoing.push(h);
            continue;
        };
        if i > 0 {
            outgoing.push(before);
            let incoming = before.twin();
            parts.push(Part { outgoing, incoming });
        }
        outgoing = vec![after];
    }
    // The last part ends at the boundary, or at the cut where the first part starts.
    outgoing.extend(sides(fan[0]).map(|(before, _)| before));
    let incoming = outgoing[outgoing.len() - 1].twin();
    parts.push(Part { outgoing, incoming });
    parts
}

#[cfg(test)]
mod tests;
