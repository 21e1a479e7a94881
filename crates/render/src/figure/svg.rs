//! Writes SVG documents: shapes, text and groups, in pixels from the top left corner.
//!
//! Apart from text, documents use only features that look the same in all programs and give the same pixels on every
//! processor. The fonts of text are not in the document. Documents have no gradients, arcs, filters or style sheets.
//! Coordinates have three decimals.

use glam::DVec2;

/// A color: red, green and blue (sRGB) and alpha, from 0 to 255.
pub type Color = [u8; 4];

/// The fill and the outline of a shape.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Paint {
    /// The color of the inside. If `None`, the shape is not filled.
    pub fill: Option<Color>,
    /// The color and the width, in pixels, of the outline. If `None`, the shape has no outline.
    pub stroke: Option<(Color, f64)>,
    /// The lengths of dashes and gaps in pixels. If empty, the outline is solid.
    pub dashes: &'static [f64],
}

impl Paint {
    /// Creates a paint that fills with this color, without an outline.
    pub const fn fill(color: Color) -> Self {
        Self {
            fill: Some(color),
            stroke: None,
            dashes: &[],
        }
    }

    /// Creates a paint that draws an outline of this color, `width` pixels wide, without a fill.
    pub const fn stroke(color: Color, width: f64) -> Self {
        Self {
            fill: None,
            stroke: Some((color, width)),
            dashes: &[],
        }
    }

    /// Makes the outline dashed. `dashes` are the lengths of dashes and gaps in pixels.
    #[must_use]
    pub const fn with_dashes(mut self, dashes: &'static [f64]) -> Self {
        self.dashes = dashes;
        self
    }

    /// Adds an outline.
    #[must_use]
    pub const fn with_stroke(mut self, color: Color, width: f64) -> Self {
        self.stroke = Some((color, width));
        self
    }
}

/// The embedded font of a text.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Font {
    /// Plain text.
    #[default]
    Plain,
    /// Titles: the plain font in semibold.
    Title,
    /// Letters of formulas, in italics.
    Letter,
    /// Digits and brackets of formulas.
    Digit,
}

impl Font {
    /// Returns the SVG attributes of the font, with fallback fonts for machines that do not have the font.
    fn attributes(self) -> &'static str {
        match self {
            Self::Plain => "font-family=\"Inter, Helvetica, Arial, sans-serif\"",
            Self::Title => {
                "font-family=\"Inter, Helvetica, Arial, sans-serif\" font-weight=\"600\""
            }
            Self::Letter => {
                "font-family=\"KaTeX_Math, 'STIX Two Text', 'Times New Roman', serif\" font-style=\"italic\""
            }
            Self::Digit => "font-family=\"KaTeX_Main, 'STIX Two Text', 'Times New Roman', serif\"",
        }
    }
}

/// A part of a text with one font and size.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The characters.
    pub text: String,
    /// The font.
    pub font: Font,
    /// The font size, as a fraction of the size of the text.
    pub size: f64,
    /// The distance above the baseline, as a fraction of the size of the text.
    pub raise: f64,
    /// The gap after the previous run, as a fraction of the size of the text. A negative gap means that the run
    /// overlaps the previous run.
    pub skip: f64,
}

impl Run {
    /// Creates a run that stands on the baseline. The font size of the run is the size of the text.
    pub fn new(font: Font, text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            font,
            size: 1.0,
            raise: 0.0,
            skip: 0.0,
        }
    }

    /// Creates a subscript of digits.
    pub fn subscript(text: impl Into<String>) -> Self {
        Self {
            size: 0.7,
            raise: -0.2,
            skip: 0.02,
            ..Self::new(Font::Digit, text)
        }
    }

    /// Creates a superscript of digits above the previous run. The previous run must be a subscript of `n_subscript`
    /// digits.
    pub fn superscript(text: impl Into<String>, n_subscript: usize) -> Self {
        // The width of a digit is half the font size. The font size of subscripts and superscripts is 0.7 times the
        // size of the text.
        Self {
            size: 0.7,
            raise: 0.42,
            skip: -0.35 * n_subscript as f64,
            ..Self::new(Font::Digit, text)
        }
    }
}

/// The point of the baseline that lies at the position of a text.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Anchor {
    /// The start of the baseline.
    #[default]
    Start,
    /// The middle of the baseline.
    Middle,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The runs from left to right.
    pub runs: Vec<Run>,
    /// The font size in pixels.
    pub size: f64,
    /// The color.
    pub color: Color,
    /// The color and the width, in pixels, of an outline behind the letters. The outline makes the letters readable on
    /// any background.
    pub halo: Option<(Color, f64)>,
    /// The point of the baseline that lies at the position of the text.
    pub anchor: Anchor,
}

impl Text {
    /// Creates a line of text in one font. The position of the text is the start of its baseline.
    pub fn new(font: Font, text: impl Into<String>, size: f64, color: Color) -> Self {
        Self::of(vec![Run::new(font, text)], size, color)
    }

    /// Creates a line of text from several runs. The position of the text is the start of its baseline.
    pub fn of(runs: Vec<Run>, size: f64, color: Color) -> Self {
        Self {
            runs,
            size,
            color,
            halo: None,
            anchor: Anchor::Start,
        }
    }

    /// Sets the anchor.
    #[must_use]
    pub fn anchored(mut self, anchor: Anchor) -> Self {
        self.anchor = anchor;
        self
    }

    /// Adds an outline behind the letters.
    #[must_use]
    pub fn with_halo(mut self, color: Color, width: f64) -> Self {
        self.halo = Some((color, width));
        self
    }
}

/// A command of an SVG path with its points: `M` starts a subpath, `L` adds a line, `Q` and `C` add Bezier curves of
/// degree 2 and 3, and `Z` closes the subpath.
pub type Command = (char, Vec<DVec2>);

/// An element of a document. All numbers are already rounded to three decimals, as in the SVG text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Element {
    Shape(Shape, Paint),
    /// A text at a position.
    Text(DVec2, Text),
    /// Starts a group with this id.
    Open(String),
    Close,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Rectangle { corner: DVec2, size: DVec2 },
    Circle { center: DVec2, radius: f64 },
    Polyline(Vec<DVec2>),
    Path(Vec<Command>),
}

/// An SVG document. Later elements are drawn on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Svg {
    /// The width in pixels.
    pub width: f64,
    /// The height in pixels.
    pub height: f64,
    pub(super) elements: Vec<Element>,
}

impl Svg {
    /// Creates an empty document of this size in pixels.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            elements: Vec::new(),
        }
    }

    /// Adds an axis-aligned rectangle with its top left corner at `corner`.
    pub fn rectangle(&mut self, corner: DVec2, size: DVec2, paint: &Paint) {
        let [corner, size] = [corner, size].map(rounded);
        self.shape(Shape::Rectangle { corner, size }, paint);
    }

    /// Adds a circle.
    pub fn circle(&mut self, center: DVec2, radius: f64, paint: &Paint) {
        let (center, radius) = (rounded(center), number(radius));
        self.shape(Shape::Circle { center, radius }, paint);
    }

    /// Adds straight lines between consecutive points. Adds nothing if there are fewer than two points.
    pub fn polyline(&mut self, points: &[DVec2], paint: &Paint) {
        if points.len() >= 2 {
            self.shape(Shape::Polyline(all_rounded(points)), paint);
        }
    }

    /// Adds a path.
    pub fn path(&mut self, path: &[Command], paint: &Paint) {
        let round = |(letter, points): &Command| (*letter, all_rounded(points));
        self.shape(Shape::Path(path.iter().map(round).collect()), paint);
    }

    /// Adds a line of text with its anchor at `position`.
    pub fn text(&mut self, position: DVec2, text: &Text) {
        let element = Element::Text(rounded(position), text.clone());
        self.elements.push(element);
    }

    /// Adds a group with this id. The group contains the elements that `draw` adds.
    pub fn group(&mut self, id: &str, draw: impl FnOnce(&mut Self)) {
        self.elements.push(Element::Open(id.to_owned()));
        draw(self);
        self.elements.push(Element::Close);
    }

    fn shape(&mut self, shape: Shape, paint: &Paint) {
        let mut paint = *paint;
        paint.stroke = paint.stroke.map(|(color, width)| (color, number(width)));
        self.elements.push(Element::Shape(shape, paint));
    }

    /// Returns the document as text. `provenance` is written as the metadata of the document.
    pub fn finish(&self, provenance: Option<&str>) -> String {
        let [w, h] = [self.width, self.height].map(number);
        let mut xml = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\">\n"
        );
        if let Some(provenance) = provenance {
            xml += &format!("  <metadata>{}</metadata>\n", escaped(provenance));
        }
        let mut depth = 1_usize;
        for element in &self.elements {
            let mut line = |depth, text: &str| xml += &format!("{:1$}{text}\n", "", 2 * depth);
            match element {
                Element::Shape(shape, paint) => {
                    let (shape, paint) = (shape.attributes(), paint.attributes());
                    line(depth, &format!("<{shape}{paint}/>"));
                }
                Element::Text(position, text) => {
                    // The outline and the letters are separate elements, because not all programs support
                    // `paint-order`.
                    if let Some((color, width)) = text.halo {
                        let stroke = format!(
                            "fill=\"none\"{} stroke-width=\"{}\" stroke-linejoin=\"round\"",
                            paint_attribute("stroke", color),
                            number(width * 2.0)
                        );
                        line(depth, &text_element(*position, text, &stroke));
                    }
                    let fill = paint_attribute("fill", text.color);
                    line(depth, &text_element(*position, text, fill.trim_start()));
                }
                Element::Open(id) => {
                    let id = escaped(id).replace('"', "&quot;");
                    line(depth, &format!("<g id=\"{id}\">"));
                    depth += 1;
                }
                Element::Close => {
                    depth -= 1;
                    line(depth, "</g>");
                }
            }
        }
        xml + "</svg>\n"
    }
}

impl Shape {
    /// Returns the name and the attributes of the element.
    fn attributes(&self) -> String {
        match self {
            Self::Rectangle { corner, size } => format!(
                "rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"",
                corner.x, corner.y, size.x, size.y
            ),
            Self::Circle {
                center: DVec2 { x, y },
                radius,
            } => format!("circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\""),
            Self::Polyline(points) => {
                format!("polyline points=\"{}\"", coordinates(points, ","))
            }
            Self::Path(path) => {
                let commands = path
                    .iter()
                    .map(|(letter, p)| format!("{letter}{}", coordinates(p, " ")));
                format!("path d=\"{}\"", commands.collect::<String>())
            }
        }
    }
}

/// Formats points, separated by spaces, with `separator` between x and y.
fn coordinates(points: &[DVec2], separator: &str) -> String {
    let points = points.iter().map(|p| format!("{}{separator}{}", p.x, p.y));
    points.collect::<Vec<_>>().join(" ")
}

/// Returns the SVG element of a text, with these attributes.
fn text_element(position: DVec2, text: &Text, attributes: &str) -> String {
    let anchor = match text.anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
    };
    let mut runs = String::new();
    let mut raised = 0.0;
    for run in &text.runs {
        let mut layout = String::new();
        if run.size != 1.0 {
            layout += &format!(" font-size=\"{}\"", number(run.size * text.size));
        }
        if run.skip != 0.0 {
            layout += &format!(" dx=\"{}\"", number(run.skip * text.size));
        }
        if run.raise != raised {
            layout += &format!(" dy=\"{}\"", number((raised - run.raise) * text.size));
            raised = run.raise;
        }
        let (font, text) = (run.font.attributes(), escaped(&run.text));
        runs += &format!("<tspan {font}{layout}>{text}</tspan>");
    }
    let [x, y, size] = [position.x, position.y, number(text.size)];
    // The attribute `xml:space` preserves spaces at the ends of the text and between runs.
    format!(
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{anchor} {attributes} xml:space=\"preserve\">{runs}</text>"
    )
}

impl Paint {
    fn attributes(&self) -> String {
        let mut attributes = match self.fill {
            Some(color) => paint_attribute("fill", color),
            None => " fill=\"none\"".to_owned(),
        };
        if let Some((color, width)) = self.stroke {
            attributes += &paint_attribute("stroke", color);
            attributes += &format!(
                " stroke-width=\"{width}\" stroke-linecap=\"round\" stroke-linejoin=\"round\""
            );
            if !self.dashes.is_empty() {
                let dashes: Vec<String> = self.dashes.iter().map(ToString::to_string).collect();
                attributes += &format!(" stroke-dasharray=\"{}\"", dashes.join(" "));
            }
        }
        attributes
    }
}

/// Returns the attribute ` name="#rrggbb"`. If the color is not opaque, also returns an attribute with the opacity.
fn paint_attribute(name: &str, [r, g, b, a]: Color) -> String {
    let color = format!(" {name}=\"#{r:02x}{g:02x}{b:02x}\"");
    if a == u8::MAX {
        return color;
    }
    color + &format!(" {name}-opacity=\"{}\"", number(f64::from(a) / 255.0))
}

/// Rounds a number to three decimals and clamps it to the range from -1e6 to 1e6. NaN becomes 0.
pub(crate) fn number(value: f64) -> f64 {
    const LIMIT: f64 = 1e6;
    if value.is_nan() {
        return 0.0;
    }
    // Adding zero turns -0 into 0, so that -0 is never written.
    (value.clamp(-LIMIT, LIMIT) * 1000.0).round() / 1000.0 + 0.0
}

fn rounded(p: DVec2) -> DVec2 {
    DVec2::new(number(p.x), number(p.y))
}

fn all_rounded(points: &[DVec2]) -> Vec<DVec2> {
    points.iter().copied().map(rounded).collect()
}

/// Escapes a text for XML, after replacing some characters (see [`printable`]).
pub(crate) fn escaped(text: &str) -> String {
    let text: String = text.chars().map(printable).collect();
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;")
}

/// Replaces a line end or a tab by a space. Replaces any other control character, and any other character that XML does
/// not allow, by U+FFFD.
pub(super) fn printable(c: char) -> char {
    match c {
        '\t' | '\n' | '\r' => ' ',
        '\0'..='\x1f' | '\x7f'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: Color = [0, 0, 0, 255];

    #[test]
    fn unusual_texts_are_well_formed_and_can_be_parsed() {
        for text in crate::figure::testing::ODD_TEXTS {
            let mut svg = Svg::new(100.0, 50.0);
            let line = Text::new(Font::Plain, *text, 12.0, BLACK).with_halo([255; 4], 2.0);
            svg.group(text, |svg| svg.text(DVec2::new(3.0, 20.0), &line));
            let xml = svg.finish(Some(text));
            let document = roxmltree::Document::parse(&xml).unwrap();
            let plain: String = text
                .chars()
                .map(|c| match c {
                    '\t' | '\n' | '\r' => ' ',
                    c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => '\u{fffd}',
                    c => c,
                })
                .collect();
            let texts: Vec<_> = document
                .descendants()
                .filter(|n| n.has_tag_name("tspan") || n.has_tag_name("metadata"))
                .map(|n| n.text().unwrap_or_default())
                .collect();
            assert_eq!(texts, [plain.as_str(); 3]);
            let group = document.descendants().find(|n| n.has_tag_name("g"));
            assert_eq!(group.unwrap().attribute("id"), Some(plain.as_str()));
        }
    }

    #[test]
    fn numbers_have_three_decimals_and_are_finite() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0001, "0"),
            (1.0 / 3.0, "0.333"),
            (-2.5, "-2.5"),
            (f64::NAN, "0"),
            (f64::INFINITY, "1000000"),
            (-1e300, "-1000000"),
        ] {
            assert_eq!(number(value).to_string(), text);
        }
    }

    #[test]
    fn shapes_are_written_as_svg_elements() {
        let mut svg = Svg::new(10.0, 20.5);
        let [a, b] = [DVec2::ZERO, DVec2::new(1.0, 2.25)];
        svg.polyline(&[a], &Paint::fill(BLACK));
        svg.polyline(&[a, b], &Paint::stroke([255, 0, 16, 51], 1.5));
        let path = [('M', vec![a]), ('C', vec![a, b, b]), ('Z', vec![])];
        svg.path(&path, &Paint::fill(BLACK));
        assert_eq!(
            svg.finish(None),
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10\" height=\"20.5\" viewBox=\"0 0 10 20.5\">\n  \
             <polyline points=\"0,0 1,2.25\" fill=\"none\" stroke=\"#ff0010\" stroke-opacity=\"0.2\" \
             stroke-width=\"1.5\" stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n  \
             <path d=\"M0 0C0 0 1 2.25 1 2.25Z\" fill=\"#000000\"/>\n</svg>\n"
        );
    }
}
