//! The positions of the next level, and the weights that they are means with.

use mesh::{DVec3, EdgeId, Mesh, VertexId};
use op::OpError;
use rayon::prelude::*;

use crate::meter::{BLOCK, Meter};

/// The positions of the next level: old vertices, then one for each edge.
pub(crate) fn finer(mesh: &Mesh, meter: &Meter) -> Result<Vec<DVec3>, OpError> {
    let old = mesh.positions();
    let mut new: Vec<DVec3> = bytemuck::zeroed_vec(old.len() + mesh.n_edges());
    new.par_chunks_mut(BLOCK)
        .enumerate()
        .try_for_each(|(block, new)| {
            for (i, p) in (block * BLOCK..).zip(new.iter_mut()) {
                *p = DVec3::ZERO;
                weights(mesh, i, |source, w| *p += w * old[source]);
            }
            meter.add(new.len())
        })?;
    Ok(new)
}

/// Calls `add` with each old vertex that new vertex `i` is a mean of, and its weight, in a fixed order.
/// The weights are positive and sum to 1. The picture on the front page of the crate shows them.
#[inline]
pub(crate) fn weights(mesh: &Mesh, i: usize, add: impl FnMut(usize, f64)) {
    let n_vertices = mesh.positions().len();
    if i < n_vertices {
        at_vertex(mesh, VertexId::new(i), add);
    } else {
        on_edge(mesh, EdgeId::new(i - n_vertices), add);
    }
}

/// The mask of an old vertex. An isolated one stays where it is.
#[inline]
fn at_vertex(mesh: &Mesh, v: VertexId, mut add: impl FnMut(usize, f64)) {
    let Some(h) = mesh.vertex_half_edge(v) else {
        return add(v.index(), 1.0);
    };
    if mesh.face(h).is_none() {
        // Clockwise, the boundary half-edge is the first to leave. The boundary arrives along the
        // twin of the last.
        let last = mesh.prev(h).twin();
        add(v.index(), 0.75);
        add(mesh.target(h).index(), 0.125);
        add(mesh.target(last).index(), 0.125);
        return;
    }
    let n = mesh.valence(v);
    let u = if n == 3 {
        3.0 / 16.0
    } else {
        3.0 / (8.0 * n as f64)
    };
    add(v.index(), 1.0 - n as f64 * u);
    for w in mesh.vertex_neighbors(v) {
        add(w.index(), u);
    }
}

/// The mask of the new vertex on an edge.
#[inline]
fn on_edge(mesh: &Mesh, e: EdgeId, mut add: impl FnMut(usize, f64)) {
    let [h, twin] = e.half_edges();
    let [a, b] = [h, twin].map(|h| mesh.origin(h).index());
    if mesh.face(h).is_some() && mesh.face(twin).is_some() {
        // In a triangle, the next half-edge goes to the vertex opposite.
        let [c, d] = [h, twin].map(|h| mesh.target(mesh.next(h)).index());
        add(a, 0.375);
        add(b, 0.375);
        add(c, 0.125);
        add(d, 0.125);
    } else {
        add(a, 0.5);
        add(b, 0.5);
    }
}
