//! Numbering the different values on the corners around vertices, for writers.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::parallel;
use mesh::{FaceId, HalfEdgeId, Mesh, VertexId};

/// Of more different values than this at a vertex only the latest are compared.
const LOOKED_AT: usize = 64;

/// The numbers of the different values on the corners around each vertex of a mesh, for all corners, in
/// the order of the faces and their corners.
#[derive(Debug)]
pub(crate) struct CornerNumbers {
    /// For each half-edge of a face the first one that leaves the same vertex with the same value.
    same: Vec<AtomicU32>,
    /// The numbers of half-edges that are the first with their value, from 0.
    numbers: Vec<AtomicU32>,
    /// For each number the half-edge that is the first.
    firsts: Vec<HalfEdgeId>,
}

impl CornerNumbers {
    /// Numbers values of which `equal` says whether those of two corners at one vertex are the same. Of a
    /// crowd at a vertex only the latest [`LOOKED_AT`] values are compared, so that a vertex with a million
    /// corners costs no more than others; a value may then get a second number.
    pub(crate) fn new(mesh: &Mesh, equal: impl Fn(HalfEdgeId, HalfEdgeId) -> bool + Sync) -> Self {
        // Each half-edge is written by the task of the one vertex that it leaves, or the one face that it
        // lies at.
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
                    let mut looked_at = different.iter().rev().take(LOOKED_AT);
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

    /// The number of the value of a corner, from 0.
    #[inline]
    pub(crate) fn number(&self, h: HalfEdgeId) -> usize {
        let first = self.same[h.index()].load(Relaxed);
        self.numbers[first as usize].load(Relaxed) as usize
    }

    /// For each number a corner that has the value.
    pub(crate) fn firsts(&self) -> &[HalfEdgeId] {
        &self.firsts
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn values_are_numbered_in_the_order_in_which_the_corners_name_them() {
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
    fn a_crowd_at_one_place_takes_no_quadratic_time() {
        let n = 200_000;
        let fan: Vec<[u32; 3]> = (1..n).map(|i| [0, i, i + 1]).collect();
        let points = (0..=n).map(|i| mesh::DVec3::splat(f64::from(i)));
        let (mesh, _) = Mesh::from_polygons(points.collect(), &fan).unwrap();
        let numbers = CornerNumbers::new(&mesh, |a, b| a == b);
        assert_eq!(numbers.firsts().len(), 3 * fan.len());
    }
}
