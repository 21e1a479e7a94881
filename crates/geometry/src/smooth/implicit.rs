//! Smooths a mesh by one backward Euler step of mean curvature flow.

use mesh::{DVec3, Mesh, parallel};
use progress::Progress;

use super::{Role, SmoothError, Smoother};
use crate::sparse::{Factor, SymmetricMatrix};
use crate::{Laplacian, bounds};

/// The longest time of the flow, in multiples of the squared diagonal of the bounding box. After this time, a shape has
/// shrunk to less than a thousandth of its size. For this time, the equations are still well conditioned.
const LONGEST: f64 = 1e3;
/// The shortest length of a boundary edge in the equations, as a fraction of the mean length of the boundary edges. A
/// shorter boundary edge counts as an edge of this length.
const SHORTEST: f64 = 1e-5;

/// Solves (M + time L) x' = M x for the new positions x', where L is the Laplacian, and M is the diagonal matrix of the
/// vertex areas. The solver computes the displacements d = x' - x from (M + time L) d = -time L x. Therefore the result
/// does not depend on the distance of the mesh from the origin.
pub(super) fn step(
    smoother: &Smoother,
    mesh: &mut Mesh,
    time: f64,
    progress: &dyn Progress,
) -> Result<(), SmoothError> {
    let diagonal = bounds(mesh).map_or(0.0, |[min, max]| min.distance(max));
    // If all vertices are at the same point, the mesh does not change.
    if diagonal == 0.0 {
        return Ok(());
    }
    let time = time.min(LONGEST * diagonal * diagonal);
    if smoother.roles.contains(&Role::Rim) {
        let (matrix, masses) = rim_laplacian(mesh);
        solve(smoother, mesh, Role::Rim, &matrix, &masses, time, progress)?;
    }
    let Laplacian { stiffness, areas } = Laplacian::new(mesh, progress)?;
    solve(
        smoother,
        mesh,
        Role::Free,
        &stiffness,
        &areas,
        time,
        progress,
    )
}

/// Solves the equations for the vertices with the given [`Role`], and moves these vertices. All other vertices stay in
/// place.
fn solve(
    smoother: &Smoother,
    mesh: &mut Mesh,
    role: Role,
    stiffness: &SymmetricMatrix,
    masses: &[f64],
    time: f64,
    progress: &dyn Progress,
) -> Result<(), SmoothError> {
    let is_pinned: Vec<bool> = smoother.roles.iter().map(|&r| r != role).collect();
    if is_pinned.iter().all(|&pinned| pinned) {
        return Ok(());
    }
    let matrix = stiffness.scaled_plus_diagonal(time, masses);
    let factor = Factor::with_pins(&matrix, &is_pinned, progress)?;
    let positions = mesh.positions();
    let force = |i: usize| {
        let p = positions[i];
        let row = stiffness.row(i).filter(|&(j, _)| j as usize != i);
        let terms = row.map(|(j, entry)| -entry * time * (positions[j as usize] - p));
        terms.fold(DVec3::ZERO, |sum, term| sum + term)
    };
    let forces: Vec<DVec3> = parallel::collect(positions.len(), force);
    let mut moves = vec![DVec3::ZERO; positions.len()];
    factor.solve(&forces, &mut moves)?;
    for (p, by) in mesh.positions_mut().iter_mut().zip(moves) {
        *p += by;
    }
    Ok(())
}

/// Returns the Laplacian of the boundary, which is treated as a set of curves. The weight of an edge is 1 / length. The
/// mass of a vertex is half the total length of its two boundary edges.
fn rim_laplacian(mesh: &Mesh) -> (SymmetricMatrix, Vec<f64>) {
    let edges = || mesh.edges().filter(|&e| mesh.is_boundary_edge(e));
    let lengths = edges().map(|e| mesh.length(e.half_edge()));
    let (sum, n) = lengths.fold((0.0, 0.0), |(sum, n), length| (sum + length, n + 1.0));
    let shortest = if sum > 0.0 { SHORTEST * (sum / n) } else { 1.0 };
    let mut entries = Vec::new();
    let mut masses = vec![0.0; mesh.positions().len()];
    for e in edges() {
        let length = f64::max(mesh.length(e.half_edge()), shortest);
        let [v, w] = mesh.edge_vertices(e).map(|v| {
            masses[v.index()] += 0.5 * length;
            u32::try_from(v.index()).expect("ids fit 32 bits")
        });
        if v != w {
            let weight = 1.0 / length;
            entries.extend([(v, w, -weight), (v, v, weight), (w, w, weight)]);
        }
    }
    (SymmetricMatrix::from_entries(masses.len(), entries), masses)
}
