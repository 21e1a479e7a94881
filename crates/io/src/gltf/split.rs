//! Splits vertices along seams. If the corners of a vertex have different values (normals, texture coordinates, colors
//! and so on), glTF needs a separate vertex for each distinct combination of values.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use mesh::{Domain, HalfEdgeId, Mesh, VertexId};

use super::streams::Stream;
use crate::file_vertices::FileVertices;
use crate::loss::Losses;
use mesh::parallel::{self, BLOCK};

/// The maximum number of comparisons for a corner. A corner is compared only with the latest distinct combinations of
/// values at other corners of its vertex. This limit keeps the total time linear in the number of corners, even if one
/// vertex has a million corners. If the corners of a vertex have more distinct combinations of values than this
/// maximum, equal corners can become different vertices.
const MAX_COMPARED: usize = 64;

/// The glTF vertices. Without reordering, they are in the order of the vertices of the mesh.
pub(super) struct Split {
    /// The number of vertices.
    pub(super) n: usize,
    /// The relation between corners and glTF vertices. `None` if the glTF vertices are the vertices of the mesh.
    seams: Option<Seams>,
}

struct Seams {
    /// For each glTF vertex, a corner that has the values of this vertex.
    corners: Vec<u32>,
    /// For each half-edge with a face, the glTF vertex at its corner.
    vertex_of: Vec<u32>,
}

impl Split {
    /// Returns the mesh vertex from which the glTF vertex `i` was made, and a corner with the values of the glTF
    /// vertex.
    pub(super) fn corner(&self, mesh: &Mesh, i: usize) -> (VertexId, HalfEdgeId) {
        if let Some(seams) = &self.seams {
            let h = HalfEdgeId::new(seams.corners[i] as usize);
            return (mesh.origin(h), h);
        }
        let v = VertexId::new(i);
        let around = mesh.vertex_half_edges(v);
        let mut corners = around.filter(|&h| mesh.face(h).is_some());
        (v, corners.next().unwrap_or(HalfEdgeId::new(0)))
    }

    /// Returns the mesh vertex from which the glTF vertex `i` was made.
    pub(super) fn vertex(&self, mesh: &Mesh, i: usize) -> VertexId {
        match &self.seams {
            Some(seams) => mesh.origin(HalfEdgeId::new(seams.corners[i] as usize)),
            None => VertexId::new(i),
        }
    }

    /// Keeps only the vertices in `order`, in this order.
    pub(super) fn select(&mut self, mesh: &Mesh, order: &[u32]) {
        let corners = parallel::collect(order.len(), |i| {
            number(self.corner(mesh, order[i] as usize).1.index())
        });
        let mut number_of = vec![u32::MAX; self.n];
        for (i, &v) in order.iter().enumerate() {
            number_of[v as usize] = number(i);
        }
        let vertex_of = parallel::collect(mesh.n_half_edges(), |h| {
            let h = HalfEdgeId::new(h);
            mesh.face(h)
                .map_or(u32::MAX, |_| number_of[self.vertex_of(mesh, h) as usize])
        });
        self.n = order.len();
        self.seams = Some(Seams { corners, vertex_of });
    }

    /// The glTF vertex at the corner of a half-edge. The half-edge must have a face.
    pub(super) fn vertex_of(&self, mesh: &Mesh, h: HalfEdgeId) -> u32 {
        match &self.seams {
            Some(seams) => seams.vertex_of[h.index()],
            None => number(mesh.origin(h).index()),
        }
    }
}

/// Adds a loss for those values of `stream` (one attribute) that the writer changes because glTF does not allow them.
pub(super) fn note_changed(stream: &Stream, mesh: &Mesh, split: &Split, losses: &mut Losses) {
    let changed = parallel::count(split.n, |i| {
        let (v, h) = split.corner(mesh, i);
        !stream.at(mesh, v, h).1
    });
    losses.add(stream.domain, &stream.column.name, changed, stream.change());
}

/// Splits the vertices of a mesh. The arrays of the mesh must have no gaps from removed elements. Isolated vertices are
/// left out. Copies that the reader made by splitting a vertex are merged with the vertex again, unless their values
/// differ.
pub(super) fn split(mesh: &Mesh, streams: &[Stream]) -> Split {
    let file = FileVertices::of(mesh);
    // Only copies of a vertex can have different values of a vertex attribute. If no vertex of the mesh has copies,
    // only corner attributes are compared.
    let can_differ = |stream: &&Stream| stream.domain == Domain::Corner || file.has_copies();
    let seams: Vec<&Stream> = streams.iter().filter(can_differ).collect();
    let n = file.len();
    if seams.is_empty() && mesh.n_isolated_vertices() == 0 && !file.has_copies() {
        return Split { n, seams: None };
    }
    let vertex_of: Vec<AtomicU32> = mesh::zeroed(mesh.n_half_edges());
    let m = seams.len();
    // While the blocks are processed, the indices in `vertex_of` start at 0 in each block. Afterwards, the number of
    // glTF vertices in all earlier blocks is added to each index.
    let blocks = parallel::blocks(n, |vertices| {
        let mut corners = Vec::with_capacity(BLOCK);
        let (mut values, mut own) = (Vec::new(), Vec::new());
        for i in vertices {
            let first = corners.len();
            values.clear();
            let around = file.all(i).flat_map(|v| mesh.vertex_half_edges(v));
            for h in around.filter(|&h| mesh.face(h).is_some()) {
                own.clear();
                let v = mesh.origin(h);
                own.extend(seams.iter().map(|stream| stream.at(mesh, v, h).0));
                let count = corners.len() - first;
                let known = (count.saturating_sub(MAX_COMPARED)..count)
                    .find(|&k| same(&values[k * m..(k + 1) * m], &own));
                if known.is_none() {
                    values.extend_from_slice(&own);
                    corners.push(number(h.index()));
                }
                let k = first + known.unwrap_or(count);
                vertex_of[h.index()].store(number(k), Relaxed);
            }
        }
        corners
    });
    let mut starts = Vec::with_capacity(blocks.len());
    let mut corners = Vec::new();
    for block in blocks {
        starts.push(number(corners.len()));
        corners.extend(block);
    }
    let vertex_of = parallel::collect(mesh.n_half_edges(), |h| {
        let block = file.number(mesh.origin(HalfEdgeId::new(h))) / BLOCK;
        vertex_of[h].load(Relaxed).saturating_add(starts[block])
    });
    Split {
        n: corners.len(),
        seams: Some(Seams { corners, vertex_of }),
    }
}

/// Whether all values of `a` and `b` have the same bits.
fn same(a: &[[f32; 4]], b: &[[f32; 4]]) -> bool {
    let mut pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.all(|(a, b)| a.to_bits() == b.to_bits())
}

/// Converts the index of a vertex or half-edge to 32 bits. The index is less than 2^32.
fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
