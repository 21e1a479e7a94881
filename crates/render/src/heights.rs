//! Images whose pixels are heights.

use glam::DVec2;

use crate::PictureError;
use crate::image::{Image, decoder, png_samples};

/// The brightness of the pixels of an image, from 0 (black) to 1 (white), as heights of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Heights {
    width: usize,
    height: usize,
    /// The rows are stored from top to bottom, and the heights of each row from left to right.
    values: Vec<f32>,
}

impl Heights {
    /// The maximum number of bytes for each pixel while an image is decoded.
    pub const DECODING_BYTES: u64 = 12;

    /// Decodes a PNG or JPEG file. A height is the mean of red, green and blue as they are stored in the file; alpha
    /// has no effect. Gray PNG files with 16 bits keep their precision.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Image::decode`].
    pub fn decode(bytes: &[u8]) -> Result<Self, PictureError> {
        if let Some((info, samples)) = gray_16(bytes) {
            let pixels = samples.as_chunks::<4>().0.iter();
            let gray = pixels.map(|&[high, low, ..]| u16::from_be_bytes([high, low]));
            return Ok(Self {
                width: info.width as usize,
                height: info.height as usize,
                values: gray
                    .map(|gray| f32::from(gray) / f32::from(u16::MAX))
                    .collect(),
            });
        }
        let image = Image::decode(bytes)?;
        let sum = |[r, g, b, _]: &[u8; 4]| u16::from(*r) + u16::from(*g) + u16::from(*b);
        let values = image
            .pixels
            .iter()
            .map(|pixel| f32::from(sum(pixel)) / 765.0);
        Ok(Self {
            width: image.width as usize,
            height: image.height as usize,
            values: values.collect(),
        })
    }

    /// Returns the height at texture coordinates with v upwards, interpolated between the centers of the four nearest
    /// pixels. Outside of the range from 0 to 1, the image is repeated, but heights are not interpolated across the
    /// border of the image. Returns 0 for coordinates that are not finite.
    pub fn at(&self, uv: DVec2) -> f64 {
        if !uv.is_finite() {
            return 0.0;
        }
        let (left, right, s) = pixels(uv.x, self.width);
        let (top, bottom, t) = pixels(1.0 - uv.y, self.height);
        let value = |x: usize, y: usize| f64::from(self.values[y * self.width + x]);
        let row = |y: usize| value(left, y) + s * (value(right, y) - value(left, y));
        row(top) + t * (row(bottom) - row(top))
    }
}

/// Returns the indices of the two pixels on either side of a coordinate in a row or column, and the weight of the
/// second pixel.
fn pixels(at: f64, n: usize) -> (usize, usize, f64) {
    let at = if (0.0..=1.0).contains(&at) {
        at
    } else {
        at - at.floor()
    };
    let last = n - 1;
    let at = (at * n as f64 - 0.5).clamp(0.0, last as f64);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 0 to the last pixel"
    )]
    let first = at as usize;
    (first, last.min(first + 1), at - first as f64)
}

/// Returns the samples of a gray PNG file with 16 bits: gray and alpha, with the high byte first. Returns `None` for
/// all other files, including broken ones.
fn gray_16(bytes: &[u8]) -> Option<(png::OutputInfo, Vec<u8>)> {
    let output = decoder(bytes).read_info().ok()?.output_color_type();
    let is_gray_16 = output == (png::ColorType::GrayscaleAlpha, png::BitDepth::Sixteen);
    is_gray_16.then(|| png_samples(bytes).ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gray(width: u32, height: u32, depth: png::BitDepth, samples: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(depth);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(samples).unwrap();
        writer.finish().unwrap();
        bytes
    }

    #[test]
    fn heights_are_interpolated_between_the_centers_of_pixels() {
        // The left column is black, the right column is white.
        let bytes = gray(2, 2, png::BitDepth::Eight, &[0, 255, 0, 255]);
        let heights = Heights::decode(&bytes).unwrap();
        for (u, expected) in [
            (0.0, 0.0),
            (0.25, 0.0),
            (0.375, 0.25),
            (0.5, 0.5),
            (0.75, 1.0),
            (1.0, 1.0),
            (-0.5, 0.5),
            (1.25, 0.0),
            (f64::NAN, 0.0),
        ] {
            for v in [0.0, 0.3, 1.0, 7.7] {
                assert_eq!(heights.at(DVec2::new(u, v)), expected, "{u} {v}");
            }
        }
    }

    #[test]
    fn the_top_row_of_the_image_is_at_v_1() {
        let bytes = gray(1, 2, png::BitDepth::Eight, &[255, 0]);
        let heights = Heights::decode(&bytes).unwrap();
        assert_eq!(heights.at(DVec2::new(0.5, 1.0)), 1.0);
        assert_eq!(heights.at(DVec2::new(0.5, 0.0)), 0.0);
    }

    #[test]
    fn gray_images_keep_16_bits_and_colors_are_averaged() {
        let bytes = gray(1, 1, png::BitDepth::Sixteen, &[0, 1]);
        let at = |bytes: &[u8]| Heights::decode(bytes).unwrap().at(DVec2::splat(0.5));
        assert_eq!(at(&bytes), f64::from(1.0_f32 / 65535.0));
        let image = Image::filled(1, 1, [255, 0, 0, 9]).unwrap();
        assert_eq!(at(&image.to_png(&[]).unwrap()), f64::from(1.0_f32 / 3.0));
    }

    #[test]
    fn broken_images_are_refused() {
        let bytes = gray(2, 2, png::BitDepth::Sixteen, &[7; 8]);
        assert!(Heights::decode(&bytes[..40]).is_err());
        assert!(Heights::decode(b"").is_err());
    }
}
