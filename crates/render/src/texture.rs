//! Textures with mipmaps.
//!
//! Where colors are averaged, transparent pixels have less weight, so that the color of invisible pixels hardly bleeds
//! into visible ones. If alpha is ignored, all pixels have the same weight.

use glam::DVec2;
use scene::{Filter, Sampler, TextureTransform, Wrap};

use crate::Image;
use crate::color::{byte, mix, narrow, to_linear, to_srgb, whole};

/// An image that is mapped to a surface.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The levels of the mipmap. The first level is the image. Each further level has half the width and half the
    /// height of the previous level, rounded up.
    levels: Vec<Level>,
    sampler: Sampler,
    transform: TextureTransform,
    alpha: Alpha,
}

/// How the alpha of a texture affects the opacity of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Alpha {
    /// Alpha is ignored, and the surface is opaque.
    Ignored,
    /// The surface is opaque where alpha is at least this cutoff, and invisible elsewhere.
    Cut(f32),
    /// Alpha is the opacity of the surface.
    Blended,
}

/// A tolerance for rounding errors in the comparison of alpha with a cutoff.
const TOLERANCE: f32 = 1e-6;

/// The minimum weight of a color, so that fully transparent pixels have a color too.
const MIN_WEIGHT: f32 = 1.0 / 1024.0;

impl Alpha {
    /// Returns the fraction of a pixel that the surface covers. `alpha` is the alpha of the pixel. Level 0 is the image
    /// itself. In smaller levels, the alpha is already the covered fraction.
    fn coverage(self, level: usize, alpha: f32) -> f32 {
        match self {
            Self::Ignored => 1.0,
            Self::Cut(cutoff) if level == 0 => f32::from(u8::from(alpha >= cutoff - TOLERANCE)),
            Self::Cut(_) | Self::Blended => alpha,
        }
    }
}

#[derive(Clone, Debug)]
struct Level {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 4]>,
}

/// The part of a texture that one pixel of the picture shows.
struct Footprint {
    /// The position in the image. The image reaches from 0 to 1 in both axes.
    position: DVec2,
    /// The first of the two mipmap levels between which values are interpolated.
    level: usize,
    /// The weight of the second level.
    t: f32,
    /// Whether the nearest pixel is used, without interpolation.
    is_nearest: bool,
}

impl Texture {
    /// The maximum number of bytes for each pixel of the image: the pixel, and its share of the smaller levels.
    pub(crate) const BYTES: u64 = 6;
    /// The maximum number of bytes for each pixel of the image while it is decoded.
    pub(crate) const DECODING_BYTES: u64 = 12;

    /// Creates a texture from the bytes of a PNG or JPEG file. If all pixels are opaque, the parameter `alpha` has no
    /// effect.
    ///
    /// # Errors
    ///
    /// A message that says why the bytes cannot be read as an image.
    pub fn decode(
        bytes: &[u8],
        sampler: Sampler,
        transform: TextureTransform,
        alpha: Alpha,
    ) -> Result<Self, String> {
        let image = Image::decode(bytes).map_err(|error| error.to_string())?;
        let first = Level {
            width: image.width as usize,
            height: image.height as usize,
            pixels: image.pixels,
        };
        let is_opaque = first.pixels.iter().all(|p| p[3] == u8::MAX);
        let alpha = if is_opaque { Alpha::Ignored } else { alpha };
        let mut levels = vec![first];
        for level in 0.. {
            let Some(half) = levels[level].half(|a| alpha.coverage(level, unit(a))) else {
                break;
            };
            levels.push(half);
        }
        Ok(Self {
            levels,
            sampler,
            transform,
            alpha,
        })
    }

    /// Whether the whole texture is opaque.
    pub(crate) fn is_opaque(&self) -> bool {
        self.alpha == Alpha::Ignored
    }

    /// Returns linear red, green and blue at texture coordinates with v upwards. `steps` are the differences of the
    /// texture coordinates between this pixel of the picture and the next pixels, to the right and downwards.
    pub(crate) fn at(&self, uv: DVec2, steps: [DVec2; 2]) -> [f32; 3] {
        let footprint = self.footprint(uv, steps);
        if self.is_opaque() {
            let light = |[r, g, b, _]: [u8; 4]| [r, g, b].map(to_linear);
            return footprint.interpolate(|level| self.at_level(level, &footprint, light));
        }
        let [r, g, b, weight] = footprint.interpolate(|level| {
            self.at_level(level, &footprint, |[r, g, b, a]| {
                let weight = self.alpha.coverage(level, unit(a)).max(MIN_WEIGHT);
                let [r, g, b] = [r, g, b].map(|c| to_linear(c) * weight);
                [r, g, b, weight]
            })
        });
        [r, g, b].map(|c| c / weight)
    }

    /// Returns the coverage of the surface, from 0 to 1, at texture coordinates with v upwards. `steps` are the
    /// differences of the texture coordinates between this sample and the next samples, to the right and downwards.
    ///
    /// With [`Alpha::Cut`], the interpolated alpha of the first level is compared with the cutoff. In the other levels,
    /// the alpha of each pixel of the image was compared first, and the results are averaged. Therefore fine structures
    /// such as leaves keep their density when they are seen from far away.
    pub(crate) fn coverage(&self, uv: DVec2, steps: [DVec2; 2]) -> f32 {
        let footprint = self.footprint(uv, steps);
        let [coverage] = footprint.interpolate(|level| {
            let alpha = self.at_level(level, &footprint, |p| [unit(p[3])]);
            alpha.map(|alpha| self.alpha.coverage(level, alpha))
        });
        coverage
    }

    /// Returns the footprint of a pixel of the picture. The footprint is between the two mipmap levels whose pixels are
    /// closest in size to the pixel of the picture (Williams, "Pyramidal Parametrics", 1983).
    fn footprint(&self, uv: DVec2, steps: [DVec2; 2]) -> Footprint {
        let (sin, cos) = libm::sincos(self.transform.rotation);
        let [sx, sy] = self.transform.scale;
        // Applies the transform without its offset. Here v points downwards.
        let scale_and_rotate = |d: DVec2| {
            let (x, y) = (d.x * sx, d.y * sy);
            DVec2::new(cos * x + sin * y, cos * y - sin * x)
        };
        let offset = DVec2::from(self.transform.offset);
        let position = scale_and_rotate(DVec2::new(uv.x, 1.0 - uv.y)) + offset;
        let size = DVec2::new(self.levels[0].width as f64, self.levels[0].height as f64);
        let [a, b] = steps.map(|d| (scale_and_rotate(DVec2::new(d.x, -d.y)) * size).length());
        // The width of a pixel of the picture, in pixels of the image.
        let width = a.max(b).max(1.0);
        let level = libm::log2(width).min((self.levels.len() - 1) as f64);
        Footprint {
            position,
            level: whole(level),
            t: narrow(level.fract()),
            is_nearest: width <= 1.0 && self.sampler.magnify == Some(Filter::Nearest),
        }
    }

    /// Interpolates between the pixels of a level at the position of `footprint`. `texel` converts a pixel to the
    /// values to interpolate. Outside of the image, the wrap mode of the sampler selects the pixels.
    fn at_level<const N: usize>(
        &self,
        level: usize,
        footprint: &Footprint,
        texel: impl Fn([u8; 4]) -> [f32; N],
    ) -> [f32; N] {
        let (level, wrap) = (&self.levels[level], self.sampler.wrap);
        let (w, h) = (level.width, level.height);
        let value = |x: usize, y: usize| texel(level.pixels[y * w + x]);
        let x = footprint.position.x * w as f64;
        let y = footprint.position.y * h as f64;
        if footprint.is_nearest {
            return value(
                wrapped(x.floor(), w, wrap[0]),
                wrapped(y.floor(), h, wrap[1]),
            );
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (s, t) = (narrow(x - left), narrow(y - top));
        let [x0, x1] = [left, left + 1.0].map(|x| wrapped(x, w, wrap[0]));
        let [y0, y1] = [top, top + 1.0].map(|y| wrapped(y, h, wrap[1]));
        let upper = mix(value(x0, y0), value(x1, y0), s);
        let lower = mix(value(x0, y1), value(x1, y1), s);
        mix(upper, lower, t)
    }
}

impl Footprint {
    /// Interpolates the values of two levels.
    fn interpolate<const N: usize>(&self, value: impl Fn(usize) -> [f32; N]) -> [f32; N] {
        if self.t > 0.0 {
            mix(value(self.level), value(self.level + 1), self.t)
        } else {
            value(self.level)
        }
    }
}

/// Scales a byte to the range from 0 to 1.
fn unit(byte: u8) -> f32 {
    f32::from(byte) / 255.0
}

impl Level {
    /// Returns a level with half the width and half the height of this level, rounded up. Each new pixel is the
    /// weighted mean of four pixels of this level. `weight` converts the alpha of a pixel to its weight. Returns `None`
    /// if this level is a single pixel.
    fn half(&self, weight: impl Fn(u8) -> f32) -> Option<Self> {
        if self.width * self.height == 1 {
            return None;
        }
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mut pixels = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                let [x0, y0] = [2 * x, 2 * y];
                let [x1, y1] = [(x0 + 1).min(self.width - 1), (y0 + 1).min(self.height - 1)];
                let four = [(x0, y0), (x1, y0), (x0, y1), (x1, y1)]
                    .map(|(x, y)| self.pixels[y * self.width + x]);
                let coverage = four.map(|p| weight(p[3]));
                let total = coverage.iter().sum::<f32>();
                let (weights, sum) = if total > 0.0 {
                    (coverage, total)
                } else {
                    ([1.0; 4], 4.0)
                };
                let mean = |i: usize| {
                    let light = four.iter().zip(weights).map(|(p, w)| to_linear(p[i]) * w);
                    to_srgb(light.sum::<f32>() / sum)
                };
                pixels.push([mean(0), mean(1), mean(2), byte(total / 4.0)]);
            }
        }
        Some(Self {
            width,
            height,
            pixels,
        })
    }
}

/// Returns the index of the pixel for the whole number `x`, which can be outside of the range from 0 to `n` - 1.
fn wrapped(x: f64, n: usize, wrap: Wrap) -> usize {
    let size = n as f64;
    let inside = match wrap {
        Wrap::Repeat => x.rem_euclid(size),
        Wrap::Mirror => {
            let x = x.rem_euclid(2.0 * size);
            x.min(2.0 * size - 1.0 - x)
        }
        Wrap::Clamp => x,
    };
    whole(inside).min(n - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [u8; 4] = [255, 0, 0, 255];
    const GREEN: [u8; 4] = [0, 255, 0, 255];
    const BLUE: [u8; 4] = [0, 0, 255, 255];
    const WHITE: [u8; 4] = [255; 4];

    /// Returns a texture of 2 x 2 pixels: red and green above blue and white.
    fn texture(sampler: Sampler, transform: TextureTransform) -> Texture {
        let image = Image {
            width: 2,
            height: 2,
            pixels: vec![RED, GREEN, BLUE, WHITE],
        };
        Texture::decode(
            &image.to_png(&[]).unwrap(),
            sampler,
            transform,
            Alpha::Ignored,
        )
        .unwrap()
    }

    fn at(texture: &Texture, u: f64, v: f64) -> [u8; 3] {
        texture.at(DVec2::new(u, v), [DVec2::ZERO; 2]).map(to_srgb)
    }

    #[test]
    fn v_points_upwards() {
        let plain = texture(Sampler::default(), TextureTransform::default());
        assert_eq!(at(&plain, 0.25, 0.75), [255, 0, 0]);
        assert_eq!(at(&plain, 0.75, 0.75), [0, 255, 0]);
        assert_eq!(at(&plain, 0.25, 0.25), [0, 0, 255]);
    }

    #[test]
    fn the_sampler_decides_how_a_texture_continues_outside_of_its_image() {
        for (wrap, left, far) in [
            (Wrap::Repeat, [0, 255, 0], [255, 0, 0]),
            (Wrap::Mirror, [255, 0, 0], [0, 255, 0]),
            (Wrap::Clamp, [255, 0, 0], [0, 255, 0]),
        ] {
            let sampler = Sampler {
                wrap: [wrap; 2],
                ..Sampler::default()
            };
            let wrapped = texture(sampler, TextureTransform::default());
            assert_eq!(at(&wrapped, -0.25, 0.75), left, "{wrap:?}");
            assert_eq!(at(&wrapped, 1.25, 0.75), far, "{wrap:?}");
        }
    }

    #[test]
    fn a_transform_scales_rotates_and_moves() {
        // The transform is a quarter turn counter-clockwise about the upper left corner, as defined by
        // `KHR_texture_transform`.
        let transform = TextureTransform {
            offset: [0.0, 1.0],
            rotation: std::f64::consts::FRAC_PI_2,
            scale: [1.0, 1.0],
        };
        let turned = texture(Sampler::default(), transform);
        // If v points downwards, (0.25, 0.25) becomes (0.25, -0.25 + 1).
        assert_eq!(at(&turned, 0.25, 0.75), [0, 0, 255]);
    }

    #[test]
    fn a_texture_seen_from_far_away_is_the_mean_of_its_linear_colors() {
        let plain = texture(Sampler::default(), TextureTransform::default());
        let light = plain.at(DVec2::splat(0.3), [DVec2::splat(9.0); 2]);
        let half = to_srgb(0.5);
        assert_eq!(light.map(to_srgb), [half; 3]);
    }

    #[test]
    fn bytes_that_are_not_an_image_are_refused() {
        for bytes in [&b""[..], b"\x89PNG\r\n\x1a\n", b"not a picture"] {
            let (sampler, transform) = (Sampler::default(), TextureTransform::default());
            let decoded = Texture::decode(bytes, sampler, transform, Alpha::Ignored);
            assert!(decoded.is_err());
        }
    }
}
