//! Writes SVG: shapes, texts and groups, in pixels from the top left corner.
//!
//! Only what every program shows alike is used, and what becomes the same pixels on every processor: no
//! gradients, no arcs, no filters, no style sheets. Coordinates have three decimals.

use glam::DVec2;

/// A color: red, green and blue (sRGB) and alpha, from 0 to 255.
pub type Color = [u8; 4];

/// How a shape is filled and outlined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Paint {
    /// The color inside; none if nothing is filled.
    pub fill: Option<Color>,
    /// The color and the width, in pixels, of the outline.
    pub stroke: Option<(Color, f64)>,
    /// The lengths of dashes and gaps in pixels; a solid outline if empty.
    pub dashes: &'static [f64],
}

impl Paint {
    /// Filled with this color.
    pub const fn fill(color: Color) -> Self {
        Self {
            fill: Some(color),
            stroke: None,
            dashes: &[],
        }
    }

    /// Outlined in this color, `width` pixels wide.
    pub const fn stroke(color: Color, width: f64) -> Self {
        Self {
            fill: None,
            stroke: Some((color, width)),
            dashes: &[],
        }
    }

    /// The same, with an outline in dashes.
    #[must_use]
    pub const fn with_dashes(mut self, dashes: &'static [f64]) -> Self {
        self.dashes = dashes;
        self
    }

    /// The same, outlined.
    #[must_use]
    pub const fn with_stroke(mut self, color: Color, width: f64) -> Self {
        self.stroke = Some((color, width));
        self
    }
}

/// Which of the embedded fonts a text is set in.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Font {
    /// Plain text.
    #[default]
    Plain,
    /// Titles: the plain font, heavier.
    Title,
    /// Letters of formulas, in italics.
    Letter,
    /// Digits and brackets of formulas.
    Digit,
}

impl Font {
    /// The attributes that choose it, with what other machines have in its place.
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

/// A part of a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// What is written.
    pub text: String,
    /// The font.
    pub font: Font,
    /// How large the letters are, as a share of those of the whole text.
    pub size: f64,
    /// How far the letters are raised above the line, as a share of the size of the whole text.
    pub raise: f64,
    /// How far behind the part before it begins, as a share of the size of the whole text; below zero, back
    /// over it.
    pub skip: f64,
}

impl Run {
    /// A part on the line, as large as the whole text.
    pub fn new(font: Font, text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            font,
            size: 1.0,
            raise: 0.0,
            skip: 0.0,
        }
    }

    /// A subscript of digits.
    pub fn subscript(text: impl Into<String>) -> Self {
        Self {
            size: 0.7,
            raise: -0.2,
            skip: 0.02,
            ..Self::new(Font::Digit, text)
        }
    }

    /// A superscript of digits above a subscript of `below` digits.
    pub fn superscript(text: impl Into<String>, below: usize) -> Self {
        // A digit of the font is half as wide as high.
        Self {
            size: 0.7,
            raise: 0.42,
            skip: -0.35 * below as f64,
            ..Self::new(Font::Digit, text)
        }
    }
}

/// Which point of a text stands at its place.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Anchor {
    /// The beginning.
    #[default]
    Start,
    /// The middle.
    Middle,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// Its parts from left to right.
    pub runs: Vec<Run>,
    /// The height of the letters in pixels, from their highest to their lowest point.
    pub size: f64,
    /// The color.
    pub color: Color,
    /// The color and the width, in pixels, of an outline behind the letters, which keeps them apart from
    /// what they stand on.
    pub halo: Option<(Color, f64)>,
    /// Which point of it stands at its place.
    pub anchor: Anchor,
}

impl Text {
    /// A line in one font, which begins at its place.
    pub fn new(font: Font, text: impl Into<String>, size: f64, color: Color) -> Self {
        Self::of(vec![Run::new(font, text)], size, color)
    }

    /// A line of several parts, which begins at its place.
    pub fn of(runs: Vec<Run>, size: f64, color: Color) -> Self {
        Self {
            runs,
            size,
            color,
            halo: None,
            anchor: Anchor::Start,
        }
    }

    /// The same text with this point of it at its place.
    #[must_use]
    pub fn anchored(mut self, anchor: Anchor) -> Self {
        self.anchor = anchor;
        self
    }

    /// The same text with an outline behind the letters.
    #[must_use]
    pub fn with_halo(mut self, color: Color, width: f64) -> Self {
        self.halo = Some((color, width));
        self
    }
}

/// A command of an SVG path with its points: `M` begins a part, `L`, `Q` and `C` add a line and Bezier curves of degree 2
/// and 3, and `Z` joins the end of the part to its beginning.
pub type Command = (char, Vec<DVec2>);

/// What a document is made of. All numbers are rounded as they are written.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Element {
    Shape(Shape, Paint),
    Text(DVec2, Text),
    /// Begins a group with this id.
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

/// An SVG document: what is drawn later lies above.
#[derive(Clone, Debug, PartialEq)]
pub struct Svg {
    /// Pixels from left to right.
    pub width: f64,
    /// Pixels from top to bottom.
    pub height: f64,
    pub(super) elements: Vec<Element>,
}

impl Svg {
    /// An empty document of this size in pixels.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            elements: Vec::new(),
        }
    }

    /// An axis-aligned rectangle with the corner `corner` at its top left.
    pub fn rectangle(&mut self, corner: DVec2, size: DVec2, paint: &Paint) {
        let [corner, size] = [corner, size].map(rounded);
        self.shape(Shape::Rectangle { corner, size }, paint);
    }

    /// A circle.
    pub fn circle(&mut self, center: DVec2, radius: f64, paint: &Paint) {
        let (center, radius) = (rounded(center), number(radius));
        self.shape(Shape::Circle { center, radius }, paint);
    }

    /// Straight lines from point to point; nothing for less than two.
    pub fn polyline(&mut self, points: &[DVec2], paint: &Paint) {
        if points.len() >= 2 {
            self.shape(Shape::Polyline(all_rounded(points)), paint);
        }
    }

    /// A path.
    pub fn path(&mut self, path: &[Command], paint: &Paint) {
        let round = |(letter, points): &Command| (*letter, all_rounded(points));
        self.shape(Shape::Path(path.iter().map(round).collect()), paint);
    }

    /// A line of text at `place`, its base line at the height of `place`.
    pub fn text(&mut self, place: DVec2, text: &Text) {
        let element = Element::Text(rounded(place), text.clone());
        self.elements.push(element);
    }

    /// A group with an id: what `draw` draws.
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

    /// The document as a text. `provenance` says where it comes from, as its metadata.
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
                Element::Text(place, text) => {
                    // Outline and letters are two elements: `paint-order` is not known everywhere.
                    if let Some((color, width)) = text.halo {
                        let stroke = format!(
                            "fill=\"none\"{} stroke-width=\"{}\" stroke-linejoin=\"round\"",
                            paint_attribute("stroke", color),
                            number(width * 2.0)
                        );
                        line(depth, &letters(*place, text, &stroke));
                    }
                    let fill = paint_attribute("fill", text.color);
                    line(depth, &letters(*place, text, fill.trim_start()));
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
    /// The name and the attributes of its element.
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
            Self::Polyline(points) => format!("polyline points=\"{}\"", written(points, ",")),
            Self::Path(path) => {
                let commands = path.iter();
                let commands = commands.map(|(letter, p)| format!("{letter}{}", written(p, " ")));
                format!("path d=\"{}\"", commands.collect::<String>())
            }
        }
    }
}

/// Points with blanks between them.
fn written(points: &[DVec2], between: &str) -> String {
    let points = points.iter().map(|p| format!("{}{between}{}", p.x, p.y));
    points.collect::<Vec<_>>().join(" ")
}

/// The element of a text with these attributes.
fn letters(place: DVec2, text: &Text, attributes: &str) -> String {
    let anchor = match text.anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
    };
    let mut runs = String::new();
    let mut raised = 0.0;
    for run in &text.runs {
        let mut more = String::new();
        if run.size != 1.0 {
            more += &format!(" font-size=\"{}\"", number(run.size * text.size));
        }
        if run.skip != 0.0 {
            more += &format!(" dx=\"{}\"", number(run.skip * text.size));
        }
        if run.raise != raised {
            more += &format!(" dy=\"{}\"", number((raised - run.raise) * text.size));
            raised = run.raise;
        }
        let (font, text) = (run.font.attributes(), escaped(&run.text));
        runs += &format!("<tspan {font}{more}>{text}</tspan>");
    }
    let [x, y, size] = [place.x, place.y, number(text.size)];
    // Blanks at the ends and between parts count.
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

/// ` name="#rrggbb"`, and the opacity unless the color is opaque.
fn paint_attribute(name: &str, [r, g, b, a]: Color) -> String {
    let color = format!(" {name}=\"#{r:02x}{g:02x}{b:02x}\"");
    if a == u8::MAX {
        return color;
    }
    color + &format!(" {name}-opacity=\"{}\"", number(f64::from(a) / 255.0))
}

/// A number with at most three decimals. What is no number, or too large for a picture, is cut off.
pub(crate) fn number(value: f64) -> f64 {
    const LARGEST: f64 = 1e6;
    if value.is_nan() {
        return 0.0;
    }
    // Plus zero: no "-0".
    (value.clamp(-LARGEST, LARGEST) * 1000.0).round() / 1000.0 + 0.0
}

fn rounded(p: DVec2) -> DVec2 {
    DVec2::new(number(p.x), number(p.y))
}

fn all_rounded(points: &[DVec2]) -> Vec<DVec2> {
    points.iter().copied().map(rounded).collect()
}

/// The text as XML between tags: what has a meaning there is written in another way, and the rest is [shown].
pub(crate) fn escaped(text: &str) -> String {
    let text: String = text.chars().map(shown).collect();
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;")
}

/// The character that stands for one in a document: a line end or a tab becomes a blank, and what XML does not allow
/// becomes U+FFFD.
pub(super) fn shown(c: char) -> char {
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
    fn every_text_is_well_formed_and_comes_back() {
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
    fn numbers_are_short_and_never_broken() {
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
    fn shapes_are_written_as_svg_has_them() {
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
