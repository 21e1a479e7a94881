//! Whether arrays form a mesh: the invariants of [`Mesh::defects`](mesh::Mesh::defects), asked by all
//! threads and without naming elements, for arrays from outside.

use glam::DVec3;
use mesh::{Connectivity, FaceId, HalfEdgeId, VertexId};
use rayon::prelude::*;

/// Elements that one thread looks at in one go.
const BLOCK: usize = 1 << 14;

/// What is wrong with the arrays of a dense mesh, if anything. Takes time in proportion to their length.
pub(crate) fn unsound(c: &Connectivity, positions: &[DVec3]) -> Option<&'static str> {
    let n = c.next.len();
    if !n.is_multiple_of(2)
        || c.origin.len() != n
        || c.face.len() != n
        || c.vertex_half_edge.len() != positions.len()
    {
        return Some("arrays that belong together differ in length");
    }
    if n.max(positions.len()).max(c.face_half_edge.len()) >= u32::MAX as usize {
        return Some("there are more elements than ids");
    }
    // Everything below indexes the arrays: first, every entry names an element that is there.
    let is_half_edge = |h: HalfEdgeId| h.index() < n;
    let within = all(n, |i| {
        is_half_edge(c.next[i])
            && c.origin[i].index() < positions.len()
            && (c.face[i] == FaceId::NONE || c.face[i].index() < c.face_half_edge.len())
    }) && all(positions.len(), |v| {
        let h = c.vertex_half_edge[v];
        positions[v].is_finite() && (h == HalfEdgeId::NONE || is_half_edge(h))
    }) && all(c.face_half_edge.len(), |f| {
        is_half_edge(c.face_half_edge[f])
    });
    if !within {
        return Some("an entry names an element that is not there, or a position is not finite");
    }
    let (is_permutation, is_linked) = rayon::join(
        || is_permutation(&c.next),
        || all(n, |i| is_linked(c, HalfEdgeId::new(i))),
    );
    if !is_permutation || !is_linked {
        return Some("half-edges do not follow each other around faces");
    }
    // `next` is a permutation that stays on its face, so every walk comes back to where it began, walks of
    // different faces meet nowhere, and they pass all corners if every face is one loop. The same holds for
    // the walks around vertices.
    let corners = c.face.par_iter().with_min_len(BLOCK);
    let n_corners = corners.filter(|&&f| f != FaceId::NONE).count();
    if sum(c.face_half_edge.len(), |f| degree(c, f)) != Some(n_corners) {
        return Some("the half-edges of a face are not one loop of three or more");
    }
    if sum(positions.len(), |v| valence(c, v)) != Some(n) {
        return Some("the half-edges of a vertex are not one fan");
    }
    None
}

fn all(n: usize, holds: impl Fn(usize) -> bool + Sync + Send) -> bool {
    (0..n).into_par_iter().with_min_len(BLOCK).all(holds)
}

/// The sum of all terms, if there are all.
fn sum(n: usize, term: impl Fn(usize) -> Option<usize> + Sync + Send) -> Option<usize> {
    (0..n).into_par_iter().with_min_len(BLOCK).map(term).sum()
}

fn is_permutation(next: &[HalfEdgeId]) -> bool {
    let mut reached = vec![0_u64; next.len().div_ceil(64)];
    next.iter().all(|h| {
        let (word, bit) = (&mut reached[h.index() / 64], 1 << (h.index() % 64));
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    })
}

/// Whether the half-edge after `h` begins where `h` ends, on the same face, and the edge is one.
fn is_linked(c: &Connectivity, h: HalfEdgeId) -> bool {
    let (next, twin) = (c.next[h.index()], h.twin());
    let face = c.face[h.index()];
    c.origin[next.index()] == c.origin[twin.index()]
        && c.face[next.index()] == face
        && c.origin[h.index()] != c.origin[twin.index()]
        && (face != FaceId::NONE || c.face[twin.index()] != FaceId::NONE)
}

/// The number of corners of a face; `None` if it is no face.
fn degree(c: &Connectivity, f: usize) -> Option<usize> {
    let first = c.face_half_edge[f];
    if c.face[first.index()] != FaceId::new(f) {
        return None;
    }
    let mut h = c.next[first.index()];
    let mut n = 1;
    while h != first {
        h = c.next[h.index()];
        n += 1;
    }
    (n >= 3).then_some(n)
}

/// The number of half-edges that leave a vertex; `None` if they are not as they must be.
fn valence(c: &Connectivity, v: usize) -> Option<usize> {
    let first = c.vertex_half_edge[v];
    if first == HalfEdgeId::NONE {
        return Some(0);
    }
    if c.origin[first.index()] != VertexId::new(v) {
        return None;
    }
    let mut h = c.next[first.twin().index()];
    let mut n = 1;
    while h != first {
        // The one gap that there may be is where the vertex begins.
        if c.face[h.index()] == FaceId::NONE {
            return None;
        }
        h = c.next[h.twin().index()];
        n += 1;
    }
    Some(n)
}
