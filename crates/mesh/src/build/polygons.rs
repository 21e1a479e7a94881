//! Stores the polygons from which a mesh is built, validates the polygons, and finds the neighbors of their corners.

use glam::DVec3;
use rayon::prelude::*;

use super::BuildError;
use crate::parallel::BLOCK;

/// Marks a missing corner.
pub(super) const NONE: u32 = u32::MAX;

/// Polygons as flat arrays: polygon f has the corners with the indices `offsets[f]..offsets[f + 1]`, and `corners`
/// contains the vertex of each corner.
///
/// A corner also represents the side of its polygon that starts at this corner.
pub(super) struct Polygons<'a> {
    pub(super) offsets: &'a [u32],
    pub(super) corners: &'a [u32],
    /// For each corner, its polygon. `None` if all polygons are triangles: then corner c belongs to triangle c / 3.
    face_of_corner: Option<Vec<u32>>,
}

impl<'a> Polygons<'a> {
    pub(super) fn new(offsets: &'a [u32], corners: &'a [u32]) -> Self {
        let triangles = corners.len() == 3 * (offsets.len() - 1)
            && offsets.par_windows(2).all(|w| w[1] - w[0] == 3);
        Self {
            offsets,
            corners,
            face_of_corner: (!triangles).then(|| faces_of_corners(offsets)),
        }
    }

    /// Returns the number of polygons.
    pub(super) fn n(&self) -> usize {
        self.offsets.len() - 1
    }

    #[inline]
    pub(super) fn face(&self, c: u32) -> u32 {
        match &self.face_of_corner {
            None => c / 3,
            Some(faces) => faces[c as usize],
        }
    }

    /// Returns the first corner of the polygon of `c`, and the corner after the last corner of that polygon.
    #[inline]
    fn corner_range(&self, c: u32) -> (u32, u32) {
        let f = self.face(c);
        match self.face_of_corner {
            None => (3 * f, 3 * f + 3),
            Some(_) => (self.offsets[f as usize], self.offsets[f as usize + 1]),
        }
    }

    #[inline]
    pub(super) fn next(&self, c: u32) -> u32 {
        self.prev_and_next(c).1
    }

    #[inline]
    pub(super) fn prev(&self, c: u32) -> u32 {
        self.prev_and_next(c).0
    }

    /// Returns the corners before and after `c` in its polygon.
    #[inline]
    pub(super) fn prev_and_next(&self, c: u32) -> (u32, u32) {
        let (first, end) = self.corner_range(c);
        let prev = if c == first { end - 1 } else { c - 1 };
        (prev, if c + 1 == end { first } else { c + 1 })
    }

    /// Returns the vertex of a corner, which is the origin of its side.
    #[inline]
    pub(super) fn origin(&self, c: u32) -> u32 {
        self.corners[c as usize]
    }
}

fn faces_of_corners(offsets: &[u32]) -> Vec<u32> {
    let mut face_of_corner = crate::zeroed(offsets[offsets.len() - 1] as usize);
    let blocks = offsets[1..].chunks(BLOCK).zip(offsets.chunks(BLOCK));
    let lengths = blocks.map(|(ends, firsts)| (ends[ends.len() - 1] - firsts[0]) as usize);
    pieces(&mut face_of_corner, lengths)
        .into_par_iter()
        .zip(offsets.par_chunks(BLOCK))
        .enumerate()
        .for_each(|(block, (faces, firsts))| {
            // The loop visits the polygons from last to first. The slots for the corners of each polygon are at the end
            // of the part that is not yet filled, and are split off from it.
            let mut unfilled = faces;
            for (i, first) in firsts.iter().enumerate().rev() {
                let Some(of_polygon) = unfilled.split_off_mut((first - firsts[0]) as usize..)
                else {
                    continue;
                };
                of_polygon.fill(to_id(block * BLOCK + i));
            }
        });
    face_of_corner
}

/// Splits a slice into consecutive pieces of these lengths, so that parallel tasks can fill them.
pub(super) fn pieces<T>(
    mut slice: &mut [T],
    lengths: impl IntoIterator<Item = usize>,
) -> Vec<&mut [T]> {
    let lengths = lengths.into_iter();
    lengths
        .map(|n| slice.split_off_mut(..n).expect("pieces of this slice"))
        .collect()
}

/// Returns, for each number, the sum of the numbers before it.
pub(super) fn sums_before(numbers: &[usize]) -> Vec<usize> {
    let sums = numbers.iter().scan(0, |sum, n| {
        *sum += n;
        Some(*sum - n)
    });
    sums.collect()
}

/// Converts polygons from lists to offsets and corners.
///
/// # Errors
///
/// Returns an error if there are too many corners.
pub(super) fn flatten(
    polygons: &[impl AsRef<[u32]> + Sync],
) -> Result<(Vec<u32>, Vec<u32>), BuildError> {
    let lengths: Vec<usize> = polygons
        .par_chunks(BLOCK)
        .map(|block| block.iter().map(|polygon| polygon.as_ref().len()).sum())
        .collect();
    let n_corners = lengths.iter().sum();
    to_u32(n_corners, "corners")?;
    let mut offsets = crate::zeroed(polygons.len() + 1);
    let mut corners = crate::zeroed(n_corners);
    let firsts = sums_before(&lengths);
    offsets[1..]
        .par_chunks_mut(BLOCK)
        .zip(pieces(&mut corners, lengths))
        .zip(polygons.par_chunks(BLOCK))
        .zip(firsts)
        .for_each(|(((ends, corners), polygons), first)| {
            let mut filled = 0;
            for (end, polygon) in ends.iter_mut().zip(polygons) {
                let polygon = polygon.as_ref();
                corners[filled..filled + polygon.len()].copy_from_slice(polygon);
                filled += polygon.len();
                *end = to_id(first + filled);
            }
        });
    Ok((offsets, corners))
}

/// Checks the input. Returns the degenerate polygons, which have fewer than three corners or contain a vertex twice.
///
/// # Errors
///
/// Returns [`BuildError`] for invalid input. Does not check that the polygons are a manifold.
pub(super) fn check(
    positions: &[DVec3],
    offsets: &[u32],
    corners: &[u32],
) -> Result<Vec<usize>, BuildError> {
    // In the worst case, each corner needs a separate edge and a separate copy of its vertex. Even then, all ids must
    // be below 2^32 - 1.
    to_u32(positions.len().saturating_add(corners.len()), "vertices")?;
    to_u32(corners.len().saturating_mul(2), "half-edges")?;
    let is_valid = offsets.first() == Some(&0)
        && offsets
            .last()
            .is_some_and(|&last| last as usize == corners.len())
        && offsets.is_sorted();
    if !is_valid {
        return Err(BuildError::BadOffsets(corners.len()));
    }
    if let Some(i) = first_of(positions, |p| !p.is_finite()) {
        return Err(BuildError::NotFinite(i));
    }
    let n_vertices = positions.len();
    if let Some(c) = first_of(corners, |&v| v as usize >= n_vertices) {
        let face = offsets.partition_point(|&offset| offset as usize <= c) - 1;
        return Err(BuildError::NoSuchVertex {
            face,
            vertex: corners[c],
            n_vertices,
        });
    }
    let degenerate = offsets[1..]
        .par_chunks(BLOCK)
        .zip(offsets.par_chunks(BLOCK))
        .enumerate()
        .map(|(block, (ends, firsts))| {
            let polygons = (block * BLOCK..).zip(firsts.iter().zip(ends));
            polygons
                .filter(|(_, (first, end))| {
                    is_degenerate(&corners[**first as usize..**end as usize])
                })
                .map(|(face, _)| face)
                .collect()
        });
    let degenerate: Vec<Vec<usize>> = degenerate.collect();
    Ok(degenerate.concat())
}

/// Returns the index of the first value for which `is_bad` holds. Tests the values block by block, which is
/// fast if no value is bad.
fn first_of<T: Sync>(values: &[T], is_bad: impl Fn(&T) -> bool + Sync) -> Option<usize> {
    let blocks = values.par_chunks(BLOCK);
    let has_bad = |block: &[T]| block.iter().fold(false, |bad, value| bad | is_bad(value));
    let block = blocks.position_first(has_bad)? * BLOCK;
    Some(block + values[block..].iter().position(is_bad)?)
}

/// Whether a polygon has fewer than three corners, or contains a vertex twice.
fn is_degenerate(polygon: &[u32]) -> bool {
    match polygon {
        [a, b, c] => a == b || b == c || c == a,
        _ if polygon.len() < 3 => true,
        _ if polygon.len() <= 16 => polygon
            .iter()
            .enumerate()
            .any(|(i, v)| polygon[..i].contains(v)),
        _ => {
            let mut sorted = polygon.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).any(|w| w[0] == w[1])
        }
    }
}

/// Converts a count of elements of this kind to `u32`.
///
/// # Errors
///
/// Returns [`BuildError::TooLarge`] if the count exceeds 2³² − 2, the highest id.
pub(super) fn to_u32(n: usize, kind: &'static str) -> Result<u32, BuildError> {
    u32::try_from(n)
        .ok()
        .filter(|&n| n < NONE)
        .ok_or(BuildError::TooLarge(n, kind))
}

/// Converts an index to `u32`. The number of elements must have been checked with [`to_u32`].
pub(super) fn to_id(n: usize) -> u32 {
    u32::try_from(n).expect("the number of elements was checked")
}
