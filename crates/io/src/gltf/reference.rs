//! Resolves references from one part of a glTF document to another. A reference is the index of the other part in its
//! list.

use std::fmt;

use serde_json::Value;

use crate::fault::Fault;

/// Returns the part at `index`. `pointer` is the location of the reference to this part, for errors.
///
/// # Errors
///
/// Returns an error if the index is out of range.
pub(super) fn get<'a, T>(
    pieces: &'a [T],
    index: usize,
    pointer: impl fmt::Display,
    what: &str,
) -> Result<&'a T, Fault> {
    pieces.get(index).ok_or_else(|| {
        let n = pieces.len();
        let message = format!("{what} {index} does not exist (the file has {n})");
        Fault::json(pointer.to_string(), message)
    })
}

/// Parses an index. `pointer` is the location of the index.
///
/// # Errors
///
/// Returns an error if the value is not an index.
pub(super) fn index(value: &Value, pointer: &str) -> Result<usize, Fault> {
    let index = value.as_u64().and_then(|index| usize::try_from(index).ok());
    index.ok_or_else(|| Fault::json(pointer, format!("expected an index, found {value}")))
}
