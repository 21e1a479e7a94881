//! Draws text over images, and fits text to a width.

use glam::DVec2;

use super::letters::line;
use super::pixels::draw;
use super::svg::{Anchor, Color, Font, Svg, Text};
use crate::Image;

/// A text at a point of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The position in pixels from the top left corner.
    pub position: DVec2,
    /// The text. The [`Anchor`] of the text (the start or the middle of the baseline) determines the horizontal
    /// alignment.
    pub text: Text,
}

impl Label {
    /// Creates a label in the plain font, centered at the position, with a white halo.
    pub fn new(position: DVec2, text: impl Into<String>, size: f64, color: Color) -> Self {
        let text = Text::new(Font::Plain, text, size, color)
            .with_halo([255, 255, 255, 230], size * 0.14)
            .anchored(Anchor::Middle);
        Self { position, text }
    }
}

/// Draws labels over an image. Later labels are drawn on top. The letters of a label are vertically centered at its
/// position. Parts outside of the image are cut off.
pub fn draw_labels(image: &mut Image, labels: &[Label]) {
    let size = DVec2::new(f64::from(image.width), f64::from(image.height));
    for label in labels {
        // Each label is drawn as a separate document. A single document with all labels would need memory for the
        // bounding box of all labels together.
        let mut svg = Svg::new(size.x, size.y);
        svg.text(
            label.position + DVec2::Y * label.text.size * 0.36,
            &label.text,
        );
        draw(image, &svg, 1.0);
    }
}

/// Returns the width of a text in pixels, without its halo.
pub fn text_width(text: &Text) -> f64 {
    line(DVec2::ZERO, text).width.into()
}

/// The maximum number of characters of a string that are measured. This limits the time for very long strings, which
/// would rarely fit into an image anyway.
const MAX_CHARACTERS: usize = 4096;

/// Shortens a text so that it fits into `width` pixels.
///
/// The middle of the text is replaced by "…", so that both ends of a path stay visible. The result is empty if the
/// width is too small even for "…".
pub fn shortened(text: &str, font: Font, size: f64, width: f64) -> String {
    let fits = |text: &str| text_width(&Text::new(font, text, size, [0, 0, 0, 255])) <= width;
    let characters: Vec<char> = text.chars().collect();
    if characters.len() <= MAX_CHARACTERS && fits(text) {
        return text.to_owned();
    }
    let keep = |n: usize| {
        let (front, back) = (n.div_ceil(2), n / 2);
        let mut text: String = characters[..front].iter().collect();
        text.push('…');
        text.extend(&characters[characters.len() - back..]);
        text
    };
    let (mut low, mut high) = (0, characters.len().min(MAX_CHARACTERS));
    if !fits(&keep(0)) {
        return String::new();
    }
    while high - low > 1 {
        let n = low.midpoint(high);
        if fits(&keep(n)) {
            low = n;
        } else {
            high = n;
        }
    }
    keep(low)
}

/// Wraps the parts of a text into lines of at most `width` pixels. The parts of a line are joined by `separator`. A
/// part that is too wide for a line is [shortened]. Only the first 4096 parts are kept.
pub fn wrapped(parts: &[&str], separator: &str, font: Font, size: f64, width: f64) -> Vec<String> {
    let fits = |text: &str| text_width(&Text::new(font, text, size, [0, 0, 0, 255])) <= width;
    let mut lines: Vec<String> = Vec::new();
    for part in parts.iter().take(MAX_CHARACTERS) {
        if let Some(last) = lines.last_mut()
            && last.chars().count() + part.chars().count() <= MAX_CHARACTERS
        {
            let longer = format!("{last}{separator}{part}");
            if fits(&longer) {
                *last = longer;
                continue;
            }
        }
        lines.push(shortened(part, font, size, width));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::testing::ODD_TEXTS;

    const BLACK: Color = [0, 0, 0, 255];

    #[test]
    fn labels_are_centered_at_their_positions() {
        let mut image = Image::filled(80, 40, [255; 4]).unwrap();
        let label = Label::new(DVec2::new(50.0, 20.0), "88", 20.0, BLACK);
        draw_labels(&mut image, &[label]);
        let dark: Vec<DVec2> = (0..80 * 40)
            .filter(|&i| image.pixels[i][0] < 100)
            .map(|i| DVec2::new((i % 80) as f64 + 0.5, (i / 80) as f64 + 0.5))
            .collect();
        let middle = dark.iter().sum::<DVec2>() / dark.len() as f64;
        assert!(middle.distance(DVec2::new(50.0, 20.0)) < 1.0, "{middle}");
    }

    #[test]
    fn a_halo_covers_the_image() {
        let mut image = Image::filled(60, 40, [0, 0, 200, 255]).unwrap();
        let label = Label::new(DVec2::new(30.0, 20.0), "8", 20.0, BLACK);
        draw_labels(&mut image, &[label]);
        assert!(image.pixels.iter().any(|p| p[0] > 200));
    }

    #[test]
    fn labels_of_any_text_at_any_position_are_drawn() {
        for text in ODD_TEXTS {
            for position in [
                DVec2::ZERO,
                DVec2::splat(-1e9),
                DVec2::NAN,
                DVec2::splat(30.0),
            ] {
                let mut image = Image::filled(30, 30, [255; 4]).unwrap();
                draw_labels(&mut image, &[Label::new(position, *text, 12.0, BLACK)]);
            }
        }
    }

    #[test]
    fn a_text_that_is_too_long_loses_its_middle() {
        let name = "scenes/assets/a_very_long_name_of_a_file.obj";
        let width = text_width(&Text::new(Font::Plain, name, 12.0, BLACK));
        assert_eq!(shortened(name, Font::Plain, 12.0, width), name);
        let short = shortened(name, Font::Plain, 12.0, width / 2.0);
        let (front, back) = short.split_once('…').unwrap();
        assert!(name.starts_with(front) && name.ends_with(back));
        assert!(front.len().abs_diff(back.len()) <= 1 && front.len() > 5);
        assert!(text_width(&Text::new(Font::Plain, &*short, 12.0, BLACK)) <= width / 2.0);
        assert_eq!(shortened(name, Font::Plain, 12.0, 2.0), "");
        for text in ODD_TEXTS {
            shortened(text, Font::Plain, 12.0, 20.0);
        }
        let very_long = "x".repeat(100_000);
        assert!(shortened(&very_long, Font::Plain, 12.0, 200.0).len() < 60);
    }

    #[test]
    fn lines_break_between_parts() {
        let parts = [
            "Vertices 482",
            "Faces 960",
            "Area 12.5",
            "x".repeat(300).leak() as &str,
        ];
        let width = text_width(&Text::new(
            Font::Plain,
            "Vertices 482, Faces 960",
            12.0,
            BLACK,
        ));
        let lines = wrapped(&parts, ", ", Font::Plain, 12.0, width + 0.1);
        assert_eq!(lines[..2], ["Vertices 482, Faces 960", "Area 12.5"]);
        assert!(lines[2].contains('…') && lines.len() == 3, "{lines:?}");
        assert_eq!(wrapped(&[], " ", Font::Plain, 12.0, 10.0), [""; 0]);
    }
}
