//! Reversing the orientation of components.

use crate::marks::Marks;
use crate::{EditError, FaceId, HalfEdgeId, Mesh};

impl Mesh {
    /// Reverses the orientation of faces, so that inside and outside are exchanged. The faces must form whole connected
    /// components. If only one of the two faces at an edge were reversed, both faces would run along the edge in the
    /// same direction.
    ///
    /// ```text
    ///       c                    c
    ///     /   ^                ^   \
    ///   /   f   \     --->   /   f   \       every half-edge keeps its id, its edge and its face,
    ///  v         \          /         v      and runs the other way
    ///  a --- h -> b         a <- h --- b
    /// ```
    ///
    /// All ids stay the same. The first corner of a face stays the first; the other corners follow in reverse order.
    /// Values of corners stay with their vertex and face. Normals (columns of [`Rule::Normal`]) of the vertices and
    /// corners are negated. Components that are not listed do not change.
    ///
    /// To reverse the whole mesh, use [`reverse`](Self::reverse), which is faster.
    ///
    /// [`Rule::Normal`]: crate::Rule::Normal
    ///
    /// # Errors
    ///
    /// Returns [`EditError::PartOfComponent`] if a listed face shares an edge with a face that is not listed; the error
    /// contains the listed face. Returns [`EditError::FaceListedTwice`] or [`EditError::NoSuchFace`] if a face is
    /// listed twice or does not exist, and [`EditError::NoElements`] for an empty list. After an error, the mesh is
    /// unchanged.
    pub fn reverse_faces(&mut self, faces: &[FaceId]) -> Result<(), EditError> {
        let mut is_listed = Marks::default();
        for &f in faces {
            self.check_face(f)?;
            if is_listed.has(f.index()) {
                return Err(EditError::FaceListedTwice(f));
            }
            is_listed.add(f.index());
        }
        if faces.is_empty() {
            return Err(EditError::NoElements);
        }
        // All half-edges of the components, including the half-edges around holes.
        let mut half_edges: Vec<HalfEdgeId> = Vec::new();
        for &f in faces {
            for h in self.face_half_edges(f) {
                half_edges.push(h);
                match self.face(h.twin()) {
                    None => half_edges.push(h.twin()),
                    Some(g) if is_listed.has(g.index()) => {}
                    Some(_) => return Err(EditError::PartOfComponent(f)),
                }
            }
        }

        self.drop_columns_by_rule();
        // A reversed half-edge starts at its old target. Therefore, the values of the corner at the origin of next(h)
        // are now stored at h.
        for &f in faces {
            let corners: Vec<HalfEdgeId> = self.face_half_edges(f).collect();
            for pair in corners.windows(2) {
                self.swap_values(pair[0], pair[1]);
            }
        }
        let old: Vec<_> = half_edges
            .iter()
            .map(|&h| (h, self.next(h), self.target(h)))
            .collect();
        for (h, next, target) in old {
            // After the reversal, h leaves the vertex that `next` left before. Therefore h replaces `next` as the
            // stored half-edge of that vertex.
            if self.vertex_half_edge(target) == Some(next) {
                self.set_vertex_half_edge(target, Some(h));
                self.negate_normals(target);
            }
            self.set_next(next, h);
            self.set_origin(h, target);
        }
        for &f in faces {
            let first = self.face_half_edge(f);
            // The first half-edge of the face must start at the same vertex as before. The links `next` are already
            // reversed, so `next` of this half-edge is the half-edge that now starts at that vertex.
            self.set_face_half_edge(f, self.next(first));
            let corners: Vec<HalfEdgeId> = self.face_half_edges(f).collect();
            for h in corners {
                self.negate_normals(h);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CORNER_NORMAL, DVec2, DVec3, UV, VERTEX_NORMAL, shapes};

    /// Returns a mesh with several shapes as components, side by side, with corner values and normals.
    fn side_by_side(shapes: &[Mesh]) -> Mesh {
        let mut positions = Vec::new();
        let mut polygons = Vec::new();
        for (i, shape) in shapes.iter().enumerate() {
            let first = positions.len();
            let shift = DVec3::X * 10.0 * i as f64;
            positions.extend(shape.positions().iter().map(|&p| p + shift));
            polygons.extend(shape.faces().map(|f| {
                let number = |v: crate::VertexId| u32::try_from(first + v.index()).unwrap();
                shape.face_vertices(f).map(number).collect::<Vec<u32>>()
            }));
        }
        let (mut mesh, _) = Mesh::from_polygons(positions, &polygons).unwrap();
        let uv = |h: HalfEdgeId| DVec2::new(h.index() as f64, 1.0);
        mesh.set(UV, mesh.half_edges().map(uv).collect());
        let normal = |h: HalfEdgeId| mesh.face(h).map_or(DVec3::ZERO, |f| mesh.face_normal(f));
        mesh.set(CORNER_NORMAL, mesh.half_edges().map(normal).collect());
        mesh.set(VERTEX_NORMAL, vec![DVec3::Z; mesh.n_vertices()]);
        mesh
    }

    fn three_components() -> (Mesh, [Vec<FaceId>; 3]) {
        let shapes = [
            shapes::cube(),
            shapes::grid(2, 2),
            shapes::cylinder(5, false),
        ];
        let mesh = side_by_side(&shapes);
        let mut first = 0;
        let faces = shapes.map(|shape| {
            let faces = (first..first + shape.n_faces()).map(FaceId::new).collect();
            first += shape.n_faces();
            faces
        });
        (mesh, faces)
    }

    #[test]
    fn reversing_all_faces_reverses_the_whole_mesh() {
        let (before, components) = three_components();
        let mut mesh = before.clone();
        let mut all = components.concat();
        all.reverse();
        mesh.reverse_faces(&all).unwrap();
        assert_eq!(mesh, before.reversed());
        mesh.reverse_faces(&all).unwrap();
        assert_eq!(mesh, before);
    }

    #[test]
    fn one_component_is_reversed_and_the_others_stay() {
        let (before, components) = three_components();
        for (k, faces) in components.iter().enumerate() {
            let mut mesh = before.clone();
            mesh.reverse_faces(faces).unwrap();
            assert_eq!(mesh.defects(), []);
            let whole = before.reversed();
            for (other, faces) in components.iter().enumerate() {
                let expected = if k == other { &whole } else { &before };
                for &f in faces {
                    assert_eq!(mesh.face_normal(f), expected.face_normal(f));
                    let corners = |mesh: &Mesh| -> Vec<_> {
                        let corner = |h: HalfEdgeId| {
                            let v = mesh.origin(h);
                            (
                                v,
                                mesh.get(UV).unwrap()[h.index()],
                                mesh.get(CORNER_NORMAL).unwrap()[h.index()],
                                mesh.get(VERTEX_NORMAL).unwrap()[v.index()],
                            )
                        };
                        mesh.face_half_edges(f).map(corner).collect()
                    };
                    assert_eq!(corners(&mesh), corners(expected));
                }
            }
        }
    }

    #[test]
    fn reversing_a_component_can_be_undone_and_redone() {
        let (before, components) = three_components();
        for faces in &components {
            let mut mesh = before.clone();
            mesh.begin();
            mesh.reverse_faces(faces).unwrap();
            mesh.rollback();
            assert_eq!(mesh, before);

            mesh.begin();
            mesh.reverse_faces(faces).unwrap();
            let after = mesh.clone();
            let change = mesh.commit().unwrap();
            let redo = mesh.revert(change);
            assert_eq!(mesh, before);
            mesh.revert(redo);
            assert_eq!(mesh, after);
        }
    }

    #[test]
    fn parts_of_components_are_refused() {
        let (mesh, [cube, grid, _]) = three_components();
        let missing = FaceId::new(mesh.n_faces());
        for (faces, refusal) in [
            (&cube[1..], EditError::PartOfComponent(cube[2])),
            (&grid[..1], EditError::PartOfComponent(grid[0])),
            (&[], EditError::NoElements),
            (&[cube[0], cube[0]], EditError::FaceListedTwice(cube[0])),
            (&[missing], EditError::NoSuchFace(missing)),
        ] {
            let mut edited = mesh.clone();
            assert_eq!(edited.reverse_faces(faces), Err(refusal));
            assert_eq!(edited, mesh);
        }
    }
}
