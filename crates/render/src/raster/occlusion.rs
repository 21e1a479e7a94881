//! Ambient occlusion: how much of its surroundings a place on the surface sees.
//!
//! Depth maps are drawn from directions that are spread evenly over the sphere; each map keeps the nearest
//! and the farthest depth, and so serves two opposite directions. A place is then looked up in all maps. It
//! does not depend on the camera, and there is no noise. What is see-through hides nothing.

use std::borrow::Cow;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::shade::surface_place;
use crate::PictureError;
use crate::drawing::{Drawing, Part, Surface};

/// Maps, each for two opposite directions.
const MAPS: usize = 48;
/// A depth map has at most so many texels along each side.
const LARGEST: u32 = 256;
/// And at least so many.
const SMALLEST: u32 = 64;

/// Texels of a map along each side, for a picture of this size.
fn side([width, height]: [u32; 2]) -> u32 {
    (width.max(height) / 3).clamp(SMALLEST, LARGEST)
}

/// The bytes of the maps for a picture of this size.
pub(super) fn bytes(size: [u32; 2]) -> u64 {
    8 * MAPS as u64 * u64::from(side(size)) * u64::from(side(size))
}

/// Depth maps from all sides.
pub(super) struct Occlusion {
    center: DVec3,
    /// A texel in scene units.
    texel: f64,
    side: usize,
    maps: Vec<Map>,
}

struct Map {
    /// The directions of its columns, of its rows, and of depth.
    axes: [Vec3; 3],
    /// The largest depth in each texel, and the largest seen from the other side: minus the least.
    depths: Vec<[f32; 2]>,
}

/// Evenly spread directions of half a sphere: Swinbank and Purser, "Fibonacci grids", 2006.
fn direction(i: usize) -> DVec3 {
    // The golden angle.
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt()) * i as f64;
    let z = 1.0 - (i as f64 + 0.5) / MAPS as f64;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(turn);
    DVec3::new(r * cos, r * sin, z)
}

impl Occlusion {
    /// `map_done` is told how many maps there are whenever one of them is done.
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
        // One texel stays free at each border.
        let texel = 2.0 * radius / (side - 2) as f64;
        let parts = drawing.parts.iter();
        let drawn: Vec<_> = parts.map(|part| drawn(part, texel * SMALL)).collect();
        let maps = (0..MAPS)
            .into_par_iter()
            .map(|i| {
                let z = direction(i);
                let x = z.any_orthonormal_vector();
                let axes = [x, z.cross(x), z].map(DVec3::as_vec3);
                let mut depths = vec![[f32::NEG_INFINITY; 2]; side * side];
                let mut places = Vec::new();
                for (part, (triangles, has_small)) in drawing.parts.iter().zip(&drawn) {
                    places.clear();
                    let half = side as f32 / 2.0;
                    places.extend(part.points.iter().map(|&p| {
                        let p = ((p - center) / texel).as_vec3();
                        let step = |axis: Vec3| step(axis.dot(p) + half);
                        Place {
                            at: [step(axes[0]), step(axes[1])],
                            depth: axes[2].dot(p),
                        }
                    }));
                    if *has_small {
                        for &p in &places {
                            dot_at(&mut depths, side, p);
                        }
                    }
                    for triangle in triangles.iter() {
                        fill(&mut depths, side, triangle.map(|v| places[v as usize]));
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

    /// How much of its surroundings a place with a unit normal sees, weighted by the cosine: 0 for none, 1
    /// for all.
    pub(super) fn open(&self, p: DVec3, normal: DVec3) -> f32 {
        // Away from its own surface, which the maps know to a texel only.
        let p = ((p - self.center) / self.texel + normal * 2.0).as_vec3();
        let n = normal.as_vec3();
        let half = self.side as f32 / 2.0 - 0.5;
        let (mut open, mut all) = (0.0, 0.0);
        for map in &self.maps {
            let along = map.axes[2].dot(n);
            let weight = along.abs();
            all += weight;
            let depth = map.axes[2].dot(p);
            let (x, y) = (map.axes[0].dot(p) + half, map.axes[1].dot(p) + half);
            let limit = (self.side - 2) as f32;
            let (x, y) = (x.clamp(0.0, limit), y.clamp(0.0, limit));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "inside the map"
            )]
            let (column, row) = (x as usize, y as usize);
            let (s, t) = (x - column as f32, y - row as f32);
            let at = row * self.side + column;
            // Softly, over some texels of depth, and between four texels.
            let (side, depth) = if along > 0.0 { (0, depth) } else { (1, -depth) };
            let seen = |place: usize| {
                let before = map.depths[place][side] - depth;
                (1.0 - before / 6.0).clamp(0.0, 1.0)
            };
            let upper = seen(at) * (1.0 - s) + seen(at + 1) * s;
            let lower = seen(at + self.side) * (1.0 - s) + seen(at + self.side + 1) * s;
            open += weight * (upper * (1.0 - t) + lower * t);
        }
        if all > 0.0 { open / all } else { 1.0 }
    }
}

/// Texels. No place in a triangle with shorter edges is farther from its nearest corner than half a texel: its
/// corners alone cover all texels whose middles it covers.
const SMALL: f64 = 0.85;

/// The triangles of a part that are drawn into maps, and whether its points are drawn for the others: those without an
/// edge of at least this length. Of a part with surfaces that hide little of what is behind them, all triangles of
/// the other surfaces.
fn drawn<'a>(part: &'a Part, length: f64) -> (Cow<'a, [[u32; 3]]>, bool) {
    let has_see_through = part.materials.iter().any(Surface::is_see_through);
    let is_drawn = |&i: &usize| {
        if has_see_through {
            let surface = part.materials.get(surface_place(part, i));
            return !surface.is_some_and(Surface::is_see_through);
        }
        let [a, b, c] = part.corners_at(i);
        let is_long = |edge: &DVec3| edge.length_squared() >= length * length;
        [a - b, b - c, c - a].iter().any(is_long)
    };
    let triangles = (0..part.triangles.len()).into_par_iter().with_min_len(4096);
    let drawn = triangles.filter(is_drawn).map(|i| part.triangles[i]);
    let drawn: Vec<[u32; 3]> = drawn.collect();
    if drawn.len() == part.triangles.len() {
        (Cow::Borrowed(&part.triangles), false)
    } else {
        (Cow::Owned(drawn), !has_see_through)
    }
}

/// Draws a point into a depth map.
fn dot_at(depths: &mut [[f32; 2]], side: usize, p: Place) {
    let [column, row] =
        p.at.map(|x| usize::try_from(x / STEPS).unwrap_or(0).min(side - 1));
    let [front, back] = &mut depths[row * side + column];
    *front = front.max(p.depth);
    *back = back.max(-p.depth);
}

/// Steps of a texel in a depth map.
const STEPS: i32 = 256;

/// A point in a depth map.
#[derive(Clone, Copy)]
struct Place {
    /// Steps from the corner.
    at: [i32; 2],
    depth: f32,
}

/// The step at a number of texels. Points are inside the map, unless their coordinates are so large that there
/// is no sphere around them.
fn step(texels: f32) -> i32 {
    let most = LARGEST as f32;
    #[expect(clippy::cast_possible_truncation, reason = "inside the map")]
    let step = (texels.clamp(0.0, most) * STEPS as f32) as i32;
    step
}

/// Draws a triangle into a depth map: the texels whose middles it covers.
fn fill(depths: &mut [[f32; 2]], side: usize, [a, b, c]: [Place; 3]) {
    let range = |i: usize| {
        let [p, q, r] = [a, b, c].map(|corner| corner.at[i]);
        let (min, max) = (p.min(q).min(r), p.max(q).max(r));
        (min + STEPS / 2 - 1) / STEPS..(max + STEPS / 2) / STEPS
    };
    let (columns, rows) = (range(0), range(1));
    if columns.is_empty() || rows.is_empty() {
        return;
    }
    let from_a = |p: Place| [0, 1].map(|i| (p.at[i] - a.at[i]) as f32);
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
            // Twice the areas beside b and c.
            let (s, t) = (x * vy - y * vx, ux * y - uy * x);
            let rest = area - s - t;
            let is_inside = if area > 0.0 {
                s >= 0.0 && t >= 0.0 && rest >= 0.0
            } else {
                s <= 0.0 && t <= 0.0 && rest <= 0.0
            };
            if is_inside {
                let depth = a.depth + s * du + t * dv;
                let place = |i: i32| usize::try_from(i).unwrap_or(0).min(last);
                let [front, back] = &mut depths[place(row) * side + place(column)];
                *front = front.max(depth);
                *back = back.max(-depth);
            }
        }
    }
}
