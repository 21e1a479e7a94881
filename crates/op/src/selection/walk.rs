//! Selections that walk over the mesh: loops and rings of edges, shortest paths, what is connected.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use mesh::{Domain, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

use crate::{OpError, Refusal};

/// The marked edges, and those that go on straight from one of them: across vertices with four edges inside the
/// mesh, and along the boundary from an edge of it.
pub(super) fn edge_loops(mesh: &Mesh, edges: &[EdgeId]) -> Vec<bool> {
    follow(mesh, edges, |h| {
        if mesh.is_boundary_edge(h.edge()) {
            // The side without a face leads along the boundary.
            return Some(match mesh.face(h) {
                None => mesh.next(h),
                Some(_) => mesh.prev(h.twin()).twin(),
            });
        }
        let v = mesh.target(h);
        let is_crossing = mesh.valence(v) == 4 && !mesh.is_boundary_vertex(v);
        is_crossing.then(|| mesh.next(mesh.next(h).twin()))
    })
}

/// The marked edges, and those across from them in faces with four corners, and so on.
pub(super) fn edge_rings(mesh: &Mesh, edges: &[EdgeId]) -> Vec<bool> {
    follow(mesh, edges, |h| {
        let f = mesh.face(h)?;
        (mesh.degree(f) == 4).then(|| mesh.next(mesh.next(h)).twin())
    })
}

/// Follows both halves of each edge from half-edge to half-edge until there is no further one, or it has been
/// there. Each half-edge is visited once.
fn follow(
    mesh: &Mesh,
    edges: &[EdgeId],
    further: impl Fn(HalfEdgeId) -> Option<HalfEdgeId>,
) -> Vec<bool> {
    let mut visited = vec![false; mesh.domain_len(Domain::Corner)];
    let mut mask = vec![false; mesh.domain_len(Domain::Edge)];
    for e in edges {
        let h = e.half_edge();
        for start in [h, h.twin()] {
            let mut at = Some(start);
            while let Some(h) = at.filter(|h| !visited[h.index()]) {
                visited[h.index()] = true;
                mask[h.edge().index()] = true;
                at = further(h);
            }
        }
    }
    mask
}

/// The edges of the shortest path between two vertices: of equal lengths the one whose last steps come from
/// vertices of lower numbers.
///
/// E. W. Dijkstra, "A note on two problems in connexion with graphs", 1959.
///
/// # Errors
///
/// [`Refusal::Missing`] if no edges lead from one to the other.
pub(super) fn shortest_path(
    mesh: &Mesh,
    from: VertexId,
    to: VertexId,
) -> Result<Vec<EdgeId>, OpError> {
    let n = mesh.domain_len(Domain::Vertex);
    let mut distance = vec![f64::INFINITY; n];
    let mut arrival: Vec<Option<HalfEdgeId>> = vec![None; n];
    let mut is_done = vec![false; n];
    // The bits of numbers that are not negative are in the order of the numbers.
    let mut heap = BinaryHeap::from([Reverse((0_u64, from))]);
    distance[from.index()] = 0.0;
    while let Some(Reverse((_, v))) = heap.pop() {
        if v == to {
            break;
        }
        if std::mem::replace(&mut is_done[v.index()], true) {
            continue;
        }
        for h in mesh.vertex_half_edges(v) {
            let w = mesh.target(h).index();
            let length = distance[v.index()] + mesh.length(h);
            let is_tie = length == distance[w]
                && !is_done[w]
                && arrival[w].is_some_and(|other| v < mesh.origin(other));
            if length < distance[w] || is_tie {
                distance[w] = length;
                arrival[w] = Some(h);
                heap.push(Reverse((length.to_bits(), mesh.target(h))));
            }
        }
    }
    let mut path = Vec::new();
    let mut at = to;
    while at != from {
        let Some(h) = arrival[at.index()] else {
            let message = format!(
                "no edges lead from vertex {} to vertex {}",
                from.index(),
                to.index()
            );
            return Err(OpError::refused(Refusal::Missing, message).about([from, to]));
        };
        path.push(h.edge());
        at = mesh.origin(h);
    }
    Ok(path)
}

/// The marked vertices, and all that edges lead to.
pub(super) fn connected(mesh: &Mesh, mut mask: Vec<bool>) -> Vec<bool> {
    let mut open: Vec<VertexId> = mesh.vertices().filter(|v| mask[v.index()]).collect();
    while let Some(v) = open.pop() {
        for w in mesh.vertex_neighbors(v) {
            if !std::mem::replace(&mut mask[w.index()], true) {
                open.push(w);
            }
        }
    }
    mask
}

/// The marked faces, and those beside them across edges that turn by at most `angle`, in degrees, and so on.
pub(super) fn spread(mesh: &Mesh, mut mask: Vec<bool>, angle: f64) -> Vec<bool> {
    let mut open: Vec<FaceId> = mesh.faces().filter(|f| mask[f.index()]).collect();
    while let Some(f) = open.pop() {
        for h in mesh.face_half_edges(f) {
            let Some(other) = mesh.face(h.twin()).filter(|g| !mask[g.index()]) else {
                continue;
            };
            let turn = mesh.dihedral_angle(h.edge()).map(f64::to_degrees);
            if turn.is_some_and(|turn| turn <= angle) {
                mask[other.index()] = true;
                open.push(other);
            }
        }
    }
    mask
}
