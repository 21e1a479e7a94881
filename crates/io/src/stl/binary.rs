//! Reads binary STL files, which consist of a header of 80 bytes, the number of triangles, and 50 bytes for each
//! triangle.

use glam::{DVec3, Vec3};
use mesh::zeroed;

use super::facets::{Facets, compare};
use crate::fault::Fault;
use crate::peek::differ;
use mesh::parallel::{self, BLOCK};

pub(super) const HEADER: usize = 80;
/// The position at which the triangles begin, after the header and the 4 bytes with the number of triangles.
pub(super) const START: usize = HEADER + 4;
/// The size of a triangle in bytes. A triangle consists of a normal and three corners, each with three 32-bit numbers,
/// and of 2 attribute bytes.
pub(super) const FACET: usize = 50;
/// Returns the number of triangles that the file declares. Returns `None` if the file ends before this number.
pub(super) fn count(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER..)?.first_chunk()?;
    Some(u32::from_le_bytes(*count))
}

/// Returns the size that a file with the declared number of triangles has.
pub(super) fn length(bytes: &[u8]) -> Option<u64> {
    count(bytes).map(|n| START as u64 + FACET as u64 * u64::from(n))
}

/// Reads the corners of all facets.
///
/// # Errors
///
/// Returns an error for the first corner coordinate that is not finite.
pub(super) fn read(facets: &[u8]) -> Result<Facets<Vec3>, Fault> {
    let n = facets.len() / FACET;
    let mut corners = zeroed::<Vec3>(3 * n);
    let parts = corners
        .chunks_mut(3 * BLOCK)
        .zip(facets.chunks(BLOCK * FACET));
    let blocks = parallel::consume(parts, |_, (corners, facets)| {
        let mut sides = [0; 3];
        let mut colored = 0;
        let mut finite = true;
        for (corners, facet) in corners.chunks_exact_mut(3).zip(facets.chunks_exact(FACET)) {
            let numbers: [f32; 12] = std::array::from_fn(|i| number(facet, i));
            let [normal, a, b, c] = std::array::from_fn(|i| vector(&numbers, 3 * i));
            corners.copy_from_slice(&[a, b, c]);
            finite &= a.is_finite() & b.is_finite() & c.is_finite();
            sides[compare(normal.into(), [a, b, c].map(DVec3::from)) as usize] += 1;
            colored += usize::from(facet[48..] != [0, 0]);
        }
        (sides, colored, finite)
    });
    if let Some(block) = blocks.iter().position(|&(_, _, finite)| !finite) {
        let first = block * BLOCK * FACET;
        for (i, facet) in facets[first..].chunks_exact(FACET).enumerate() {
            if let Some(k) = (3..12).find(|&k| !number(facet, k).is_finite()) {
                let found = number(facet, k);
                let message = format!("expected a finite number, found {found}");
                return Err(Fault::byte(START + first + i * FACET + 4 * k, message));
            }
        }
    }
    let mut found = Facets {
        corners,
        ..Facets::default()
    };
    for (sides, colored, _) in blocks {
        for (all, n) in found.sides.iter_mut().zip(sides) {
            *all += n;
        }
        found.colored += colored;
    }
    Ok(found)
}

/// The number of facets whose corners are at three different points.
pub(super) fn n_simple(facets: &[u8]) -> usize {
    let n = facets.len() / FACET;
    parallel::count(n, |i| {
        let facet = &facets[FACET * i..FACET * (i + 1)];
        let numbers: [f32; 12] = std::array::from_fn(|i| number(facet, i));
        let corners: [Vec3; 3] = std::array::from_fn(|i| vector(&numbers, 3 + 3 * i));
        differ(&corners)
    })
}

/// The number of facets with attribute bytes other than 0.
pub(super) fn n_colored(facets: &[u8]) -> usize {
    let n = facets.len() / FACET;
    parallel::count(n, |i| facets[FACET * i + 48..FACET * (i + 1)] != [0, 0])
}

#[inline]
fn number(facet: &[u8], i: usize) -> f32 {
    let bytes = facet[4 * i..].first_chunk();
    f32::from_le_bytes(*bytes.expect("a facet has 12 numbers"))
}

#[inline]
fn vector(numbers: &[f32; 12], i: usize) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|k| numbers[i + k]))
}
