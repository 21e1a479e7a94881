//! Merges vertices with exactly equal positions.

use std::cmp::Ordering;

use geometry::first_equal;
use glam::DVec3;
use mesh::{Attributes, Domain, Mesh, Values, VertexId};
use rayon::prelude::*;

use crate::file_vertices::FileVertices;
use crate::polygons::gather;
use mesh::parallel;

/// The number of positions in a chunk. Each chunk is processed by one task.
const CHUNK: usize = 1 << 15;

/// A position with coordinates of 32 or 64 bits.
pub(crate) trait Position: Copy + Into<DVec3> + Send + Sync {}

impl<P: Copy + Into<DVec3> + Send + Sync> Position for P {}

/// Counts the vertices that a reader of the written file would merge with an earlier vertex. Use this function only for
/// formats whose reader merges vertices with equal positions. Vertices without a face are not counted, because they are
/// not written. Positions are compared after they are rounded to 32 bits.
pub(crate) fn n_merged(mesh: &Mesh) -> usize {
    n_merged_as(mesh, DVec3::as_vec3)
}

/// Like [`n_merged`], but the function `round` rounds the positions.
pub(crate) fn n_merged_as<P: Position>(mesh: &Mesh, round: impl Fn(DVec3) -> P + Sync) -> usize {
    let used = vertices_with_faces(mesh);
    let places = parallel::collect(used.len(), |i| round(mesh.position(VertexId::new(used[i]))));
    let first = first_equal(&places);
    parallel::count(first.len(), |i| first[i] as usize != i)
}

/// Returns the vertices that belong to at least one face. Copies that a reader made by splitting vertices are left out.
fn vertices_with_faces(mesh: &Mesh) -> Vec<usize> {
    let file = FileVertices::of(mesh);
    parallel::filter(mesh.n_vertices(), |v| {
        let v = VertexId::new(v);
        mesh.vertex_half_edge(v).is_some() && !file.is_copy(v)
    })
}

/// Like [`n_merged`], but for formats whose reader also compares other values: it merges two vertices only if their
/// positions are equal and `compare` returns `Equal`.
pub(crate) fn n_merged_if_equal(
    mesh: &Mesh,
    compare: impl Fn(usize, usize) -> Ordering + Sync,
) -> usize {
    let used = vertices_with_faces(mesh);
    let rounded = |i: usize| mesh.position(VertexId::new(used[i])).as_vec3();
    let (unique, vertex_of) = weld(&parallel::collect(used.len(), rounded));
    if unique.len() == used.len() {
        return 0;
    }
    let (firsts, _) = split_unequal(&vertex_of, |a, b| compare(used[a], used[b]));
    used.len() - firsts.len()
}

/// Returns the distinct positions in order of first occurrence, and for each given position, its index in this list. 0
/// and -0 are equal. There must be fewer than 2^32 - 1 positions. The returned positions have 64-bit numbers.
pub(crate) fn weld<P: Position>(positions: &[P]) -> (Vec<DVec3>, Vec<u32>) {
    let mut vertex_of = first_equal(positions);
    let is_first = |i: usize, first: u32| i == first as usize;
    // For each chunk, the number of its positions that do not occur earlier in the whole list.
    let counts = parallel::consume(vertex_of.chunks(CHUNK), |chunk, firsts| {
        let own = (chunk * CHUNK..).zip(firsts);
        own.filter(|&(i, &first)| is_first(i, first)).count()
    });
    let n_unique = counts.iter().sum();
    if n_unique == positions.len() {
        let all = parallel::collect(n_unique, |i| positions[i].into());
        return (all, vertex_of);
    }
    let mut unique = mesh::zeroed::<DVec3>(n_unique);
    let mut numbers = mesh::zeroed::<u32>(positions.len());
    let mut before = 0;
    let ends = counts.iter().map(|count| {
        before += count;
        before
    });
    let ends: Vec<usize> = ends.collect();
    let parts = parallel::split_at_ends(&mut unique, ends.iter().copied());
    parallel::consume(
        parts.into_iter().zip(numbers.chunks_mut(CHUNK)),
        |chunk, (unique, numbers)| {
            let before = ends[chunk] - unique.len();
            let mut k = 0;
            for (i, number) in (chunk * CHUNK..).zip(numbers) {
                if is_first(i, vertex_of[i]) {
                    unique[k] = positions[i].into();
                    *number = index(before + k);
                    k += 1;
                }
            }
        },
    );
    parallel::change(&mut vertex_of, |first| *first = numbers[*first as usize]);
    (unique, vertex_of)
}

/// Like [`weld`], but merges two vertices only if their values of all vertex attributes are also equal. These
/// attributes are joint weights and deltas of morph targets. Removes the attribute values of the merged vertices.
pub(crate) fn weld_equal(
    positions: &[DVec3],
    attributes: &mut Attributes,
) -> (Vec<DVec3>, Vec<u32>) {
    let (welded, vertex_of) = weld(positions);
    if welded.len() == positions.len() {
        return (welded, vertex_of);
    }
    let columns = attributes.of(Domain::Vertex);
    let compare = |a: usize, b: usize| {
        let orders = columns.iter().map(|column| match &column.values {
            Values::Float(values) => values[a].partial_cmp(&values[b]),
            Values::Vec3(values) => values[a].to_array().partial_cmp(&values[b].to_array()),
            _ => None,
        });
        let mut orders = orders.flatten();
        orders
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    };
    let (firsts, vertex_of) = split_unequal(&vertex_of, compare);
    gather(attributes, Domain::Vertex, &firsts);
    let positions = firsts.iter().map(|&v| positions[v as usize]);
    (positions.collect(), vertex_of)
}

/// Divides elements into groups. Two elements are in the same group if they have the same class and `compare` returns
/// `Equal`. `classes` contains the class of each element. Returns the first element of each group, in ascending order,
/// and for each element, the index of its group.
pub(crate) fn split_unequal(
    classes: &[u32],
    compare: impl Fn(usize, usize) -> Ordering + Sync,
) -> (Vec<u32>, Vec<u32>) {
    let n = u32::try_from(classes.len()).unwrap_or(u32::MAX);
    let mut order: Vec<u32> = (0..n).collect();
    let class = |v: u32| classes[v as usize];
    let compare = |a: u32, b: u32| {
        let by_class = class(a).cmp(&class(b));
        by_class.then_with(|| compare(a as usize, b as usize))
    };
    order.par_sort_unstable_by(|&a, &b| compare(a, b).then(a.cmp(&b)));
    let mut first_of = vec![0; classes.len()];
    let mut first = 0;
    for (i, &v) in order.iter().enumerate() {
        if i == 0 || compare(order[i - 1], v).is_ne() {
            first = v;
        }
        first_of[v as usize] = first;
    }
    let mut numbers = vec![0; classes.len()];
    let mut firsts = Vec::new();
    for (v, &first) in (0..n).zip(&first_of) {
        if first == v {
            numbers[v as usize] = index(firsts.len());
            firsts.push(v);
        }
    }
    let vertex_of = first_of.iter().map(|&first| numbers[first as usize]);
    (firsts, vertex_of.collect())
}

/// Converts `i`, which is less than 2^32, to 32 bits.
fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use proptest::prelude::*;

    use super::*;

    /// A simple implementation with the standard library, for comparison.
    fn slow(positions: &[DVec3]) -> (Vec<DVec3>, Vec<u32>) {
        let mut numbers = HashMap::new();
        let mut unique = Vec::new();
        let number = |&p: &DVec3| {
            let bits = p.to_array().map(|x| (x + 0.0).to_bits());
            *numbers.entry(bits).or_insert_with(|| {
                unique.push(p);
                index(unique.len() - 1)
            })
        };
        let vertex_of = positions.iter().map(number).collect();
        (unique, vertex_of)
    }

    #[test]
    fn the_first_of_equal_positions_represents_them() {
        let (a, b) = (DVec3::new(0.0, 1.0, 2.0), DVec3::new(-0.0, 1.0, 2.0));
        let (unique, vertex_of) = weld(&[DVec3::ONE, b, a, DVec3::ONE, DVec3::ZERO]);
        assert_eq!(vertex_of, [0, 1, 1, 0, 2]);
        assert!(unique[1].x.is_sign_negative() && unique.len() == 3);
        assert_eq!(weld::<DVec3>(&[]), (Vec::new(), Vec::new()));
    }

    #[test]
    fn large_arrays_are_welded_as_the_simple_implementation_does() {
        for (n, period) in [(200_000, 70_000), (100_000, 100_000), (150_000, 1)] {
            let positions: Vec<_> = (0..n)
                .map(|i| DVec3::new(f64::from(i % period), f64::from(i % period % 7), 0.5))
                .collect();
            assert!(weld(&positions) == slow(&positions));
        }
    }

    proptest! {
        #[test]
        fn random_positions_are_welded_as_the_simple_implementation_does(
            numbers in prop::collection::vec([-2..3_i8, -2..3, -2..3], 0..300),
        ) {
            let positions: Vec<_> = numbers
                .iter()
                .map(|p| DVec3::from_array(p.map(|x| f64::from(x) * 0.5)))
                .collect();
            prop_assert_eq!(weld(&positions), slow(&positions));
        }
    }
}
