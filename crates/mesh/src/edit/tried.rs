//! What every edit promises, asked of any edit in a test.

use std::fmt::Debug;

use crate::{EdgeId, EditError, HalfEdgeId, Mesh, VertexId};

/// Tries an edit. A refusal must leave every array as it was; an edit must leave a valid mesh with one
/// gap at a boundary vertex and no new pairs of parallel edges, and must be taken back, done again and
/// taken back again to the same bytes.
pub(super) fn tried<T: Debug>(
    mesh: &Mesh,
    edit: impl Fn(&mut Mesh) -> Result<T, EditError>,
) -> Result<(Mesh, T), EditError> {
    let mut rolled_back = mesh.clone();
    rolled_back.begin();
    let result = edit(&mut rolled_back);
    if result.is_err() {
        assert_eq!(&rolled_back, mesh, "refused, but changed: {result:?}");
    }
    let edited = rolled_back.clone();
    rolled_back.rollback();
    assert_eq!(&rolled_back, mesh, "rolled back");
    let made = result?;
    assert_eq!(edited.defects(), [], "after {made:?}");
    assert_one_gap(&edited);
    assert!(n_parallel(&edited) <= n_parallel(mesh), "after {made:?}");

    let mut reverted = mesh.clone();
    reverted.begin();
    edit(&mut reverted).expect("the same edit of the same mesh");
    assert_eq!(reverted, edited, "the same edit of the same mesh");
    let mut change = reverted.commit().expect("one level");
    for expected in [mesh, &edited, mesh, &edited] {
        change = reverted.revert(change);
        assert_eq!(&reverted, expected, "reverted");
    }
    Ok((reverted, made))
}

/// A vertex has one fan of faces, so it begins one boundary half-edge at most.
fn assert_one_gap(mesh: &Mesh) {
    let mut seen = vec![false; mesh.positions().len()];
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_none()) {
        let v = mesh.origin(h);
        assert!(!seen[v.index()], "two gaps at {v}");
        seen[v.index()] = true;
    }
}

/// How many edges join two vertices that an edge before joins.
pub(super) fn n_parallel(mesh: &Mesh) -> usize {
    let mut ends: Vec<[VertexId; 2]> = mesh.edges().map(|e| mesh.edge_vertices(e)).collect();
    for pair in &mut ends {
        pair.sort_unstable();
    }
    ends.sort_unstable();
    ends.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

/// The corners of all faces, each face from its lowest vertex: what the mesh is but for its ids.
pub(super) fn polygons(mesh: &Mesh) -> Vec<Vec<usize>> {
    let corners = |f| {
        let mut face: Vec<usize> = mesh.face_vertices(f).map(VertexId::index).collect();
        let low = (0..face.len()).min_by_key(|&i| face[i]).expect("corners");
        face.rotate_left(low);
        face
    };
    mesh.faces().map(corners).collect()
}

/// The half-edge from the vertex of number `v` to that of number `w`.
pub(super) fn half_edge(mesh: &Mesh, v: usize, w: usize) -> HalfEdgeId {
    mesh.find_half_edge(VertexId::new(v), VertexId::new(w))
        .expect("an edge")
}

/// The mesh with an edge opened between ends that stay: a hole of two edges. Both ends must be inside.
pub(super) fn with_slit(mut mesh: Mesh, e: EdgeId) -> Mesh {
    let [_, old] = e.half_edges();
    let (before, after, face) = (mesh.prev(old), mesh.next(old), mesh.face(old).unwrap());
    let new = mesh.push_edge(mesh.target(old), mesh.origin(old));
    let [out, kept] = new.half_edges();
    mesh.set_next(before, kept);
    mesh.set_next(kept, after);
    mesh.set_face(kept, Some(face));
    mesh.set_face_half_edge(face, kept);
    mesh.set_face(old, None);
    mesh.set_next(old, out);
    mesh.set_next(out, old);
    mesh.set_vertex_half_edge(mesh.origin(old), Some(old));
    mesh.set_vertex_half_edge(mesh.origin(out), Some(out));
    assert_eq!(mesh.defects(), []);
    mesh
}
