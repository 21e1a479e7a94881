//! The outlines of lines of text, in the fonts of this crate and no others.
//!
//! A character that its font does not have comes from the first of the others that has it, except in formulas, and is left
//! out if none has it. Letters are kerned, and accents are put onto their letters. There is no right-to-left text: the
//! fonts have no letters of that kind.

use std::sync::LazyLock;

use glam::DVec2;
use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::gdef::GlyphClass;
use ttf_parser::gpos::{self, AnchorMatrix, PairAdjustment, PositioningSubtable};
use ttf_parser::opentype_layout::Class;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::svg::{Anchor, Font, Text, number, shown};
use crate::color::narrow;

/// The embedded fonts in the order in which a missing character is looked for. `fonts/README.md` says where they come
/// from.
static FACES: LazyLock<[Typeface; 4]> = LazyLock::new(|| {
    [
        &include_bytes!("../../fonts/Inter-Regular.ttf")[..],
        include_bytes!("../../fonts/Inter-SemiBold.ttf"),
        include_bytes!("../../fonts/KaTeX_Math-Italic.ttf"),
        include_bytes!("../../fonts/KaTeX_Main-Regular.ttf"),
    ]
    .map(|bytes| Typeface::new(Face::parse(bytes, 0).expect("the fonts are embedded")))
});

/// A line of text as it is drawn.
pub(super) struct Line {
    /// The outlines of the letters, in one path for each part of the text that has any.
    pub(super) paths: Vec<Path>,
    /// How far it goes from left to right, blanks included.
    pub(super) width: f32,
}

/// The line with its [`Anchor`] at `place`.
pub(super) fn line(place: DVec2, text: &Text) -> Line {
    let clusters = clusters(text);
    let mut advance = 0.0;
    let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
    for cluster in &clusters {
        let start = advance + cluster.shift[0];
        let end = start + cluster.advance();
        left = left.min(start).min(end);
        right = right.max(start).max(end);
        advance += cluster.advance();
    }
    let Some(first) = clusters.first() else {
        return Line {
            paths: Vec::new(),
            width: 0.0,
        };
    };
    let width = right - left;
    let mut x = first.shift[0] - left
        + match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -width / 2.0,
        };
    let origin = Transform::from_translate(narrow(place.x), narrow(place.y));
    let mut paths = Vec::new();
    for run in clusters.chunk_by(|a, b| a.run == b.run) {
        let mut builder = PathBuilder::new();
        for cluster in run {
            let [right, down] = cluster.shift;
            let place = origin.pre_translate(x + right, down);
            cluster.outline(place, &mut builder);
            x += cluster.advance();
        }
        paths.extend(builder.finish());
    }
    Line { paths, width }
}

/// A letter and the accents on it.
struct Cluster {
    /// The part of the text that it belongs to.
    run: usize,
    face: &'static Typeface,
    /// The size of the letters.
    size: f32,
    /// How far it and all that follow are moved to the right and down.
    shift: [f32; 2],
    /// The way to the next cluster, in units of the font.
    units: i32,
    /// The glyphs, and how far each is from the origin, in units of the font.
    glyphs: Vec<(GlyphId, [i32; 2])>,
}

impl Cluster {
    fn scale(&self) -> f32 {
        self.size / f32::from(self.face.face.units_per_em())
    }

    fn advance(&self) -> f32 {
        self.units as f32 * self.scale()
    }

    /// Adds the outlines of the letter whose origin is moved to `place`.
    fn outline(&self, place: Transform, builder: &mut PathBuilder) {
        for &(glyph, [x, y]) in &self.glyphs {
            let mut outline = Outline::default();
            self.face.face.outline_glyph(glyph, &mut outline);
            // Fonts have y upwards.
            let place = place
                .pre_scale(self.scale(), self.scale())
                .pre_translate(x as f32, -y as f32)
                .pre_scale(1.0, -1.0);
            if let Some(path) = outline.0.finish().and_then(|path| path.transform(place)) {
                builder.push_path(&path);
            }
        }
    }
}

/// The letters of a text from left to right.
fn clusters(text: &Text) -> Vec<Cluster> {
    let characters: Vec<(usize, char)> = text
        .runs
        .iter()
        .enumerate()
        .flat_map(|(i, run)| run.text.chars().map(move |c| (i, shown(c))))
        .collect();
    let mut clusters: Vec<Cluster> = Vec::with_capacity(characters.len());
    let mut shift = [0.0; 2];
    let (mut begun, mut raised) = (0, 0.0);
    for (i, &(number_of_run, c)) in characters.iter().enumerate() {
        let run = &text.runs[number_of_run];
        if begun <= number_of_run {
            begun = number_of_run + 1;
            shift[0] += narrow(number(run.skip * text.size));
            shift[1] += narrow(number((raised - run.raise) * text.size));
            raised = run.raise;
        }
        let (face, glyph) = Typeface::of(run.font, c);
        if face.is_mark(glyph)
            && let Some(letter) = clusters.last_mut()
            && std::ptr::eq(letter.face, face)
        {
            letter.glyphs.push((glyph, face.mark_place(letter, glyph)));
            continue;
        }
        // Accents do not part a letter from the next one.
        let next = characters[i + 1..]
            .iter()
            .map(|(_, c)| face.glyph(*c))
            .find(|&glyph| !face.is_mark(glyph));
        let is_ignored = glyph == GlyphId(0) && is_invisible(c);
        clusters.push(Cluster {
            run: number_of_run,
            face,
            size: narrow(number(run.size * text.size)),
            shift,
            units: if is_ignored {
                0
            } else {
                face.advance(glyph) + next.map_or(0, |next| face.kerning(glyph, next))
            },
            glyphs: vec![(glyph, [0; 2])],
        });
    }
    clusters
}

/// Whether a character that no font has takes no room: one that joins, parts or directs others.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
        | '\u{fe00}'..='\u{fe0f}' | '\u{feff}')
}

/// A font and where its letters stand beside each other.
struct Typeface {
    face: Face<'static>,
    /// The tables that say so, each a list whose first entry for a letter holds.
    positions: Vec<Vec<PositioningSubtable<'static>>>,
}

impl Typeface {
    fn new(face: Face<'static>) -> Self {
        let tables = face.tables().gpos.into_iter();
        let lookups = tables.flat_map(|table| table.lookups);
        let positions = lookups.map(|l| l.subtables.into_iter().collect()).collect();
        Self { face, positions }
    }

    /// The font that has a character in text of this font, and its glyph there; glyph 0 if none has it.
    fn of(font: Font, c: char) -> (&'static Self, GlyphId) {
        let (own, others) = match font {
            Font::Plain => (0, &FACES[..]),
            Font::Title => (1, &FACES[..]),
            // Another font would not fit beside the other parts of a formula.
            Font::Letter => (2, &[][..]),
            Font::Digit => (3, &[][..]),
        };
        let own = &FACES[own];
        std::iter::once(own)
            .chain(others)
            .map(|face| (face, face.glyph(c)))
            .find(|(_, glyph)| *glyph != GlyphId(0))
            .unwrap_or((own, GlyphId(0)))
    }

    fn glyph(&self, c: char) -> GlyphId {
        self.face.glyph_index(c).unwrap_or_default()
    }

    fn is_mark(&self, glyph: GlyphId) -> bool {
        let classes = self.face.tables().gdef;
        classes.and_then(|table| table.glyph_class(glyph)) == Some(GlyphClass::Mark)
    }

    fn advance(&self, glyph: GlyphId) -> i32 {
        self.face.glyph_hor_advance(glyph).unwrap_or(0).into()
    }

    /// How far two letters beside each other are moved apart.
    fn kerning(&self, first: GlyphId, second: GlyphId) -> i32 {
        let of = |table: &PositioningSubtable| {
            let PositioningSubtable::Pair(pairs) = table else {
                return None;
            };
            let index = pairs.coverage().get(first)?;
            let (value, _) = match pairs {
                PairAdjustment::Format1 { sets, .. } => sets.get(index)?.get(second)?,
                PairAdjustment::Format2 {
                    classes, matrix, ..
                } => matrix.get((classes.0.get(first), classes.1.get(second)))?,
            };
            Some(i32::from(value.x_advance))
        };
        self.positions
            .iter()
            .filter_map(|tables| tables.iter().find_map(of))
            .sum()
    }

    /// Where an accent stands on a letter with others: on the last of them, if the font says where, or on the letter.
    fn mark_place(&self, letter: &Cluster, mark: GlyphId) -> [i32; 2] {
        let (base, _) = letter.glyphs[0];
        let (last, [x, y]) = letter.glyphs[letter.glyphs.len() - 1];
        let on_letter = |table: &PositioningSubtable| match table {
            PositioningSubtable::MarkToBase(t) => {
                let anchor = t.marks.get(t.mark_coverage.get(mark)?)?;
                on(anchor, t.anchors, t.base_coverage.get(base)?)
            }
            _ => None,
        };
        let on_mark = |table: &PositioningSubtable| match table {
            PositioningSubtable::MarkToMark(t) => {
                let anchor = t.marks.get(t.mark1_coverage.get(mark)?)?;
                let [dx, dy] = on(anchor, t.mark2_matrix, t.mark2_coverage.get(last)?)?;
                Some([x + dx, y + dy])
            }
            _ => None,
        };
        let tables = || self.positions.iter().flatten();
        let place = tables().find_map(on_mark);
        place
            .or_else(|| tables().find_map(on_letter))
            .unwrap_or([letter.units, 0])
    }
}

/// How far a mark with this anchor is from the base of this number that it stands on, if the font says where.
fn on((class, anchor): (Class, gpos::Anchor), places: AnchorMatrix, base: u16) -> Option<[i32; 2]> {
    let place = places.get(base, class)?;
    Some([place.x - anchor.x, place.y - anchor.y].map(i32::from))
}

/// The outline of a glyph in units of its font.
#[derive(Default)]
struct Outline(PathBuilder);

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn width(font: Font, text: &str) -> f32 {
        line(DVec2::ZERO, &Text::new(font, text, 100.0, [0, 0, 0, 255])).width
    }

    #[test]
    fn letters_are_kerned_across_parts_of_a_text() {
        let [a, v, both] = ["A", "V", "AV"].map(|text| width(Font::Plain, text));
        assert!(both < a + v - 1.0);
        let runs = ["A", "V"].map(|text| crate::figure::Run::new(Font::Plain, text));
        let parted = Text::of(runs.to_vec(), 100.0, [0, 0, 0, 255]);
        assert_eq!(line(DVec2::ZERO, &parted).width, both);
    }

    #[test]
    fn accents_stand_on_their_letters_and_take_no_room() {
        let bounds = |text: &str| {
            let text = Text::new(Font::Plain, text, 100.0, [0, 0, 0, 255]);
            line(DVec2::ZERO, &text).paths[0].bounds()
        };
        let (e, one, two) = ("e", "e\u{301}", "e\u{301}\u{302}");
        assert_eq!(width(Font::Plain, two), width(Font::Plain, e));
        // The font has the letter with its accent too.
        let [composed, parts] = ["\u{e9}", one].map(bounds);
        assert!(
            (composed.top() - parts.top()).abs() < 1.0,
            "{composed:?} {parts:?}"
        );
        assert!(
            (composed.right() - parts.right()).abs() < 1.0,
            "{composed:?} {parts:?}"
        );
        assert!(bounds(two).top() < parts.top() - 5.0);
    }

    #[test]
    fn a_character_comes_from_the_first_font_that_has_it() {
        // A fraktur letter is in one font of formulas only, and formulas keep to their font.
        let fraktur = '\u{211c}';
        let (face, glyph) = Typeface::of(Font::Title, fraktur);
        assert!(std::ptr::eq(face, &raw const FACES[3]) && glyph != GlyphId(0));
        assert_eq!(Typeface::of(Font::Letter, fraktur).1, GlyphId(0));
        assert_eq!(width(Font::Plain, "\u{200b}\u{feff}"), 0.0);
    }
}
