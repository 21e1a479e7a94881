//! Reads the pixels of images that the program has written.

use std::fs::File;
use std::io::BufReader;

use crate::folder::Folder;

/// An opaque image.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Pixels {
    /// Width and height.
    pub(crate) size: [u32; 2],
    pixels: Vec<[u8; 3]>,
}

/// The image in a PNG file without alpha.
#[track_caller]
pub(crate) fn pixels(folder: &Folder, name: &str) -> Pixels {
    let file = BufReader::new(File::open(folder.path(name)).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    Pixels {
        size: [info.width, info.height],
        pixels: pixels.as_chunks().0.to_vec(),
    }
}

impl Pixels {
    /// Returns a rectangle of pixels, given by its upper left corner and its size.
    pub(crate) fn part(&self, [left, top]: [u32; 2], [width, height]: [u32; 2]) -> Self {
        let row = |y: u32| {
            let start = (y * self.size[0] + left) as usize;
            &self.pixels[start..start + width as usize]
        };
        Self {
            size: [width, height],
            pixels: (top..top + height).flat_map(row).copied().collect(),
        }
    }

    /// Counts the pixels that match a condition.
    pub(crate) fn count(&self, is_match: impl Fn([u8; 3]) -> bool) -> usize {
        self.pixels.iter().filter(|p| is_match(**p)).count()
    }
}
