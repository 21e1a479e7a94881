//! Computes ambient occlusion: surfaces are darker where less of their surroundings is visible from them.
//!
//! Depth maps are drawn from directions that are spread evenly over the sphere. Each depth map stores the nearest and
//! the farthest depth, so it serves two opposite directions. The openness of a point is the weighted mean of its
//! visibility in all depth maps. This number does not depend on the camera and has no noise. Surfaces with an alpha
//! below one half, or with a texture that is not opaque, do not reduce the openness.

use std::borrow::Cow;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::PictureError;
use crate::drawing::{Drawing, Part, Surface};

/// The number of depth maps. Each depth map serves two opposite directions.
const MAPS: usize = 48;
/// The maximum width and height of a depth map in texels.
const MAX_SIDE: u32 = 256;
/// The minimum width and height of a depth map in texels.
const MIN_SIDE: u32 = 64;

/// Returns the width and height of a depth map in texels, for a picture of this size.
fn side([width, height]: [u32; 2]) -> u32 {
    (width.max(height) / 3).clamp(MIN_SIDE, MAX_SIDE)
}

/// Returns the number of bytes of all depth maps for a picture of this size.
pub(super) fn bytes(size: [u32; 2]) -> u64 {
    8 * MAPS as u64 * u64::from(side(size)) * u64::from(side(size))
}

/// Depth maps from all directions.
pub(super) struct Occlusion {
    center: DVec3,
    /// The size of a texel in scene units.
    texel: f64,
    side: usize,
    maps: Vec<Map>,
}

struct Map {
    /// The directions in which columns, rows, and depth increase.
    axes: [Vec3; 3],
    /// For each texel, the largest depth in the direction of the depth map, and the largest depth in the opposite
    /// direction. The largest depth in the opposite direction is the negative of the smallest depth.
    depths: Vec<[f32; 2]>,
}

/// Returns one of the evenly spread directions of a hemisphere: Swinbank and Purser, "Fibonacci grids", 2006.
fn direction(i: usize) -> DVec3 {
    // Consecutive directions differ by the golden angle.
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt()) * i as f64;
    let z = 1.0 - (i as f64 + 0.5) / MAPS as f64;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(turn);
    DVec3::new(r * cos, r * sin, z)
}

impl Occlusion {
    /// Draws the depth maps. When a map is complete, `map_done` is called with the total number of maps.
    pub(super) fn new(
        drawing: &Drawing,
        size: [u32; 2],
        map_done: impl Fn(u64) -> Result<(), PictureError> + Sync,
    ) -> Result<Self, PictureError> {
        let all_points = |each: &mut dyn FnMut(DVec3)| {
            for part in &drawing.parts {
                part.points.iter().for_each(|&p| each(p));
            }
        };
        let (center, radius) = crate::camera::sphere(&all_points);
        let side = side(size) as usize;
        // The bounding sphere of the scene is `side - 2` texels wide, so that the texels at the border of a depth map
        // stay empty.
        let texel = 2.0 * radius / (side - 2) as f64;
        let parts = drawing.parts.iter();
        let to_draw: Vec<_> = parts
            .map(|part| triangles_to_draw(part, texel * SMALL_EDGE))
            .collect();
        let maps = (0..MAPS)
            .into_par_iter()
            .map(|i| {
                let z = direction(i);
                let x = z.any_orthonormal_vector();
                let axes = [x, z.cross(x), z].map(DVec3::as_vec3);
                let mut depths = vec![[f32::NEG_INFINITY; 2]; side * side];
                let mut points = Vec::new();
                for (part, (triangles, has_small)) in drawing.parts.iter().zip(&to_draw) {
                    points.clear();
                    let half = side as f32 / 2.0;
                    points.extend(part.points.iter().map(|&p| {
                        let p = ((p - center) / texel).as_vec3();
                        let step = |axis: Vec3| step(axis.dot(p) + half);
                        MapPoint {
                            at: [step(axes[0]), step(axes[1])],
                            depth: axes[2].dot(p),
                        }
                    }));
                    if *has_small {
                        for &p in &points {
                            draw_point(&mut depths, side, p);
                        }
                    }
                    for triangle in triangles.iter() {
                        draw_triangle(&mut depths, side, triangle.map(|v| points[v as usize]));
                    }
                }
                map_done(MAPS as u64)?;
                Ok(Map { axes, depths })
            })
            .collect::<Result<_, PictureError>>()?;
        Ok(Self {
            center,
            texel,
            side,
            maps,
        })
    }

    /// Returns the fraction of the surroundings that is visible from a point with this unit normal, from 0 (none) to 1
    /// (all). Each direction is weighted by the cosine of its angle to the normal.
    pub(super) fn openness(&self, p: DVec3, normal: DVec3) -> f32 {
        // The point is moved away from its surface. Otherwise, the surface could hide its own points, because the
        // resolution of the maps is limited.
        let p = ((p - self.center) / self.texel + normal * 2.0).as_vec3();
        let n = normal.as_vec3();
        let half = self.side as f32 / 2.0 - 0.5;
        let (mut openness, mut all) = (0.0, 0.0);
        for map in &self.maps {
            let cosine = map.axes[2].dot(n);
            let weight = cosine.abs();
            all += weight;
            let depth = map.axes[2].dot(p);
            let (x, y) = (map.axes[0].dot(p) + half, map.axes[1].dot(p) + half);
            let limit = (self.side - 2) as f32;
            let (x, y) = (x.clamp(0.0, limit), y.clamp(0.0, limit));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the point is inside the map"
            )]
            let (column, row) = (x as usize, y as usize);
            let (s, t) = (x - column as f32, y - row as f32);
            let index = row * self.side + column;
            // A point at the stored depth or in front of it is visible. Behind the stored depth, visibility decreases
            // linearly to 0 over 6 texels of depth. Visibility is interpolated between four texels.
            let (side, depth) = if cosine > 0.0 {
                (0, depth)
            } else {
                (1, -depth)
            };
            let visible = |index: usize| {
                let difference = map.depths[index][side] - depth;
                (1.0 - difference / 6.0).clamp(0.0, 1.0)
            };
            let upper = visible(index) * (1.0 - s) + visible(index + 1) * s;
            let next_row = index + self.side;
            let lower = visible(next_row) * (1.0 - s) + visible(next_row + 1) * s;
            openness += weight * (upper * (1.0 - t) + lower * t);
        }
        if all > 0.0 { openness / all } else { 1.0 }
    }
}

/// If all edges of a triangle are shorter than this number of texels, only the corners of the triangle are drawn. All
/// points of such a small triangle are within half a texel of the nearest corner. Therefore the corners cover all
/// texels whose middles the triangle covers.
const SMALL_EDGE: f64 = 0.85;

/// Returns the triangles of a part that are drawn into the depth maps, and whether the points of the part are drawn
/// too. Triangles whose edges are all shorter than `length` are left out, because the points of the part are drawn
/// instead. If the part has transparent surfaces, returns all triangles of its opaque surfaces, and `false`.
fn triangles_to_draw<'a>(part: &'a Part, length: f64) -> (Cow<'a, [[u32; 3]]>, bool) {
    let has_transparent = part.materials.iter().any(Surface::is_transparent);
    let is_drawn = |&i: &usize| {
        if has_transparent {
            let surface = part.materials.get(part.surface_index(i));
            return !surface.is_some_and(Surface::is_transparent);
        }
        let [a, b, c] = part.corners_at(i);
        let is_long = |edge: &DVec3| edge.length_squared() >= length * length;
        [a - b, b - c, c - a].iter().any(is_long)
    };
    let triangles = (0..part.triangles.len()).into_par_iter().with_min_len(4096);
    let to_draw = triangles.filter(is_drawn).map(|i| part.triangles[i]);
    let to_draw: Vec<[u32; 3]> = to_draw.collect();
    if to_draw.len() == part.triangles.len() {
        (Cow::Borrowed(&part.triangles), false)
    } else {
        (Cow::Owned(to_draw), !has_transparent)
    }
}

/// Draws a point into a depth map.
fn draw_point(depths: &mut [[f32; 2]], side: usize, p: MapPoint) {
    let [column, row] =
        p.at.map(|x| usize::try_from(x / STEPS).unwrap_or(0).min(side - 1));
    let [front, back] = &mut depths[row * side + column];
    *front = front.max(p.depth);
    *back = back.max(-p.depth);
}

/// The number of grid steps per texel of a depth map.
const STEPS: i32 = 256;

/// A point in a depth map.
#[derive(Clone, Copy)]
struct MapPoint {
    /// The distances from the corner of the depth map, in grid steps.
    at: [i32; 2],
    depth: f32,
}

/// Converts texels to grid steps. A point is outside of the depth map only if its coordinates are so large that the
/// radius of the bounding sphere overflows.
fn step(texels: f32) -> i32 {
    let max = MAX_SIDE as f32;
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the point is inside the map"
    )]
    let step = (texels.clamp(0.0, max) * STEPS as f32) as i32;
    step
}

/// Draws a triangle into a depth map: into each texel whose middle lies in the triangle.
fn draw_triangle(depths: &mut [[f32; 2]], side: usize, [a, b, c]: [MapPoint; 3]) {
    let range = |i: usize| {
        let [p, q, r] = [a, b, c].map(|corner| corner.at[i]);
        let (min, max) = (p.min(q).min(r), p.max(q).max(r));
        (min + STEPS / 2 - 1) / STEPS..(max + STEPS / 2) / STEPS
    };
    let (columns, rows) = (range(0), range(1));
    if columns.is_empty() || rows.is_empty() {
        return;
    }
    let from_a = |p: MapPoint| [0, 1].map(|i| (p.at[i] - a.at[i]) as f32);
    let ([ux, uy], [vx, vy]) = (from_a(b), from_a(c));
    let area = ux * vy - uy * vx;
    if area == 0.0 {
        return;
    }
    let (du, dv) = ((b.depth - a.depth) / area, (c.depth - a.depth) / area);
    let last = side - 1;
    for row in rows {
        let y = (row * STEPS + STEPS / 2 - a.at[1]) as f32;
        for column in columns.clone() {
            let x = (column * STEPS + STEPS / 2 - a.at[0]) as f32;
            // The middle of the texel forms a triangle with the side opposite to b, and another with the side opposite
            // to c. `s` and `t` are twice the signed areas of these two triangles.
            let (s, t) = (x * vy - y * vx, ux * y - uy * x);
            let rest = area - s - t;
            let is_inside = if area > 0.0 {
                s >= 0.0 && t >= 0.0 && rest >= 0.0
            } else {
                s <= 0.0 && t <= 0.0 && rest <= 0.0
            };
            if is_inside {
                let depth = a.depth + s * du + t * dv;
                let index = |i: i32| usize::try_from(i).unwrap_or(0).min(last);
                let [front, back] = &mut depths[index(row) * side + index(column)];
                *front = front.max(depth);
                *back = back.max(-depth);
            }
        }
    }
}
