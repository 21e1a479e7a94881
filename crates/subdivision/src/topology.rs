//! Relates the elements of the next level to the elements of the old mesh.

use std::f64::consts::TAU;

use mesh::{Connectivity, DVec4, EdgeId, FaceId, HalfEdgeId, Mesh};
use progress::{Cancelled, Meter};

/// Computes the connectivity of the next subdivision level, and the old element from which each new element comes. The
/// old mesh has no deleted elements.
pub(crate) trait Topology: Sync {
    /// Computes the connectivity of the next level.
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, Cancelled>;

    /// Half-edge `i` of the next level represents a corner. Returns the location of this corner in the old mesh.
    fn corner(&self, finer: &Connectivity, i: usize) -> Place;

    /// Returns the id of the old vertex from which vertex `i` of the next level comes. Vertex `i` is new if the result
    /// is `None` or is not the id of an old vertex. The default returns `i`, because old vertices keep their ids in
    /// most schemes.
    fn vertex(&self, i: usize) -> Option<usize> {
        Some(i)
    }

    /// If new edge `i` is a part of an old edge, returns the old edge.
    fn edge(&self, i: usize) -> Option<usize>;

    /// If new face `i` is a part of an old face, returns the old face.
    fn face(&self, i: usize) -> Option<usize>;

    /// If edge `i` of the next level is the part of an old edge next to one of its ends, returns the half-edge of the
    /// old edge that starts at this end. The default is for schemes that split each old edge in two and number the
    /// parts of old edges before all other edges.
    fn half(&self, i: usize) -> Option<HalfEdgeId> {
        self.edge(i).map(|_| HalfEdgeId::new(i))
    }

    /// Whether the masks of the scheme apply to an old vertex and its attributes. If not, the vertex and its attributes
    /// stay unchanged.
    fn smooths_vertex(&self, _: usize) -> bool {
        true
    }

    /// Whether the new vertex on an edge follows the masks of the scheme. Otherwise the new vertex lies in the
    /// middle of the edge.
    fn smooths_edge(&self, _: EdgeId) -> bool {
        true
    }
}

/// Where a corner of the next level lies in an old face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At the origin of this half-edge.
    At(HalfEdgeId),
    /// In the middle of the edge of this half-edge, in the face of the half-edge.
    On(HalfEdgeId),
    /// In the center of this face.
    In(FaceId),
    /// At the Doo-Sabin point of the corner at the origin of this half-edge.
    DooSabin(HalfEdgeId),
    /// On an edge, at 1/n of the way from the origin of the first half-edge to the origin of the second.
    Toward([HalfEdgeId; 2], u32),
    /// Outside of all faces: the half-edge is on the boundary.
    Outside,
}

/// Returns the location on the edge of `h`, at 1/n of the way from the origin of `h`. If `h` has a face, the location
/// is in this face; otherwise, it is in the face of the twin of `h`.
pub(crate) fn place_near_origin(mesh: &Mesh, h: HalfEdgeId, n: u32) -> Place {
    if mesh.face(h).is_some() {
        Place::Toward([h, mesh.next(h)], n)
    } else {
        Place::Toward([mesh.next(h.twin()), h.twin()], n)
    }
}

/// The value of the new corner at `place` is a weighted mean of the values of old corners. Calls `add` with each of
/// these old corners and its weight. All of them belong to one face.
pub(crate) fn add_linear(mesh: &Mesh, place: Place, add: &mut dyn FnMut(usize, f64)) {
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
        Place::DooSabin(h) => add_doo_sabin(mesh, h, |h, w| add(h.index(), w)),
        Place::Toward([near, far], n) => {
            let part = 1.0 / f64::from(n);
            add(near.index(), 1.0 - part);
            add(far.index(), part);
        }
        Place::Outside => {}
    }
}

/// Returns the mean of the old corner values, with the weights of [`add_linear`].
pub(crate) fn linear_value(mesh: &Mesh, place: Place, old: &[DVec4]) -> DVec4 {
    let mut sum = DVec4::ZERO;
    add_linear(mesh, place, &mut |source, w| sum += old[source] * w);
    sum
}

/// Computes the Doo-Sabin point of the corner at the origin of `h`. Calls `add(half_edge, weight)` for each corner of
/// the face of `h`. The half-edge starts at the corner.
#[inline]
pub(crate) fn add_doo_sabin(mesh: &Mesh, h: HalfEdgeId, mut add: impl FnMut(HalfEdgeId, f64)) {
    let n = mesh.loop_half_edges(h).count();
    for (j, h) in mesh.loop_half_edges(h).enumerate() {
        add(h, doo_sabin_weight(n, j));
    }
}

/// For a Doo-Sabin point of a face with `n` corners, returns the weight of the `j`-th corner, counted from the corner
/// to which the point belongs.
#[inline]
fn doo_sabin_weight(n: usize, j: usize) -> f64 {
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
    fn the_weights_of_a_face_sum_to_one_and_halve_a_regular_polygon() {
        for n in 3..30 {
            let ring = |k: f64| -> f64 {
                let at = |j: usize| libm::cos(k * TAU * j as f64 / n as f64);
                (0..n).map(|j| doo_sabin_weight(n, j) * at(j)).sum()
            };
            assert!((ring(0.0) - 1.0).abs() < 1e-15, "{n}");
            assert!((ring(1.0) - 0.5).abs() < 1e-15, "{n}");
        }
    }
}
