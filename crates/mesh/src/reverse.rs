//! Reversing the orientation of every face of a mesh.
//!
//! ```text
//!       c                    c
//!     /   ^                ^   \         every half-edge keeps its id, its edge and its face,
//!   /   f   \     --->   /   f   \       and runs the other way:
//!  v         \          /         v        origin'(h) = target(h)
//!  a --- h -> b         a <- h --- b       next'(h)   = prev(h)
//! ```
//!
//! When a face is reversed, its half-edge h that leaves a vertex v becomes the half-edge that ends at v. The half-edge
//! before h, prev(h), becomes the half-edge that leaves v. Therefore, prev(h) replaces h in three roles: it can be the
//! stored half-edge of v, it can be the stored half-edge of the face, and it stores the values of the corner at v. At a
//! boundary vertex, the new stored half-edge has no face, as required: if h has no face, prev(h) has no face either.
//! Reversing twice restores the connectivity of all elements that were not deleted.

use crate::attribute::Attributes;
use crate::{Connectivity, Domain, HalfEdgeId, Mesh};

impl Mesh {
    /// Returns the mesh with the orientation of every face reversed, so that inside and outside are
    /// exchanged.
    ///
    /// All ids stay the same. The first corner of a face stays the first; the other corners follow in
    /// reverse order. Values of corners stay with their vertex and face. Normals (columns of
    /// [`Rule::Normal`]) are negated, and columns of [`Rule::Drop`] are dropped.
    ///
    /// [`Rule::Normal`]: crate::Rule::Normal
    /// [`Rule::Drop`]: crate::Rule::Drop
    ///
    /// # Examples
    ///
    /// ```
    /// let cube = geometry::shapes::cube();
    /// assert_eq!(geometry::volume(&cube.reversed()), -geometry::volume(&cube));
    /// assert_eq!(cube.reversed().reversed(), cube);
    /// ```
    #[must_use]
    pub fn reversed(&self) -> Self {
        let n = self.domain_len(Domain::Corner);
        let mut prev = vec![HalfEdgeId::NONE; n];
        for h in self.half_edges() {
            prev[self.next(h).index()] = h;
        }
        let all = || (0..n).map(HalfEdgeId::new);
        let prev_of = |h: &HalfEdgeId| h.some().map_or(HalfEdgeId::NONE, |h| prev[h.index()]);
        let old = self.connectivity();
        let connectivity = Connectivity {
            origin: all().map(|h| self.target(h)).collect(),
            face: old.face.clone(),
            vertex_half_edge: old.vertex_half_edge.iter().map(prev_of).collect(),
            face_half_edge: old.face_half_edge.iter().map(prev_of).collect(),
            next: prev,
        };
        let mut attributes = Attributes::default();
        for (domain, column) in self.attributes().iter() {
            let values = match domain {
                Domain::Corner => column.values.gather(n, |h| {
                    let h = HalfEdgeId::new(h);
                    let source = if self.face(h).is_some() {
                        self.next(h)
                    } else {
                        h
                    };
                    Some(source.index())
                }),
                _ => column.values.clone(),
            };
            let mut column = column.with_values(values);
            column.negate_normals(0..column.values.len());
            attributes.insert(domain, column);
        }
        attributes.drop_by_rule();
        let mut reversed = Self {
            dead: self.dead.clone(),
            ..Self::from_arrays(connectivity, self.positions.clone())
        };
        reversed.set_attributes(attributes);
        reversed
    }

    /// Reverses the orientation of every face in place. Afterwards, the mesh is equal to the result of
    /// [`reversed`](Self::reversed).
    pub fn reverse(&mut self) {
        self.replace(self.reversed());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CORNER_NORMAL, DVec2, DVec3, FaceId, UV, VERTEX_NORMAL, shapes};

    fn meshes() -> Vec<Mesh> {
        let isolated = Mesh::from_polygons(vec![DVec3::ZERO], &[[0_u32; 3]; 0])
            .unwrap()
            .0;
        let mut with_dead = shapes::cube();
        with_dead.delete_face(FaceId::new(1)).unwrap();
        with_dead.delete_face(FaceId::new(2)).unwrap();
        vec![
            Mesh::default(),
            isolated,
            shapes::square(),
            shapes::grid(3, 2),
            shapes::cube(),
            shapes::torus(4, 3, 2.0, 0.5),
            shapes::cylinder(5, false),
            with_dead,
        ]
    }

    /// Returns the mesh with corner values that are all different: the value of each corner contains the index of its
    /// half-edge.
    fn numbered(mut mesh: Mesh) -> Mesh {
        let uv = (0..mesh.domain_len(Domain::Corner))
            .map(|h| DVec2::new(h as f64, 0.0))
            .collect();
        mesh.set(UV, uv);
        mesh
    }

    #[test]
    fn the_reversed_mesh_is_valid_and_has_the_opposite_volume() {
        for mesh in meshes() {
            let reversed = mesh.reversed();
            assert_eq!(reversed.defects(), []);
            assert!(
                (crate::geometry::volume(&reversed) + crate::geometry::volume(&mesh)).abs() < 1e-14
            );
            assert_eq!(reversed.positions(), mesh.positions());
            assert_eq!(reversed.n_boundary_loops(), mesh.n_boundary_loops());
        }
    }

    #[test]
    fn reversing_twice_gives_the_same_mesh() {
        for mut mesh in meshes().into_iter().map(numbered) {
            let twice = mesh.reversed().reversed();
            // The entries of dead (deleted) elements have no meaning, so the meshes are compacted before they are
            // compared.
            assert_eq!(twice.is_dense(), mesh.is_dense());
            mesh.compact();
            let mut twice = twice;
            twice.compact();
            assert_eq!(twice, mesh);
        }
    }

    #[test]
    fn the_first_corner_stays_and_corners_keep_their_values() {
        for mesh in meshes().into_iter().map(numbered) {
            let reversed = mesh.reversed();
            for f in mesh.faces() {
                let corners = |mesh: &Mesh| -> Vec<_> {
                    let uv = mesh.get(UV).unwrap();
                    mesh.face_half_edges(f)
                        .map(|h| (mesh.origin(h), uv[h.index()].x))
                        .collect()
                };
                let mut expected = corners(&mesh);
                expected[1..].reverse();
                assert_eq!(corners(&reversed), expected);
            }
        }
    }

    #[test]
    fn normals_are_negated() {
        let mut mesh = shapes::octahedron();
        mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
        let flat_normals = |mesh: &Mesh| -> Vec<DVec3> {
            let normal = |h| mesh.face_normal(mesh.face(h).unwrap());
            mesh.half_edges().map(normal).collect()
        };
        mesh.set(CORNER_NORMAL, flat_normals(&mesh));
        mesh.reverse();
        assert_eq!(mesh.get(CORNER_NORMAL).unwrap(), flat_normals(&mesh));
        let inwards: Vec<DVec3> = mesh.positions().iter().map(|&p| -p).collect();
        assert_eq!(mesh.get(VERTEX_NORMAL).unwrap(), inwards);
    }

    #[test]
    fn reversing_in_place_can_be_undone() {
        let before = numbered(shapes::cube());
        let mut mesh = before.clone();
        mesh.begin();
        mesh.reverse();
        assert_eq!(mesh, before.reversed());
        mesh.rollback();
        assert_eq!(mesh, before);
    }
}
