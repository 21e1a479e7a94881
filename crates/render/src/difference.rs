//! Where two images differ.

use crate::Image;

/// Where pixels differ.
const OTHER: [u8; 4] = [0xd6, 0x20, 0x28, 255];

/// How much is left of the image around that.
const FAINT: u32 = 4;

/// An image in which the pixels are red that differ between two others by more than `tolerance` steps of 255, over the
/// first one, faint and gray. `None` if their sizes differ.
pub fn difference(expected: &Image, found: &Image, tolerance: u8) -> Option<Image> {
    let is_near =
        |a: &[u8; 4], b: &[u8; 4]| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= tolerance);
    let is_as_large = (expected.width, expected.height) == (found.width, found.height);
    is_as_large.then(|| {
        let pixels = expected.pixels.iter().zip(&found.pixels);
        Image {
            width: expected.width,
            height: expected.height,
            pixels: pixels
                .map(|(a, b)| if is_near(a, b) { faint(*a) } else { OTHER })
                .collect(),
        }
    })
}

/// A light gray; lighter for light colors, and for those that are seen through.
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

        let red: Vec<usize> = (0..20).filter(|&i| image.pixels[i] == OTHER).collect();
        assert_eq!(red, [7, 19]);
        assert_eq!(image.pixels[0], [212, 212, 212, 255]);
        let image = difference(&expected, &found, 1).unwrap();
        assert_eq!(image.pixels.iter().position(|p| *p == OTHER), Some(19));
    }

    #[test]
    fn what_is_not_seen_is_white_and_other_sizes_have_no_difference() {
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
}
