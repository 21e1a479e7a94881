//! Splits every old edge in two, as most schemes do.
//!
//! New edges are numbered so that the id of each new half-edge can be computed from the old ids, without a search. V is
//! the number of old vertices. Old edge e consists of half-edge 2e and its twin. Half-edge 2e is called h below, and
//! runs from a to b. The old edge becomes the new edges 2e and 2e + 1, which meet at the new vertex V + e:
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
//! Each vertex stores one outgoing half-edge. An old vertex stores the first part of the half-edge that the old mesh
//! stores for this vertex. If that old half-edge is on the boundary, its first part is on the boundary, too. A new
//! vertex lies on an old edge, and stores the second part of one of the two half-edges of this edge. If the old edge is
//! on the boundary, this is the half-edge without a face.
//!
//! The four half-edges and the vertex of each old edge are computed from the old mesh only, so all old edges can
//! be processed in parallel. The idea is from Vanhoey and Dupuy, "A Halfedge Refinement Rule for Parallel Loop
//! Subdivision", 2022, adapted to half-edges stored in pairs.

use mesh::{Connectivity, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter};

use crate::links::{self, Arrays, Entries};
use crate::parallel::fill_uncounted;
use crate::topology::Place;

/// Returns the first part of half-edge `h`, which starts at the origin of `h`.
#[inline]
pub(crate) fn first(h: HalfEdgeId) -> HalfEdgeId {
    HalfEdgeId::new(2 * h.index() + (h.index() & 1))
}

/// Returns the second part of half-edge `h`, which ends at the target of `h`.
#[inline]
pub(crate) fn second(h: HalfEdgeId) -> HalfEdgeId {
    HalfEdgeId::new(first(h).index() ^ 2)
}

/// Returns the new vertex on the edge of `h`.
#[inline]
pub(crate) fn on_edge(mesh: &Mesh, h: HalfEdgeId) -> VertexId {
    VertexId::new(mesh.n_vertices() + h.edge().index())
}

/// New half-edge `i` must be a part of an old half-edge. Returns the location, in the old mesh, of the corner at its
/// origin.
pub(crate) fn place(mesh: &Mesh, i: usize) -> Place {
    // An old edge has four parts: parts 0 and 2 belong to its first half-edge, parts 1 and 3 to its second half-edge.
    // Part 0 starts at the origin of the first half-edge, and part 3 starts at the origin of the second half-edge.
    let h = HalfEdgeId::new(i / 4 * 2 + i % 2);
    if mesh.face(h).is_none() {
        Place::Outside
    } else if matches!(i % 4, 0 | 3) {
        Place::At(h)
    } else {
        Place::On(h)
    }
}

/// For the two parts of a half-edge: the next half-edge of each part, and the face of each part.
pub(crate) type PartLinks = ([HalfEdgeId; 2], [FaceId; 2]);

/// The last entries of the arrays of the next level: the entries of the new elements that do not lie on old edges.
pub(crate) struct AddedArrays<'n> {
    pub(crate) halves: Arrays<'n>,
    /// For each new vertex that does not lie on an old edge, the half-edge that this vertex stores.
    pub(crate) vertex_half_edge: &'n mut [HalfEdgeId],
    pub(crate) face_half_edge: &'n mut [HalfEdgeId],
}

/// Builds the connectivity of the next subdivision level. The links of a half-edge are its next half-edge and its face.
/// The parts of old edges come first; `parts` gives the links of the two parts of each old half-edge. `fill_added`
/// writes the new elements that do not lie on old edges. `vertices`, `edges` and `faces` are the numbers of these added
/// elements.
pub(crate) fn split_edges(
    mesh: &Mesh,
    [vertices, edges, faces]: [usize; 3],
    parts: impl Fn(HalfEdgeId) -> PartLinks + Sync,
    fill_added: impl FnOnce(AddedArrays) -> Result<(), Cancelled>,
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
    fill_added(AddedArrays {
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
    fn the_four_parts_of_an_edge_have_consecutive_ids() {
        let [h, twin] = mesh::EdgeId::new(5).half_edges();
        let parts = [first(h), second(twin), second(h), first(twin)];
        assert_eq!(parts.map(HalfEdgeId::index), [20, 21, 22, 23]);
        assert_eq!(first(h).twin(), second(twin));
        assert_eq!(second(h).twin(), first(twin));
    }
}
