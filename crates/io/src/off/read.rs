//! From the lines of an OFF file to polygons.

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Domain, Rule, UV, VERTEX_NORMAL};

use crate::Polygons;
use crate::fault::Fault;
use crate::note::Notes;
use crate::peek::PeekMesh;
use crate::text::{Cursor, Place, check_encoding, number, parsed};

/// The face attribute for places in a map of colors.
pub(super) const COLOR_INDEX: &str = "color_index";

/// The color of faces that have none, where others have one.
const GRAY: DVec4 = DVec4::new(2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 1.0);

/// The words behind each other on a line, each with its place.
type Words<'a, 'w> = &'w [(Place, &'a [u8])];

/// Reads an OFF file from its bytes.
///
/// # Errors
///
/// The first place that breaks the rules of the format.
pub(crate) fn read(bytes: &[u8], notes: &mut Notes) -> Result<Polygons, Fault> {
    check_encoding(bytes)?;
    let mut cursor = Cursor::new(bytes);
    let header = Header::read(&mut cursor)?;
    let vertices = vertices(&mut cursor, &header, notes)?;
    let faces = faces(&mut cursor, &header, notes)?;
    let (rest, first) = cursor.count_rest();
    notes.left_out(rest, first, "lines behind the last face left out");
    let mut polygons = Polygons {
        positions: vertices.positions,
        offsets: faces.offsets,
        corners: faces.corners,
        ..Polygons::default()
    };
    if header.normals {
        polygons.insert_vertices(VERTEX_NORMAL, vertices.normals);
    }
    if header.colors {
        polygons.insert_vertices(COLOR, vertices.colors.finish());
    }
    if header.uvs {
        let corners = polygons.corners.iter();
        let uvs = corners.map(|&v| vertices.uvs[v as usize]).collect();
        polygons.insert_corners(UV, uvs);
    }
    if faces.n_colored > 0 {
        let n = polygons.n_faces() - faces.n_colored;
        notes.changed(n, None, "faces without a color are gray: others have one");
        let mut colors = faces.colors.finish();
        colors.resize(polygons.n_faces(), GRAY);
        for f in faces.plain {
            colors[f] = GRAY;
        }
        polygons.insert(Domain::Face, COLOR.name, Rule::Copy, colors);
    }
    if !faces.indices.is_empty() {
        let mut indices = vec![-1; polygons.n_faces()];
        for (f, index) in faces.indices {
            indices[f] = index;
        }
        polygons.insert(Domain::Face, COLOR_INDEX, Rule::Copy, indices);
    }
    Ok(polygons)
}

// ---- The first lines ---------------------------------------------------------------------------

/// What the first lines of a file say.
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
        // Old files have no keyword.
        if !word[0].is_ascii_digit() || word.ends_with(b"OFF") {
            header.keyword(place, word)?;
            *cursor = ahead;
            if let Some((place, b"BINARY")) = cursor.clone().argument() {
                return Err(place.error("expected an OFF file as text, found a binary one"));
            }
            cursor.skip_empty_lines();
        }
        header.n_vertices = count(cursor, "vertices")?;
        header.n_faces = count(cursor, "faces")?;
        // The count of edges is never right and sometimes missing.
        if let Some((place, word)) = cursor.argument() {
            number(place, word)?;
            cursor.end_of_line("")?;
        }
        cursor.skip_line();
        Ok(header)
    }

    fn keyword(&mut self, place: Place, word: &[u8]) -> Result<(), Fault> {
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
                    return Err(place.expected("an OFF file with three coordinates", word));
                }
                _ => return Err(place.expected("`OFF` with `ST`, `C` or `N` before it", word)),
            }
        }
        Ok(())
    }
}

fn count(cursor: &mut Cursor, what: &str) -> Result<usize, Fault> {
    let (place, word) = cursor.argument_or_nothing();
    let expected = || place.expected(format_args!("how many {what} there are"), word);
    parsed(word).ok_or_else(expected)
}

/// Refuses counts that the rest of the file has no room for.
fn check_room(cursor: &Cursor, n: usize, words: usize, what: &str) -> Result<(), Fault> {
    if cursor.has_room(n, words) {
        return Ok(());
    }
    let message = format!("expected {n} {what}, found {} bytes", cursor.remaining());
    Err(cursor.place().error(message))
}

// ---- Vertices ----------------------------------------------------------------------------------

#[derive(Default)]
struct Vertices {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    colors: Colors,
    uvs: Vec<DVec2>,
}

fn vertices(cursor: &mut Cursor, header: &Header, notes: &mut Notes) -> Result<Vertices, Fault> {
    let before = 3 + if header.normals { 3 } else { 0 };
    let behind = if header.uvs { 2 } else { 0 };
    let least = before + behind + if header.colors { 3 } else { 0 };
    check_room(cursor, header.n_vertices, least, "vertices")?;
    let mut found = Vertices {
        positions: Vec::with_capacity(header.n_vertices),
        ..Vertices::default()
    };
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
                n => format!("{least} numbers of a vertex, found {n}"),
            };
            return Err(cursor.place().error(format!("expected {expected}")));
        }
        found.positions.push(DVec3::from_array(numbers(&words)?));
        if header.normals {
            found.normals.push(DVec3::from_array(numbers(&words[3..])?));
        }
        let mut at = before;
        if header.colors {
            let n = (words.len() - before - behind).min(4);
            found.colors.push(&words[at..at + n])?;
            at += n;
        }
        if header.uvs {
            found.uvs.push(DVec2::from_array(numbers(&words[at..])?));
            at += 2;
        }
        if words.len() > at {
            extra += 1;
            first_extra = first_extra.or(Some(line));
        }
        cursor.skip_line();
    }
    let what = "vertices have more numbers than the first line of the file promises: left out";
    notes.left_out(extra, first_extra, what);
    Ok(found)
}

/// The first of some words as numbers.
fn numbers<const N: usize>(words: Words) -> Result<[f64; N], Fault> {
    let mut numbers = [0.0; N];
    for (x, &(place, word)) in numbers.iter_mut().zip(words) {
        *x = number(place, word)?;
    }
    Ok(numbers)
}

/// Colors as they are written, until it is known whether they are 255ths.
#[derive(Default)]
struct Colors {
    values: Vec<DVec4>,
    /// Which of them have no alpha.
    opaque: Vec<bool>,
    fraction: bool,
    above_one: bool,
}

impl Colors {
    /// Adds a color of three or four words.
    fn push(&mut self, words: Words) -> Result<(), Fault> {
        let mut color = DVec4::ONE;
        for (i, &(place, word)) in words.iter().enumerate() {
            color[i] = number(place, word)?;
            self.fraction |= word.iter().any(|byte| matches!(byte, b'.' | b'e' | b'E'));
            self.above_one |= color[i] > 1.0;
        }
        self.values.push(color);
        self.opaque.push(words.len() == 3);
        Ok(())
    }

    fn finish(mut self) -> Vec<DVec4> {
        if self.above_one && !self.fraction {
            for (color, opaque) in self.values.iter_mut().zip(self.opaque) {
                let alpha = if opaque { 1.0 } else { color.w / 255.0 };
                *color = (color.truncate() / 255.0).extend(alpha);
            }
        }
        self.values
    }
}

// ---- Faces -------------------------------------------------------------------------------------

#[derive(Default)]
struct Faces {
    offsets: Vec<u32>,
    corners: Vec<u32>,
    /// Empty before the first color.
    colors: Colors,
    n_colored: usize,
    /// Faces without a color behind the first one that has one or before it.
    plain: Vec<usize>,
    /// Faces with a place in a map of colors.
    indices: Vec<(usize, i32)>,
}

fn faces(cursor: &mut Cursor, header: &Header, notes: &mut Notes) -> Result<Faces, Fault> {
    check_room(cursor, header.n_faces, 1, "faces")?;
    let mut found = Faces {
        offsets: vec![0],
        ..Faces::default()
    };
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
        let degree = degree.ok_or_else(|| place.expected("how many corners a face has", word))?;
        let too_many = |_| place.error("expected fewer than 2^32 vertices and corners");
        let start = found.corners.len();
        for k in 0..degree {
            let (place, word) = cursor.argument().ok_or_else(|| {
                let message = format!("expected a face of {degree} corners, found {k}");
                cursor.place().error(message)
            })?;
            let Some(v) = parsed(word).filter(|&v: &usize| v < header.n_vertices) else {
                let n = header.n_vertices;
                return Err(place.expected(format_args!("a vertex from 0 to below {n}"), word));
            };
            found.corners.push(u32::try_from(v).map_err(too_many)?);
        }
        words.clear();
        words.extend(std::iter::from_fn(|| cursor.argument()));
        cursor.skip_line();
        if degree < 3 {
            small += 1;
            first_small = first_small.or(Some(line));
            found.corners.truncate(start);
            continue;
        }
        let end = u32::try_from(found.corners.len()).map_err(too_many)?;
        found.offsets.push(end);
        found.color(&words)?;
    }
    let what = "faces with fewer than 3 corners left out";
    notes.left_out(small, first_small, what);
    Ok(found)
}

impl Faces {
    /// Takes what stands behind the corners of the last face.
    fn color(&mut self, words: Words) -> Result<(), Fault> {
        let f = self.offsets.len() - 2;
        match *words {
            [_, _, _] | [_, _, _, _] => {
                self.colors.values.resize(f, DVec4::ONE);
                self.colors.opaque.resize(f, true);
                self.colors.push(words)?;
                self.n_colored += 1;
                return Ok(());
            }
            [] => {}
            [(place, word)] => {
                let index = parsed(word)
                    .ok_or_else(|| place.expected("a place in a map of colors", word))?;
                self.indices.push((f, index));
            }
            [(place, _), ..] => {
                let message = format!(
                    "expected nothing, a place in a map of colors or a color of 3 or 4 numbers, found {} words",
                    words.len()
                );
                return Err(place.error(message));
            }
        }
        self.plain.push(f);
        Ok(())
    }
}

// ---- Counts ------------------------------------------------------------------------------------

/// The counts of an OFF file. Numbers and corners are not looked at.
///
/// # Errors
///
/// If the header or the count of a face breaks the rules of the format, or the file ends too early.
pub(crate) fn peek(bytes: &[u8]) -> Result<PeekMesh, Fault> {
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
        ..PeekMesh::default()
    };
    for _ in 0..header.n_faces {
        cursor.skip_empty_lines();
        let degree = count(&mut cursor, "corners")? as u64;
        mesh.add_faces(u64::from(degree >= 3), degree);
        cursor.skip_line();
    }
    mesh.uvs = header.uvs && mesh.faces > 0;
    Ok(mesh)
}
