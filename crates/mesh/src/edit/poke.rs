//! Poking a face: adding a vertex inside it.

use glam::DVec3;

use super::{check_finite, first_repeated};
use crate::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Adds a vertex at the mean of the corners of `f` and joins it to all corners.
    ///
    /// ```text
    ///    d-----c          d-----c
    ///    |     |          | \ / |
    ///    |  f  |   -->    |  m  |        m = (a + b + c + d) / 4
    ///    |     |          | /f\ |
    ///    a-----b          a-----b
    /// ```
    ///
    /// A face with n corners becomes n triangles: the numbers of vertices, edges and faces grow by 1, n and n - 1. Let
    /// a be the first corner, from which [`face_half_edge`](Self::face_half_edge) starts. The triangle (a, b, m) keeps
    /// the id of `f`. The new elements are the edges m-a, m-b, ... and the faces (b, c, m), ... in the order of the
    /// corners. The first half-edge of each new edge starts at m.
    ///
    /// Interpolated vertex attributes at m are the mean of the attributes of the corners; other vertex
    /// attributes are zero. The corners at m get the mean of the corner values of the face; the other corners keep
    /// their values. New faces have the values of `f`. The attribute values of new edges are zero.
    ///
    /// Returns m. [`dissolve_vertex`](Self::dissolve_vertex) is the inverse.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::VisitsTwice`] if the face contains a vertex twice, because this vertex would be joined to m
    /// twice. Returns [`EditError::BadNumber`] if the mean of the corners is not finite. Returns
    /// [`EditError::NoSuchFace`] if `f` does not exist, and [`EditError::Full`] if there are not enough ids for the new
    /// elements. After an error, the mesh is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::cube();
    /// let f = mesh.faces().next().unwrap();
    /// let m = mesh.poke_face(f)?;
    /// assert_eq!((mesh.valence(m), mesh.n_faces()), (4, 9));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn poke_face(&mut self, f: FaceId) -> Result<VertexId, EditError> {
        self.check_face(f)?;
        self.poke_face_at(f, self.face_center(f))
    }

    /// Pokes a face like [`poke_face`](Self::poke_face), but puts the new vertex at `position`, in scene units. As in
    /// `poke_face`, the attributes at the new vertex are the means over the corners, and do not depend on `position`.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`poke_face`](Self::poke_face), and [`EditError::BadNumber`] if `position`
    /// is not finite.
    pub fn poke_face_at(&mut self, f: FaceId, position: DVec3) -> Result<VertexId, EditError> {
        self.check_face(f)?;
        check_finite(&[position])?;
        let sides: Vec<HalfEdgeId> = self.face_half_edges(f).collect();
        let corners: Vec<VertexId> = sides.iter().map(|&h| self.origin(h)).collect();
        if let Some(v) = first_repeated(&corners) {
            return Err(EditError::VisitsTwice(f, v));
        }
        self.check_room(2 * sides.len())?;

        self.drop_columns_by_rule();
        let m = self.push_vertex(position);
        self.average_values(&corners, m);
        let spokes: Vec<HalfEdgeId> = corners
            .iter()
            .map(|&v| self.push_edge(m, v).half_edge())
            .collect();
        self.set_vertex_half_edge(m, Some(spokes[0]));
        self.average_values(&sides, spokes[0]);

        for (i, (&side, &spoke)) in sides.iter().zip(&spokes).enumerate() {
            // The corners of the new triangle are corner i, the corner after it, and the new vertex m.
            let following = (i + 1) % sides.len();
            let to_m = spokes[following].twin();
            self.copy_values(sides[following], to_m);
            self.copy_values(spokes[0], spoke);
            let triangle = if i == 0 {
                f
            } else {
                self.push_copy_of_face(f, side)
            };
            self.link_around(triangle, &[side, to_m, spoke]);
        }
        Ok(m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edit::testing::{checked_edit_mesh, sample_shapes, with_attributes};
    use crate::{COLOR, CREASE, Domain, EdgeId, MATERIAL, UV, shapes};
    use glam::{DVec2, DVec4};

    fn corners(mesh: &Mesh, f: usize) -> Vec<usize> {
        mesh.face_vertices(FaceId::new(f))
            .map(VertexId::index)
            .collect()
    }

    #[test]
    fn a_square_becomes_four_triangles() {
        let mut mesh = shapes::square();
        let m = mesh.poke_face(FaceId::new(0)).unwrap();
        assert_eq!(mesh.defects(), []);
        assert_eq!(mesh.position(m), DVec3::new(0.5, 0.5, 0.0));
        assert_eq!(
            (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
            (5, 8, 4)
        );
        assert!(mesh.faces().all(|f| mesh.is_triangle(f)));
    }

    #[test]
    fn ids_are_given_as_documented() {
        let mut mesh = shapes::square();
        mesh.poke_face(FaceId::new(0)).unwrap();
        let faces: Vec<_> = (0..4).map(|f| corners(&mesh, f)).collect();
        assert_eq!(faces, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]);
        let ends = |e| mesh.edge_vertices(EdgeId::new(e)).map(VertexId::index);
        assert_eq!(
            (4..8).map(ends).collect::<Vec<_>>(),
            [[4, 0], [4, 1], [4, 2], [4, 3]]
        );
    }

    #[test]
    fn poking_any_face_can_be_undone_and_redone() {
        for shape in sample_shapes() {
            for f in shape.faces() {
                let degree = shape.degree(f);
                let mesh = checked_edit_mesh(&shape, |mesh| mesh.poke_face(f).map(drop)).unwrap();
                assert_eq!(mesh.defects(), []);
                assert_eq!(mesh.euler_characteristic(), shape.euler_characteristic());
                assert_eq!(mesh.n_faces(), shape.n_faces() + degree - 1);
                assert_eq!(mesh.n_boundary_loops(), shape.n_boundary_loops());
            }
        }
    }

    #[test]
    fn a_flat_face_keeps_its_area_and_direction() {
        let mut mesh = shapes::cylinder(7, true);
        let (area, volume) = (crate::geometry::area(&mesh), crate::geometry::volume(&mesh));
        for f in 0..9 {
            mesh.poke_face(FaceId::new(f)).unwrap();
        }
        assert!((crate::geometry::area(&mesh) - area).abs() < 1e-12);
        assert!((crate::geometry::volume(&mesh) - volume).abs() < 1e-12);
    }

    #[test]
    fn attributes_follow_their_rules() {
        let mut mesh = with_attributes(shapes::grid(2, 1));
        mesh.set(CREASE, vec![3.0; mesh.n_edges()]);
        let f = FaceId::new(1);
        let m = mesh.poke_face_at(f, mesh.face_center(f)).unwrap();
        // Values that are linear on each face stay linear, and both sides of the seam keep their values.
        for h in mesh.half_edges() {
            let Some(face) = mesh.face(h) else { continue };
            let shift = if face == FaceId::new(0) { 0.0 } else { 10.0 };
            let expected = mesh.position(mesh.origin(h)).truncate() + DVec2::splat(shift);
            assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{h}");
        }
        let p = mesh.position(m);
        assert_eq!(
            mesh.get(COLOR).unwrap()[m.index()],
            DVec4::new(p.x, p.y, 0.0, 1.0)
        );
        assert_eq!(mesh.get(MATERIAL).unwrap(), [5, 6, 6, 6, 6]);
        let creases = mesh.get(CREASE).unwrap();
        assert_eq!(creases[7..], [0.0; 4]);
        assert!(mesh.attributes().column(Domain::Face, "dropped").is_none());
    }

    #[test]
    fn bad_positions_and_missing_faces_are_refused_and_nothing_changes() {
        let mesh = with_attributes(shapes::grid(2, 1));
        let f = FaceId::new(0);
        let mut edited = mesh.clone();
        let infinite = DVec3::new(0.0, f64::INFINITY, 0.0);
        let result = edited.poke_face_at(f, infinite);
        assert_eq!(result, Err(EditError::BadNumber(f64::INFINITY)));
        let result = edited.poke_face_at(f, DVec3::splat(f64::NAN));
        assert!(matches!(result, Err(EditError::BadNumber(_))));
        let missing = FaceId::new(2);
        assert_eq!(
            edited.poke_face(missing),
            Err(EditError::NoSuchFace(missing))
        );
        assert_eq!(edited, mesh);
    }
}
