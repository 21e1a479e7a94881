//! Stanford PLY.

use std::path::Path;

use scene::Scene;

use crate::error::{ReadError, Unwritable};
use crate::note::Notes;
use crate::peek::PeekGeometry;
use crate::{Found, WriteOptions, Written};

/// Reads a file from its bytes.
pub(crate) fn read(
    path: &Path,
    _bytes: &[u8],
    _name: String,
    _notes: &mut Notes,
) -> Result<Found, ReadError> {
    Err(ReadError::io(path, std::io::ErrorKind::Unsupported.into()))
}

/// What reading will give.
pub(crate) fn peek(path: &Path, _bytes: &[u8]) -> Result<PeekGeometry, ReadError> {
    Err(ReadError::io(path, std::io::ErrorKind::Unsupported.into()))
}

/// The bytes of a file that holds `scene`.
pub(crate) fn write(
    _path: &Path,
    _scene: &Scene,
    _options: &WriteOptions,
) -> Result<Written, Unwritable> {
    Err(Unwritable::Scene {
        message: "cannot be written yet".to_owned(),
    })
}
