//! Textures with mipmaps.
//!
//! Where colors are averaged, transparent pixels have less weight than opaque pixels, so that the color of invisible
//! pixels hardly affects visible pixels. If the alpha of a texture is ignored, all its pixels have the same weight.

use std::sync::Arc;

use glam::DVec2;
use rayon::prelude::*;
use scene::{Filter, Sampler, TextureTransform, Wrap};

use crate::color::{byte, mix, narrow, to_linear, to_srgb, whole};
use crate::{Image, PictureError};

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

/// A cache of decoded textures, so that a texture in several drawings is decoded only once.
#[derive(Clone, Debug, Default)]
pub struct TextureCache(Vec<(scene::Texture, Alpha, Arc<Texture>)>);

impl TextureCache {
    pub(crate) fn get(&self, source: &scene::Texture, alpha: Alpha) -> Option<Arc<Texture>> {
        let known = self.0.iter().find(|(of, a, _)| of == source && *a == alpha);
        known.map(|(_, _, texture)| texture.clone())
    }

    pub(crate) fn insert(
        &mut self,
        source: &scene::Texture,
        alpha: Alpha,
        decoded: Texture,
    ) -> Arc<Texture> {
        let decoded = Arc::new(decoded);
        self.0.push((source.clone(), alpha, decoded.clone()));
        decoded
    }

    /// Removes the textures for which `keep` returns false.
    pub fn retain(&mut self, mut keep: impl FnMut(&Arc<Texture>) -> bool) {
        self.0.retain(|(_, _, texture)| keep(texture));
    }
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

/// The minimum weight of a color in a weighted mean. The weight is not 0, so that the mean of fully transparent pixels
/// is defined.
const MIN_WEIGHT: f32 = 1.0 / 1024.0;

impl Alpha {
    /// Returns the fraction of a pixel that the surface covers. `alpha` is the alpha of the pixel. Level 0 is the image
    /// itself. In smaller mipmap levels, `alpha` is already the fraction of the pixel that the surface covers.
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

/// The position and the mipmap levels at which a texture is read for one pixel of the picture.
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
    /// Returns the errors of [`Image::decode`].
    pub fn decode(
        bytes: &[u8],
        sampler: Sampler,
        transform: TextureTransform,
        alpha: Alpha,
    ) -> Result<Self, PictureError> {
        let image = Image::decode(bytes)?;
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

    /// Returns how the texture continues outside of its image, and how it is magnified.
    pub fn sampler(&self) -> Sampler {
        self.sampler
    }

    /// Returns the width and the height of the image in pixels.
    pub fn size(&self) -> [u32; 2] {
        let side = |n| u32::try_from(n).unwrap_or(u32::MAX);
        [self.levels[0].width, self.levels[0].height].map(side)
    }

    /// Converts texture coordinates with v upwards to a position in the image. The image reaches from 0 to 1 in both
    /// axes, and the second axis points downwards.
    pub fn position(&self, uv: DVec2) -> DVec2 {
        self.scale_and_rotate(DVec2::new(uv.x, 1.0 - uv.y)) + DVec2::from(self.transform.offset)
    }

    /// Returns a mipmap level as graphics cards store it. The width and height of the image are divided by 2 to the
    /// power of `level` and rounded down, but are at least 1. Alpha is the fraction of a pixel that the surface covers.
    /// The colors are multiplied by alpha, so that the color of invisible pixels hardly affects visible pixels when
    /// pixels are interpolated.
    pub fn level(&self, level: u32) -> Image {
        let [width, height] = self
            .size()
            .map(|n| n.checked_shr(level).unwrap_or(0).max(1));
        let exact = f64::from(level).min((self.levels.len() - 1) as f64);
        let pixel = |i: u32| {
            let (x, y) = (f64::from(i % width) + 0.5, f64::from(i / width) + 0.5);
            let footprint = Footprint {
                position: DVec2::new(x / f64::from(width), y / f64::from(height)),
                level: whole(exact),
                t: 0.0,
                is_nearest: false,
            };
            let [r, g, b, a] = self.weighted(&footprint);
            let [r, g, b] = [r, g, b].map(to_srgb);
            [r, g, b, byte(a)]
        };
        let pixels = (0..width * height).into_par_iter().map(pixel).collect();
        Image {
            width,
            height,
            pixels,
        }
    }

    /// Whether the whole texture is opaque.
    pub(crate) fn is_opaque(&self) -> bool {
        self.alpha == Alpha::Ignored
    }

    /// Returns linear red, green and blue at texture coordinates with v upwards. `steps` says how the texture
    /// coordinates change from this pixel of the picture to the next pixel on the right, and to the next pixel below.
    pub(crate) fn at(&self, uv: DVec2, steps: [DVec2; 2]) -> [f32; 3] {
        let footprint = self.footprint(uv, steps);
        if self.is_opaque() {
            let light = |[r, g, b, _]: [u8; 4]| [r, g, b].map(to_linear);
            return footprint.interpolate(|level| self.at_level(level, &footprint, light));
        }
        let [r, g, b, weight] = self.weighted(&footprint);
        [r, g, b].map(|c| c / weight)
    }

    /// Returns four numbers: linear red, green and blue, each multiplied by a weight, and the weight itself. The weight
    /// is the fraction of the pixel that the surface covers, but it is never 0.
    fn weighted(&self, footprint: &Footprint) -> [f32; 4] {
        footprint.interpolate(|level| {
            self.at_level(level, footprint, |[r, g, b, a]| {
                let weight = self.alpha.coverage(level, unit(a)).max(MIN_WEIGHT);
                let [r, g, b] = [r, g, b].map(|c| to_linear(c) * weight);
                [r, g, b, weight]
            })
        })
    }

    /// Returns the coverage of the surface, from 0 to 1, at texture coordinates with v upwards. `steps` says how the
    /// texture coordinates change from this sample to the next sample on the right, and to the next sample below.
    ///
    /// With [`Alpha::Cut`], the first mipmap level interpolates alpha and then compares it with the cutoff. The other
    /// levels store averages: the alpha of each pixel of the image was first compared with the cutoff, and the results
    /// were averaged. Therefore fine structures such as leaves do not become thinner or denser when they are seen from
    /// far away.
    pub(crate) fn coverage(&self, uv: DVec2, steps: [DVec2; 2]) -> f32 {
        let footprint = self.footprint(uv, steps);
        let [coverage] = footprint.interpolate(|level| {
            let alpha = self.at_level(level, &footprint, |p| [unit(p[3])]);
            alpha.map(|alpha| self.alpha.coverage(level, alpha))
        });
        coverage
    }

    /// Returns the footprint of a pixel of the picture: where and at which mipmap levels the texture is read. Values
    /// are interpolated between the two mipmap levels whose pixels are closest in size to the pixel of the picture
    /// (Williams, "Pyramidal Parametrics", 1983).
    fn footprint(&self, uv: DVec2, steps: [DVec2; 2]) -> Footprint {
        let [width, height] = self.size().map(f64::from);
        let size = DVec2::new(width, height);
        let [a, b] = steps.map(|d| (self.scale_and_rotate(DVec2::new(d.x, -d.y)) * size).length());
        // The width of a pixel of the picture, in pixels of the image.
        let width = a.max(b).max(1.0);
        let level = libm::log2(width).min((self.levels.len() - 1) as f64);
        Footprint {
            position: self.position(uv),
            level: whole(level),
            t: narrow(level.fract()),
            is_nearest: width <= 1.0 && self.sampler.magnify == Some(Filter::Nearest),
        }
    }

    /// Applies the scale and the rotation of the transform, but not its offset, to texture coordinates with v
    /// downwards.
    fn scale_and_rotate(&self, uv: DVec2) -> DVec2 {
        let (sin, cos) = libm::sincos(self.transform.rotation);
        let (x, y) = (
            uv.x * self.transform.scale[0],
            uv.y * self.transform.scale[1],
        );
        DVec2::new(cos * x + sin * y, cos * y - sin * x)
    }

    /// Interpolates between the pixels of a level at the position of `footprint`. `texel` converts a pixel to the
    /// values that are interpolated. Outside of the image, the wrap mode of the sampler selects the pixels.
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
    /// weighted mean of four pixels of this level. `weight` converts the alpha of a pixel to the weight of the pixel.
    /// Returns `None` if this level is a single pixel.
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
        // In coordinates whose v axis points downwards, the transform maps (0.25, 0.25) to (0.25, -0.25 + 1).
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
    fn levels_for_graphics_cards_are_rounded_down() {
        let image = Image {
            width: 5,
            height: 2,
            pixels: vec![RED; 10],
        };
        let bytes = image.to_png(&[]).unwrap();
        let (sampler, transform) = (Sampler::default(), TextureTransform::default());
        let texture = Texture::decode(&bytes, sampler, transform, Alpha::Ignored).unwrap();
        for (level, size) in [[5, 2], [2, 1], [1, 1], [1, 1]].into_iter().enumerate() {
            let found = texture.level(u32::try_from(level).unwrap());
            assert_eq!([found.width, found.height], size);
            assert!(found.pixels.iter().all(|p| *p == RED), "{level}");
        }
        let plain = self::texture(sampler, transform);
        assert_eq!(plain.level(0).pixels, [RED, GREEN, BLUE, WHITE]);
        assert_eq!(
            plain.level(1).pixels,
            [[to_srgb(0.5), to_srgb(0.5), to_srgb(0.5), 255]]
        );
    }

    #[test]
    fn colors_of_levels_are_multiplied_by_the_coverage() {
        let image = Image {
            width: 2,
            height: 1,
            pixels: vec![[255, 255, 255, 128], [255, 0, 0, 0]],
        };
        let bytes = image.to_png(&[]).unwrap();
        let (sampler, transform) = (Sampler::default(), TextureTransform::default());
        for (alpha, expected) in [
            (Alpha::Blended, [to_srgb(128.0 / 255.0), 128]),
            (Alpha::Cut(0.5), [255, 255]),
        ] {
            let texture = Texture::decode(&bytes, sampler, transform, alpha).unwrap();
            let [white, clear] = texture.level(0).pixels[..] else {
                panic!()
            };
            assert_eq!([white[0], white[3]], expected, "{alpha:?}");
            assert!(clear[0] < 5 && clear[3] == 0, "{clear:?}");
        }
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
