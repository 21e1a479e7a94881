//! Few colors for many: for files and terminals that have no more than 256.

use std::collections::{BTreeSet, HashMap};

use crate::Image;

/// At most 256 colors for all pixels of images: their own if they have no more, else those that stand for them best
/// (Dekker, "Kohonen neural networks for optimal colour quantization", 1994), and the most frequent color as it is.
#[derive(Clone, Debug)]
pub struct Palette {
    colors: Vec<[u8; 3]>,
    /// The place that stands for what is not seen.
    transparent: Option<u8>,
    /// The places of colors that were asked for.
    known: HashMap<[u8; 3], u8>,
}

/// As many pixels of all images are looked at for the palette.
const SAMPLES: usize = 1 << 18;

/// Half opaque.
const SEEN: u8 = 128;

impl Palette {
    /// The palette of these images.
    pub fn of(frames: &[Image]) -> Self {
        let has_holes = frames.iter().flat_map(|f| &f.pixels).any(|p| p[3] < SEEN);
        let room = if has_holes { 255 } else { 256 };
        let mut colors = own_colors(frames, room).unwrap_or_else(|| chosen_colors(frames, room));
        let transparent = has_holes.then(|| {
            colors.push([0; 3]);
            u8::try_from(colors.len() - 1).unwrap_or(u8::MAX)
        });
        Self {
            colors,
            transparent,
            known: HashMap::new(),
        }
    }

    /// The colors, and black for what is not seen.
    pub fn colors(&self) -> &[[u8; 3]] {
        &self.colors
    }

    /// The place that stands for what is less than half opaque, if there is such a thing.
    pub fn transparent(&self) -> Option<u8> {
        self.transparent
    }

    /// The place of the nearest color, the first of those that are equally near.
    pub fn index(&mut self, [r, g, b, a]: [u8; 4]) -> u8 {
        if let Some(transparent) = self.transparent
            && a < SEEN
        {
            return transparent;
        }
        let color = [r, g, b];
        let n = self.colors.len() - usize::from(self.transparent.is_some());
        let colors = &self.colors[..n];
        *self.known.entry(color).or_insert_with(|| {
            let nearest = nearest(colors, color);
            u8::try_from(nearest).unwrap_or(u8::MAX)
        })
    }
}

/// The place of the color that is nearest, the first of several ones.
fn nearest(colors: &[[u8; 3]], color: [u8; 3]) -> usize {
    let distance = |other: &[u8; 3]| -> u32 {
        let squares = other
            .iter()
            .zip(color)
            .map(|(&p, q)| u32::from(p.abs_diff(q)).pow(2));
        squares.sum()
    };
    let places = 0..colors.len();
    places.min_by_key(|&i| distance(&colors[i])).unwrap_or(0)
}

/// All colors of the images in order, if there are at most `room`.
fn own_colors(frames: &[Image], room: usize) -> Option<Vec<[u8; 3]>> {
    let mut colors = BTreeSet::new();
    let mut last = None;
    for &[r, g, b, a] in frames.iter().flat_map(|f| &f.pixels) {
        // Neighbors are often the same.
        if a < SEEN || last == Some([r, g, b]) {
            continue;
        }
        last = Some([r, g, b]);
        if colors.insert([r, g, b]) && colors.len() > room {
            return None;
        }
    }
    Some(colors.into_iter().collect())
}

/// Colors that stand for those of the images. The most frequent one, most often the background, is among them as it
/// is.
fn chosen_colors(frames: &[Image], room: usize) -> Vec<[u8; 3]> {
    let pixels: usize = frames.iter().map(|f| f.pixels.len()).sum();
    // An odd step does not stay in one column.
    let step = (pixels / SAMPLES) | 1;
    let seen = frames
        .iter()
        .flat_map(|f| &f.pixels)
        .filter(|p| p[3] >= SEEN);
    let samples: Vec<[u8; 4]> = seen
        .step_by(step)
        .map(|&[r, g, b, _]| [r, g, b, 255])
        .collect();
    let quantized = color_quant::NeuQuant::new(1, room, samples.as_flattened());
    let mut colors: Vec<[u8; 3]> = quantized.color_map_rgb().as_chunks().0.to_vec();
    let mut sorted = samples;
    sorted.sort_unstable();
    let most = sorted.chunk_by(|p, q| p == q).max_by_key(|run| run.len());
    if let Some(&[r, g, b, _]) = most.and_then(<[_]>::first) {
        let place = nearest(&colors, [r, g, b]);
        colors[place] = [r, g, b];
    }
    colors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colors_are_all_there() {
        let colors: Vec<[u8; 4]> = (0..=255).map(|i| [i, 255 - i, i / 2, 255]).collect();
        let mut image = Image::filled(16, 16, [0; 4]).unwrap();
        image.pixels.copy_from_slice(&colors);
        let mut palette = Palette::of(&[image.clone()]);
        assert_eq!((palette.colors().len(), palette.transparent()), (256, None));
        for [r, g, b, a] in colors {
            let place = palette.index([r, g, b, a]);
            assert_eq!(palette.colors()[usize::from(place)], [r, g, b]);
        }
        // One place is needed for what is not seen.
        image.pixels[0][3] = 0;
        let mut palette = Palette::of(&[image]);
        assert_eq!(palette.colors().len(), 256);
        assert_eq!(Some(palette.index([7, 7, 7, 100])), palette.transparent());
        assert_ne!(Some(palette.index([0, 0, 0, 255])), palette.transparent());
    }

    #[test]
    fn no_images_and_no_pixels_have_a_palette() {
        assert_eq!(Palette::of(&[]).index([1, 2, 3, 255]), 0);
        let clear = Image::filled(2, 2, [0; 4]).unwrap();
        let mut palette = Palette::of(&[clear]);
        assert_eq!(palette.transparent(), Some(0));
        assert_eq!(palette.index([1, 2, 3, 255]), 0);
    }
}
