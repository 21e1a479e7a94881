//! Writes files completely or not at all. Large files are produced in blocks on all threads.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;

use store::Store;

use crate::error::WriteError;
use crate::gzip;
use mesh::parallel::consume;

/// The content of a file that is about to be written.
pub(crate) enum Content<'a> {
    /// Bytes that only this file uses.
    Bytes(Vec<u8>),
    /// The bytes of an image, which are shared with the scene.
    Shared(Arc<[u8]>),
    /// Functions that produce the blocks of the file in order. Only a few blocks are in memory at a time, so even a
    /// large file takes little memory while it is written.
    Blocks(Vec<Block<'a>>),
}

/// A function that appends one block of a file to a buffer. A block has a few hundred kilobytes.
pub(crate) type Block<'a> = Box<dyn Fn(&mut Vec<u8>) + Send + Sync + 'a>;

/// Writes all files to temporary files first. When all temporary files are complete, moves them to their paths in the
/// given order. The last file is compressed if its name ends in `.gz`. Returns the paths and the total size in bytes.
///
/// # Errors
///
/// Returns [`WriteError::Io`] with the path of the file that could not be written. After this error, existing files are
/// unchanged, with one exception: if the system fails to rename one of several temporary files, the files that were
/// renamed earlier have already been replaced.
pub(crate) fn save(
    store: &dyn Store,
    files: Vec<(PathBuf, Content)>,
) -> Result<(Vec<PathBuf>, u64), WriteError> {
    let mut complete = Vec::with_capacity(files.len());
    let mut n_bytes = 0;
    let last = files.len().saturating_sub(1);
    for (i, (path, content)) in files.into_iter().enumerate() {
        let mut file = store.create(&path)?;
        let written = if i == last && gzip::is_compressed(&path) {
            gzip::compress(&mut *file, |out| content.write(out))
        } else {
            content.write(&mut *file)
        };
        match written {
            Ok(n) => n_bytes += n,
            Err(source) => return Err(WriteError::Io { path, source }),
        }
        complete.push((path, file));
    }
    let mut paths = Vec::with_capacity(complete.len());
    for (path, file) in complete {
        file.commit()?;
        paths.push(path);
    }
    Ok((paths, n_bytes))
}

impl Content<'_> {
    /// Writes the content, and returns the number of bytes written.
    fn write(&self, out: &mut (dyn Write + Send)) -> io::Result<u64> {
        let n_bytes = match self {
            Content::Bytes(bytes) => {
                out.write_all(bytes)?;
                bytes.len() as u64
            }
            Content::Shared(bytes) => {
                out.write_all(bytes)?;
                bytes.len() as u64
            }
            Content::Blocks(blocks) => write_blocks(out, blocks)?,
        };
        out.flush()?;
        Ok(n_bytes)
    }
}

/// Runs the blocks, writes the bytes that they append to `out`, and returns the number of bytes. While one thread
/// writes a group of blocks, the other threads produce the next group.
fn write_blocks(out: &mut (dyn Write + Send), blocks: &[Block]) -> io::Result<u64> {
    let in_group = 4 * rayon::current_num_threads();
    let mut ready: Vec<Vec<u8>> = Vec::new();
    let mut spare: Vec<Vec<u8>> = Vec::new();
    let mut n_bytes = 0;
    // Each round writes one group of blocks and produces the next group. The last round
    // writes the last group and produces nothing.
    for group in blocks.chunks(in_group).chain([&[][..]]) {
        spare.resize_with(group.len(), Vec::new);
        let (written, ()) = rayon::join(
            || ready.iter().try_for_each(|bytes| out.write_all(bytes)),
            || {
                consume(&mut spare, |i, bytes: &mut Vec<u8>| {
                    bytes.clear();
                    group[i](bytes);
                });
            },
        );
        written?;
        n_bytes += ready.iter().map(|bytes| bytes.len() as u64).sum::<u64>();
        std::mem::swap(&mut ready, &mut spare);
    }
    Ok(n_bytes)
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use store::Disk;

    use super::*;

    fn save_all(files: &[(&Path, &[u8])]) -> Result<(), WriteError> {
        let content =
            |&(path, bytes): &(&Path, &[u8])| (path.to_owned(), Content::Bytes(bytes.to_vec()));
        save(&Disk, files.iter().map(content).collect()).map(|_| ())
    }

    #[test]
    fn files_are_replaced_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        fs::write(&a, "old").unwrap();

        save_all(&[(&a, b"new"), (&b, b"b")]).unwrap();

        assert_eq!(fs::read(a).unwrap(), b"new");
        assert_eq!(fs::read(b).unwrap(), b"b");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn blocks_are_written_in_order() {
        let folder = tempfile::tempdir().unwrap();
        for n in [0, 1, 7, 1000] {
            let path = folder.path().join(n.to_string());
            let block = |i: usize| -> Block {
                Box::new(move |out| {
                    let length = i * 7919 % 300;
                    out.extend(format!("{i} ").as_bytes().iter().cycle().take(length));
                })
            };
            let mut expected = Vec::new();
            for i in 0..n {
                block(i)(&mut expected);
            }
            let blocks = Content::Blocks((0..n).map(block).collect());
            let (_, n_bytes) = save(&Disk, vec![(path.clone(), blocks)]).unwrap();
            assert_eq!(fs::read(path).unwrap(), expected);
            assert_eq!(n_bytes, expected.len() as u64);
        }
    }

    #[test]
    fn if_one_file_cannot_be_written_no_file_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let a = folder.path().join("a");
        let missing = folder.path().join("no/such/b");

        let error = save_all(&[(&a, b""), (&missing, b"")]).unwrap_err();

        let expected = format!(
            "cannot write {}: the folder does not exist",
            missing.display()
        );
        assert_eq!(error.to_string(), expected);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_folder_with_the_name_of_the_file_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(save_all(&[(folder.path(), b"")]).is_err());
    }
}
