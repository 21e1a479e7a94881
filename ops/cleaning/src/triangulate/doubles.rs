//! Diagonals that would join two vertices a second time.
//!
//! ```text
//!      d ---- c           the two sides of a pillow have the same corners: cut along a-c and a-c it
//!     /|     /|           has two edges between a and c; along a-c and b-d it is a tetrahedron
//!    a ---- b
//! ```
//!
//! A half-edge mesh can have them, but a file of triangles cannot: read again, it falls apart there.

use geometry::triangulate::Cut;
use mesh::{FaceId, Mesh, VertexId};
use rayon::prelude::*;

/// A diagonal: its vertices, lower first, and its face.
type Diagonal = ([VertexId; 2], FaceId);

/// Turns diagonals of quadrilaterals that would be doubles, where the other one is as good and is none.
/// Returns how many doubles remain.
pub(crate) fn avoid(mesh: &Mesh, cuts: &mut [Cut]) -> usize {
    let diagonals = all(mesh, cuts);
    let doubles = doubles(mesh, &diagonals);
    if doubles.is_empty() {
        return 0;
    }
    for (_, f) in doubles {
        let Cut::Quad {
            from_zero,
            is_free: true,
        } = cuts[f.index()]
        else {
            continue;
        };
        let corners: Vec<VertexId> = mesh.face_vertices(f).collect();
        let i = usize::from(from_zero);
        let other = rising(corners[i], corners[i + 2]);
        let place = diagonals.partition_point(|(ends, _)| *ends < other);
        let is_there = diagonals.get(place).is_some_and(|(ends, _)| *ends == other);
        if !is_there && !are_joined(mesh, other) {
            cuts[f.index()] = Cut::Quad {
                from_zero: !from_zero,
                is_free: true,
            };
        }
    }
    self::doubles(mesh, &all(mesh, cuts)).len()
}

/// All diagonals, sorted.
fn all(mesh: &Mesh, cuts: &[Cut]) -> Vec<Diagonal> {
    let mut diagonals: Vec<Diagonal> = cuts
        .par_iter()
        .enumerate()
        .with_min_len(256)
        .filter(|(_, cut)| cut.n_diagonals() > 0)
        .flat_map_iter(|(f, cut)| {
            let f = FaceId::new(f);
            let corners: Vec<VertexId> = mesh.face_vertices(f).collect();
            let mut pairs = Vec::new();
            cut.diagonals(&mut pairs);
            pairs
                .into_iter()
                .map(move |[i, j]| (rising(corners[i as usize], corners[j as usize]), f))
        })
        .collect();
    diagonals.par_sort_unstable();
    diagonals
}

/// Of sorted diagonals those that join vertices which share an edge, or an earlier diagonal.
fn doubles(mesh: &Mesh, diagonals: &[Diagonal]) -> Vec<Diagonal> {
    diagonals
        .par_iter()
        .enumerate()
        .with_min_len(256)
        .filter(|&(i, (ends, _))| (i > 0 && diagonals[i - 1].0 == *ends) || are_joined(mesh, *ends))
        .map(|(_, diagonal)| *diagonal)
        .collect()
}

fn are_joined(mesh: &Mesh, [v, w]: [VertexId; 2]) -> bool {
    mesh.find_half_edge(v, w).is_some()
}

fn rising(v: VertexId, w: VertexId) -> [VertexId; 2] {
    [v.min(w), v.max(w)]
}
