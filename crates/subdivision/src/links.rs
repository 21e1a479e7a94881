//! Connectivity that is written element by element: each is a function of its number and the old mesh.

use mesh::{Connectivity, FaceId, HalfEdgeId, VertexId};
use op::OpError;
use rayon::prelude::*;

use crate::meter::{BLOCK, Meter};

/// What is known of a half-edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub(crate) origin: VertexId,
    pub(crate) next: HalfEdgeId,
    /// [`FaceId::NONE`] on the boundary.
    pub(crate) face: FaceId,
}

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

/// The arrays of such a mesh.
pub(crate) fn connectivity(links: &impl Links, meter: &Meter) -> Result<Connectivity, OpError> {
    let [vertices, edges, faces] = links.counts();
    let mut new = Connectivity {
        next: mesh::zeroed(2 * edges),
        origin: mesh::zeroed(2 * edges),
        face: mesh::zeroed(2 * edges),
        vertex_half_edge: mesh::zeroed(vertices),
        face_half_edge: mesh::zeroed(faces),
    };
    (
        new.next.par_chunks_mut(2 * BLOCK),
        new.origin.par_chunks_mut(2 * BLOCK),
        new.face.par_chunks_mut(2 * BLOCK),
    )
        .into_par_iter()
        .enumerate()
        .try_for_each(|(block, (next, origin, face))| {
            let n = next.len() / 2;
            let next = next.as_chunks_mut::<2>().0.iter_mut();
            let origin = origin.as_chunks_mut::<2>().0.iter_mut();
            let face = face.as_chunks_mut::<2>().0.iter_mut();
            for (e, ((next, origin), face)) in (block * BLOCK..).zip(next.zip(origin).zip(face)) {
                let halves = links.edge(e);
                *next = halves.map(|half| half.next);
                *origin = halves.map(|half| half.origin);
                *face = halves.map(|half| half.face);
            }
            meter.add(n)
        })?;
    write(&mut new.vertex_half_edge, |i| links.vertex(i));
    write(&mut new.face_half_edge, |i| links.face(i));
    Ok(new)
}

fn write(array: &mut [HalfEdgeId], value: impl Fn(usize) -> HalfEdgeId + Sync) {
    array
        .par_iter_mut()
        .with_min_len(BLOCK)
        .enumerate()
        .for_each(|(i, slot)| *slot = value(i));
}
