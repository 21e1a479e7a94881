//! The pixels of an SVG document, and drawing over images.
//!
//! `resvg` draws, with the fonts of this crate and no others: a character that they do not have is left out. Our
//! documents keep to what it draws without rounding that depends on the processor: plain colors over what is
//! there, which it adds in whole numbers.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, fontdb};

use super::svg::Svg;
use crate::blend::blended;
use crate::image::checked_size;
use crate::{Image, PictureError};

/// The embedded fonts. `fonts/README.md` says where they come from.
static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    for bytes in [
        &include_bytes!("../../fonts/Inter-Regular.ttf")[..],
        include_bytes!("../../fonts/Inter-SemiBold.ttf"),
        include_bytes!("../../fonts/KaTeX_Math-Italic.ttf"),
        include_bytes!("../../fonts/KaTeX_Main-Regular.ttf"),
    ] {
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(bytes)));
    }
    fonts.set_sans_serif_family("Inter");
    fonts.set_serif_family("KaTeX_Main");
    Arc::new(fonts)
});

/// The pixels of a document, each unit of it `scale` pixels long, over `background`.
///
/// # Errors
///
/// [`PictureError::Size`] if a side is not from 1 to [`LARGEST_SIDE`](crate::LARGEST_SIDE) pixels;
/// [`PictureError::Encode`] if the document is none.
pub fn pixels(svg: &Svg, scale: f64, background: [u8; 4]) -> Result<Image, PictureError> {
    let (width, height) = pixel_size(svg, scale)?;
    let mut image = Image::filled(width, height, background)?;
    draw(&mut image, svg, scale)?;
    Ok(image)
}

/// The width and the height of a document in whole pixels, each unit of it `scale` pixels long.
///
/// # Errors
///
/// [`PictureError::Size`] if a side is not from 1 to [`LARGEST_SIDE`](crate::LARGEST_SIDE) pixels.
pub fn pixel_size(svg: &Svg, scale: f64) -> Result<(u32, u32), PictureError> {
    // A number that is none, or below zero, becomes 0 and is refused.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates"
    )]
    let [width, height] = [svg.width(), svg.height()].map(|x| (x * scale).round() as u32);
    checked_size(width, height)?;
    Ok((width, height))
}

/// The bytes that [`pixels`] takes at most: four for each pixel of the result and of the layer that is drawn.
pub fn bytes_needed(width: u32, height: u32) -> u64 {
    u64::from(width) * u64::from(height) * 8
}

/// Draws a document over an image, its top left corner on that of the image. What lies outside of the image is
/// cut off. Takes memory for the part that is drawn on.
///
/// # Errors
///
/// [`PictureError::Encode`] if the document is none.
pub fn draw(image: &mut Image, svg: &Svg, scale: f64) -> Result<(), PictureError> {
    let tree = parsed(&svg.finish(None))?;
    // The box of strokes is not always tight around dashes and caps: one pixel more.
    let area = tree.root().abs_layer_bounding_box();
    let span = |low: f32, high: f32, side: u32| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates"
        )]
        let [low, high] = [
            (f64::from(low) * scale).floor() - 1.0,
            (f64::from(high) * scale).ceil() + 1.0,
        ]
        .map(|x| x.clamp(0.0, f64::from(side)) as u32);
        (low, high.saturating_sub(low))
    };
    let (left, width) = span(area.left(), area.right(), image.width);
    let (top, height) = span(area.top(), area.bottom(), image.height);
    let Some(mut layer) = Pixmap::new(width, height) else {
        // Nothing of it is inside.
        return Ok(());
    };
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the rasterizer has 32-bit numbers"
    )]
    let place = Transform::from_row(
        scale as f32,
        0.0,
        0.0,
        scale as f32,
        -(left as f32),
        -(top as f32),
    );
    resvg::render(&tree, place, &mut layer.as_mut());
    let rows = layer.pixels().chunks_exact(width as usize);
    let below = image
        .pixels
        .chunks_exact_mut(image.width as usize)
        .skip(top as usize);
    for (from, to) in rows.zip(below) {
        for (&over, under) in from.iter().zip(&mut to[left as usize..]) {
            let [r, g, b] = [over.red(), over.green(), over.blue()];
            let color = [r, g, b].map(|c| u32::from(c) * 255);
            *under = blended(color, over.alpha(), *under);
        }
    }
    Ok(())
}

/// How wide and how high a document is drawn: what encloses everything in it, from the left, top, right and
/// bottom. `None` if it draws nothing.
pub(crate) fn extent(svg: &Svg) -> Option<[f64; 4]> {
    let tree = parsed(&svg.finish(None)).ok()?;
    if !tree.root().has_children() {
        return None;
    }
    let b = tree.root().abs_bounding_box();
    Some([b.left(), b.top(), b.right(), b.bottom()].map(f64::from))
}

fn parsed(xml: &str) -> Result<usvg::Tree, PictureError> {
    let select_fallback = usvg::FontResolver::default_fallback_selector();
    let options = usvg::Options {
        font_family: "Inter".to_owned(),
        fontdb: FONTS.clone(),
        font_resolver: usvg::FontResolver {
            // A part of a formula is looked for in the font of every other part, and a font that has the
            // whole formula would take the place of all.
            select_fallback: Box::new(move |c, used, fonts| {
                let first = used.first().and_then(|&id| fonts.face(id));
                let of_formula = first.is_some_and(|face| face.families[0].0.starts_with("KaTeX"));
                (!of_formula).then(|| select_fallback(c, used, fonts))?
            }),
            ..usvg::FontResolver::default()
        },
        ..usvg::Options::default()
    };
    usvg::Tree::from_str(xml, &options).map_err(|error| PictureError::Encode(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::svg::{Font, Paint, Run, Text};
    use glam::DVec2;

    const BLACK: [u8; 4] = [0, 0, 0, 255];
    const WHITE: [u8; 4] = [255; 4];

    #[test]
    fn a_rectangle_fills_its_pixels_and_no_others() {
        let mut svg = Svg::new(6.0, 4.0);
        let red = [200, 10, 20, 255];
        svg.rectangle(
            DVec2::new(1.0, 2.0),
            DVec2::new(3.0, 1.0),
            &Paint::fill(red),
        );
        let image = pixels(&svg, 2.0, WHITE).unwrap();
        assert_eq!((image.width, image.height), (12, 8));
        for (i, &pixel) in image.pixels.iter().enumerate() {
            let (x, y) = (i % 12, i / 12);
            let inside = (2..8).contains(&x) && (4..6).contains(&y);
            assert_eq!(pixel, if inside { red } else { WHITE }, "{x} {y}");
        }
    }

    #[test]
    fn a_disc_has_its_area_in_gray_values() {
        let mut svg = Svg::new(100.0, 100.0);
        svg.circle(DVec2::new(50.3, 49.8), 40.0, &Paint::fill(BLACK));
        let image = pixels(&svg, 1.0, [0, 0, 0, 0]).unwrap();
        let area: f64 = image.pixels.iter().map(|p| f64::from(p[3]) / 255.0).sum();
        let exact = std::f64::consts::PI * 1600.0;
        assert!((area - exact).abs() < 0.003 * exact, "{area}");
    }

    #[test]
    fn every_text_is_drawn_without_harm() {
        for text in crate::figure::ODD_TEXTS {
            let mut svg = Svg::new(200.0, 30.0);
            let line = Text::new(Font::Plain, *text, 16.0, BLACK).with_halo(WHITE, 2.0);
            svg.text(DVec2::new(4.0, 20.0), &line);
            let image = pixels(&svg, 1.0, [0; 4]).unwrap();
            let is_drawn = image.pixels.iter().any(|p| p[3] > 0);
            let is_known = text.chars().any(|c| c.is_ascii_graphic());
            assert!(is_drawn || !is_known, "{text:?}");
        }
    }

    #[test]
    fn every_font_has_its_own_letters() {
        let drawn = |font| {
            let mut svg = Svg::new(40.0, 30.0);
            svg.text(DVec2::new(4.0, 24.0), &Text::new(font, "b2", 24.0, BLACK));
            pixels(&svg, 1.0, WHITE).unwrap()
        };
        let fonts = [Font::Plain, Font::Title, Font::Letter, Font::Digit].map(drawn);
        for i in 0..4 {
            assert!(fonts[..i].iter().all(|other| *other != fonts[i]));
        }
    }

    #[test]
    fn a_letter_of_a_formula_keeps_its_font_beside_other_parts() {
        let drawn = |runs| {
            let mut svg = Svg::new(40.0, 30.0);
            svg.text(DVec2::new(4.0, 24.0), &Text::of(runs, 24.0, BLACK));
            let image = pixels(&svg, 1.0, WHITE).unwrap();
            (0..30)
                .map(|y| image.pixels[y * 40..y * 40 + 14].to_vec())
                .collect::<Vec<_>>()
        };
        let letter = Run::new(Font::Letter, "c");
        let alone = drawn(vec![letter.clone()]);
        assert_eq!(
            drawn(vec![letter, Run::new(Font::Digit, "(")])[18..],
            alone[18..]
        );
    }

    #[test]
    fn what_is_drawn_outside_is_cut_off() {
        let mut svg = Svg::new(10.0, 10.0);
        for x in [-50.0, 300.0] {
            svg.circle(DVec2::new(x, 5.0), 3.0, &Paint::fill(BLACK));
            let mut image = Image::filled(8, 8, WHITE).unwrap();
            let before = image.clone();
            draw(&mut image, &svg, 1.0).unwrap();
            assert_eq!(image, before);
        }
        svg.circle(DVec2::new(0.0, 0.0), 3.0, &Paint::fill(BLACK));
        let mut image = Image::filled(8, 8, WHITE).unwrap();
        draw(&mut image, &svg, 1.0).unwrap();
        assert_eq!((image.pixels[0], image.pixels[63]), (BLACK, WHITE));
    }

    #[test]
    fn sizes_that_no_image_has_are_refused() {
        for (side, scale) in [(0.0, 1.0), (10.0, 1e9), (f64::NAN, 1.0), (-3.0, 1.0)] {
            let refused = pixels(&Svg::new(side, 10.0), scale, WHITE);
            assert!(matches!(refused, Err(PictureError::Size { .. })));
        }
    }
}
