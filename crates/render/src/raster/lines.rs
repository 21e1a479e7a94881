//! Draws lines over triangles. Lines have a constant width and round ends, and are hidden where a triangle is in front
//! of them.
//!
//! To decide whether a line is visible at a sample, the depth of the line is compared with the depth of the surface.
//! Both depths are taken at the point of the line's axis that is nearest to the sample. The depth of the surface at
//! this point is computed from the plane of the triangle that is visible at the sample. Therefore a thick line on a
//! slanted surface is visible in its full width, although one side of the line is behind the surface.
//!
//! A hidden point is drawn as a ring, because a faint disc would look like a stain on the surface.

use glam::{DVec2, DVec3};

use super::TILE;
use super::project::GRID;
use super::shade::Shader;
use super::tile::{NO_TRIANGLE, OFFSETS, Planes, Tile};
use crate::View;
use crate::color::whole_u32;
use crate::drawing::{Drawing, Line};
use crate::work::map_indices;

/// The width of the ring of a hidden point, as a fraction of the radius of the point.
const RING: f64 = 0.35;
/// The minimum width of the ring of a hidden point, in pixels.
const MIN_RING: f64 = 1.2;

/// The maximum width of a line, as a fraction of the distance to neighboring lines. At this maximum, the edges of
/// equilateral triangles cover about half of the surface. The covered fraction is 2 √3 w if edges have length 1 and
/// width w.
const MAX_RELATIVE_WIDTH: f64 = 0.15;

/// A line, projected to the picture.
pub(super) struct ProjectedLine {
    /// The ends in pixels.
    ends: [DVec2; 2],
    /// The depths of the ends.
    depths: [f64; 2],
    /// Half the width in pixels.
    radius: f64,
    /// The vector from the first end to the second, divided by the square of its length; zero for a point.
    scaled: DVec2,
}

/// Projects all lines. The result is `None` for each line that is not drawn.
pub(super) fn project(drawing: &Drawing, view: &View) -> Vec<Option<ProjectedLine>> {
    map_indices(drawing.lines.len(), |i| {
        project_line(&drawing.lines[i], view)
    })
}

/// Projects a line. Returns `None` if the line is behind the camera, has no width, or has an end that is not finite.
fn project_line(line: &Line, view: &View) -> Option<ProjectedLine> {
    let [a, b] = line.ends.map(|p| view.camera_space(p));
    let [da, db] = [a, b].map(|v| view.clip_distance(0, 0.0, v));
    if da < 0.0 && db < 0.0 {
        return None;
    }
    let clip = |[a, b]: [DVec3; 2], [da, db]: [f64; 2]| {
        if da >= 0.0 {
            return a;
        }
        let mut clipped = b + (a - b) * (db / (db - da));
        clipped.z = view.near;
        clipped
    };
    let points = [clip([a, b], [da, db]), clip([b, a], [db, da])].map(|v| view.project(v));
    let ends = points.map(|p| p.at);
    let length_squared = ends[0].distance_squared(ends[1]);
    let pixel = view.pixel_size(0.5 * points[0].depth + 0.5 * points[1].depth);
    let width = f64::from(line.width).min(MAX_RELATIVE_WIDTH * line.spacing / pixel);
    let projected = ProjectedLine {
        ends,
        depths: points.map(|p| p.depth),
        radius: 0.5 * width,
        scaled: if length_squared > 0.0 {
            (ends[1] - ends[0]) / length_squared
        } else {
            DVec2::ZERO
        },
    };
    (ends.iter().all(|p| p.is_finite()) && projected.radius > 0.0).then_some(projected)
}

/// Returns the bounding box of a line in pixels: left, top, right and bottom.
pub(super) fn limits(line: &ProjectedLine) -> [f64; 4] {
    let [a, b] = line.ends;
    let (min, max) = (a.min(b) - line.radius, a.max(b) + line.radius);
    [min.x, min.y, max.x, max.y]
}

impl ProjectedLine {
    /// Returns the parameter, from 0 to 1, of the point of the line that is nearest to `p`.
    fn nearest(&self, p: DVec2) -> f64 {
        (p - self.ends[0]).dot(self.scaled).clamp(0.0, 1.0)
    }

    /// Returns the point at a parameter.
    fn point(&self, t: f64) -> DVec2 {
        self.ends[0] + (self.ends[1] - self.ends[0]) * t
    }

    /// Returns the distance of `p` to the axis of the line.
    fn distance(&self, p: DVec2) -> f64 {
        p.distance(self.point(self.nearest(p)))
    }
}

/// Draws a line into a tile.
pub(super) fn draw(tile: &mut Tile, number: u32, projected: &ProjectedLine, shader: &Shader) {
    let line = &shader.drawing.lines[number as usize];
    let corner = DVec2::new(f64::from(tile.left), f64::from(tile.top));
    let half = f64::from(TILE) / 2.0;
    if projected.distance(corner + half) > half * std::f64::consts::SQRT_2 + projected.radius {
        return;
    }
    let [left, top, right, bottom] = limits(projected);
    let pixel = |x: f64, low: u32, high: u32| whole_u32(x.clamp(low.into(), (high - 1).into()));
    let [x0, x1] = [left, right].map(|x| pixel(x, tile.left, tile.right));
    let [y0, y1] = [top, bottom].map(|y| pixel(y, tile.top, tile.bottom));
    let radius_squared = projected.radius * projected.radius;
    let is_point = projected.scaled == DVec2::ZERO;
    let ring_inner_radius = if is_point {
        (projected.radius - MIN_RING.max(RING * projected.radius)).max(0.0)
    } else {
        0.0
    };
    for y in y0..=y1 {
        for x in x0..=x1 {
            let middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            if projected.distance(middle) > projected.radius + std::f64::consts::FRAC_1_SQRT_2 {
                continue;
            }
            let index = tile.index(x, y);
            for (k, offset) in OFFSETS.iter().enumerate() {
                let [dx, dy] = offset.map(|d| f64::from(d) / f64::from(GRID));
                let p = middle + DVec2::new(dx, dy);
                let t = projected.nearest(p);
                let distance_squared = p.distance_squared(projected.point(t));
                if distance_squared > radius_squared {
                    continue;
                }
                let sample = (tile.triangles[index][k], tile.depth[index][k]);
                let is_visible = projected.is_visible(line, shader, sample, t, &mut tile.planes);
                let entry = &mut tile.lines[index][k];
                if is_visible {
                    *entry = 2 * number + 2;
                } else if line.hidden > 0.0
                    && distance_squared >= ring_inner_radius * ring_inner_radius
                    && (*entry == 0 || *entry & 1 == 1)
                {
                    *entry = 2 * number + 3;
                }
            }
        }
    }
}

impl ProjectedLine {
    /// Whether the point of the line at parameter `t` is in front of the triangle that is visible at a sample. The
    /// argument `triangle_depth` is the depth of the triangle at the sample. The faces beside the line never hide the
    /// line.
    fn is_visible(
        &self,
        line: &Line,
        shader: &Shader,
        (triangle, triangle_depth): (u32, f32),
        t: f64,
        planes: &mut Planes,
    ) -> bool {
        if triangle == NO_TRIANGLE {
            return true;
        }
        let [d0, d1] = self.depths;
        let depth = d0 + (d1 - d0) * t;
        let view = shader.view;
        // On a curved surface, the surface beside a line can be nearer to the camera than the line. The line stays
        // visible if the difference is less than `bias`.
        let bias = view.pixel_size(depth) * (1.0 + self.radius);
        let limit = depth - view.depth_change(bias, depth);
        if f64::from(triangle_depth) >= limit {
            return true;
        }
        let n = planes.len();
        let entry = &mut planes[triangle as usize % n];
        if entry.is_none_or(|(id, ..)| id != triangle) {
            *entry = None;
        }
        let (_, (face, p, n)) = *entry.get_or_insert_with(|| (triangle, shader.plane(triangle)));
        if line.faces.contains(&face) {
            return true;
        }
        let surface = view.plane_depth(p, n, self.point(t));
        surface.is_none_or(|surface| surface >= limit)
    }
}
