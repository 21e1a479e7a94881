//! How the elements of the next level lie in a mesh.

use std::f64::consts::TAU;

use mesh::{Connectivity, DVec4, EdgeId, FaceId, HalfEdgeId, Mesh};
use progress::{Cancelled, Meter};

/// How the elements of the next level lie in a dense mesh.
pub(crate) trait Topology: Sync {
    /// The connectivity of the next level.
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, Cancelled>;

    /// Where the corner of half-edge `i` of the next level lies in the old mesh.
    fn corner(&self, finer: &Connectivity, i: usize) -> Place;

    /// The old vertex that new vertex `i` is, if any. By default old vertices come first, and a number above
    /// theirs is none.
    fn vertex(&self, i: usize) -> Option<usize> {
        Some(i)
    }

    /// The old edge that new edge `i` is a part of.
    fn edge(&self, i: usize) -> Option<usize>;

    /// The old face that new face `i` is a part of.
    fn face(&self, i: usize) -> Option<usize>;

    /// The old half-edge whose part at the origin new edge `i` is. Where there are creases, each edge has two
    /// parts, which come first unless this says otherwise.
    fn half(&self, i: usize) -> Option<HalfEdgeId> {
        self.edge(i).map(|_| HalfEdgeId::new(i))
    }

    /// Whether an old vertex, and what is there, is smoothed where the scheme smooths; otherwise it stays.
    fn moves(&self, _: usize) -> bool {
        true
    }

    /// Whether what is new on an edge is smoothed where the scheme smooths; otherwise it lies in the
    /// middle.
    fn smooths(&self, _: EdgeId) -> bool {
        true
    }
}

/// Where a corner of the next level lies in an old face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At the origin of this half-edge.
    At(HalfEdgeId),
    /// In the middle of this half-edge.
    On(HalfEdgeId),
    /// In the center of this face.
    In(FaceId),
    /// At the Doo-Sabin point that is pulled in from the origin of this half-edge.
    Pulled(HalfEdgeId),
    /// On an edge, one n-th of the way from the origin of the first half-edge to that of the second.
    Toward([HalfEdgeId; 2], u32),
    /// Nowhere: the half-edge is on the boundary.
    Outside,
}

/// The place on the edge of `h`, one n-th of the way from its origin, in the face that `h` or its twin has.
pub(crate) fn near(mesh: &Mesh, h: HalfEdgeId, n: u32) -> Place {
    if mesh.face(h).is_some() {
        Place::Toward([h, mesh.next(h)], n)
    } else {
        Place::Toward([mesh.next(h.twin()), h.twin()], n)
    }
}

/// Adds the old corners that a new one is the mean of, all in its own old face.
pub(crate) fn linear(mesh: &Mesh, place: Place, add: &mut dyn FnMut(usize, f64)) {
    match place {
        Place::At(h) => add(h.index(), 1.0),
        Place::On(h) => {
            add(h.index(), 0.5);
            add(mesh.next(h).index(), 0.5);
        }
        Place::In(f) => {
            let part = 1.0 / mesh.degree(f) as f64;
            for h in mesh.face_half_edges(f) {
                add(h.index(), part);
            }
        }
        Place::Pulled(h) => pulled(mesh, h, |h, w| add(h.index(), w)),
        Place::Toward([near, far], n) => {
            let part = 1.0 / f64::from(n);
            add(near.index(), 1.0 - part);
            add(far.index(), part);
        }
        Place::Outside => {}
    }
}

/// That mean.
pub(crate) fn linear_value(mesh: &Mesh, place: Place, old: &[DVec4]) -> DVec4 {
    let mut sum = DVec4::ZERO;
    linear(mesh, place, &mut |source, w| sum += old[source] * w);
    sum
}

/// Adds the corners of the face of `h`, by the half-edges that leave them, with their weights in the point
/// pulled in from the origin of `h`.
#[inline]
pub(crate) fn pulled(mesh: &Mesh, h: HalfEdgeId, mut add: impl FnMut(HalfEdgeId, f64)) {
    let n = mesh.loop_half_edges(h).count();
    for (j, h) in mesh.loop_half_edges(h).enumerate() {
        add(h, pulled_weight(n, j));
    }
}

/// The weight of the `j`-th corner of a face with `n`.
#[inline]
fn pulled_weight(n: usize, j: usize) -> f64 {
    match (n, j) {
        (4, 0) => 9.0 / 16.0,
        (4, 2) => 1.0 / 16.0,
        (4, _) => 3.0 / 16.0,
        (3, 0) => 2.0 / 3.0,
        (3, _) => 1.0 / 6.0,
        (_, 0) => (n + 5) as f64 / (4 * n) as f64,
        _ => (3.0 + 2.0 * libm::cos(TAU * (j as f64 / n as f64))) / (4 * n) as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_of_a_face_sum_to_one_and_pull_a_regular_polygon_in_by_half() {
        for n in 3..30 {
            let ring = |k: f64| -> f64 {
                let at = |j: usize| libm::cos(k * TAU * j as f64 / n as f64);
                (0..n).map(|j| pulled_weight(n, j) * at(j)).sum()
            };
            assert!((ring(0.0) - 1.0).abs() < 1e-15, "{n}");
            assert!((ring(1.0) - 0.5).abs() < 1e-15, "{n}");
        }
    }
}
