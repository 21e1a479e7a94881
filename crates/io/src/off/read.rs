//! From the lines of an OFF file to polygons.

use std::path::Path;

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Domain, Rule, UV, VERTEX_NORMAL};

use super::COLOR_INDEX;
use super::colors::Colors;
use super::header::{Header, check_room, count, header, whole};
use crate::error::{ReadError, TextError};
use crate::lines::{count_rest, skip_empty_lines};
use crate::note::Notes;
use crate::peek::{PeekGeometry, PeekMesh};
use crate::text::{Cursor, Place, check_encoding, number, quoted};
use crate::{Found, Polygons};

/// The color of faces that have none, where others have one.
const GRAY: DVec4 = DVec4::new(2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 1.0);

/// Reads an OFF file from its bytes.
///
/// # Errors
///
/// The first place that breaks the rules of the format.
pub(crate) fn read(
    path: &Path,
    bytes: &[u8],
    name: String,
    notes: &mut Notes,
) -> Result<Found, ReadError> {
    let polygons = polygons(bytes, notes).map_err(|error| error.in_file(path))?;
    Ok(Found::polygons(name, polygons))
}

fn polygons(bytes: &[u8], notes: &mut Notes) -> Result<Polygons, TextError> {
    check_encoding(bytes)?;
    let mut cursor = Cursor::new(bytes);
    let header = header(&mut cursor)?;
    let vertices = vertices(&mut cursor, &header, notes)?;
    let faces = faces(&mut cursor, &header, notes)?;
    let (rest, first) = count_rest(&mut cursor);
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

#[derive(Default)]
struct Vertices {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    colors: Colors,
    uvs: Vec<DVec2>,
}

fn vertices(
    cursor: &mut Cursor,
    header: &Header,
    notes: &mut Notes,
) -> Result<Vertices, TextError> {
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
        skip_empty_lines(cursor);
        let line = cursor.place().line;
        words.clear();
        while let Some(word) = cursor.argument() {
            words.push(word);
        }
        if words.len() < least {
            let expected = if v == 0 || !words.is_empty() {
                least
            } else {
                header.n_vertices
            };
            let what = if words.is_empty() {
                "vertices"
            } else {
                "numbers of a vertex"
            };
            let found = if words.is_empty() { v } else { words.len() };
            let message = format!("expected {expected} {what}, found {found}");
            return Err(cursor.place().error(message));
        }
        let vector = |at: usize| -> Result<DVec3, TextError> {
            let [x, y, z] = [0, 1, 2].map(|i| number(words[at + i].0, words[at + i].1));
            Ok(DVec3::new(x?, y?, z?))
        };
        found.positions.push(vector(0)?);
        if header.normals {
            found.normals.push(vector(3)?);
        }
        let mut at = before;
        if header.colors {
            let n = if words.len() - before - behind >= 4 {
                4
            } else {
                3
            };
            found.colors.push(&words[at..at + n])?;
            at += n;
        }
        if header.uvs {
            let [s, t] = [0, 1].map(|i| number(words[at + i].0, words[at + i].1));
            found.uvs.push(DVec2::new(s?, t?));
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

fn faces(cursor: &mut Cursor, header: &Header, notes: &mut Notes) -> Result<Faces, TextError> {
    check_room(cursor, header.n_faces, 1, "faces")?;
    let mut found = Faces {
        offsets: vec![0],
        ..Faces::default()
    };
    let (mut small, mut first_small) = (0, None);
    let mut words = Vec::new();
    for i in 0..header.n_faces {
        skip_empty_lines(cursor);
        let line = cursor.place().line;
        let Some((place, word)) = cursor.argument() else {
            let message = format!("expected {} faces, found {i}", header.n_faces);
            return Err(cursor.place().error(message));
        };
        let degree = whole(word).filter(|&n| n <= cursor.remaining() / 2 + 1);
        let Some(degree) = degree else {
            let message = format!(
                "expected how many corners a face has, found {}",
                quoted(word)
            );
            return Err(place.error(message));
        };
        let start = found.corners.len();
        for k in 0..degree {
            let (place, word) = cursor.argument().ok_or_else(|| {
                let message = format!("expected a face of {degree} corners, found {k}");
                cursor.place().error(message)
            })?;
            let Some(v) = whole(word).filter(|&v| v < header.n_vertices) else {
                let message = format!(
                    "expected a vertex from 0 to below {}, found {}",
                    header.n_vertices,
                    quoted(word)
                );
                return Err(place.error(message));
            };
            let too_many = |_| place.error("expected fewer than 2^32 vertices and corners");
            found.corners.push(u32::try_from(v).map_err(too_many)?);
        }
        words.clear();
        while let Some(word) = cursor.argument() {
            words.push(word);
        }
        cursor.skip_line();
        if degree < 3 {
            small += 1;
            first_small = first_small.or(Some(line));
            found.corners.truncate(start);
            continue;
        }
        let end = u32::try_from(found.corners.len());
        let too_many = |_| place.error("expected fewer than 2^32 vertices and corners");
        found.offsets.push(end.map_err(too_many)?);
        face_color(&mut found, &words)?;
    }
    notes.left_out(
        small,
        first_small,
        "faces with fewer than 3 corners left out",
    );
    Ok(found)
}

/// Takes what stands behind the corners of the last face.
fn face_color(faces: &mut Faces, words: &[(Place, &[u8])]) -> Result<(), TextError> {
    let f = faces.offsets.len() - 2;
    match *words {
        [_, _, _] | [_, _, _, _] => {
            while faces.colors.len() < f {
                faces.colors.skip();
            }
            faces.colors.push(words)?;
            faces.n_colored += 1;
            return Ok(());
        }
        [] => {}
        [(place, word)] => {
            let index = std::str::from_utf8(word)
                .ok()
                .and_then(|word| word.parse().ok());
            let Some(index) = index else {
                let message = format!(
                    "expected a place in a map of colors, found {}",
                    quoted(word)
                );
                return Err(place.error(message));
            };
            faces.indices.push((f, index));
        }
        [(place, _), ..] => {
            let message = format!(
                "expected nothing, a place in a map of colors or a color of 3 or 4 numbers, found {} words",
                words.len()
            );
            return Err(place.error(message));
        }
    }
    faces.plain.push(f);
    Ok(())
}

/// The counts of an OFF file. Numbers and corners are not looked at.
///
/// # Errors
///
/// If the header or the count of a face breaks the rules of the format, or the file ends too early.
pub(crate) fn peek(path: &Path, bytes: &[u8]) -> Result<PeekGeometry, ReadError> {
    let counts = || {
        let mut cursor = Cursor::new(bytes);
        let header = header(&mut cursor)?;
        check_room(&cursor, header.n_vertices, 3, "vertices")?;
        for _ in 0..header.n_vertices {
            skip_empty_lines(&mut cursor);
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
            skip_empty_lines(&mut cursor);
            let degree = count(&mut cursor, "corners")? as u64;
            mesh.add_faces(u64::from(degree >= 3), degree);
            cursor.skip_line();
        }
        mesh.uvs = header.uvs && mesh.faces > 0;
        Ok(PeekGeometry::Mesh(mesh))
    };
    counts().map_err(|error: TextError| error.in_file(path))
}
