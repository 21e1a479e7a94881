//! The corners of faces, lines and points: indices from 1, or back from the last.

use super::file::NONE;
use crate::error::TextError;
use crate::text::{Place, quoted};

/// The number of one kind of thing, of which corners name one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) positions: usize,
    pub(super) uvs: usize,
    pub(super) normals: usize,
}

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
const VERTEX: Noun = ("vertex", "vertices");
const UV: Noun = ("texture coordinate", "texture coordinates");
const NORMAL: Noun = ("normal", "normals");

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
) -> Result<(Index, Option<Index>, Option<Index>), TextError> {
    let mut fields = word.splitn(3, |&byte| byte == b'/');
    let [v, vt, vn] = [(); 3].map(|()| fields.next().unwrap_or(b""));
    let read = |field: &[u8], of: fn(Counts) -> usize, noun| {
        let limit = match limits {
            Limits::Part => None,
            Limits::Start => Some(NONE as usize),
            Limits::Whole(counts) => Some(of(counts)),
        };
        index(place, word, field, of(now), limit, noun)
    };
    let optional = |field: &[u8], of, noun| {
        if field.is_empty() {
            Ok(None)
        } else {
            read(field, of, noun).map(Some)
        }
    };
    let position = read(v, |counts| counts.positions, VERTEX)?;
    let uv = optional(vt, |counts| counts.uvs, UV)?;
    let normal = optional(vn, |counts| counts.normals, NORMAL)?;
    Ok((position, uv, normal))
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
) -> Result<Index, TextError> {
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
    if written < 0 {
        let relative = written + signed(count);
        if relative < 0 && limit.is_some() {
            return Err(place.error(format!(
                "the corner refers to {one} {written}, but {count} {many} are defined so far"
            )));
        }
        return Ok(Index::Relative(relative));
    }
    let limit = limit.unwrap_or(NONE as usize);
    match u32::try_from(written - 1) {
        Ok(index) if (index as usize) < limit => Ok(Index::Absolute(index)),
        _ => Err(place.error(format!(
            "the corner refers to {one} {written}, but {limit} {many} are defined {}",
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
