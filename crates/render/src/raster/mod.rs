//! From a drawing to pixels.
//!
//! The picture is cut into tiles. Triangles are sorted into the tiles that they touch; then each tile finds
//! what its samples see and shades it, independently of all others: the same bytes for any number of
//! threads.
//!
//! ```text
//!   project    points to a grid of 1/256 pixel; triangles that reach too far are cut
//!   bins       which triangles and lines touch which tile
//!   tile       which triangle each of 16 samples a pixel sees
//!   holes      which samples a triangle covers that is not opaque
//!   lines      which line lies over it
//!   shade      the color of a triangle at a place
//!   occlusion  how much of the surroundings a place sees
//! ```

mod bins;
mod holes;
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
use crate::style::Shading;
use crate::work::Work;
use crate::{PictureError, View};
use holes::Cover;
use project::{Corner, Flat, GRID};
use shade::{Memory, Shader};
use tile::{NOTHING, PLACES, SAMPLES, Tile};

/// Pixels of a tile along each side.
const TILE: u32 = 32;

/// How a drawing is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// How light falls.
    pub shading: Shading,
    /// How dark places are that see little of their surroundings: from 0 (no darker) to 1.
    pub occlusion: f32,
    /// Linear red, green and blue, and alpha, of what is behind everything.
    pub background: [f32; 4],
}

impl Look {
    /// Whether it needs to know how much places see of their surroundings.
    fn has_occlusion(&self) -> bool {
        self.occlusion > 0.0 && self.shading != Shading::Plain
    }
}

/// A drawing in pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// The pixels.
    pub image: Image,
    /// Where the labels of the drawing are, in its order; `None` for those behind the camera or beside the
    /// picture.
    pub labels: Vec<Option<PlacedLabel>>,
}

/// A label in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLabel {
    /// Pixels from the left and from the top.
    pub at: DVec2,
    /// Whether something is before it.
    pub is_hidden: bool,
}

/// The size of a picture, and its tiles.
struct Frame {
    width: u32,
    height: u32,
    columns: u32,
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

/// The bytes of memory that [`render`] takes at most, beside the drawing: so many points, triangles and lines
/// in a picture of this size. Triangles that the camera is among may take more.
pub fn bytes_needed(drawing: &Drawing, [width, height]: [u32; 2], look: &Look) -> u64 {
    // Sizes that are too large are refused; here they must not overflow.
    let [width, height] = [width, height].map(|side| side.min(1 << 20));
    let frame = Frame::new([width, height]);
    let pixels = u64::from(width) * u64::from(height);
    let threads = rayon::current_num_threads() as u64;
    let n_points: u64 = drawing.parts.iter().map(|p| p.points.len() as u64).sum();
    let (triangles, lines) = (drawing.n_triangles() as u64, drawing.lines.len() as u64);
    let maps = if look.has_occlusion() && triangles > 0 {
        occlusion::bytes([width, height]) + 12 * n_points * threads + 24 * triangles
    } else {
        0
    };
    let points = size_of::<Corner>() as u64 * n_points;
    let groups = drawing.parts.iter().map(|p| p.triangles.len());
    let of_triangles = bins::bytes(groups, &frame);
    let a_line = size_of::<Option<lines::FlatLine>>() as u64 + 8 * threads;
    let of_lines = a_line * lines + bins::bytes(std::iter::once(drawing.lines.len()), &frame);
    // A thread that waits for others begins further rows of tiles.
    let rows = 4 * threads * (4 * u64::from(TILE * width) + (1 << 18));
    4 * pixels + points + of_triangles + of_lines + maps + rows + (1 << 20)
}

/// What things cost, in about nanoseconds: a triangle and a line until they are in their tiles, both there, a pixel, and
/// a triangle in all depth maps.
const SORTED: u64 = 60;
const LINED: u64 = 200;
const DRAWN: u64 = 60;
const SHADED: u64 = 150;
const MAPPED: u64 = 400;

/// Draws a drawing.
///
/// # Errors
///
/// [`PictureError::Size`] if the picture has no pixels or too many; [`PictureError::Cancelled`].
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
    let of_maps = if look.has_occlusion() {
        MAPPED * n_triangles
    } else {
        0
    };
    let n_lines = drawing.lines.len() as u64;
    let of_tiles = DRAWN * (n_triangles + n_lines) + SHADED * n_pixels as u64;
    let before = SORTED * n_triangles + LINED * n_lines;
    let work = Work::new(progress, "draw", before + of_maps + of_tiles);
    work.add(0)?;
    let triangles = bins::Triangles::new(drawing, view, &frame, &work)?;
    let lines = bins::Lines::new(lines::project(drawing, view), &frame, &work)?;
    let shader = Shader::new(drawing, view, size, look, |n_maps| {
        work.add(of_maps / n_maps)
    })?;

    let of_tile = of_tiles / frame.n_tiles() as u64;
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
                    triangles.of(drawing, number, |id, flat| {
                        draw(tile, id, flat, &shader);
                    });
                    for (line, flat) in lines.of(number) {
                        lines::draw(tile, line, flat, &shader);
                    }
                    work.add(of_tile)?;
                    Ok(resolve(tile, &shader, look))
                })
                .collect::<Result<_, PictureError>>()?;
            for (tile, left) in tiles.iter().zip((0..width).step_by(TILE as usize)) {
                let n = (width - left).min(TILE as usize);
                for (row, of_tile) in band.chunks_mut(width).zip(tile.chunks(n)) {
                    row[left..left + n].copy_from_slice(of_tile);
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

/// Draws a triangle into a tile, where it is not transparent.
fn draw(tile: &mut Tile, id: u32, flat: &Flat, shader: &Shader) {
    if !shader.has_holes {
        tile.draw(id, flat, u16::MAX);
        return;
    }
    match shader.cover(id) {
        Cover::Same(mask) => tile.draw(id, flat, mask),
        Cover::Textured(mut texture) => {
            tile.draw_holed(id, flat, |pixel, sample| texture.covers(pixel, sample));
        }
    }
}

/// The pixels of a tile.
fn resolve(tile: &Tile, shader: &Shader, look: &Look) -> Vec<[u8; 4]> {
    let n_pixels = (tile.right - tile.left) * (tile.bottom - tile.top);
    let mut pixels = Vec::with_capacity(n_pixels as usize);
    let nothing = finished([0.0; 4], look.background);
    let mut memory = Memory::default();
    for y in tile.top..tile.bottom {
        for x in tile.left..tile.right {
            let place = tile.place(x, y);
            let (seen, over) = (&tile.seen[place], &tile.over[place]);
            let is_empty = *seen == [NOTHING; SAMPLES] && *over == [0; SAMPLES];
            pixels.push(if is_empty {
                nothing
            } else {
                memory.begin_pixel();
                let light = shaded([x, y], seen, over, shader, &mut memory);
                finished(light, look.background)
            });
        }
    }
    pixels
}

/// Premultiplied linear light and alpha of a pixel.
fn shaded(
    [x, y]: [u32; 2],
    seen: &[u32; SAMPLES],
    over: &[u32; SAMPLES],
    shader: &Shader,
    memory: &mut Memory,
) -> [f32; 4] {
    let middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let mut sum = [0.0; 4];
    let mut done = 0_u32;
    for first in 0..SAMPLES {
        if done >> first & 1 == 1 {
            continue;
        }
        // All samples that see the same.
        let (mut n, mut place) = (0.0_f32, [0_i32; 2]);
        for k in first..SAMPLES {
            if seen[k] == seen[first] && over[k] == over[first] {
                done |= 1 << k;
                n += 1.0;
                place = [place[0] + PLACES[k][0], place[1] + PLACES[k][1]];
            }
        }
        let line = (over[first] > 0).then(|| shader.line_color(over[first]));
        let line_alpha = line.map_or(0.0, |c| c[3]);
        let mut color = [0.0; 4];
        if seen[first] != NOTHING && line_alpha < 1.0 {
            let scale = 1.0 / (f64::from(n) * f64::from(GRID));
            let aside = DVec2::new(f64::from(place[0]), f64::from(place[1])) * scale;
            let [r, g, b] = shader.shade(seen[first], middle + aside, memory);
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

/// A pixel from premultiplied linear light over a background.
fn finished([r, g, b, a]: [f32; 4], [s, t, u, v]: [f32; 4]) -> [u8; 4] {
    let rest = (1.0 - a) * v;
    let alpha = a + rest;
    if alpha <= 0.0 {
        return [0; 4];
    }
    let light = [r + s * rest, g + t * rest, b + u * rest].map(|c| to_srgb(c / alpha));
    [light[0], light[1], light[2], byte(alpha)]
}

/// Where a label is, and whether a triangle is before it.
fn place(
    at: glam::DVec3,
    drawing: &Drawing,
    view: &View,
    frame: &Frame,
    triangles: &bins::Triangles,
) -> Option<PlacedLabel> {
    let seen = view.see(at)?;
    let (w, h) = (f64::from(frame.width), f64::from(frame.height));
    if !(0.0..w).contains(&seen.at.x) || !(0.0..h).contains(&seen.at.y) {
        return None;
    }
    let [x, y] = seen.at.to_array().map(whole_u32);
    let number = (y / TILE * frame.columns + x / TILE) as usize;
    let nearer = view.depth_of(2.0 * view.pixel(seen.depth), seen.depth);
    let limit = narrow(seen.depth - nearer);
    // As if it were a tile of one pixel.
    let mut tile = Tile::new();
    (tile.left, tile.top, tile.right, tile.bottom) = (x, y, x + 1, y + 1);
    triangles.of(drawing, number, |id, flat| {
        tile.draw(id, flat, u16::MAX);
    });
    Some(PlacedLabel {
        at: seen.at,
        is_hidden: tile.depth[0][nearest_sample(seen.at)] < limit,
    })
}

/// The sample of its pixel that is nearest to a place.
fn nearest_sample(at: DVec2) -> usize {
    let inside = (at - at.floor() - 0.5) * f64::from(GRID);
    let distance = |k: &usize| {
        let [x, y] = PLACES[*k];
        inside.distance_squared(DVec2::new(f64::from(x), f64::from(y)))
    };
    (0..SAMPLES)
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .unwrap_or(0)
}
