//! Builds the arrays of the cut mesh.
//!
//! Old half-edges keep their indices and their origins. Only `next` and `face` of old half-edges change. The diagonals
//! are added face by face, in the order of [`Cut::diagonals`]. The first half-edge of a diagonal starts at the corner
//! with the lower index.

use geometry::triangulate::Cut;
use mesh::{EdgeId, FaceId, HalfEdgeId, Mesh, Sources, VertexId};

/// Returns a mesh in which the faces of `mesh` are cut as `cuts` specifies. `n_diagonals` is the total number of
/// diagonals. The new mesh must not have more elements than there are ids.
pub(crate) fn assemble(mesh: &Mesh, cuts: &[Cut], n_diagonals: usize) -> Mesh {
    let n_old = mesh.n_half_edges();
    let n = n_old + 2 * n_diagonals;
    let mut connectivity = mesh.connectivity().clone();
    connectivity.next.resize(n, HalfEdgeId::NONE);
    connectivity.face.resize(n, FaceId::NONE);
    connectivity.origin.reserve_exact(2 * n_diagonals);
    connectivity.face_half_edge.clear();
    let mut corner_sources: Vec<HalfEdgeId> = (0..n_old).map(HalfEdgeId::new).collect();
    let mut face_sources: Vec<FaceId> = Vec::with_capacity(mesh.n_faces() + n_diagonals);

    let mut sides: Vec<HalfEdgeId> = Vec::new();
    let mut diagonals: Vec<[u32; 2]> = Vec::new();
    for (f, cut) in mesh.faces().zip(cuts) {
        sides.clear();
        sides.extend(mesh.face_half_edges(f));
        if *cut == Cut::Keep {
            let new = FaceId::new(connectivity.face_half_edge.len());
            for h in &sides {
                connectivity.face[h.index()] = new;
            }
            connectivity.face_half_edge.push(sides[0]);
            face_sources.push(f);
            continue;
        }
        cut.diagonals(&mut diagonals);
        let first = connectivity.origin.len();
        for corner in diagonals.iter().flatten() {
            let h = sides[*corner as usize];
            connectivity.origin.push(mesh.origin(h));
            corner_sources.push(h);
        }
        // Returns the half-edge from the corner `from` to the corner `to`: a side of the face, or a half-edge of a
        // diagonal.
        let half_edge = |from: u32, to: u32| {
            let pair = [from.min(to), from.max(to)];
            match diagonals.binary_search(&pair) {
                Ok(k) => HalfEdgeId::new(first + 2 * k + usize::from(from > to)),
                Err(_) => sides[from as usize],
            }
        };
        for &[a, b, c] in cut.triangles() {
            let new = FaceId::new(connectivity.face_half_edge.len());
            let triangle = [half_edge(a, b), half_edge(b, c), half_edge(c, a)];
            for k in 0..3 {
                connectivity.next[triangle[k].index()] = triangle[(k + 1) % 3];
                connectivity.face[triangle[k].index()] = new;
            }
            connectivity.face_half_edge.push(triangle[0]);
            face_sources.push(f);
        }
    }

    let mut attributes = mesh.attributes().gathered(Sources {
        vertices: &mesh.vertices().collect::<Vec<VertexId>>(),
        corners: &corner_sources,
        edges: &edge_sources(mesh.n_edges(), n_diagonals),
        faces: &face_sources,
    });
    attributes.drop_by_rule();
    let mut cut = Mesh::from_arrays(connectivity, mesh.positions().to_vec());
    cut.set_attributes(attributes);
    cut
}

/// Returns, for each edge of the cut mesh, the source: the old edge whose attribute values this edge gets. The source
/// of an old edge is the edge itself. The source of a diagonal is `NONE`, so diagonals get zero values.
fn edge_sources(n_old: usize, n_diagonals: usize) -> Vec<EdgeId> {
    let mut sources: Vec<EdgeId> = (0..n_old).map(EdgeId::new).collect();
    sources.resize(n_old + n_diagonals, EdgeId::NONE);
    sources
}
