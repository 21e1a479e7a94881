//! Textures: pictures on surfaces, with smaller copies for what is far away.
//!
//! What is not opaque has less weight where colors are mixed: the color of what is not seen does not bleed into what is.

use glam::DVec2;
use scene::{Filter, Sampler, TextureTransform, Wrap};

use crate::Image;
use crate::color::{byte, mix, narrow, to_linear, to_srgb, whole};

/// A picture in memory, and how it lies on a surface.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The picture and its copies, each half as large as the one before.
    levels: Vec<Level>,
    sampler: Sampler,
    transform: TextureTransform,
    alpha: Alpha,
}

/// What the alpha of a texture means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Alpha {
    /// Nothing: the surface is opaque.
    Ignored,
    /// The surface is there where alpha is at least this, and not elsewhere.
    Cut(f32),
    /// The surface covers so much of what is behind it.
    Blended,
}

/// Alphas of bytes that are equal as written must not differ by how they were computed.
const SLACK: f32 = 1e-6;

/// The least weight of a color: where nothing is opaque, there is a color nevertheless.
const LEAST_WEIGHT: f32 = 1.0 / 1024.0;

impl Alpha {
    /// How much of the surface a pixel covers. Level 0 is the picture itself; in place of alpha, its copies have
    /// coverage.
    fn coverage(self, level: usize, alpha: f32) -> f32 {
        match self {
            Self::Ignored => 1.0,
            Self::Cut(least) if level == 0 => f32::from(u8::from(alpha >= least - SLACK)),
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

/// What is looked at for a pixel of the picture: a place in a level and the next one, and how far it is from the first
/// to the second.
struct Footprint {
    place: DVec2,
    level: usize,
    t: f32,
    is_nearest: bool,
}

impl Texture {
    /// A texture from the bytes of a PNG or JPEG file. One without alpha is opaque, whatever alpha would mean.
    ///
    /// # Errors
    ///
    /// Why the bytes are no picture.
    pub fn decode(
        bytes: &[u8],
        sampler: Sampler,
        transform: TextureTransform,
        alpha: Alpha,
    ) -> Result<Self, String> {
        let picture = Image::decode(bytes).map_err(|error| error.to_string())?;
        let first = Level {
            width: picture.width as usize,
            height: picture.height as usize,
            pixels: picture.pixels,
        };
        let is_opaque = first.pixels.iter().all(|p| p[3] == u8::MAX);
        let alpha = if is_opaque { Alpha::Ignored } else { alpha };
        let mut levels = vec![first];
        for level in 0.. {
            let Some(half) = levels[level].half(|a| alpha.coverage(level, part(a))) else {
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

    /// Whether it is opaque all over.
    pub(crate) fn is_opaque(&self) -> bool {
        self.alpha == Alpha::Ignored
    }

    /// Linear red, green and blue at texture coordinates with v upwards. `beside` says how far away the
    /// next pixels of the picture are.
    pub(crate) fn at(&self, uv: DVec2, beside: [DVec2; 2]) -> [f32; 3] {
        let footprint = self.footprint(uv, beside);
        if self.is_opaque() {
            let light = |[r, g, b, _]: [u8; 4]| [r, g, b].map(to_linear);
            return footprint.mixed(|level| self.at_level(level, &footprint, light));
        }
        let [r, g, b, weight] = footprint.mixed(|level| {
            self.at_level(level, &footprint, |[r, g, b, a]| {
                let weight = self.alpha.coverage(level, part(a)).max(LEAST_WEIGHT);
                let [r, g, b] = [r, g, b].map(|c| to_linear(c) * weight);
                [r, g, b, weight]
            })
        });
        [r, g, b].map(|c| c / weight)
    }

    /// How much of the surface is there, from 0 to 1, at texture coordinates with v upwards. `beside` says how far
    /// away the next places are that are asked for.
    ///
    /// Where a texture cuts, places are compared before they are averaged: what is small stays as dense as it is
    /// from far away.
    pub(crate) fn coverage(&self, uv: DVec2, beside: [DVec2; 2]) -> f32 {
        let footprint = self.footprint(uv, beside);
        let [coverage] = footprint.mixed(|level| {
            let alpha = self.at_level(level, &footprint, |p| [part(p[3])]);
            alpha.map(|alpha| self.alpha.coverage(level, alpha))
        });
        coverage
    }

    /// Which pixels of which copies are looked at: between the two copies whose pixels are as large as those of the
    /// picture. Williams, "Pyramidal Parametrics", 1983.
    fn footprint(&self, uv: DVec2, beside: [DVec2; 2]) -> Footprint {
        let (sin, cos) = libm::sincos(self.transform.rotation);
        let [sx, sy] = self.transform.scale;
        // Of the transform without its offset: linear, with v downwards.
        let turned = |d: DVec2| {
            let (x, y) = (d.x * sx, d.y * sy);
            DVec2::new(cos * x + sin * y, cos * y - sin * x)
        };
        let place = turned(DVec2::new(uv.x, 1.0 - uv.y)) + DVec2::from(self.transform.offset);
        let size = DVec2::new(self.levels[0].width as f64, self.levels[0].height as f64);
        let [a, b] = beside.map(|d| (turned(DVec2::new(d.x, -d.y)) * size).length());
        let wide = a.max(b).max(1.0);
        let level = libm::log2(wide).min((self.levels.len() - 1) as f64);
        Footprint {
            place,
            level: whole(level),
            t: narrow(level.fract()),
            // A picture of large pixels is meant to be seen as such if its file says so.
            is_nearest: wide <= 1.0 && self.sampler.magnify == Some(Filter::Nearest),
        }
    }

    /// What `texel` makes of the pixels of a level at a place from 0 to 1, and beyond as the sampler says.
    fn at_level<const N: usize>(
        &self,
        level: usize,
        footprint: &Footprint,
        texel: impl Fn([u8; 4]) -> [f32; N],
    ) -> [f32; N] {
        let (level, wrap) = (&self.levels[level], self.sampler.wrap);
        let (w, h) = (level.width, level.height);
        let value = |x: usize, y: usize| texel(level.pixels[y * w + x]);
        let x = footprint.place.x * w as f64;
        let y = footprint.place.y * h as f64;
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
    /// The mean of what `of` says of two levels.
    fn mixed<const N: usize>(&self, of: impl Fn(usize) -> [f32; N]) -> [f32; N] {
        if self.t > 0.0 {
            mix(of(self.level), of(self.level + 1), self.t)
        } else {
            of(self.level)
        }
    }
}

/// The part of 1 that a byte stands for.
fn part(byte: u8) -> f32 {
    f32::from(byte) / 255.0
}

impl Level {
    /// The mean of each four pixels, whose alphas have these weights; `None` of a single pixel.
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
                let covered = four.map(|p| weight(p[3]));
                let all = covered.iter().sum::<f32>();
                let (weights, sum) = if all > 0.0 {
                    (covered, all)
                } else {
                    ([1.0; 4], 4.0)
                };
                let mean = |i: usize| {
                    let light = four.iter().zip(weights).map(|(p, w)| to_linear(p[i]) * w);
                    to_srgb(light.sum::<f32>() / sum)
                };
                pixels.push([mean(0), mean(1), mean(2), byte(all / 4.0)]);
            }
        }
        Some(Self {
            width,
            height,
            pixels,
        })
    }
}

/// The pixel for a whole number, which may lie outside of the `n` pixels that there are.
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

    /// Red and green over blue and white.
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
    fn beyond_its_border_a_texture_goes_on_as_its_sampler_says() {
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
    fn a_transform_scales_turns_and_moves() {
        // As KHR_texture_transform has it: a quarter turn counter-clockwise about the upper left corner.
        let transform = TextureTransform {
            offset: [0.0, 1.0],
            rotation: std::f64::consts::FRAC_PI_2,
            scale: [1.0, 1.0],
        };
        let turned = texture(Sampler::default(), transform);
        // (0.25, 0.25) from above becomes (0.25, -0.25 + 1).
        assert_eq!(at(&turned, 0.25, 0.75), [0, 0, 255]);
    }

    #[test]
    fn from_far_away_a_texture_is_the_mean_of_its_light() {
        let plain = texture(Sampler::default(), TextureTransform::default());
        let light = plain.at(DVec2::splat(0.3), [DVec2::splat(9.0); 2]);
        let half = to_srgb(0.5);
        assert_eq!(light.map(to_srgb), [half; 3]);
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        for bytes in [&b""[..], b"\x89PNG\r\n\x1a\n", b"not a picture"] {
            let (sampler, transform) = (Sampler::default(), TextureTransform::default());
            let decoded = Texture::decode(bytes, sampler, transform, Alpha::Ignored);
            assert!(decoded.is_err());
        }
    }
}
