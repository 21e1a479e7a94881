//! Lists the elements of a mesh in a fixed order. Two meshes are compared element by element: the n-th element in the
//! list of one mesh with the n-th element in the list of the other mesh.

use mesh::{EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

/// The elements of a mesh in an order that depends only on the ids of vertices and faces.
pub(super) struct Order {
    pub(super) vertices: Vec<VertexId>,
    pub(super) faces: Vec<FaceId>,
    /// The corners, sorted by face. Within a face, the corner at the vertex with the lowest id comes first.
    pub(super) corners: Vec<HalfEdgeId>,
    /// The edges, sorted by the lower vertex id of each edge. Edges with the same lower vertex id are sorted by the
    /// higher vertex id.
    pub(super) edges: Vec<EdgeId>,
}

impl Order {
    pub(super) fn of(mesh: &Mesh) -> Self {
        let faces: Vec<FaceId> = mesh.faces().collect();
        let mut corners = Vec::with_capacity(2 * mesh.n_edges());
        for &f in &faces {
            let begin = corners.len();
            corners.extend(mesh.face_half_edges(f));
            let of_face = &mut corners[begin..];
            let lowest = (0..of_face.len()).min_by_key(|&i| mesh.origin(of_face[i]));
            of_face.rotate_left(lowest.unwrap_or(0));
        }
        let mut edges: Vec<EdgeId> = mesh.edges().collect();
        // The sort is stable: several edges between the same vertices stay in the order of their ids.
        edges.sort_by_key(|&e| pair(mesh, e));
        Self {
            vertices: mesh.vertices().collect(),
            faces,
            corners,
            edges,
        }
    }
}

fn pair(mesh: &Mesh, e: EdgeId) -> [VertexId; 2] {
    let [v, w] = mesh.edge_vertices(e);
    [v.min(w), v.max(w)]
}

/// Whether corresponding faces and edges have the same vertices.
pub(super) fn same_connectivity(a: &Mesh, b: &Mesh, [p, q]: &[Order; 2]) -> bool {
    let mut degrees = p.faces.iter().zip(&q.faces);
    let mut corners = p.corners.iter().zip(&q.corners);
    let mut edges = p.edges.iter().zip(&q.edges);
    p.vertices == q.vertices
        && p.faces.len() == q.faces.len()
        && p.edges.len() == q.edges.len()
        && degrees.all(|(&f, &g)| a.degree(f) == b.degree(g))
        && corners.all(|(&h, &k)| a.origin(h) == b.origin(k))
        && edges.all(|(&e, &d)| pair(a, e) == pair(b, d))
}
