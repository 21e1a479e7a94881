//! Renders a drawing to pixels.
//!
//! The picture is divided into tiles. Triangles and lines are sorted into the tiles that they touch. Then each tile is
//! drawn and shaded independently of all other tiles, so that any number of threads gives the same bytes.
//!
//! ```text
//!   project    projects points to a grid of 1/256 pixel, and clips triangles
//!   bins       sorts triangles and lines into tiles
//!   tile       finds the visible triangle for each of 16 samples per pixel
//!   coverage   selects the samples that a transparent triangle covers
//!   lines      finds the lines that cover samples
//!   shade      computes the color of a triangle at a point
//!   occlusion  computes ambient occlusion at a point
//! ```

mod bins;
mod coverage;

mod lines;
mod occlusion;
mod project;
mod shade;
#[cfg(test)]
mod tests;
mod tile;

use glam::DVec2;
use progress::Progress;
use rayon::prelude::*;

use crate::color::{byte, narrow, to_srgb, whole_u32};
use crate::drawing::Drawing;
use crate::image::{Image, checked_size};
use crate::style::Look;
use crate::work::Work;
use crate::{PictureError, View};
use coverage::Coverage;
use project::{GRID, GridPoint, ProjectedTriangle};
use shade::{Shader, ShadingCache};
use tile::{NO_TRIANGLE, OFFSETS, SAMPLES, Tile};

/// The width and height of a tile in pixels.
const TILE: u32 = 32;

/// A rendered drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// The pixels.
    pub image: Image,
    /// The position of each label of the drawing. The order is that of the labels in the drawing. The position is
    /// `None` if the label is behind the camera or outside of the picture.
    pub labels: Vec<Option<PlacedLabel>>,
}

/// The position of a label in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLabel {
    /// The distances from the left and the top of the picture, in pixels.
    pub at: DVec2,
    /// Whether a triangle hides the position. Transparent triangles hide the position too.
    pub is_hidden: bool,
}

/// The width and height of a picture, in pixels and in tiles.
struct Frame {
    width: u32,
    height: u32,
    /// The number of columns of tiles.
    columns: u32,
    /// The number of rows of tiles.
    rows: u32,
}

impl Frame {
    fn new([width, height]: [u32; 2]) -> Self {
        Self {
            width,
            height,
            columns: width.div_ceil(TILE),
            rows: height.div_ceil(TILE),
        }
    }

    fn n_tiles(&self) -> usize {
        self.columns as usize * self.rows as usize
    }
}

/// Returns the memory that [`render`] needs for the pixels of a picture of this size, in bytes.
pub fn pixel_bytes(size: [u32; 2]) -> u64 {
    // Sizes that are too large are refused later. Here, width and height are clamped so that the computation does not
    // overflow.
    let [width, height] = size.map(|side| u64::from(side.min(1 << 20)));
    let threads = rayon::current_num_threads() as u64;
    // While a thread waits for other threads, it starts more rows of tiles. Therefore one thread can hold several rows
    // in memory.
    let rows = 4 * threads * (4 * u64::from(TILE) * width + (1 << 18));
    4 * width * height + rows + (1 << 20)
}

/// Returns an upper bound of the memory that [`render`] needs for a picture with this view and size, in bytes. The
/// memory of the drawing itself is not included.
pub fn bytes_needed(drawing: &Drawing, view: &View, size: [u32; 2], look: &Look) -> u64 {
    // Width and height are clamped, as in `pixel_bytes`, so that the computation does not overflow.
    let [width, height] = size.map(|side| side.min(1 << 20));
    let frame = Frame::new([width, height]);
    let threads = rayon::current_num_threads() as u64;
    let n_points: u64 = drawing.parts.iter().map(|p| p.points.len() as u64).sum();
    let (triangles, lines) = (drawing.n_triangles() as u64, drawing.lines.len() as u64);
    let maps = if look.has_occlusion() && triangles > 0 {
        occlusion::bytes([width, height]) + 12 * n_points * threads + 24 * triangles
    } else {
        0
    };
    let points = size_of::<GridPoint>() as u64 * n_points;
    let groups = drawing.parts.iter().map(|p| p.triangles.len());
    let triangle_bytes = bins::bytes(groups, &frame) + bins::clipped_bytes(drawing, view);
    let bytes_per_line = size_of::<Option<lines::ProjectedLine>>() as u64 + 8 * threads;
    let line_bins = bins::bytes(std::iter::once(drawing.lines.len()), &frame);
    let line_bytes = bytes_per_line * lines + line_bins;
    pixel_bytes(size) + points + triangle_bytes + line_bytes + maps
}

// The following constants are estimated times in nanoseconds. Progress reports use them to weight the stages.

/// The cost of projecting a triangle and sorting it into tiles.
const BIN_TRIANGLE_COST: u64 = 60;
/// The cost of projecting a line and sorting it into tiles.
const BIN_LINE_COST: u64 = 200;
/// The cost of drawing a triangle or line into its tiles.
const DRAW_COST: u64 = 60;
/// The cost of shading a pixel.
const PIXEL_COST: u64 = 150;
/// The cost of drawing a triangle into all depth maps.
const DEPTH_MAP_COST: u64 = 400;

/// Renders a drawing.
///
/// # Errors
///
/// Returns [`PictureError::Size`] if a side of the picture is 0 or too long. Returns [`PictureError::Cancelled`] if the
/// listener cancels the work.
pub fn render(
    drawing: &Drawing,
    view: &View,
    size: [u32; 2],
    look: &Look,
    progress: &dyn Progress,
) -> Result<Rendered, PictureError> {
    let n_pixels = checked_size(size[0], size[1])?;
    let frame = Frame::new(size);
    let n_triangles = drawing.n_triangles() as u64;
    let map_cost = if look.has_occlusion() {
        DEPTH_MAP_COST * n_triangles
    } else {
        0
    };
    let n_lines = drawing.lines.len() as u64;
    let tile_cost = DRAW_COST * (n_triangles + n_lines) + PIXEL_COST * n_pixels as u64;
    let bin_cost = BIN_TRIANGLE_COST * n_triangles + BIN_LINE_COST * n_lines;
    let work = Work::new(progress, "draw", bin_cost + map_cost + tile_cost);
    work.add(0)?;
    let triangles = bins::Triangles::new(drawing, view, &frame, &work)?;
    let lines = bins::Lines::new(lines::project(drawing, view), &frame, &work)?;
    let shader = Shader::new(drawing, view, size, look, |n_maps| {
        work.add(map_cost / n_maps)
    })?;

    let cost_per_tile = tile_cost / frame.n_tiles() as u64;
    let mut pixels = vec![[0; 4]; n_pixels];
    let width = frame.width as usize;
    pixels
        .par_chunks_mut(width * TILE as usize)
        .zip(0..frame.rows)
        .try_for_each(|(band, row)| {
            let tiles: Vec<Vec<[u8; 4]>> = (0..frame.columns)
                .into_par_iter()
                .map_init(Tile::new, |tile, column| {
                    tile.begin(&frame, column, row);
                    let number = (row * frame.columns + column) as usize;
                    triangles.each_of_tile(drawing, number, |id, projected| {
                        draw(tile, id, projected, &shader);
                    });
                    for (line, projected) in lines.of_tile(number) {
                        lines::draw(tile, line, projected, &shader);
                    }
                    work.add(cost_per_tile)?;
                    Ok(resolve(tile, &shader, look))
                })
                .collect::<Result<_, PictureError>>()?;
            for (tile, left) in tiles.iter().zip((0..width).step_by(TILE as usize)) {
                let n = (width - left).min(TILE as usize);
                for (row, tile_row) in band.chunks_mut(width).zip(tile.chunks(n)) {
                    row[left..left + n].copy_from_slice(tile_row);
                }
            }
            Ok::<(), PictureError>(())
        })?;
    let labels = drawing
        .labels
        .iter()
        .map(|label| place(label.at, drawing, view, &frame, &triangles))
        .collect();
    Ok(Rendered {
        image: Image {
            width: frame.width,
            height: frame.height,
            pixels,
        },
        labels,
    })
}

/// Draws a triangle into a tile, but only at the samples that its alpha selects (see [`Coverage`]).
fn draw(tile: &mut Tile, id: u32, projected: &ProjectedTriangle, shader: &Shader) {
    if !shader.has_transparency {
        tile.draw(id, projected, u16::MAX);
        return;
    }
    match shader.coverage(id) {
        Coverage::Same(mask) => tile.draw(id, projected, mask),
        Coverage::Textured(mut texture) => {
            tile.draw_textured(id, projected, |pixel, sample| texture.covers(pixel, sample));
        }
    }
}

/// Computes the pixels of a tile from its samples.
fn resolve(tile: &Tile, shader: &Shader, look: &Look) -> Vec<[u8; 4]> {
    let n_pixels = (tile.right - tile.left) * (tile.bottom - tile.top);
    let mut pixels = Vec::with_capacity(n_pixels as usize);
    let empty = over_background([0.0; 4], look.background);
    let mut cache = ShadingCache::default();
    for y in tile.top..tile.bottom {
        for x in tile.left..tile.right {
            let index = tile.index(x, y);
            let (triangles, lines) = (&tile.triangles[index], &tile.lines[index]);
            let is_empty = *triangles == [NO_TRIANGLE; SAMPLES] && *lines == [0; SAMPLES];
            pixels.push(if is_empty {
                empty
            } else {
                cache.begin_pixel();
                let light = shade_pixel([x, y], triangles, lines, shader, &mut cache);
                over_background(light, look.background)
            });
        }
    }
    pixels
}

/// Returns the linear light of a pixel, premultiplied by alpha, and the alpha.
fn shade_pixel(
    [x, y]: [u32; 2],
    triangles: &[u32; SAMPLES],
    lines: &[u32; SAMPLES],
    shader: &Shader,
    cache: &mut ShadingCache,
) -> [f32; 4] {
    let middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let mut sum = [0.0; 4];
    let mut done = 0_u32;
    for first in 0..SAMPLES {
        if done >> first & 1 == 1 {
            continue;
        }
        // All samples with the same triangle and line are shaded together, at their mean position.
        let (mut n, mut offset_sum) = (0.0_f32, [0_i32; 2]);
        for k in first..SAMPLES {
            if triangles[k] == triangles[first] && lines[k] == lines[first] {
                done |= 1 << k;
                n += 1.0;
                let [dx, dy] = OFFSETS[k];
                offset_sum = [offset_sum[0] + dx, offset_sum[1] + dy];
            }
        }
        let line = (lines[first] > 0).then(|| shader.line_color(lines[first]));
        let line_alpha = line.map_or(0.0, |c| c[3]);
        let mut color = [0.0; 4];
        if triangles[first] != NO_TRIANGLE && line_alpha < 1.0 {
            let scale = 1.0 / (f64::from(n) * f64::from(GRID));
            let offset = DVec2::from(offset_sum.map(f64::from)) * scale;
            let [r, g, b] = shader.shade(triangles[first], middle + offset, cache);
            color = [r, g, b, 1.0];
        }
        if let Some([r, g, b, a]) = line {
            let over = [r * a, g * a, b * a, a];
            color = std::array::from_fn(|i| over[i] + color[i] * (1.0 - a));
        }
        for (sum, c) in sum.iter_mut().zip(color) {
            *sum += c * n;
        }
    }
    sum.map(|c| c / SAMPLES as f32)
}

/// Composites premultiplied linear light over the background, and converts it to an sRGB pixel.
fn over_background([r, g, b, a]: [f32; 4], [s, t, u, v]: [f32; 4]) -> [u8; 4] {
    let rest = (1.0 - a) * v;
    let alpha = a + rest;
    if alpha <= 0.0 {
        return [0; 4];
    }
    let light = [r + s * rest, g + t * rest, b + u * rest].map(|c| to_srgb(c / alpha));
    [light[0], light[1], light[2], byte(alpha)]
}

/// Returns the position of a label in the picture, and whether a triangle hides it.
fn place(
    at: glam::DVec3,
    drawing: &Drawing,
    view: &View,
    frame: &Frame,
    triangles: &bins::Triangles,
) -> Option<PlacedLabel> {
    let point = view.screen_point(at)?;
    let (w, h) = (f64::from(frame.width), f64::from(frame.height));
    if !(0.0..w).contains(&point.at.x) || !(0.0..h).contains(&point.at.y) {
        return None;
    }
    let [x, y] = point.at.to_array().map(whole_u32);
    let number = (y / TILE * frame.columns + x / TILE) as usize;
    let tolerance = view.depth_change(2.0 * view.pixel_size(point.depth), point.depth);
    let limit = narrow(point.depth - tolerance);
    // To find the depth of the surface at the label, the triangles are drawn into a tile of a single pixel: the pixel
    // of the label.
    let mut tile = Tile::new();
    (tile.left, tile.top, tile.right, tile.bottom) = (x, y, x + 1, y + 1);
    triangles.each_of_tile(drawing, number, |id, projected| {
        tile.draw(id, projected, u16::MAX);
    });
    Some(PlacedLabel {
        at: point.at,
        is_hidden: tile.depth[0][nearest_sample(point.at)] < limit,
    })
}

/// Returns the sample that is nearest to a point of the picture, among the samples of the pixel that contains the
/// point.
fn nearest_sample(at: DVec2) -> usize {
    let offset = (at - at.floor() - 0.5) * f64::from(GRID);
    let distance = |k: &usize| {
        let [x, y] = OFFSETS[*k];
        offset.distance_squared(DVec2::new(f64::from(x), f64::from(y)))
    };
    (0..SAMPLES)
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .unwrap_or(0)
}
