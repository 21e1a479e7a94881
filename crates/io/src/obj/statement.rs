//! Parses the statements of an OBJ file, or of a part of it.

use glam::{DVec2, DVec3, DVec4};

use super::corner::{Corner, Limits, corner};
use super::file::{LeftOut, NO_MATERIAL, NONE};
use super::parser::Parser;
use super::part::{Part, to_u32};
use crate::fault::Fault;
use crate::text::{Cursor, TextPosition, is_not_finite, name, number, parsed};

/// The text at the beginning of comments with vertex colors.
const MRGB_COMMENT: &[u8] = b"#MRGB ";

/// The maximum number of distinct unknown words that are listed by name.
pub(super) const MAX_LISTED_WORDS: usize = 8;

/// Parses the statements of a part of a file. The indices are checked later, when all parts are parsed, because they
/// can refer to elements of other parts.
///
/// # Errors
///
/// Returns an error for the first line that violates the format, or for the first unknown word after
/// [`MAX_LISTED_WORDS`] other unknown words.
pub(super) fn read_part(bytes: &[u8], is_first: bool) -> Result<Part, Fault> {
    let cursor = if is_first {
        Cursor::new(bytes)
    } else {
        Cursor::inside(bytes)
    };
    Parser::new(cursor, Limits::Part).run()
}

/// Parses the statements of a whole file in order. Parsing in order is slower than parsing in parts, but the position
/// of the first error is exact.
///
/// # Errors
///
/// Returns an error for the first line that violates the format.
pub(super) fn read_whole(bytes: &[u8], limits: Limits) -> Result<Part, Fault> {
    Parser::new(Cursor::new(bytes), limits).run()
}

impl Parser<'_> {
    fn run(mut self) -> Result<Part, Fault> {
        let is_part = matches!(self.limits, Limits::Part);
        while !self.cursor.is_at_end() {
            if is_part && self.fast_line() {
                continue;
            }
            if let Some((place, keyword)) = self.cursor.argument() {
                self.statement(place, keyword)?;
            } else if self.cursor.ahead().starts_with(MRGB_COMMENT) {
                self.mrgb_comment();
            }
            self.cursor.skip_line();
        }
        self.part.last = self.current;
        self.part.n_lines = self.cursor.place().line - 1;
        Ok(self.part)
    }

    fn statement(&mut self, place: TextPosition, keyword: &[u8]) -> Result<(), Fault> {
        match keyword {
            b"v" => {
                let (values, n) = self.numbers("v", place)?;
                self.vertex(place, values, n)?;
            }
            b"vt" => {
                let (values, n) = self.numbers("vt", place)?;
                self.uv(place, values, n)?;
            }
            b"vn" => {
                let (values, n) = self.numbers("vn", place)?;
                self.normal(place, values, n)?;
            }
            b"f" | b"fo" => return self.face(place),
            b"l" => return self.polyline(place),
            b"p" => return self.points(place),
            b"g" => self.group(),
            b"o" => {
                let object = self.cursor.rest_of_line();
                self.current.object = Some(self.part.objects.index_of_bytes(&object));
            }
            b"usemtl" => {
                let mut material = self.cursor.rest_of_line();
                if material == NO_MATERIAL {
                    material.clear();
                }
                self.current.material = Some(self.part.materials.index_of_bytes(&material));
            }
            b"mtllib" => {
                let libraries = self.cursor.rest_of_line();
                self.part.libraries.push((place, name(&libraries)));
            }
            b"s" => return self.smoothing(place),
            _ => {
                let word = name(&keyword[..keyword.len().min(40)]);
                let what = if is_other_statement(&word) {
                    LeftOut::Statement(word)
                } else {
                    self.unknown(place, word)?
                };
                self.leave_out(place, 1, what);
            }
        }
        Ok(())
    }

    /// Decides whether an unknown word is listed by name. Binary data can have very many distinct unknown words, so
    /// only the first few of the file are listed. The parser of a part does not see the words of earlier parts.
    /// Therefore, parsing a part with too many unknown words fails, and the whole file is parsed in order.
    fn unknown(&self, place: TextPosition, word: String) -> Result<LeftOut, Fault> {
        let key = LeftOut::Unknown(word);
        let known = &self.part.left_out;
        let unknown = |key: &&LeftOut| matches!(key, LeftOut::Unknown(_));
        let listed = known.keys().filter(unknown);
        if known.contains_key(&key) || listed.count() < MAX_LISTED_WORDS {
            Ok(key)
        } else if let Limits::Part = self.limits {
            Err(place.error("too many different unknown statements in one part of the file"))
        } else {
            Ok(LeftOut::OtherUnknown)
        }
    }

    fn leave_out(&mut self, place: TextPosition, count: usize, what: LeftOut) {
        if count > 0 {
            self.part.left_out.entry(what).or_insert((0, place.line)).0 += count;
        }
    }

    // ---- Vertices, texture coordinates, normals ------------------------------------------------

    /// Adds a vertex for which the line has only the first `n` of the `values`.
    pub(super) fn vertex(
        &mut self,
        place: TextPosition,
        values: [f64; 7],
        n: usize,
    ) -> Result<(), Fault> {
        let [x, y, z, rest @ ..] = values;
        let color = match n {
            3 => None,
            4 => {
                let is_weighted = !is_exactly(rest[0], 1.0);
                self.leave_out(place, usize::from(is_weighted), LeftOut::Weights);
                None
            }
            6 => Some(DVec4::new(rest[0], rest[1], rest[2], 1.0)),
            7 => Some(DVec4::from_array(rest)),
            _ => {
                let message = format!(
                    "expected a vertex with 3 coordinates, or with an additional weight (4 numbers), color (6) or color \
                    and alpha (7), found {n} numbers"
                );
                return Err(place.error(message));
            }
        };
        below_none(place, self.part.positions.len(), "vertices")?;
        self.part.add_vertex(DVec3::new(x, y, z), color);
        Ok(())
    }

    pub(super) fn uv(
        &mut self,
        place: TextPosition,
        values: [f64; 3],
        n: usize,
    ) -> Result<(), Fault> {
        let [u, v, w] = values;
        if n == 0 {
            return Err(place.error("expected 1 to 3 texture coordinates, found none"));
        }
        self.leave_out(place, usize::from(!is_exactly(w, 0.0)), LeftOut::Depths);
        below_none(place, self.part.uvs.len(), "texture coordinates")?;
        self.part.uvs.push(DVec2::new(u, v));
        Ok(())
    }

    pub(super) fn normal(
        &mut self,
        place: TextPosition,
        values: [f64; 3],
        n: usize,
    ) -> Result<(), Fault> {
        if n != 3 {
            return Err(place.error(format!("expected a normal with 3 coordinates, found {n}")));
        }
        below_none(place, self.part.normals.len(), "normals")?;
        self.part.normals.push(DVec3::from_array(values));
        Ok(())
    }

    /// Parses at most N numbers, up to the end of the line. Returns an array with the numbers, and their count.
    fn numbers<const N: usize>(
        &mut self,
        keyword: &str,
        start: TextPosition,
    ) -> Result<([f64; N], usize), Fault> {
        let mut values = [0.0; N];
        let mut n = 0;
        while let Some((place, word)) = self.cursor.argument() {
            let Some(value) = values.get_mut(n) else {
                let message = format!("expected at most {N} numbers after `{keyword}`, found more");
                return Err(start.error(message));
            };
            *value = if keyword != "v" && is_not_finite(word) {
                self.leave_out(place, 1, LeftOut::NotFinite);
                0.0
            } else {
                number(place, word)?
            };
            n += 1;
        }
        Ok((values, n))
    }

    /// Reads the colors in a `#MRGB` comment of `ZBrush`: eight hexadecimal digits for each vertex.
    fn mrgb_comment(&mut self) {
        let digits = self.cursor.ahead()[MRGB_COMMENT.len()..].trim_ascii_start();
        for digits in digits.chunks_exact(8) {
            let digits = std::str::from_utf8(digits).unwrap_or_default();
            let Ok(value) = u32::from_str_radix(digits, 16) else {
                break;
            };
            self.part.mrgb_colors.push(value);
        }
    }

    // ---- Faces, lines, points ------------------------------------------------------------------

    fn face(&mut self, start: TextPosition) -> Result<(), Fault> {
        let before = self.part.n_corners();
        let had = self.columns();
        while let Some((place, word)) = self.cursor.argument() {
            let corner = self.corner(place, word)?;
            below_none(place, self.part.n_corners(), "corners")?;
            self.part.push_corner(corner);
        }
        if self.part.n_corners() - before < 3 {
            self.part.truncate_corners(before, had);
            self.leave_out(start, 1, LeftOut::SmallFaces);
        } else {
            self.end_face();
        }
        Ok(())
    }

    fn polyline(&mut self, start: TextPosition) -> Result<(), Fault> {
        let before = self.part.line_corners.len();
        while let Some((place, word)) = self.cursor.argument() {
            let corner = self.corner(place, word)?;
            let n = self.part.line_corners.len();
            below_none(place, n, "corners of lines")?;
            self.part.record_indices(corner);
            self.part.line_corners.push_optional(n, corner[0]);
        }
        let end = self.part.line_corners.len();
        let n = end - before;
        if n < 2 {
            let message = format!("expected a polyline with at least 2 vertices, found {n}");
            return Err(start.error(message));
        }
        self.part.line_ends.push(to_u32(end));
        Ok(())
    }

    fn points(&mut self, start: TextPosition) -> Result<(), Fault> {
        let mut n = 0;
        while let Some((place, word)) = self.cursor.argument() {
            let corner = self.corner(place, word)?;
            self.part.record_indices(corner);
            n += 1;
        }
        self.leave_out(start, n, LeftOut::Points);
        Ok(())
    }

    fn corner(&self, place: TextPosition, word: &[u8]) -> Result<Corner, Fault> {
        corner(place, word, self.part.counts(), self.limits)
    }

    // ---- Groups and smoothing ------------------------------------------------------------------

    fn group(&mut self) {
        let mut set = Vec::new();
        while let Some((_, word)) = self.cursor.argument() {
            set.push(to_u32(self.part.groups.index_of_bytes(word)));
        }
        set.sort_unstable();
        set.dedup();
        let next = self.part.group_sets.len();
        let place = *self.sets.entry(set.clone()).or_insert(next);
        if place == next {
            self.part.group_sets.push(set);
        }
        self.current.groups = Some(place);
    }

    fn smoothing(&mut self, start: TextPosition) -> Result<(), Fault> {
        let (place, word) = self.cursor.argument().unwrap_or((start, b""));
        let group = match word {
            b"off" => 0,
            b"on" => 1,
            _ => {
                let group = parsed(word).filter(|&group: &i32| group >= 0);
                let what = "a smoothing group (a non-negative integer, `on` or `off`)";
                group.ok_or_else(|| place.expected(what, word))?
            }
        };
        self.current.smoothing = Some(group);
        Ok(())
    }
}

fn below_none(place: TextPosition, count: usize, what: &str) -> Result<(), Fault> {
    if count >= NONE as usize {
        return Err(place.error(format!("expected fewer than {NONE} {what}")));
    }
    Ok(())
}

fn is_exactly(x: f64, value: f64) -> bool {
    x.to_bits() == value.to_bits() || (x - value).abs() == 0.0
}

/// Whether a word is a statement of the format that the reader leaves out.
pub(super) fn is_other_statement(word: &str) -> bool {
    OTHER_STATEMENTS
        .split(' ')
        .any(|statement| statement == word)
}

/// Statements of the format that do not describe polygons: free-form curves and surfaces, display attributes, and
/// calls of other files.
const OTHER_STATEMENTS: &str = "vp deg bmat step cstype curv curv2 surf parm trim hole scrv sp end con \
    mg bevel c_interp d_interp lod shadow_obj trace_obj ctech stech usemap maplib call csh bsp bzp cdc cdp res";
