//! Compares images. The result is a message, or an image that shows the pixels that differ.

use std::io::Cursor;

use png::Reader;

use crate::image::{decoder, rgba};
use crate::{Image, PictureError};

/// The color of pixels that differ.
const DIFFERENT: [u8; 4] = [0xd6, 0x20, 0x28, 255];

/// The factor by which the contrast of the expected image is reduced.
const FAINT: u32 = 4;

/// Returns a faint gray copy of `expected` with the different pixels in red. A pixel is different if one of its
/// channels (each from 0 to 255) differs by more than `tolerance`. Returns `None` if the sizes of the images differ.
pub fn difference(expected: &Image, found: &Image, tolerance: u8) -> Option<Image> {
    let is_near =
        |a: &[u8; 4], b: &[u8; 4]| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= tolerance);
    let is_same_size = (expected.width, expected.height) == (found.width, found.height);
    is_same_size.then(|| {
        let pixels = expected.pixels.iter().zip(&found.pixels);
        Image {
            width: expected.width,
            height: expected.height,
            pixels: pixels
                .map(|(a, b)| if is_near(a, b) { faint(*a) } else { DIFFERENT })
                .collect(),
        }
    })
}

/// Compares two PNG files, which can be animations. Returns a message that describes the difference, or `None` if no
/// channel (from 0 to 255) of any pixel differs by more than `tolerance`.
///
/// # Errors
///
/// Returns [`PictureError::Unreadable`] if a file cannot be decoded. The error contains the index of the file: 0 for
/// `found`, 1 for `expected`.
pub fn compare(
    found: &[u8],
    expected: &[u8],
    tolerance: u8,
) -> Result<Option<String>, PictureError> {
    let (mut found, mut expected) = (Frames::new(found, 0)?, Frames::new(expected, 1)?);
    let [[width, height], [w, h]] = [&expected, &found].map(|f| f.reader.info().size().into());
    if [w, h] != [width, height] {
        let message = format!("expected a picture of {width} x {height} pixels, found {w} x {h}");
        return Ok(Some(message));
    }
    let [n, n_found] = [&expected, &found].map(Frames::count);
    if n_found != n {
        return Ok(Some(format!("expected {n} images, found {n_found}")));
    }
    let mut differences = Differences::default();
    for frame in 0..n {
        let (found, expected) = (found.next()?, expected.next()?);
        if found.control != expected.control {
            let number = frame + 1;
            let message = format!(
                "image {number} of the animation has another position, duration or blend mode than expected"
            );
            return Ok(Some(message));
        }
        let width = expected.width.max(1);
        for (i, (a, b)) in found.pixels.iter().zip(&expected.pixels).enumerate() {
            differences.total += 1;
            let channels = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
            let largest = channels.max().unwrap_or(0);
            if largest > tolerance {
                differences.n += 1;
                differences.largest = differences.largest.max(largest);
                let position = [frame as usize, i % width, i / width];
                differences.first.get_or_insert(position);
            }
        }
    }
    Ok(differences.message(n))
}

/// A summary of the pixels that differ.
#[derive(Default)]
struct Differences {
    /// The number of pixels that differ.
    n: u64,
    /// The number of all pixels.
    total: u64,
    /// The largest difference between two corresponding channels, from 0 to 255.
    largest: u8,
    /// For the first pixel that differs: the index of its image in the animation, its column and its row.
    first: Option<[usize; 3]>,
}

impl Differences {
    fn message(&self, n_frames: u32) -> Option<String> {
        let [frame, x, y] = self.first?;
        let (n, total, largest) = (self.n, self.total, self.largest);
        let image = match n_frames {
            1 => String::new(),
            _ => format!(" of image {}", frame + 1),
        };
        let (differ, by, at) = match n {
            1 => ("pixels differs", "by", ", at"),
            _ => ("pixels differ", "by at most", "; the first is at"),
        };
        Some(format!(
            "{n} of {total} {differ}, {by} {largest} of 255{at} ({x}, {y}){image}"
        ))
    }
}

/// The images of a PNG file, read one after another.
struct Frames<'b> {
    reader: Reader<Cursor<&'b [u8]>>,
    /// The index of the file: 0 for `found`, 1 for `expected`.
    file: usize,
}

struct Frame {
    pixels: Vec<[u8; 4]>,
    width: usize,
    /// The position, disposal, blend mode and duration, if the file is an animation.
    control: Option<([u32; 6], [u16; 2])>,
}

impl<'b> Frames<'b> {
    fn new(bytes: &'b [u8], file: usize) -> Result<Self, PictureError> {
        let reader = decoder(bytes).read_info();
        let reader = reader.map_err(|error| unreadable(file, &error))?;
        Ok(Self { reader, file })
    }

    fn count(&self) -> u32 {
        let animation = self.reader.info().animation_control();
        animation.map_or(1, |animation| animation.num_frames.max(1))
    }

    fn next(&mut self) -> Result<Frame, PictureError> {
        let size = self.reader.output_buffer_size();
        let size = size.ok_or_else(|| unreadable(self.file, &"the image is too large"))?;
        let mut bytes = vec![0; size];
        let info = self.reader.next_frame(&mut bytes);
        let info = info.map_err(|error| unreadable(self.file, &error))?;
        bytes.truncate(info.buffer_size());
        let control = self.reader.info().frame_control.map(|c| {
            let [dispose, blend] = [c.dispose_op as u32, c.blend_op as u32];
            let layout = [c.x_offset, c.y_offset, c.width, c.height, dispose, blend];
            (layout, [c.delay_num, c.delay_den])
        });
        Ok(Frame {
            width: info.width as usize,
            pixels: rgba(&info, bytes),
            control,
        })
    }
}

fn unreadable(file: usize, why: &dyn std::fmt::Display) -> PictureError {
    let why = why.to_string();
    PictureError::Unreadable { file, why }
}

/// Converts a color to a light gray. Lighter and more transparent colors give a lighter gray.
fn faint([r, g, b, alpha]: [u8; 4]) -> [u8; 4] {
    let [r, g, b, alpha] = [r, g, b, alpha].map(u32::from);
    let dark = alpha * (255 - (r + g + b) / 3) / 255;
    let gray = u8::try_from(255 - dark / FAINT).unwrap_or(u8::MAX);
    [gray, gray, gray, 255]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_pixels_that_differ_are_red() {
        let mut found = Image::filled(5, 4, [10, 200, 30, 255]).unwrap();
        let expected = found.clone();
        found.pixels[7] = [10, 200, 30, 254];
        found.pixels[19] = [0; 4];

        let image = difference(&expected, &found, 0).unwrap();

        let red: Vec<usize> = (0..20).filter(|&i| image.pixels[i] == DIFFERENT).collect();
        assert_eq!(red, [7, 19]);
        assert_eq!(image.pixels[0], [212, 212, 212, 255]);
        let image = difference(&expected, &found, 1).unwrap();
        let first_red = image.pixels.iter().position(|p| *p == DIFFERENT);
        assert_eq!(first_red, Some(19));
    }

    #[test]
    fn transparent_pixels_are_white_and_different_sizes_give_no_image() {
        let clear = Image::filled(2, 3, [0; 4]).unwrap();
        assert!(
            difference(&clear, &clear, 0)
                .unwrap()
                .pixels
                .iter()
                .all(|p| *p == [255; 4])
        );
        assert_eq!(
            difference(&clear, &Image::filled(3, 2, [0; 4]).unwrap(), 0),
            None
        );
    }

    /// Encodes a PNG file of 3 x 2 pixels. If there are several images, the file is an animation.
    fn file(images: &[[u8; 24]], color: png::ColorType) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
        encoder.set_color(color);
        encoder
            .add_text_chunk("Software".to_owned(), format!("{images:?}"))
            .unwrap();
        if images.len() > 1 {
            encoder
                .set_animated(u32::try_from(images.len()).unwrap(), 0)
                .unwrap();
        }
        let mut writer = encoder.write_header().unwrap();
        for image in images {
            writer
                .write_image_data(&image[..6 * color.samples()])
                .unwrap();
        }
        writer.finish().unwrap();
        bytes
    }

    const RGBA: png::ColorType = png::ColorType::Rgba;

    fn message(found: &[u8], expected: &[u8], tolerance: u8) -> Option<String> {
        compare(found, expected, tolerance).unwrap()
    }

    #[test]
    fn the_message_names_the_position_of_a_pixel_that_differs() {
        let expected = [100; 24];
        let mut found = expected;
        found[4 * 4 + 1] = 103;
        let message =
            |found, tolerance| message(&file(&[found], RGBA), &file(&[expected], RGBA), tolerance);
        assert_eq!(
            message(found, 0).as_deref(),
            Some("1 of 6 pixels differs, by 3 of 255, at (1, 1)")
        );
        assert!(message(found, 2).is_some());
        assert_eq!(message(found, 3), None);
        found[0] = 0;
        assert_eq!(
            message(found, 0).as_deref(),
            Some("2 of 6 pixels differ, by at most 100 of 255; the first is at (0, 0)")
        );
    }

    #[test]
    fn files_with_the_same_pixels_in_different_color_types_are_equal() {
        let gray = [7; 24];
        let mut rgba = [7; 24];
        rgba.iter_mut()
            .skip(3)
            .step_by(4)
            .for_each(|alpha| *alpha = 255);
        let expected = file(&[gray], png::ColorType::Rgb);
        for (image, color) in [
            (gray, png::ColorType::Grayscale),
            (gray, png::ColorType::Rgb),
            (rgba, RGBA),
        ] {
            assert_eq!(message(&file(&[image], color), &expected, 0), None);
        }
        let transparent = file(&[gray], png::ColorType::GrayscaleAlpha);
        let message = message(&transparent, &expected, 0).unwrap();
        assert!(message.contains("by at most 248"), "{message}");
    }

    #[test]
    fn every_image_of_an_animation_is_compared() {
        let (a, b) = ([1; 24], [2; 24]);
        let expected = file(&[a, b, a], RGBA);
        let message = |found: &[_]| message(&file(found, RGBA), &expected, 0);
        assert_eq!(message(&[a, b, a]), None);
        assert_eq!(
            message(&[a, b, b]).as_deref(),
            Some("6 of 18 pixels differ, by at most 1 of 255; the first is at (0, 0) of image 3")
        );
        assert_eq!(
            message(&[a, b]).as_deref(),
            Some("expected 3 images, found 2")
        );
    }

    #[test]
    fn a_broken_file_is_an_error_and_never_a_panic() {
        let good = file(&[[9; 24]; 2], RGBA);
        for i in 0..good.len() {
            let mut broken = good.clone();
            broken[i] ^= 0x55;
            let _ = compare(&good, &broken, 0);
            let cut = compare(&good, &good[..i], 0);
            assert!(
                !matches!(cut, Ok(None)) || i + 12 >= good.len(),
                "{i}: {cut:?}"
            );
        }
        for (found, expected, number) in [(&b"no picture"[..], &good[..], 0), (&good, b"", 1)] {
            let error = compare(found, expected, 0).unwrap_err();
            assert!(
                matches!(error, PictureError::Unreadable { file, .. } if file == number),
                "{error:?}"
            );
        }
    }
}
