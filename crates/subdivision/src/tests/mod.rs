//! Laws, and comparisons of Loop subdivision with two other ways to compute it.

mod attributes;
mod laws;
mod limit;
mod other_ways;
mod plan;

use mesh::{DVec3, Mesh, VertexId};
use op::NoProgress;

use crate::{LoopWeights, Rules, Scheme, subdivide};

/// One level, checked.
pub(crate) fn once(mesh: &Mesh) -> Mesh {
    let rules = Rules::of(Scheme::Loop(LoopWeights::Warren));
    let new = subdivide(mesh, rules, 1, &NoProgress).unwrap();
    assert_eq!(new.defects(), []);
    new
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
    let [min, max] = mesh.bounds().unwrap();
    let p = mesh.position(v);
    (p.x == min.x || p.x == max.x) && (p.y == min.y || p.y == max.y)
}
