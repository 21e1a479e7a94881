//! Selects the samples of a pixel that a transparent triangle covers. The number of these samples is proportional to
//! alpha. The sample that is covered first differs for most surfaces, so that several transparent surfaces can be
//! visible in the same pixel.

use glam::DVec2;

use super::project::GRID;
use super::shade::{Shader, TriangleData};
use super::tile::{OFFSETS, SAMPLES, mask_of};
use crate::View;
use crate::color::whole;
use crate::texture::Texture;

/// The samples that a triangle can cover.
pub(super) enum Coverage<'a> {
    /// The same samples in every pixel, given by this bit mask.
    Same(u16),
    /// The samples depend on the texture.
    Textured(Box<Textured<'a>>),
}

/// A triangle with a texture that is not opaque.
pub(super) struct Textured<'a> {
    view: &'a View,
    texture: &'a Texture,
    data: TriangleData,
    /// The texture coordinates of the corners.
    uvs: [DVec2; 3],
    /// The alpha of the material.
    alpha: f32,
    /// The sample that is covered first if alpha is small; see [`rank`].
    rotation: usize,
    /// The last tested pixel, and the differences between the texture coordinates of neighboring samples in this pixel.
    last_pixel: Option<([u32; 2], [DVec2; 2])>,
}

impl<'a> Shader<'a> {
    /// Returns the samples of a pixel that a triangle can cover, according to its alpha and its texture.
    pub(super) fn coverage(&self, id: u32) -> Coverage<'a> {
        let (index, triangle) = self.locate(id);
        let part = &self.drawing.parts[index];
        let surface_index = part.surface_index(triangle);
        let Some(surface) = part.materials.get(surface_index) else {
            return Coverage::Same(u16::MAX);
        };
        let alpha = surface.color[3];
        let texture = surface.texture.as_ref().filter(|t| !t.is_opaque());
        let uvs = part.uvs.get(surface.uv_set);
        let corners = part.corners_at(triangle);
        let [a, b, c] = corners;
        let is_back = (b - a).cross(c - a).dot(self.view.axes()[2]) < 0.0;
        let rotation = 5 * (index + surface_index) + if is_back { 8 } else { 0 };
        match (texture, uvs) {
            (Some(texture), Some(uvs)) if alpha > 0.0 => Coverage::Textured(Box::new(Textured {
                view: self.view,
                texture,
                data: TriangleData::new(index, triangle, corners),
                uvs: part.corners[triangle].map(|c| uvs[c as usize]),
                alpha,
                rotation,
                last_pixel: None,
            })),
            _ => {
                let n = n_covered(alpha);
                Coverage::Same(mask_of(|k| rank(k, rotation) < n))
            }
        }
    }
}

impl Textured<'_> {
    /// Whether the alpha of the material and the texture is high enough to cover a sample of a pixel.
    pub(super) fn covers(&mut self, pixel: [u32; 2], sample: usize) -> bool {
        let middle = DVec2::new(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5);
        let steps = match self.last_pixel {
            Some((last, steps)) if last == pixel => steps,
            _ => {
                // With 16 samples per pixel, the mean distance between samples is a quarter of a pixel.
                let here = self.uv(middle);
                let steps = [DVec2::X, DVec2::Y].map(|step| {
                    let there = self.uv(middle + 0.25 * step);
                    here.zip(there).map_or(DVec2::ZERO, |(p, q)| q - p)
                });
                self.last_pixel = Some((pixel, steps));
                steps
            }
        };
        let [x, y] = OFFSETS[sample].map(|d| f64::from(d) / f64::from(GRID));
        let Some(uv) = self.uv(middle + DVec2::new(x, y)) else {
            return true;
        };
        let coverage = self.texture.coverage(uv, steps);
        rank(sample, self.rotation) < n_covered(coverage * self.alpha)
    }

    /// Returns the texture coordinates at a point of the picture; `None` if the triangle is seen edge-on.
    fn uv(&self, at: DVec2) -> Option<DVec2> {
        let (origin, direction) = self.view.ray(at);
        let [u, v, w] = self.data.barycentric(origin, direction)?;
        Some(self.uvs[0] * u + self.uvs[1] * v + self.uvs[2] * w)
    }
}

/// Returns the number of covered samples for a coverage from 0 to 1.
fn n_covered(coverage: f32) -> usize {
    whole(f64::from(coverage.clamp(0.0, 1.0) * SAMPLES as f32 + 0.5))
}

/// Returns the position of a sample in the order in which samples are covered. The order starts at the sample
/// `rotation` and goes in steps of 7 samples, so that the first few samples are spread over the pixel.
fn rank(sample: usize, rotation: usize) -> usize {
    // A multiplication by 7 undoes the steps of 7 samples, because the inverse of 7 modulo 16 is 7 itself.
    (sample + SAMPLES - rotation % SAMPLES) * 7 % SAMPLES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_a_permutation_of_the_samples() {
        for rotation in 0..40 {
            let mut ranks: Vec<usize> = (0..SAMPLES).map(|k| rank(k, rotation)).collect();
            assert_eq!(ranks[(3 * 7 + rotation) % SAMPLES], 3);
            ranks.sort_unstable();
            assert_eq!(ranks, (0..SAMPLES).collect::<Vec<_>>());
        }
    }
}
