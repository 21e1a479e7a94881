//! Reading the statements of an OBJ file.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use super::file::{LeftOut, NO_MATERIAL, NONE, ObjFile, Run};
use crate::error::TextError;
use crate::text::{Cursor, Place, name, number, quoted};

/// Reads the statements of an OBJ file.
///
/// # Errors
///
/// The first line that breaks the rules of the format.
pub(super) fn parse(bytes: &[u8]) -> Result<ObjFile, TextError> {
    let (file, highest) = Parser::new(bytes, None).run()?;
    let counts = Counts::of(&file);
    if highest.fits(counts) {
        return Ok(file);
    }
    // A vertex may be defined after the faces that use it. Some index was too high to the end:
    // now that all counts are known, read again to find the line.
    Parser::new(bytes, Some(counts)).run().map(|(file, _)| file)
}

/// How many there are of what corners refer to.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    positions: usize,
    uvs: usize,
    normals: usize,
}

impl Counts {
    fn of(file: &ObjFile) -> Self {
        Self {
            positions: file.positions.len(),
            uvs: file.uvs.len(),
            normals: file.normals.len(),
        }
    }

    fn fits(self, limits: Self) -> bool {
        self.positions <= limits.positions
            && self.uvs <= limits.uvs
            && self.normals <= limits.normals
    }
}

struct Parser<'a> {
    cursor: Cursor<'a>,
    file: ObjFile,
    /// What indices may refer to; `None` while it is not known.
    limits: Option<Counts>,
    /// One more than the highest index seen of each kind.
    highest: Counts,
    run: Run,
    sets: BTreeMap<Vec<u32>, usize>,
    groups: BTreeMap<String, usize>,
    objects: BTreeMap<String, usize>,
    materials: BTreeMap<String, usize>,
}

impl<'a> Parser<'a> {
    fn new(bytes: &'a [u8], limits: Option<Counts>) -> Self {
        let file = ObjFile {
            line_offsets: vec![0],
            group_sets: vec![Vec::new()],
            ..ObjFile::default()
        };
        Self {
            cursor: Cursor::new(bytes),
            file,
            limits,
            highest: Counts::default(),
            run: Run::default(),
            sets: BTreeMap::from([(Vec::new(), 0)]),
            groups: BTreeMap::new(),
            objects: BTreeMap::new(),
            materials: BTreeMap::new(),
        }
    }

    fn run(mut self) -> Result<(ObjFile, Counts), TextError> {
        while !self.cursor.is_at_end() {
            if let Some((place, keyword)) = self.cursor.argument() {
                self.statement(place, keyword)?;
            }
            self.cursor.skip_line();
        }
        let unknown = self
            .file
            .left_out
            .iter()
            .find(|(key, _)| matches!(key, LeftOut::Unknown(_)));
        if let (true, Some((LeftOut::Unknown(word), &(_, line)))) =
            (self.file.positions.is_empty(), unknown)
        {
            let message = format!(
                "expected a statement of an OBJ file, found {}, and the file defines no vertex",
                quoted(word.as_bytes())
            );
            return Err(TextError {
                line,
                column: 1,
                message,
            });
        }
        Ok((self.file, self.highest))
    }

    fn statement(&mut self, place: Place, keyword: &[u8]) -> Result<(), TextError> {
        // The usual ones as lists of bytes: they are compared without a call.
        match keyword {
            [b'v'] => self.vertex(place)?,
            [b'v', b't'] => self.uv(place)?,
            [b'v', b'n'] => self.normal(place)?,
            [b'f'] | [b'f', b'o'] => return self.face(place),
            b"l" => return self.line(place),
            b"p" => return self.points(place),
            b"g" => self.group(),
            b"o" => {
                let object = self.cursor.rest_of_line();
                self.run.object = index_of(&mut self.objects, &mut self.file.object_names, &object);
            }
            b"usemtl" => {
                let mut material = self.cursor.rest_of_line();
                if material == NO_MATERIAL {
                    material.clear();
                }
                self.run.material = index_of(
                    &mut self.materials,
                    &mut self.file.material_names,
                    &material,
                );
            }
            b"mtllib" => {
                let libraries = self.cursor.rest_of_line();
                self.file.libraries.push((place, name(&libraries)));
            }
            b"s" => return self.smoothing(place),
            _ => {
                let word = name(&keyword[..keyword.len().min(40)]);
                let known = OTHER_STATEMENTS.contains(&word.as_str());
                self.leave_out(
                    place,
                    1,
                    if known {
                        LeftOut::Statement(word)
                    } else {
                        self.unknown(word)
                    },
                );
            }
        }
        Ok(())
    }

    /// Binary data may hold any number of different words: only a few are listed by name.
    fn unknown(&self, word: String) -> LeftOut {
        const LISTED: usize = 8;
        let key = LeftOut::Unknown(word);
        let listed = self
            .file
            .left_out
            .keys()
            .filter(|key| matches!(key, LeftOut::Unknown(_)));
        if self.file.left_out.contains_key(&key) || listed.count() < LISTED {
            key
        } else {
            LeftOut::OtherUnknown
        }
    }

    fn leave_out(&mut self, place: Place, count: usize, what: LeftOut) {
        if count > 0 {
            self.file.left_out.entry(what).or_insert((0, place.line)).0 += count;
        }
    }

    // ---- Vertices, texture coordinates, normals ------------------------------------------------

    fn vertex(&mut self, place: Place) -> Result<(), TextError> {
        let (values, n) = self.numbers::<7>("v", place)?;
        let [x, y, z, rest @ ..] = values;
        let color = match n {
            3 => None,
            4 => {
                self.leave_out(
                    place,
                    usize::from(!is_exactly(rest[0], 1.0)),
                    LeftOut::Weights,
                );
                None
            }
            6 => Some(DVec4::new(rest[0], rest[1], rest[2], 1.0)),
            7 => Some(DVec4::from_array(rest)),
            _ => {
                return Err(place.error(format!(
                    "expected a vertex as 3 coordinates, or with a weight (4), a color (6) or a \
                     color and alpha (7), found {n} numbers"
                )));
            }
        };
        let before = self.file.positions.len();
        below_none(place, before, "vertices")?;
        self.file.positions.push(DVec3::new(x, y, z));
        if color.is_some() && self.file.colors.is_empty() {
            self.file.colors.resize(before, DVec4::ONE);
        }
        if color.is_some() || !self.file.colors.is_empty() {
            self.file.colors.push(color.unwrap_or(DVec4::ONE));
        }
        Ok(())
    }

    fn uv(&mut self, place: Place) -> Result<(), TextError> {
        let ([u, v, w], n) = self.numbers::<3>("vt", place)?;
        if n == 0 {
            return Err(place.error("expected 1 to 3 texture coordinates, found none"));
        }
        self.leave_out(place, usize::from(!is_exactly(w, 0.0)), LeftOut::Depths);
        below_none(place, self.file.uvs.len(), "texture coordinates")?;
        self.file.uvs.push(DVec2::new(u, v));
        Ok(())
    }

    fn normal(&mut self, place: Place) -> Result<(), TextError> {
        let (values, n) = self.numbers::<3>("vn", place)?;
        if n != 3 {
            return Err(place.error(format!("expected 3 coordinates of a normal, found {n}")));
        }
        below_none(place, self.file.normals.len(), "normals")?;
        self.file.normals.push(DVec3::from_array(values));
        Ok(())
    }

    /// The numbers up to the end of the line, at most N of them, and how many there were.
    fn numbers<const N: usize>(
        &mut self,
        keyword: &str,
        start: Place,
    ) -> Result<([f64; N], usize), TextError> {
        let mut values = [0.0; N];
        let mut n = 0;
        while let Some((place, word)) = self.cursor.argument() {
            let Some(value) = values.get_mut(n) else {
                return Err(start.error(format!(
                    "expected at most {N} numbers after `{keyword}`, found more"
                )));
            };
            *value = number(place, word)?;
            n += 1;
        }
        Ok((values, n))
    }

    // ---- Faces, lines, points ------------------------------------------------------------------

    fn face(&mut self, start: Place) -> Result<(), TextError> {
        let faces = &self.file.faces;
        let before = faces.positions.len();
        let had = (faces.uvs.is_empty(), faces.normals.is_empty());
        while let Some((place, word)) = self.cursor.argument() {
            let corner = self.corner(place, word)?;
            let faces = &mut self.file.faces;
            let n = faces.positions.len();
            below_none(place, n, "corners")?;
            faces.positions.push(corner[0]);
            push_optional(&mut faces.uvs, n, corner[1]);
            push_optional(&mut faces.normals, n, corner[2]);
        }
        let faces = &mut self.file.faces;
        let end = faces.positions.len();
        if end - before < 3 {
            faces.positions.truncate(before);
            faces.uvs.truncate(if had.0 { 0 } else { before });
            faces.normals.truncate(if had.1 { 0 } else { before });
            self.leave_out(start, 1, LeftOut::SmallFaces);
            return Ok(());
        }
        let run = Run {
            first_face: faces.len(),
            ..self.run
        };
        faces.offsets.push(to_u32(end));
        let last = self.file.runs.last();
        if last.is_none_or(|last| {
            Run {
                first_face: run.first_face,
                ..*last
            } != run
        }) {
            self.file.runs.push(run);
        }
        Ok(())
    }

    fn line(&mut self, start: Place) -> Result<(), TextError> {
        let before = self.file.line_corners.len();
        while let Some((place, word)) = self.cursor.argument() {
            let [position, ..] = self.corner(place, word)?;
            below_none(place, self.file.line_corners.len(), "corners of lines")?;
            self.file.line_corners.push(position);
        }
        let end = self.file.line_corners.len();
        if end - before < 2 {
            return Err(start.error(format!(
                "expected a line of at least 2 vertices, found {}",
                end - before
            )));
        }
        self.file.line_offsets.push(to_u32(end));
        Ok(())
    }

    fn points(&mut self, start: Place) -> Result<(), TextError> {
        let mut n = 0;
        while let Some((place, word)) = self.cursor.argument() {
            self.corner(place, word)?;
            n += 1;
        }
        self.leave_out(start, n, LeftOut::Points);
        Ok(())
    }

    /// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn` as indices from 0, [`NONE`] for what is missing.
    fn corner(&mut self, place: Place, word: &[u8]) -> Result<[u32; 3], TextError> {
        let mut fields = word.splitn(3, |&byte| byte == b'/');
        let [v, vt, vn] = [(); 3].map(|()| fields.next().unwrap_or(b""));
        let now = Counts::of(&self.file);
        let limits = self.limits;
        let optional = |field: &[u8], count, limit, what| {
            if field.is_empty() {
                Ok(NONE)
            } else {
                index(place, word, field, count, limit, what)
            }
        };
        let position = index(
            place,
            word,
            v,
            now.positions,
            limits.map(|l| l.positions),
            VERTEX,
        )?;
        let uv = optional(vt, now.uvs, limits.map(|l| l.uvs), UV)?;
        let normal = optional(vn, now.normals, limits.map(|l| l.normals), NORMAL)?;
        let above = |highest: &mut usize, index: u32| {
            if index != NONE {
                *highest = (*highest).max(index as usize + 1);
            }
        };
        above(&mut self.highest.positions, position);
        above(&mut self.highest.uvs, uv);
        above(&mut self.highest.normals, normal);
        Ok([position, uv, normal])
    }

    // ---- Groups and smoothing ------------------------------------------------------------------

    fn group(&mut self) {
        let mut set = Vec::new();
        while let Some((_, word)) = self.cursor.argument() {
            let group = index_of(&mut self.groups, &mut self.file.group_names, word);
            set.extend(group.map(to_u32));
        }
        set.sort_unstable();
        set.dedup();
        let next = self.file.group_sets.len();
        self.run.groups = *self.sets.entry(set.clone()).or_insert(next);
        if self.run.groups == next {
            self.file.group_sets.push(set);
        }
    }

    fn smoothing(&mut self, start: Place) -> Result<(), TextError> {
        let (place, word) = self.cursor.argument().unwrap_or((start, b""));
        self.run.smoothing = match word {
            b"off" => 0,
            b"on" => 1,
            _ => {
                let parsed = std::str::from_utf8(word)
                    .ok()
                    .and_then(|text| text.parse().ok());
                parsed.filter(|&group: &i32| group >= 0).ok_or_else(|| {
                    place.error(format!(
                        "expected a smoothing group, a whole number or `off`, found {}",
                        quoted(word)
                    ))
                })?
            }
        };
        Ok(())
    }
}

/// One and many.
type Noun = (&'static str, &'static str);
const VERTEX: Noun = ("vertex", "vertices");
const UV: Noun = ("texture coordinate", "texture coordinates");
const NORMAL: Noun = ("normal", "normals");

/// The index from 0 that `field` of the corner `word` stands for. `count` is how many of its kind are
/// defined so far, which negative indices count back from; `limit` how many the whole file defines.
fn index(
    place: Place,
    word: &[u8],
    field: &[u8],
    count: usize,
    limit: Option<usize>,
    (one, many): Noun,
) -> Result<u32, TextError> {
    let Some(written) = integer(field) else {
        return Err(place.error(format!(
            "expected a corner such as 1, 1/2, 1//3 or 1/2/3, found {}",
            quoted(word)
        )));
    };
    if written == 0 {
        return Err(place.error(format!(
            "indices count from 1, but the corner {} has 0",
            quoted(word)
        )));
    }
    let from_zero = if written > 0 {
        written - 1
    } else {
        written + signed(count)
    };
    if from_zero < 0 {
        return Err(place.error(format!(
            "the corner refers to {one} {written}, but {count} {many} are defined so far"
        )));
    }
    let limit = limit.unwrap_or(NONE as usize);
    match u32::try_from(from_zero) {
        Ok(index) if (index as usize) < limit => Ok(index),
        _ => Err(place.error(format!(
            "the corner refers to {one} {written}, but {} {many} are defined {}",
            limit.min(NONE as usize),
            if limit == NONE as usize {
                "at most"
            } else {
                "in the file"
            }
        ))),
    }
}

/// A whole number with an optional sign, as long as it fits.
fn integer(field: &[u8]) -> Option<i64> {
    let (negative, digits) = match field {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, field),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0_i64;
    for &byte in digits {
        if !byte.is_ascii_digit() {
            return None;
        }
        value = 10 * value + i64::from(byte - b'0');
    }
    Some(if negative { -value } else { value })
}

fn signed(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

/// Appends to a column that stays empty until its first value; `n` values belong before it.
fn push_optional(column: &mut Vec<u32>, n: usize, value: u32) {
    if value != NONE && column.is_empty() {
        column.resize(n, NONE);
    }
    if value != NONE || !column.is_empty() {
        column.push(value);
    }
}

/// The place of a name in a list without duplicates; `None` for an empty name.
fn index_of(
    places: &mut BTreeMap<String, usize>,
    list: &mut Vec<String>,
    bytes: &[u8],
) -> Option<usize> {
    if bytes.is_empty() {
        return None;
    }
    let next = list.len();
    let text = name(bytes);
    let place = *places.entry(text.clone()).or_insert(next);
    if place == next {
        list.push(text);
    }
    Some(place)
}

fn below_none(place: Place, count: usize, what: &str) -> Result<(), TextError> {
    if count >= NONE as usize {
        return Err(place.error(format!("expected fewer than {NONE} {what}")));
    }
    Ok(())
}

fn to_u32(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(NONE)
}

fn is_exactly(x: f64, value: f64) -> bool {
    x.to_bits() == value.to_bits() || (x - value).abs() == 0.0
}

/// Statements of the format that say nothing about polygons: free-form curves and surfaces, display
/// attributes, and calls of other files.
const OTHER_STATEMENTS: [&str; 33] = [
    "vp",
    "deg",
    "bmat",
    "step",
    "cstype",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "mg",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "usemap",
    "maplib",
    "call",
    "csh",
    "bsp",
    "bzp",
    "cdc",
    "cdp",
    "res",
];

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

    fn read(text: &str) -> ObjFile {
        parse(text.as_bytes()).unwrap()
    }

    #[test]
    fn polygons_of_any_degree_stay_whole_and_in_order() {
        let file = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\nf 3 2 1\n");
        assert_eq!(file.positions.len(), 5);
        assert_eq!(file.faces.offsets, [0, 4, 7]);
        assert_eq!(file.faces.positions, [0, 1, 2, 3, 2, 1, 0]);
        assert!(file.faces.uvs.is_empty() && file.faces.normals.is_empty());
    }

    #[test]
    fn corners_have_texture_coordinates_and_normals_in_every_combination() {
        let file = read(&format!(
            "{TRIANGLE}vt 0.5\nvt 1 1 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3\nf 1//1 2//1 3//1\n\
             f 1/1/1 2/-1/-1 3/2/1\nf 1/ 2// 3/2/\n"
        ));
        let n = NONE;
        assert_eq!(
            file.faces.uvs,
            [n, n, n, 0, 1, n, n, n, n, 0, 1, 1, n, n, 1]
        );
        assert_eq!(
            file.faces.normals,
            [n, n, n, n, n, n, 0, 0, 0, 0, 0, 0, n, n, n]
        );
        assert_eq!(file.uvs, [DVec2::new(0.5, 0.0), DVec2::ONE]);
    }

    #[test]
    fn negative_indices_count_back_from_the_line() {
        let file = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 2 2 2\nf -4 -2 -1\n");
        assert_eq!(file.faces.positions, [0, 1, 2, 0, 2, 3]);
    }

    #[test]
    fn vertices_may_come_after_the_faces_that_use_them() {
        assert_eq!(
            read(&format!("f 1 2 3\n{TRIANGLE}")).faces.positions,
            [0, 1, 2]
        );
    }

    #[test]
    fn colors_and_weights_follow_the_coordinates() {
        let file = read("v 0 0 0\nv 1 0 0 1 0.5 0\nv 1 0 0 1\nv 1 0 0 2.5\nv 1 0 0 0 0 0 0.5\n");
        let color = |r, g, b, a| DVec4::new(r, g, b, a);
        let white = DVec4::ONE;
        let expected = [
            white,
            color(1.0, 0.5, 0.0, 1.0),
            white,
            white,
            color(0.0, 0.0, 0.0, 0.5),
        ];
        assert_eq!(file.colors, expected);
        assert_eq!(file.left_out[&LeftOut::Weights], (1, 4));
    }

    #[test]
    fn line_ends_tabs_continuations_and_exponents_are_understood() {
        let file = read(
            "\u{feff}# art \\\r\nv\t1e2 -2.5E-1 +3 # here\rv 0 0 \\\n  1\r\n\nv 1 1 1\nf 1 \\\r\n2 3",
        );
        assert_eq!(file.positions[0], DVec3::new(100.0, -0.25, 3.0));
        assert_eq!(file.positions[1], DVec3::Z);
        assert_eq!(file.faces.positions, [0, 1, 2]);
        assert!(file.left_out.is_empty(), "{:?}", file.left_out);
    }

    #[test]
    fn runs_say_groups_object_material_and_smoothing() {
        let file = read(&format!(
            "{TRIANGLE}f 1 2 3\no my thing\ng b a b\nusemtl red paint\ns 3\nf 1 2 3\nf 1 2 3\n\
             g b a\nf 1 2 3\ng\ns off\nusemtl (null)\nf 1 2 3\ng # comment\nf 1 2 3\n"
        ));
        let named = Run {
            first_face: 1,
            groups: 1,
            object: Some(0),
            material: Some(0),
            smoothing: 3,
        };
        let last = Run {
            first_face: 4,
            object: Some(0),
            ..Run::default()
        };
        assert_eq!(file.runs, [Run::default(), named, last]);
        assert_eq!(file.group_sets, [vec![], vec![0, 1]]);
        assert_eq!(file.group_names, ["b", "a"]);
        assert_eq!(file.object_names, ["my thing"]);
        assert_eq!(file.material_names, ["red paint"]);
    }

    #[test]
    fn what_is_left_out_is_counted_with_its_first_line() {
        let file = read(&format!(
            "{TRIANGLE}vp 1 2\nvp 1 2\ncstype bezier\nwhatever\np 1 2 -1\nl 1 2 3/1\nvt 0 0 0.5\n\
             f 1 2\n"
        ));
        let expected = [
            (LeftOut::Statement("cstype".into()), (1, 6)),
            (LeftOut::Statement("vp".into()), (2, 4)),
            (LeftOut::Unknown("whatever".into()), (1, 7)),
            (LeftOut::Points, (3, 8)),
            (LeftOut::SmallFaces, (1, 11)),
            (LeftOut::Depths, (1, 10)),
        ];
        assert_eq!(file.left_out, BTreeMap::from(expected));
        assert_eq!(file.line_corners, [0, 1, 2]);
    }

    #[test]
    fn broken_files_are_refused_at_the_line() {
        for (text, line, column, words) in [
            ("v 0 0", 4, 1, "found 2 numbers"),
            ("v 0 0 0 1 1", 4, 1, "found 5 numbers"),
            ("v 1 2 3 4 5 6 7 8", 4, 1, "at most 7"),
            ("v 0 x 0", 4, 5, "expected a number, found `x`"),
            ("v 0 0 nan", 4, 7, "finite number, found `nan`"),
            ("v 0 0 -inf", 4, 7, "finite"),
            ("v 1e400 0 0", 4, 3, "finite"),
            ("vt", 4, 1, "found none"),
            ("vt 0 0 0 0", 4, 1, "at most 3"),
            ("vn 0 0", 4, 1, "found 2"),
            ("f 1 2 0", 4, 7, "count from 1"),
            (
                "f 1 2 4",
                4,
                7,
                "vertex 4, but 3 vertices are defined in the file",
            ),
            (
                "f 1 2 -4",
                4,
                7,
                "vertex -4, but 3 vertices are defined so far",
            ),
            (
                "f 1 2 3/1",
                4,
                7,
                "texture coordinate 1, but 0 texture coordinates",
            ),
            (
                "f 1 2 3//2\nvn 0 0 1",
                4,
                7,
                "normal 2, but 1 normals are defined in the file",
            ),
            ("f 1 2 3 \\\n 99999999999", 5, 2, "vertex 99999999999, but"),
            ("f 1 2 99999999999999999999", 4, 7, "expected a corner"),
            (
                "f 1 2 a",
                4,
                7,
                "expected a corner such as 1, 1/2, 1//3 or 1/2/3, found `a`",
            ),
            ("f 1 2 3/4/5/6", 4, 7, "found `3/4/5/6`"),
            ("f 1 2 /1", 4, 7, "expected a corner"),
            ("l 1", 4, 1, "at least 2 vertices, found 1"),
            ("l 1 9", 4, 5, "vertex 9"),
            ("p 9", 4, 3, "vertex 9"),
            ("s many", 4, 3, "found `many`"),
            ("s -1", 4, 3, "found `-1`"),
            ("s", 4, 1, "found nothing"),
        ] {
            let error = parse(format!("{TRIANGLE}{text}").as_bytes()).unwrap_err();
            assert!(error.message.contains(words), "{text:?}: {error:?}");
            assert_eq!(
                (error.line, error.column),
                (line, column),
                "{text:?}: {error:?}"
            );
        }
    }

    #[test]
    fn another_kind_of_file_is_refused() {
        let error = parse(b"# hello\nsolid thing\n").unwrap_err();
        assert_eq!(error.line, 2);
        assert!(parse(b"# nothing\n").is_ok());
    }

    proptest! {
        #[test]
        fn any_bytes_are_read_or_refused(
            bytes: Vec<u8>,
            text in "((v|vt|vn|f|l|p|g|o|s|usemtl|mtllib|x)[ \t/0-9a.\\\\\r\\-]{0,12}\n){0,30}",
        ) {
            let _ = parse(&bytes);
            let _ = parse(text.as_bytes());
            super::super::peek(&bytes);
            super::super::peek(text.as_bytes());
        }
    }
}
