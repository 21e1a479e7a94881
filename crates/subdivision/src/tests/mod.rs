//! Properties of all schemes and of each scheme, and comparisons of Loop subdivision with two other
//! implementations.

mod attributes;
mod butterfly;
mod convergence;
mod doo_sabin;
mod large_faces;
mod laws;
mod limit;
mod local;
mod matrix;
mod oracles;
mod schemes;
mod sqrt3;

use mesh::{DVec3, Mesh, VertexId};
use progress::NoProgress;

use crate::{LoopWeights, Rules, Scheme, Split, subdivide};

/// The schemes for which general properties are tested.
pub(crate) const SCHEMES: [Scheme; 7] = [
    Scheme::Loop(LoopWeights::Warren),
    Scheme::CatmullClark,
    Scheme::Midpoint(Split::Triangles),
    Scheme::Midpoint(Split::Quads),
    Scheme::Butterfly,
    Scheme::DooSabin,
    Scheme::Sqrt3,
];

/// Computes one level of Loop subdivision and checks its invariants.
pub(crate) fn once(mesh: &Mesh) -> Mesh {
    level(Scheme::Loop(LoopWeights::Warren), mesh)
}

/// Computes one level of a scheme and checks its invariants.
pub(crate) fn level(scheme: Scheme, mesh: &Mesh) -> Mesh {
    levels(scheme, 1, mesh)
}

/// Computes several levels of a scheme and checks the invariants of the result.
pub(crate) fn levels(scheme: Scheme, levels: u32, mesh: &Mesh) -> Mesh {
    let new = subdivide(mesh, Rules::of(scheme), levels, &NoProgress).unwrap();
    assert_eq!(new.defects(), [], "{scheme:?}");
    new
}

/// Returns the counts that no scheme changes: Euler characteristic, components, boundary loops, isolated
/// vertices.
pub(crate) fn topology(mesh: &Mesh) -> (i64, usize, usize, usize) {
    (
        mesh.euler_characteristic(),
        geometry::n_components(mesh),
        mesh.n_boundary_loops(),
        mesh.n_isolated_vertices(),
    )
}

/// Returns the largest distance between points with the same index.
pub(crate) fn distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .map(|(a, b)| a.distance(*b))
        .fold(0.0, f64::max)
}

/// Whether `v` is one of the four corners of a sheet.
pub(crate) fn is_corner(mesh: &Mesh, v: VertexId) -> bool {
    let [min, max] = geometry::bounds(mesh).unwrap();
    let p = mesh.position(v);
    (p.x == min.x || p.x == max.x) && (p.y == min.y || p.y == max.y)
}
