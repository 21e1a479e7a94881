//! Legends, which explain the colors of a picture: a bar with numbers, or a list of names.

use glam::DVec2;

use super::label::text_width;
use super::pixels::draw;
use super::svg::{Color, Font, Paint, Svg, Text};
use crate::Image;
use crate::color::whole;

/// The colors that a legend explains.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// A range of numbers, shown as a bar.
    Continuous {
        /// The number that the first color represents.
        low: f64,
        /// The number that the last color represents.
        high: f64,
        /// The colors of numbers at equal steps from `low` to `high`.
        colors: Vec<Color>,
    },
    /// Named colors, shown as a list from top to bottom.
    Discrete(Vec<(String, Color)>),
}

/// A legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// The title above the colors. It can be empty.
    pub title: String,
    /// The colors.
    pub scale: Scale,
}

const TEXT: Color = [0x1f, 0x29, 0x37, 255];
const LINE: Color = [0x6b, 0x72, 0x80, 255];

/// The background is nearly opaque, so that the text is readable over any picture.
const BACKGROUND: Color = [255, 255, 255, 235];

/// The distance from the text to the edge of the legend, in pixels at scale 1.
const PADDING: f64 = 12.0;

/// The font size, in pixels at scale 1.
const FONT_SIZE: f64 = 13.0;

/// The width and the height of the bar, in pixels at scale 1.
const BAR: [f64; 2] = [18.0, 170.0];

/// The height of an entry of a list, in pixels at scale 1.
const ROW: f64 = 21.0;

/// The maximum number of entries of a list.
const MAX_ENTRIES: usize = 24;

/// A corner of an image, in which a legend is drawn.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Corner {
    /// Upper right.
    #[default]
    UpperRight,
    /// Upper left.
    UpperLeft,
    /// Lower right.
    LowerRight,
    /// Lower left.
    LowerLeft,
}

impl Corner {
    /// All corners, in order of preference.
    pub const ALL: [Self; 4] = [
        Self::UpperRight,
        Self::UpperLeft,
        Self::LowerRight,
        Self::LowerLeft,
    ];
}

/// Draws a legend into a corner of an image.
///
/// At scale 1, a legend has about 100 x 200 pixels. A list shows at most 24 entries, and the number of the remaining
/// entries. Parts outside of the image are cut off.
pub fn draw_legend(image: &mut Image, legend: &Legend, corner: Corner, scale: f64) {
    let image_size = DVec2::new(f64::from(image.width), f64::from(image.height)) / scale;
    let [at, size] = placed(legend, corner, image_size);
    let mut svg = Svg::new(image_size.x, image_size.y);
    write(&mut svg, legend, at, size);
    draw(image, &svg, scale);
}

/// Returns how many pixels of the image a legend in a corner would cover. Pixels of the background color are not
/// counted.
pub fn covered_pixels(
    image: &Image,
    legend: &Legend,
    corner: Corner,
    scale: f64,
    background: Color,
) -> usize {
    let image_size = DVec2::new(f64::from(image.width), f64::from(image.height));
    let [at, size] = placed(legend, corner, image_size / scale);
    let start = at * scale;
    let end = ((at + size) * scale).min(image_size);
    let row_len = image.width as usize;
    let rows = whole(start.y.floor())..whole(end.y.ceil());
    let columns = whole(start.x.floor())..whole(end.x.ceil());
    rows.map(|y| &image.pixels[y * row_len..][columns.clone()])
        .map(|row| row.iter().filter(|&&pixel| pixel != background).count())
        .sum()
}

/// Returns the upper left corner and the size of a legend in an image of this size, in pixels at scale 1.
fn placed(legend: &Legend, corner: Corner, image_size: DVec2) -> [DVec2; 2] {
    const GAP: f64 = 10.0;
    let size = legend_size(legend);
    let far = (image_size - size - DVec2::splat(GAP)).max(DVec2::ZERO);
    let near = far.min(DVec2::splat(GAP));
    let at = match corner {
        Corner::UpperRight => DVec2::new(far.x, near.y),
        Corner::UpperLeft => near,
        Corner::LowerRight => far,
        Corner::LowerLeft => DVec2::new(near.x, far.y),
    };
    [at.round(), size]
}

/// Returns a figure that contains only the legend. The figure has the size of the legend.
pub fn legend_figure(legend: &Legend) -> Svg {
    let size = legend_size(legend);
    let mut svg = Svg::new(size.x, size.y);
    write(&mut svg, legend, DVec2::ZERO, size);
    svg
}

fn title(legend: &Legend) -> Text {
    Text::new(Font::Title, &*legend.title, FONT_SIZE, TEXT)
}

fn plain(text: &str) -> Text {
    Text::new(Font::Plain, text, FONT_SIZE, TEXT)
}

/// Returns the labels of ticks, or the entries of a list.
fn labels(scale: &Scale) -> Vec<String> {
    match scale {
        Scale::Continuous { low, high, .. } => {
            ticks(*low, *high).into_iter().map(|t| t.label).collect()
        }
        Scale::Discrete(entries) => {
            let shown = entries.iter().take(MAX_ENTRIES);
            let shown = shown.map(|(name, _)| name.clone());
            let more = entries.len().saturating_sub(MAX_ENTRIES);
            let more = (more > 0).then(|| format!("and {more} more"));
            shown.chain(more).collect()
        }
    }
}

fn title_height(legend: &Legend) -> f64 {
    if legend.title.is_empty() {
        0.0
    } else {
        FONT_SIZE + 12.0
    }
}

/// Returns the width and the height of a legend, in whole pixels at scale 1.
pub(super) fn legend_size(legend: &Legend) -> DVec2 {
    let labels = labels(&legend.scale);
    let widths = labels.iter().map(|label| text_width(&plain(label)));
    let widest = widths.fold(0.0, f64::max);
    let inner = match legend.scale {
        Scale::Continuous { .. } => DVec2::new(BAR[0] + 12.0 + widest, BAR[1] + 8.0),
        Scale::Discrete(_) => DVec2::new(14.0 + 9.0 + widest, labels.len() as f64 * ROW - 6.0),
    };
    let width = inner.x.max(text_width(&title(legend)));
    let size = DVec2::new(width, inner.y + title_height(legend));
    (size + DVec2::splat(2.0 * PADDING)).ceil()
}

/// Writes a legend of this size into a figure. `corner` is the upper left corner.
pub(super) fn write(svg: &mut Svg, legend: &Legend, corner: DVec2, size: DVec2) {
    svg.rectangle(corner, size, &Paint::fill(BACKGROUND));
    let corner = corner + DVec2::splat(PADDING);
    if !legend.title.is_empty() {
        svg.text(corner + DVec2::Y * FONT_SIZE * 0.8, &title(legend));
    }
    let top = corner + DVec2::Y * title_height(legend);
    match &legend.scale {
        Scale::Continuous { low, high, colors } => {
            write_bar(svg, top + DVec2::Y * 4.0, [*low, *high], colors);
        }
        Scale::Discrete(entries) => {
            for (i, label) in labels(&legend.scale).iter().enumerate() {
                let at = top + DVec2::Y * i as f64 * ROW;
                if let Some((_, color)) = entries.get(i).filter(|_| i < MAX_ENTRIES) {
                    let paint = Paint::fill(*color).with_stroke(LINE, 0.75);
                    svg.rectangle(at, DVec2::splat(14.0), &paint);
                }
                svg.text(at + DVec2::new(23.0, 11.7), &plain(label));
            }
        }
    }
}

/// Writes the bar with its ticks, with the highest number at the top.
fn write_bar(svg: &mut Svg, corner: DVec2, [low, high]: [f64; 2], colors: &[Color]) {
    let [width, height] = BAR;
    // The bar consists of strips of whole pixels and not of an SVG gradient, because programs draw gradients
    // differently.
    let color_at = |t: f64| {
        let last = colors.len().saturating_sub(1);
        let i = whole((t * last as f64).round());
        colors.get(i.min(last)).copied().unwrap_or(LINE)
    };
    let mut y = 0.0;
    while y < height {
        let color = color_at(1.0 - (y + 0.5) / height);
        let mut strip = 1.0;
        while y + strip < height && color_at(1.0 - (y + strip + 0.5) / height) == color {
            strip += 1.0;
        }
        // Each strip of the bar extends to the bottom of the bar, and the later strips are drawn over it. Otherwise the
        // background would show between strips whose borders are not at whole pixels of the picture.
        let size = DVec2::new(width, height - y);
        svg.rectangle(corner + DVec2::Y * y, size, &Paint::fill(color));
        y += strip;
    }
    svg.rectangle(corner, BAR.into(), &Paint::stroke(LINE, 0.75));
    for tick in ticks(low, high) {
        let at = corner + DVec2::new(width, (1.0 - tick.t) * height);
        svg.polyline(&[at, at + DVec2::X * 5.0], &Paint::stroke(LINE, 1.0));
        let start = at + DVec2::new(9.0, FONT_SIZE * 0.36);
        svg.text(start, &plain(&tick.label));
    }
}

/// A number on an axis.
#[derive(Clone, Debug, PartialEq)]
struct Tick {
    /// The number.
    value: f64,
    /// The position on the axis, from 0 to 1.
    t: f64,
    /// The number as text. All labels of an axis have the same number of decimals, unless they have exponents.
    label: String,
}

/// Returns about six round numbers from `low` to `high`.
///
/// The numbers are multiples of 1, 2 or 5 times a power of ten (Heckbert, "Nice numbers for graph labels", Graphics
/// Gems, 1990). If `low` and `high` are nearly equal, there is one tick in the middle. If one of them is not finite, or
/// `low` exceeds `high`, there are no ticks.
fn ticks(low: f64, high: f64) -> Vec<Tick> {
    if !(low.is_finite() && high.is_finite() && low <= high) {
        return Vec::new();
    }
    let (span, steps) = (high - low, 5.0);
    let rough = if span.is_finite() {
        span / steps
    } else {
        high / steps - low / steps
    };
    // If the ends of the axis are nearly equal, several labels would show the same number. Therefore such an axis has
    // only one tick.
    let largest = low.abs().max(high.abs());
    if rough <= largest * 1e-14 {
        return vec![Tick {
            value: low,
            t: 0.5,
            label: single_label(low),
        }];
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the exponent is from -324 to 308"
    )]
    let mut exponent = libm::floor(libm::log10(rough)) as i32;
    let power = |text: String| text.parse::<f64>().unwrap_or(f64::MAX);
    let fraction = rough / power(format!("1e{exponent}"));
    let mut digit = [1_i64, 2, 5]
        .into_iter()
        .find(|&digit| fraction <= digit as f64 * (1.0 + 1e-9))
        .unwrap_or(10);
    if digit == 10 {
        (digit, exponent) = (1, exponent + 1);
    }
    let step = power(format!("{digit}e{exponent}"));
    // A step is at least 1e-14 times the absolute value of `low`, and at least 1e-14 times the absolute value of
    // `high`. Therefore each end divided by the step is small enough to be rounded to an exact integer in `f64`.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the quotients are at most 1e15"
    )]
    let [first, last] = [
        (low / step - 1e-9).ceil() as i64,
        (high / step + 1e-9).floor() as i64,
    ];
    (first..=last)
        .map(|i| {
            // The value is parsed from its decimal digits and not computed by a multiplication. Therefore 3 steps
            // of 0.1 give exactly 0.3.
            let value = power(format!("{}e{exponent}", i * digit));
            Tick {
                value,
                t: ((value / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0)).clamp(0.0, 1.0),
                label: tick_label(i * digit, exponent, largest),
            }
        })
        .collect()
}

/// Formats the number `digits` times 10 to the power `exponent`. `largest` is the largest absolute value on the axis.
fn tick_label(digits: i64, exponent: i32, largest: f64) -> String {
    let text = format!("{digits}e{exponent}");
    let Ok(value) = text.parse::<f64>() else {
        return text;
    };
    if exponent < -5 || largest >= 1e7 {
        return minus(&format!("{value:e}"));
    }
    let decimals = usize::try_from(-exponent).unwrap_or(0);
    minus(&format!("{value:.decimals$}"))
}

/// Formats the number of an axis that has only one number.
fn single_label(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) {
        return minus(&format!("{value:.4e}"));
    }
    let text = format!("{value:.4}");
    minus(text.trim_end_matches('0').trim_end_matches('.'))
}

/// Replaces the hyphen by a minus sign, and removes the sign of zero.
fn minus(number: &str) -> String {
    let is_zero = !number.contains(|c: char| c.is_ascii_digit() && c != '0');
    if is_zero {
        return number.trim_start_matches('-').to_owned();
    }
    number.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tick_labels(low: f64, high: f64) -> Vec<String> {
        ticks(low, high).into_iter().map(|t| t.label).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        for (low, high, expected) in [
            (0.0, 1.0, &["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"][..]),
            (3.0, 8.0, &["3", "4", "5", "6", "7", "8"]),
            (-1.0, 1.0, &["−1.0", "−0.5", "0.0", "0.5", "1.0"]),
            (0.13, 0.31, &["0.15", "0.20", "0.25", "0.30"]),
            (0.0, 180.0, &["0", "50", "100", "150"]),
            (0.0, 2e-7, &["0e0", "5e−8", "1e−7", "1.5e−7", "2e−7"]),
        ] {
            assert_eq!(tick_labels(low, high), expected);
        }
    }

    #[test]
    fn ticks_are_in_range_and_ascending_for_any_ends() {
        let ends = [
            0.0,
            1.0,
            -1.0,
            0.1,
            1e-300,
            5e-324,
            1e300,
            f64::MAX,
            -f64::MAX,
            123.456,
            1e15,
            1e-7,
        ];
        for low in ends {
            for high in ends {
                let found = ticks(low, high);
                assert_eq!(found.is_empty(), low > high, "{low} {high}");
                assert!(found.len() <= 12, "{low} {high}");
                assert!(found.iter().all(|tick| (0.0..=1.0).contains(&tick.t)));
                assert!(found.windows(2).all(|t| t[0].value < t[1].value));
                let margin = (high / 2.0 - low / 2.0) * 1e-6;
                assert!(
                    found
                        .iter()
                        .all(|t| low - margin <= t.value && t.value <= high + margin)
                );
            }
        }
        for (low, high) in [(f64::NAN, 1.0), (0.0, f64::INFINITY), (2.0, 1.0)] {
            assert_eq!(ticks(low, high), []);
        }
        assert_eq!(tick_labels(2.5, 2.5), ["2.5"]);
    }

    fn bar() -> Legend {
        let colors = (0..=255).map(|i| [i, 0, 255 - i, 255]).collect();
        Legend {
            title: "distance".into(),
            scale: Scale::Continuous {
                low: 0.0,
                high: 1.0,
                colors,
            },
        }
    }

    #[test]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a legend is at most a few hundred pixels wide"
    )]
    fn the_bar_shows_its_colors_from_bottom_to_top() {
        let mut image = Image::filled(300, 300, [0, 255, 0, 255]).unwrap();
        draw_legend(&mut image, &bar(), Corner::UpperRight, 1.0);
        let left = 300 - 10 - legend_size(&bar()).x as usize;
        let column = |x: usize| (0..300).map(move |y| y * 300 + x);
        let reds: Vec<u8> = column(left + 20)
            .map(|i| image.pixels[i])
            .filter(|p| p[1] == 0 && p[0].abs_diff(255 - p[2]) <= 1)
            .map(|p| p[0])
            .collect();
        assert!(reds.len() >= 160 && reds.windows(2).all(|r| r[0] >= r[1]));
        assert!(reds[0] > 250 && reds[reds.len() - 1] < 5);
    }

    #[test]
    fn legends_are_drawn_into_images_of_any_size() {
        let entries = |n: usize| (0..n).map(|i| (format!("tag {i}"), [200, 0, 0, 255]));
        let list = |n| Legend {
            title: String::new(),
            scale: Scale::Discrete(entries(n).collect()),
        };
        for legend in [bar(), list(0), list(3), list(100)] {
            for side in [1, 20, 400] {
                let mut image = Image::filled(side, side, [0, 0, 0, 255]).unwrap();
                draw_legend(&mut image, &legend, Corner::UpperRight, 1.0);
            }
        }
        let labels = labels(&list(100).scale);
        assert_eq!(labels.last().unwrap(), "and 76 more");
    }

    #[test]
    fn scales_with_no_or_one_color_are_drawn() {
        for colors in [vec![], vec![[1, 2, 3, 255]]] {
            let scale = Scale::Continuous {
                low: 1.0,
                high: 1.0,
                colors,
            };
            let title = "<none>".to_owned();
            let figure = legend_figure(&Legend { title, scale });
            crate::figure::pixels(&figure, 1.0, [255; 4]).unwrap();
        }
    }
}
