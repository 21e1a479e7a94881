//! Which triangles and lines touch which tile of the picture.
//!
//! Triangles and lines are taken in chunks, each sorted into tiles by one task with a counting sort. A tile reads its
//! lists chunk after chunk. The lists are bounded: where most things touch many tiles, those are not listed in each of
//! them.

use std::ops::Range;

use rayon::prelude::*;

use super::lines::{FlatLine, limits};
use super::project::{Corner, Flat, GRID, GRID_BITS, clipped, project};
use super::{Frame, LINED, SORTED, TILE};
use crate::color::whole_u32;
use crate::drawing::Drawing;
use crate::work::Work;
use crate::{PictureError, View};

/// At most so many chunks, and one more for each part, because each has a number for every tile.
const MOST_CHUNKS: usize = 32;
/// At least so many things in a chunk, unless a part has less.
const LEAST_CHUNK: usize = 1 << 15;
/// What touches more tiles than this is not listed in each of them, but looked at in all.
const MANY_TILES: usize = 64;
/// A list has so many entries for each thing at most, and some more.
const MOST_ENTRIES: usize = 8;
const MORE_ENTRIES: usize = 4096;
/// Marks an entry of a list that means a cut triangle.
const CUT: u32 = 1 << 31;

/// Things in order of the tiles that they touch.
pub(super) struct Sorted {
    /// Where the things of each tile begin in `items`, and the end.
    starts: Vec<u32>,
    items: Vec<u32>,
    /// Those that touch many tiles.
    large: Vec<u32>,
}

/// A rectangle of tiles: left, top, and behind right and bottom.
pub(super) type TileRect = [u32; 4];

/// How many tiles a rectangle has.
fn n_tiles([left, top, right, bottom]: TileRect) -> usize {
    (right - left) as usize * (bottom - top) as usize
}

/// So many tiles may be touched by what is listed in all of them, for lists that are not too long.
fn most_tiles(things: &[(u32, TileRect)]) -> usize {
    let mut entries = [0; MANY_TILES + 1];
    for &(_, rect) in things {
        let n = n_tiles(rect);
        if n <= MANY_TILES {
            entries[n] += n;
        }
    }
    let room = MOST_ENTRIES * things.len() + MORE_ENTRIES;
    let mut sum = 0;
    let fits = |n: &usize| {
        sum += entries[*n];
        sum <= room
    };
    (0..=MANY_TILES).take_while(fits).last().unwrap_or(0)
}

/// The chunks of `n` things of `all`.
fn chunks(n: usize, all: usize) -> impl Iterator<Item = Range<usize>> {
    let size = all.div_ceil(MOST_CHUNKS).max(LEAST_CHUNK);
    (0..n)
        .step_by(size)
        .map(move |first| first..(first + size).min(n))
}

/// The bytes that lists take at most, and what they take while they are made: for groups of so many things, which are
/// not in one chunk.
pub(super) fn bytes(groups: impl Iterator<Item = usize> + Clone, frame: &Frame) -> u64 {
    let all: usize = groups.clone().sum();
    let n_chunks: usize = groups.map(|n| chunks(n, all).count()).sum();
    let lists = 4 * ((MOST_ENTRIES + 1) * all + (MORE_ENTRIES + frame.n_tiles() + 1) * n_chunks);
    let in_work = n_chunks.min(rayon::current_num_threads());
    let longest = chunks(all, all).map(|chunk| chunk.len()).max().unwrap_or(0);
    let while_made = size_of::<(u32, TileRect)>() * longest + 4 * (frame.n_tiles() + 1);
    (lists + in_work * while_made) as u64
}

impl Sorted {
    /// Sorts things by their tiles.
    fn new(frame: &Frame, things: &[(u32, TileRect)]) -> Self {
        let most = most_tiles(things);
        let n_large = things.iter().filter(|t| n_tiles(t.1) > most).count();
        let mut large = Vec::with_capacity(n_large);
        let tiles = |[left, top, right, bottom]: TileRect| {
            (top..bottom)
                .flat_map(move |row| (left..right).map(move |c| row * frame.columns + c))
                .map(|tile| tile as usize)
        };
        let mut starts = vec![0_u32; frame.n_tiles() + 1];
        for &(item, rect) in things {
            if n_tiles(rect) > most {
                large.push(item);
                continue;
            }
            for tile in tiles(rect) {
                starts[tile + 1] += 1;
            }
        }
        for i in 0..frame.n_tiles() {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut items = vec![0; starts[frame.n_tiles()] as usize];
        for &(item, rect) in things.iter().filter(|t| n_tiles(t.1) <= most) {
            for tile in tiles(rect) {
                let place = &mut next[tile];
                items[*place as usize] = item;
                *place += 1;
            }
        }
        Self {
            starts,
            items,
            large,
        }
    }

    /// What touches a tile: first what touches many, then the others, each in their order.
    fn of(&self, tile: usize) -> impl Iterator<Item = u32> {
        let range = self.starts[tile] as usize..self.starts[tile + 1] as usize;
        self.large.iter().chain(&self.items[range]).copied()
    }
}

/// Triangles by tiles.
pub(super) struct Triangles {
    /// Where each part has its points.
    points: Vec<Vec<Corner>>,
    chunks: Vec<Chunk>,
}

/// Some triangles of one part.
struct Chunk {
    part: usize,
    /// The first triangle in its part, and over all parts.
    first: usize,
    first_of_all: u32,
    sorted: Sorted,
    /// What is left of triangles that were cut, with their places in the chunk.
    cut: Vec<(u32, Flat)>,
}

impl Triangles {
    /// Sorts all triangles of a drawing.
    pub(super) fn new(
        drawing: &Drawing,
        view: &View,
        frame: &Frame,
        work: &Work,
    ) -> Result<Self, PictureError> {
        let parts = drawing.parts.iter();
        let points: Vec<_> = parts.map(|p| project(view, &p.points)).collect();
        let mut ranges = Vec::new();
        let mut first_of_all = 0_u32;
        for (part, p) in drawing.parts.iter().enumerate() {
            for range in chunks(p.triangles.len(), drawing.n_triangles()) {
                let n = u32::try_from(range.len()).unwrap_or(u32::MAX);
                ranges.push((part, range, first_of_all));
                first_of_all = first_of_all.saturating_add(n);
            }
        }
        let chunks = ranges
            .into_par_iter()
            .map(|(part, range, first_of_all)| {
                let p = &drawing.parts[part];
                let mut cut = Vec::new();
                let mut rects = Vec::with_capacity(range.len());
                for (i, triangle) in (0..).zip(&p.triangles[range.clone()]) {
                    let flat = triangle.map(|v| points[part][v as usize]);
                    if flat.iter().any(|c| c.is_outside()) {
                        for flat in clipped(view, p.corners_at(range.start + i as usize)) {
                            if let Some(rect) = touched(&flat, frame) {
                                let place = u32::try_from(cut.len()).unwrap_or(u32::MAX);
                                rects.push((place | CUT, rect));
                                cut.push((i, flat));
                            }
                        }
                    } else if let Some(rect) = touched(&flat, frame) {
                        rects.push((i, rect));
                    }
                }
                let sorted = Sorted::new(frame, &rects);
                work.add(SORTED * range.len() as u64)?;
                Ok(Chunk {
                    part,
                    first: range.start,
                    first_of_all,
                    sorted,
                    cut,
                })
            })
            .collect::<Result<_, PictureError>>()?;
        Ok(Self { points, chunks })
    }

    /// Calls `each` with the triangles that touch a tile: the number over all parts, and the place.
    pub(super) fn of(&self, drawing: &Drawing, tile: usize, mut each: impl FnMut(u32, &Flat)) {
        for chunk in &self.chunks {
            let part = &drawing.parts[chunk.part];
            for item in chunk.sorted.of(tile) {
                if item & CUT == 0 {
                    let triangle = part.triangles[chunk.first + item as usize];
                    let flat = triangle.map(|v| self.points[chunk.part][v as usize]);
                    each(chunk.first_of_all + item, &flat);
                } else {
                    let (place, flat) = &chunk.cut[(item ^ CUT) as usize];
                    each(chunk.first_of_all + place, flat);
                }
            }
        }
    }
}

/// The tiles that a triangle touches; `None` if it has no sample.
fn touched(flat: &Flat, frame: &Frame) -> Option<TileRect> {
    let of = |axis: usize, end: u32| {
        let [a, b, c] = flat.map(|corner| corner.at[axis]);
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        // Samples lie on the middles of 16 rows and columns of a pixel.
        let step = GRID / 16;
        let first = (min + step / 2 - 1).div_euclid(step);
        let last = (max - step / 2).div_euclid(step);
        if first > last || max < 0 {
            return None;
        }
        let low = u32::try_from((min >> GRID_BITS).max(0)).ok()?;
        let high = u32::try_from(max >> GRID_BITS).ok()?.min(end - 1);
        (low <= high).then_some([low / TILE, high / TILE + 1])
    };
    let [left, right] = of(0, frame.width)?;
    let [top, bottom] = of(1, frame.height)?;
    Some([left, top, right, bottom])
}

/// Lines by tiles.
pub(super) struct Lines {
    flat: Vec<Option<FlatLine>>,
    chunks: Vec<(u32, Sorted)>,
}

impl Lines {
    /// Sorts lines by their boxes.
    pub(super) fn new(
        flat: Vec<Option<FlatLine>>,
        frame: &Frame,
        work: &Work,
    ) -> Result<Self, PictureError> {
        let ranges: Vec<_> = chunks(flat.len(), flat.len()).collect();
        let chunks = ranges
            .into_par_iter()
            .map(|range| {
                let mut rects = Vec::with_capacity(range.len());
                for (i, line) in (0..).zip(&flat[range.clone()]) {
                    let rect = line.as_ref().and_then(|line| around(limits(line), frame));
                    rects.extend(rect.map(|rect| (i, rect)));
                }
                work.add(LINED * range.len() as u64)?;
                let first = u32::try_from(range.start).unwrap_or(u32::MAX);
                Ok((first, Sorted::new(frame, &rects)))
            })
            .collect::<Result<_, PictureError>>()?;
        Ok(Self { flat, chunks })
    }

    /// The lines that may touch a tile, in their order, with their numbers.
    pub(super) fn of(&self, tile: usize) -> impl Iterator<Item = (u32, &FlatLine)> {
        let mut lines: Vec<u32> = Vec::new();
        for (first, sorted) in &self.chunks {
            lines.extend(sorted.of(tile).map(|line| first + line));
        }
        lines.sort_unstable();
        let flat = |line: u32| Some((line, self.flat[line as usize].as_ref()?));
        lines.into_iter().filter_map(flat)
    }
}

/// The tiles that a box touches, in pixels: left, top, right and bottom.
fn around([left, top, right, bottom]: [f64; 4], frame: &Frame) -> Option<TileRect> {
    let (w, h) = (f64::from(frame.width), f64::from(frame.height));
    if right < 0.0 || bottom < 0.0 || left >= w || top >= h {
        return None;
    }
    let tile = |x: f64, end: f64| whole_u32(x.clamp(0.0, end - 1.0)) / TILE;
    let end = [tile(right, w) + 1, tile(bottom, h) + 1];
    Some([tile(left, w), tile(top, h), end[0], end[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_bounded_and_have_everything() {
        let frame = Frame::new([640, 640]);
        for side in [1, 3, 8, 9, 20] {
            // Squares of tiles, all over the picture.
            let things: Vec<(u32, TileRect)> = (0..5000)
                .map(|i| {
                    let (left, top) = (i % (21 - side), i / 20 % (21 - side));
                    (i, [left, top, left + side, top + side])
                })
                .collect();
            let sorted = Sorted::new(&frame, &things);
            assert!(sorted.items.len() <= MOST_ENTRIES * things.len() + MORE_ENTRIES);
            for tile in 0..frame.n_tiles() {
                let [x, y] = [tile % 20, tile / 20].map(|i| u32::try_from(i).unwrap());
                let found: Vec<u32> = sorted.of(tile).collect();
                for &(item, [left, top, right, bottom]) in &things {
                    if (left..right).contains(&x) && (top..bottom).contains(&y) {
                        assert!(found.contains(&item), "{side}, {tile}");
                    }
                }
            }
        }
    }
}
