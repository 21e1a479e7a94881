//! Parses the corners of faces, lines and points. Indices start at 1. A negative index counts backward from the last
//! element that is defined before the corner: -1 is this element, and -2 is the element before it.

use super::file::NONE;
use crate::fault::Fault;
use crate::text::{TextPosition, parsed, quoted};
use mesh::counted;

/// Three counts: the number of positions, of texture coordinates, and of normals.
pub(super) type Counts = [usize; 3];

/// The indices of the position, texture coordinate and normal of a corner. The position is always present.
pub(super) type Corner = [Option<Index>; 3];

/// The element that an index refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Index {
    /// An index in the file, from 0.
    Absolute(u32),
    /// An index relative to this part of the file: the first element that the part defines has index 0. Elements of
    /// earlier parts have negative indices.
    Relative(i64),
}

/// How much is known about the range of valid indices.
#[derive(Clone, Copy, Debug)]
pub(super) enum Limits {
    /// Only a part of the file is parsed. The element counts of the other parts are not known, so indices are not
    /// checked.
    Part,
    /// The whole file is parsed for the first time. Positive indices are not checked, because they can refer to
    /// elements that later lines define. Negative indices are checked.
    Start,
    /// The whole file is parsed again, and all indices are checked. The field contains the number of elements that the
    /// file defines.
    Whole(Counts),
}

const NOUNS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

/// Parses `v`, `v/vt`, `v//vn` or `v/vt/vn`. `now` contains how many positions, texture coordinates and normals are
/// defined before this corner.
///
/// # Errors
///
/// Returns an error if the word is not a corner or refers to an element that does not exist.
pub(super) fn corner(
    place: TextPosition,
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

/// Parses `field`, which is the text of an index. `word` is the text of the whole corner, for errors. `count` is the
/// number of elements of this kind that are defined so far. `limit` is the maximum number of elements of this kind in
/// the whole file. It is `None` if only a part of the file is parsed.
fn index(
    place: TextPosition,
    word: &[u8],
    field: &[u8],
    count: usize,
    limit: Option<usize>,
    noun: &str,
) -> Result<Index, Fault> {
    let Some(written) = parsed::<i64>(field) else {
        return Err(place.expected("a corner such as 1, 1/2, 1//3 or 1/2/3", word));
    };
    if written == 0 {
        let word = quoted(word);
        let message = format!("the corner {word} has index 0, but indices start at 1");
        return Err(place.error(message));
    }
    if written < 0 {
        let relative = written.saturating_add(i64::try_from(count).unwrap_or(i64::MAX));
        if relative < 0 && limit.is_some() {
            let defined = counted(count, noun);
            let message = format!(
                "the corner refers to {noun} {written}, but the file defines only {defined} before this line"
            );
            return Err(place.error(message));
        }
        return Ok(Index::Relative(relative));
    }
    let limit = limit.unwrap_or(NONE as usize);
    match u32::try_from(written - 1) {
        Ok(index) if (index as usize) < limit => Ok(Index::Absolute(index)),
        _ => {
            let defined = counted(limit, noun);
            let message = if limit == NONE as usize {
                format!(
                    "the corner refers to {noun} {written}, but a file can define at most {defined}"
                )
            } else {
                format!("the corner refers to {noun} {written}, but the file defines {defined}")
            };
            Err(place.error(message))
        }
    }
}
