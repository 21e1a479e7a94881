//! Texts over images: at places of pixels, and shortened to a width.

use glam::DVec2;

use super::letters::line;
use super::pixels::draw;
use super::svg::{Anchor, Color, Font, Svg, Text};
use crate::Image;

/// A text beside a place of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The place in pixels from the top left corner.
    pub place: DVec2,
    /// What is written, with its [`Anchor`] at the place.
    pub text: Text,
}

impl Label {
    /// A label in the plain font, centered on the place, with a white halo, for points that have a number.
    pub fn new(place: DVec2, text: impl Into<String>, size: f64, color: Color) -> Self {
        let text = Text::new(Font::Plain, text, size, color)
            .with_halo([255, 255, 255, 230], size * 0.14)
            .anchored(Anchor::Middle);
        Self { place, text }
    }
}

/// Draws labels over an image, later ones above: each with the middle of its letters at the height of its place.
/// What is outside of the image is cut off.
pub fn draw_labels(image: &mut Image, labels: &[Label]) {
    let size = DVec2::new(f64::from(image.width), f64::from(image.height));
    for label in labels {
        // Each alone: the memory for one is small, however large the image is.
        let mut svg = Svg::new(size.x, size.y);
        svg.text(label.place + DVec2::Y * label.text.size * 0.36, &label.text);
        draw(image, &svg, 1.0);
    }
}

/// How far a text goes from left to right, in pixels, without its halo.
pub fn text_width(text: &Text) -> f64 {
    line(DVec2::ZERO, text).width.into()
}

/// A text of more characters fits into no image that a caption is shortened for; what is measured is bounded.
const LONGEST: usize = 4096;

/// As much of the text as fits into `width` pixels, with "…" where something is missing: in the middle, so that
/// both ends of a path are seen. Nothing if not even that fits.
pub fn shortened(text: &str, font: Font, size: f64, width: f64) -> String {
    let fits = |text: &str| text_width(&Text::new(font, text, size, [0, 0, 0, 255])) <= width;
    let characters: Vec<char> = text.chars().collect();
    if characters.len() <= LONGEST && fits(text) {
        return text.to_owned();
    }
    let kept = |n: usize| {
        let (front, back) = (n.div_ceil(2), n / 2);
        let mut text: String = characters[..front].iter().collect();
        text.push('…');
        text.extend(&characters[characters.len() - back..]);
        text
    };
    let (mut low, mut high) = (0, characters.len().min(LONGEST));
    if !fits(&kept(0)) {
        return String::new();
    }
    while high - low > 1 {
        let n = low.midpoint(high);
        if fits(&kept(n)) {
            low = n;
        } else {
            high = n;
        }
    }
    kept(low)
}

/// Parts of a text in as few lines of at most `width` pixels as their order allows, with `between` between those
/// of a line. A part that is too wide is [shortened].
pub fn filled(parts: &[&str], between: &str, font: Font, size: f64, width: f64) -> Vec<String> {
    let fits = |text: &str| text_width(&Text::new(font, text, size, [0, 0, 0, 255])) <= width;
    let mut lines: Vec<String> = Vec::new();
    for part in parts.iter().take(LONGEST) {
        if let Some(last) = lines.last_mut()
            && last.chars().count() + part.chars().count() <= LONGEST
        {
            let longer = format!("{last}{between}{part}");
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
    fn labels_stand_around_their_places() {
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
    fn a_halo_covers_what_is_below() {
        let mut image = Image::filled(60, 40, [0, 0, 200, 255]).unwrap();
        let label = Label::new(DVec2::new(30.0, 20.0), "8", 20.0, BLACK);
        draw_labels(&mut image, &[label]);
        assert!(image.pixels.iter().any(|p| p[0] > 200));
    }

    #[test]
    fn every_text_can_be_a_label_anywhere() {
        for text in ODD_TEXTS {
            for place in [
                DVec2::ZERO,
                DVec2::splat(-1e9),
                DVec2::NAN,
                DVec2::splat(30.0),
            ] {
                let mut image = Image::filled(30, 30, [255; 4]).unwrap();
                draw_labels(&mut image, &[Label::new(place, *text, 12.0, BLACK)]);
            }
        }
    }

    #[test]
    fn a_text_that_is_too_long_loses_its_middle() {
        let name = "scenes/assets/a_very_long_name_of_a_file.obj";
        let wide = text_width(&Text::new(Font::Plain, name, 12.0, BLACK));
        assert_eq!(shortened(name, Font::Plain, 12.0, wide), name);
        let short = shortened(name, Font::Plain, 12.0, wide / 2.0);
        let (front, back) = short.split_once('…').unwrap();
        assert!(name.starts_with(front) && name.ends_with(back));
        assert!(front.len().abs_diff(back.len()) <= 1 && front.len() > 5);
        assert!(text_width(&Text::new(Font::Plain, &*short, 12.0, BLACK)) <= wide / 2.0);
        assert_eq!(shortened(name, Font::Plain, 12.0, 2.0), "");
        for text in ODD_TEXTS {
            shortened(text, Font::Plain, 12.0, 20.0);
        }
        let endless = "x".repeat(100_000);
        assert!(shortened(&endless, Font::Plain, 12.0, 200.0).len() < 60);
    }

    #[test]
    fn lines_are_filled_with_whole_parts() {
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
        let lines = filled(&parts, ", ", Font::Plain, 12.0, width + 0.1);
        assert_eq!(lines[..2], ["Vertices 482, Faces 960", "Area 12.5"]);
        assert!(lines[2].contains('…') && lines.len() == 3, "{lines:?}");
        assert_eq!(filled(&[], " ", Font::Plain, 12.0, 10.0), [""; 0]);
    }
}
