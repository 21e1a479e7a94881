//! The corners of faces, lines and points: indices from 1, or back from the last.

use super::file::NONE;
use crate::fault::Fault;
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
) -> Result<(Index, Option<Index>, Option<Index>), Fault> {
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
        let given = Some(field).filter(|field| !field.is_empty());
        given.map(|field| read(field, of, noun)).transpose()
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
) -> Result<Index, Fault> {
    let Some(written) = integer(field) else {
        return Err(place.expected("a corner such as 1, 1/2, 1//3 or 1/2/3", word));
    };
    if written == 0 {
        let word = quoted(word);
        let message = format!("indices count from 1, but the corner {word} has 0");
        return Err(place.error(message));
    }
    if written < 0 {
        let relative = written + signed(count);
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
    let value = digits.iter().try_fold(0_i64, |value, byte| {
        let digit = byte.is_ascii_digit().then(|| i64::from(byte - b'0'));
        digit.map(|digit| 10 * value + digit)
    })?;
    Some(if negative { -value } else { value })
}

fn signed(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}
