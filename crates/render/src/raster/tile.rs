//! A tile of the picture: which triangle each sample sees.
//!
//! A pixel has 16 samples, one in each of 16 rows and columns (n-rooks: Shirley, "Discrepancy as a Quality
//! Measure for Sample Distributions", 1991). Of the ways to place them this one has been found by a search: it
//! differs least from the areas that edges of all directions cut from the pixel.

use std::ops::{Add, BitOr, Mul, Sub};

use crate::color::narrow;

use super::lines::Planes;
use super::project::{Corner, Flat, GRID, GRID_BITS};
use super::{Frame, TILE};

/// Samples of a pixel.
pub(super) const SAMPLES: usize = 16;
/// Stands where no triangle is seen.
pub(super) const NOTHING: u32 = u32::MAX;
/// So many planes of triangles are remembered.
const PLANES: usize = 512;
/// The rows of the samples, for each column.
const ROWS: [i32; SAMPLES] = [3, 11, 7, 15, 1, 6, 10, 13, 2, 5, 9, 14, 0, 8, 4, 12];
/// The place of each sample, from the middle of its pixel, in steps of the grid.
pub(super) const PLACES: [[i32; 2]; SAMPLES] = {
    let mut places = [[0; 2]; SAMPLES];
    let step = GRID / 16;
    let (mut column, mut k) = (0, 0);
    while k < SAMPLES {
        let aside = step / 2 - GRID / 2;
        places[k] = [column * step + aside, ROWS[k] * step + aside];
        column += 1;
        k += 1;
    }
    places
};

/// The samples of a tile.
pub(super) struct Tile {
    /// The pixels of its upper left corner, and behind its lower right one.
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) right: u32,
    pub(super) bottom: u32,
    /// For each pixel the depth of what its samples see; infinite where there is nothing.
    pub(super) depth: Vec<[f32; SAMPLES]>,
    /// For each pixel the triangles that its samples see.
    pub(super) seen: Vec<[u32; SAMPLES]>,
    /// For each pixel the lines that lie over its samples: twice the number plus 2, and 1 if hidden; 0 for
    /// none.
    pub(super) over: Vec<[u32; SAMPLES]>,
    /// The planes of some triangles.
    pub(super) planes: Planes,
}

impl Tile {
    pub(super) fn new() -> Self {
        let n = (TILE * TILE) as usize;
        Self {
            left: 0,
            top: 0,
            right: 0,
            bottom: 0,
            depth: vec![[f32::INFINITY; SAMPLES]; n],
            seen: vec![[NOTHING; SAMPLES]; n],
            over: vec![[0; SAMPLES]; n],
            planes: vec![None; PLANES],
        }
    }

    /// Begins a tile.
    pub(super) fn begin(&mut self, frame: &Frame, column: u32, row: u32) {
        (self.left, self.top) = (column * TILE, row * TILE);
        self.right = (self.left + TILE).min(frame.width);
        self.bottom = (self.top + TILE).min(frame.height);
        self.depth.fill([f32::INFINITY; SAMPLES]);
        self.seen.fill([NOTHING; SAMPLES]);
        self.over.fill([0; SAMPLES]);
    }

    /// The place of a pixel in the arrays.
    pub(super) fn place(&self, x: u32, y: u32) -> usize {
        ((y - self.top) * TILE + (x - self.left)) as usize
    }

    /// Draws a triangle into the samples where it is nearer than what is there; at the same depth the
    /// triangle of the lower number stays. Only samples with their bit in `mask` are covered.
    pub(super) fn draw(&mut self, id: u32, flat: &Flat, mask: u16) {
        let Some(setup) = Setup::new(flat, self) else {
            return;
        };
        let [x0, y0, x1, y1] = setup.limits;
        // Many small triangles lie between the middles of pixels.
        if x0 > x1 || y0 > y1 {
            return;
        }
        // In 32 bits the arithmetic is exact for triangles of less than 64 pixels: 32 to each side.
        let first = flat[0].at;
        let is_near = |c: &Corner| (0..2).all(|i| c.at[i].abs_diff(first[i]) < 1 << 13);
        if mask == u16::MAX && flat.iter().all(is_near) {
            self.fill::<i32>(id, &setup, mask);
        } else {
            self.fill::<i64>(id, &setup, mask);
        }
    }

    /// Draws a triangle as [`Self::draw`] does, where `covers` says that it is: asked of pixels and their samples.
    pub(super) fn draw_holed(
        &mut self,
        id: u32,
        flat: &Flat,
        mut covers: impl FnMut([u32; 2], usize) -> bool,
    ) {
        let Some(mut setup) = Setup::new(flat, self) else {
            return;
        };
        let [x0, y0, x1, y1] = setup.limits;
        for y in y0..=y1 {
            for x in x0..=x1 {
                let mask = mask_of(|k| setup.is_inside(x, y, k) && covers([x, y], k));
                if mask != 0 {
                    setup.limits = [x, y, x, y];
                    self.fill::<i64>(id, &setup, mask);
                }
            }
        }
    }

    #[expect(
        clippy::needless_bitwise_bool,
        reason = "no branches: 16 samples at once"
    )]
    fn fill<T: Number>(&mut self, id: u32, setup: &Setup, mask: u16) {
        let [x0, y0, x1, y1] = setup.limits;
        let edges = setup.edges.map(Edge::of::<T>);
        // What each edge changes from the middle of a pixel to its samples.
        let mut aside = edges.map(|[a, b, _]| {
            PLACES.map(|[x, y]| a * T::of(i64::from(x)) + b * T::of(i64::from(y)))
        });
        for (k, aside) in aside[0].iter_mut().enumerate() {
            if mask >> k & 1 == 0 {
                *aside = T::of(i64::MIN / 4);
            }
        }
        let most = aside.map(|of_edge| of_edge.into_iter().max().unwrap_or(T::of(0)));
        let [dx, dy] = setup.slope;
        let deeper = PLACES.map(|[x, y]| narrow(dx * f64::from(x) + dy * f64::from(y)));
        let step = edges.map(|[a, _, _]| a * T::of(i64::from(GRID)));
        for y in y0..=y1 {
            let from = setup.from(x0, y);
            let mut e: [T; 3] = std::array::from_fn(|i| {
                let [a, b, c] = edges[i];
                c + a * T::of(from[0]) + b * T::of(from[1])
            });
            let mut depth = setup.depth + dx * from[0] as f64 + dy * from[1] as f64;
            let row = self.place(x0, y);
            let n = (x1 - x0 + 1) as usize;
            for place in row..row + n {
                let outside = (0..3).any(|i| e[i] + most[i] < T::of(0));
                if !outside {
                    let inside: [T; SAMPLES] = std::array::from_fn(|k| {
                        (e[0] + aside[0][k]) | (e[1] + aside[1][k]) | (e[2] + aside[2][k])
                    });
                    let d = narrow(depth);
                    let (depths, seen) = (&mut self.depth[place], &mut self.seen[place]);
                    for k in 0..SAMPLES {
                        let d = (d + deeper[k]).max(setup.nearest).min(setup.farthest);
                        let is_nearer = (d < depths[k]) | ((d == depths[k]) & (id < seen[k]));
                        let take = (inside[k] >= T::of(0)) & is_nearer;
                        depths[k] = if take { d } else { depths[k] };
                        seen[k] = if take { id } else { seen[k] };
                    }
                }
                for i in 0..3 {
                    e[i] = e[i] + step[i];
                }
                depth += dx * f64::from(GRID);
            }
        }
    }
}

/// The whole numbers that edges are computed with.
trait Number:
    Copy + Ord + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + BitOr<Output = Self>
{
    fn of(value: i64) -> Self;
}

impl Number for i64 {
    fn of(value: i64) -> Self {
        value
    }
}

impl Number for i32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the caller knows that it fits"
    )]
    fn of(value: i64) -> Self {
        value as Self
    }
}

/// An edge: a x + b y + c is not negative inside, seen from the first corner of its triangle.
#[derive(Clone, Copy)]
struct Edge {
    a: i64,
    b: i64,
    c: i64,
}

impl Edge {
    fn of<T: Number>(self) -> [T; 3] {
        [self.a, self.b, self.c].map(T::of)
    }
}

/// The bits of the samples for which something holds.
pub(super) fn mask_of(mut holds: impl FnMut(usize) -> bool) -> u16 {
    (0..SAMPLES).fold(0, |mask, k| mask | u16::from(holds(k)) << k)
}

/// What filling a triangle needs.
struct Setup {
    edges: [Edge; 3],
    /// The first and the last pixel to look at, from left to right and from top to bottom.
    limits: [u32; 4],
    /// The first corner.
    origin: [i64; 2],
    /// Depth at the first corner, and how it changes for a step of the grid.
    depth: f64,
    slope: [f64; 2],
    nearest: f32,
    farthest: f32,
}

impl Setup {
    /// `None` if the triangle has no area or is not on the tile.
    fn new(flat: &Flat, tile: &Tile) -> Option<Self> {
        let [o, mut p, mut q] = *flat;
        let from_o = |c: Corner| [c.at[0] - o.at[0], c.at[1] - o.at[1]].map(i64::from);
        let (mut u, mut v) = (from_o(p), from_o(q));
        let mut area = u[0] * v[1] - u[1] * v[0];
        if area == 0 {
            return None;
        }
        if area < 0 {
            std::mem::swap(&mut p, &mut q);
            std::mem::swap(&mut u, &mut v);
            area = -area;
        }
        let axis = |i: usize, low: u32, high: u32| {
            let [a, b, c] = [o, p, q].map(|c| c.at[i]);
            let first = a.min(b).min(c) >> GRID_BITS;
            let last = a.max(b).max(c) >> GRID_BITS;
            let first = u32::try_from(first.max(0)).unwrap_or(0).max(low);
            let last = u32::try_from(last).ok()?.min(high - 1);
            (first <= last).then_some([first, last])
        };
        let [x0, x1] = axis(0, tile.left, tile.right)?;
        let [y0, y1] = axis(1, tile.top, tile.bottom)?;
        // The area of the corner (x, y) with an edge from s to t: (t - s) x ((x, y) - s). With y downwards
        // a positive area turns clockwise. A sample exactly on an edge belongs to the triangle below or to
        // the right of it.
        let edge = |s: [i64; 2], t: [i64; 2]| {
            let (a, b) = (s[1] - t[1], t[0] - s[0]);
            let c = -(a * s[0] + b * s[1]);
            let is_mine = a > 0 || (a == 0 && b > 0);
            Edge {
                a,
                b,
                c: if is_mine { c } else { c - 1 },
            }
        };
        let [dp, dq] = [p, q].map(|c| f64::from(c.depth) - f64::from(o.depth));
        let [ux, uy, vx, vy] = [u[0], u[1], v[0], v[1]].map(|x| x as f64);
        let area = area as f64;
        Some(Self {
            edges: [edge([0; 2], u), edge(u, v), edge(v, [0; 2])],
            limits: [x0, y0, x1, y1],
            origin: o.at.map(i64::from),
            depth: f64::from(o.depth),
            slope: [(dp * vy - dq * uy) / area, (dq * ux - dp * vx) / area],
            nearest: o.depth.min(p.depth).min(q.depth),
            farthest: o.depth.max(p.depth).max(q.depth),
        })
    }

    /// Whether a sample of a pixel is in the triangle.
    fn is_inside(&self, x: u32, y: u32, sample: usize) -> bool {
        let (from, aside) = (self.from(x, y), PLACES[sample].map(i64::from));
        let [x, y] = [from[0] + aside[0], from[1] + aside[1]];
        self.edges.iter().all(|e| e.a * x + e.b * y + e.c >= 0)
    }

    /// The middle of a pixel, from the first corner.
    fn from(&self, x: u32, y: u32) -> [i64; 2] {
        let middle = |x: u32| i64::from(x) * i64::from(GRID) + i64::from(GRID) / 2;
        [middle(x) - self.origin[0], middle(y) - self.origin[1]]
    }
}
