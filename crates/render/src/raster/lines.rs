//! Lines over triangles: of constant width, with round ends, hidden where something is before them.
//!
//! A sample of a line is compared with the surface at the nearest place on its axis: the plane of the
//! triangle that the sample sees is continued to there. So a thick line on a slanted surface is seen from
//! border to border, though half of it lies behind that surface.
//!
//! What is hidden of a point is a ring: a faint disc would look like a stain on what is before it.

use glam::{DVec2, DVec3};

use super::TILE;
use super::project::GRID;
use super::shade::Shader;
use super::tile::{NOTHING, PLACES, Tile};
use crate::View;
use crate::color::whole_u32;
use crate::drawing::{Drawing, Line};
use crate::work::each;

/// The width of the ring that a hidden point is: a part of its radius, but so many pixels at least.
const RING: f64 = 0.35;
const LEAST_RING: f64 = 1.2;

/// The width of lines as a part of how far they are apart, at most. The sides of regular triangles of side 1 cover 2 √3
/// times their width: half of everything.
const FINE: f64 = 0.15;

/// A line in the picture.
pub(super) struct FlatLine {
    /// The ends in pixels.
    ends: [DVec2; 2],
    /// Their depths.
    depths: [f64; 2],
    /// Half the width in pixels.
    radius: f64,
    /// From the first end to the second, divided by the square of the length; zero for a point.
    scaled: DVec2,
}

/// Where lines are seen; `None` for those behind the camera.
pub(super) fn project(drawing: &Drawing, view: &View) -> Vec<Option<FlatLine>> {
    each(drawing.lines.len(), |i| flat(&drawing.lines[i], view))
}

fn flat(line: &Line, view: &View) -> Option<FlatLine> {
    let [a, b] = line.ends.map(|p| view.turned(p));
    let [da, db] = [a, b].map(|v| view.inside(0, 0.0, v));
    if da < 0.0 && db < 0.0 {
        return None;
    }
    let cut = |[a, b]: [DVec3; 2], [da, db]: [f64; 2]| {
        if da >= 0.0 {
            return a;
        }
        let mut cut = b + (a - b) * (db / (db - da));
        cut.z = view.near;
        cut
    };
    let seen = [cut([a, b], [da, db]), cut([b, a], [db, da])].map(|v| view.project(v));
    let ends = seen.map(|s| s.at);
    let length_squared = ends[0].distance_squared(ends[1]);
    let pixel = view.pixel(0.5 * seen[0].depth + 0.5 * seen[1].depth);
    let width = f64::from(line.width).min(FINE * line.room / pixel);
    let flat = FlatLine {
        ends,
        depths: seen.map(|s| s.depth),
        radius: 0.5 * width,
        scaled: if length_squared > 0.0 {
            (ends[1] - ends[0]) / length_squared
        } else {
            DVec2::ZERO
        },
    };
    (ends.iter().all(|p| p.is_finite()) && flat.radius > 0.0).then_some(flat)
}

/// The box of a line in pixels: left, top, right and bottom.
pub(super) fn limits(line: &FlatLine) -> [f64; 4] {
    let [a, b] = line.ends;
    let (min, max) = (a.min(b) - line.radius, a.max(b) + line.radius);
    [min.x, min.y, max.x, max.y]
}

impl FlatLine {
    /// How far along the line the place is that is nearest to `p`, from 0 to 1.
    fn along(&self, p: DVec2) -> f64 {
        (p - self.ends[0]).dot(self.scaled).clamp(0.0, 1.0)
    }

    fn place(&self, t: f64) -> DVec2 {
        self.ends[0] + (self.ends[1] - self.ends[0]) * t
    }

    fn distance(&self, p: DVec2) -> f64 {
        p.distance(self.place(self.along(p)))
    }
}

/// Draws a line into a tile.
pub(super) fn draw(tile: &mut Tile, number: u32, flat: &FlatLine, shader: &Shader) {
    let line = &shader.drawing.lines[number as usize];
    let corner = DVec2::new(f64::from(tile.left), f64::from(tile.top));
    let half = f64::from(TILE) / 2.0;
    if flat.distance(corner + half) > half * std::f64::consts::SQRT_2 + flat.radius {
        return;
    }
    let [left, top, right, bottom] = limits(flat);
    let pixel = |x: f64, low: u32, high: u32| whole_u32(x.clamp(low.into(), (high - 1).into()));
    let [x0, x1] = [left, right].map(|x| pixel(x, tile.left, tile.right));
    let [y0, y1] = [top, bottom].map(|y| pixel(y, tile.top, tile.bottom));
    let radius_squared = flat.radius * flat.radius;
    let is_point = flat.scaled == DVec2::ZERO;
    let hole = if is_point {
        (flat.radius - LEAST_RING.max(RING * flat.radius)).max(0.0)
    } else {
        0.0
    };
    for y in y0..=y1 {
        for x in x0..=x1 {
            let middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            if flat.distance(middle) > flat.radius + std::f64::consts::FRAC_1_SQRT_2 {
                continue;
            }
            let place = tile.place(x, y);
            for (k, place_of_sample) in PLACES.iter().enumerate() {
                let [dx, dy] = place_of_sample.map(|d| f64::from(d) / f64::from(GRID));
                let p = middle + DVec2::new(dx, dy);
                let t = flat.along(p);
                let distance_squared = p.distance_squared(flat.place(t));
                if distance_squared > radius_squared {
                    continue;
                }
                let seen = (tile.seen[place][k], tile.depth[place][k]);
                let is_seen = flat.is_seen(line, shader, seen, t, &mut tile.planes);
                let over = &mut tile.over[place][k];
                if is_seen {
                    *over = 2 * number + 2;
                } else if line.hidden > 0.0
                    && distance_squared >= hole * hole
                    && (*over == 0 || *over & 1 == 1)
                {
                    *over = 2 * number + 3;
                }
            }
        }
    }
}

/// The planes of triangles that were asked for lately: the triangle, its face, a point and a normal.
pub(super) type Planes = Vec<Option<(u32, (u32, DVec3, DVec3))>>;

impl FlatLine {
    /// Whether the line at `t` is before what a sample sees: a triangle at a depth.
    fn is_seen(
        &self,
        line: &Line,
        shader: &Shader,
        (seen, sample): (u32, f32),
        t: f64,
        planes: &mut Planes,
    ) -> bool {
        if seen == NOTHING {
            return true;
        }
        let [d0, d1] = self.depths;
        let depth = d0 + (d1 - d0) * t;
        let view = shader.view;
        // A curved surface comes forward beside its edges by less than this.
        let bias = view.pixel(depth) * (1.0 + self.radius);
        let limit = depth - view.depth_of(bias, depth);
        if f64::from(sample) >= limit {
            return true;
        }
        let n = planes.len();
        let entry = &mut planes[seen as usize % n];
        if entry.is_none_or(|(id, ..)| id != seen) {
            *entry = None;
        }
        let (_, (face, p, n)) = *entry.get_or_insert_with(|| (seen, shader.plane(seen)));
        if line.faces.contains(&face) {
            return true;
        }
        let surface = view.plane_depth(p, n, self.place(t));
        surface.is_none_or(|surface| surface >= limit)
    }
}
