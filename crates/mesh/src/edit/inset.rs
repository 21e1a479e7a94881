//! Insetting a face: adding a smaller copy of the face inside the face. The copy lies in the face, or above or below
//! the face.

use glam::DVec3;

use super::check_finite;
use super::extrude::Rim;
use crate::{EditError, FaceId, HalfEdgeId, Id, Mesh, VertexId};

impl Mesh {
    /// Insets `f`: shrinks it towards its center and surrounds it by a ring of quads.
    ///
    /// ```text
    ///    w ------------- v              w ------------- v
    ///    |               |              | \     s     / |
    ///    |               |              |   w'---- v'   |      v' = (1 - t) v + t c
    ///    |       f       |     -->      |   |  f   |    |      c the mean of the corners of f
    ///    |               |              |   +------+    |      t the fraction
    ///    |               |              | /          \  |
    ///    + ------------- +              + ------------- +
    /// ```
    ///
    /// If `f` has n corners, the numbers of vertices, edges and faces grow by n, 2n and n. The inner face keeps the id
    /// of `f`, and its first corner is the copy of the first corner of `f`. Existing vertices and edges do not move. As
    /// in [`extrude_faces`](Self::extrude_faces), the new elements are numbered in the order of the half-edges h of
    /// `f`, counter-clockwise from the first. Let h run from v to w, and let v' and w' be the copies of v and w. For
    /// this h, the edit adds the vertex v', the edges v'-w' and v-v' in this order, and the face (v, w, w', v'), which
    /// stores h as its half-edge.
    ///
    /// Each new vertex, and each corner at a new vertex, gets values that are interpolated with t = `fraction`. At t =
    /// 0, the interpolated values are the values at the outer corner. At t = 1, they are the mean of the values at all
    /// corners of the face. Attributes that are not interpolated are copied from the outer corner. Inner edges have the
    /// values of the outer edges, and the faces of the ring have the values of `f`. The attribute values of the edges
    /// between outer and inner vertices are zero.
    ///
    /// Returns the faces of the ring, in the order of the half-edges of `f`.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::BadNumber`] if `fraction` is not strictly between 0 and 1, and [`EditError::SameFace`] if
    /// `f` lies on both sides of one of its edges. Returns [`EditError::NoSuchFace`] if `f` does not exist, and
    /// [`EditError::Full`] if there are not enough ids for the new elements. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::square();
    /// let f = mesh.faces().next().unwrap();
    /// let ring = mesh.inset_face(f, 0.5)?;
    /// assert_eq!(ring.len(), 4);
    /// assert_eq!(mesh.face_area(f), 0.25);
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn inset_face(&mut self, f: FaceId, fraction: f64) -> Result<Vec<FaceId>, EditError> {
        self.inset(f, fraction, DVec3::ZERO)
    }

    /// Insets a face like [`inset_face`](Self::inset_face), and raises the inner face by `height` along the
    /// normal of `f`, in scene units. A negative height lowers the inner face. A zero-area face has no normal, so its
    /// inner face is not raised.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`inset_face`](Self::inset_face). Also returns [`EditError::BadNumber`] if
    /// `height` or a raised coordinate is not finite.
    pub fn bevel_face(
        &mut self,
        f: FaceId,
        fraction: f64,
        height: f64,
    ) -> Result<Vec<FaceId>, EditError> {
        self.check_face(f)?;
        self.inset(f, fraction, height * self.face_normal(f))
    }

    fn inset(&mut self, f: FaceId, t: f64, offset: DVec3) -> Result<Vec<FaceId>, EditError> {
        let rim = Rim::of(self, &[f])?;
        if !(t > 0.0 && t < 1.0) {
            return Err(EditError::BadNumber(t));
        }
        let corners: Vec<HalfEdgeId> = self.face_half_edges(f).collect();
        if let Some(h) = corners.iter().find(|h| self.face(h.twin()) == Some(f)) {
            return Err(EditError::SameFace(h.edge()));
        }
        self.check_room(4 * corners.len())?;
        let vertices: Vec<VertexId> = self.face_vertices(f).collect();
        let center = self.face_center(f);
        let inner_position = |&v: &VertexId| (1.0 - t) * self.position(v) + t * center + offset;
        let positions: Vec<DVec3> = vertices.iter().map(inner_position).collect();
        check_finite(&positions)?;

        let ring = self.raise(&rim);
        let inner_corners: Vec<HalfEdgeId> = self.face_half_edges(f).collect();
        let inner: Vec<VertexId> = self.face_vertices(f).collect();
        for (&v, p) in inner.iter().zip(positions) {
            self.set_position(v, p);
        }
        self.mix_with_mean(&vertices, t, &inner);
        self.mix_with_mean(&corners, t, &inner_corners);
        for (i, &h) in corners.iter().enumerate() {
            let at_w = self.next(self.next(h));
            let at_v = self.next(at_w);
            self.copy_values(inner_corners[(i + 1) % corners.len()], at_w);
            self.copy_values(inner_corners[i], at_v);
        }
        Ok(ring)
    }

    /// Sets the interpolated values of each element of `to`. At `t` = 0, an element gets the values of the element with
    /// the same index in `from`. At `t` = 1, an element gets the mean of the values of all elements of `from`.
    fn mix_with_mean<I: Id>(&mut self, from: &[I], t: f64, to: &[I]) {
        let &[.., last] = to else { return };
        // The last element of `to` stores the mean until its own values are set at the end of the loop.
        self.average_values(from, last);
        for (&from, &to) in from.iter().zip(to) {
            self.mix_values(from, last, t, to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CREASE, MATERIAL, UV, shapes};
    use glam::DVec2;

    fn inset(mesh: &Mesh, f: usize, t: f64, height: f64) -> (Mesh, Vec<FaceId>) {
        let f = FaceId::new(f);
        let mut result = mesh.clone();
        let ring = if height == 0.0 {
            result.inset_face(f, t).unwrap()
        } else {
            result.bevel_face(f, t, height).unwrap()
        };
        assert_eq!(result.defects(), []);
        let n = mesh.degree(f);
        assert_eq!(ring.len(), n);
        assert_eq!(result.n_vertices(), mesh.n_vertices() + n);
        assert_eq!(result.n_edges(), mesh.n_edges() + 2 * n);
        assert_eq!(result.n_faces(), mesh.n_faces() + n);
        assert_eq!(result.degree(f), n);
        assert_eq!(result.boundary_loops(), mesh.boundary_loops());
        (result, ring)
    }

    #[test]
    fn ids_are_given_as_documented() {
        let (mesh, ring) = inset(&shapes::square(), 0, 0.5, 0.0);
        let corners =
            |f: FaceId| -> Vec<usize> { mesh.face_vertices(f).map(VertexId::index).collect() };
        assert_eq!(corners(FaceId::new(0)), [4, 5, 6, 7]);
        let around: Vec<_> = ring.iter().map(|&f| corners(f)).collect();
        assert_eq!(
            around,
            [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
        );
        assert_eq!(ring, [1, 2, 3, 4].map(FaceId::new));
        assert_eq!(mesh.position(VertexId::new(4)), DVec3::new(0.25, 0.25, 0.0));
    }

    #[test]
    fn an_inset_changes_neither_area_nor_shape_of_flat_faces() {
        for shape in [
            shapes::cube(),
            shapes::octahedron(),
            shapes::cylinder(7, true),
        ] {
            for f in 0..shape.n_faces() {
                let (mesh, _) = inset(&shape, f, 0.25, 0.0);
                assert!(
                    (crate::geometry::area(&mesh) - crate::geometry::area(&shape)).abs() < 1e-12
                );
                assert!(
                    (crate::geometry::volume(&mesh) - crate::geometry::volume(&shape)).abs()
                        < 1e-12
                );
                let f = FaceId::new(f);
                let shrunk = 0.75 * 0.75 * shape.face_area(f);
                assert!((mesh.face_area(f) - shrunk).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_beveled_face_is_raised_along_its_normal() {
        for (f, normal) in [(1, DVec3::Z), (2, DVec3::NEG_Y), (3, DVec3::X)] {
            let (mesh, _) = inset(&shapes::cube(), f, 0.5, 0.75);
            assert_eq!(mesh.face_center(FaceId::new(f)), 1.75 * normal);
            let (mesh, _) = inset(&shapes::cube(), f, 0.5, -0.75);
            assert_eq!(mesh.face_center(FaceId::new(f)), 0.25 * normal);
        }
    }

    #[test]
    fn linear_corner_values_stay_linear() {
        let mut mesh = shapes::grid(3, 2);
        let uv = |p: DVec3| DVec2::new(0.5 * p.x - p.y + 3.0, 2.0 * p.y + 0.25 * p.x);
        let uvs = |mesh: &Mesh| -> Vec<DVec2> {
            mesh.half_edges()
                .map(|h| uv(mesh.position(mesh.origin(h))))
                .collect()
        };
        mesh.set(UV, uvs(&mesh));
        for f in 0..6 {
            (mesh, _) = inset(&mesh, f, 0.375, 0.0);
        }
        let expected = uvs(&mesh);
        for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
            let found = mesh.get(UV).unwrap()[h.index()];
            assert!((found - expected[h.index()]).length() < 1e-14, "{h}");
        }
    }

    #[test]
    fn values_of_faces_and_edges_are_copied() {
        let mut mesh = shapes::cube();
        mesh.set(MATERIAL, (0..6).collect());
        mesh.set(CREASE, (1..13).map(f64::from).collect());
        let (mesh, _) = inset(&mesh, 4, 0.5, 1.0);
        assert_eq!(mesh.get(MATERIAL).unwrap()[6..], [4; 4]);
        let creases = mesh.get(CREASE).unwrap();
        let inner = mesh.face_half_edges(FaceId::new(4)).map(HalfEdgeId::edge);
        assert!(inner.into_iter().all(|e| creases[e.index()] > 0.0));
        assert_eq!(creases[12..].iter().filter(|&&c| c == 0.0).count(), 4);
    }

    #[test]
    fn every_inset_can_be_undone_and_redone() {
        for shape in [
            shapes::grid(2, 2),
            shapes::cube(),
            shapes::tetrahedron(),
            shapes::icosahedron(),
            shapes::torus(5, 3, 2.0, 1.0),
            shapes::cylinder(6, true),
        ] {
            for f in shape.faces() {
                let after = inset(&shape, f.index(), 0.25, 0.5).0;
                let mut mesh = shape.clone();
                mesh.begin();
                mesh.bevel_face(f, 0.25, 0.5).unwrap();
                mesh.rollback();
                assert_eq!(mesh, shape);
                mesh.begin();
                mesh.bevel_face(f, 0.25, 0.5).unwrap();
                let change = mesh.commit().unwrap();
                let redo = mesh.revert(change);
                assert_eq!(mesh, shape);
                mesh.revert(redo);
                assert_eq!(mesh, after);
            }
        }
    }

    #[test]
    fn bad_input_is_refused_and_changes_nothing() {
        let cube = shapes::cube();
        let refused = |f: usize, t: f64, height: f64| {
            let mut mesh = cube.clone();
            let reason = mesh.bevel_face(FaceId::new(f), t, height).unwrap_err();
            assert_eq!(mesh, cube);
            reason
        };
        assert_eq!(refused(6, 0.5, 0.0), EditError::NoSuchFace(FaceId::new(6)));
        for t in [0.0, 1.0, -1.0, 2.0, f64::NAN] {
            assert!(matches!(refused(0, t, 0.0), EditError::BadNumber(_)), "{t}");
        }
        for height in [f64::NAN, f64::INFINITY] {
            let reason = refused(0, 0.5, height);
            assert!(matches!(reason, EditError::BadNumber(_)), "{height}");
        }
    }

    #[test]
    fn a_face_on_both_sides_of_an_edge_is_refused() {
        let ring = crate::edit::extrude::tests::slit_ring();
        let f = FaceId::new(0);
        let mut mesh = ring.clone();
        let result = mesh.inset_face(f, 0.5);
        assert!(matches!(result, Err(EditError::SameFace(_))), "{result:?}");
        assert_eq!(mesh, ring);
    }
}
