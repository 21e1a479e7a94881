//! Splitting a vertex into an edge.

use glam::DVec3;

use super::check_finite;
use crate::{EdgeId, EditError, HalfEdgeId, Mesh};

impl Mesh {
    /// Splits a vertex into two vertices that share an edge. The new vertex gets the edges from `x` clockwise to the
    /// last edge before `y`.
    ///
    /// ```text
    ///      \  f  |x             \  f  |x
    ///       \    |               \    |          v: the origin of x and y
    ///   ----- v -----    -->   -- v-->w ----     f: the face of x, g: the face of y
    ///         |    \              |    \         w is new and has the edges from x up to y, without y
    ///        y|  g  \            y|  g  \
    /// ```
    ///
    /// The half-edges `x` and `y` leave v and stand for two corners at v: `x` stands for the corner in f, and `y` for
    /// the corner in g. The new edge runs from v to w. The first half-edge of the new edge is on f, the second
    /// half-edge is on g, and both faces gain a corner. If f or g is a hole, the new edge is on the boundary. The mesh
    /// gains one vertex and one edge. All existing ids stay the same.
    ///
    /// [`split_face`](Self::split_face) is the corresponding edit for faces. To undo the split, collapse the new edge
    /// to the old position with [`collapse_edge_to`](Self::collapse_edge_to). The collapse always succeeds if, before
    /// the split, no two edges joined v to the same vertex and no face contained v twice. To undo a collapse that
    /// removed triangles, call `split_vertex`, then `split_face`.
    ///
    /// The new vertex is at `position` and has the attributes of v. On each side of the new edge, the face has a corner
    /// at both ends of the edge; both corners have the values of the old corner on this side. The attribute values of
    /// the new edge are zero.
    ///
    /// Returns the new edge.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::WrongCorner`] if `y` does not leave the origin of `x`, and [`EditError::Adjacent`] if `x`
    /// is `y`. Returns [`EditError::VisitsTwice`] if both corners belong to the same face, and [`EditError::BadNumber`]
    /// if a coordinate is not finite. Returns [`EditError::NoSuchHalfEdge`] if `x` or `y` does not exist, and
    /// [`EditError::Full`] if there are not enough ids for the new elements. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::octahedron();
    /// let before = mesh.clone();
    /// let v = mesh.vertices().next().unwrap();
    /// let around: Vec<_> = mesh.vertex_half_edges(v).collect();
    /// let e = mesh.split_vertex(around[0], around[2], mesh.position(v) + mesh::DVec3::X)?;
    /// assert_eq!((mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()), (7, 13, 8));
    ///
    /// mesh.collapse_edge_to(e, before.position(v))?;
    /// mesh.compact();
    /// assert_eq!(mesh.positions(), before.positions());
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn split_vertex(
        &mut self,
        x: HalfEdgeId,
        y: HalfEdgeId,
        position: DVec3,
    ) -> Result<EdgeId, EditError> {
        self.check_half_edge(x)?;
        self.check_half_edge(y)?;
        check_finite(&[position])?;
        let v = self.origin(x);
        if self.origin(y) != v {
            return Err(EditError::WrongCorner(y));
        }
        if x == y {
            return Err(EditError::Adjacent(x, y));
        }
        let (f, g) = (self.face(x), self.face(y));
        if let Some(f) = f.filter(|_| f == g) {
            return Err(EditError::VisitsTwice(f, v));
        }
        self.check_room(2)?;
        let (before_x, before_y) = (self.prev(x), self.prev(y));

        self.drop_columns_by_rule();
        let w = self.push_vertex(position);
        let e = self.push_edge(v, w);
        let [vw, wv] = e.half_edges();
        self.copy_values(v, w);
        self.copy_values(x, vw);
        self.copy_values(y, wv);

        let mut h = x;
        while h != y {
            self.set_origin(h, w);
            h = self.next(h.twin());
        }
        for (before, new, after, face) in [(before_x, vw, x, f), (before_y, wv, y, g)] {
            self.set_next(before, new);
            self.set_next(new, after);
            self.set_face(new, face);
        }

        // If the stored half-edge of v now leaves w, it becomes the stored half-edge of w, and vw becomes the stored
        // half-edge of v. If the stored half-edge of v still leaves v, v keeps it, and wv becomes the stored half-edge
        // of w. In both cases, the stored half-edge of a boundary vertex is a boundary half-edge.
        let old = self.vertex_half_edge(v);
        let is_moved = old.is_some_and(|h| self.origin(h) == w);
        let first = if is_moved { old } else { Some(wv) };
        self.set_vertex_half_edge(w, first);
        if is_moved {
            self.set_vertex_half_edge(v, Some(vw));
        }
        Ok(e)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{COLOR, FaceId, UV, VertexId, shapes};
    use glam::{DVec2, DVec4};

    /// Returns the faces in order of ids. Each face is given as the list of its vertices, starting with the vertex with
    /// the lowest id.
    fn faces(mesh: &Mesh) -> Vec<(FaceId, Vec<VertexId>)> {
        let corners = |f| {
            let mut corners: Vec<VertexId> = mesh.face_vertices(f).collect();
            let low = (0..corners.len()).min_by_key(|&i| corners[i]);
            corners.rotate_left(low.unwrap_or(0));
            corners
        };
        mesh.faces().map(|f| (f, corners(f))).collect()
    }

    fn samples() -> Vec<Mesh> {
        vec![
            shapes::square(),
            shapes::grid(3, 2),
            shapes::fans(&shapes::grid(3, 2)),
            shapes::cube(),
            shapes::tetrahedron(),
            shapes::octahedron(),
            shapes::torus(3, 3, 2.0, 1.0),
            shapes::cylinder(5, false),
            shapes::icosahedron(),
        ]
    }

    /// Returns all pairs of different outgoing half-edges of the same vertex.
    fn pairs(mesh: &Mesh) -> Vec<(HalfEdgeId, HalfEdgeId)> {
        let of = |v| {
            let pairs = move |x| mesh.vertex_half_edges(v).map(move |y| (x, y));
            mesh.vertex_half_edges(v).flat_map(pairs)
        };
        let all = mesh.vertices().flat_map(of);
        all.filter(|(x, y)| x != y).collect()
    }

    #[test]
    fn the_new_vertex_takes_the_edges_from_x_clockwise_to_before_y() {
        let mut mesh = shapes::octahedron();
        let v = VertexId::new(0);
        let around: Vec<_> = mesh.vertex_half_edges(v).collect();
        let (f, g) = (mesh.face(around[1]), mesh.face(around[3]));
        let e = mesh.split_vertex(around[1], around[3], DVec3::ONE).unwrap();
        assert_eq!(mesh.defects(), []);
        let w = VertexId::new(6);
        assert_eq!(mesh.edge_vertices(e), [v, w]);
        assert_eq!(mesh.edge_faces(e), [f, g]);
        assert_eq!(mesh.position(w), DVec3::ONE);
        assert_eq!([0, 1, 2, 3].map(|i| mesh.origin(around[i])), [v, w, w, v]);
        assert_eq!([f, g].map(|f| mesh.degree(f.unwrap())), [4, 4]);
    }

    #[test]
    fn a_collapse_undoes_a_split() {
        for shape in samples() {
            for (x, y) in pairs(&shape) {
                let mut mesh = shape.clone();
                let v = mesh.origin(x);
                let e = mesh.split_vertex(x, y, DVec3::splat(9.0)).unwrap();
                assert_eq!(mesh.defects(), []);
                assert_eq!(mesh.n_boundary_loops(), shape.n_boundary_loops());
                assert_eq!(mesh.collapse_edge_to(e, shape.position(v)), Ok(v));
                assert_eq!(mesh.defects(), []);
                assert_eq!(faces(&mesh), faces(&shape));
                mesh.compact();
                assert_eq!(mesh.positions(), shape.positions());
            }
        }
    }

    #[test]
    fn a_split_undoes_a_collapse() {
        let mut n_undone = 0;
        for shape in samples() {
            for e in shape.edges() {
                let mut mesh = shape.clone();
                if mesh.collapse_edge(e).is_err() {
                    continue;
                }
                undo_collapse(&mut mesh, &shape, e);
                n_undone += 1;
                assert_eq!(mesh.defects(), []);
                mesh.compact();
                assert_eq!(mesh.n_vertices(), shape.n_vertices());
                assert_eq!(face_positions(&mesh), face_positions(&shape));
            }
        }
        assert!(n_undone > 100, "{n_undone}");
    }

    /// Undoes a collapse: splits the merged vertex. `mesh` is the mesh that results when the edge `e` of `shape`
    /// collapses.
    fn undo_collapse(mesh: &mut Mesh, shape: &Mesh, e: EdgeId) {
        // h runs from v to the removed vertex.
        let [h, twin] = e.half_edges();
        let h = if mesh.has_vertex(shape.origin(h)) {
            h
        } else {
            twin
        };
        let (v, removed) = (shape.origin(h), shape.target(h));
        let triangles = [h, h.twin()].map(|h| shape.face(h).is_some_and(|f| shape.is_triangle(f)));
        // The first and the last of the half-edges that move back to the removed vertex. If a triangle vanished, its
        // edge at the removed vertex was merged with its edge at v. In this case, the edge at v is used.
        let [mut first, mut last] = [shape.next(h), shape.prev(h.twin()).twin()];
        if triangles[0] {
            first = shape.prev(h).twin();
        }
        if triangles[1] {
            last = shape.next(h.twin());
        }
        if !mesh.has_edge(first.edge()) {
            first = last;
        }
        if !mesh.has_edge(last.edge()) {
            last = first;
        }
        let mut x = first;
        let mut y = mesh.next(last.twin());
        // The collapse merged two edges of a triangle into one edge. The triangle can be restored on each side of this
        // edge that is not a hole.
        let keep_left = triangles[0] && (mesh.face(x).is_none() || x == y);
        if keep_left {
            x = mesh.next(x.twin());
        }
        let keep_right = triangles[1] && mesh.face(y).is_none();
        if keep_right {
            y = last;
        }
        let new = mesh.split_vertex(x, y, shape.position(removed)).unwrap();
        mesh.set_position(v, shape.position(v));
        let [vw, wv] = new.half_edges();
        for (h, is_triangle, keep) in [
            (vw, triangles[0], keep_left),
            (wv, triangles[1], keep_right),
        ] {
            // On the face of h, the apex of the triangle comes after h if the merged edge leaves the target of h, and
            // before h if the merged edge leaves the origin of h.
            let is_after = (h == vw) != keep;
            if is_triangle && is_after {
                mesh.split_face(h, mesh.next(mesh.next(h))).unwrap();
            } else if is_triangle {
                mesh.split_face(mesh.next(h), mesh.prev(h)).unwrap();
            }
        }
    }

    /// Returns the corner positions of the faces, in an order that does not depend on ids.
    fn face_positions(mesh: &Mesh) -> Vec<Vec<[u64; 3]>> {
        let position = |&v: &VertexId| mesh.position(v).to_array().map(f64::to_bits);
        let mut all: Vec<Vec<_>> = faces(mesh)
            .iter()
            .map(|(_, corners)| {
                let mut positions: Vec<_> = corners.iter().map(position).collect();
                let low = (0..positions.len()).min_by_key(|&i| positions[i]);
                positions.rotate_left(low.unwrap_or(0));
                positions
            })
            .collect();
        all.sort();
        all
    }

    #[test]
    fn the_new_edge_is_on_the_boundary_if_a_corner_is_in_a_hole() {
        for shape in samples() {
            for (x, y) in pairs(&shape) {
                let is_hole = [x, y].map(|h| shape.face(h).is_none());
                let mut mesh = shape.clone();
                let e = mesh.split_vertex(x, y, DVec3::ZERO).unwrap();
                assert_eq!(mesh.is_boundary_edge(e), is_hole.contains(&true));
            }
        }
    }

    #[test]
    fn new_elements_have_the_values_of_the_vertex_and_its_corners() {
        let mut mesh = shapes::octahedron();
        let n = mesh.n_half_edges();
        mesh.set(UV, (0..n).map(|i| DVec2::splat(i as f64)).collect());
        mesh.set(COLOR, (0..6).map(|i| DVec4::splat(f64::from(i))).collect());
        let v = VertexId::new(2);
        let around: Vec<_> = mesh.vertex_half_edges(v).collect();
        let (x, y) = (around[0], around[2]);
        let e = mesh.split_vertex(x, y, DVec3::ONE).unwrap();
        let [vw, wv] = e.half_edges();
        let uv = mesh.get(UV).unwrap();
        assert_eq!(
            (uv[vw.index()], uv[wv.index()]),
            (uv[x.index()], uv[y.index()])
        );
        assert_eq!(mesh.get(COLOR).unwrap()[6], DVec4::splat(2.0));
    }

    #[test]
    fn a_split_can_be_undone_and_redone() {
        for shape in samples() {
            for (x, y) in pairs(&shape) {
                let mut mesh = shape.clone();
                mesh.begin();
                mesh.split_vertex(x, y, DVec3::ONE).unwrap();
                let after = mesh.clone();
                mesh.rollback();
                assert_eq!(mesh, shape);
                mesh.begin();
                mesh.split_vertex(x, y, DVec3::ONE).unwrap();
                let change = mesh.commit().unwrap();
                let redo = mesh.revert(change);
                assert_eq!(mesh, shape);
                mesh.revert(redo);
                assert_eq!(mesh, after);
            }
        }
    }

    #[test]
    fn half_edges_that_are_not_two_corners_of_one_vertex_are_refused() {
        let mesh = shapes::cube();
        let mut edited = mesh.clone();
        let mut refused = |x, y, p| edited.split_vertex(x, y, p).unwrap_err();
        let h = HalfEdgeId::new(0);
        let next = mesh.next(h);
        assert_eq!(refused(h, next, DVec3::ZERO), EditError::WrongCorner(next));
        assert_eq!(refused(h, h, DVec3::ZERO), EditError::Adjacent(h, h));
        let missing = HalfEdgeId::new(99);
        let no_such = EditError::NoSuchHalfEdge(missing);
        assert_eq!(refused(h, missing, DVec3::ZERO), no_such);
        assert_eq!(refused(missing, h, DVec3::ZERO), no_such);
        let other = mesh.next(h.twin());
        let error = refused(h, other, DVec3::X * f64::INFINITY);
        assert!(matches!(error, EditError::BadNumber(_)));
        assert_eq!(edited, mesh);
    }

    #[test]
    fn two_corners_of_one_face_are_refused() {
        // The two faces share two edges. After a flip of one of the shared edges, the second face contains vertex 2
        // twice.
        let polygons: [&[u32]; 2] = [&[0, 1, 2, 3], &[1, 0, 4, 3, 2, 5]];
        let (mut mesh, _) = Mesh::from_polygons(vec![DVec3::ZERO; 6], &polygons).unwrap();
        let e = mesh.find_half_edge(VertexId::new(0), VertexId::new(1));
        mesh.flip_edge(e.unwrap().edge()).unwrap();
        let f = FaceId::new(1);
        let is_corner = |&h: &HalfEdgeId| mesh.face(h) == Some(f);
        let around = mesh.vertex_half_edges(VertexId::new(2));
        let corners: Vec<_> = around.filter(is_corner).collect();
        let before = mesh.clone();
        let result = mesh.split_vertex(corners[0], corners[1], DVec3::ZERO);
        assert_eq!(result, Err(EditError::VisitsTwice(f, VertexId::new(2))));
        assert_eq!(mesh, before);
    }
}
