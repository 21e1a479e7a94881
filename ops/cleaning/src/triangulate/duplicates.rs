//! Avoids duplicate diagonals: diagonals between two vertices that an edge or another diagonal already joins.
//!
//! ```text
//!      d ---- c           Both faces of a pillow have the corners a, b, c, d. If both are cut along a-c,
//!     /      /            the mesh has two edges between a and c. If one is cut along a-c and the other
//!    a ---- b             along b-d, it is a tetrahedron.
//! ```
//!
//! A half-edge mesh can represent duplicate edges, but a file of triangles cannot. When a file with duplicate edges is
//! read, the mesh is split at these edges.

use geometry::triangulate::Cut;
use mesh::{FaceId, Mesh, VertexId, parallel};
use rayon::prelude::*;

/// A diagonal: its two vertices, sorted by their ids, and the face that it cuts.
type Diagonal = ([VertexId; 2], FaceId);

/// Replaces each duplicate diagonal of a quadrilateral with the other diagonal of the quadrilateral, unless the other
/// diagonal is worse or also a duplicate. Returns the number of duplicates that remain.
pub(crate) fn avoid(mesh: &Mesh, cuts: &mut [Cut]) -> usize {
    let diagonals = all(mesh, cuts);
    let duplicates = duplicates(mesh, &diagonals);
    if duplicates.is_empty() {
        return 0;
    }
    for (_, f) in duplicates {
        let Cut::Quad {
            from_zero,
            is_free: true,
        } = cuts[f.index()]
        else {
            continue;
        };
        let corners: Vec<VertexId> = mesh.face_vertices(f).collect();
        let i = usize::from(from_zero);
        let other = sorted_pair(corners[i], corners[i + 2]);
        let index = diagonals.partition_point(|(ends, _)| *ends < other);
        let exists = diagonals.get(index).is_some_and(|(ends, _)| *ends == other);
        if !exists && !are_joined(mesh, other) {
            cuts[f.index()] = Cut::Quad {
                from_zero: !from_zero,
                is_free: true,
            };
        }
    }
    self::duplicates(mesh, &all(mesh, cuts)).len()
}

/// Returns the diagonals of all cuts, sorted by their vertices.
fn all(mesh: &Mesh, cuts: &[Cut]) -> Vec<Diagonal> {
    let blocks = parallel::blocks(cuts.len(), |faces| {
        let (mut diagonals, mut pairs) = (Vec::new(), Vec::new());
        for f in faces.filter(|&f| cuts[f].n_diagonals() > 0) {
            let corners: Vec<VertexId> = mesh.face_vertices(FaceId::new(f)).collect();
            pairs.clear();
            cuts[f].diagonals(&mut pairs);
            let ends = pairs.iter().map(|pair| pair.map(|i| corners[i as usize]));
            diagonals.extend(ends.map(|[v, w]| (sorted_pair(v, w), FaceId::new(f))));
        }
        diagonals
    });
    let mut diagonals: Vec<Diagonal> = blocks.concat();
    diagonals.par_sort_unstable();
    diagonals
}

/// Returns the diagonals whose vertices are also joined by an edge or by an earlier diagonal. `diagonals` is sorted.
fn duplicates(mesh: &Mesh, diagonals: &[Diagonal]) -> Vec<Diagonal> {
    let is_repeated = |i: usize| i > 0 && diagonals[i - 1].0 == diagonals[i].0;
    let repeated = parallel::filter(diagonals.len(), |i| {
        is_repeated(i) || are_joined(mesh, diagonals[i].0)
    });
    repeated.into_iter().map(|i| diagonals[i]).collect()
}

fn are_joined(mesh: &Mesh, [v, w]: [VertexId; 2]) -> bool {
    mesh.find_half_edge(v, w).is_some()
}

fn sorted_pair(v: VertexId, w: VertexId) -> [VertexId; 2] {
    [v.min(w), v.max(w)]
}
