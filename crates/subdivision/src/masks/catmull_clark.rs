//! The masks of Catmull-Clark subdivision.
//!
//! ```text
//!     a ---- b          a              e1           new in a face: the mean of its corners
//!     |      |          |          f1  |  f2
//!     |  f   |       f  *  g     e4 -- v -- e2      new on an edge: (a + b + f + g) / 4, sharp: (a + b) / 2
//!     |      |          |          f4  |  f3
//!     d ---- c          b              e3           old: (n - 2)/n v + (Σ e + Σ f) / n², on a crease:
//!                                                   3/4 v + 1/8 of both neighbors along it
//! ```
//!
//! a, b, e and v are old vertices, f and g are the new vertices in the faces, and n is the valence of v.
//! Source: Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes", 1978.

use mesh::{DVec3, EdgeId, FaceId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use super::midpoint::center;
use super::{Masks, at_vertex};
use crate::parallel::fill;
use crate::sharpness::Sharpness;

pub(crate) struct CatmullClarkMasks<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) sharpness: Sharpness<'a>,
}

/// A term of a mask: an old vertex, or the new vertex at the center of a face.
#[derive(Clone, Copy)]
enum Source {
    Old(usize),
    Center(FaceId),
}

impl Masks for CatmullClarkMasks<'_> {
    fn mask(&self, i: usize, add: &mut impl FnMut(usize, f64)) {
        let first_center = self.mesh.n_vertices() + self.mesh.n_edges();
        if i < first_center {
            self.over_centers(i, &mut |source, w| match source {
                Source::Old(i) => add(i, w),
                Source::Center(f) => center(self.mesh, f, w, add),
            });
        } else {
            center(self.mesh, FaceId::new(i - first_center), 1.0, add);
        }
    }

    fn values(&self, n: usize, old: &[DVec3], meter: &Meter) -> Result<Vec<DVec3>, Cancelled> {
        let mut new: Vec<DVec3> = mesh::zeroed(n);
        let first_center = self.mesh.n_vertices() + self.mesh.n_edges();
        // The face centers are computed first, because the new positions of edges and vertices depend on them.
        let (edges_and_vertices, centers) = new.split_at_mut(first_center);
        fill(centers, meter, |f| {
            let (mut sum, mut n) = (DVec3::ZERO, 0_u32);
            for v in self.mesh.face_vertices(FaceId::new(f)) {
                sum += old[v.index()];
                n += 1;
            }
            sum * (1.0 / f64::from(n))
        })?;
        let centers = &*centers;
        fill(edges_and_vertices, meter, |i| {
            let mut sum = DVec3::ZERO;
            self.over_centers(i, &mut |source, w| {
                let value = match source {
                    Source::Old(i) => old[i],
                    Source::Center(f) => centers[f.index()],
                };
                sum += value * w;
            });
            sum
        })?;
        Ok(new)
    }
}

impl CatmullClarkMasks<'_> {
    /// Vertex `i` is an old vertex or a new vertex on an edge. Calls `add` with each old vertex and each face center
    /// that contributes to this vertex, and with its weight in the sum.
    #[inline]
    fn over_centers(&self, i: usize, add: &mut impl FnMut(Source, f64)) {
        let n_vertices = self.mesh.n_vertices();
        if i >= n_vertices {
            return self.on_edge(EdgeId::new(i - n_vertices), add);
        }
        let v = VertexId::new(i);
        let mut add = |source: usize, w: f64| match source.checked_sub(n_vertices) {
            None => add(Source::Old(source), w),
            Some(f) => add(Source::Center(FaceId::new(f)), w),
        };
        at_vertex(self.mesh, &self.sharpness, v, &mut add, |weight, add| {
            let n = self.mesh.valence(v) as f64;
            let part = weight / (n * n);
            add(i, (n - 2.0) / n * weight);
            for h in self.mesh.vertex_half_edges(v) {
                add(self.mesh.target(h).index(), part);
                if let Some(f) = self.mesh.face(h) {
                    add(n_vertices + f.index(), part);
                }
            }
        });
    }

    #[inline]
    fn on_edge(&self, e: EdgeId, add: &mut impl FnMut(Source, f64)) {
        let sharp = self.sharpness.weight_at_edge(e);
        let end = 0.5 * sharp + 0.25 * (1.0 - sharp);
        for v in self.mesh.edge_vertices(e) {
            add(Source::Old(v.index()), end);
        }
        if sharp < 1.0 {
            for f in self.mesh.edge_faces(e).into_iter().flatten() {
                add(Source::Center(f), 0.25 * (1.0 - sharp));
            }
        }
    }
}
