//! Moves vertices towards the mean of their neighbors, or away from this mean.

use mesh::{DVec3, Mesh, VertexId};
use progress::Progress;

use super::{Role, SmoothError, Smoother, Weights};
use crate::Laplacian;
use crate::sparse::SymmetricMatrix;

/// Returns the factor μ of the second step of a Taubin pass, in which the mesh grows. This factor is negative and
/// satisfies 1 / factor + 1 / μ = `pass_band`.
pub(super) fn growing_factor(factor: f64, pass_band: f64) -> f64 {
    factor / (pass_band * factor - 1.0)
}

/// Moves each vertex towards the weighted mean of its neighbors, by the fraction `factor` of the way.
pub(super) fn step(
    smoother: &Smoother,
    mesh: &mut Mesh,
    weights: Weights,
    factor: f64,
    progress: &dyn Progress,
) -> Result<(), SmoothError> {
    match weights {
        Weights::Uniform => smoother.gather(mesh, |mesh, v, role| {
            let p = mesh.position(v);
            let to_mean = match role {
                Role::Rim => along_rim(mesh, v, |_| 1.0),
                _ => mean(
                    mesh.vertex_neighbors(v)
                        .map(|w| (mesh.position(w) - p, 1.0)),
                ),
            };
            p + factor * to_mean
        }),
        Weights::Cotangent => {
            let matrix = Laplacian::new(mesh, progress)?.stiffness;
            smoother.gather(mesh, |mesh, v, role| {
                let to_mean = match role {
                    Role::Rim => along_rim(mesh, v, |length| 1.0 / length.max(f64::MIN_POSITIVE)),
                    _ => mean(neighbors(&matrix, mesh, v)),
                };
                mesh.position(v) + factor * to_mean
            });
        }
    }
    Ok(())
}

/// Returns the vectors from `v` to its neighbors, each with the weight of the neighbor.
fn neighbors<'a>(
    matrix: &'a SymmetricMatrix,
    mesh: &'a Mesh,
    v: VertexId,
) -> impl Iterator<Item = (DVec3, f64)> + 'a {
    let others = matrix
        .row(v.index())
        .filter(move |&(w, _)| w as usize != v.index());
    let p = mesh.position(v);
    others.map(move |(w, entry)| (mesh.positions()[w as usize] - p, f64::max(0.0, -entry)))
}

/// Returns the vector from `v` to the weighted mean of its two neighbors on the boundary. `weight` computes the weight
/// of a neighbor from its distance.
fn along_rim(mesh: &Mesh, v: VertexId, weight: impl Fn(f64) -> f64) -> DVec3 {
    let p = mesh.position(v);
    let rim = mesh
        .vertex_half_edges(v)
        .filter(|h| mesh.is_boundary_edge(h.edge()));
    mean(rim.map(|h| {
        let to_neighbor = mesh.position(mesh.target(h)) - p;
        (to_neighbor, weight(to_neighbor.length()))
    }))
}

/// Returns the weighted mean of vectors, which are given with their weights. Returns the zero vector if all weights are
/// zero.
fn mean(vectors: impl Iterator<Item = (DVec3, f64)>) -> DVec3 {
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for (vector, weight) in vectors {
        sum += weight * vector;
        total += weight;
    }
    if total > 0.0 {
        sum / total
    } else {
        DVec3::ZERO
    }
}
