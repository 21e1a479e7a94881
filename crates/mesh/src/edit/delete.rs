//! Taking an edge or a vertex away, with the faces at it.

use super::sorted_unique;
use crate::{EdgeId, EditError, Mesh, VertexId};

impl Mesh {
    /// Takes an edge away, and with it the faces beside it.
    ///
    /// ```text
    ///    +-----+-----+-----+          +-----+     +-----+
    ///    |     |     e     |    -->   |     |           |
    ///    +-----+-----+-----+          +-----+     +-----+
    /// ```
    ///
    /// As [`delete_faces`](Self::delete_faces): other edges of these faces that have no face left go as
    /// well, vertices stay, isolated if they have no other edge. No id changes and no attribute value.
    /// [`dissolve_edge`](Self::dissolve_edge) merges the faces instead.
    ///
    /// # Errors
    ///
    /// [`EditError::Pinch`] if the faces left around a vertex would not form one fan,
    /// [`EditError::NoSuchEdge`]. The mesh is unchanged.
    pub fn delete_edge(&mut self, e: EdgeId) -> Result<(), EditError> {
        self.check_edge(e)?;
        self.delete_faces(&sorted_unique(self.edge_faces(e).into_iter().flatten()))
    }

    /// Takes a vertex away, and with it the faces around it.
    ///
    /// ```text
    ///    +-----+-----+          +-----+-----+
    ///    |     |     |          |           |
    ///    +-----v-----+    -->   +           +       four squares around v go
    ///    |     |     |          |           |       and leave the rim of the others
    ///    +-----+-----+          +-----+-----+
    /// ```
    ///
    /// As [`delete_faces`](Self::delete_faces): edges that have no face left go as well, other vertices
    /// stay, isolated if they have no other edge. An isolated vertex just goes. No id changes and no
    /// attribute value. [`dissolve_vertex`](Self::dissolve_vertex) merges the faces instead.
    ///
    /// # Errors
    ///
    /// [`EditError::Pinch`] if the faces left around another vertex would not form one fan,
    /// [`EditError::NoSuchVertex`]. The mesh is unchanged.
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
    use crate::edit::testing::{shapes_to_try, undone_and_redone};
    use crate::{FaceId, shapes};

    /// The faces and edges that are left.
    fn left(mesh: &Mesh) -> [usize; 3] {
        [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
    }

    #[test]
    fn an_edge_goes_with_the_faces_beside_it() {
        let cube = shapes::cube();
        for e in cube.edges() {
            let mesh = undone_and_redone(&cube, |mesh| mesh.delete_edge(e)).unwrap();
            assert!(!mesh.has_edge(e));
            assert_eq!((left(&mesh), mesh.n_boundary_loops()), ([8, 11, 4], 1));
        }
    }

    #[test]
    fn a_boundary_edge_goes_with_its_face() {
        let mut mesh = shapes::square();
        mesh.delete_edge(EdgeId::new(2)).unwrap();
        assert_eq!((left(&mesh), mesh.n_isolated_vertices()), ([4, 0, 0], 4));
    }

    #[test]
    fn a_vertex_goes_with_the_faces_around_it() {
        let icosahedron = shapes::icosahedron();
        for v in icosahedron.vertices() {
            let mesh = undone_and_redone(&icosahedron, |mesh| mesh.delete_vertex(v)).unwrap();
            assert!(!mesh.has_vertex(v));
            assert_eq!((left(&mesh), mesh.n_boundary_loops()), ([11, 25, 15], 1));
        }
    }

    #[test]
    fn an_isolated_vertex_just_goes() {
        let mut mesh = shapes::square();
        mesh.delete_face(FaceId::new(0)).unwrap();
        mesh.delete_vertex(VertexId::new(1)).unwrap();
        assert_eq!(left(&mesh), [3, 0, 0]);
    }

    #[test]
    fn edges_and_vertices_of_every_shape_go_or_are_refused_for_a_pinch() {
        let is_pinch = |refused| matches!(refused, EditError::Pinch(_));
        let mut n_refused = 0;
        for shape in shapes_to_try() {
            for e in shape.edges() {
                let done = undone_and_redone(&shape, |mesh| mesh.delete_edge(e));
                n_refused += usize::from(done.is_err());
                assert!(done.map_or_else(is_pinch, |mesh| !mesh.has_edge(e)));
            }
            for v in shape.vertices() {
                let done = undone_and_redone(&shape, |mesh| mesh.delete_vertex(v));
                n_refused += usize::from(done.is_err());
                assert!(done.map_or_else(is_pinch, |mesh| !mesh.has_vertex(v)));
            }
        }
        assert!(
            n_refused > 0,
            "an edge across the sheet leaves two parts at a vertex"
        );
    }

    #[test]
    fn what_is_not_there_is_refused() {
        let mut mesh = shapes::cube();
        let (e, v) = (EdgeId::new(12), VertexId::new(8));
        assert_eq!(mesh.delete_edge(e), Err(EditError::NoSuchEdge(e)));
        assert_eq!(mesh.delete_vertex(v), Err(EditError::NoSuchVertex(v)));
        assert_eq!(mesh, shapes::cube());
    }
}
