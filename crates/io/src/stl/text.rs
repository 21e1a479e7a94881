//! Reads STL as text. The words have a fixed order, and line breaks can be anywhere between them.

use glam::DVec3;

use super::facets::{Facets, compare};
use crate::fault::Fault;
use crate::text::{Cursor, is_not_finite, name, number, quoted};

/// Reads the facets of a text file.
///
/// # Errors
///
/// Returns an error for the first word that violates the format.
pub(super) fn read(bytes: &[u8]) -> Result<Facets<DVec3>, Fault> {
    let mut found = Facets::default();
    let mut cursor = Cursor::new(bytes);
    expect(&mut cursor, b"solid")?;
    loop {
        let name = name(&cursor.rest_of_line());
        let first = found.corners.len() / 3;
        solid(&mut cursor, &mut found)?;
        found.solids.push((name, first..found.corners.len() / 3));
        // The name after `endsolid` is skipped, because it only repeats the name of the solid.
        cursor.skip_line();
        cursor.skip_white();
        if cursor.is_at_end() {
            return Ok(found);
        }
        expect(&mut cursor, b"solid")?;
    }
}

/// Reads facets up to `endsolid`.
fn solid(cursor: &mut Cursor, found: &mut Facets<DVec3>) -> Result<(), Fault> {
    loop {
        let (place, keyword) = cursor.next_word();
        if is(keyword, b"endsolid") {
            return Ok(());
        }
        if !is(keyword, b"facet") {
            return Err(place.expected("`facet` or `endsolid`", keyword));
        }
        expect(cursor, b"normal")?;
        let normal = normal(cursor)?;
        expect(cursor, b"outer")?;
        expect(cursor, b"loop")?;
        let mut corners = [DVec3::ZERO; 3];
        for corner in &mut corners {
            expect(cursor, b"vertex")?;
            for i in 0..3 {
                let (place, word) = cursor.next_word();
                corner[i] = number(place, word)?;
            }
        }
        expect(cursor, b"endloop")?;
        expect(cursor, b"endfacet")?;
        found.sides[compare(normal, corners) as usize] += 1;
        found.corners.extend(corners);
    }
}

/// Reads a normal. Some programs write `nan` as the normal of a zero-area facet. Such a normal is read as zero.
fn normal(cursor: &mut Cursor) -> Result<DVec3, Fault> {
    let mut normal = DVec3::ZERO;
    for i in 0..3 {
        let (place, word) = cursor.next_word();
        normal[i] = if is_not_finite(word) {
            f64::NAN
        } else {
            number(place, word)?
        };
    }
    Ok(if normal.is_finite() {
        normal
    } else {
        DVec3::ZERO
    })
}

/// Counts the facets of a text file: the occurrences of the word `endfacet`.
pub(super) fn count(bytes: &[u8]) -> u64 {
    count_words(bytes, b"endfacet")
}

/// Counts the solids of a text file: the occurrences of the word `endsolid`.
pub(super) fn n_solids(bytes: &[u8]) -> u64 {
    count_words(bytes, b"endsolid")
}

/// Counts the occurrences of a word that begins with `e`.
fn count_words(bytes: &[u8], word: &[u8]) -> u64 {
    let mut n = 0;
    let mut rest = bytes;
    while let Some(at) = rest.iter().position(|byte| matches!(byte, b'e' | b'E')) {
        let tail = &rest[at..];
        let found = tail.get(..word.len()).is_some_and(|tail| is(tail, word));
        n += u64::from(found);
        rest = &tail[if found { word.len() } else { 1 }..];
    }
    n
}

fn expect(cursor: &mut Cursor, expected: &[u8]) -> Result<(), Fault> {
    let (place, word) = cursor.next_word();
    if is(word, expected) {
        return Ok(());
    }
    Err(place.expected(quoted(expected), word))
}

/// Whether a word is the given keyword, in lower or upper case.
fn is(word: &[u8], keyword: &[u8]) -> bool {
    word.eq_ignore_ascii_case(keyword)
}
