//! Converts the lines of an OFF file to polygons.

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Domain, Rule, UV, VERTEX_NORMAL, counted};

use crate::Polygons;
use crate::fault::Fault;
use crate::note::Notes;
use crate::peek::{MAX_COMPARED, PeekMesh, are_different};
use crate::text::{Cursor, TextPosition, check_encoding, number, parsed};

/// The name of the face attribute that stores indices into a color map.
pub(crate) const COLOR_INDEX: &str = "color_index";

/// The color that faces without a color get if other faces have a color.
const GRAY: DVec4 = DVec4::new(2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 1.0);

/// Consecutive words of a line, each with its position in the file.
type Words<'a, 'w> = &'w [(TextPosition, &'a [u8])];

/// Reads an OFF file from its bytes.
///
/// # Errors
///
/// Returns an error for the first position that violates the format.
pub(crate) fn read(bytes: &[u8], notes: &mut Notes) -> Result<Polygons, Fault> {
    check_encoding(bytes)?;
    let mut cursor = Cursor::new(bytes);
    let header = Header::read(&mut cursor)?;
    let mut polygons = Polygons::default();
    let uvs = vertices(&mut cursor, &header, &mut polygons, notes)?;
    faces(&mut cursor, &header, &mut polygons, notes)?;
    if header.uvs {
        let corners = polygons.corners.iter();
        let uvs = corners.map(|&v| uvs[v as usize]).collect();
        polygons.insert_known(UV, uvs);
    }
    Ok(polygons)
}

// ---- Header -----------------------------------------------------------------------------------

/// The content of the first lines of a file.
#[derive(Default)]
struct Header {
    normals: bool,
    colors: bool,
    uvs: bool,
    n_vertices: usize,
    n_faces: usize,
}

impl Header {
    fn read(cursor: &mut Cursor) -> Result<Self, Fault> {
        let mut header = Self::default();
        cursor.skip_empty_lines();
        let mut ahead = cursor.clone();
        let Some((place, word)) = ahead.argument() else {
            let message = "expected `OFF`, found the end of the file";
            return Err(cursor.place().error(message));
        };
        // Files of some old programs have no keyword and begin with the number of vertices.
        if !word[0].is_ascii_digit() || word.ends_with(b"OFF") {
            header.keyword(place, word)?;
            *cursor = ahead;
            if let Some((place, b"BINARY")) = cursor.clone().argument() {
                return Err(place.error("expected an OFF file as text, found a binary OFF file"));
            }
            cursor.skip_empty_lines();
        }
        header.n_vertices = count(cursor, "vertices")?;
        header.n_faces = count(cursor, "faces")?;
        // The number of edges is often wrong or missing, so its value is ignored.
        if let Some((place, word)) = cursor.argument() {
            number(place, word)?;
            cursor.end_of_line("")?;
        }
        cursor.skip_line();
        Ok(header)
    }

    fn keyword(&mut self, place: TextPosition, word: &[u8]) -> Result<(), Fault> {
        let Some(mut letters) = word.strip_suffix(b"OFF") else {
            return Err(place.expected("`OFF`", word));
        };
        while let [letter, rest @ ..] = letters {
            letters = rest;
            match letter {
                b'N' => self.normals = true,
                b'C' => self.colors = true,
                b'S' if rest.first() == Some(&b'T') => {
                    self.uvs = true;
                    letters = &rest[1..];
                }
                b'4' | b'n' => {
                    return Err(
                        place.expected("an OFF file with three coordinates for each vertex", word)
                    );
                }
                _ => return Err(place.expected("`OFF` with `ST`, `C` or `N` before it", word)),
            }
        }
        Ok(())
    }
}

fn count(cursor: &mut Cursor, what: &str) -> Result<usize, Fault> {
    let (place, word) = cursor.argument_or_nothing();
    let expected = || place.expected(format_args!("the number of {what}"), word);
    parsed(word).ok_or_else(expected)
}

/// Checks that the rest of the file is long enough for `n` items, each with `words` words.
fn check_room(cursor: &Cursor, n: usize, words: usize, what: &str) -> Result<(), Fault> {
    if cursor.has_room(n, words) {
        return Ok(());
    }
    let message = format!(
        "the rest of the file is too short for {n} {what} (bytes left: {})",
        cursor.remaining()
    );
    Err(cursor.place().error(message))
}

// ---- Vertices ----------------------------------------------------------------------------------

/// Reads the vertices. Returns the texture coordinates of the vertices.
fn vertices(
    cursor: &mut Cursor,
    header: &Header,
    polygons: &mut Polygons,
    notes: &mut Notes,
) -> Result<Vec<DVec2>, Fault> {
    let before = 3 + if header.normals { 3 } else { 0 };
    let after = if header.uvs { 2 } else { 0 };
    let least = before + after + if header.colors { 3 } else { 0 };
    check_room(cursor, header.n_vertices, least, "vertices")?;
    polygons.positions.reserve(header.n_vertices);
    let (mut normals, mut colors, mut uvs) = (Vec::new(), Colors::default(), Vec::new());
    let mut words = Vec::new();
    let (mut extra, mut first_extra) = (0, None);
    for v in 0..header.n_vertices {
        cursor.skip_empty_lines();
        let line = cursor.place().line;
        words.clear();
        words.extend(std::iter::from_fn(|| cursor.argument()));
        if words.len() < least {
            let expected = match words.len() {
                0 => format!("{} vertices, found {v}", header.n_vertices),
                n => format!("a vertex with {least} numbers, found {n}"),
            };
            return Err(cursor.place().error(format!("expected {expected}")));
        }
        let position = DVec3::from_array(numbers(&words)?);
        polygons.positions.push(position);
        if header.normals {
            normals.push(DVec3::from_array(numbers(&words[3..])?));
        }
        let mut at = before;
        if header.colors {
            let n = (words.len() - before - after).min(4);
            colors.push(&words[at..at + n])?;
            at += n;
        }
        if header.uvs {
            uvs.push(DVec2::from_array(numbers(&words[at..])?));
            at += 2;
        }
        if words.len() > at {
            extra += 1;
            first_extra.get_or_insert(line);
        }
        cursor.skip_line();
    }
    let what = "vertices with extra numbers: these numbers are left out, because the keyword in the first line does not declare them";
    notes.left_out("extra-content", extra, first_extra, what);
    if header.normals {
        polygons.insert_known(VERTEX_NORMAL, normals);
    }
    if header.colors {
        polygons.insert_known(COLOR, colors.finish());
    }
    Ok(uvs)
}

/// Parses the first N words as numbers.
fn numbers<const N: usize>(words: Words) -> Result<[f64; N], Fault> {
    let mut numbers = [0.0; N];
    for (x, &(place, word)) in numbers.iter_mut().zip(words) {
        *x = number(place, word)?;
    }
    Ok(numbers)
}

/// The colors of the vertices or of the faces. All colors must be read before it is known whether the components are
/// bytes.
#[derive(Default)]
struct Colors {
    /// The color and, if given, the alpha of each element; `None` for a face without a color.
    values: Vec<Option<(DVec3, Option<f64>)>>,
    fraction: bool,
    above_one: bool,
}

impl Colors {
    /// Adds a color that is given by three or four words.
    fn push(&mut self, words: Words) -> Result<(), Fault> {
        let [r, g, b, a] = numbers(words)?;
        for (x, (_, word)) in [r, g, b, a].into_iter().zip(words) {
            self.fraction |= word.iter().any(|byte| matches!(byte, b'.' | b'e' | b'E'));
            self.above_one |= x > 1.0;
        }
        let alpha = (words.len() == 4).then_some(a);
        self.values.push(Some((DVec3::new(r, g, b), alpha)));
        Ok(())
    }

    fn finish(self) -> Vec<DVec4> {
        let is_bytes = self.above_one && !self.fraction;
        let unit = if is_bytes { 255.0 } else { 1.0 };
        let color = |(rgb, alpha): (DVec3, Option<f64>)| {
            (rgb / unit).extend(alpha.map_or(1.0, |alpha| alpha / unit))
        };
        let colors = self.values.into_iter();
        colors.map(|given| given.map_or(GRAY, color)).collect()
    }
}

// ---- Faces -------------------------------------------------------------------------------------

/// Reads the faces, and counts the lines after them.
fn faces(
    cursor: &mut Cursor,
    header: &Header,
    polygons: &mut Polygons,
    notes: &mut Notes,
) -> Result<(), Fault> {
    check_room(cursor, header.n_faces, 1, "faces")?;
    // `colors` is empty until the first face with a color. `indices` is empty until the first face with a color index.
    let (mut colors, mut indices) = (Colors::default(), Vec::new());
    let (mut small, mut first_small) = (0, None);
    let mut words = Vec::new();
    for i in 0..header.n_faces {
        cursor.skip_empty_lines();
        let line = cursor.place().line;
        let Some((place, word)) = cursor.argument() else {
            let message = format!("expected {} faces, found {i}", header.n_faces);
            return Err(cursor.place().error(message));
        };
        let degree = parsed(word).filter(|&n| n <= cursor.remaining() / 2 + 1);
        let degree =
            degree.ok_or_else(|| place.expected("the number of corners of a face", word))?;
        let too_many = |_| place.error("expected fewer than 2^32 vertices and corners");
        let start = polygons.corners.len();
        for k in 0..degree {
            let (place, word) = cursor.argument().ok_or_else(|| {
                let corners = counted(degree, "corner");
                let message = format!("expected a face with {corners}, found {k}");
                cursor.place().error(message)
            })?;
            let Some(v) = parsed(word).filter(|&v: &usize| v < header.n_vertices) else {
                let n = header.n_vertices;
                return Err(place.expected(format_args!("a vertex index below {n}"), word));
            };
            polygons.corners.push(u32::try_from(v).map_err(too_many)?);
        }
        words.clear();
        words.extend(std::iter::from_fn(|| cursor.argument()));
        cursor.skip_line();
        if degree < 3 {
            small += 1;
            first_small.get_or_insert(line);
            polygons.corners.truncate(start);
            continue;
        }
        let f = polygons.n_faces();
        let end = u32::try_from(polygons.corners.len()).map_err(too_many)?;
        polygons.offsets.push(end);
        match words[..] {
            [] => {}
            [(place, word)] => {
                let index: Option<i32> = parsed(word);
                indices.resize(f, -1);
                indices
                    .push(index.ok_or_else(|| place.expected("an index into a color map", word))?);
            }
            [_, _, _] | [_, _, _, _] => {
                colors.values.resize(f, None);
                colors.push(&words)?;
            }
            [(place, _), ..] => {
                let message = format!(
                    "expected the end of the line, an index into a color map or a color of 3 or 4 numbers, found {} words",
                    words.len()
                );
                return Err(place.error(message));
            }
        }
    }
    note_left_out(small, first_small, cursor, notes);
    let n_faces = polygons.n_faces();
    if !colors.values.is_empty() {
        colors.values.resize(n_faces, None);
        let n = colors.values.iter().filter(|color| color.is_none()).count();
        notes.changed(
            "colors-missing",
            n,
            None,
            "faces without a color set to gray because other faces have colors",
        );
        polygons.insert(Domain::Face, COLOR.name, Rule::Copy, colors.finish());
    }
    if !indices.is_empty() {
        indices.resize(n_faces, -1);
        polygons.insert(Domain::Face, COLOR_INDEX, Rule::Copy, indices);
    }
    Ok(())
}

/// Adds notes about the faces with fewer than 3 corners and about the lines after the last face. `first` is the line of
/// the first face with fewer than 3 corners.
fn note_left_out(small: usize, first: Option<usize>, cursor: &mut Cursor, notes: &mut Notes) {
    let what = "faces with fewer than 3 corners left out";
    notes.left_out("faces-too-small", small, first, what);
    let (rest, first) = cursor.count_rest();
    notes.left_out(
        "extra-content",
        rest,
        first,
        "lines left out after the last face",
    );
}

// ---- Counts ------------------------------------------------------------------------------------

/// Returns the element counts of an OFF file, and the face attributes that the mesh can have. Adds notes on faces and
/// lines that are left out. Numbers and vertex indices are not checked.
///
/// # Errors
///
/// Returns an error if the header or the number of corners of a face violates the format, or if the file ends too
/// early.
pub(crate) fn peek(
    bytes: &[u8],
    notes: &mut Notes,
) -> Result<(PeekMesh, Vec<(Domain, String)>), Fault> {
    let mut cursor = Cursor::new(bytes);
    let header = Header::read(&mut cursor)?;
    check_room(&cursor, header.n_vertices, 3, "vertices")?;
    for _ in 0..header.n_vertices {
        cursor.skip_empty_lines();
        cursor.skip_line();
    }
    check_room(&cursor, header.n_faces, 1, "faces")?;
    let mut mesh = PeekMesh {
        vertices: header.n_vertices as u64,
        normals: header.normals,
        colors: header.colors,
        keeps_vertices: true,
        ..PeekMesh::default()
    };
    let (mut small, mut first_small) = (0, None);
    let mut has_values = false;
    for _ in 0..header.n_faces {
        cursor.skip_empty_lines();
        let line = cursor.place().line;
        let degree = count(&mut cursor, "corners")? as u64;
        mesh.add_faces(u64::from(degree >= 3), degree);
        has_values |= degree > MAX_COMPARED as u64;
        if (3..=MAX_COMPARED as u64).contains(&degree) {
            let words = (0..degree).map_while(|_| cursor.argument());
            let vertices: Vec<&[u8]> = words.map(|(_, word)| word).collect();
            // The function `are_different` returns false if an index begins with a zero, even for the index `0`.
            // Therefore, the index `0` is counted separately. The vertices are different if `0` occurs at most once and
            // `are_different` returns true for the other indices.
            let others: Vec<&[u8]> = (vertices.iter().copied())
                .filter(|word| *word != b"0")
                .collect();
            let is_simple = vertices.len() as u64 == degree
                && others.len() + 1 >= vertices.len()
                && are_different(&others);
            mesh.add_simple(u64::from(is_simple), degree);
            has_values = has_values || cursor.argument().is_some();
        }
        if degree < 3 {
            small += 1;
            first_small.get_or_insert(line);
        }
        cursor.skip_line();
    }
    note_left_out(small, first_small, &mut cursor, notes);
    mesh.uvs = header.uvs && mesh.faces > 0;
    let names = [COLOR.name, COLOR_INDEX].map(|name| (Domain::Face, name.to_owned()));
    let names = names.into_iter().filter(|_| has_values);
    Ok((mesh, names.collect()))
}
