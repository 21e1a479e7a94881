//! Converts lines of text to outlines. Only the embedded fonts are used.
//!
//! If the font of a text does not have a character, the first embedded font with this character is used. Formulas use
//! only their own font. If no usable font has the character, the text shows the glyph for missing characters, which is
//! blank in Inter. Letters are kerned, and accents are placed on their letters. Right-to-left text is not supported,
//! because the fonts have no right-to-left letters.

use std::sync::LazyLock;

use glam::DVec2;
use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::gdef::GlyphClass;
use ttf_parser::gpos::{self, AnchorMatrix, PairAdjustment, PositioningSubtable};
use ttf_parser::opentype_layout::Class;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::svg::{Anchor, Font, Text, number, printable};
use crate::color::narrow;

/// The embedded fonts, in the order in which they are searched for a missing character. The file `fonts/README.md`
/// gives the sources of the fonts.
static FACES: LazyLock<[Typeface; 4]> = LazyLock::new(|| {
    [
        &include_bytes!("../../fonts/Inter-Regular.ttf")[..],
        include_bytes!("../../fonts/Inter-SemiBold.ttf"),
        include_bytes!("../../fonts/KaTeX_Math-Italic.ttf"),
        include_bytes!("../../fonts/KaTeX_Main-Regular.ttf"),
    ]
    .map(|bytes| Typeface::new(Face::parse(bytes, 0).expect("the fonts are embedded")))
});

/// The outlines of a line of text.
pub(super) struct Line {
    /// The outlines of the letters: one path for each run (a part of the text in one font and size) that has outlines.
    pub(super) paths: Vec<Path>,
    /// The width, including spaces.
    pub(super) width: f32,
}

/// Returns the outlines of a text with its [`Anchor`] at `position`.
pub(super) fn line(position: DVec2, text: &Text) -> Line {
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
    let origin = Transform::from_translate(narrow(position.x), narrow(position.y));
    let mut paths = Vec::new();
    for run in clusters.chunk_by(|a, b| a.run == b.run) {
        let mut builder = PathBuilder::new();
        for cluster in run {
            let [right, down] = cluster.shift;
            let transform = origin.pre_translate(x + right, down);
            cluster.outline(transform, &mut builder);
            x += cluster.advance();
        }
        paths.extend(builder.finish());
    }
    Line { paths, width }
}

/// A letter with its accents.
struct Cluster {
    /// The index of the run that contains the letter.
    run: usize,
    face: &'static Typeface,
    /// The font size.
    size: f32,
    /// The offset of the letter to the right and down: the sum of the shifts of its run and of all previous runs.
    shift: [f32; 2],
    /// The distance from the origin of this letter to the origin of the next letter, in font units.
    units: i32,
    /// The glyphs of the letter and its accents. Each glyph has an offset from the origin of the letter, in font units.
    glyphs: Vec<(GlyphId, [i32; 2])>,
}

impl Cluster {
    fn scale(&self) -> f32 {
        self.size / f32::from(self.face.face.units_per_em())
    }

    fn advance(&self) -> f32 {
        self.units as f32 * self.scale()
    }

    /// Adds the outlines of the glyphs to `builder`. `transform` maps the origin of the letter to its place.
    fn outline(&self, transform: Transform, builder: &mut PathBuilder) {
        for &(glyph, [x, y]) in &self.glyphs {
            let mut outline = Outline::default();
            self.face.face.outline_glyph(glyph, &mut outline);
            // In fonts, y points upwards, so the outline is flipped.
            let transform = transform
                .pre_scale(self.scale(), self.scale())
                .pre_translate(x as f32, -y as f32)
                .pre_scale(1.0, -1.0);
            let path = outline.0.finish();
            if let Some(path) = path.and_then(|path| path.transform(transform)) {
                builder.push_path(&path);
            }
        }
    }
}

/// Returns the letters of a text from left to right, each with its accents.
fn clusters(text: &Text) -> Vec<Cluster> {
    let characters: Vec<(usize, char)> = text
        .runs
        .iter()
        .enumerate()
        .flat_map(|(i, run)| run.text.chars().map(move |c| (i, printable(c))))
        .collect();
    let mut clusters: Vec<Cluster> = Vec::with_capacity(characters.len());
    let mut shift = [0.0; 2];
    let (mut n_started_runs, mut raised) = (0, 0.0);
    for (i, &(run_index, c)) in characters.iter().enumerate() {
        let run = &text.runs[run_index];
        if n_started_runs <= run_index {
            n_started_runs = run_index + 1;
            shift[0] += narrow(number(run.skip * text.size));
            shift[1] += narrow(number((raised - run.raise) * text.size));
            raised = run.raise;
        }
        let (face, glyph) = Typeface::find(run.font, c);
        if face.is_mark(glyph)
            && let Some(letter) = clusters.last_mut()
            && std::ptr::eq(letter.face, face)
        {
            letter.glyphs.push((glyph, face.mark_offset(letter, glyph)));
            continue;
        }
        // Accents are skipped, because they do not affect the kerning of the letters before and after them.
        let next = characters[i + 1..]
            .iter()
            .map(|(_, c)| face.glyph(*c))
            .find(|&glyph| !face.is_mark(glyph));
        let is_ignored = glyph == GlyphId(0) && is_invisible(c);
        clusters.push(Cluster {
            run: run_index,
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

/// Whether a character is skipped if no font has a glyph for it. Such characters are invisible and have no width. They
/// join or separate other characters, or set the direction or the variant of other characters.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
        | '\u{fe00}'..='\u{fe0f}' | '\u{feff}')
}

/// A font with its positioning tables.
struct Typeface {
    face: Face<'static>,
    /// The subtables of each lookup of the `GPOS` table. The first subtable that applies to a glyph is used.
    positions: Vec<Vec<PositioningSubtable<'static>>>,
}

impl Typeface {
    fn new(face: Face<'static>) -> Self {
        let tables = face.tables().gpos.into_iter();
        let lookups = tables.flat_map(|table| table.lookups);
        let positions = lookups.map(|l| l.subtables.into_iter().collect()).collect();
        Self { face, positions }
    }

    /// Returns the glyph for the character `c` in a text with the font `font`, and the embedded font that contains the
    /// glyph. If `font` does not have the character and is not a formula font, all embedded fonts are tried in order.
    /// If no font with the character is found, returns `font` and the glyph 0.
    fn find(font: Font, c: char) -> (&'static Self, GlyphId) {
        let (first, fallbacks) = match font {
            Font::Plain => (0, &FACES[..]),
            Font::Title => (1, &FACES[..]),
            // Formulas do not mix fonts, so their fonts have no fallback.
            Font::Letter => (2, &[][..]),
            Font::Digit => (3, &[][..]),
        };
        let first = &FACES[first];
        std::iter::once(first)
            .chain(fallbacks)
            .map(|face| (face, face.glyph(c)))
            .find(|(_, glyph)| *glyph != GlyphId(0))
            .unwrap_or((first, GlyphId(0)))
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

    /// Returns the kerning of two adjacent glyphs: a number, usually negative, that is added to the distance between
    /// them.
    fn kerning(&self, first: GlyphId, second: GlyphId) -> i32 {
        let adjustment = |table: &PositioningSubtable| {
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
            .filter_map(|tables| tables.iter().find_map(adjustment))
            .sum()
    }

    /// Returns the offset of an accent on a letter that can already have accents. If the font defines a position for
    /// the new accent on the last existing accent, the new accent is placed there. Otherwise, if the font defines a
    /// position on the letter, the new accent is placed on the letter. If the font defines neither position, the new
    /// accent follows the letter.
    fn mark_offset(&self, letter: &Cluster, mark: GlyphId) -> [i32; 2] {
        let (base, _) = letter.glyphs[0];
        let (last, [x, y]) = letter.glyphs[letter.glyphs.len() - 1];
        let on_letter = |table: &PositioningSubtable| match table {
            PositioningSubtable::MarkToBase(t) => {
                let anchor = t.marks.get(t.mark_coverage.get(mark)?)?;
                anchor_offset(anchor, t.anchors, t.base_coverage.get(base)?)
            }
            _ => None,
        };
        let on_mark = |table: &PositioningSubtable| match table {
            PositioningSubtable::MarkToMark(t) => {
                let anchor = t.marks.get(t.mark1_coverage.get(mark)?)?;
                let base = t.mark2_coverage.get(last)?;
                let [dx, dy] = anchor_offset(anchor, t.mark2_matrix, base)?;
                Some([x + dx, y + dy])
            }
            _ => None,
        };
        let tables = || self.positions.iter().flatten();
        tables()
            .find_map(on_mark)
            .or_else(|| tables().find_map(on_letter))
            .unwrap_or([letter.units, 0])
    }
}

/// Returns the offset of a mark from a base glyph. The mark has the given anchor, and `base` is the index of the base
/// glyph. Returns `None` if the font does not define the offset.
fn anchor_offset(
    (class, anchor): (Class, gpos::Anchor),
    base_anchors: AnchorMatrix,
    base: u16,
) -> Option<[i32; 2]> {
    let base_anchor = base_anchors.get(base, class)?;
    Some([base_anchor.x - anchor.x, base_anchor.y - anchor.y].map(i32::from))
}

/// The outline of a glyph in font units.
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
    fn letters_are_kerned_across_runs() {
        let [a, v, both] = ["A", "V", "AV"].map(|text| width(Font::Plain, text));
        assert!(both < a + v - 1.0);
        let runs = ["A", "V"].map(|text| crate::figure::Run::new(Font::Plain, text));
        let two_runs = Text::of(runs.to_vec(), 100.0, [0, 0, 0, 255]);
        assert_eq!(line(DVec2::ZERO, &two_runs).width, both);
    }

    #[test]
    fn accents_are_on_their_letters_and_have_no_width() {
        let bounds = |text: &str| {
            let text = Text::new(Font::Plain, text, 100.0, [0, 0, 0, 255]);
            line(DVec2::ZERO, &text).paths[0].bounds()
        };
        let (e, one, two) = ("e", "e\u{301}", "e\u{301}\u{302}");
        assert_eq!(width(Font::Plain, two), width(Font::Plain, e));
        // The font also has a single glyph for the letter with its accent.
        let [composed, combined] = ["\u{e9}", one].map(bounds);
        assert!(
            (composed.top() - combined.top()).abs() < 1.0,
            "{composed:?} {combined:?}"
        );
        assert!(
            (composed.right() - combined.right()).abs() < 1.0,
            "{composed:?} {combined:?}"
        );
        assert!(bounds(two).top() < combined.top() - 5.0);
    }

    #[test]
    fn a_character_comes_from_the_first_font_that_has_it() {
        // Only one of the two formula fonts has this fraktur letter. Formulas do not use a second font for missing
        // characters.
        let fraktur = '\u{211c}';
        let (face, glyph) = Typeface::find(Font::Title, fraktur);
        assert!(std::ptr::eq(face, &raw const FACES[3]) && glyph != GlyphId(0));
        assert_eq!(Typeface::find(Font::Letter, fraktur).1, GlyphId(0));
        assert_eq!(width(Font::Plain, "\u{200b}\u{feff}"), 0.0);
    }
}
