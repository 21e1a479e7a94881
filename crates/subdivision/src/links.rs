//! Connectivity that is written element by element: each is a function of its number and the old mesh.

use mesh::{Connectivity, FaceId, HalfEdgeId, VertexId};
use progress::{Cancelled, Meter};
use rayon::prelude::*;

use crate::parallel::{BLOCK, fill_uncounted};

/// Half-edges to be written: the same part of three arrays.
pub(crate) struct Arrays<'n> {
    pub(crate) next: &'n mut [HalfEdgeId],
    pub(crate) origin: &'n mut [VertexId],
    pub(crate) face: &'n mut [FaceId],
}

impl Arrays<'_> {
    /// Splits into the first `n` half-edges and the others.
    pub(crate) fn split_at(self, n: usize) -> (Self, Self) {
        let (next, other_next) = self.next.split_at_mut(n);
        let (origin, other_origin) = self.origin.split_at_mut(n);
        let (face, other_face) = self.face.split_at_mut(n);
        let others = Self {
            next: other_next,
            origin: other_origin,
            face: other_face,
        };
        (Self { next, origin, face }, others)
    }
}

/// What is written for one element: `N` half-edges, and the first half-edges of `K` faces or vertices.
pub(crate) struct Entries<const N: usize, const K: usize> {
    pub(crate) next: [HalfEdgeId; N],
    pub(crate) origin: [VertexId; N],
    pub(crate) face: [FaceId; N],
    pub(crate) first: [HalfEdgeId; K],
}

/// Writes in parallel the entries of every element, which stand one after the other.
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
        let (block, other_halves) = halves.split_at(N * len);
        let (first, other_firsts) = firsts.split_at_mut(K * len);
        blocks.push((block, first));
        (halves, firsts) = (other_halves, other_firsts);
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

/// Writes the half-edges, and what else begins with one of them, of the block with this number.
type Task<'a> = dyn Fn(usize, Arrays, &mut [HalfEdgeId]) -> Result<(), Cancelled> + Sync + 'a;

/// The loop of the threads, compiled once.
fn each_block(blocks: Vec<(Arrays, &mut [HalfEdgeId])>, task: &Task) -> Result<(), Cancelled> {
    let blocks = blocks.into_par_iter().enumerate();
    blocks.try_for_each(|(block, (halves, firsts))| task(block, halves, firsts))
}

/// The origin of a half-edge, the one after it, and its face, which is [`FaceId::NONE`] on the boundary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link(
    pub(crate) VertexId,
    pub(crate) HalfEdgeId,
    pub(crate) FaceId,
);

/// The elements of a new mesh.
pub(crate) trait Links: Sync {
    /// How many vertices, edges and faces there are.
    fn counts(&self) -> [usize; 3];

    /// The two halves of edge `i`.
    fn edge(&self, i: usize) -> [Link; 2];

    /// The half-edge of vertex `i`; [`HalfEdgeId::NONE`] if it is isolated.
    fn vertex(&self, i: usize) -> HalfEdgeId;

    /// The half-edge of face `i`.
    fn face(&self, i: usize) -> HalfEdgeId;
}

/// The arrays of a mesh with these numbers of vertices, edges and faces, to be filled.
pub(crate) fn zeroed([vertices, edges, faces]: [usize; 3]) -> Connectivity {
    Connectivity {
        next: mesh::zeroed(2 * edges),
        origin: mesh::zeroed(2 * edges),
        face: mesh::zeroed(2 * edges),
        vertex_half_edge: mesh::zeroed(vertices),
        face_half_edge: mesh::zeroed(faces),
    }
}

/// The arrays of such a mesh.
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
