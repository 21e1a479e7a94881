//! Which triangles and lines touch which tile of the picture.
//!
//! Triangles are taken in chunks, each sorted into tiles by one task with a counting sort. A tile reads its
//! lists chunk after chunk.

use rayon::prelude::*;

use super::project::{Corner, Flat, GRID, GRID_BITS, clipped};
use super::{Frame, SORTED, TILE};
use crate::drawing::Drawing;
use crate::progress::Work;
use crate::{PictureError, View};

/// At most so many chunks, because each has a number for every tile.
const MOST_CHUNKS: usize = 32;
/// At least so many triangles in a chunk.
const LEAST_CHUNK: usize = 1 << 15;
/// What touches more tiles than this is not listed in each of them, but looked at in all.
const MANY_TILES: u32 = 64;
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

impl Sorted {
    /// Sorts things by their tiles, which `tiles` gives to its argument.
    fn new(n_columns: u32, n_tiles: usize, things: impl Iterator<Item = (u32, TileRect)>) -> Self {
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        let mut large = Vec::new();
        for (item, [left, top, right, bottom]) in things {
            if (right - left) * (bottom - top) > MANY_TILES {
                large.push(item);
                continue;
            }
            for row in top..bottom {
                pairs.extend((left..right).map(|column| (row * n_columns + column, item)));
            }
        }
        let mut starts = vec![0_u32; n_tiles + 1];
        for &(tile, _) in &pairs {
            starts[tile as usize + 1] += 1;
        }
        for i in 0..n_tiles {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut items = vec![0; pairs.len()];
        for (tile, item) in pairs {
            let place = &mut next[tile as usize];
            items[*place as usize] = item;
            *place += 1;
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
        let points: Vec<_> = drawing
            .parts
            .iter()
            .map(|part| super::project::project(view, &part.points))
            .collect();
        let size = drawing.n_triangles().div_ceil(MOST_CHUNKS).max(LEAST_CHUNK);
        let mut ranges = Vec::new();
        let mut first_of_all = 0;
        for (part, p) in drawing.parts.iter().enumerate() {
            for first in (0..p.triangles.len()).step_by(size) {
                let end = (first + size).min(p.triangles.len());
                ranges.push((part, first..end, first_of_all));
                first_of_all += u32::try_from(end - first).unwrap_or(u32::MAX);
            }
        }
        let chunks = ranges
            .into_par_iter()
            .map(|(part, range, first_of_all)| {
                let p = &drawing.parts[part];
                let mut cut = Vec::new();
                let mut rects = Vec::new();
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
                let sorted = Sorted::new(frame.columns, frame.n_tiles(), rects.into_iter());
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
    sorted: Sorted,
}

impl Lines {
    /// Sorts lines by their boxes, in pixels: left, top, right and bottom.
    pub(super) fn new(boxes: impl Iterator<Item = Option<[f64; 4]>>, frame: &Frame) -> Self {
        let rects = (0..).zip(boxes).filter_map(|(i, limits)| {
            let [left, top, right, bottom] = limits?;
            let (w, h) = (f64::from(frame.width), f64::from(frame.height));
            if right < 0.0 || bottom < 0.0 || left >= w || top >= h {
                return None;
            }
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "inside the picture"
            )]
            let tile = |x: f64, end: f64| x.clamp(0.0, end - 1.0) as u32 / TILE;
            let rect = [
                tile(left, w),
                tile(top, h),
                tile(right, w) + 1,
                tile(bottom, h) + 1,
            ];
            Some((i, rect))
        });
        Self {
            sorted: Sorted::new(frame.columns, frame.n_tiles(), rects),
        }
    }

    /// The lines that may touch a tile, in their order.
    pub(super) fn of(&self, tile: usize) -> Vec<u32> {
        let mut lines: Vec<u32> = self.sorted.of(tile).collect();
        lines.sort_unstable();
        lines
    }
}
