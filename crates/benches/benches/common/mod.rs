//! Helpers for the benchmarks of local edits.

use geometry::shapes;
use mesh::{EdgeId, Mesh};

/// A torus of a million triangles.
pub(crate) fn torus() -> Mesh {
    shapes::fans(&shapes::torus(1000, 500, 2.0, 1.0))
}

/// Returns the edges in a random order, which is the same in every run. Uses the Fisher-Yates shuffle with a 64-bit
/// linear congruential generator (Knuth, "The Art of Computer Programming", volume 2, 1997, 3.3.4).
pub(crate) fn shuffled(mut edges: Vec<EdgeId>) -> Vec<EdgeId> {
    let mut state = 1_u64;
    for i in (1..edges.len()).rev() {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let high = usize::try_from(state >> 33).expect("31 bits");
        edges.swap(i, high % (i + 1));
    }
    edges
}
