//! Color maps, which show numbers as colors.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{byte, mix, narrow, to_linear, whole};

/// A color map, which shows numbers as colors.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum ColorMap {
    /// From dark violet through green to yellow. The brightness rises evenly, so the map also works in grayscale and
    /// for color-blind people.
    #[default]
    Viridis,
    /// From blue through light gray to red, for numbers with a meaningful middle, such as 0.
    Diverging,
    /// From black to white.
    Gray,
    /// Eight colors that are easy to distinguish. Consecutive whole numbers have different colors, and after eight
    /// numbers, the colors repeat. Use this map for numbers that identify classes, such as labels of parts.
    Classes,
}

/// Viridis at 17 evenly spaced values: Smith and van der Walt, "A Better Default Colormap for Matplotlib", 2015;
/// released under CC0.
const VIRIDIS: [[u8; 3]; 17] = [
    [68, 1, 84],
    [72, 20, 103],
    [71, 38, 119],
    [66, 56, 131],
    [59, 73, 137],
    [51, 89, 140],
    [44, 104, 142],
    [38, 119, 142],
    [33, 145, 140],
    [31, 154, 138],
    [39, 168, 131],
    [58, 184, 119],
    [88, 197, 101],
    [127, 210, 78],
    [170, 220, 50],
    [213, 226, 26],
    [253, 231, 37],
];

/// A diverging map at nine evenly spaced values: Moreland, "Diverging Color Maps for Scientific Visualization", 2009.
const DIVERGING: [[u8; 3]; 9] = [
    [59, 76, 192],
    [98, 130, 234],
    [141, 176, 254],
    [184, 208, 249],
    [221, 221, 221],
    [245, 196, 173],
    [244, 154, 123],
    [222, 96, 77],
    [180, 4, 38],
];

/// Colors for classes: Okabe and Ito, "Color Universal Design", 2008.
const CLASSES: [[u8; 3]; 8] = [
    [86, 180, 233],
    [230, 159, 0],
    [0, 158, 115],
    [204, 121, 167],
    [0, 114, 178],
    [240, 228, 66],
    [213, 94, 0],
    [150, 150, 150],
];

impl ColorMap {
    /// Returns the sRGB color at position `t` of the map. `t` is clamped to the range from 0 (first color) to 1 (last
    /// color).
    pub fn srgb(self, t: f64) -> [u8; 3] {
        let stops: &[[u8; 3]] = match self {
            Self::Viridis => &VIRIDIS,
            Self::Diverging => &DIVERGING,
            Self::Gray => &[[0; 3], [255; 3]],
            Self::Classes => &CLASSES,
        };
        let last = stops.len() - 1;
        let position = t.clamp(0.0, 1.0) * last as f64;
        let below = whole(position);
        if self == Self::Classes {
            return stops[below];
        }
        let [from, to] = [below, (below + 1).min(last)].map(|i| stops[i].map(f32::from));
        mix(from, to, narrow(position - below as f64)).map(|c| byte(c / 255.0))
    }

    /// Returns the sRGB color of a whole number in [`Classes`](Self::Classes). The colors repeat after eight numbers.
    pub fn class(self, class: f64) -> [u8; 3] {
        // The small offset prevents rounding from selecting the color of the previous class.
        self.srgb(class.floor().rem_euclid(8.0) / 7.0 + 1e-9)
    }

    /// Returns the linear red, green and blue of a number. `range` gives the numbers that the first and the last color
    /// of the color map represent. NaN is gray. If the second number of `range` is not greater than the first, all
    /// numbers have the middle color of the color map. [`Classes`](Self::Classes) ignores `range` and rounds `value`
    /// down.
    pub fn linear(self, value: f64, [low, high]: [f64; 2]) -> [f32; 3] {
        if value.is_nan() {
            return [0.3; 3];
        }
        let color = match self {
            Self::Classes => self.class(value),
            _ if high > low => self.srgb((value - low) / (high - low)),
            _ => self.srgb(0.5),
        };
        color.map(to_linear)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_a_map_have_its_first_and_last_color() {
        assert_eq!(ColorMap::Viridis.srgb(0.0), [68, 1, 84]);
        assert_eq!(ColorMap::Viridis.srgb(1.0), [253, 231, 37]);
        assert_eq!(ColorMap::Diverging.srgb(0.5), [221; 3]);
        assert_eq!(ColorMap::Gray.srgb(f64::NAN), [0; 3]);
        assert_eq!(ColorMap::Gray.srgb(2.0), [255; 3]);
    }

    #[test]
    fn the_luminance_of_viridis_rises_monotonically() {
        let luminance = |t: f64| {
            let [r, g, b] = ColorMap::Viridis.srgb(t).map(to_linear);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let steps: Vec<f32> = (0..=16).map(|i| luminance(f64::from(i) / 16.0)).collect();
        assert!(steps.windows(2).all(|w| w[0] < w[1]), "{steps:?}");
    }

    #[test]
    fn the_colors_of_classes_repeat_after_eight() {
        for class in 0..16_u32 {
            let color = ColorMap::Classes.linear(f64::from(class), [0.0, 0.0]);
            let expected = CLASSES[class as usize % 8].map(to_linear);
            assert_eq!(color, expected, "{class}");
        }
    }
}
