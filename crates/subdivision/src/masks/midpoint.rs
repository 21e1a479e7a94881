//! The masks of midpoint subdivision: old vertices stay in place, and new vertices lie in the middle of edges
//! and faces.

use mesh::{EdgeId, FaceId, Mesh};

use super::Masks;

pub(crate) struct MidpointMasks<'a>(pub(crate) &'a Mesh);

impl Masks for MidpointMasks<'_> {
    #[inline]
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        let mesh = self.0;
        let Some(e) = i.checked_sub(mesh.n_vertices()) else {
            return add(i, 1.0);
        };
        match e.checked_sub(mesh.n_edges()) {
            None => {
                for v in mesh.edge_vertices(EdgeId::new(e)) {
                    add(v.index(), 0.5);
                }
            }
            Some(f) => center(mesh, FaceId::new(f), 1.0, add),
        }
    }
}

/// Calls `add` with each corner of a face. All corners have the same weight, and the weights sum to `weight`.
#[inline]
pub(crate) fn center(mesh: &Mesh, f: FaceId, weight: f64, add: &mut impl FnMut(usize, f64)) {
    let part = weight / mesh.degree(f) as f64;
    for v in mesh.face_vertices(f) {
        add(v.index(), part);
    }
}
