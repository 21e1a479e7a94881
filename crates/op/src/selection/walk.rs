//! Selections that traverse the mesh: edge loops, edge rings, shortest paths, connected components.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use mesh::{Domain, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

use crate::{OpError, Refusal};

/// Returns one flag for each edge of the mesh: whether the edge is in `edges` or on an edge loop through one of them.
/// At an interior vertex with four edges, an edge loop continues with the opposite edge. At all other vertices, the
/// loop ends. An edge loop that contains a boundary edge follows the boundary instead.
pub(super) fn edge_loops(mesh: &Mesh, edges: &[EdgeId]) -> Vec<bool> {
    follow(mesh, edges, |h| {
        if mesh.is_boundary_edge(h.edge()) {
            // Half-edges without a face form the boundary loop, so `next` follows the boundary.
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

/// Returns one flag for each edge of the mesh: whether the edge is in `edges` or on an edge ring through one of them.
/// In a face with four corners, an edge ring passes from an edge to the opposite edge. The ring ends at the boundary
/// and at faces with a different number of corners.
pub(super) fn edge_rings(mesh: &Mesh, edges: &[EdgeId]) -> Vec<bool> {
    follow(mesh, edges, |h| {
        let f = mesh.face(h)?;
        (mesh.degree(f) == 4).then(|| mesh.next(mesh.next(h)).twin())
    })
}

/// Starts at both half-edges of each edge and calls `successor` repeatedly, until it returns `None` or a half-edge that
/// was already visited. Returns the visited edges. Each half-edge is visited at most once.
fn follow(
    mesh: &Mesh,
    edges: &[EdgeId],
    successor: impl Fn(HalfEdgeId) -> Option<HalfEdgeId>,
) -> Vec<bool> {
    let mut visited = vec![false; mesh.domain_len(Domain::Corner)];
    let mut mask = vec![false; mesh.domain_len(Domain::Edge)];
    for e in edges {
        let h = e.half_edge();
        for start in [h, h.twin()] {
            let mut current = Some(start);
            while let Some(h) = current.filter(|h| !visited[h.index()]) {
                visited[h.index()] = true;
                mask[h.edge().index()] = true;
                current = successor(h);
            }
        }
    }
    mask
}

/// Returns the edges of the shortest path between two vertices, starting with the edge at `to`. If several shortest
/// paths lead to a vertex, the path on which the previous vertex has the lowest id is chosen.
///
/// E. W. Dijkstra, "A note on two problems in connexion with graphs", 1959.
///
/// # Errors
///
/// Returns [`Refusal::Missing`] if no path exists.
pub(super) fn shortest_path(
    mesh: &Mesh,
    from: VertexId,
    to: VertexId,
) -> Result<Vec<EdgeId>, OpError> {
    let n = mesh.domain_len(Domain::Vertex);
    let mut distance = vec![f64::INFINITY; n];
    let mut arrival: Vec<Option<HalfEdgeId>> = vec![None; n];
    let mut is_done = vec![false; n];
    // The heap compares the bit patterns of the distances. For non-negative floating-point numbers, the bit patterns
    // have the same order as the numbers.
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
    let mut current = to;
    while current != from {
        let Some(h) = arrival[current.index()] else {
            let message = format!(
                "no path along edges leads from vertex {} to vertex {}",
                from.index(),
                to.index()
            );
            return Err(OpError::refused(Refusal::Missing, message).about([from, to]));
        };
        path.push(h.edge());
        current = mesh.origin(h);
    }
    Ok(path)
}

/// Returns the vertices of all connected components that contain a marked vertex.
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

/// Returns the marked faces, and all faces that can be reached from them across edges with a dihedral angle of at most
/// `angle` degrees.
pub(super) fn spread(mesh: &Mesh, mut mask: Vec<bool>, angle: f64) -> Vec<bool> {
    let turn = mesh.dihedral_angles();
    let mut open: Vec<FaceId> = mesh.faces().filter(|f| mask[f.index()]).collect();
    while let Some(f) = open.pop() {
        for h in mesh.face_half_edges(f) {
            let Some(other) = mesh.face(h.twin()).filter(|g| !mask[g.index()]) else {
                continue;
            };
            if turn(h.edge()).is_some_and(|turn| turn.to_degrees() <= angle) {
                mask[other.index()] = true;
                open.push(other);
            }
        }
    }
    mask
}
