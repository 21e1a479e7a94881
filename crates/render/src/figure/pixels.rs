//! Renders SVG documents to pixels, or draws them over images.
//!
//! `tiny-skia` draws the shapes and the outlines of letters directly, without parsing the text of the document.
//! Documents use only features that `tiny-skia` draws without processor-dependent rounding. For example, all colors are
//! plain colors, which `tiny-skia` blends in integers.

use glam::DVec2;
use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash,
    Transform,
};

use super::letters;
use super::svg::{Color, Element, Shape, Svg, number};
use crate::blend::blended;
use crate::color::{narrow, whole_u32};
use crate::image::checked_size;
use crate::{Image, PictureError};

/// Renders a document over `background`, with `scale` pixels per unit of the document.
///
/// # Errors
///
/// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`](crate::LARGEST_SIDE) pixels.
pub fn pixels(svg: &Svg, scale: f64, background: [u8; 4]) -> Result<Image, PictureError> {
    let (width, height) = pixel_size(svg, scale)?;
    let mut image = Image::filled(width, height, background)?;
    draw(&mut image, svg, scale);
    Ok(image)
}

/// Returns the width and the height of a document in whole pixels, with `scale` pixels per unit of the document.
///
/// # Errors
///
/// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`](crate::LARGEST_SIDE) pixels.
pub fn pixel_size(svg: &Svg, scale: f64) -> Result<(u32, u32), PictureError> {
    // NaN and negative numbers become 0, and a side of 0 is refused.
    let [width, height] = [svg.width, svg.height].map(|x| whole_u32((x * scale).round()));
    checked_size(width, height)?;
    Ok((width, height))
}

/// Returns how many bytes [`pixels`] needs at most for the pixels of an image of this size. Each pixel needs four bytes
/// in the image, and four bytes in a temporary image, into which the document is drawn first.
pub fn bytes_needed(width: u32, height: u32) -> u64 {
    u64::from(width) * u64::from(height) * 8
}

/// Draws a document over an image, with the top left corners of both at the same place. Parts outside of the image are
/// cut off. The required memory is proportional to the area of the bounding box of the document inside of the image.
pub fn draw(image: &mut Image, svg: &Svg, scale: f64) {
    let paths: Vec<PaintedPath> = svg.elements.iter().flat_map(PaintedPath::of).collect();
    let Some(area) = paths.iter().filter_map(PaintedPath::area).reduce(union) else {
        return;
    };
    // The bounding box of a path does not always include the caps and dashes of its strokes, so one pixel is added on
    // each side.
    let span = |low: f32, high: f32, side: u32| {
        let low = (f64::from(low) * scale).floor() - 1.0;
        let high = (f64::from(high) * scale).ceil() + 1.0;
        let [low, high] = [low, high].map(|x| whole_u32(x).min(side));
        (low, high.saturating_sub(low))
    };
    let (left, width) = span(area.left(), area.right(), image.width);
    let (top, height) = span(area.top(), area.bottom(), image.height);
    let Some(mut layer) = Pixmap::new(width, height) else {
        // The area is outside of the image.
        return;
    };
    let scale = narrow(scale);
    let transform = Transform::from_row(scale, 0.0, 0.0, scale, -(left as f32), -(top as f32));
    for path in &paths {
        path.draw(&mut layer, transform);
    }
    let rows = layer.pixels().chunks_exact(width as usize);
    let below = image.pixels.chunks_exact_mut(image.width as usize);
    let below = below.skip(top as usize);
    for (from, to) in rows.zip(below) {
        for (&over, under) in from.iter().zip(&mut to[left as usize..]) {
            let [r, g, b] = [over.red(), over.green(), over.blue()];
            let color = [r, g, b].map(|c| u32::from(c) * 255);
            *under = blended(color, over.alpha(), *under);
        }
    }
}

/// A path with its colors.
struct PaintedPath {
    path: Path,
    fill: Option<Color>,
    stroke: Option<(Color, Stroke)>,
}

impl PaintedPath {
    /// Converts an element to paths, from back to front.
    fn of(element: &Element) -> Vec<Self> {
        match element {
            Element::Shape(shape, paint) => {
                let dashes = paint.dashes.iter().copied().map(narrow).collect();
                let dash = StrokeDash::new(dashes, 0.0);
                let stroke = paint.stroke.map(|pen| stroke(pen, LineCap::Round, dash));
                let painted = |path| Self {
                    path,
                    fill: paint.fill,
                    stroke,
                };
                outline(shape).map(painted).into_iter().collect()
            }
            Element::Text(position, text) => {
                let paths = letters::line(*position, text).paths;
                let halo = text.halo.map(|(color, width)| {
                    stroke((color, number(width * 2.0)), LineCap::Butt, None)
                });
                let layers = [(None, halo), (Some(text.color), None)];
                let layers = layers.into_iter().flat_map(|(fill, stroke)| {
                    let painted = move |path: &Path| Self {
                        path: path.clone(),
                        fill,
                        stroke: stroke.clone(),
                    };
                    paths.iter().map(painted)
                });
                layers
                    .filter(|d| d.fill.is_some() || d.stroke.is_some())
                    .collect()
            }
            Element::Open(_) | Element::Close => Vec::new(),
        }
    }

    /// Returns the bounding box, without the caps of lines.
    fn area(&self) -> Option<Rect> {
        let area = self.path.compute_tight_bounds()?;
        match &self.stroke {
            Some((_, stroke)) => area.outset(stroke.width / 2.0, stroke.width / 2.0),
            None => Some(area),
        }
    }

    fn draw(&self, layer: &mut Pixmap, transform: Transform) {
        let paint = |[r, g, b, a]: Color| {
            let mut paint = Paint::default();
            paint.set_color_rgba8(r, g, b, a);
            paint
        };
        let bounds = self.path.bounds();
        // A straight path along an axis encloses no area and is not filled.
        if let Some(color) = self.fill
            && bounds.width() > 0.0
            && bounds.height() > 0.0
        {
            let rule = FillRule::Winding;
            layer.fill_path(&self.path, &paint(color), rule, transform, None);
        }
        if let Some((color, stroke)) = &self.stroke
            && stroke.width > 0.0
        {
            layer.stroke_path(&self.path, &paint(*color), stroke, transform, None);
        }
    }
}

/// Returns the smallest rectangle that contains both rectangles.
fn union(a: Rect, b: Rect) -> Rect {
    let [left, top] = [a.left().min(b.left()), a.top().min(b.top())];
    let [right, bottom] = [a.right().max(b.right()), a.bottom().max(b.bottom())];
    Rect::from_ltrb(left, top, right, bottom).unwrap_or(a)
}

/// Converts the color and the width of a line to a color and a stroke of `tiny-skia`.
fn stroke((color, width): (Color, f64), cap: LineCap, dash: Option<StrokeDash>) -> (Color, Stroke) {
    let stroke = Stroke {
        width: narrow(width),
        line_cap: cap,
        line_join: LineJoin::Round,
        dash,
        ..Stroke::default()
    };
    (color, stroke)
}

/// Returns the outline of a shape, or `None` if the outline is empty.
fn outline(shape: &Shape) -> Option<Path> {
    let mut path = PathBuilder::new();
    match shape {
        Shape::Rectangle { corner, size } => {
            let [x, y, w, h] = [corner.x, corner.y, size.x, size.y].map(narrow);
            if w <= 0.0 || h <= 0.0 {
                return None;
            }
            path.push_rect(Rect::from_xywh(x, y, w, h)?);
        }
        Shape::Circle { center, radius } => {
            if *radius <= 0.0 {
                return None;
            }
            let [x, y, r] = [center.x, center.y, *radius].map(narrow);
            // Each quarter of the circle is approximated by a cubic curve. The distance from each end of the curve to
            // the next control point is 4 / 3 * tan(pi / 8) times the radius.
            let k = r * 0.552_284_8;
            path.move_to(x + r, y);
            path.cubic_to(x + r, y + k, x + k, y + r, x, y + r);
            path.cubic_to(x - k, y + r, x - r, y + k, x - r, y);
            path.cubic_to(x - r, y - k, x - k, y - r, x, y - r);
            path.cubic_to(x + k, y - r, x + r, y - k, x + r, y);
            path.close();
        }
        Shape::Polyline(points) => {
            for (i, p) in points.iter().enumerate() {
                let [x, y] = point(*p);
                if i == 0 {
                    path.move_to(x, y);
                } else {
                    path.line_to(x, y);
                }
            }
        }
        Shape::Path(commands) => {
            for (letter, points) in commands {
                let points: Vec<[f32; 2]> = points.iter().copied().map(point).collect();
                match (letter, &points[..]) {
                    ('M', &[[x, y]]) => path.move_to(x, y),
                    ('L', &[[x, y]]) => path.line_to(x, y),
                    ('Q', &[[x1, y1], [x, y]]) => path.quad_to(x1, y1, x, y),
                    ('C', &[[x1, y1], [x2, y2], [x, y]]) => path.cubic_to(x1, y1, x2, y2, x, y),
                    _ => path.close(),
                }
            }
        }
    }
    path.finish()
}

fn point(p: DVec2) -> [f32; 2] {
    [p.x, p.y].map(narrow)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::svg::{Font, Paint, Run, Text};

    const BLACK: [u8; 4] = [0, 0, 0, 255];
    const WHITE: [u8; 4] = [255; 4];

    #[test]
    fn a_rectangle_fills_exactly_its_pixels() {
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
    fn the_sum_of_the_alphas_of_a_disc_is_its_area() {
        let mut svg = Svg::new(100.0, 100.0);
        svg.circle(DVec2::new(50.3, 49.8), 40.0, &Paint::fill(BLACK));
        let image = pixels(&svg, 1.0, [0, 0, 0, 0]).unwrap();
        let area: f64 = image.pixels.iter().map(|p| f64::from(p[3]) / 255.0).sum();
        let exact = std::f64::consts::PI * 1600.0;
        assert!((area - exact).abs() < 0.003 * exact, "{area}");
    }

    #[test]
    fn unusual_texts_are_drawn() {
        for text in crate::figure::testing::ODD_TEXTS {
            let mut svg = Svg::new(200.0, 30.0);
            let line = Text::new(Font::Plain, *text, 16.0, BLACK).with_halo(WHITE, 2.0);
            svg.text(DVec2::new(4.0, 20.0), &line);
            let image = pixels(&svg, 1.0, [0; 4]).unwrap();
            let is_drawn = image.pixels.iter().any(|p| p[3] > 0);
            let has_letters = text.chars().any(|c| c.is_ascii_graphic());
            assert!(is_drawn || !has_letters, "{text:?}");
        }
    }

    #[test]
    fn fonts_have_different_letters() {
        let draw = |font| {
            let mut svg = Svg::new(40.0, 30.0);
            svg.text(DVec2::new(4.0, 24.0), &Text::new(font, "b2", 24.0, BLACK));
            pixels(&svg, 1.0, WHITE).unwrap()
        };
        let images = [Font::Plain, Font::Title, Font::Letter, Font::Digit].map(draw);
        for i in 0..4 {
            assert!(images[..i].iter().all(|image| *image != images[i]));
        }
    }

    #[test]
    fn a_letter_of_a_formula_is_drawn_alike_beside_other_runs() {
        let draw = |runs| {
            let mut svg = Svg::new(40.0, 30.0);
            svg.text(DVec2::new(4.0, 24.0), &Text::of(runs, 24.0, BLACK));
            let image = pixels(&svg, 1.0, WHITE).unwrap();
            (0..30)
                .map(|y| image.pixels[y * 40..y * 40 + 14].to_vec())
                .collect::<Vec<_>>()
        };
        let letter = Run::new(Font::Letter, "c");
        let alone = draw(vec![letter.clone()]);
        assert_eq!(
            draw(vec![letter, Run::new(Font::Digit, "(")])[18..],
            alone[18..]
        );
    }

    #[test]
    fn shapes_outside_of_the_image_are_cut_off() {
        let mut svg = Svg::new(10.0, 10.0);
        for x in [-50.0, 300.0] {
            svg.circle(DVec2::new(x, 5.0), 3.0, &Paint::fill(BLACK));
            let mut image = Image::filled(8, 8, WHITE).unwrap();
            let before = image.clone();
            draw(&mut image, &svg, 1.0);
            assert_eq!(image, before);
        }
        svg.circle(DVec2::new(0.0, 0.0), 3.0, &Paint::fill(BLACK));
        let mut image = Image::filled(8, 8, WHITE).unwrap();
        draw(&mut image, &svg, 1.0);
        assert_eq!((image.pixels[0], image.pixels[63]), (BLACK, WHITE));
    }

    #[test]
    fn invalid_sizes_are_refused() {
        for (side, scale) in [(0.0, 1.0), (10.0, 1e9), (f64::NAN, 1.0), (-3.0, 1.0)] {
            let refused = pixels(&Svg::new(side, 10.0), scale, WHITE);
            assert!(matches!(refused, Err(PictureError::Size { .. })));
        }
    }
}
