//! Where a level smooths: inside of the chosen faces.

use mesh::Mesh;

use super::pieces::Pieces;
use crate::level::Topology;
use crate::masks::Masks;

/// What belongs to the chosen faces alone.
pub(super) struct Area {
    /// Whether no face at each vertex is outside.
    pub(super) vertices: Vec<bool>,
    /// Whether no face at each edge is outside.
    pub(super) edges: Vec<bool>,
}

impl Area {
    pub(super) fn of(mesh: &Mesh, chosen: &[bool]) -> Self {
        let mut vertices = vec![true; mesh.n_vertices()];
        let mut edges = vec![true; mesh.n_edges()];
        for f in mesh.faces().filter(|f| !chosen[f.index()]) {
            for h in mesh.face_half_edges(f) {
                vertices[mesh.origin(h).index()] = false;
                edges[h.edge().index()] = false;
            }
        }
        Self { vertices, edges }
    }
}

/// The masks of a scheme where it smooths; elsewhere old vertices stay and new ones lie in the middle.
pub(super) struct AreaMasks<'a, M> {
    pub(super) pieces: &'a Pieces<'a>,
    pub(super) masks: &'a M,
}

impl<M: Masks> Masks for AreaMasks<'_, M> {
    fn n_vertices(&self) -> usize {
        self.pieces.n_vertices()
    }

    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.pieces.mesh;
        let (n_vertices, n_edges) = (mesh.n_vertices(), mesh.n_edges());
        let Some(new) = i.checked_sub(n_vertices) else {
            if self.pieces.moves(i) {
                self.masks.mask(i, add);
            } else {
                add(i, 1.0);
            }
            return;
        };
        match self.pieces.cut_edges.get(new) {
            Some(&e) if self.pieces.smooths(e) => self.masks.mask(n_vertices + e.index(), add),
            Some(&e) => {
                for v in mesh.edge_vertices(e) {
                    add(v.index(), 0.5);
                }
            }
            None => {
                let f = self.pieces.centered[new - self.pieces.cut_edges.len()];
                self.masks.mask(n_vertices + n_edges + f.index(), add);
            }
        }
    }
}
