//! Color palettes, for files and terminals that have at most 256 colors.

use std::collections::{BTreeSet, HashMap};

use crate::Image;

/// A palette of at most 256 colors for several images.
///
/// All transparent pixels count as one color. If the images have at most 256 colors, the palette has exactly these
/// colors. Otherwise, the colors are quantized (Dekker, "Kohonen neural networks for optimal colour quantization",
/// 1994). In this case, only one color is always exact: the most frequent color in a sample of the pixels.
#[derive(Clone, Debug)]
pub struct Palette {
    colors: Vec<[u8; 3]>,
    /// The index of the transparent entry.
    transparent: Option<u8>,
    /// A cache: for each color that was looked up before, the index of the nearest entry.
    nearest_entries: HashMap<[u8; 3], u8>,
}

/// The approximate number of pixels, over all images, that the quantization reads.
const SAMPLES: usize = 1 << 18;

/// Pixels with at least this alpha count as opaque.
const OPAQUE_ALPHA: u8 = 128;

impl Palette {
    /// Computes the palette of these images.
    pub fn of(frames: &[Image]) -> Self {
        let mut pixels = frames.iter().flat_map(|f| &f.pixels);
        let has_transparent = pixels.any(|p| p[3] < OPAQUE_ALPHA);
        let limit = if has_transparent { 255 } else { 256 };
        let mut colors =
            distinct_colors(frames, limit).unwrap_or_else(|| quantized_colors(frames, limit));
        let transparent = has_transparent.then(|| {
            colors.push([0; 3]);
            u8::try_from(colors.len() - 1).unwrap_or(u8::MAX)
        });
        Self {
            colors,
            transparent,
            nearest_entries: HashMap::new(),
        }
    }

    /// Returns the colors of the palette's entries. The transparent entry of the palette is black.
    pub fn colors(&self) -> &[[u8; 3]] {
        &self.colors
    }

    /// Returns the index of the palette entry for pixels that are less than half opaque, if the images have such
    /// pixels.
    pub fn transparent(&self) -> Option<u8> {
        self.transparent
    }

    /// Returns the index of the nearest color. If several colors are equally near, returns the first of these colors.
    pub fn index(&mut self, [r, g, b, a]: [u8; 4]) -> u8 {
        if let Some(transparent) = self.transparent
            && a < OPAQUE_ALPHA
        {
            return transparent;
        }
        let color = [r, g, b];
        let n = self.colors.len() - usize::from(self.transparent.is_some());
        let colors = &self.colors[..n];
        *self.nearest_entries.entry(color).or_insert_with(|| {
            let nearest = nearest(colors, color);
            u8::try_from(nearest).unwrap_or(u8::MAX)
        })
    }
}

/// Returns the index of the nearest color. If several colors are equally near, returns the first of these colors.
fn nearest(colors: &[[u8; 3]], color: [u8; 3]) -> usize {
    let distance_squared = |candidate: &[u8; 3]| -> u32 {
        let squares = candidate
            .iter()
            .zip(color)
            .map(|(&p, q)| u32::from(p.abs_diff(q)).pow(2));
        squares.sum()
    };
    let indices = 0..colors.len();
    indices
        .min_by_key(|&i| distance_squared(&colors[i]))
        .unwrap_or(0)
}

/// Returns all opaque colors of the images, sorted. Returns `None` if there are more than `limit` colors.
fn distinct_colors(frames: &[Image], limit: usize) -> Option<Vec<[u8; 3]>> {
    let mut colors = BTreeSet::new();
    let mut last = None;
    for &[r, g, b, a] in frames.iter().flat_map(|f| &f.pixels) {
        // Neighboring pixels often have the same color. To save time, a pixel is skipped if it has the color of the
        // previous opaque pixel.
        if a < OPAQUE_ALPHA || last == Some([r, g, b]) {
            continue;
        }
        last = Some([r, g, b]);
        if colors.insert([r, g, b]) && colors.len() > limit {
            return None;
        }
    }
    Some(colors.into_iter().collect())
}

/// Quantizes the colors of the images. The most frequent color, usually the background, stays exact.
fn quantized_colors(frames: &[Image], limit: usize) -> Vec<[u8; 3]> {
    let pixels: usize = frames.iter().map(|f| f.pixels.len()).sum();
    // The step between samples is odd, because an even step in an image of even width could take all samples from a few
    // columns.
    let step = (pixels / SAMPLES) | 1;
    let opaque = frames
        .iter()
        .flat_map(|f| &f.pixels)
        .filter(|p| p[3] >= OPAQUE_ALPHA);
    let samples: Vec<[u8; 4]> = opaque
        .step_by(step)
        .map(|&[r, g, b, _]| [r, g, b, 255])
        .collect();
    let quantized = color_quant::NeuQuant::new(1, limit, samples.as_flattened());
    let mut colors: Vec<[u8; 3]> = quantized.color_map_rgb().as_chunks().0.to_vec();
    let mut sorted = samples;
    sorted.sort_unstable();
    let longest_run = sorted.chunk_by(|p, q| p == q).max_by_key(|run| run.len());
    if let Some(&[r, g, b, _]) = longest_run.and_then(<[_]>::first) {
        let index = nearest(&colors, [r, g, b]);
        colors[index] = [r, g, b];
    }
    colors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_to_256_colors_are_kept_exactly() {
        let colors: Vec<[u8; 4]> = (0..=255).map(|i| [i, 255 - i, i / 2, 255]).collect();
        let mut image = Image::filled(16, 16, [0; 4]).unwrap();
        image.pixels.copy_from_slice(&colors);
        let mut palette = Palette::of(&[image.clone()]);
        assert_eq!((palette.colors().len(), palette.transparent()), (256, None));
        for [r, g, b, a] in colors {
            let index = palette.index([r, g, b, a]);
            assert_eq!(palette.colors()[usize::from(index)], [r, g, b]);
        }
        // The transparent pixels need one entry of the palette.
        image.pixels[0][3] = 0;
        let mut palette = Palette::of(&[image]);
        assert_eq!(palette.colors().len(), 256);
        assert_eq!(Some(palette.index([7, 7, 7, 100])), palette.transparent());
        assert_ne!(Some(palette.index([0, 0, 0, 255])), palette.transparent());
    }

    #[test]
    fn images_without_opaque_pixels_have_a_palette() {
        assert_eq!(Palette::of(&[]).index([1, 2, 3, 255]), 0);
        let clear = Image::filled(2, 2, [0; 4]).unwrap();
        let mut palette = Palette::of(&[clear]);
        assert_eq!(palette.transparent(), Some(0));
        assert_eq!(palette.index([1, 2, 3, 255]), 0);
    }
}
