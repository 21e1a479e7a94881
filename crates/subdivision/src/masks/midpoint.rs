//! The masks of linear subdivision: old vertices stay, new ones lie in the middle of edges and faces.

use mesh::{EdgeId, FaceId, Mesh};

use super::Masks;
use crate::Split;

pub(crate) struct MidpointMasks<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) split: Split,
}

impl Masks for MidpointMasks<'_> {
    fn n_vertices(&self) -> usize {
        let n = self.mesh.n_vertices() + self.mesh.n_edges();
        match self.split {
            Split::Triangles => n,
            Split::Quads => n + self.mesh.n_faces(),
        }
    }

    #[inline]
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        let (n_vertices, n_edges) = (self.mesh.n_vertices(), self.mesh.n_edges());
        if i < n_vertices {
            add(i, 1.0);
        } else if i < n_vertices + n_edges {
            for v in self.mesh.edge_vertices(EdgeId::new(i - n_vertices)) {
                add(v.index(), 0.5);
            }
        } else {
            center(
                self.mesh,
                FaceId::new(i - n_vertices - n_edges),
                1.0,
                &mut |i, w| add(i, w),
            );
        }
    }
}

/// Adds the mean of the corners of a face, scaled.
#[inline]
pub(crate) fn center(mesh: &Mesh, f: FaceId, weight: f64, add: &mut impl FnMut(usize, f64)) {
    let part = weight / mesh.degree(f) as f64;
    for v in mesh.face_vertices(f) {
        add(v.index(), part);
    }
}
