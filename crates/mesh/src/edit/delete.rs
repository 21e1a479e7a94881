//! Deleting an edge or a vertex together with its faces.

use super::sorted_unique;
use crate::{EdgeId, EditError, Mesh, VertexId};

impl Mesh {
    /// Deletes an edge and the faces beside it.
    ///
    /// ```text
    ///    +-----+-----+-----+          +-----+     +-----+
    ///    |     |     e     |    -->   |     |           |
    ///    +-----+-----+-----+          +-----+     +-----+
    /// ```
    ///
    /// As with [`delete_faces`](Self::delete_faces), edges that have no face left are deleted too. Vertices are not
    /// deleted; a vertex that loses all of its edges becomes isolated. The ids and attribute values of the remaining
    /// elements do not change. [`dissolve_edge`](Self::dissolve_edge) merges the faces instead.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Pinch`] if the faces left around a vertex would not form one fan, and
    /// [`EditError::NoSuchEdge`] if `e` does not exist. After an error, the mesh is unchanged.
    pub fn delete_edge(&mut self, e: EdgeId) -> Result<(), EditError> {
        self.check_edge(e)?;
        self.delete_faces(&sorted_unique(self.edge_faces(e).into_iter().flatten()))
    }

    /// Deletes a vertex and the faces around it.
    ///
    /// ```text
    ///    +-----+-----+          +-----+-----+
    ///    |     |     |          |           |
    ///    +-----v-----+    -->   +           +       the four squares around v are deleted;
    ///    |     |     |          |           |       the outer edges belong to other faces
    ///    +-----+-----+          +-----+-----+
    /// ```
    ///
    /// As with [`delete_faces`](Self::delete_faces), edges that have no face left are deleted too. Other vertices are
    /// not deleted; a vertex that loses all of its edges becomes isolated. The ids and attribute values of the
    /// remaining elements do not change. `v` can be an isolated vertex. [`dissolve_vertex`](Self::dissolve_vertex)
    /// merges the faces instead.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Pinch`] if the faces left around another vertex would not form one fan, and
    /// [`EditError::NoSuchVertex`] if `v` does not exist. After an error, the mesh is unchanged.
    pub fn delete_vertex(&mut self, v: VertexId) -> Result<(), EditError> {
        self.check_vertex(v)?;
        self.delete_faces(&sorted_unique(self.vertex_faces(v)))?;
        self.kill(v);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edit::testing::{checked_edit_mesh, sample_shapes};
    use crate::{FaceId, shapes};

    /// Returns the number of vertices, of edges, and of faces.
    fn counts(mesh: &Mesh) -> [usize; 3] {
        [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
    }

    #[test]
    fn an_edge_is_deleted_with_the_faces_beside_it() {
        let cube = shapes::cube();
        for e in cube.edges() {
            let mesh = checked_edit_mesh(&cube, |mesh| mesh.delete_edge(e)).unwrap();
            assert!(!mesh.has_edge(e));
            assert_eq!((counts(&mesh), mesh.n_boundary_loops()), ([8, 11, 4], 1));
        }
    }

    #[test]
    fn a_boundary_edge_is_deleted_with_its_face() {
        let mut mesh = shapes::square();
        mesh.delete_edge(EdgeId::new(2)).unwrap();
        assert_eq!((counts(&mesh), mesh.n_isolated_vertices()), ([4, 0, 0], 4));
    }

    #[test]
    fn a_vertex_is_deleted_with_the_faces_around_it() {
        let icosahedron = shapes::icosahedron();
        for v in icosahedron.vertices() {
            let mesh = checked_edit_mesh(&icosahedron, |mesh| mesh.delete_vertex(v)).unwrap();
            assert!(!mesh.has_vertex(v));
            assert_eq!((counts(&mesh), mesh.n_boundary_loops()), ([11, 25, 15], 1));
        }
    }

    #[test]
    fn an_isolated_vertex_is_deleted() {
        let mut mesh = shapes::square();
        mesh.delete_face(FaceId::new(0)).unwrap();
        mesh.delete_vertex(VertexId::new(1)).unwrap();
        assert_eq!(counts(&mesh), [3, 0, 0]);
    }

    #[test]
    fn edges_and_vertices_of_every_shape_are_deleted_or_refused_for_a_pinch() {
        let is_pinch = |error| matches!(error, EditError::Pinch(_));
        let mut n_refused = 0;
        for shape in sample_shapes() {
            for e in shape.edges() {
                let result = checked_edit_mesh(&shape, |mesh| mesh.delete_edge(e));
                n_refused += usize::from(result.is_err());
                assert!(result.map_or_else(is_pinch, |mesh| !mesh.has_edge(e)));
            }
            for v in shape.vertices() {
                let result = checked_edit_mesh(&shape, |mesh| mesh.delete_vertex(v));
                n_refused += usize::from(result.is_err());
                assert!(result.map_or_else(is_pinch, |mesh| !mesh.has_vertex(v)));
            }
        }
        assert!(
            n_refused > 0,
            "at least one deletion must be refused, because it would leave two fans of faces at a vertex"
        );
    }

    #[test]
    fn missing_elements_are_refused() {
        let mut mesh = shapes::cube();
        let (e, v) = (EdgeId::new(12), VertexId::new(8));
        assert_eq!(mesh.delete_edge(e), Err(EditError::NoSuchEdge(e)));
        assert_eq!(mesh.delete_vertex(v), Err(EditError::NoSuchVertex(v)));
        assert_eq!(mesh, shapes::cube());
    }
}
