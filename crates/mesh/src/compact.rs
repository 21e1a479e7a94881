//! Removes dead elements from the arrays.

use crate::attribute::Sources;
use crate::parallel::{self, BLOCK};
use crate::{Connectivity, EdgeId, FaceId, HalfEdgeId, Id, Mesh, VertexId};

/// Maps the ids of elements before a call of [`Mesh::compact`] to their ids after the call. Dead elements map to
/// `NONE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renumbering {
    /// The new vertex for each old vertex index.
    pub vertices: Vec<VertexId>,
    /// The new edge for each old edge index. If e becomes edge n, then half-edge 2e becomes 2n, and half-edge 2e + 1
    /// becomes 2n + 1.
    pub edges: Vec<EdgeId>,
    /// The new face for each old face index.
    pub faces: Vec<FaceId>,
}

impl Renumbering {
    /// Returns the new id of a half-edge.
    pub fn half_edge(&self, h: HalfEdgeId) -> HalfEdgeId {
        match self.edges[h.edge().index()] {
            EdgeId::NONE => HalfEdgeId::NONE,
            e => e.half_edges()[h.index() % 2],
        }
    }
}

impl Mesh {
    /// Removes dead elements from the arrays. Living elements keep their order and are numbered from 0
    /// without gaps. Returns the map from old ids to new ids; the old ids are invalid afterwards. If no
    /// element is dead, returns `None`: all ids stay the same, and the call takes constant time.
    pub fn compact(&mut self) -> Option<Renumbering> {
        if self.is_dense() {
            return None;
        }
        let (vertices, new_vertices) = self.living_and_new();
        let (edges, new_edges) = self.living_and_new::<EdgeId>();
        let (faces, new_faces) = self.living_and_new();
        let corner = |i: usize| edges[i / 2].half_edges()[i % 2];
        let corners: Vec<HalfEdgeId> = parallel::collect(2 * edges.len(), corner);
        let map = Renumbering {
            vertices: new_vertices,
            edges: new_edges,
            faces: new_faces,
        };
        let old = &*self;
        let half_edge = |h: Option<HalfEdgeId>| h.map_or(HalfEdgeId::NONE, |h| map.half_edge(h));
        let face = |f: Option<FaceId>| f.map_or(FaceId::NONE, |f| map.faces[f.index()]);
        let new = Self {
            attributes: old.attributes.gathered(Sources {
                vertices: &vertices,
                corners: &corners,
                edges: &edges,
                faces: &faces,
            }),
            positions: each(&vertices, |v| old.position(v)),
            connectivity: Connectivity {
                next: each(&corners, |h| map.half_edge(old.next(h))),
                origin: each(&corners, |h| map.vertices[old.origin(h).index()]),
                face: each(&corners, |h| face(old.face(h))),
                vertex_half_edge: each(&vertices, |v| half_edge(old.vertex_half_edge(v))),
                face_half_edge: each(&faces, |f| map.half_edge(old.face_half_edge(f))),
            },
            ..Self::default()
        };
        self.replace(new);
        Some(map)
    }

    /// Returns the living elements in order, and the new id of each element: its position among the living elements, or
    /// `NONE` if the element is dead.
    fn living_and_new<I: Id>(&self) -> (Vec<I>, Vec<I>) {
        let n = self.domain_len(I::DOMAIN);
        let living = parallel::blocks(n, |block| {
            let ids = block.map(I::new).filter(|&id| self.is_living(id));
            ids.collect::<Vec<I>>()
        });
        let mut new = vec![I::NONE; n];
        let mut n_before = 0;
        let blocks = new.chunks_mut(BLOCK).zip(&living).map(|(new, living)| {
            let first = n_before;
            n_before += living.len();
            (first, new, living)
        });
        parallel::consume(blocks, |_, (first, new, living)| {
            for (i, id) in (first..).zip(living) {
                new[id.index() % BLOCK] = I::new(i);
            }
        });
        (living.concat(), new)
    }
}

fn each<I: Id, T: Send>(kept: &[I], value: impl Fn(I) -> T + Sync) -> Vec<T> {
    parallel::collect(kept.len(), |i| value(kept[i]))
}

#[cfg(test)]
mod tests {
    use crate::{Domain, FaceId, VertexId, shapes};

    #[test]
    fn compacting_a_dense_mesh_changes_nothing() {
        let mut mesh = shapes::torus(4, 3, 2.0, 1.0);
        let before = mesh.clone();
        assert_eq!(mesh.compact(), None);
        assert_eq!(mesh, before);
    }

    #[test]
    fn compacting_keeps_the_positions_and_values_of_living_elements() {
        let mut mesh = shapes::grid(3, 1);
        mesh.set(crate::MATERIAL, vec![10, 11, 12]);
        mesh.delete_face(FaceId::new(0)).unwrap();
        mesh.delete_isolated_vertices();
        let kept: Vec<_> = mesh.vertices().map(|v| mesh.position(v)).collect();
        let map = mesh.compact().unwrap();
        assert_eq!(mesh.defects(), []);
        assert!(mesh.is_dense());
        assert_eq!(mesh.positions(), kept);
        assert_eq!(mesh.get(crate::MATERIAL).unwrap(), [11, 12]);
        assert_eq!(map.faces, [FaceId::NONE, FaceId::new(0), FaceId::new(1)]);
        assert_eq!(map.vertices[0], VertexId::NONE);
        assert_eq!(mesh.domain_len(Domain::Edge), 7);
    }
}
