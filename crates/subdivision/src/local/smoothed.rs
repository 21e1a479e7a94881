//! Smoothing in local refinement: the masks, which contain the weight of each old vertex that contributes to a new
//! vertex.

use mesh::DVec3;
use progress::{Cancelled, Meter};

use super::pieces::Pieces;
use crate::masks::AnyMasks;
use crate::parallel::fill;
use crate::topology::Topology;

/// The masks of local refinement. Smoothed elements follow the masks of the scheme. Old vertices that are not smoothed
/// stay in place. New vertices on edges that are not smoothed lie in the middle of these edges.
pub(super) struct LocalMasks<'a> {
    pub(super) pieces: &'a Pieces<'a>,
    pub(super) masks: &'a dyn AnyMasks,
}

impl LocalMasks<'_> {
    /// Returns the id that vertex `i` of the next level would have if all faces were cut. Returns `None` if the vertex
    /// is not smoothed.
    fn index_in_full_level(&self, i: usize) -> Option<usize> {
        let pieces = self.pieces;
        let (n_vertices, n_edges) = (pieces.mesh.n_vertices(), pieces.mesh.n_edges());
        let Some(new) = i.checked_sub(n_vertices) else {
            return pieces.smooths_vertex(i).then_some(i);
        };
        if let Some(e) = pieces.middles.get(new) {
            pieces.smooths_edge(e).then_some(n_vertices + e.index())
        } else {
            let f = pieces.centers.get(new - pieces.middles.len())?;
            Some(n_vertices + n_edges + f.index())
        }
    }
}

impl AnyMasks for LocalMasks<'_> {
    fn mask(&self, i: usize, add: &mut dyn FnMut(usize, f64)) {
        let (mesh, middles) = (self.pieces.mesh, &self.pieces.middles);
        if let Some(i) = self.index_in_full_level(i) {
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
        // If faces get new vertices at their centers, the values are computed together, as if the level cut all faces.
        // If the values were computed one by one, each vertex of a large face would sum all corners of that face again.
        let full_level = if self.pieces.centers.len() == 0 {
            Vec::new()
        } else {
            let mesh = self.pieces.mesh;
            let n_full = mesh.n_vertices() + mesh.n_edges() + mesh.n_faces();
            self.masks.values(n_full, old, meter)?
        };
        let mut new: Vec<DVec3> = mesh::zeroed(n);
        fill(&mut new, meter, |i| {
            if let Some(value) = self.index_in_full_level(i).and_then(|i| full_level.get(i)) {
                return *value;
            }
            let mut sum = DVec3::ZERO;
            self.mask(i, &mut |source, w| sum += old[source] * w);
            sum
        })?;
        Ok(new)
    }
}
