//! Where a level smooths: inside of the chosen faces.

use mesh::{DVec3, EdgeId, Mesh};
use progress::Cancelled;

use super::pieces::Pieces;
use crate::masks::AnyMasks;
use crate::parallel::{Meter, fill};
use crate::topology::Topology;

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
pub(super) struct AreaMasks<'a> {
    pub(super) pieces: &'a Pieces<'a>,
    pub(super) masks: &'a dyn AnyMasks,
}

/// Where a vertex comes from.
enum Source {
    /// From this vertex of the whole level.
    Whole(usize),
    /// From this old vertex, which stays.
    Old(usize),
    /// From the middle of this edge.
    Middle(EdgeId),
}

impl AreaMasks<'_> {
    fn source(&self, i: usize) -> Source {
        let pieces = self.pieces;
        let (n_vertices, n_edges) = (pieces.mesh.n_vertices(), pieces.mesh.n_edges());
        let Some(new) = i.checked_sub(n_vertices) else {
            return if pieces.moves(i) {
                Source::Whole(i)
            } else {
                Source::Old(i)
            };
        };
        match pieces.middles.get(new) {
            Some(e) if pieces.smooths(e) => Source::Whole(n_vertices + e.index()),
            Some(e) => Source::Middle(e),
            None => {
                let f = pieces.centers.get(new - pieces.middles.len());
                let f = f.expect("a vertex on no edge is in a face");
                Source::Whole(n_vertices + n_edges + f.index())
            }
        }
    }
}

impl AnyMasks for AreaMasks<'_> {
    fn mask(&self, i: usize, add: &mut dyn FnMut(usize, f64)) {
        match self.source(i) {
            Source::Whole(i) => self.masks.mask(i, add),
            Source::Old(i) => add(i, 1.0),
            Source::Middle(e) => {
                for v in self.pieces.mesh.edge_vertices(e) {
                    add(v.index(), 0.5);
                }
            }
        }
    }

    fn values(&self, n: usize, old: &[DVec3], meter: &Meter) -> Result<Vec<DVec3>, Cancelled> {
        // Each vertex of a large face would sum all its corners for itself.
        let whole = if self.pieces.centers.len() == 0 {
            Vec::new()
        } else {
            let mesh = self.pieces.mesh;
            let n_whole = mesh.n_vertices() + mesh.n_edges() + mesh.n_faces();
            self.masks.values(n_whole, old, meter)?
        };
        let mut new: Vec<DVec3> = mesh::zeroed(n);
        fill(&mut new, meter, |i| {
            if let (false, Source::Whole(i)) = (whole.is_empty(), self.source(i)) {
                return whole[i];
            }
            let mut sum = DVec3::ZERO;
            self.mask(i, &mut |source, w| sum += old[source] * w);
            sum
        })?;
        Ok(new)
    }
}
