//! Images in memory, read from PNG and JPEG files and written as PNG files.

use std::io::{Cursor, Write};

use progress::{NoProgress, Progress};
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::PictureError;
use crate::blend::over;
use crate::work::Work;

/// The maximum width and height of an image, in pixels.
pub const LARGEST_SIDE: u32 = 16_384;

/// An image of 8-bit colors.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Image {
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
    /// The rows are stored from top to bottom, and the pixels of each row from left to right. A pixel is red, green and
    /// blue in sRGB, and straight alpha: the colors are not multiplied by alpha.
    pub pixels: Vec<[u8; 4]>,
}

impl Image {
    /// Creates an image of one color.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`].
    pub fn filled(width: u32, height: u32, color: [u8; 4]) -> Result<Self, PictureError> {
        let n = checked_size(width, height)?;
        Ok(Self {
            width,
            height,
            pixels: vec![color; n],
        })
    }

    /// Decodes a PNG or JPEG file.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`]. Returns [`PictureError::Decode`]
    /// if the file is not a PNG or JPEG file, or cannot be decoded.
    pub fn decode(bytes: &[u8]) -> Result<Self, PictureError> {
        if bytes.starts_with(b"\xff\xd8") {
            Self::from_jpeg(bytes)
        } else {
            Self::from_png(bytes)
        }
    }

    /// Returns the width and the height of a PNG or JPEG file in pixels, without decoding its pixels.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`]. Returns [`PictureError::Decode`]
    /// if the file is not a PNG or JPEG file, or its header cannot be decoded.
    pub fn size(bytes: &[u8]) -> Result<[u32; 2], PictureError> {
        let [width, height] = if bytes.starts_with(b"\xff\xd8") {
            jpeg_size(&jpeg_decoder(bytes)?)
        } else {
            let failed = |error: png::DecodingError| PictureError::Decode(error.to_string());
            decoder(bytes)
                .read_info()
                .map_err(failed)?
                .info()
                .size()
                .into()
        };
        checked_size(width, height).map(|_| [width, height])
    }

    /// Decodes a PNG file. If the file is an animation, decodes its first image.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`]. Returns [`PictureError::Decode`]
    /// if the file is not a PNG file, or is broken.
    pub fn from_png(bytes: &[u8]) -> Result<Self, PictureError> {
        let (info, samples) = png_samples(bytes)?;
        Ok(Self {
            width: info.width,
            height: info.height,
            pixels: rgba(&info, samples),
        })
    }

    fn from_jpeg(bytes: &[u8]) -> Result<Self, PictureError> {
        let failed = |error: DecodeErrors| PictureError::Decode(error.to_string());
        let mut decoder = jpeg_decoder(bytes)?;
        let [width, height] = jpeg_size(&decoder);
        checked_size(width, height)?;
        let bytes = decoder.decode().map_err(failed)?;
        let pixels = bytes.as_chunks().0.iter();
        Ok(Self {
            width,
            height,
            pixels: pixels.map(|&[r, g, b]| [r, g, b, u8::MAX]).collect(),
        })
    }

    /// Composites `image` over this image. `corner` is the column and the row at which the top left corner of `image`
    /// is placed. All of `image` must be inside of this image.
    pub fn place(&mut self, image: &Self, corner: [u64; 2]) {
        let [x, y] = corner.map(|c| usize::try_from(c).unwrap_or(usize::MAX));
        let rows = self.pixels.chunks_exact_mut(self.width as usize).skip(y);
        for (to, from) in rows.zip(image.pixels.chunks_exact(image.width as usize)) {
            for (under, &color) in to[x..].iter_mut().zip(from) {
                *under = over(color, *under);
            }
        }
    }

    /// Encodes the image as a PNG file, without an alpha channel if all pixels are opaque.
    ///
    /// Each entry of `texts` is a pair of strings: a keyword of 1 to 79 Latin-1 characters, and its text. The texts are
    /// stored in the file, for example to record its provenance.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Encode`] if the image has no pixels or a keyword is invalid.
    pub fn to_png(&self, texts: &[(&str, &str)]) -> Result<Vec<u8>, PictureError> {
        self.to_png_with_progress(texts, &NoProgress)
    }

    /// Encodes the image like [`Self::to_png`], with progress and cancellation.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Self::to_png`]. Returns [`PictureError::Cancelled`] if the listener cancels the work.
    pub fn to_png_with_progress(
        &self,
        texts: &[(&str, &str)],
        progress: &dyn Progress,
    ) -> Result<Vec<u8>, PictureError> {
        let work = Work::new(progress, "encode", u64::from(self.height));
        let mut bytes = Vec::new();
        let (encoder, channels) = encoder(&mut bytes, std::slice::from_ref(self), texts)?;
        let mut writer = encoder.write_header()?;
        // The image is written row by row, so that a large image is not copied as a whole.
        let mut stream = writer.stream_writer()?;
        for row in self.pixels.chunks(self.width.max(1) as usize) {
            work.add(1)?;
            let written = stream.write_all(&samples(row, channels));
            written.map_err(png::EncodingError::from)?;
        }
        stream.finish()?;
        writer.finish()?;
        Ok(bytes)
    }
}

/// Returns an encoder for a PNG file that contains these texts and one or more images of equal size. Also returns the
/// number of channels: 3 if all pixels of the images are opaque, and 4 otherwise.
pub(crate) fn encoder<'b>(
    bytes: &'b mut Vec<u8>,
    images: &[Image],
    texts: &[(&str, &str)],
) -> Result<(png::Encoder<'b, &'b mut Vec<u8>>, usize), PictureError> {
    let [width, height] = images.first().map_or([0; 2], |i| [i.width, i.height]);
    let mut pixels = images.iter().flat_map(|image| &image.pixels);
    let (color, channels) = if pixels.all(|p| p[3] == u8::MAX) {
        (png::ColorType::Rgb, 3)
    } else {
        (png::ColorType::Rgba, 4)
    };
    let mut encoder = png::Encoder::new(bytes, width, height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_color(color);
    encoder.set_compression(png::Compression::Balanced);
    for (keyword, text) in texts {
        encoder.add_itxt_chunk((*keyword).to_owned(), (*text).to_owned())?;
    }
    Ok((encoder, channels))
}

/// Returns the first `channels` channels of each pixel.
pub(crate) fn samples(pixels: &[[u8; 4]], channels: usize) -> Vec<u8> {
    let mut samples = Vec::with_capacity(4 * pixels.len());
    for pixel in pixels {
        samples.extend_from_slice(&pixel[..channels]);
    }
    samples
}

/// Returns a decoder of PNG files into gray or RGB pixels with alpha.
pub(crate) fn decoder(bytes: &[u8]) -> png::Decoder<Cursor<&[u8]>> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::ALPHA | png::Transformations::EXPAND);
    decoder
}

/// Decodes the samples of the first image of a PNG file: gray and alpha, or red, green, blue and alpha.
///
/// # Errors
///
/// Returns the errors of [`Image::from_png`].
pub(crate) fn png_samples(bytes: &[u8]) -> Result<(png::OutputInfo, Vec<u8>), PictureError> {
    let failed = |error: png::DecodingError| PictureError::Decode(error.to_string());
    let mut reader = decoder(bytes).read_info().map_err(failed)?;
    let (width, height) = reader.info().size();
    let n = checked_size(width, height)?;
    let size = reader.output_buffer_size().unwrap_or(usize::MAX);
    if size > 8 * n {
        let message = "the pixels of the image take more than 8 bytes each";
        return Err(PictureError::Decode(message.to_owned()));
    }
    let mut samples = vec![0; size];
    let info = reader.next_frame(&mut samples).map_err(failed)?;
    if [info.width, info.height] != [width, height] || info.buffer_size() != size {
        let message = "the first image in the file does not have the size that the file declares";
        return Err(PictureError::Decode(message.to_owned()));
    }
    Ok((info, samples))
}

/// Creates the decoder of a JPEG file, and decodes the headers of the file.
fn jpeg_decoder(bytes: &[u8]) -> Result<JpegDecoder<ZCursor<&[u8]>>, PictureError> {
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGB)
        .set_strict_mode(false)
        .set_max_width(usize::MAX)
        .set_max_height(usize::MAX);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let headers = decoder.decode_headers();
    headers.map_err(|error| PictureError::Decode(error.to_string()))?;
    Ok(decoder)
}

/// Returns the width and the height of a JPEG file whose headers have been decoded.
fn jpeg_size(decoder: &JpegDecoder<ZCursor<&[u8]>>) -> [u32; 2] {
    // If the decoder does not know the size, the result is 0 x 0, and the caller refuses the image. The JPEG format
    // limits a side to 65535 pixels.
    let info = decoder.info();
    info.map_or([0; 2], |i| [i.width, i.height].map(u32::from))
}

/// Converts samples from a [`decoder`] to 8-bit RGBA pixels.
pub(crate) fn rgba(info: &png::OutputInfo, mut bytes: Vec<u8>) -> Vec<[u8; 4]> {
    if info.bit_depth == png::BitDepth::Sixteen {
        bytes = (bytes.as_chunks().0.iter())
            .map(|&sample| rounded(u16::from_be_bytes(sample)))
            .collect();
    }
    match info.color_type {
        png::ColorType::Rgba => bytes.as_chunks().0.to_vec(),
        _ => (bytes.as_chunks().0.iter())
            .map(|&[gray, alpha]| [gray, gray, gray, alpha])
            .collect(),
    }
}

/// Rounds a 16-bit sample to the nearest 8-bit sample.
fn rounded(sample: u16) -> u8 {
    u8::try_from((u32::from(sample) + 128) / 257).unwrap_or(u8::MAX)
}

/// Returns the number of pixels of an image of this width and height.
///
/// # Errors
///
/// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`].
pub fn checked_size(width: u32, height: u32) -> Result<usize, PictureError> {
    let allowed = 1..=LARGEST_SIDE;
    if allowed.contains(&width) && allowed.contains(&height) {
        Ok(width as usize * height as usize)
    } else {
        Err(PictureError::Size { width, height })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decodes a PNG file into its width, height, color type and unconverted samples.
    fn decoded(bytes: &[u8]) -> (u32, u32, png::ColorType, Vec<u8>) {
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        (info.width, info.height, info.color_type, pixels)
    }

    #[test]
    fn an_encoded_png_file_has_the_pixels_of_the_image() {
        let mut image = Image::filled(3, 2, [1, 2, 3, 255]).unwrap();
        image.pixels[4] = [200, 100, 50, 255];
        let (width, height, color, pixels) = decoded(&image.to_png(&[]).unwrap());
        assert_eq!((width, height, color), (3, 2, png::ColorType::Rgb));
        assert_eq!(pixels[..3], [1, 2, 3]);
        assert_eq!(pixels[12..15], [200, 100, 50]);

        image.pixels[0] = [9, 8, 7, 0];
        let (_, _, color, pixels) = decoded(&image.to_png(&[]).unwrap());
        assert_eq!(color, png::ColorType::Rgba);
        assert_eq!(pixels, image.pixels.as_flattened());
    }

    #[test]
    fn texts_are_stored_in_the_png_file() {
        let image = Image::filled(1, 1, [0; 4]).unwrap();
        let bytes = image.to_png(&[("Source", "teapot.ron")]).unwrap();
        let reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let text = &reader.info().utf8_text[0];
        assert_eq!(text.keyword, "Source");
        assert_eq!(text.get_text().unwrap(), "teapot.ron");
    }

    #[test]
    fn empty_and_too_large_images_are_refused() {
        for (width, height) in [(0, 1), (1, 0), (LARGEST_SIDE + 1, 1), (u32::MAX, u32::MAX)] {
            let refused = Image::filled(width, height, [0; 4]);
            assert!(matches!(refused, Err(PictureError::Size { .. })));
        }
    }

    #[test]
    fn an_encoded_image_decodes_to_the_same_image() {
        let mut image = Image::filled(7, 3, [1, 2, 3, 255]).unwrap();
        assert_eq!(Image::from_png(&image.to_png(&[]).unwrap()).unwrap(), image);
        image.pixels[4] = [9, 8, 7, 6];
        let text = [("Software", "a program")];
        assert_eq!(
            Image::from_png(&image.to_png(&text).unwrap()).unwrap(),
            image
        );
    }

    #[test]
    fn every_color_type_and_bit_depth_is_read() {
        for color in [
            png::ColorType::Grayscale,
            png::ColorType::GrayscaleAlpha,
            png::ColorType::Rgb,
            png::ColorType::Rgba,
        ] {
            for depth in [png::BitDepth::Eight, png::BitDepth::Sixteen] {
                let mut bytes = Vec::new();
                let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
                encoder.set_color(color);
                encoder.set_depth(depth);
                let n = 2 * color.samples() * (depth as usize) / 8;
                let mut writer = encoder.write_header().unwrap();
                writer.write_image_data(&vec![200; n]).unwrap();
                writer.finish().unwrap();

                let image = Image::from_png(&bytes).unwrap();

                let has_alpha = color.samples() % 2 == 0;
                let alpha = if has_alpha { 200 } else { 255 };
                assert_eq!(image.pixels, [[200, 200, 200, alpha]; 2], "{color:?}");
            }
        }
    }

    #[test]
    fn truncated_and_too_large_files_are_refused() {
        let complete = Image::filled(7, 3, [1, 2, 3, 255])
            .unwrap()
            .to_png(&[])
            .unwrap();
        for end in 0..complete.len() - 12 {
            assert!(Image::from_png(&complete[..end]).is_err(), "{end}");
        }
        // The width in the header of this file is too large, and the pixels of the file are incomplete.
        let mut huge = Vec::new();
        let encoder = png::Encoder::new(&mut huge, LARGEST_SIDE + 1, 1);
        let mut writer = encoder.write_header().unwrap();
        writer.write_chunk(png::chunk::IDAT, b"begin").unwrap();
        drop(writer);
        let error = Image::from_png(&huge).unwrap_err();
        assert!(matches!(error, PictureError::Size { .. }), "{error}");
    }
}
