//! Assigns numbers to the distinct values on the corners around each vertex. Writers use these numbers, for example, as
//! indices of normals in OBJ files.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use mesh::parallel;
use mesh::{FaceId, HalfEdgeId, Mesh, Values, VertexId};

/// The value of a corner is compared with at most this number of distinct values at the same vertex.
const MAX_COMPARED: usize = 64;

/// For each corner of a mesh, a number that stands for the value of the corner. Two corners have the same number if
/// they belong to the same vertex and have the same value. The numbers start at 0 and are assigned in the order of the
/// faces and their corners.
#[derive(Debug)]
pub(crate) struct CornerNumbers {
    /// For each half-edge of a face, the first half-edge that starts at the same vertex and has the same value.
    same: Vec<AtomicU32>,
    /// The number of each value, stored at the first half-edge that has this value at its vertex. Numbers start at 0.
    numbers: Vec<AtomicU32>,
    /// For each number, the first half-edge whose value has this number.
    firsts: Vec<HalfEdgeId>,
}

impl CornerNumbers {
    /// Assigns numbers to the values of corners. `equal` returns whether two corners of one vertex have the same value.
    /// A corner is compared only with the latest [`MAX_COMPARED`] distinct values at its vertex. This limit keeps the
    /// total time linear in the number of corners, even if one vertex has a million corners. If a vertex has more
    /// distinct values than this limit, the same value can get two different numbers.
    pub(crate) fn new(mesh: &Mesh, equal: impl Fn(HalfEdgeId, HalfEdgeId) -> bool + Sync) -> Self {
        // Relaxed stores are sufficient, because only one task writes each entry. The entry of a half-edge in `same` is
        // written by the task for its first vertex. An entry of `numbers` is written by the task for the number that is
        // stored there.
        let unset = || -> Vec<AtomicU32> { mesh::zeroed(mesh.n_half_edges()) };
        let (same, numbers) = (unset(), unset());
        let number_of = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
        parallel::blocks(mesh.n_vertices(), |vertices| {
            let (mut corners, mut different) = (Vec::new(), Vec::new());
            for v in vertices {
                let around = mesh.vertex_half_edges(VertexId::new(v));
                corners.clear();
                corners.extend(around.filter_map(|h| mesh.face(h).map(|f| (f, h))));
                corners.sort_unstable();
                different.clear();
                for &(_, h) in &corners {
                    let mut looked_at = different.iter().rev().take(MAX_COMPARED);
                    let known = looked_at.find(|&&known| equal(known, h)).copied();
                    if known.is_none() {
                        different.push(h);
                    }
                    let first = known.unwrap_or(h);
                    same[h.index()].store(number_of(first.index()), Relaxed);
                }
            }
        });
        let firsts = parallel::blocks(mesh.n_faces(), |faces| {
            let corners = faces.flat_map(|f| mesh.face_half_edges(FaceId::new(f)));
            let is_first = |h: &HalfEdgeId| same[h.index()].load(Relaxed) as usize == h.index();
            corners.filter(is_first).collect::<Vec<_>>()
        });
        let firsts = firsts.concat();
        parallel::blocks(firsts.len(), |block| {
            for number in block {
                numbers[firsts[number].index()].store(number_of(number), Relaxed);
            }
        });
        Self {
            same,
            numbers,
            firsts,
        }
    }

    /// The number that was assigned to the value at a corner. Numbers start at 0.
    #[inline]
    pub(crate) fn number(&self, h: HalfEdgeId) -> usize {
        let first = self.same[h.index()].load(Relaxed);
        self.numbers[first as usize].load(Relaxed) as usize
    }

    /// Returns, for each number, the first corner whose value has this number.
    pub(crate) fn firsts(&self) -> &[HalfEdgeId] {
        &self.firsts
    }
}

/// Converts values of corners to values of vertices. Returns `None` if `same` returns false for two corners of a
/// vertex. A vertex without a corner gets zero.
pub(crate) fn vertex_values(
    mesh: &Mesh,
    values: &Values,
    same: impl Fn(usize, usize) -> bool + Sync,
) -> Option<Values> {
    let corners = |v: usize| {
        mesh.vertex_half_edges(VertexId::new(v))
            .filter(|&h| mesh.face(h).is_some())
            .map(HalfEdgeId::index)
    };
    let agree = parallel::all(mesh.n_vertices(), |v| {
        let mut corners = corners(v);
        let first = corners.next();
        first.is_none_or(|first| corners.all(|h| same(first, h)))
    });
    agree.then(|| values.gather(mesh.n_vertices(), |v| corners(v).next()))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn values_are_numbered_in_the_order_of_the_corners() {
        let mesh = geometry::shapes::fans(&geometry::shapes::torus(80, 60, 2.0, 0.5));
        let value = |h: HalfEdgeId| h.index() * 7919 % 5;
        let numbers = CornerNumbers::new(&mesh, |a, b| value(a) == value(b));
        let mut known = BTreeMap::new();
        let mut firsts = Vec::new();
        for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
            let number = *known.entry((mesh.origin(h), value(h))).or_insert_with(|| {
                firsts.push(h);
                firsts.len() - 1
            });
            assert_eq!(numbers.number(h), number);
        }
        assert!(mesh.n_faces() > 2 * parallel::BLOCK);
        assert_eq!(numbers.firsts(), firsts);
    }

    #[test]
    fn many_values_at_one_vertex_take_linear_time() {
        let n = 200_000;
        let fan: Vec<[u32; 3]> = (1..n).map(|i| [0, i, i + 1]).collect();
        let points = (0..=n).map(|i| mesh::DVec3::splat(f64::from(i)));
        let (mesh, _) = Mesh::from_polygons(points.collect(), &fan).unwrap();
        let numbers = CornerNumbers::new(&mesh, |a, b| a == b);
        assert_eq!(numbers.firsts().len(), 3 * fan.len());
    }
}
