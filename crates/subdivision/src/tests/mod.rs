//! Laws of all schemes and of each, and comparisons of Loop subdivision with two other ways to compute it.

mod attributes;
mod butterfly;
mod convergence;
mod doo_sabin;
mod laws;
mod limit;
mod local;
mod matrix;
mod other_ways;
mod schemes;
mod sqrt3;

use mesh::{DVec3, Mesh, VertexId};
use progress::NoProgress;

use crate::{LoopWeights, Rules, Scheme, Split, subdivide};

/// The schemes that laws are tried with.
pub(crate) const SCHEMES: [Scheme; 7] = [
    Scheme::Loop(LoopWeights::Warren),
    Scheme::CatmullClark,
    Scheme::Midpoint(Split::Triangles),
    Scheme::Midpoint(Split::Quads),
    Scheme::Butterfly,
    Scheme::DooSabin,
    Scheme::Sqrt3,
];

/// One level of Loop subdivision, checked.
pub(crate) fn once(mesh: &Mesh) -> Mesh {
    level(Scheme::Loop(LoopWeights::Warren), mesh)
}

/// One level of a scheme, checked.
pub(crate) fn level(scheme: Scheme, mesh: &Mesh) -> Mesh {
    levels(scheme, 1, mesh)
}

/// So many levels of a scheme, checked.
pub(crate) fn levels(scheme: Scheme, levels: u32, mesh: &Mesh) -> Mesh {
    let new = subdivide(mesh, Rules::of(scheme), levels, &NoProgress).unwrap();
    assert_eq!(new.defects(), [], "{scheme:?}");
    new
}

/// What no scheme changes: Euler characteristic, components, loops of the boundary, isolated vertices.
pub(crate) fn kind(mesh: &Mesh) -> (i64, usize, usize, usize) {
    (
        mesh.euler_characteristic(),
        geometry::n_components(mesh),
        mesh.n_boundary_loops(),
        mesh.n_isolated_vertices(),
    )
}

/// The largest distance between two points of the same place.
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
