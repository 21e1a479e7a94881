//! Which samples a triangle covers that is not opaque: as many as its alpha says, others for each surface, so that
//! one is seen through another.

use glam::DVec2;

use super::project::GRID;
use super::shade::{Facts, Shader, surface_place};
use super::tile::{PLACES, SAMPLES, mask_of};
use crate::View;
use crate::color::whole;
use crate::texture::Texture;

/// What a triangle covers.
pub(super) enum Cover<'a> {
    /// These samples of every pixel.
    Same(u16),
    /// What its texture leaves.
    Textured(Box<Textured<'a>>),
}

/// A triangle whose texture has holes.
pub(super) struct Textured<'a> {
    view: &'a View,
    texture: &'a Texture,
    facts: Facts,
    /// Texture coordinates of the corners.
    uvs: [DVec2; 3],
    /// Of the material.
    alpha: f32,
    turn: usize,
    /// The last pixel, and how far apart its samples are in the texture.
    pixel: Option<([u32; 2], [DVec2; 2])>,
}

impl<'a> Shader<'a> {
    /// Which samples a triangle may cover.
    pub(super) fn cover(&self, id: u32) -> Cover<'a> {
        let (index, triangle) = self.find(id);
        let part = &self.drawing.parts[index];
        let place = surface_place(part, triangle);
        let Some(surface) = part.materials.get(place) else {
            return Cover::Same(u16::MAX);
        };
        let alpha = surface.color[3];
        let holed = surface.texture.as_ref().filter(|t| !t.is_opaque());
        let uvs = part.uvs.get(surface.uv_set);
        let corners = part.corners_at(triangle);
        let [a, b, c] = corners;
        let is_back = (b - a).cross(c - a).dot(self.view.axes()[2]) < 0.0;
        let turn = 5 * (index + place) + if is_back { 8 } else { 0 };
        match (holed, uvs) {
            (Some(texture), Some(uvs)) if alpha > 0.0 => Cover::Textured(Box::new(Textured {
                view: self.view,
                texture,
                facts: Facts::new(index, triangle, corners),
                uvs: part.corners[triangle].map(|c| uvs[c as usize]),
                alpha,
                turn,
                pixel: None,
            })),
            _ => {
                let n = n_covered(alpha);
                Cover::Same(mask_of(|k| rank(k, turn) < n))
            }
        }
    }
}

impl Textured<'_> {
    /// Whether the triangle is there at a sample of a pixel.
    pub(super) fn covers(&mut self, pixel: [u32; 2], sample: usize) -> bool {
        let middle = DVec2::new(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5);
        let beside = match self.pixel {
            Some((last, beside)) if last == pixel => beside,
            _ => {
                // 16 samples a pixel are as far apart as those of a picture four times as large.
                let here = self.uv(middle);
                let beside = [DVec2::X, DVec2::Y].map(|step| {
                    let there = self.uv(middle + 0.25 * step);
                    here.zip(there).map_or(DVec2::ZERO, |(p, q)| q - p)
                });
                self.pixel = Some((pixel, beside));
                beside
            }
        };
        let [x, y] = PLACES[sample].map(|d| f64::from(d) / f64::from(GRID));
        let Some(uv) = self.uv(middle + DVec2::new(x, y)) else {
            return true;
        };
        let coverage = self.texture.coverage(uv, beside);
        rank(sample, self.turn) < n_covered(coverage * self.alpha)
    }

    /// The texture coordinates at a place of the picture; `None` if the triangle is seen from its edge.
    fn uv(&self, at: DVec2) -> Option<DVec2> {
        let (origin, direction) = self.view.ray(at);
        let [u, v, w] = self.facts.barycentric(origin, direction)?;
        Some(self.uvs[0] * u + self.uvs[1] * v + self.uvs[2] * w)
    }
}

/// How many of the samples are covered at a coverage from 0 to 1.
fn n_covered(coverage: f32) -> usize {
    whole(f64::from(coverage.clamp(0.0, 1.0) * SAMPLES as f32 + 0.5))
}

/// How many samples are covered before this one: the first few are spread over the pixel, every seventh in turn.
fn rank(sample: usize, turn: usize) -> usize {
    // 7 is its own inverse, modulo 16.
    (sample + SAMPLES - turn % SAMPLES) * 7 % SAMPLES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_has_a_rank_of_its_own() {
        for turn in 0..40 {
            let mut ranks: Vec<usize> = (0..SAMPLES).map(|k| rank(k, turn)).collect();
            assert_eq!(ranks[(3 * 7 + turn) % SAMPLES], 3);
            ranks.sort_unstable();
            assert_eq!(ranks, (0..SAMPLES).collect::<Vec<_>>());
        }
    }
}
