//! COLLADA.

use std::path::Path;

use crate::Found;
use crate::error::ReadError;
use crate::note::Notes;
use crate::peek::PeekObject;

/// Reads a file from its bytes.
pub(crate) fn read(
    path: &Path,
    _bytes: &[u8],
    _name: &str,
    _notes: &mut Notes,
) -> Result<Vec<Found>, ReadError> {
    Err(ReadError::io(path, std::io::ErrorKind::Unsupported.into()))
}

/// What reading will give.
pub(crate) fn peek(path: &Path, _bytes: &[u8], _name: &str) -> Result<Vec<PeekObject>, ReadError> {
    Err(ReadError::io(path, std::io::ErrorKind::Unsupported.into()))
}
