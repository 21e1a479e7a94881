//! Replacing a file by another text, at once.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// Puts a text in place of that of a file: written beside it and renamed, so that nobody meets half of it. A
/// link stays a link, and who may read and write the file stays as it was.
pub(crate) fn replace_file(path: &Path, text: &str) -> io::Result<()> {
    let path = path.canonicalize()?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut new = tempfile::Builder::new()
        .prefix(".meshwright-")
        .tempfile_in(folder)?;
    new.write_all(text.as_bytes())?;
    new.as_file().sync_all()?;
    new.as_file()
        .set_permissions(fs::metadata(&path)?.permissions())?;
    new.persist(&path)?;
    Ok(())
}
