//! Where a level smooths: inside of the chosen faces.

use mesh::{DVec3, Mesh};
use progress::{Cancelled, Meter};

use super::pieces::Pieces;
use crate::masks::AnyMasks;
use crate::parallel::fill;
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

impl AreaMasks<'_> {
    /// The vertex of the whole level that vertex `i` is, if that is smoothed.
    fn whole(&self, i: usize) -> Option<usize> {
        let pieces = self.pieces;
        let (n_vertices, n_edges) = (pieces.mesh.n_vertices(), pieces.mesh.n_edges());
        let Some(new) = i.checked_sub(n_vertices) else {
            return pieces.moves(i).then_some(i);
        };
        if let Some(e) = pieces.middles.get(new) {
            pieces.smooths(e).then_some(n_vertices + e.index())
        } else {
            let f = pieces.centers.get(new - pieces.middles.len())?;
            Some(n_vertices + n_edges + f.index())
        }
    }
}

impl AnyMasks for AreaMasks<'_> {
    fn mask(&self, i: usize, add: &mut dyn FnMut(usize, f64)) {
        let (mesh, middles) = (self.pieces.mesh, &self.pieces.middles);
        if let Some(i) = self.whole(i) {
            return self.masks.mask(i, add);
        }
        let new = i.checked_sub(mesh.n_vertices());
        match new.and_then(|new| middles.get(new)) {
            Some(e) => mesh
                .edge_vertices(e)
                .iter()
                .for_each(|v| add(v.index(), 0.5)),
            None => add(i, 1.0),
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
            if let Some(value) = self.whole(i).and_then(|i| whole.get(i)) {
                return *value;
            }
            let mut sum = DVec3::ZERO;
            self.mask(i, &mut |source, w| sum += old[source] * w);
            sum
        })?;
        Ok(new)
    }
}
