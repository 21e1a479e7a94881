//! Collapses an edge to a vertex.

use glam::DVec3;

use super::check_finite;
use crate::{EdgeId, EditError, HalfEdgeId, Id, Mesh, VertexId};

impl Mesh {
    /// Collapses an edge to its midpoint: its two ends become one vertex.
    ///
    /// ```text
    ///        c               c                 +-----c           +-----c
    ///      / f \             |                 |  f  |           |   f  \
    ///    a --e-- b    -->    v                 a--e--b    -->    v-------+
    ///      \ g /             |                 |  g  |           |   g  /
    ///        d               d                 d-----+           d-----+
    /// ```
    ///
    /// The merged vertex v is the end with the lower id; the other end and `e` are removed. A triangle beside `e` is
    /// removed, and its other two edges become one: the edge at v remains, and the other edge is removed. A face beside
    /// `e` with more than three corners loses one corner, and a hole beside `e` loses one edge. Let V, E and F be the
    /// numbers of vertices, edges and faces. Inside a triangle mesh, V, E and F decrease by 1, 3 and 2; on its
    /// boundary, by 1, 2 and 1. V - E + F stays the same. No ids are added, and all other elements keep their ids.
    ///
    /// Vertex attributes of v are interpolated between the two ends, except attributes whose rule does not interpolate:
    /// these keep their values at v. At v, the corners of the faces beside `e` get interpolated values. The values of
    /// each corner are interpolated within its face, so both sides of a seam stay separate. A face that is not beside
    /// `e` can also have a corner at an end of `e`. For each attribute, the old value of this corner is compared with
    /// the old value that each face beside `e` has at the same end. If the values are equal for one of these faces, the
    /// corner gets the new value of this face at v. Otherwise, the corner keeps its old value. When two edges become
    /// one, the remaining edge gets the larger of the two values of each floating-point attribute, so that creases are
    /// preserved. A tag is set if either edge had this tag. Attributes of other types keep the value of the remaining
    /// edge.
    ///
    /// A collapse is refused if it would change the topology of the surface or make two elements coincide. The test is
    /// the link condition of Dey, Edelsbrunner, Guha and Nekhayev ("Topology preserving edge contraction", 1999),
    /// extended to polygons. For this test, each hole is treated as if a cone of triangles closed it: the triangles
    /// join the edges of the hole to an additional vertex. The two ends of `e` are allowed to share a neighbor only if
    /// this neighbor is a corner of a triangle beside `e`. The two ends are allowed to share a face only if this face
    /// is beside `e`.
    ///
    /// Returns v.
    ///
    /// # Errors
    ///
    /// - [`EditError::JoinsBoundaries`] if both ends are on the boundary, but `e` is not.
    /// - [`EditError::Link`] if the ends have a common neighbor that is not a corner of a triangle beside `e`. After
    ///   the collapse, two edges would join this neighbor to the merged vertex. This error is also returned if `e` is a
    ///   side of a hole with three edges.
    /// - [`EditError::DuplicateEdge`] if a second edge joins the ends.
    /// - [`EditError::VisitsTwice`] if a face that is not beside `e` has both ends as corners, because this face would
    ///   contain the merged vertex twice.
    /// - [`EditError::Vanishes`] if no faces would be left, as for the edges of a single triangle. This error is also
    ///   returned if the only faces left at the merged vertex would be two faces back to back, as for a tetrahedron.
    /// - [`EditError::SameFace`] if one face is on both sides of `e`, or if two edges would become one edge with the
    ///   same face on both sides. [`EditError::SameOpposite`] if two triangles beside `e` share a second edge. In these
    ///   two cases, a collapse would be possible, but it is not implemented, because these cases are rare.
    /// - [`EditError::NoSuchEdge`].
    ///
    /// After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::icosahedron();
    /// let e = mesh.edges().next().unwrap();
    /// let v = mesh.collapse_edge(e)?;
    /// assert_eq!((mesh.n_vertices(), mesh.n_faces()), (11, 18));
    /// assert_eq!(mesh.valence(v), 6);
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn collapse_edge(&mut self, e: EdgeId) -> Result<VertexId, EditError> {
        self.collapse_edge_at(e, 0.5)
    }

    /// Collapses an edge like [`collapse_edge`](Self::collapse_edge), but to the point at `t` on the edge. `t` is 0 at
    /// the origin of the first half-edge of the edge, and 1 at the target of this half-edge.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`collapse_edge`](Self::collapse_edge), and [`EditError::OutsideEdge`] if
    /// `t` is below 0, above 1 or not a number.
    pub fn collapse_edge_at(&mut self, e: EdgeId, t: f64) -> Result<VertexId, EditError> {
        self.check_edge(e)?;
        if !(0.0..=1.0).contains(&t) {
            return Err(EditError::OutsideEdge(t));
        }
        let [a, b] = self.edge_vertices(e).map(|v| self.position(v));
        let point = (1.0 - t) * a + t * b;
        self.check_collapse_to(e, point)?;
        Ok(self.collapse(e, t, point))
    }

    /// Collapses an edge like [`collapse_edge`](Self::collapse_edge), but to any given point. The attributes are
    /// interpolated at the point on the edge that is nearest to the given point. If both ends of the edge have the same
    /// position, the attributes are interpolated at the middle of the edge.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`collapse_edge`](Self::collapse_edge), and [`EditError::BadNumber`] if a
    /// coordinate is not finite.
    pub fn collapse_edge_to(&mut self, e: EdgeId, point: DVec3) -> Result<VertexId, EditError> {
        self.check_collapse_to(e, point)?;
        Ok(self.collapse_checked_edge_to(e, point))
    }

    /// Checks whether [`collapse_edge_to`](Self::collapse_edge_to) would succeed.
    ///
    /// # Errors
    ///
    /// Returns the error that [`collapse_edge_to`](Self::collapse_edge_to) would return.
    pub fn check_collapse_to(&self, e: EdgeId, point: DVec3) -> Result<(), EditError> {
        self.check_edge(e)?;
        check_finite(&[point])?;
        self.check_collapse(e)
    }

    /// Collapses an edge like [`collapse_edge_to`](Self::collapse_edge_to), but without any check. Call this function
    /// only if [`check_collapse_to`](Self::check_collapse_to) succeeds.
    ///
    /// Several threads can check many edges, and then these edges can be collapsed one after the other without a second
    /// check. The mesh must be a mesh of triangles, and the edges must be far from each other: no end of an edge may be
    /// an end of another edge or a neighbor of such an end. Then no collapse changes the result of the check for another
    /// edge.
    ///
    /// # Panics
    ///
    /// Debug builds panic if the check does not succeed. Release builds can then panic too, or leave the mesh invalid.
    pub fn collapse_checked_edge_to(&mut self, e: EdgeId, point: DVec3) -> VertexId {
        debug_assert_eq!(self.check_collapse_to(e, point), Ok(()));
        let [a, b] = self.edge_vertices(e).map(|v| self.position(v));
        let t = (point - a).dot(b - a) / (b - a).length_squared();
        let t = if t.is_nan() { 0.5 } else { t.clamp(0.0, 1.0) };
        self.collapse(e, t, point)
    }

    fn collapse(&mut self, e: EdgeId, t: f64, point: DVec3) -> VertexId {
        let sides = e.half_edges();
        let [a, b] = self.edge_vertices(e);
        let (v, removed) = (a.min(b), a.max(b));

        self.drop_columns_by_rule();
        self.mix_corners_along(e, t, v);
        self.mix_values(a, b, t, v);
        self.set_position(v, point);
        self.move_half_edges(sides[usize::from(v == a)], v);

        let before = sides.map(|h| self.prev(h));
        let vanishes = sides.map(|h| self.is_beside_triangle(h));
        for (h, before) in sides.into_iter().zip(before) {
            let after = self.next(h);
            self.set_next(before, after);
            self.replace_first_of_face(h, after);
        }
        self.kill(e);
        self.kill(removed);
        // If a face beside e was a triangle, it now has only two edges. Of these two edges, the one that ends at the
        // removed vertex is removed too. Around the face of the first half-edge of e, the edge at vertex b comes after
        // e, and the edge at vertex a comes before e. Around the face of the second half-edge, the edge at vertex a
        // comes after e, and the edge at vertex b comes before e.
        for (i, h) in sides.into_iter().enumerate().filter(|&(i, _)| vanishes[i]) {
            let after = self.next(h);
            if (removed == b) == (i == 0) {
                self.remove_two_gon(after, before[i]);
            } else {
                self.remove_two_gon(before[i], after);
            }
        }
        v
    }

    // ---- Checks --------------------------------------------------------------------------------

    fn check_collapse(&self, e: EdgeId) -> Result<(), EditError> {
        let [ab, ba] = e.half_edges();
        let (a, b) = (self.origin(ab), self.origin(ba));
        let (f, g) = (self.face(ab), self.face(ba));
        if f == g {
            return Err(EditError::SameFace(e));
        }
        let is_inside = f.is_some() && g.is_some();
        let at_boundary = [a, b].map(|v| self.is_boundary_vertex(v));
        if is_inside && at_boundary == [true; 2] {
            return Err(EditError::JoinsBoundaries(e));
        }
        self.check_outer_faces(e)?;

        // The third corners of the triangles beside the edge. Only these corners are allowed to be neighbors of both
        // ends.
        let apexes = [ab, ba].map(|h| {
            self.is_beside_triangle(h)
                .then(|| self.target(self.next(h)))
        });
        // The neighbors of b, except a, and the faces around b.
        let (mut vertices, mut faces) = (SmallIdSet::new(), SmallIdSet::new());
        let mut h = self.next(ab);
        while h != ba {
            vertices.push(self.target(h));
            if let Some(f) = self.face(h) {
                faces.push(f);
            }
            h = self.next(h.twin());
        }
        vertices.sort();
        faces.sort();
        let mut shared = [0; 2];
        let mut valence = vertices.len();
        let mut pinched = None;
        let mut h = self.next(ba);
        while h != ab {
            let x = self.target(h);
            if x == b {
                return Err(EditError::DuplicateEdge(a, b));
            }
            if apexes.contains(&Some(x)) {
                let i = usize::from(apexes[0] != Some(x));
                shared[i] += 1;
            } else if vertices.has(x) {
                return Err(EditError::Link(e, x));
            }
            let other = self.face(h).filter(|&p| Some(p) != f && Some(p) != g);
            pinched = pinched.or(other.filter(|&p| faces.has(p)));
            valence += 1;
            h = self.next(h.twin());
        }
        // For each triangle beside the edge, the collapse merges the two edges that lead to the apex of the triangle.
        // The collapse is refused if it would merge more than these two edges at an apex. This happens if edges are
        // parallel, or if the apex is also the third corner of a hole with three edges.
        for (i, x) in apexes.into_iter().enumerate() {
            let merged = apexes.iter().filter(|&&apex| apex == x).count();
            if let Some(x) = x.filter(|&x| shared[i].min(vertices.count(x)) > merged) {
                return Err(EditError::Link(e, x));
            }
        }
        for h in [ab, ba] {
            if self.face(h).is_none() && self.is_loop_of_three(h) {
                return Err(EditError::Link(e, self.target(self.next(h))));
            }
        }
        if let Some(p) = pinched {
            return Err(EditError::VisitsTwice(p, a.min(b)));
        }
        let vanishing = apexes.iter().flatten().count();
        let n_left = valence.saturating_sub(vanishing);
        if vanishing > 0 && n_left == 2 && at_boundary == [false; 2] && self.would_fold(e, apexes) {
            return Err(EditError::Vanishes(e));
        }
        Ok(())
    }

    /// For each triangle beside `e`, checks its two outer faces: the faces on the far sides of its other two edges,
    /// which become one edge. At least one outer face must exist, and at least one must differ from the face on the
    /// other side of `e`. If the face on the other side of `e` is a triangle, neither outer face is allowed to be this
    /// triangle.
    fn check_outer_faces(&self, e: EdgeId) -> Result<(), EditError> {
        for h in e.half_edges() {
            if !self.is_beside_triangle(h) {
                continue;
            }
            let beside = self.face(h.twin());
            let is_triangle = self.is_beside_triangle(h.twin());
            let after = self.next(h);
            let outer = [after, self.next(after)].map(|h| self.face(h.twin()));
            match outer {
                [None, None] => return Err(EditError::Vanishes(e)),
                [x, y] if x == y && x == beside => {
                    return Err(if is_triangle {
                        EditError::Vanishes(e)
                    } else {
                        EditError::SameFace(e)
                    });
                }
                _ if is_triangle && outer.contains(&beside) => {
                    return Err(EditError::SameOpposite(e, self.target(after)));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Requires that the collapse would leave exactly two edges and two faces at the merged vertex. Returns whether
    /// these two faces would lie back to back. Two faces lie back to back if every vertex of one of them has only two
    /// edges.
    fn would_fold(&self, e: EdgeId, apexes: [Option<VertexId>; 2]) -> bool {
        let [ab, ba] = e.half_edges();
        // Finds one of the two faces at the merged vertex. A face beside e remains after the collapse if it is not a
        // triangle. If both faces beside e are triangles, the next face around vertex a remains.
        let around = match apexes {
            [None, _] => ab,
            [_, None] => ba,
            _ => self.next(self.next(ba).twin()),
        };
        let ends = self.edge_vertices(e);
        self.loop_half_edges(around).all(|h| {
            let v = self.origin(h);
            let n_removed = apexes.iter().filter(|&&x| x == Some(v)).count();
            ends.contains(&v) || self.valence(v) == 2 + n_removed
        })
    }

    fn is_loop_of_three(&self, h: HalfEdgeId) -> bool {
        self.next(self.next(self.next(h))) == h
    }

    fn is_beside_triangle(&self, h: HalfEdgeId) -> bool {
        self.face(h).is_some() && self.is_loop_of_three(h)
    }

    // ---- Changes -------------------------------------------------------------------------------

    /// Makes all half-edges that leave the origin of `h` leave `v` instead. `v` is the target of `h`.
    fn move_half_edges(&mut self, h: HalfEdgeId, v: VertexId) {
        let removed = self.origin(h);
        // The stored half-edge of a boundary vertex must be a half-edge without a face.
        let hole = [h, h.twin()].into_iter().find(|&h| self.face(h).is_none());
        if let Some(hole) = hole {
            self.set_vertex_half_edge(v, Some(self.next(hole)));
        } else if self.is_boundary_vertex(removed) {
            self.set_vertex_half_edge(v, self.vertex_half_edge(removed));
        } else if self.vertex_half_edge(v) == Some(h.twin()) {
            self.set_vertex_half_edge(v, Some(self.next(h)));
        }
        let mut moved = self.next(h.twin());
        while moved != h {
            self.set_origin(moved, v);
            moved = self.next(moved.twin());
        }
    }

    /// Removes the face that consists of the half-edges `x` and `y` only, and removes the edge of `x`. `y`
    /// takes the place of the twin of `x`.
    fn remove_two_gon(&mut self, x: HalfEdgeId, y: HalfEdgeId) {
        let outer = x.twin();
        let (before, after) = (self.prev_in_face(outer), self.next(outer));
        let (two_gon, outer_face) = (self.face(x), self.face(outer));
        self.copy_values(outer, y);
        self.merge_values(x.edge(), y.edge());
        self.set_next(before, y);
        self.set_next(y, after);
        self.set_face(y, outer_face);
        self.replace_first_of_face(outer, y);
        self.replace_first_of_vertex(x, y.twin());
        self.replace_first_of_vertex(outer, y);
        self.kill(x.edge());
        if let Some(f) = two_gon {
            self.kill(f);
        }
    }

    /// The edge `e` will collapse to its point at the parameter `t`. Sets the values of the corners at both ends of
    /// `e`.
    fn mix_corners_along(&mut self, e: EdgeId, t: f64, v: VertexId) {
        if !self.has_corner_columns() {
            return;
        }
        // For each side of the edge, the corners of the face on this side: first the corner at a, then the corner at b.
        let [ab, ba] = e.half_edges();
        let corners = [[ab, self.next(ab)], [self.next(ba), ba]];
        let sides = [0, 1].map(|i| Some(corners[i]).filter(|_| self.face(corners[i][i]).is_some()));
        for (end, outgoing) in [ab, ba].into_iter().enumerate() {
            let mut h = self.next(outgoing.twin());
            while h != outgoing {
                let is_beside = sides.iter().flatten().any(|side| side[end] == h);
                if self.face(h).is_some() && !is_beside {
                    self.follow_values(sides, end, t, h);
                }
                h = self.next(h.twin());
            }
        }
        for (h, side) in [ab, ba].into_iter().zip(sides) {
            if let Some([at_a, at_b]) = side {
                // Values that are not interpolated are taken from the corner at v. If the result is stored at h, it is
                // copied to the half-edge after h, because h is removed.
                let at_v = if v == self.origin(ab) { at_a } else { at_b };
                self.mix_values(at_a, at_b, t, at_v);
                if at_v == h {
                    self.copy_values(h, self.next(h));
                }
            }
        }
    }
}

/// A multiset of ids that stays on the stack while it is small.
struct SmallIdSet<I> {
    on_stack: [I; 16],
    n: usize,
    /// All ids, if they do not fit on the stack; otherwise empty.
    on_heap: Vec<I>,
}

impl<I: Id + Ord> SmallIdSet<I> {
    fn new() -> Self {
        Self {
            on_stack: [I::NONE; 16],
            n: 0,
            on_heap: Vec::new(),
        }
    }

    fn push(&mut self, id: I) {
        if let Some(slot) = self.on_stack.get_mut(self.n) {
            *slot = id;
        } else {
            if self.on_heap.is_empty() {
                self.on_heap.extend(self.on_stack);
            }
            self.on_heap.push(id);
        }
        self.n += 1;
    }

    /// Sorts the ids. Must be called after the last `push`, and before `has` and `count`.
    fn sort(&mut self) {
        self.on_heap.sort_unstable();
    }

    fn len(&self) -> usize {
        self.n
    }

    fn has(&self, id: I) -> bool {
        if self.on_heap.is_empty() {
            self.on_stack[..self.n].contains(&id)
        } else {
            self.on_heap.binary_search(&id).is_ok()
        }
    }

    fn count(&self, id: I) -> usize {
        let all = if self.on_heap.is_empty() {
            &self.on_stack[..self.n]
        } else {
            &self.on_heap
        };
        all.iter().filter(|&&x| x == id).count()
    }
}

#[cfg(test)]
mod tests;
