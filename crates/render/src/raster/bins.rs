//! Assigns triangles and lines to tiles of the picture: to all tiles that their bounding boxes touch.
//!
//! The triangles and lines are called items. The items are divided into chunks. For each chunk, one task makes a list
//! of items for each tile, with a counting sort. The lists of a tile are read chunk by chunk. The size of the lists is
//! bounded, because items that touch many tiles are in one list that all tiles read.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::lines::{ProjectedLine, limits};
use super::project::{GRID, GRID_BITS, GridPoint, ProjectedTriangle, clipped, project};
use super::{BIN_LINE_COST, BIN_TRIANGLE_COST, Frame, TILE};
use crate::color::whole_u32;
use crate::drawing::{Drawing, Part};
use crate::work::Work;
use crate::{PictureError, View};

/// The maximum number of chunks, not counting the incomplete last chunk of each part. The number of chunks is limited
/// because each chunk stores a number for every tile.
const MAX_CHUNKS: usize = 32;
/// The minimum number of items in a chunk. The last chunk of a part can have fewer items than this minimum.
const MIN_CHUNK: usize = 1 << 15;
/// If an item touches more tiles than this number, it is always in the list that all tiles read.
const MAX_LISTED_TILES: usize = 64;
/// If a chunk has n items, its lists have at most `ENTRIES_PER_ITEM` * n + `EXTRA_ENTRIES` entries in total.
const ENTRIES_PER_ITEM: usize = 8;
/// The constant in the formula for the maximum number of entries; see `ENTRIES_PER_ITEM`.
const EXTRA_ENTRIES: usize = 4096;
/// This bit is set in each list entry for a clipped triangle.
const CLIPPED: u32 = 1 << 31;

/// Items sorted by the tiles that they touch.
pub(super) struct Bins {
    /// For each tile, the index of its first item in `items`. The last entry is the length of `items`.
    starts: Vec<u32>,
    items: Vec<u32>,
    /// The items that touch many tiles.
    large: Vec<u32>,
}

/// A rectangle of tiles: left, top, right and bottom. Right and bottom are exclusive.
pub(super) type TileRect = [u32; 4];

fn n_tiles([left, top, right, bottom]: TileRect) -> usize {
    (right - left) as usize * (bottom - top) as usize
}

/// Returns a number n. An item that touches at most n tiles is put in the list of each of these tiles. To bound the
/// size of these lists, an item that touches more than n tiles is put in the list that all tiles read.
fn max_listed_tiles(items: &[(u32, TileRect)]) -> usize {
    let mut entries = [0; MAX_LISTED_TILES + 1];
    for &(_, rect) in items {
        let n = n_tiles(rect);
        if n <= MAX_LISTED_TILES {
            entries[n] += n;
        }
    }
    let limit = ENTRIES_PER_ITEM * items.len() + EXTRA_ENTRIES;
    let mut sum = 0;
    let fits = |n: &usize| {
        sum += entries[*n];
        sum <= limit
    };
    (0..=MAX_LISTED_TILES).take_while(fits).last().unwrap_or(0)
}

/// Divides a part with `n` items into chunks. `all` is the number of items of all parts.
fn chunks(n: usize, all: usize) -> impl Iterator<Item = Range<usize>> {
    let size = all.div_ceil(MAX_CHUNKS).max(MIN_CHUNK);
    (0..n)
        .step_by(size)
        .map(move |first| first..(first + size).min(n))
}

/// Returns the maximum number of bytes that the lists take, including the temporary memory of sorting. The triangles of
/// each part form a group, or all lines form one group. `groups` has the number of items of each group. All items of a
/// chunk belong to the same group.
pub(super) fn bytes(groups: impl Iterator<Item = usize> + Clone, frame: &Frame) -> u64 {
    let all: usize = groups.clone().sum();
    let n_chunks: usize = groups.map(|n| chunks(n, all).count()).sum();
    let lists =
        4 * ((ENTRIES_PER_ITEM + 1) * all + (EXTRA_ENTRIES + frame.n_tiles() + 1) * n_chunks);
    let n_tasks = n_chunks.min(rayon::current_num_threads());
    let longest = chunks(all, all).map(|chunk| chunk.len()).max().unwrap_or(0);
    let temporary = size_of::<(u32, TileRect)>() * longest + 4 * (frame.n_tiles() + 1);
    (lists + n_tasks * temporary) as u64
}

/// Returns the maximum number of bytes for the pieces of clipped triangles and for the lists of pieces. The temporary
/// memory of sorting is included.
pub(super) fn clipped_bytes(drawing: &Drawing, view: &View) -> u64 {
    let n_pieces: u64 = drawing.parts.iter().map(|part| n_pieces(part, view)).sum();
    // While a vector grows, its old and its new memory together take up to three times the memory of its elements.
    let vectors = 3 * (size_of::<(u32, ProjectedTriangle)>() + size_of::<(u32, TileRect)>());
    n_pieces * (vectors + 4 * (ENTRIES_PER_ITEM + 1)) as u64
}

/// Returns the number of pieces of the clipped triangles of a part.
fn n_pieces(part: &Part, view: &View) -> u64 {
    let is_outside = |p: DVec3| GridPoint::projected(view, view.camera_space(p)).is_outside();
    let [mut min, mut max] = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    for &p in &*part.points {
        (min, max) = (min.min(p), max.max(p));
    }
    // The region in which no triangle is clipped is convex. Therefore it contains all points if it contains the corners
    // of their bounding box.
    let corner = |i: u32| {
        let side = |axis: u32| if i >> axis & 1 == 0 { min } else { max };
        DVec3::new(side(0).x, side(1).y, side(2).z)
    };
    if part.points.is_empty() || !(0..8).any(|i| is_outside(corner(i))) {
        return 0;
    }
    let triangles = (0..part.triangles.len()).into_par_iter();
    let pieces = triangles.map(|i| {
        let corners = part.corners_at(i);
        let is_clipped = corners.into_iter().any(is_outside);
        if is_clipped {
            clipped(view, corners).len() as u64
        } else {
            0
        }
    });
    pieces.sum()
}

impl Bins {
    /// Sorts items by the tiles that they touch.
    fn new(frame: &Frame, rects: &[(u32, TileRect)]) -> Self {
        let limit = max_listed_tiles(rects);
        let n_large = rects.iter().filter(|t| n_tiles(t.1) > limit).count();
        let mut large = Vec::with_capacity(n_large);
        let tiles = |[left, top, right, bottom]: TileRect| {
            (top..bottom)
                .flat_map(move |row| (left..right).map(move |c| row * frame.columns + c))
                .map(|tile| tile as usize)
        };
        let mut starts = vec![0_u32; frame.n_tiles() + 1];
        for &(item, rect) in rects {
            if n_tiles(rect) > limit {
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
        for &(item, rect) in rects.iter().filter(|t| n_tiles(t.1) <= limit) {
            for tile in tiles(rect) {
                let index = &mut next[tile];
                items[*index as usize] = item;
                *index += 1;
            }
        }
        Self {
            starts,
            items,
            large,
        }
    }

    /// Returns the items of a tile. Items that touch many tiles come first. Within each of these two groups, the items
    /// are in their original order.
    fn items_of(&self, tile: usize) -> impl Iterator<Item = u32> {
        let range = self.starts[tile] as usize..self.starts[tile + 1] as usize;
        self.large.iter().chain(&self.items[range]).copied()
    }
}

/// The triangles of a drawing, sorted by tiles.
pub(super) struct Triangles {
    /// The projected points of each part.
    points: Vec<Vec<GridPoint>>,
    chunks: Vec<Chunk>,
}

/// Some triangles of one part.
struct Chunk {
    part: usize,
    /// The index of the first triangle of the chunk among the triangles of its part.
    first: usize,
    /// The index of the first triangle of the chunk among the triangles of all parts.
    first_of_all: u32,
    bins: Bins,
    /// The pieces into which clipped triangles are divided. Each entry has the index of the triangle in the chunk, and
    /// a piece.
    clipped: Vec<(u32, ProjectedTriangle)>,
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
                let mut pieces = Vec::new();
                let mut rects = Vec::with_capacity(range.len());
                for (i, triangle) in (0..).zip(&p.triangles[range.clone()]) {
                    let projected = triangle.map(|v| points[part][v as usize]);
                    if projected.iter().any(|c| c.is_outside()) {
                        for projected in clipped(view, p.corners_at(range.start + i as usize)) {
                            if let Some(rect) = tiles_of_triangle(&projected, frame) {
                                let index = u32::try_from(pieces.len()).unwrap_or(u32::MAX);
                                rects.push((index | CLIPPED, rect));
                                pieces.push((i, projected));
                            }
                        }
                    } else if let Some(rect) = tiles_of_triangle(&projected, frame) {
                        rects.push((i, rect));
                    }
                }
                let bins = Bins::new(frame, &rects);
                work.add(BIN_TRIANGLE_COST * range.len() as u64)?;
                Ok(Chunk {
                    part,
                    first: range.start,
                    first_of_all,
                    bins,
                    clipped: pieces,
                })
            })
            .collect::<Result<_, PictureError>>()?;
        Ok(Self { points, chunks })
    }

    /// Calls `each` with every triangle that touches a tile, and possibly with other triangles. The arguments are the
    /// index of the triangle (among the triangles of all parts) and the projected triangle.
    pub(super) fn each_of_tile(
        &self,
        drawing: &Drawing,
        tile: usize,
        mut each: impl FnMut(u32, &ProjectedTriangle),
    ) {
        for chunk in &self.chunks {
            let part = &drawing.parts[chunk.part];
            for item in chunk.bins.items_of(tile) {
                if item & CLIPPED == 0 {
                    let triangle = part.triangles[chunk.first + item as usize];
                    let projected = triangle.map(|v| self.points[chunk.part][v as usize]);
                    each(chunk.first_of_all + item, &projected);
                } else {
                    let (index, projected) = &chunk.clipped[(item ^ CLIPPED) as usize];
                    each(chunk.first_of_all + index, projected);
                }
            }
        }
    }
}

/// Returns the tiles that the bounding box of a triangle touches; `None` if the box contains no sample of the picture.
fn tiles_of_triangle(projected: &ProjectedTriangle, frame: &Frame) -> Option<TileRect> {
    let range = |axis: usize, end: u32| {
        let [a, b, c] = projected.map(|corner| corner.at[axis]);
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        // Each pixel is divided into 16 rows and 16 columns. Each sample is in the middle of a row and in the middle of
        // a column.
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
    let [left, right] = range(0, frame.width)?;
    let [top, bottom] = range(1, frame.height)?;
    Some([left, top, right, bottom])
}

/// The lines of a drawing, sorted by tiles.
pub(super) struct Lines {
    projected: Vec<Option<ProjectedLine>>,
    chunks: Vec<(u32, Bins)>,
}

impl Lines {
    /// Sorts lines by their bounding boxes.
    pub(super) fn new(
        projected: Vec<Option<ProjectedLine>>,
        frame: &Frame,
        work: &Work,
    ) -> Result<Self, PictureError> {
        let ranges: Vec<_> = chunks(projected.len(), projected.len()).collect();
        let chunks = ranges
            .into_par_iter()
            .map(|range| {
                let mut rects = Vec::with_capacity(range.len());
                for (i, line) in (0..).zip(&projected[range.clone()]) {
                    let rect = line
                        .as_ref()
                        .and_then(|line| tiles_of_box(limits(line), frame));
                    rects.extend(rect.map(|rect| (i, rect)));
                }
                work.add(BIN_LINE_COST * range.len() as u64)?;
                let first = u32::try_from(range.start).unwrap_or(u32::MAX);
                Ok((first, Bins::new(frame, &rects)))
            })
            .collect::<Result<_, PictureError>>()?;
        Ok(Self { projected, chunks })
    }

    /// Returns the lines whose bounding boxes touch a tile, and possibly other lines. Each line comes with its index,
    /// and the indices are in ascending order.
    pub(super) fn of_tile(&self, tile: usize) -> impl Iterator<Item = (u32, &ProjectedLine)> {
        let mut lines: Vec<u32> = Vec::new();
        for (first, bins) in &self.chunks {
            lines.extend(bins.items_of(tile).map(|line| first + line));
        }
        lines.sort_unstable();
        let projected = |line: u32| Some((line, self.projected[line as usize].as_ref()?));
        lines.into_iter().filter_map(projected)
    }
}

/// Returns the tiles that a box of pixels touches, or `None` if the box is outside of the picture.
fn tiles_of_box([left, top, right, bottom]: [f64; 4], frame: &Frame) -> Option<TileRect> {
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
    fn lists_are_bounded_and_complete() {
        let frame = Frame::new([640, 640]);
        for side in [1, 3, 8, 9, 20] {
            // Each item is a square of `side` times `side` tiles. The squares are distributed over the picture.
            let items: Vec<(u32, TileRect)> = (0..5000)
                .map(|i| {
                    let (left, top) = (i % (21 - side), i / 20 % (21 - side));
                    (i, [left, top, left + side, top + side])
                })
                .collect();
            let bins = Bins::new(&frame, &items);
            assert!(bins.items.len() <= ENTRIES_PER_ITEM * items.len() + EXTRA_ENTRIES);
            for tile in 0..frame.n_tiles() {
                let [x, y] = [tile % 20, tile / 20].map(|i| u32::try_from(i).unwrap());
                let found: Vec<u32> = bins.items_of(tile).collect();
                for &(item, [left, top, right, bottom]) in &items {
                    if (left..right).contains(&x) && (top..bottom).contains(&y) {
                        assert!(found.contains(&item), "{side}, {tile}");
                    }
                }
            }
        }
    }
}
