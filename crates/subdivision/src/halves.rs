//! The two halves of every old edge, which most schemes make.
//!
//! New edges are numbered so that each new half-edge can be found without looking for it. An old edge e with
//! halves h = 2e, from a to b, and its twin becomes edges 2e and 2e + 1 around the new vertex V + e:
//!
//! ```text
//!            first(h) = 4e            second(h) = 4e + 2
//!         -------------------->    -------------------->
//!       a                       V+e                      b
//!         <--------------------    <--------------------
//!        second(twin) = 4e + 1      first(twin) = 4e + 3
//!
//!      first(h) = 2h + (h & 1)       second(h) = first(h) ^ 2
//! ```
//!
//! An old vertex keeps the first part of its half-edge, which is on the boundary if that was. A new
//! vertex leaves along the second part of a half, the boundary one if there is one.
//!
//! So one task for each old edge writes four half-edges and a vertex, and none reads what another writes.
//! The idea is that of Vanhoey and Dupuy, "A Halfedge Refinement Rule for Parallel Loop Subdivision", 2022,
//! for edges in pairs.

use mesh::{Connectivity, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use crate::links::{self, Arrays, Entries};
use crate::parallel::fill_uncounted;
use crate::topology::Place;

/// The part of half-edge `h` that leaves its origin.
#[inline]
pub(crate) fn first(h: HalfEdgeId) -> HalfEdgeId {
    HalfEdgeId::new(2 * h.index() + (h.index() & 1))
}

/// The part of half-edge `h` that goes to its target.
#[inline]
pub(crate) fn second(h: HalfEdgeId) -> HalfEdgeId {
    HalfEdgeId::new(first(h).index() ^ 2)
}

/// The new vertex on the edge of `h`.
#[inline]
pub(crate) fn on_edge(mesh: &Mesh, h: HalfEdgeId) -> VertexId {
    VertexId::new(mesh.n_vertices() + h.edge().index())
}

/// Where the corner of new half-edge `i` lies, which is a part of an old one.
pub(crate) fn place(mesh: &Mesh, i: usize) -> Place {
    // Of the four parts of an edge 0 and 2 belong to its first half, 1 and 3 to its second, and 0 and 3
    // are the first parts.
    let h = HalfEdgeId::new(i / 4 * 2 + i % 2);
    if mesh.face(h).is_none() {
        Place::Outside
    } else if matches!(i % 4, 0 | 3) {
        Place::At(h)
    } else {
        Place::On(h)
    }
}

/// What follows the first and the second part of a half-edge, and the faces of both.
pub(crate) type Parts = ([HalfEdgeId; 2], [FaceId; 2]);

/// The arrays of the next level, to be filled behind the halves of old edges.
pub(crate) struct Rest<'n> {
    pub(crate) halves: Arrays<'n>,
    /// Of the vertices behind those on old edges.
    pub(crate) vertex_half_edge: &'n mut [HalfEdgeId],
    pub(crate) face_half_edge: &'n mut [HalfEdgeId],
}

/// The connectivity of the next level: the halves of old edges, with what `parts` says of each half-edge,
/// and behind them `edges` more edges, `vertices` more vertices and `faces` faces, which `rest` fills.
pub(crate) fn split_edges(
    mesh: &Mesh,
    [vertices, edges, faces]: [usize; 3],
    parts: impl Fn(HalfEdgeId) -> Parts + Sync,
    rest: impl FnOnce(Rest) -> Result<(), Cancelled>,
    meter: &Meter,
) -> Result<Connectivity, Cancelled> {
    let (n_vertices, n_edges) = (mesh.n_vertices(), mesh.n_edges());
    let mut new = links::zeroed([n_vertices + n_edges + vertices, 2 * n_edges + edges, faces]);
    let halves = Arrays {
        next: &mut new.next,
        origin: &mut new.origin,
        face: &mut new.face,
    };
    let (of_edges, halves) = halves.split_at(4 * n_edges);
    let (kept, added) = new.vertex_half_edge.split_at_mut(n_vertices);
    let (leaving, vertex_half_edge) = added.split_at_mut(n_edges);
    links::write(of_edges, leaving, meter, |e| {
        let h = HalfEdgeId::new(2 * e);
        let ([h1, h2], [f1, f2]) = parts(h);
        let ([t1, t2], [g1, g2]) = parts(h.twin());
        let m = VertexId::new(n_vertices + e);
        Entries {
            next: [h1, t2, h2, t1],
            origin: [mesh.origin(h), m, m, mesh.origin(h.twin())],
            face: [f1, g2, f2, g1],
            first: [second(if g2 == FaceId::NONE { h.twin() } else { h })],
        }
    })?;
    let old = &mesh.connectivity().vertex_half_edge;
    fill_uncounted(kept, meter, |v| {
        old[v].some().map_or(HalfEdgeId::NONE, first)
    })?;
    rest(Rest {
        halves,
        vertex_half_edge,
        face_half_edge: &mut new.face_half_edge,
    })?;
    Ok(new)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_four_parts_of_an_edge_are_its_four_half_edges() {
        let [h, twin] = mesh::EdgeId::new(5).half_edges();
        let parts = [first(h), second(twin), second(h), first(twin)];
        assert_eq!(parts.map(HalfEdgeId::index), [20, 21, 22, 23]);
        assert_eq!(first(h).twin(), second(twin));
        assert_eq!(second(h).twin(), first(twin));
    }
}
