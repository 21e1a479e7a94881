//! Finds the visible triangle for each sample of a tile of the picture.
//!
//! A pixel has 16 samples. Each of its 16 rows and each of its 16 columns contains exactly one sample (n-rooks:
//! Shirley, "Discrepancy as a Quality Measure for Sample Distributions", 1991). The arrangement of samples in `ROWS`
//! was found by a search. The search used many edges, in all directions, that cut a pixel. For each edge, it compared
//! the fraction of covered samples with the exact covered fraction of the pixel. Of all tested arrangements, this one
//! has the smallest difference between the two fractions.

use std::ops::{Add, BitOr, Mul, Sub};

use glam::DVec3;

use crate::color::narrow;

use super::project::{GRID, GRID_BITS, GridPoint, ProjectedTriangle};
use super::{Frame, TILE};

/// The number of samples per pixel.
pub(super) const SAMPLES: usize = 16;
/// The value that is stored instead of a triangle index for a sample without a triangle.
pub(super) const NO_TRIANGLE: u32 = u32::MAX;
/// The number of triangle planes that a tile caches.
const PLANES: usize = 512;
/// The row of the sample in each column.
const ROWS: [i32; SAMPLES] = [3, 11, 7, 15, 1, 6, 10, 13, 2, 5, 9, 14, 0, 8, 4, 12];
/// The offset of each sample from the middle of its pixel, in grid steps.
pub(super) const OFFSETS: [[i32; 2]; SAMPLES] = {
    let mut offsets = [[0; 2]; SAMPLES];
    let step = GRID / 16;
    let (mut column, mut k) = (0, 0);
    while k < SAMPLES {
        let start = step / 2 - GRID / 2;
        offsets[k] = [column * step + start, ROWS[k] * step + start];
        column += 1;
        k += 1;
    }
    offsets
};

/// The samples of a tile.
pub(super) struct Tile {
    /// The range of pixels of the tile. `right` and `bottom` are exclusive.
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) right: u32,
    pub(super) bottom: u32,
    /// For each pixel, the depth of the visible triangle at each of its samples. The depth is infinite if a sample has
    /// no triangle.
    pub(super) depth: Vec<[f32; SAMPLES]>,
    /// For each pixel, the visible triangle at each of its samples.
    pub(super) triangles: Vec<[u32; SAMPLES]>,
    /// For each pixel, a number at each of its samples. The number is 0 if no line covers the sample. If the line with
    /// index i covers the sample, the number is 2 i + 2 for a visible line, and 2 i + 3 for a hidden line.
    pub(super) lines: Vec<[u32; SAMPLES]>,
    /// A cache of the triangle planes that were used last.
    pub(super) planes: Planes,
}

/// A cache of the planes of triangles. Each entry has the index of the triangle, the index of its face, a point of the
/// plane and the normal.
pub(super) type Planes = Vec<Option<(u32, (u32, DVec3, DVec3))>>;

impl Tile {
    pub(super) fn new() -> Self {
        let n = (TILE * TILE) as usize;
        Self {
            left: 0,
            top: 0,
            right: 0,
            bottom: 0,
            depth: vec![[f32::INFINITY; SAMPLES]; n],
            triangles: vec![[NO_TRIANGLE; SAMPLES]; n],
            lines: vec![[0; SAMPLES]; n],
            planes: vec![None; PLANES],
        }
    }

    /// Clears all samples and moves to a tile of the picture.
    pub(super) fn begin(&mut self, frame: &Frame, column: u32, row: u32) {
        (self.left, self.top) = (column * TILE, row * TILE);
        self.right = (self.left + TILE).min(frame.width);
        self.bottom = (self.top + TILE).min(frame.height);
        self.depth.fill([f32::INFINITY; SAMPLES]);
        self.triangles.fill([NO_TRIANGLE; SAMPLES]);
        self.lines.fill([0; SAMPLES]);
    }

    /// Returns the index of a pixel in the arrays.
    pub(super) fn index(&self, x: u32, y: u32) -> usize {
        ((y - self.top) * TILE + (x - self.left)) as usize
    }

    /// Draws a triangle. At each sample that the new triangle covers, the new triangle replaces the current triangle if
    /// the new triangle is nearer to the camera. At the same depth, the triangle with the lower index is visible. Only
    /// samples whose bit is set in `mask` can be covered.
    pub(super) fn draw(&mut self, id: u32, projected: &ProjectedTriangle, mask: u16) {
        let Some(setup) = Setup::new(projected, self) else {
            return;
        };
        let [x0, y0, x1, y1] = setup.limits;
        if x0 > x1 || y0 > y1 {
            return;
        }
        // 32-bit arithmetic is exact if, in each axis, all corners are less than 32 pixels from the first corner.
        let first = projected[0].at;
        let is_near = |c: &GridPoint| (0..2).all(|i| c.at[i].abs_diff(first[i]) < 1 << 13);
        if mask == u16::MAX && projected.iter().all(is_near) {
            self.fill::<i32>(id, &setup, mask);
        } else {
            self.fill::<i64>(id, &setup, mask);
        }
    }

    /// Draws like [`Self::draw`], for a triangle that covers only the samples for which `covers` returns true. `covers`
    /// takes a pixel and the index of a sample.
    pub(super) fn draw_textured(
        &mut self,
        id: u32,
        projected: &ProjectedTriangle,
        mut covers: impl FnMut([u32; 2], usize) -> bool,
    ) {
        let Some(mut setup) = Setup::new(projected, self) else {
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
        reason = "without branches, the 16 samples are computed in parallel"
    )]
    fn fill<T: Number>(&mut self, id: u32, setup: &Setup, mask: u16) {
        let [x0, y0, x1, y1] = setup.limits;
        let edges = setup.edges.map(Edge::of::<T>);
        // For each edge function: its values at the samples minus its value at the middle of the pixel.
        let mut offsets = edges.map(|[a, b, _]| {
            OFFSETS.map(|[x, y]| a * T::of(i64::from(x)) + b * T::of(i64::from(y)))
        });
        for (k, offset) in offsets[0].iter_mut().enumerate() {
            if mask >> k & 1 == 0 {
                *offset = T::of(i64::MIN / 4);
            }
        }
        let max_offset = offsets.map(|edge| edge.into_iter().max().unwrap_or(T::of(0)));
        let [dx, dy] = setup.slope;
        let depth_offsets = OFFSETS.map(|[x, y]| narrow(dx * f64::from(x) + dy * f64::from(y)));
        let step = edges.map(|[a, _, _]| a * T::of(i64::from(GRID)));
        for y in y0..=y1 {
            let middle = setup.middle(x0, y);
            let mut e: [T; 3] = std::array::from_fn(|i| {
                let [a, b, c] = edges[i];
                c + a * T::of(middle[0]) + b * T::of(middle[1])
            });
            let mut depth = setup.depth + dx * middle[0] as f64 + dy * middle[1] as f64;
            let row = self.index(x0, y);
            let n = (x1 - x0 + 1) as usize;
            for index in row..row + n {
                let outside = (0..3).any(|i| e[i] + max_offset[i] < T::of(0));
                if !outside {
                    let inside: [T; SAMPLES] = std::array::from_fn(|k| {
                        (e[0] + offsets[0][k]) | (e[1] + offsets[1][k]) | (e[2] + offsets[2][k])
                    });
                    let d = narrow(depth);
                    let depths = &mut self.depth[index];
                    let triangles = &mut self.triangles[index];
                    for k in 0..SAMPLES {
                        let d = (d + depth_offsets[k])
                            .max(setup.nearest)
                            .min(setup.farthest);
                        let is_nearer = (d < depths[k]) | ((d == depths[k]) & (id < triangles[k]));
                        let is_visible = (inside[k] >= T::of(0)) & is_nearer;
                        depths[k] = if is_visible { d } else { depths[k] };
                        triangles[k] = if is_visible { id } else { triangles[k] };
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

/// An integer type for edge functions.
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
        reason = "the caller ensures that the value fits into the type"
    )]
    fn of(value: i64) -> Self {
        value as Self
    }
}

/// An edge function a x + b y + c, which is at least 0 inside of the triangle. The coordinates x and y are relative to
/// the first corner of the triangle.
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

/// Returns the bits of the samples for which `is_covered` is true.
pub(super) fn mask_of(mut is_covered: impl FnMut(usize) -> bool) -> u16 {
    (0..SAMPLES).fold(0, |mask, k| mask | u16::from(is_covered(k)) << k)
}

/// The data for filling a triangle.
struct Setup {
    edges: [Edge; 3],
    /// The part of the bounding box that lies in the tile: left, top, right and bottom, in pixels, inclusive.
    limits: [u32; 4],
    /// The first corner.
    origin: [i64; 2],
    /// The depth at the first corner.
    depth: f64,
    /// The change of depth per grid step to the right and downwards.
    slope: [f64; 2],
    /// The range of depths of the corners.
    nearest: f32,
    farthest: f32,
}

impl Setup {
    /// Prepares a triangle. Returns `None` if the triangle has zero area, or its bounding box is outside of the tile.
    fn new(projected: &ProjectedTriangle, tile: &Tile) -> Option<Self> {
        let [o, mut p, mut q] = *projected;
        let from_o = |c: GridPoint| [c.at[0] - o.at[0], c.at[1] - o.at[1]].map(i64::from);
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
        // The edge function of the edge from s to t is the cross product of t - s and (x, y) - s. The value of the edge
        // function is twice the signed area of the triangle that the edge forms with the point (x, y). The area is
        // positive if the triangle is clockwise, because y points downwards. A sample exactly on an edge belongs to the
        // triangle below or to the right of the edge.
        let edge = |s: [i64; 2], t: [i64; 2]| {
            let (a, b) = (s[1] - t[1], t[0] - s[0]);
            let c = -(a * s[0] + b * s[1]);
            let includes_edge = a > 0 || (a == 0 && b > 0);
            Edge {
                a,
                b,
                c: if includes_edge { c } else { c - 1 },
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
        let (middle, offset) = (self.middle(x, y), OFFSETS[sample].map(i64::from));
        let [x, y] = [middle[0] + offset[0], middle[1] + offset[1]];
        self.edges.iter().all(|e| e.a * x + e.b * y + e.c >= 0)
    }

    /// Returns the middle of a pixel, relative to the first corner.
    fn middle(&self, x: u32, y: u32) -> [i64; 2] {
        let middle = |x: u32| i64::from(x) * i64::from(GRID) + i64::from(GRID) / 2;
        [middle(x) - self.origin[0], middle(y) - self.origin[1]]
    }
}
