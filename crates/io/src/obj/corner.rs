//! The corners of faces, lines and points: indices from 1, or back from the last.

use super::file::NONE;
use crate::fault::Fault;
use crate::text::{Place, parsed, quoted};

/// How many positions, texture coordinates and normals there are.
pub(super) type Counts = [usize; 3];

/// What a corner has of each of them: always a position.
pub(super) type Corner = [Option<Index>; 3];

/// What an index refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Index {
    /// A place in the file, from 0.
    Absolute(u32),
    /// A place after the beginning of this part of the file; before it, if it is negative.
    Relative(i64),
}

/// Where indices may point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Limits {
    /// Anywhere: this is a part of a file, and what the others define is not known yet.
    Part,
    /// This is the whole file, but what comes behind is not known yet.
    Start,
    /// The whole file defines this many.
    Whole(Counts),
}

/// One and many.
type Noun = (&'static str, &'static str);
const NOUNS: [Noun; 3] = [
    ("vertex", "vertices"),
    ("texture coordinate", "texture coordinates"),
    ("normal", "normals"),
];

/// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`. `now` is what the text before this place defines, which
/// negative indices count back from.
///
/// # Errors
///
/// If the word is no corner or refers to what is not there.
pub(super) fn corner(
    place: Place,
    word: &[u8],
    now: Counts,
    limits: Limits,
) -> Result<Corner, Fault> {
    let mut corner = [None; 3];
    for (k, field) in word.splitn(3, |&byte| byte == b'/').enumerate() {
        let limit = match limits {
            Limits::Part => None,
            Limits::Start => Some(NONE as usize),
            Limits::Whole(counts) => Some(counts[k]),
        };
        if k == 0 || !field.is_empty() {
            corner[k] = Some(index(place, word, field, now[k], limit, NOUNS[k])?);
        }
    }
    Ok(corner)
}

/// What `field` of the corner `word` stands for. `count` is how many of its kind are defined so far;
/// `limit` how many there can be, `None` in a part of a file.
fn index(
    place: Place,
    word: &[u8],
    field: &[u8],
    count: usize,
    limit: Option<usize>,
    (one, many): Noun,
) -> Result<Index, Fault> {
    let Some(written) = parsed::<i64>(field) else {
        return Err(place.expected("a corner such as 1, 1/2, 1//3 or 1/2/3", word));
    };
    if written == 0 {
        let word = quoted(word);
        let message = format!("indices count from 1, but the corner {word} has 0");
        return Err(place.error(message));
    }
    if written < 0 {
        let relative = written.saturating_add(i64::try_from(count).unwrap_or(i64::MAX));
        if relative < 0 && limit.is_some() {
            let message = format!(
                "the corner refers to {one} {written}, but {count} {many} are defined so far"
            );
            return Err(place.error(message));
        }
        return Ok(Index::Relative(relative));
    }
    let limit = limit.unwrap_or(NONE as usize);
    match u32::try_from(written - 1) {
        Ok(index) if (index as usize) < limit => Ok(Index::Absolute(index)),
        _ => {
            let so = if limit == NONE as usize {
                "at most"
            } else {
                "in the file"
            };
            let message = format!(
                "the corner refers to {one} {written}, but {limit} {many} are defined {so}"
            );
            Err(place.error(message))
        }
    }
}
