//! Fixtures and checks for the tests of the edits.

use std::fmt::Debug;

use glam::{DVec2, DVec3, DVec4};

use crate::{
    COLOR, Column, Domain, EdgeId, EditError, HalfEdgeId, MATERIAL, Mesh, Rule, UV, Values,
    VertexId, shapes,
};

/// Returns closed and open meshes of triangles, squares and larger faces; some have attributes.
pub(super) fn sample_shapes() -> Vec<Mesh> {
    vec![
        shapes::square(),
        with_attributes(shapes::grid(3, 2)),
        with_attributes(shapes::fans(&shapes::grid(3, 2))),
        shapes::cube(),
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::icosahedron(),
        shapes::torus(4, 3, 2.0, 1.0),
        shapes::cylinder(5, true),
        shapes::cylinder(3, false),
    ]
}

/// Adds UVs and colors that are linear in x and y. The UVs have a seam: on face 0 they are x and y, on the
/// other faces x + 10 and y + 10. Materials are 5, 6, 6, ... The face column "dropped" has the rule `Drop`.
pub(super) fn with_attributes(mut mesh: Mesh) -> Mesh {
    let position = |h| mesh.position(mesh.origin(h)).truncate();
    let uv = |h| match mesh.face(h) {
        Some(f) if f.index() == 0 => position(h),
        Some(_) => position(h) + DVec2::splat(10.0),
        None => DVec2::ZERO,
    };
    let uvs = mesh.half_edges().map(uv).collect();
    let colors = mesh.positions().iter();
    let colors = colors.map(|p| DVec4::new(p.x, p.y, p.z, 1.0)).collect();
    let n = mesh.n_faces();
    mesh.set(UV, uvs);
    mesh.set(COLOR, colors);
    mesh.set(
        MATERIAL,
        (0..n).map(|f| if f == 0 { 5 } else { 6 }).collect(),
    );
    let dropped = Column {
        name: "dropped".to_owned(),
        rule: Rule::Drop,
        values: Values::Float(vec![0.5; n]),
    };
    mesh.insert_column(Domain::Face, dropped);
    mesh
}

/// Returns a mesh of one face with a hole. Edge e3 joins vertex 0 on the outer boundary to vertex 3 of the
/// hole. The face is on both sides of e3, and contains both vertices twice.
///
/// ```text
///    2---------1
///     \ 5---4 /
///      \ \ / /
///       \ 3 /
///        \|/
///         0
/// ```
pub(super) fn ring() -> Mesh {
    of_one_face(
        &[[0, 1], [1, 2], [2, 0], [0, 3], [3, 5], [5, 4], [4, 3]],
        &[&[0, 2, 4, 6, 8, 10, 12, 7], &[1, 5, 3], &[13, 11, 9]],
        &[5, 1, 3, 13, 11, 9],
    )
}

/// Returns a square in which edge e4 joins corner 0 to vertex 4 in the middle. Vertex 4 has no other edge.
pub(super) fn spur() -> Mesh {
    of_one_face(
        &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 4]],
        &[&[0, 2, 4, 6, 8, 9], &[1, 7, 5, 3]],
        &[7, 1, 3, 5, 9],
    )
}

/// Returns a mesh with these edges and loops of half-edges. The mesh has one face, inside the first loop. The other
/// loops have no face. `outgoing` contains one outgoing half-edge of each vertex.
fn of_one_face(edges: &[[usize; 2]], loops: &[&[usize]], outgoing: &[usize]) -> Mesh {
    let mut mesh = Mesh::default();
    let vertices: Vec<VertexId> = (0..outgoing.len())
        .map(|i| mesh.push_vertex(DVec3::splat(i as f64)))
        .collect();
    for &[v, w] in edges {
        mesh.push_edge(vertices[v], vertices[w]);
    }
    let half_edge = HalfEdgeId::new;
    for around in loops {
        for (&h, &after) in around.iter().zip(around.iter().cycle().skip(1)) {
            mesh.set_next(half_edge(h), half_edge(after));
        }
    }
    let f = mesh.push_face(half_edge(loops[0][0]));
    loops[0]
        .iter()
        .for_each(|&h| mesh.set_face(half_edge(h), Some(f)));
    for (&v, &h) in vertices.iter().zip(outgoing) {
        mesh.set_vertex_half_edge(v, Some(half_edge(h)));
    }
    assert_eq!(mesh.defects(), []);
    mesh
}

/// Returns the faces in order of ids. Each face is a list of vertex indices that starts with the lowest index.
pub(super) fn polygons(mesh: &Mesh) -> Vec<Vec<usize>> {
    let corners = |f| {
        let mut corners: Vec<_> = mesh.face_vertices(f).map(VertexId::index).collect();
        let low = (0..corners.len()).min_by_key(|&i| corners[i]);
        corners.rotate_left(low.unwrap_or(0));
        corners
    };
    mesh.faces().map(corners).collect()
}

/// Applies an edit like [`checked_edit`], but returns only the edited mesh.
pub(super) fn checked_edit_mesh(
    before: &Mesh,
    edit: impl Fn(&mut Mesh) -> Result<(), EditError>,
) -> Result<Mesh, EditError> {
    checked_edit(before, edit).map(|(mesh, ())| mesh)
}

/// Applies an edit to a copy of the mesh and checks the result. A refused edit must leave every array unchanged. After
/// an accepted edit, the mesh must be valid and must not have more parallel edges than before. Undo must restore the
/// old mesh, and redo must restore the edited mesh.
pub(super) fn checked_edit<T: Debug>(
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
    let output = result?;
    assert_eq!(edited.defects(), [], "after {output:?}");
    assert!(n_parallel(&edited) <= n_parallel(mesh), "after {output:?}");

    let mut reverted = mesh.clone();
    reverted.begin();
    edit(&mut reverted).expect("the same edit of the same mesh");
    assert_eq!(reverted, edited, "the same edit of the same mesh");
    let mut change = reverted.commit().expect("one level");
    for expected in [mesh, &edited, mesh, &edited] {
        change = reverted.revert(change);
        assert_eq!(&reverted, expected, "reverted");
    }
    Ok((reverted, output))
}

/// Returns the number of edges whose ends are already joined by an earlier edge.
pub(super) fn n_parallel(mesh: &Mesh) -> usize {
    let mut ends: Vec<[VertexId; 2]> = mesh.edges().map(|e| mesh.edge_vertices(e)).collect();
    for pair in &mut ends {
        pair.sort_unstable();
    }
    ends.sort_unstable();
    ends.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

/// Returns the half-edge from the vertex with index `v` to the vertex with index `w`.
pub(super) fn half_edge(mesh: &Mesh, v: usize, w: usize) -> HalfEdgeId {
    mesh.find_half_edge(VertexId::new(v), VertexId::new(w))
        .expect("the vertices share an edge")
}

/// Cuts an edge without splitting its ends, which gives a hole with two edges. Both ends of the edge must be
/// inside the mesh.
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
