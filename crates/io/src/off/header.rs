//! The first lines of an OFF file.

use crate::error::TextError;
use crate::lines::skip_empty_lines;
use crate::text::{Cursor, Place, number, quoted};

/// What the first lines of a file say.
pub(super) struct Header {
    pub(super) normals: bool,
    pub(super) colors: bool,
    pub(super) uvs: bool,
    pub(super) n_vertices: usize,
    pub(super) n_faces: usize,
}

pub(super) fn header(cursor: &mut Cursor) -> Result<Header, TextError> {
    let mut header = Header {
        normals: false,
        colors: false,
        uvs: false,
        n_vertices: 0,
        n_faces: 0,
    };
    skip_empty_lines(cursor);
    let mut ahead = cursor.clone();
    let Some((place, word)) = ahead.argument() else {
        return Err(cursor
            .place()
            .error("expected `OFF`, found the end of the file"));
    };
    // Old files have no keyword.
    if !word[0].is_ascii_digit() || word.ends_with(b"OFF") {
        keyword(&mut header, place, word)?;
        *cursor = ahead;
        if let Some((place, b"BINARY")) = ahead_argument(cursor) {
            return Err(place.error("expected an OFF file as text, found a binary one"));
        }
        skip_empty_lines(cursor);
    }
    header.n_vertices = count(cursor, "vertices")?;
    header.n_faces = count(cursor, "faces")?;
    // The count of edges is never right and sometimes missing.
    if let Some((place, word)) = cursor.argument() {
        number(place, word)?;
        end_of_line(cursor)?;
    }
    cursor.skip_line();
    Ok(header)
}

fn keyword(header: &mut Header, place: Place, word: &[u8]) -> Result<(), TextError> {
    let refuse =
        |expected: &str| Err(place.error(format!("expected {expected}, found {}", quoted(word))));
    let Some(mut letters) = word.strip_suffix(b"OFF") else {
        return refuse("`OFF`");
    };
    while let [letter, rest @ ..] = letters {
        letters = rest;
        match letter {
            b'N' => header.normals = true,
            b'C' => header.colors = true,
            b'S' if rest.first() == Some(&b'T') => {
                header.uvs = true;
                letters = &rest[1..];
            }
            b'4' | b'n' => return refuse("an OFF file with three coordinates"),
            _ => return refuse("`OFF` with `ST`, `C` or `N` before it"),
        }
    }
    Ok(())
}

fn ahead_argument<'a>(cursor: &Cursor<'a>) -> Option<(Place, &'a [u8])> {
    cursor.clone().argument()
}

pub(super) fn count(cursor: &mut Cursor, what: &str) -> Result<usize, TextError> {
    let found = cursor.argument();
    let (place, word) = found.unwrap_or((cursor.place(), b""));
    whole(word).ok_or_else(|| {
        place.error(format!(
            "expected how many {what} there are, found {}",
            quoted(word)
        ))
    })
}

pub(super) fn whole(word: &[u8]) -> Option<usize> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Refuses counts that the rest of the file has no room for: each word takes two bytes, but for the last.
pub(super) fn check_room(
    cursor: &Cursor,
    n: usize,
    words: usize,
    what: &str,
) -> Result<(), TextError> {
    let least = n.checked_mul(2 * words);
    if least.is_none_or(|least| least > cursor.remaining() + 1) {
        let message = format!("expected {n} {what}, found {} bytes", cursor.remaining());
        return Err(cursor.place().error(message));
    }
    Ok(())
}

fn end_of_line(cursor: &mut Cursor) -> Result<(), TextError> {
    match cursor.argument() {
        None => Ok(()),
        Some((place, word)) => {
            let message = format!("expected the end of the line, found {}", quoted(word));
            Err(place.error(message))
        }
    }
}
