//! Texture coordinates of vertices, for formats that have none of corners.

use glam::DVec2;
use mesh::{Mesh, VertexId};
use rayon::prelude::*;

/// Texture coordinates of vertices, if all corners of each have the same bits; zero where a vertex has no
/// corner.
pub(crate) fn uvs_of_vertices(mesh: &Mesh, uvs: &[DVec2]) -> Option<Vec<DVec2>> {
    let bits = |uv: DVec2| uv.to_array().map(f64::to_bits);
    let of_vertex = |v: usize| {
        let corners = mesh.vertex_half_edges(VertexId::new(v));
        let mut corners = corners
            .filter(|&h| mesh.face(h).is_some())
            .map(|h| uvs[h.index()]);
        let first = corners.next().unwrap_or_default();
        corners.all(|uv| bits(uv) == bits(first)).then_some(first)
    };
    let all = (0..mesh.n_vertices()).into_par_iter().with_min_len(4096);
    all.map(of_vertex).collect()
}
