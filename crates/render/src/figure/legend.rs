//! What the colors of a picture stand for: a bar with numbers, or a list of words.

use glam::DVec2;

use super::label::text_width;
use super::pixels::draw;
use super::svg::{Color, Font, Paint, Svg, Text};
use crate::Image;
use crate::color::whole;

/// The meaning of colors.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// Numbers between two ends.
    Continuous {
        /// The number of the first color.
        low: f64,
        /// The number of the last color.
        high: f64,
        /// Colors at equal steps from `low` to `high`.
        colors: Vec<Color>,
    },
    /// Each color has its own name; the first one stands above.
    Discrete(Vec<(String, Color)>),
}

/// A legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// What is shown; nothing is written for an empty title.
    pub title: String,
    /// The colors.
    pub scale: Scale,
}

const TEXT: Color = [0x1f, 0x29, 0x37, 255];
const LINE: Color = [0x6b, 0x72, 0x80, 255];

/// Light enough to read on, over whatever the picture shows.
const GROUND: Color = [255, 255, 255, 235];

/// From the texts to the edge, in pixels at scale 1.
const PADDING: f64 = 12.0;

/// The height of the letters, in pixels at scale 1.
const LETTERS: f64 = 13.0;

/// The width and the height of the bar, in pixels at scale 1.
const BAR: [f64; 2] = [18.0, 170.0];

/// From one entry of a list to the next, in pixels at scale 1.
const ROW: f64 = 21.0;

/// A list shows no more entries.
const MOST_ENTRIES: usize = 24;

/// Draws a legend into the upper right corner of an image, `scale` times its plain size of about 100 x 200 pixels. A list of more
/// than 24 entries says how many are not shown. What has no room in the image is cut off.
pub fn draw_legend(image: &mut Image, legend: &Legend, scale: f64) {
    let size = DVec2::new(f64::from(image.width), f64::from(image.height)) / scale;
    let own = measured(legend);
    let gap = 10.0;
    let far = (size - own - DVec2::splat(gap)).max(DVec2::ZERO);
    let place = DVec2::new(far.x, far.y.min(gap));
    let mut svg = Svg::new(size.x, size.y);
    write(&mut svg, legend, place.round(), own);
    draw(image, &svg, scale);
}

/// A legend as a figure of its own, as large as it needs to be.
pub fn legend_figure(legend: &Legend) -> Svg {
    let size = measured(legend);
    let mut svg = Svg::new(size.x, size.y);
    write(&mut svg, legend, DVec2::ZERO, size);
    svg
}

fn title(legend: &Legend) -> Text {
    Text::new(Font::Title, &*legend.title, LETTERS, TEXT)
}

fn plain(text: &str) -> Text {
    Text::new(Font::Plain, text, LETTERS, TEXT)
}

/// The names of ticks, or the entries of a list.
fn words(scale: &Scale) -> Vec<String> {
    match scale {
        Scale::Continuous { low, high, .. } => {
            ticks(*low, *high).into_iter().map(|t| t.name).collect()
        }
        Scale::Discrete(entries) => {
            let shown = entries.iter().take(MOST_ENTRIES);
            let shown = shown.map(|(name, _)| name.clone());
            let more = entries.len().saturating_sub(MOST_ENTRIES);
            let more = (more > 0).then(|| format!("and {more} more"));
            shown.chain(more).collect()
        }
    }
}

fn title_height(legend: &Legend) -> f64 {
    if legend.title.is_empty() {
        0.0
    } else {
        LETTERS + 12.0
    }
}

/// The width and the height of a legend, in whole pixels at scale 1.
fn measured(legend: &Legend) -> DVec2 {
    let words = words(&legend.scale);
    let widths = words.iter().map(|word| text_width(&plain(word)));
    let widest = widths.fold(0.0, f64::max);
    let inner = match legend.scale {
        Scale::Continuous { .. } => DVec2::new(BAR[0] + 12.0 + widest, BAR[1] + 8.0),
        Scale::Discrete(_) => DVec2::new(14.0 + 9.0 + widest, words.len() as f64 * ROW - 6.0),
    };
    let wide = inner.x.max(text_width(&title(legend)));
    let size = DVec2::new(wide, inner.y + title_height(legend));
    (size + DVec2::splat(2.0 * PADDING)).ceil()
}

fn write(svg: &mut Svg, legend: &Legend, place: DVec2, size: DVec2) {
    svg.rectangle(place, size, &Paint::fill(GROUND));
    let corner = place + DVec2::splat(PADDING);
    if !legend.title.is_empty() {
        svg.text(corner + DVec2::Y * LETTERS * 0.8, &title(legend));
    }
    let top = corner + DVec2::Y * title_height(legend);
    match &legend.scale {
        Scale::Continuous { low, high, colors } => {
            write_bar(svg, top + DVec2::Y * 4.0, [*low, *high], colors);
        }
        Scale::Discrete(entries) => {
            for (i, word) in words(&legend.scale).iter().enumerate() {
                let at = top + DVec2::Y * i as f64 * ROW;
                if let Some((_, color)) = entries.get(i).filter(|_| i < MOST_ENTRIES) {
                    let paint = Paint::fill(*color).with_stroke(LINE, 0.75);
                    svg.rectangle(at, DVec2::splat(14.0), &paint);
                }
                svg.text(at + DVec2::new(23.0, 11.7), &plain(word));
            }
        }
    }
}

/// The bar, the highest number above.
fn write_bar(svg: &mut Svg, corner: DVec2, [low, high]: [f64; 2], colors: &[Color]) {
    let [width, height] = BAR;
    // Strips of whole pixels, each of the color in its middle: gradients are not the same everywhere.
    let color_at = |share: f64| {
        let last = colors.len().saturating_sub(1);
        let i = whole((share * last as f64).round());
        colors.get(i.min(last)).copied().unwrap_or(LINE)
    };
    let mut y = 0.0;
    while y < height {
        let color = color_at(1.0 - (y + 0.5) / height);
        let mut strip = 1.0;
        while y + strip < height && color_at(1.0 - (y + strip + 0.5) / height) == color {
            strip += 1.0;
        }
        let size = DVec2::new(width, strip);
        svg.rectangle(corner + DVec2::Y * y, size, &Paint::fill(color));
        y += strip;
    }
    svg.rectangle(corner, BAR.into(), &Paint::stroke(LINE, 0.75));
    for tick in ticks(low, high) {
        let at = corner + DVec2::new(width, (1.0 - tick.share) * height);
        svg.polyline(&[at, at + DVec2::X * 5.0], &Paint::stroke(LINE, 1.0));
        let place = at + DVec2::new(9.0, LETTERS * 0.36);
        svg.text(place, &plain(&tick.name));
    }
}

/// A number on an axis.
#[derive(Clone, Debug, PartialEq)]
struct Tick {
    /// The number.
    value: f64,
    /// How far it is along the axis, from 0 to 1.
    share: f64,
    /// The number as text: all on one axis have the same number of decimals.
    name: String,
}

/// Nice numbers from `low` to `high`, about six of them: multiples of 1, 2 or 5 times a power of ten (Heckbert,
/// "Nice numbers for graph labels", Graphics Gems, 1990). One in the middle if both ends are the same, none if they
/// are not finite or `low` is above `high`.
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
    // Ends that are nearly the same leave no room for numbers between.
    let largest = low.abs().max(high.abs());
    if rough <= largest * 1e-14 {
        return vec![Tick {
            value: low,
            share: 0.5,
            name: number_name(low),
        }];
    }
    #[expect(clippy::cast_possible_truncation, reason = "from -324 to 308")]
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
    // A step is at least 1e-14 of the ends: these are whole numbers.
    #[expect(clippy::cast_possible_truncation, reason = "at most 1e15")]
    let [first, last] = [
        (low / step - 1e-9).ceil() as i64,
        (high / step + 1e-9).floor() as i64,
    ];
    (first..=last)
        .map(|i| {
            // Read from its digits: 3 steps of 0.1 are 0.3.
            let value = power(format!("{}e{exponent}", i * digit));
            Tick {
                value,
                share: ((value / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0)).clamp(0.0, 1.0),
                name: tick_name(i * digit, exponent, largest),
            }
        })
        .collect()
}

/// `digits` times 10 to the `exponent`, where `largest` is the largest number of the axis.
fn tick_name(digits: i64, exponent: i32, largest: f64) -> String {
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

/// A number of an axis that has no other.
fn number_name(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) {
        return minus(&format!("{value:.4e}"));
    }
    let text = format!("{value:.4}");
    minus(text.trim_end_matches('0').trim_end_matches('.'))
}

/// With a minus sign in place of the hyphen, and none before zero.
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

    fn names(low: f64, high: f64) -> Vec<String> {
        ticks(low, high).into_iter().map(|t| t.name).collect()
    }

    #[test]
    fn ticks_are_nice_numbers() {
        assert_eq!(names(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(names(3.0, 8.0), ["3", "4", "5", "6", "7", "8"]);
        assert_eq!(names(-1.0, 1.0), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(names(0.13, 0.31), ["0.15", "0.20", "0.25", "0.30"]);
        assert_eq!(names(0.0, 180.0), ["0", "50", "100", "150"]);
        assert_eq!(names(0.0, 2e-7), ["0e0", "5e−8", "1e−7", "1.5e−7", "2e−7"]);
    }

    #[test]
    fn ticks_lie_inside_and_in_order_for_any_ends() {
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
                assert!(found.iter().all(|t| (0.0..=1.0).contains(&t.share)));
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
        assert_eq!(names(2.5, 2.5), ["2.5"]);
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
        reason = "a legend is some hundred pixels wide"
    )]
    fn the_bar_runs_through_its_colors_from_below() {
        let mut image = Image::filled(300, 300, [0, 255, 0, 255]).unwrap();
        draw_legend(&mut image, &bar(), 1.0);
        let left = 300 - 10 - measured(&bar()).x as usize;
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
    fn a_legend_has_room_in_its_corner_or_is_cut_off() {
        let words = |n: usize| (0..n).map(|i| (format!("tag {i}"), [200, 0, 0, 255]));
        let list = |n| Legend {
            title: String::new(),
            scale: Scale::Discrete(words(n).collect()),
        };
        for legend in [bar(), list(0), list(3), list(100)] {
            for side in [1, 20, 400] {
                let mut image = Image::filled(side, side, [0, 0, 0, 255]).unwrap();
                draw_legend(&mut image, &legend, 1.0);
            }
        }
        assert_eq!(words_of(&list(100)).last().unwrap(), "and 76 more");
    }

    fn words_of(legend: &Legend) -> Vec<String> {
        words(&legend.scale)
    }

    #[test]
    fn a_scale_without_colors_is_drawn_too() {
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
