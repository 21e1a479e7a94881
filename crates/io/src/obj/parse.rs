//! Parses the parts of an OBJ file in parallel.

use super::corner::{Counts, Limits};
use super::file::{LeftOut, ObjFile};
use super::join::{fits, join};
use super::part::Part;
use super::statement::{read_part, read_whole};
use crate::fault::Fault;
use crate::text::{TextPosition, check_encoding, quoted};
use mesh::parallel;

/// The approximate size in bytes of a part of the text. The arrays of a part of this size fit in the cache of a
/// processor core.
pub(super) const PART: usize = 256 << 10;

/// Parses the statements of an OBJ file.
///
/// # Errors
///
/// Returns an error if a line violates the format, or an index refers to a missing element.
pub(super) fn parse(bytes: &[u8]) -> Result<ObjFile, Fault> {
    check_encoding(bytes)?;
    parse_in_parts(bytes, PART)
}

fn parse_in_parts(bytes: &[u8], size: usize) -> Result<ObjFile, Fault> {
    let parts = parallel::consume(cut(bytes, size), |i, part| read_part(part, i == 0).ok());
    let parts: Option<Vec<Part>> = parts.into_iter().collect();
    let parts = match parts.filter(|parts| fits(parts)) {
        Some(parts) => parts,
        None => vec![parse_whole(bytes)?],
    };
    let file = join(parts);
    match first_unknown(&file) {
        Some(error) if file.positions.is_empty() => Err(error),
        _ => Ok(file),
    }
}

/// Parses a file in order, after parsing in parts failed. Usually, the file contains an error. Only parsing in order
/// finds the exact position of the first error.
fn parse_whole(bytes: &[u8]) -> Result<Part, Fault> {
    let part = read_whole(bytes, Limits::Start)?;
    if fits(std::slice::from_ref(&part)) {
        return Ok(part);
    }
    // An index of the file is too high. The first pass could not check it, because a vertex can be defined after the
    // faces that use it. The second pass knows the final counts and finds the line of the index.
    let counts: Counts = part.counts();
    drop(part);
    read_whole(bytes, Limits::Whole(counts))
}

/// Returns the error for the first unknown statement, if the file has no vertices. A file that has unknown statements
/// but no vertices is not an OBJ file.
fn first_unknown(file: &ObjFile) -> Option<Fault> {
    let unknown = |(what, &(_, line)): (&LeftOut, &(usize, usize))| match what {
        LeftOut::Unknown(word) => Some((line, word.clone())),
        _ => None,
    };
    let (line, word) = file.left_out.iter().filter_map(unknown).min()?;
    let word = quoted(word.as_bytes());
    let message =
        format!("expected a statement of an OBJ file, found {word} in a file without vertices");
    Some(TextPosition::of_line(line).error(message))
}

/// Cuts the bytes of a file into parts of about `size` bytes. Each part except the last ends at the end of a line that
/// is not continued on the next line.
pub(super) fn cut(bytes: &[u8], size: usize) -> Vec<&[u8]> {
    let mut parts = Vec::with_capacity(bytes.len() / size + 1);
    let mut start = 0;
    while bytes.len() - start > size {
        let end = line_end_from(bytes, start + size);
        parts.push(&bytes[start..end]);
        start = end;
    }
    parts.push(&bytes[start..]);
    parts
}

/// Returns the end of the first line that ends at or after `from` and is not continued on the next line.
fn line_end_from(bytes: &[u8], from: usize) -> usize {
    let mut at = from;
    while at < bytes.len() {
        let is_end = match bytes[at] {
            b'\n' => {
                let line_end = at - usize::from(at > 0 && bytes[at - 1] == b'\r');
                line_end == 0 || bytes[line_end - 1] != b'\\'
            }
            b'\r' => bytes.get(at + 1) != Some(&b'\n') && (at == 0 || bytes[at - 1] != b'\\'),
            _ => false,
        };
        at += 1;
        if is_end {
            break;
        }
    }
    at
}

#[cfg(test)]
mod tests;
