//! Two slow and simple implementations of one level of Loop subdivision. Tests compare their results with the results
//! of the crate.

use std::collections::{BTreeMap, BTreeSet};

use mesh::{DVec3, EdgeId, Mesh, VertexId};

use crate::fixtures::{corners, number};

/// Computes a level in the way that courses teach: by splitting and flipping edges. The new positions are computed
/// first. Then every old edge is split in the middle, and every new edge between an old vertex and a new vertex is
/// flipped. At the end, the vertices are moved to the new positions. Vertices have the same ids as in
/// [`crate::subdivide`]; edges and faces do not.
pub(crate) fn by_splits_and_flips(old: &Mesh) -> Mesh {
    let positions = old.vertices().map(|v| moved(old, v));
    let positions: Vec<DVec3> = positions
        .chain(old.edges().map(|e| between(old, e)))
        .collect();

    let mut mesh = old.clone();
    let mut cuts = Vec::new();
    for e in old.edges() {
        let n_edges = mesh.n_edges();
        mesh.split_edge(e, 0.5).unwrap();
        // The split cuts e in half. One half keeps the id of e, and the other half is the first of the new edges. The
        // loop skips this half, because it does not cut a face.
        cuts.extend((n_edges + 1..mesh.n_edges()).map(EdgeId::new));
    }
    let is_old = |v: VertexId| old.has_vertex(v);
    for e in cuts {
        let [v, w] = mesh.edge_vertices(e);
        if is_old(v) != is_old(w) {
            mesh.flip_edge(e).unwrap();
        }
    }
    mesh.positions_mut().copy_from_slice(&positions);
    mesh
}

fn moved(mesh: &Mesh, v: VertexId) -> DVec3 {
    let p = mesh.position(v);
    let on_boundary = |e: &EdgeId| mesh.is_boundary_edge(*e);
    let edges: Vec<EdgeId> = mesh
        .vertex_half_edges(v)
        .map(mesh::HalfEdgeId::edge)
        .collect();
    let n = edges.len() as f64;
    let far = |e: EdgeId| -> DVec3 {
        let [a, b] = mesh.edge_vertices(e);
        mesh.position(if a == v { b } else { a })
    };
    if edges.is_empty() {
        p
    } else if mesh.is_boundary_vertex(v) {
        let sum: DVec3 = edges.iter().copied().filter(on_boundary).map(far).sum();
        0.75 * p + 0.125 * sum
    } else {
        let u = if edges.len() == 3 {
            3.0 / 16.0
        } else {
            3.0 / (8.0 * n)
        };
        (1.0 - n * u) * p + u * edges.into_iter().map(far).sum::<DVec3>()
    }
}

fn between(mesh: &Mesh, e: EdgeId) -> DVec3 {
    let [a, b] = mesh.edge_vertices(e).map(|v| mesh.position(v));
    let faces = mesh.edge_faces(e);
    if faces.contains(&None) {
        return 0.5 * (a + b);
    }
    let opposite = |f: mesh::FaceId| {
        let mut around = mesh.face_vertices(f);
        mesh.position(around.find(|v| !mesh.edge_vertices(e).contains(v)).unwrap())
    };
    let [c, d] = faces.map(|f| opposite(f.unwrap()));
    0.375 * (a + b) + 0.125 * (c + d)
}

/// Subdivides a list of triangles, without the use of half-edges: an edge is a pair of vertices. Returns the positions
/// and the triangles. New vertices on edges come after the old vertices, sorted by the vertex pairs of their edges. The
/// result is wrong if two edges connect the same two vertices.
pub(crate) fn over_polygons(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let at = |v: u32| positions[v as usize];
    // For each edge: the corners opposite to this edge.
    let mut opposite: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for &[a, b, c] in triangles {
        for (v, w, x) in [(a, b, c), (b, c, a), (c, a, b)] {
            opposite.entry([v.min(w), v.max(w)]).or_default().push(x);
        }
    }
    let mut ring = vec![BTreeSet::new(); positions.len()];
    let mut rim = ring.clone();
    for ([v, w], opposite) in &opposite {
        for (v, w) in [(v, w), (w, v)] {
            ring[*v as usize].insert(*w);
            if opposite.len() == 1 {
                rim[*v as usize].insert(*w);
            }
        }
    }
    let sum = |set: &BTreeSet<u32>| set.iter().map(|&v| at(v)).sum::<DVec3>();
    let mut new: Vec<DVec3> = (0..positions.len())
        .map(|v| match (ring[v].len(), rim[v].len()) {
            (0, _) => positions[v],
            (3, 0) => positions[v] * 7.0 / 16.0 + sum(&ring[v]) * 3.0 / 16.0,
            (n, 0) => positions[v] * 5.0 / 8.0 + sum(&ring[v]) * 3.0 / 8.0 / n as f64,
            (_, 2) => positions[v] * 3.0 / 4.0 + sum(&rim[v]) / 8.0,
            other => panic!("vertex {v} is non-manifold: {other:?}"),
        })
        .collect();
    let mut middle = BTreeMap::new();
    for (&[a, b], opposite) in &opposite {
        middle.insert([a, b], u32::try_from(new.len()).unwrap());
        new.push(match opposite[..] {
            [c, d] => (3.0 * at(a) + 3.0 * at(b) + at(c) + at(d)) / 8.0,
            _ => (at(a) + at(b)) / 2.0,
        });
    }
    let middle = |v: u32, w: u32| middle[&[v.min(w), v.max(w)]];
    let triangles = triangles.iter().flat_map(|&[a, b, c]| {
        let (x, y, z) = (middle(a, b), middle(b, c), middle(c, a));
        [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
    });
    (new, triangles.collect())
}

/// Subdivides like [`over_polygons`], with the vertices in the order of [`crate::subdivide`].
pub(crate) fn over_polygons_of(mesh: &Mesh) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let old: Vec<[u32; 3]> = mesh.faces().map(|f| corners(mesh, f)).collect();
    let (positions, mut triangles) = over_polygons(mesh.positions(), &old);
    let mut edges: Vec<([u32; 2], EdgeId)> = mesh
        .edges()
        .map(|e| {
            let mut ends = mesh.edge_vertices(e).map(number);
            ends.sort_unstable();
            (ends, e)
        })
        .collect();
    edges.sort_unstable();
    let n = mesh.n_vertices();
    let mut ordered = positions.clone();
    let mut numbers: Vec<u32> = (0..u32::try_from(positions.len()).unwrap()).collect();
    for (i, (_, e)) in edges.iter().enumerate() {
        ordered[n + e.index()] = positions[n + i];
        numbers[n + i] = u32::try_from(n + e.index()).unwrap();
    }
    for v in triangles.iter_mut().flatten() {
        *v = numbers[*v as usize];
    }
    (ordered, triangles)
}
