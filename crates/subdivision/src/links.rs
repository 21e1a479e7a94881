//! Writes connectivity arrays in parallel. The array entries of a new element depend only on the id of this element and
//! on the old mesh.

use mesh::{Connectivity, FaceId, HalfEdgeId, VertexId};
use progress::{Cancelled, Meter};
use rayon::prelude::*;

use crate::parallel::{BLOCK, fill_uncounted};

/// A range of half-edges to be written: the slices of three arrays (next half-edge, origin and face) for these
/// half-edges.
pub(crate) struct Arrays<'n> {
    pub(crate) next: &'n mut [HalfEdgeId],
    pub(crate) origin: &'n mut [VertexId],
    pub(crate) face: &'n mut [FaceId],
}

impl Arrays<'_> {
    /// Splits the range into the first `n` half-edges and the remaining half-edges.
    pub(crate) fn split_at(self, n: usize) -> (Self, Self) {
        let (next, rest_next) = self.next.split_at_mut(n);
        let (origin, rest_origin) = self.origin.split_at_mut(n);
        let (face, rest_face) = self.face.split_at_mut(n);
        let rest = Self {
            next: rest_next,
            origin: rest_origin,
            face: rest_face,
        };
        (Self { next, origin, face }, rest)
    }
}

/// The array entries of one element: the data of `N` half-edges, and the first half-edge of each of `K` faces or
/// vertices.
pub(crate) struct Entries<const N: usize, const K: usize> {
    pub(crate) next: [HalfEdgeId; N],
    pub(crate) origin: [VertexId; N],
    pub(crate) face: [FaceId; N],
    pub(crate) first: [HalfEdgeId; K],
}

/// Computes the array entries of all elements in parallel. The arrays contain the entries in the order of the elements.
pub(crate) fn write<const N: usize, const K: usize>(
    mut halves: Arrays,
    mut firsts: &mut [HalfEdgeId],
    meter: &Meter,
    entries: impl Fn(usize) -> Entries<N, K> + Sync,
) -> Result<(), Cancelled> {
    let n = halves.next.len() / N;
    let mut blocks = Vec::with_capacity(n.div_ceil(BLOCK));
    for start in (0..n).step_by(BLOCK) {
        let len = BLOCK.min(n - start);
        let (block, rest_halves) = halves.split_at(N * len);
        let (first, rest_firsts) = firsts.split_at_mut(K * len);
        blocks.push((block, first));
        (halves, firsts) = (rest_halves, rest_firsts);
    }
    each_block(blocks, &|block, halves, firsts| {
        let next = halves.next.as_chunks_mut::<N>().0.iter_mut();
        let origin = halves.origin.as_chunks_mut::<N>().0.iter_mut();
        let face = halves.face.as_chunks_mut::<N>().0.iter_mut();
        let len = next.len();
        for (i, ((next, origin), face)) in next.zip(origin).zip(face).enumerate() {
            let new = entries(block * BLOCK + i);
            *next = new.next;
            *origin = new.origin;
            *face = new.face;
            firsts[K * i..][..K].copy_from_slice(&new.first);
        }
        meter.add(len)
    })
}

/// Writes the block with the given index: its half-edges, and the first half-edges of its faces or vertices.
type Task<'a> = dyn Fn(usize, Arrays, &mut [HalfEdgeId]) -> Result<(), Cancelled> + Sync + 'a;

/// Runs `task` on all blocks in parallel. The task is `dyn`, so that the parallel loop is compiled once and not for
/// each closure.
fn each_block(blocks: Vec<(Arrays, &mut [HalfEdgeId])>, task: &Task) -> Result<(), Cancelled> {
    let blocks = blocks.into_par_iter().enumerate();
    blocks.try_for_each(|(block, (halves, firsts))| task(block, halves, firsts))
}

/// The origin, the next half-edge and the face of a half-edge. The face is [`FaceId::NONE`] on the boundary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link(
    pub(crate) VertexId,
    pub(crate) HalfEdgeId,
    pub(crate) FaceId,
);

/// Computes the connectivity of a new mesh, separately for each edge, vertex and face.
pub(crate) trait Links: Sync {
    /// Returns the number of vertices, the number of edges, and the number of faces.
    fn counts(&self) -> [usize; 3];

    /// Returns the two half-edges of edge `i`.
    fn edge(&self, i: usize) -> [Link; 2];

    /// Returns the half-edge of vertex `i`; [`HalfEdgeId::NONE`] if the vertex is isolated.
    fn vertex(&self, i: usize) -> HalfEdgeId;

    /// Returns the half-edge of face `i`.
    fn face(&self, i: usize) -> HalfEdgeId;
}

/// Allocates zeroed arrays for a mesh with this many vertices, edges and faces.
pub(crate) fn zeroed([vertices, edges, faces]: [usize; 3]) -> Connectivity {
    Connectivity {
        next: mesh::zeroed(2 * edges),
        origin: mesh::zeroed(2 * edges),
        face: mesh::zeroed(2 * edges),
        vertex_half_edge: mesh::zeroed(vertices),
        face_half_edge: mesh::zeroed(faces),
    }
}

/// Fills the connectivity arrays of the mesh that `links` describes.
pub(crate) fn connectivity(links: &impl Links, meter: &Meter) -> Result<Connectivity, Cancelled> {
    let mut new = zeroed(links.counts());
    let halves = Arrays {
        next: &mut new.next,
        origin: &mut new.origin,
        face: &mut new.face,
    };
    write(halves, &mut [], meter, |e| {
        let halves = links.edge(e);
        Entries {
            next: halves.map(|Link(_, next, _)| next),
            origin: halves.map(|Link(origin, _, _)| origin),
            face: halves.map(|Link(_, _, face)| face),
            first: [],
        }
    })?;
    fill_uncounted(&mut new.vertex_half_edge, meter, |i| links.vertex(i))?;
    fill_uncounted(&mut new.face_half_edge, meter, |i| links.face(i))?;
    Ok(new)
}
