//! Encodes animations as APNG and GIF files.

use progress::Progress;

use crate::image::{encoder, samples};
use crate::palette::Palette;
use crate::work::Work;
use crate::{Image, PictureError};

/// The duration of the images of an animation, and the number of repetitions.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Timing {
    /// The duration of each image in milliseconds. In a GIF file, the duration is rounded up to hundredths of a second.
    pub delay: u16,
    /// The number of times that the animation plays. 0 means that the animation repeats forever.
    pub plays: u16,
}

/// Encodes images as an animated PNG file, which keeps all colors and their transparency.
///
/// Each entry of `texts` is a pair of strings: a keyword of 1 to 79 Latin-1 characters, and its text.
///
/// # Errors
///
/// Returns [`PictureError::Encode`] if there are no images, the sizes of the images differ, or a keyword is invalid.
/// Returns [`PictureError::Cancelled`] if the listener cancels the work.
pub fn to_apng(
    frames: &[Image],
    timing: Timing,
    texts: &[(&str, &str)],
    progress: &dyn Progress,
) -> Result<Vec<u8>, PictureError> {
    common_size(frames)?;
    let n = u32::try_from(frames.len()).map_err(|_| encode("too many images"))?;
    let mut bytes = Vec::new();
    let (mut encoder, channels) = encoder(&mut bytes, frames, texts)?;
    encoder.set_animated(n, u32::from(timing.plays))?;
    encoder.set_frame_delay(timing.delay, 1000)?;
    let mut writer = encoder.write_header()?;
    let work = Work::new(progress, "encode", frames.len() as u64);
    for frame in frames {
        work.add(1)?;
        writer.write_image_data(&samples(&frame.pixels, channels))?;
    }
    writer.finish()?;
    Ok(bytes)
}

/// Encodes images as a GIF file, with one [`Palette`] for all images.
///
/// Pixels that are less than half opaque become transparent. All other pixels become opaque. `comment` is a string that
/// is stored in the file, for example to record its provenance.
///
/// # Errors
///
/// Returns [`PictureError::Encode`] if there are no images, the sizes of the images differ, or a side is longer than
/// 65535 pixels. Returns [`PictureError::Cancelled`] if the listener cancels the work.
pub fn to_gif(
    frames: &[Image],
    timing: Timing,
    comment: Option<&str>,
    progress: &dyn Progress,
) -> Result<Vec<u8>, PictureError> {
    let (width, height) = common_size(frames)?;
    let side = |side: u32| u16::try_from(side).map_err(|_| encode("the images are too large"));
    let (width, height) = (side(width)?, side(height)?);
    let mut palette = Palette::of(frames);
    let colors = palette.colors().as_flattened().to_vec();
    let mut bytes = Vec::new();
    let mut encoder = gif::Encoder::new(&mut bytes, width, height, &colors)?;
    encoder.set_repeat(match timing.plays {
        0 => gif::Repeat::Infinite,
        // A GIF file stores how often the animation is repeated after it has played once.
        plays => gif::Repeat::Finite(plays - 1),
    })?;
    if let Some(comment) = comment {
        // In a GIF file, the blocks of an extension have at most 255 bytes.
        let blocks: Vec<&[u8]> = comment.as_bytes().chunks(255).collect();
        encoder.write_raw_extension(gif::Extension::Comment.into(), &blocks)?;
    }
    let work = Work::new(progress, "encode", frames.len() as u64);
    for frame in frames {
        work.add(1)?;
        let buffer: Vec<u8> = frame.pixels.iter().map(|&p| palette.index(p)).collect();
        let frame = gif::Frame {
            width,
            height,
            delay: timing.delay.div_ceil(10),
            // If the images have transparent pixels, each image is cleared before the next one is shown. Otherwise, the
            // previous image would stay visible where the next image is transparent.
            dispose: if palette.transparent().is_some() {
                gif::DisposalMethod::Background
            } else {
                gif::DisposalMethod::Keep
            },
            transparent: palette.transparent(),
            buffer: buffer.into(),
            ..gif::Frame::default()
        };
        encoder.write_frame(&frame)?;
    }
    drop(encoder);
    Ok(bytes)
}

fn encode(message: &str) -> PictureError {
    PictureError::Encode(message.to_owned())
}

/// Returns the size of the images. All images must have the same size.
fn common_size(frames: &[Image]) -> Result<(u32, u32), PictureError> {
    let [Image { width, height, .. }, rest @ ..] = frames else {
        return Err(encode("expected at least 1 image, found 0"));
    };
    for (number, frame) in (2..).zip(rest) {
        let (w, h) = (frame.width, frame.height);
        if (w, h) != (*width, *height) {
            return Err(PictureError::Encode(format!(
                "expected all images to have {width} x {height} pixels, found {w} x {h} in image {number}"
            )));
        }
    }
    Ok((*width, *height))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::work::Listener;
    use progress::NoProgress;
    use std::io::Cursor;

    const TIMING: Timing = Timing {
        delay: 45,
        plays: 0,
    };

    /// Makes images with a smooth gradient of more than 256 colors, or, if `is_smooth` is false, with few colors.
    fn frames(n: u8, is_smooth: bool, alpha: impl Fn(u8, u8) -> u8) -> Vec<Image> {
        let color = |k: u8, x: u8, y: u8| {
            if is_smooth {
                [x * 4, y * 5, k * 40, alpha(x, y)]
            } else {
                [x / 16 * 60, y / 16 * 60, k * 20, alpha(x, y)]
            }
        };
        let frame = |k| {
            let mut image = Image::filled(64, 48, [0; 4]).unwrap();
            let positions = (0..48).flat_map(|y| (0..64).map(move |x| (x, y)));
            image.pixels = positions.map(|(x, y)| color(k, x, y)).collect();
            image
        };
        (0..n).map(frame).collect()
    }

    /// Decodes an APNG file into its frames and their delays.
    fn decoded_apng(bytes: &[u8]) -> Vec<(Vec<u8>, u16, u16)> {
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let n = reader.info().animation_control().unwrap().num_frames;
        (0..n)
            .map(|_| {
                let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
                let size = reader.next_frame(&mut pixels).unwrap().buffer_size();
                pixels.truncate(size);
                let control = *reader.info().frame_control().unwrap();
                (pixels, control.delay_num, control.delay_den)
            })
            .collect()
    }

    #[test]
    fn an_apng_file_has_all_pixels_of_all_images() {
        for (alpha, channels) in [(255, 3), (77, 4)] {
            let frames = frames(3, true, |_, _| alpha);
            let bytes = to_apng(&frames, TIMING, &[("Software", "test")], &NoProgress).unwrap();
            let decoded = decoded_apng(&bytes);
            assert_eq!(decoded.len(), 3);
            for ((pixels, num, den), frame) in decoded.iter().zip(&frames) {
                let expected: Vec<u8> = frame
                    .pixels
                    .iter()
                    .flat_map(|p| p[..channels].to_vec())
                    .collect();
                assert_eq!(*pixels, expected);
                assert_eq!(u32::from(*num) * 1000 / u32::from(*den), 45);
            }
        }
    }

    /// Decodes a GIF file into its frames as RGBA, and the delays in hundredths of a second.
    fn decoded_gif(bytes: &[u8]) -> Vec<(Vec<[u8; 4]>, u16)> {
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            let (pixels, rest) = frame.buffer.as_chunks();
            assert!(rest.is_empty());
            frames.push((pixels.to_vec(), frame.delay));
        }
        frames
    }

    #[test]
    fn a_gif_file_with_few_colors_has_the_exact_pixels() {
        let frames = frames(4, false, |_, _| 255);
        let decoded = decoded_gif(&to_gif(&frames, TIMING, Some("test"), &NoProgress).unwrap());
        assert_eq!(decoded.len(), 4);
        for ((pixels, delay), frame) in decoded.iter().zip(&frames) {
            assert_eq!(*pixels, frame.pixels);
            assert_eq!(*delay, 5);
        }
    }

    #[test]
    fn a_gif_file_with_many_colors_has_similar_colors() {
        let mut frames = frames(3, true, |_, _| 255);
        // Quantization must not change the color of the background.
        for frame in &mut frames {
            frame.pixels[..900].fill([251, 253, 254, 255]);
        }
        let bytes = to_gif(&frames, TIMING, None, &NoProgress).unwrap();
        let decoded = decoded_gif(&bytes);
        for ((pixels, _), frame) in decoded.iter().zip(&frames) {
            assert_eq!(pixels[..900], frame.pixels[..900]);
            let error: u32 = pixels
                .as_flattened()
                .iter()
                .zip(frame.pixels.as_flattened())
                .map(|(&p, &q)| u32::from(p.abs_diff(q)))
                .sum();
            let mean = f64::from(error) / (pixels.len() * 3) as f64;
            assert!(mean < 8.0, "{mean}");
        }
        assert_eq!(bytes, to_gif(&frames, TIMING, None, &NoProgress).unwrap());
    }

    #[test]
    fn pixels_that_are_less_than_half_opaque_are_transparent_in_a_gif_file() {
        for is_smooth in [false, true] {
            let frames = frames(2, is_smooth, |x, _| if x < 20 { 127 } else { 128 });
            let decoded = decoded_gif(&to_gif(&frames, TIMING, None, &NoProgress).unwrap());
            for (pixels, _) in decoded {
                for (i, p) in pixels.iter().enumerate() {
                    assert_eq!(p[3], if i % 64 < 20 { 0 } else { 255 });
                }
            }
        }
        let transparent = Image::filled(3, 3, [9, 9, 9, 0]).unwrap();
        let decoded = decoded_gif(&to_gif(&[transparent], TIMING, None, &NoProgress).unwrap());
        assert!(decoded[0].0.iter().all(|p| p[3] == 0));
    }

    #[test]
    fn unusual_texts_and_comments_are_encoded() {
        let frame = Image::filled(2, 2, [9, 9, 9, 255]).unwrap();
        let long = "long ".repeat(200);
        for text in crate::figure::testing::ODD_TEXTS
            .iter()
            .copied()
            .chain([long.as_str()])
        {
            let frames = std::slice::from_ref(&frame);
            assert_eq!(
                decoded_gif(&to_gif(frames, TIMING, Some(text), &NoProgress).unwrap()).len(),
                1
            );
            to_apng(frames, TIMING, &[("Software", text)], &NoProgress).unwrap();
        }
    }

    #[test]
    fn images_of_different_sizes_and_empty_lists_are_refused() {
        let image = |width| Image::filled(width, 2, [0; 4]).unwrap();
        for frames in [vec![], vec![image(2), image(3)]] {
            for result in [
                to_apng(&frames, TIMING, &[], &NoProgress),
                to_gif(&frames, TIMING, None, &NoProgress),
            ] {
                assert!(matches!(result, Err(PictureError::Encode(_))));
            }
        }
    }

    #[test]
    fn encoding_can_be_cancelled() {
        let frame = Image::filled(8, 8, [7; 4]).unwrap();
        let frames = vec![frame.clone(); 9];
        let until_half = Listener(|fraction| fraction < 0.5);
        for result in [
            frame.to_png_with_progress(&[], &until_half),
            to_apng(&frames, TIMING, &[], &until_half),
            to_gif(&frames, TIMING, None, &until_half),
        ] {
            assert!(matches!(result, Err(PictureError::Cancelled)), "{result:?}");
        }
    }
}
