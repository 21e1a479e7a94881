//! Reads and writes compressed files: `model.obj.gz` is read and written like `model.obj`.
//!
//! The content is compressed with gzip (RFC 1952). All formats except `.glb`, `.mws` and `.npz` can be compressed. The
//! size of the decompressed content is limited, because a small compressed file can contain a huge amount of data.

use std::borrow::Cow;
use std::io::{self, Read as _, Write};
use std::path::Path;

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use store::Store;

use crate::error::ReadError;

/// Whether the name of a file ends in `.gz`, in upper or lower case.
pub(crate) fn is_compressed(path: &Path) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("gz"))
}

/// Returns the path without `.gz`. The returned path determines the format of the file, the name of its object, and the
/// names of additional files such as material libraries.
pub(crate) fn plain(path: &Path) -> Cow<'_, Path> {
    if is_compressed(path) {
        Cow::Owned(path.with_extension(""))
    } else {
        Cow::Borrowed(path)
    }
}

/// Decompresses the content of a file if its name ends in `.gz`. `most` is the maximum size of the result in bytes.
///
/// # Errors
///
/// Returns [`ReadError::Compressed`] if the content is damaged or larger than `most`.
pub(crate) fn unpacked(path: &Path, bytes: Vec<u8>, most: u64) -> Result<Vec<u8>, ReadError> {
    if !is_compressed(path) {
        return Ok(bytes);
    }
    let error = |message: String| ReadError::Compressed {
        path: path.to_path_buf(),
        message,
    };
    let mut out = Vec::new();
    // Memory is allocated while the content is decompressed. The size that the file declares is not used, because it
    // can be wrong.
    let mut decoder = MultiGzDecoder::new(&bytes[..]).take(most.saturating_add(1));
    let read = decoder.read_to_end(&mut out);
    read.map_err(|why| error(format!("the compressed content is damaged: {why}")))?;
    if out.len() as u64 > most {
        let message = format!(
            "the decompressed content of the file is larger than the memory budget of {}",
            mesh::readable_bytes(most)
        );
        return Err(error(message));
    }
    Ok(out)
}

/// Returns the beginning of the content of a file: at most `most` bytes. The content of a `.gz` file is decompressed.
///
/// # Errors
///
/// Returns an error if the file cannot be read or decompressed.
pub(crate) fn head(store: &dyn Store, path: &Path, most: u64) -> Result<Vec<u8>, ReadError> {
    if !is_compressed(path) {
        return Ok(store.read_up_to(path, most)?);
    }
    let bytes = store.read(path)?;
    let mut out = Vec::new();
    let read = MultiGzDecoder::new(&bytes[..])
        .take(most)
        .read_to_end(&mut out);
    read.map_err(|why| ReadError::Compressed {
        path: path.to_path_buf(),
        message: format!("the compressed content is damaged: {why}"),
    })?;
    Ok(out)
}

/// Compresses the bytes that `write` writes, and returns the number of compressed bytes. Equal content gives equal
/// compressed bytes, because the header contains neither a time nor a file name.
///
/// # Errors
///
/// Returns an error if `out` or `write` fails.
pub(crate) fn compress(
    out: &mut (dyn Write + Send),
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<u64>,
) -> io::Result<u64> {
    let counter = Counter { out, n: 0 };
    let mut encoder = GzEncoder::new(counter, Compression::default());
    write(&mut encoder)?;
    Ok(encoder.finish()?.n)
}

/// Counts the bytes that are written.
struct Counter<'a> {
    out: &'a mut (dyn Write + Send),
    n: u64,
}

impl Write for Counter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let n = self.out.write(bytes)?;
        self.n += n as u64;
        Ok(n)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
